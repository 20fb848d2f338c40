//! Tells the library by which code and compiler it was built: a checksum that changes with the sources of this
//! crate and of those that it computes with, with the locked dependencies, and with what the compiler is told.

use std::env;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The workspace's files, from this crate's folder. Those that are not there, as in a crate that was packed by itself,
/// count as absent.
const WORKSPACE: [&str; 2] = ["../../Cargo.toml", "../../Cargo.lock"];

/// The crates whose code decides about results.
const CRATES: [&str; 12] = [
    "agent",
    "deformation",
    "estimator",
    "experiment",
    "models",
    "names",
    "planning",
    "scenario",
    "setup",
    "simulation",
    "statistics",
    "surface",
];

/// What Cargo says of the compilation that may change the arithmetic.
const SETTINGS: [&str; 4] = [
    "TARGET",
    "OPT_LEVEL",
    "CARGO_CFG_TARGET_FEATURE",
    "CARGO_ENCODED_RUSTFLAGS",
];

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut hasher = crc32fast::Hasher::new();
    let of_crate = |name| ["src", "build.rs", "Cargo.toml"].map(|part| format!("../{name}/{part}"));
    let of_crates = CRATES.into_iter().flat_map(of_crate);
    for source in WORKSPACE.map(str::to_owned).into_iter().chain(of_crates) {
        let path = root.join(&source);
        if path.exists() {
            add(&mut hasher, &source, &path)?;
        }
    }
    for setting in SETTINGS {
        hasher.update(env::var(setting).unwrap_or_default().as_bytes());
        hasher.update(b"\0");
    }
    hasher.update(&compiler());
    println!("cargo::rustc-env=ADSLAM_BUILD={:08x}", hasher.finalize());
    Ok(())
}

/// Adds a file, or all files below a folder by their names, and asks to be run again when one of them changes. Tests
/// by themselves decide about no result: to change one builds nothing anew. A file that is new is named in another,
/// which changes then.
fn add(hasher: &mut crc32fast::Hasher, name: &str, path: &Path) -> io::Result<()> {
    if path.file_stem().is_some_and(|stem| stem == "tests") {
        return Ok(());
    }
    if path.is_dir() {
        let mut names: Vec<_> = fs::read_dir(path)?
            .map(|entry| entry.map(|entry| entry.file_name()))
            .collect::<io::Result<_>>()?;
        names.sort();
        for child in names {
            let name = format!("{name}/{}", child.to_string_lossy());
            add(hasher, &name, &path.join(child))?;
        }
        return Ok(());
    }
    println!("cargo::rerun-if-changed={}", path.display());
    hasher.update(name.as_bytes());
    // Checkouts differ in how lines end.
    let mut content = fs::read(path)?;
    content.retain(|byte| *byte != b'\r');
    hasher.update(&(content.len() as u64).to_le_bytes());
    hasher.update(&content);
    Ok(())
}

/// The compiler's version.
fn compiler() -> Vec<u8> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let said = Command::new(rustc).arg("-vV").output();
    said.map(|said| said.stdout).unwrap_or_default()
}
