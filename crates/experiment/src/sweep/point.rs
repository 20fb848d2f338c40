//! What the runs of one point say: a mean for each planner, and every pair of planners compared.

use adslam_statistics::{MeanEstimate, PairedComparison, RankComparison, holm, interval_of_share};
use serde_json::{Map, Value};

use super::metrics::{SEES_ALL, STEPS_TO_SEE_ALL};

/// The metrics of a planner's runs at one point, seed by seed; none where the run has not been done.
pub(super) type PlannerMetrics = Vec<Option<Map<String, Value>>>;

/// The results of one point.
pub(super) struct PointStatistics {
    /// For each planner.
    pub(super) planners: Vec<PlannerStatistics>,
    /// For each metric, every pair of planners.
    pub(super) comparisons: Vec<Vec<Comparison>>,
}

/// The results of one planner at one point.
pub(super) struct PlannerStatistics {
    /// Runs that were done.
    pub(super) done: usize,
    /// For each metric; none where no run has a value.
    pub(super) means: Vec<Option<MeanEstimate>>,
}

/// Two planners at the same seeds.
pub(super) struct Comparison {
    /// The number of the planner that is subtracted from.
    pub(super) first: usize,
    /// The number of the planner that is subtracted.
    pub(super) second: usize,
    /// None where no seed has a value of both.
    pub(super) result: Option<ComparisonResult>,
}

/// The outcome of the paired test.
pub(super) struct ComparisonResult {
    pub(super) tested: Tested,
    /// Its p-value, corrected for the pairs of the same metric at the same point.
    pub(super) p_holm: f64,
}

/// What was tested at the same seeds.
pub(super) struct Tested {
    /// Who has the smaller value, and how often; never is larger than any value.
    pub(super) ranks: RankComparison,
    /// The difference where both have a value; none where that is so at no seed.
    pub(super) difference: Option<MeanEstimate>,
    /// The p-value: of ranks where some runs never get there, of differences else.
    pub(super) p: f64,
}

impl PointStatistics {
    /// Of the runs of each planner, for each metric.
    pub(super) fn of(planners: &[PlannerMetrics], metrics: &[String]) -> Self {
        let values: Vec<Vec<Vec<Option<f64>>>> = metrics
            .iter()
            .map(|metric| planners.iter().map(|runs| values(runs, metric)).collect())
            .collect();
        let statistics = planners.iter().enumerate().map(|(planner, runs)| {
            let means = values.iter().zip(metrics).map(|(of_metric, metric)| {
                let known: Vec<f64> = of_metric[planner].iter().copied().flatten().collect();
                let mut estimate = MeanEstimate::of(&known)?;
                if metric == SEES_ALL {
                    let some = known.iter().filter(|sees_all| **sees_all > 0.0).count();
                    estimate.interval = interval_of_share(some, known.len());
                }
                Some(estimate)
            });
            PlannerStatistics {
                done: runs.iter().flatten().count(),
                means: means.collect(),
            }
        });
        Self {
            planners: statistics.collect(),
            comparisons: values
                .iter()
                .zip(metrics)
                .map(|(values, metric)| {
                    let all_count = metric == STEPS_TO_SEE_ALL;
                    compare(planners, values, all_count)
                })
                .collect(),
        }
    }
}

fn values(runs: &PlannerMetrics, metric: &str) -> Vec<Option<f64>> {
    let value = |run: &Option<Map<String, Value>>| run.as_ref()?.get(metric)?.as_f64();
    runs.iter().map(value).collect()
}

/// Compares every pair of planners, whose values stand seed by seed. Where `never_is_last`, a run without a value is
/// one that never gets there; else its pair is left out.
fn compare(
    planners: &[PlannerMetrics],
    values: &[Vec<Option<f64>>],
    never_is_last: bool,
) -> Vec<Comparison> {
    let seconds = |first| (first + 1..values.len()).map(move |second| (first, second));
    let pairs: Vec<(usize, usize)> = (0..values.len()).flat_map(seconds).collect();
    let compared: Vec<Option<Tested>> = pairs
        .iter()
        .map(|&(first, second)| {
            let done = planners[first].iter().zip(&planners[second]);
            let both = values[first].iter().zip(&values[second]);
            let of_done = both
                .zip(done)
                .filter(|(_, (a, b))| a.is_some() && b.is_some());
            let counting: Vec<(Option<f64>, Option<f64>)> = of_done
                .map(|((a, b), _)| (*a, *b))
                .filter(|(a, b)| never_is_last || (a.is_some() && b.is_some()))
                .collect();
            tested(&counting, never_is_last)
        })
        .collect();
    let tested: Vec<f64> = compared.iter().flatten().map(|tested| tested.p).collect();
    let mut corrected = holm(&tested).into_iter();
    let results = compared.into_iter().map(|tested| {
        let tested = tested?;
        let p_holm = corrected.next()?;
        Some(ComparisonResult { tested, p_holm })
    });
    pairs
        .iter()
        .zip(results)
        .map(|(&(first, second), result)| Comparison {
            first,
            second,
            result,
        })
        .collect()
}

fn tested(pairs: &[(Option<f64>, Option<f64>)], never_is_last: bool) -> Option<Tested> {
    let ranks = RankComparison::of(pairs)?;
    let differences: Vec<f64> = pairs
        .iter()
        .filter_map(|(a, b)| Some((*a)? - (*b)?))
        .collect();
    let paired = PairedComparison::of(&differences);
    Some(Tested {
        ranks,
        difference: paired.map(|paired| paired.difference),
        p: match paired {
            Some(paired) if !never_is_last => paired.p,
            _ => ranks.p,
        },
    })
}
