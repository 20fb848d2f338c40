//! What the runs of one point say: a mean for each planner, and every pair of planners compared.

use serde_json::{Map, Value};

use crate::statistics::{MeanEstimate, PairedComparison, holm};

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
    pub(super) paired: PairedComparison,
    /// Its p-value, corrected for the pairs of the same metric at the same point.
    pub(super) p_holm: f64,
}

impl PointStatistics {
    /// Of the runs of each planner, for each metric.
    pub(super) fn of(planners: &[PlannerMetrics], metrics: &[String]) -> Self {
        let values: Vec<Vec<Vec<Option<f64>>>> = metrics
            .iter()
            .map(|metric| planners.iter().map(|runs| values(runs, metric)).collect())
            .collect();
        let statistics = planners.iter().enumerate().map(|(planner, runs)| {
            let means = values.iter().map(|of_metric| {
                let known: Vec<f64> = of_metric[planner].iter().copied().flatten().collect();
                MeanEstimate::of(&known)
            });
            PlannerStatistics {
                done: runs.iter().flatten().count(),
                means: means.collect(),
            }
        });
        Self {
            planners: statistics.collect(),
            comparisons: values.iter().map(|values| compare(values)).collect(),
        }
    }
}

fn values(runs: &PlannerMetrics, metric: &str) -> Vec<Option<f64>> {
    let value = |run: &Option<Map<String, Value>>| run.as_ref()?.get(metric)?.as_f64();
    runs.iter().map(value).collect()
}

/// Compares every pair of planners, whose values stand seed by seed.
fn compare(values: &[Vec<Option<f64>>]) -> Vec<Comparison> {
    let seconds = |first| (first + 1..values.len()).map(move |second| (first, second));
    let pairs: Vec<(usize, usize)> = (0..values.len()).flat_map(seconds).collect();
    let compared: Vec<Option<PairedComparison>> = pairs
        .iter()
        .map(|&(first, second)| {
            let both = values[first].iter().zip(&values[second]);
            let differences: Vec<f64> = both.filter_map(|(a, b)| Some((*a)? - (*b)?)).collect();
            PairedComparison::of(&differences)
        })
        .collect();
    let tested: Vec<f64> = compared.iter().flatten().map(|paired| paired.p).collect();
    let mut corrected = holm(&tested).into_iter();
    let results = compared.into_iter().map(|paired| {
        let paired = paired?;
        let p_holm = corrected.next()?;
        Some(ComparisonResult { paired, p_holm })
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
