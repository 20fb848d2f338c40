//! Who watches a run.

use adslam_diagnostics::Failure;
use adslam_simulation::StepView;

/// Watches a run: writes it down, draws it, or stops it with an error.
pub trait Observer {
    /// Called after every step, the start included.
    ///
    /// # Errors
    /// Whatever the observer cannot go on with; it ends the run.
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure>;
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn step(&mut self, _: &StepView<'_>) -> Result<(), Failure> {
        Ok(())
    }
}
