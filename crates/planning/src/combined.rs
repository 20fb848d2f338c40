//! The combined planner, Section III-D.

use nalgebra::Point3;

use crate::trace_choice::TraceChoice;
use crate::{Decision, Goals, Planner, PlanningError, PlanningNoise, Score, Situation};

/// nᵤ, how many of the safe actions nearest to the goal are scored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nearest {
    /// This many; 1 gives the global planner, the size of the action set the local one.
    Count(usize),
    /// This share of the safe actions, rounded down, at least one.
    Fraction(f64),
}

impl Nearest {
    /// nᵤ for a number of safe actions.
    #[must_use]
    pub fn of(self, safe: usize) -> usize {
        let wanted = match self {
            Self::Count(count) => count,
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a share of a count; a cast saturates"
            )]
            Self::Fraction(fraction) => {
                let share = fraction * safe as f64;
                let whole = share.round();
                // A decimal fraction and the product are rounded once each: 0.29 of 100 is 29.
                let is_whole = (share - whole).abs() <= whole * f64::EPSILON;
                (if is_whole { whole } else { share.floor() }) as usize
            }
        };
        wanted.clamp(1, safe.max(1))
    }
}

/// Takes, of the safe actions nearest to the current viewpoint, the one with the smallest trace.
#[derive(Clone, Debug)]
pub struct CombinedPlanner {
    goals: Goals,
    nearest: Nearest,
    choice: TraceChoice,
}

impl CombinedPlanner {
    /// A planner that visits these viewpoints and scores the `nearest` actions.
    #[must_use]
    pub fn new(goals: Goals, nearest: Nearest, noise: PlanningNoise) -> Self {
        Self {
            goals,
            nearest,
            choice: TraceChoice::new(noise),
        }
    }
}

impl Planner for CombinedPlanner {
    fn decide(&mut self, situation: &Situation<'_>) -> Result<Decision, PlanningError> {
        let goal = self.goals.next_from(&situation.belief.state.pose.position);
        let decision = self.choice.decide(situation, |safe| {
            let count = self.nearest.of(safe.candidates().len());
            safe.keep_nearest(&goal.1, count);
        })?;
        Ok(Decision {
            goal: Some(goal),
            abandoned: self.goals.abandoned(),
            ..decision
        })
    }

    fn scores(&self) -> &[Score] {
        self.choice.scores()
    }

    fn viewpoints(&self) -> &[Point3<f64>] {
        self.goals.viewpoints()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_fractions_mean_what_they_say() {
        for (digits, parts) in [(1, 10), (2, 100), (3, 1000)] {
            for k in 1..=parts {
                let fraction: f64 = format!("{k}e-{digits}").parse().unwrap();
                for safe in 1..700 {
                    let expected = (k * safe / parts).max(1);
                    let nearest = Nearest::Fraction(fraction).of(safe);
                    assert_eq!(nearest, expected, "{fraction} of {safe}");
                }
            }
        }
    }

    #[test]
    fn shares_are_rounded_down_to_at_least_one() {
        assert_eq!(Nearest::Fraction(0.1).of(258), 25);
        assert_eq!(Nearest::Fraction(0.1).of(5), 1);
        assert_eq!(Nearest::Fraction(1.0).of(258), 258);
        assert_eq!(
            Nearest::Fraction(0.29).of(100),
            29,
            "29 hundredths, not 28.999…"
        );
        assert_eq!(Nearest::Count(1).of(258), 1);
        assert_eq!(Nearest::Count(675).of(258), 258);
    }
}
