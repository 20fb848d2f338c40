//! The objective of eqs. (6), (7) over candidates: what would be seen, and what it would leave.

use adslam_estimator::{FilterNoise, PosteriorTrace, SetId};
use adslam_models::FeatureId;

use crate::{Candidate, PlanningError, Score, Situation, VisibleSets, ties};

/// What a planner assumes otherwise than the filter does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanningNoise {
    /// Sigma of a feature measurement, cm; the filter's where absent.
    pub feature_measurement_sigma: Option<f64>,
}

impl PlanningNoise {
    /// The filter's noise with what is set here in its place.
    #[must_use]
    pub fn over(&self, filter: &FilterNoise) -> FilterNoise {
        let sigma = self
            .feature_measurement_sigma
            .unwrap_or(filter.feature_measurement_sigma);
        FilterNoise {
            feature_measurement_sigma: sigma,
            ..*filter
        }
    }
}

/// Scores the candidates of one decision after another; reuses its allocation between them.
#[derive(Clone, Debug, Default)]
pub struct ActionScorer {
    noise: PlanningNoise,
    objective: PosteriorTrace,
    ids: Vec<FeatureId>,
    /// The sets computed so far: where in `sets` each stands, and where in the objective.
    computed: Vec<(usize, SetId)>,
    scores: Vec<Score>,
    /// Traces computed, the bounds included.
    traces: usize,
}

/// Traces nearer to each other than this, relatively, count as equal: mirror images of an action are
/// exactly as good, and rounding must not decide between them.
pub const TRACE_TOLERANCE: f64 = ties::TOLERANCE;

/// A candidate is passed over only if even with more to see it would be worse by more than any
/// rounding.
const MARGIN: f64 = 1.0 + 100.0 * TRACE_TOLERANCE;

impl ActionScorer {
    /// A scorer that assumes this noise.
    #[must_use]
    pub fn new(noise: PlanningNoise) -> Self {
        Self {
            noise,
            ..Self::default()
        }
    }

    /// The actions scored for the last decision, in the order of scoring.
    #[must_use]
    pub fn scores(&self) -> &[Score] {
        &self.scores
    }

    /// Additions and multiplications of the last decision, see [`PosteriorTrace::operations`].
    #[must_use]
    pub fn operations(&self) -> usize {
        self.objective.operations(self.traces)
    }

    /// The score of the candidate with the smallest trace, the first in the action set among equals;
    /// `None` if there are no candidates. `sets` says what each of them sees.
    ///
    /// Candidates are scored in groups that see the same, those that see most first. One that is
    /// sure to be worse than the best so far is passed over: measuring more never raises the
    /// trace, so a set that contains its own gives a lower bound.
    ///
    /// # Errors
    /// Sets of other candidates, or a belief that has broken down.
    pub fn best(
        &mut self,
        situation: &Situation<'_>,
        candidates: &[Candidate],
        sets: &VisibleSets,
    ) -> Result<Option<Score>, PlanningError> {
        self.score(situation, candidates, sets, true)?;
        Ok(first_of_the_best(&self.scores))
    }

    /// The score of every candidate, or of those that the time for the decision was enough for, in the order of the
    /// action set. `sets` says what each of them sees.
    ///
    /// # Errors
    /// As [`ActionScorer::best`].
    pub fn all(
        &mut self,
        situation: &Situation<'_>,
        candidates: &[Candidate],
        sets: &VisibleSets,
    ) -> Result<&[Score], PlanningError> {
        self.score(situation, candidates, sets, false)?;
        self.scores
            .sort_unstable_by_key(|score| ties::order(score.index));
        Ok(&self.scores)
    }

    /// Scores the candidates, all of them or those that may be the best.
    fn score(
        &mut self,
        situation: &Situation<'_>,
        candidates: &[Candidate],
        sets: &VisibleSets,
        passes_over: bool,
    ) -> Result<(), PlanningError> {
        if sets.count() != candidates.len() {
            return Err(PlanningError::SetsOfOtherCandidates {
                sets: sets.count(),
                candidates: candidates.len(),
            });
        }
        let model = situation.model;
        sets.union(&mut self.ids);
        self.objective.prepare(
            situation.belief,
            situation.feature_motion,
            &self.noise.over(&model.noise),
            model.measures_structure,
            &self.ids,
        )?;
        self.scores.clear();
        self.traces = 0;
        self.computed.clear();
        let mut smallest = f64::INFINITY;
        for group in sets.groups() {
            let set = sets.set(group[0]);
            // The latest is the smallest of those that contain this one.
            let wider = self
                .computed
                .iter()
                .rev()
                .find(|(other, _)| VisibleSets::contains(sets.set(*other), set))
                .map(|(_, id)| *id);
            let mut entered = None;
            for &place in group {
                if !self.scores.is_empty() && situation.is_late() {
                    return Ok(());
                }
                let Candidate {
                    index,
                    control,
                    pose,
                } = candidates[place];
                if let Some(wider) = wider.filter(|_| passes_over) {
                    self.traces += 1;
                    if self.objective.after(&control, wider)? > smallest * MARGIN {
                        continue;
                    }
                }
                let set = match entered {
                    Some(set) => set,
                    None => {
                        VisibleSets::features(set, &mut self.ids);
                        let added = self.objective.add_set(&self.ids)?;
                        self.computed.push((group[0], added));
                        *entered.insert(added)
                    }
                };
                self.traces += 1;
                let trace = self.objective.after(&control, set)?;
                self.scores.push(Score { index, pose, trace });
                smallest = smallest.min(trace);
            }
        }
        Ok(())
    }
}

/// Of the scores that are equal to the smallest the first in the action set.
fn first_of_the_best(scores: &[Score]) -> Option<Score> {
    let smallest = scores.iter().map(|score| score.trace).reduce(f64::min)?;
    let limit = smallest * (1.0 + TRACE_TOLERANCE);
    scores
        .iter()
        .filter(|score| score.trace <= limit)
        .min_by_key(|score| ties::order(score.index))
        .copied()
}
