//! `adslam tables`

use std::fs;
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::study::SummaryRecord;
use adslam_experiment::tables::{TablePlan, Tables, json, markdown, terminal};
use adslam_record::AtomicFile;
use adslam_scenario::registry::Registry;

use super::study::{finish, other_builds, tell_if_partial};
use crate::TablesArgs;
use crate::answer::Answer;
use crate::paths::{folder_of, shown};

/// Does the runs of a configuration that are not there yet, prints its tables, and writes tables.md and tables.json,
/// and report.html where it is asked for.
///
/// Interrupted, it still prints the tables of the runs that have finished, and writes none.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn tables(
    args: &TablesArgs,
    registry: &Registry,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    Answer::give(args.json, |answer| {
        run_missing(args, registry, interrupt, answer)
    })
}

fn run_missing(
    args: &TablesArgs,
    registry: &Registry,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), Failure> {
    let out = args.folder();
    let plan = TablePlan::load_with(&args.config, &args.selection.selection(), registry)?;
    let mut study = plan.open(&out, other_builds(args.accept_build))?;
    answer.set("title", plan.title());
    let end = finish(&mut study, &out, answer, interrupt, SummaryRecord::of_unit)?;
    let mut tables = plan.tables(study.records(), end, study.builds());
    answer.warn(&tables.warnings);
    answer.say(terminal(&tables));
    if tables.interrupted {
        return tables.into_result();
    }
    let files = study.write_results(|folder| write(&tables, folder))?;
    answer.set_files(&files);
    let names: Vec<String> = files.iter().map(|file| shown(file)).collect();
    answer.say(format_args!("wrote {}", names.join(" and ")));
    tell_if_partial(&study, answer);
    if args.html {
        let known = tables.warnings.len();
        plan.record(&mut tables, interrupt)?;
        answer.warn(&tables.warnings[known..]);
        let page = adslam_report::write(&tables, folder_of(&files[0]))?;
        answer.set("report", shown(&page));
        answer.say(format_args!(
            "wrote {}; open it in a browser, no network needed",
            page.display()
        ));
    }
    tables.into_result()
}

/// Writes the tables, and first removes a report of others.
fn write(tables: &Tables, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let paths = ["tables.md", "tables.json"].map(|name| folder.join(name));
    let texts = [markdown(tables), json(tables)?];
    if fs::read_to_string(&paths[1]).ok().as_ref() != Some(&texts[1]) {
        adslam_report::remove(folder)?;
    }
    let files = paths.iter().zip(texts);
    let files = files.map(|(path, text)| AtomicFile::with_content(path, text.as_bytes()));
    AtomicFile::commit_all(files.collect::<Result<_, _>>()?)?;
    Ok(paths.into())
}
