//! The lints of the workspace, above all that no code is unsafe, hold in every crate: one that forgets
//! `[lints] workspace = true` would be built without them.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::fs;
use std::path::{Path, PathBuf};

use adslam_tests::repository;
use toml::Table;

fn manifest(folder: &Path) -> Table {
    let path = folder.join("Cargo.toml");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    text.parse()
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The folders of all crates that the workspace names.
fn members(workspace: &Table) -> Vec<PathBuf> {
    let patterns = workspace["members"].as_array().unwrap();
    let patterns = patterns.iter().map(|pattern| pattern.as_str().unwrap());
    let folders = patterns.flat_map(|pattern| match pattern.strip_suffix("/*") {
        Some(parent) => fs::read_dir(repository(parent))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect(),
        None => vec![repository(pattern)],
    });
    folders.collect()
}

#[test]
fn every_crate_takes_the_workspaces_lints() {
    let root = manifest(&repository(""));
    let workspace = root["workspace"].as_table().unwrap();
    let forbidden = |lints: &toml::Value| lints["rust"]["unsafe_code"].as_str() == Some("forbid");
    assert!(forbidden(&workspace["lints"]), "unsafe code is forbidden");
    let members = members(workspace);
    assert!(members.len() > 10, "{members:?}");
    for member in members {
        let lints = manifest(&member)
            .get("lints")
            .and_then(|lints| lints.get("workspace")?.as_bool());
        assert_eq!(lints, Some(true), "{}", member.display());
    }
    // A workspace of its own, as it is built with other flags.
    assert!(forbidden(&manifest(&repository("fuzz"))["lints"]));
}
