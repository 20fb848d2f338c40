//! Who may use whom: the picture of docs/ARCHITECTURE.md against the manifests.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn metadata() -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--offline"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The name of a crate's folder in `crates/`; none for other packages.
fn layered(package: &Value) -> Option<String> {
    let manifest = Path::new(package["manifest_path"].as_str()?);
    let folder = manifest.parent()?;
    let is_crate = folder.parent()?.file_name()? == "crates" && package["source"].is_null();
    is_crate.then(|| folder.file_name().unwrap().to_string_lossy().into_owned())
}

/// The place of each crate in the first picture of the page, from the top.
fn picture() -> BTreeMap<String, usize> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/ARCHITECTURE.md");
    let text = fs::read_to_string(page).unwrap();
    let block = text
        .split("```text\n")
        .nth(1)
        .unwrap()
        .split("```")
        .next()
        .unwrap();
    let lines = block.lines().enumerate();
    lines
        .flat_map(|(line, crates)| {
            crates
                .split_whitespace()
                .map(move |name| (name.to_owned(), line))
        })
        .collect()
}

/// For each package what it is built with, tests apart.
fn dependencies(metadata: &Value) -> BTreeMap<String, Vec<String>> {
    let nodes = metadata["resolve"]["nodes"].as_array().unwrap();
    let of_node = |node: &Value| {
        let used = node["deps"].as_array().unwrap().iter();
        let normal = |dep: &&Value| {
            dep["dep_kinds"]
                .as_array()
                .unwrap()
                .iter()
                .any(|kind| kind["kind"].is_null())
        };
        used.filter(normal)
            .map(|dep| dep["pkg"].as_str().unwrap().to_owned())
            .collect()
    };
    nodes
        .iter()
        .map(|node| (node["id"].as_str().unwrap().to_owned(), of_node(node)))
        .collect()
}

#[test]
fn crates_use_only_what_is_below_them() {
    let metadata = metadata();
    let layers = picture();
    let packages = metadata["packages"].as_array().unwrap();
    let names: BTreeMap<&str, String> = packages
        .iter()
        .filter_map(|package| Some((package["id"].as_str()?, layered(package)?)))
        .collect();
    assert_eq!(
        names.values().collect::<BTreeSet<_>>(),
        layers.keys().collect::<BTreeSet<_>>(),
        "the picture has every crate"
    );
    let dependencies = dependencies(&metadata);
    for (id, name) in &names {
        for used in &dependencies[*id] {
            let Some(used) = names.get(used.as_str()) else {
                continue;
            };
            assert!(layers[name] < layers[used], "{name} uses {used}");
        }
    }
}

#[test]
fn figures_replays_and_exports_know_no_toml() {
    let metadata = metadata();
    let packages = metadata["packages"].as_array().unwrap();
    let dependencies = dependencies(&metadata);
    let name =
        |id: &str| packages.iter().find(|package| package["id"] == id).unwrap()["name"].clone();
    for package in packages {
        let knows_toml = match layered(package).as_deref() {
            Some("figures" | "replay" | "export" | "record") => false,
            Some("scenario") => true,
            _ => continue,
        };
        let mut seen = BTreeSet::new();
        let mut next = vec![package["id"].as_str().unwrap().to_owned()];
        while let Some(id) = next.pop() {
            if seen.insert(id.clone()) {
                next.extend(dependencies[&id].iter().cloned());
            }
        }
        let toml = seen.iter().any(|id| name(id) == "toml");
        assert_eq!(toml, knows_toml, "{}", package["name"]);
    }
}
