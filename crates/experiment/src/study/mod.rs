//! Many runs that survive: a plan, a folder, and a file for each finished run.
//!
//! A study does every unit of its plan once and keeps what each gave in a file of its own, written whole or not
//! at all. Killed at any moment and opened again, it does what is missing and nothing twice. What is made of a
//! study should be made of its [records](Study::records) alone, which come in the order of the plan: then it is
//! the same, byte for byte, however often the study was stopped and on however many threads it ran.
//!
//! The folder has `study.lock`, which the working process holds locked, `plan.json`, which says what the study
//! is and which builds have worked on it, and `records/`. A study may grow: by runs, points and planners.

mod content;
mod difference;
mod folder;
mod growth;
mod kept;
mod plan;
pub(crate) mod points;
mod record;
mod refusal;
mod results;
mod summary;
#[cfg(test)]
mod tests;

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

pub use plan::{StudyPlan, StudyPoint, StudyUnit};
pub use summary::SummaryRecord;

use crate::provenance::BuildRuns;
use crate::run::Progress;
use adslam_diagnostics::Failure;
use adslam_diagnostics::Interrupt;
use folder::StudyFolder;
use record::{RecordFile, encode};

/// A study at work: its folder is locked until this is dropped.
#[derive(Debug)]
pub struct Study<'a, R> {
    folder: StudyFolder,
    units: Vec<StudyUnit<'a>>,
    records: Vec<Option<R>>,
    /// The number of the build that did each unit, among those of the folder.
    builds: Vec<Option<usize>>,
}

/// Whether a folder may hold runs of other builds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OtherBuilds {
    /// Their runs may differ from those that this build would do: they are refused.
    #[default]
    Refuse,
    /// The user takes them for the same.
    Accept,
}

/// How the work on a study ended.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyEnd {
    /// Units that failed, in the order of the plan, and why; they are tried again next time.
    pub failures: Vec<String>,
    /// Whether the user stopped it before all units were done.
    pub interrupted: bool,
}

impl StudyEnd {
    /// An error if not every unit was done.
    ///
    /// # Errors
    /// [`Failure::Interrupted`] where the user stopped it, else [`Failure::Runs`] where units
    /// failed.
    pub fn into_result(self) -> Result<(), Failure> {
        Failure::unless_complete(self.interrupted, self.failures)
    }
}

/// What became of a unit that had no record.
enum Outcome<R> {
    Done(R),
    Failed(String),
    /// Not begun or not finished, as the user or a failed write stopped the work.
    Stopped,
    NotWritten(Failure),
}

impl<'a, R: Serialize + DeserializeOwned + Send> Study<'a, R> {
    /// Begins the study of `plan` in `folder`, resumes it, or lets it grow to `plan`: locks the folder, makes
    /// sure that it holds nothing that is not in `plan`, reads the records that are there, removes what a killed
    /// process left half-written, and writes down what the study has become.
    ///
    /// # Errors
    /// [`InputError`](adslam_diagnostics::InputError) where another process works in the folder, where it holds
    /// another study, runs that are not in the plan, or runs of another build, where a record is damaged or
    /// foreign, and where it cannot be written to; nothing of what is there is changed then, but for the lock's
    /// file. [`Failure::Output`] where the plan cannot be written.
    pub fn open(
        folder: &Path,
        plan: &StudyPlan<'a>,
        other_builds: OtherBuilds,
    ) -> Result<Self, Failure> {
        let (folder, units) = StudyFolder::lock(folder, plan, other_builds)?;
        let read: Vec<_> = units
            .par_iter()
            .map(|unit| folder.record(unit).read())
            .collect();
        let read = read.into_iter().collect::<Result<Vec<Option<_>>, _>>()?;
        let (records, builds) = read.into_iter().map(Option::unzip).unzip();
        folder.prepare()?;
        Ok(Self {
            folder,
            units,
            records,
            builds,
        })
    }

    /// The units, in the order of the plan.
    #[must_use]
    pub fn units(&self) -> &[StudyUnit<'a>] {
        &self.units
    }

    /// What each unit gave, in the order of the plan; none where it has not been done.
    #[must_use]
    pub fn records(&self) -> &[Option<R>] {
        &self.records
    }

    /// How many units each build has done; builds that have done none are left out.
    #[must_use]
    pub fn builds(&self) -> Vec<BuildRuns> {
        let of = self.folder.builds().iter().enumerate();
        let of = of.map(|(number, build)| BuildRuns {
            build: build.clone(),
            runs: self.builds.iter().filter(|by| **by == Some(number)).count(),
        });
        of.filter(|of| of.runs > 0).collect()
    }

    /// How many units have been done.
    #[must_use]
    pub fn done(&self) -> usize {
        self.records.iter().flatten().count()
    }

    /// Does the units that have no record, in parallel on rayon's threads, each with `work`; calls `progress`
    /// after each. A unit that fails does not stop the others, and is tried again next time.
    ///
    /// `work` should look at the [`Interrupt`] that it is given and then return
    /// [`Failure::Interrupted`].
    ///
    /// # Errors
    /// [`Failure::Output`] where a record cannot be written; no further unit is begun then, and the
    /// records that were written stay.
    pub fn finish<W>(
        &mut self,
        interrupt: &Interrupt,
        progress: Progress<'_>,
        work: W,
    ) -> Result<StudyEnd, Failure>
    where
        W: Fn(&StudyUnit<'a>, &Interrupt) -> Result<R, Failure> + Sync,
    {
        let missing = self.records.iter().enumerate();
        let missing = missing.filter(|(_, record)| record.is_none());
        let missing: Vec<usize> = missing.map(|(index, _)| index).collect();
        let (folder, units) = (&self.folder, &self.units);
        let cannot_write = AtomicBool::new(false);
        let outcomes: Vec<Outcome<R>> = missing
            .par_iter()
            .with_max_len(1)
            .map(|&index| {
                if interrupt.requested() || cannot_write.load(Ordering::Relaxed) {
                    return Outcome::Stopped;
                }
                let unit = &units[index];
                let (file, build) = (folder.record(unit), folder.build());
                let outcome = done(&file, build, unit, || work(unit, interrupt));
                match &outcome {
                    Outcome::Done(_) | Outcome::Failed(_) => progress(),
                    Outcome::NotWritten(_) => cannot_write.store(true, Ordering::Relaxed),
                    Outcome::Stopped => {}
                }
                outcome
            })
            .collect();
        let mut end = StudyEnd::default();
        let mut not_written = None;
        for (index, outcome) in missing.into_iter().zip(outcomes) {
            match outcome {
                Outcome::Done(record) => {
                    self.records[index] = Some(record);
                    self.builds[index] = Some(self.folder.build());
                }
                Outcome::Failed(reason) => end.failures.push(reason),
                Outcome::Stopped => end.interrupted = true,
                Outcome::NotWritten(error) => not_written = not_written.or(Some(error)),
            }
        }
        not_written.map_or(Ok(end), Err)
    }
}

/// Does a unit and writes its record, which is returned as it is read back: what is made of a record does not
/// depend on when it was written.
fn done<R: Serialize + DeserializeOwned>(
    file: &RecordFile<'_>,
    build: usize,
    unit: &StudyUnit<'_>,
    work: impl FnOnce() -> Result<R, Failure>,
) -> Outcome<R> {
    let failed = |reason: String| {
        let name = unit.label.map_or_else(|| unit.key(), str::to_owned);
        Outcome::Failed(format!("[{name}] {reason}"))
    };
    let record = match work() {
        Ok(record) => record,
        Err(Failure::Interrupted) => return Outcome::Stopped,
        Err(error @ Failure::Output { .. }) => return Outcome::NotWritten(error),
        Err(error) => return failed(error.to_string()),
    };
    match encode(&record) {
        Ok((json, record)) => match file.write(&json, build) {
            Ok(()) => Outcome::Done(record),
            Err(error) => Outcome::NotWritten(error),
        },
        Err(cause) => failed(format!("its result cannot be kept as JSON: {cause}")),
    }
}
