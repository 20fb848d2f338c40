//! `adslam replay`

use std::path::PathBuf;

use adslam_diagnostics::Failure;
use adslam_experiment::run::{StoredRun, refuse_part_of_run};
use adslam_record::{RunHistory, prepare_folder};

use crate::ReplayArgs;
use crate::answer::Answer;
use crate::paths::folder_of;

/// Makes one page of one or two runs.
///
/// # Errors
/// A folder without a run, or a file that cannot be written.
pub fn replay(args: &ReplayArgs) -> Result<(), Failure> {
    Answer::give(args.json, |answer| make_page(args, answer))
}

fn make_page(args: &ReplayArgs, answer: &mut Answer) -> Result<(), Failure> {
    refuse_part_of_run(&args.out)?;
    let load = |folder: &PathBuf| StoredRun::load(folder);
    let runs: Vec<StoredRun> = args.runs.iter().map(load).collect::<Result<_, _>>()?;
    for run in &runs {
        answer.warn(&run.warnings);
    }
    let histories: Vec<&RunHistory> = runs.iter().map(|run| &run.history).collect();
    prepare_folder(folder_of(&args.out))?;
    let bytes = adslam_replay::write_html(&histories, &args.out)?;
    answer.set("bytes", bytes);
    answer.set_files(&[&args.out]);
    answer.say(format_args!(
        "wrote {} ({:.1} MB); open it in a browser, no network needed",
        args.out.display(),
        bytes as f64 / 1e6
    ));
    Ok(())
}
