//! `adslam new`

use std::fs;
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError};
use adslam_experiment::run::refuse_part_of_run;
use adslam_record::{AtomicFile, prepare_folder};
use adslam_scenario::Scenario;
use adslam_scenario::registry::Registry;

use crate::answer::Answer;
use crate::args::{NewArgs, NewFile};
use crate::paths::folder_of;

const SCENARIO: &str = include_str!("../../templates/scenario.toml");
const CONFIG: &str = include_str!("../../templates/config.toml");
const SWEEP: &str = include_str!("../../templates/sweep.toml");

/// Writes a commented scenario, configuration or sweep to start from.
///
/// # Errors
/// A file that is there already, one that cannot be written, or a scenario that cannot be used.
pub fn new(file: &NewFile, registry: &Registry) -> Result<(), Failure> {
    let (NewFile::Scenario(args) | NewFile::Config { args, .. } | NewFile::Sweep { args, .. }) =
        file;
    Answer::give(args.json, |answer| match file {
        NewFile::Scenario(_) => {
            let out = write(args, "scenario.toml", |_| Ok(SCENARIO.to_owned()), answer)?;
            answer.say(format_args!(
                "wrote {0}; next: adslam run {0} --planner combined --out results/run",
                out.display()
            ));
            Ok(())
        }
        NewFile::Config { scenario, .. } => {
            let text = |out: &Path| of_scenario(CONFIG, out, scenario.as_deref(), registry);
            let out = write(args, "config.toml", text, answer)?;
            answer.say(format_args!(
                "wrote {0}; next: adslam tables {0} --out results",
                out.display()
            ));
            Ok(())
        }
        NewFile::Sweep { scenario, .. } => {
            let text = |out: &Path| of_scenario(SWEEP, out, scenario.as_deref(), registry);
            let out = write(args, "sweep.toml", text, answer)?;
            answer.say(format_args!(
                "wrote {0}; next: adslam sweep {0} --out results",
                out.display()
            ));
            Ok(())
        }
    })
}

/// Writes the text for a place, unless something is there; returns the place.
fn write(
    args: &NewArgs,
    default: &str,
    text: impl FnOnce(&Path) -> Result<String, InputError>,
    answer: &mut Answer,
) -> Result<PathBuf, Failure> {
    let out = args.out.clone().unwrap_or_else(|| default.into());
    if !args.force && fs::symlink_metadata(&out).is_ok() {
        let message = format!("{} is there already", out.display());
        return Err(InputError::about_file(&out, message)
            .with_help("give another path with --out, or replace it with --force")
            .into());
    }
    refuse_part_of_run(&out)?;
    let text = text(&out)?;
    prepare_folder(folder_of(&out))?;
    AtomicFile::with_content(&out, text.as_bytes())?.commit()?;
    answer.set_files(&[&out]);
    Ok(out)
}

/// The text at `out` that names a scenario or, if none is given, the `scenario.toml` beside it.
fn of_scenario(
    template: &str,
    out: &Path,
    scenario: Option<&Path>,
    registry: &Registry,
) -> Result<String, InputError> {
    let folder = folder_of(out);
    let beside = out.with_file_name("scenario.toml");
    let path = scenario.unwrap_or(&beside);
    if !path.exists() {
        let message = format!("there is no scenario {}", path.display());
        return Err(InputError::about_file(path, message).with_help(format!(
            "name one with --scenario, or write it first: adslam new scenario --out {}",
            path.display()
        )));
    }
    Scenario::load_with(path, registry)?;
    let name = relative(path, folder);
    let name = name.to_str().ok_or_else(|| {
        let message = format!("{} is no Unicode text", path.display());
        InputError::about_file(path, message).with_help("give the scenario a plain name")
    })?;
    let quoted = toml::Value::from(name).to_string();
    Ok(template.replace("{scenario}", &quoted))
}

/// The path as it counts from `folder`; absolute where the one does not lead to the other.
fn relative(path: &Path, folder: &Path) -> PathBuf {
    let absolute = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let (path, folder) = (absolute(path), absolute(folder));
    pathdiff::diff_paths(&path, &folder).unwrap_or(path)
}
