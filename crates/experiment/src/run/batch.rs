//! Many runs in parallel.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::{HistoryRecorder, NoObserver, RunOutcome, Setup, simulate};
use crate::ExperimentError;
use crate::scenario::PlannerName;

/// A wish to stop, which long work looks at between steps.
#[derive(Debug, Default)]
pub struct Interrupt(AtomicBool);

impl Interrupt {
    /// No such wish.
    #[must_use]
    pub const fn new() -> Self {
        Self(AtomicBool::new(false))
    }

    /// Asks to stop. May be called from a signal handler's thread.
    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether someone asked.
    #[must_use]
    pub fn requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// One run to do.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// Where.
    pub setup: &'a Setup,
    /// By which planner.
    pub planner: PlannerName,
    /// With which noise.
    pub seed: u64,
    /// Whether its history is kept: a few megabytes for each run.
    pub record: bool,
}

/// What became of it.
pub type BatchResult = Result<RunOutcome, ExperimentError>;

/// Called when a run has finished, from any thread.
pub type Progress<'a> = &'a (dyn Fn() + Sync);

impl Batch<'_> {
    /// Does all runs, in parallel on rayon's threads, and returns the results in the order of the
    /// list. Each depends on its own seed only, so the number of threads changes nothing but the time.
    #[must_use]
    pub fn run_all(
        batch: &[Batch<'_>],
        interrupt: &Interrupt,
        progress: Progress<'_>,
    ) -> Vec<BatchResult> {
        batch
            .par_iter()
            .map(|run| {
                // Even to begin a run, with its viewpoints, takes time.
                if interrupt.requested() {
                    return Err(ExperimentError::Interrupted);
                }
                let result = run.run(interrupt);
                progress();
                result
            })
            .collect()
    }

    fn run(&self, interrupt: &Interrupt) -> BatchResult {
        if !self.record {
            return simulate(
                self.setup,
                self.planner,
                self.seed,
                interrupt,
                &mut NoObserver,
            );
        }
        let mut recorder = HistoryRecorder::new(self.setup, self.planner, self.seed);
        let outcome = simulate(
            self.setup,
            self.planner,
            self.seed,
            interrupt,
            &mut recorder,
        )?;
        Ok(RunOutcome {
            history: Some(recorder.into_history()),
            ..outcome
        })
    }
}
