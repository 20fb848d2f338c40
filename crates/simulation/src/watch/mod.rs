//! What a user should know of a run and what it alone can show, found step by step.

mod gate;
mod goals;
mod lasting;

use adslam_planning::Decision;

pub use gate::GateWatch;
use goals::GoalWatch;
use lasting::Lasting;

use crate::StepView;

/// Decisions without a safe action, one after the other up to the last, that are worth a warning.
const COMPROMISED: usize = 10;

/// Watches one run.
#[derive(Clone, Debug, Default)]
pub struct RunWatch {
    has_seen: bool,
    gate: GateWatch,
    goals: GoalWatch,
    decisions: usize,
    compromised: Lasting,
    /// Decisions that waived the limits of roll and pitch, and the step of the first.
    waived: Option<(usize, usize)>,
}

impl RunWatch {
    /// For a robot for which viewpoints count as reached within this distance, cm.
    #[must_use]
    pub fn new(reached_within: f64) -> Self {
        Self {
            has_seen: false,
            gate: GateWatch::default(),
            goals: GoalWatch::new(reached_within),
            decisions: 0,
            compromised: Lasting::default(),
            waived: None,
        }
    }

    /// Looks at a step.
    pub fn step(&mut self, view: &StepView<'_>) {
        self.has_seen |= !view.visible.is_empty();
        if let Some(report) = view.update {
            self.gate.add(view.step as u64, report);
        }
        if let Some((decision, _)) = view.decision {
            let decided_at = view.step - 1;
            self.decide(decided_at, decision);
            self.goals
                .decide(decided_at, decision, &view.belief.state.pose.position);
        }
    }

    fn decide(&mut self, step: usize, decision: &Decision) {
        self.decisions += 1;
        self.compromised
            .add(step as u64, decision.compromised && !decision.limits_waived);
        if decision.limits_waived {
            let (count, _) = self.waived.get_or_insert((0, step));
            *count += 1;
        }
    }

    /// What has been found.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.has_seen {
            warnings.push(
                "the robot saw no feature in the whole run; is the object where it should be? adslam replay \
                 shows it"
                    .to_owned(),
            );
        }
        warnings.extend(self.gate.warning());
        if let Some((count, first)) = self.waived {
            warnings.push(format!(
                "no action kept the limits of roll and pitch, so that they were waived (in {count} of {} decisions, \
                 the first at step {first})",
                self.decisions
            ));
        }
        if let Some((since, count)) = self.compromised.holds().filter(|(_, n)| *n >= COMPROMISED) {
            warnings.push(format!(
                "from some step to the end no action was safe; is the robot shut in, or the clearance too large? \
                 (from step {since} on, {count} decisions)"
            ));
        }
        warnings.extend(self.goals.warnings());
        warnings
    }
}
