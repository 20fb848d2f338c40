//! Whole runs written down while they are done.

use std::fmt::Write as _;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_models::{Control, Pose};
use adslam_names::PlannerName;
use adslam_record::Observer;
use adslam_setup::Setup;
use adslam_simulation::StepView;

use super::GoldenRun;

impl GoldenRun {
    /// Does a run and writes it down.
    pub(super) fn record(
        setup: &Setup,
        planner: PlannerName,
        seed: u64,
        interrupt: &Interrupt,
    ) -> Result<Self, Failure> {
        let mut recorder = Recorder {
            controls: setup.model.planning.actions.controls(),
            pose: String::new(),
            lines: Vec::new(),
        };
        simulate(setup, planner, seed, interrupt, &mut recorder)?;
        let mut lines = recorder.lines;
        lines.push(recorder.pose);
        Ok(Self {
            name: format!("{}, {planner}, seed {seed}", setup.name()),
            lines,
        })
    }
}

/// Writes a run down.
struct Recorder<'a> {
    controls: &'a [Control],
    /// The line of the present step as far as it is known.
    pose: String,
    lines: Vec<String>,
}

impl Observer for Recorder<'_> {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        let mut line = std::mem::replace(
            &mut self.pose,
            pose_line(view.step, &view.belief.state.pose),
        );
        match view.decision {
            None => {
                for (i, p) in view.viewpoints.iter().enumerate() {
                    let place = numbers(&[p.x, p.y, p.z]);
                    self.lines.push(format!("viewpoint {i} {place}"));
                }
            }
            Some((decision, _)) => {
                let taken = |control: &Control| *control == decision.control;
                let action = match self.controls.iter().position(taken) {
                    Some(place) => place.to_string(),
                    None => control_text(&decision.control),
                };
                let goal = decision
                    .goal
                    .map_or("-".to_owned(), |(goal, _)| goal.to_string());
                let trace = decision
                    .predicted_trace
                    .map_or("-".to_owned(), |trace| format!("{trace:.6}"));
                let (admissible, safe, scored) =
                    (decision.admissible, decision.safe, decision.scored);
                // Writing to a string does not fail.
                let _ = write!(
                    line,
                    "  {action:>3} {goal:>2} {admissible:>3} {safe:>3} {scored:>3} {trace}"
                );
                self.lines.push(line);
            }
        }
        Ok(())
    }
}

fn pose_line(step: usize, pose: &Pose) -> String {
    let pose: [f64; 6] = pose.to_vector().into();
    format!("{step:>4} {}", numbers(&pose))
}

fn control_text(control: &Control) -> String {
    let (r, t) = (&control.rotation, &control.translation);
    let parts = [r.x, r.y, r.z, t.x, t.y, t.z].map(|x| format!("{x:.4}"));
    parts.join(",")
}

fn numbers(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|x| format!("{x:>10.6}")).collect();
    texts.join(" ")
}
