//! What the commands that do studies have in common.

use std::path::Path;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::provenance::remark;
use adslam_experiment::study::{OtherBuilds, Study, StudyEnd, StudyUnit};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::answer::Answer;
use crate::print::tell;
use crate::progress;

/// What `--accept-build` says.
pub(super) const fn other_builds(accept: bool) -> OtherBuilds {
    if accept {
        OtherBuilds::Accept
    } else {
        OtherBuilds::Refuse
    }
}

/// Does the runs of a study that are not in its folder yet, with a bar, and tells how many there are.
///
/// # Errors
/// A record that cannot be written. Failed runs and an interruption are in what is returned; of failed runs before an
/// interruption the user has been told.
pub(super) fn finish<'a, R, W>(
    study: &mut Study<'a, R>,
    folder: &Path,
    answer: &mut Answer,
    interrupt: &Interrupt,
    work: W,
) -> Result<StudyEnd, Failure>
where
    R: Serialize + DeserializeOwned + Send,
    W: Fn(&StudyUnit<'a>, &Interrupt) -> Result<R, Failure> + Sync,
{
    let (total, there) = (study.units().len(), study.done());
    answer.set("runs", total);
    answer.set("runs_there_already", there);
    if there > 0 {
        answer.say(format_args!("{there} of {total} runs were there already"));
    }
    let bar = progress::bar(total, "runs").with_position(there as u64);
    bar.reset_eta();
    let end = study.finish(interrupt, &|| bar.inc(1), work);
    bar.finish_and_clear();
    let done = study.done();
    answer.set("runs_done", done);
    if done < total {
        let out = folder.display();
        tell(format_args!(
            "{done} of {total} runs are kept in {out}; the same command does the others"
        ));
    }
    let end = end?;
    answer.set("complete", done == total);
    answer.set("failures", &end.failures);
    let builds = study.builds();
    if let Some(remark) = remark(&builds) {
        answer.warn(&[remark.replace("**", "")]);
    }
    answer.set("builds", builds);
    if end.interrupted && !end.failures.is_empty() {
        // The interruption is what the command ends with, and tells nothing of these.
        let failures = end.failures.clone();
        tell(Failure::Runs { failures });
    }
    Ok(end)
}

/// Says that results of a part of the runs do not lie where whole ones would.
pub(super) fn tell_if_partial<R>(study: &Study<'_, R>, answer: &Answer) {
    if !study.is_complete() {
        answer.say(
            "the tables lack runs, so they lie apart, and what was complete before stays as it was",
        );
    }
}
