//! `cargo xtask docs`: the files that are made from the code.

mod reference;
mod schemas;
mod words;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use adslam_cli::{FAILURE, schema_text};
use adslam_scenario::FileKind;
use adslam_scenario::registry::Registry;
use adslam_scenario::schema::json_schema;
use serde_json::Value;

const TEMPLATE: &str = include_str!("../templates/scenario.md");

/// Writes every file whose content has changed, says which, and returns the exit code.
pub fn renew(workspace: &Path) -> ExitCode {
    match stale(workspace) {
        Ok(files) => {
            for (path, content) in files {
                if let Err(error) = fs::write(&path, content) {
                    eprintln!("error: cannot write {}: {error}", path.display());
                    return ExitCode::from(FAILURE);
                }
                println!("wrote {}", path.display());
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(FAILURE)
        }
    }
}

/// The files whose content is not what the code makes, with what it makes.
fn stale(workspace: &Path) -> Result<Vec<(PathBuf, String)>, String> {
    let registry = Registry::standard();
    let schemas: Vec<Value> = FileKind::ALL
        .map(|kind| json_schema(kind, &registry))
        .into();
    let mut files = vec![(
        workspace.join("docs/scenario.md"),
        reference::render(TEMPLATE, &schemas)?,
    )];
    for kind in FileKind::ALL {
        let name = format!("schemas/{}.schema.json", kind.short_name());
        files.push((workspace.join(name), schema_text(kind, &registry)));
    }
    files.retain(|(path, content)| fs::read_to_string(path).ok().as_ref() != Some(content));
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_made_from_the_code_are_up_to_date() {
        let files = stale(&crate::workspace()).unwrap();
        let names: Vec<_> = files.iter().map(|(path, _)| path.display()).collect();
        assert!(
            names.is_empty(),
            "`cargo xtask docs` renews {names:?}, which the code has left behind"
        );
    }
}
