//! Many runs in parallel.

use adslam_diagnostics::{Failure, Interrupt};
use adslam_names::PlannerName;
use adslam_record::{HistoryRecorder, NoObserver};
use adslam_setup::Setup;
use rayon::prelude::*;

use super::{RunOutcome, simulate};

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
pub type BatchResult = Result<RunOutcome, Failure>;

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
                    return Err(Failure::Interrupted);
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
        let mut recorder = HistoryRecorder::new(&self.setup.model, self.planner, self.seed)
            .with_look(self.setup.scenario.registry().look(self.planner));
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
