//! `adslam export`

use adslam_diagnostics::{Failure, InputError};
use adslam_experiment::run::{StoredRun, refuse_part_of_run};
use adslam_export::{Period, write_csv, write_mcap, write_ply};
use adslam_record::prepare_folder;

use crate::ExportArgs;
use crate::answer::Answer;
use crate::args::ExportFormat;

/// Writes a run in the format of another tool.
///
/// # Errors
/// A folder without a run, a period that is none, or files that cannot be written.
pub fn export(args: &ExportArgs) -> Result<(), Failure> {
    Answer::give(args.json, |answer| write(args, answer))
}

fn write(args: &ExportArgs, answer: &mut Answer) -> Result<(), Failure> {
    refuse_part_of_run(&args.out)?;
    let StoredRun { history, warnings } = StoredRun::load(&args.run)?;
    answer.warn(&warnings);
    let out = &args.out;
    let shown = out.display();
    answer.set("out", crate::paths::shown(out));
    answer.set("steps", history.steps.len());
    if args.format == ExportFormat::Ply {
        let files = write_ply(&history, out)?;
        answer.set("count", files);
        answer.say(format_args!("wrote {files} PLY files to {shown}"));
        return Ok(());
    }
    if let Some(folder) = out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        prepare_folder(folder)?;
    }
    if args.format == ExportFormat::Csv {
        write_csv(&history, out)?;
    } else {
        let period = Period::from_seconds(args.period).ok_or_else(|| {
            InputError::about_file(out, format!("steps cannot be {} s apart", args.period))
                .with_help("give --period a number of seconds, up to 3600")
        })?;
        write_mcap(&history, period, out)?;
    }
    answer.say(format_args!(
        "wrote {} steps to {shown}",
        history.steps.len()
    ));
    Ok(())
}
