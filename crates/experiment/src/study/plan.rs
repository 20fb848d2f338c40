//! What a study does.

use adslam_names::PlannerName;
use adslam_setup::Setup;

/// A point of a study: where, and by which planners.
#[derive(Clone, Copy, Debug)]
pub struct StudyPoint<'a> {
    /// Where. All that its runs depend on is its scenario, every key with the value that holds, and its object.
    pub setup: &'a Setup,
    /// By which planners, each once.
    pub planners: &'a [PlannerName],
    /// What failures are told by, if not by the name of the record.
    pub label: Option<&'a str>,
}

/// One run of a study.
#[derive(Clone, Copy, Debug)]
pub struct StudyUnit<'a> {
    /// Its point, from 0, in the order of the plan.
    pub point: usize,
    /// The number of its point in the study's folder, from 1: points keep theirs when others are added.
    pub number: usize,
    /// Where.
    pub setup: &'a Setup,
    /// By which planner.
    pub planner: PlannerName,
    /// With which noise.
    pub seed: u64,
    /// That of its point.
    pub label: Option<&'a str>,
}

impl StudyUnit<'_> {
    /// What its record is called: the number of its point, planner and seed, such as `0007-combined-seed3`.
    #[must_use]
    pub fn key(&self) -> String {
        format!("{:04}-{}-seed{}", self.number, self.planner, self.seed)
    }
}

/// What a study does: every planner of every point at the same seeds.
#[derive(Clone, Debug)]
pub struct StudyPlan<'a> {
    /// What kind of study it is, in a word, such as "sweep".
    pub kind: &'static str,
    /// The points.
    pub points: Vec<StudyPoint<'a>>,
    /// The seed of the first run of each planner at each point.
    pub first_seed: u64,
    /// How many runs that are, their seeds counted up from the first.
    pub runs: usize,
}

impl<'a> StudyPlan<'a> {
    /// The runs: point by point, planner by planner, seed by seed, for points that have these numbers.
    pub(crate) fn units(&self, numbers: &[usize]) -> Vec<StudyUnit<'a>> {
        let points = self.points.iter().zip(numbers).enumerate();
        let units = points.flat_map(|(point, (at, &number))| {
            at.planners.iter().flat_map(move |&planner| {
                (0..self.runs as u64).map(move |run| StudyUnit {
                    point,
                    number,
                    setup: at.setup,
                    planner,
                    seed: self.first_seed.wrapping_add(run),
                    label: at.label,
                })
            })
        });
        units.collect()
    }
}
