//! What criterion measured, read from the files that it leaves.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// One benchmark.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Measured {
    /// The median time of one call.
    pub median_ms: f64,
    /// Operations a second, where the benchmark states its additions and multiplications.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gflops: Option<f64>,
}

/// All benchmarks of a run: by group, variant and case.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    #[serde(flatten)]
    groups: BTreeMap<String, BTreeMap<String, BTreeMap<String, Measured>>>,
    /// The rate of the largest dense matrix product, one thread, 10⁹ operations a second.
    pub matrix_product_gflops: f64,
}

/// Groups whose elements are floating-point operations.
const COUNTING: [&str; 6] = [
    "matrix_product",
    "ekf_step",
    "feature_update",
    "structure_update",
    "local_decision",
    "combined_decision",
];
/// The variants of these that do as many as they state.
const COUNTED: [&str; 2] = ["fast", "fast_two_threads"];

#[derive(Deserialize)]
struct Identity {
    group_id: String,
    function_id: Option<String>,
    value_str: Option<String>,
    throughput: Option<Throughput>,
}

#[derive(Deserialize)]
enum Throughput {
    Elements(u64),
    #[serde(untagged)]
    Other(serde::de::IgnoredAny),
}

#[derive(Deserialize)]
struct Estimates {
    median: Estimate,
}

#[derive(Deserialize)]
struct Estimate {
    /// Nanoseconds.
    point_estimate: f64,
}

impl Report {
    /// All results in criterion's folder.
    ///
    /// # Errors
    /// A file that cannot be read or is not what criterion writes, and a folder without results.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let mut report = Self::default();
        report.collect(folder)?;
        if report.groups.is_empty() {
            return Err(format!(
                "{}: no results of benchmarks; run without --no-run",
                folder.display()
            ));
        }
        let products = report
            .groups
            .get("matrix_product")
            .and_then(|g| g.get("fast"));
        let rates = products.into_iter().flatten().filter_map(|(_, m)| m.gflops);
        report.matrix_product_gflops = rates.fold(0.0, f64::max);
        Ok(report)
    }

    /// One benchmark, if it was run.
    pub fn get(&self, group: &str, variant: &str, case: &str) -> Option<Measured> {
        self.groups.get(group)?.get(variant)?.get(case).copied()
    }

    fn collect(&mut self, folder: &Path) -> Result<(), String> {
        let failed = |error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if !path.is_dir() {
                continue;
            }
            if path.file_name().is_some_and(|name| name == "new") {
                self.add(&path)?;
            } else {
                self.collect(&path)?;
            }
        }
        Ok(())
    }

    fn add(&mut self, folder: &Path) -> Result<(), String> {
        let identity: Identity = read_json(&folder.join("benchmark.json"))?;
        let estimates: Estimates = read_json(&folder.join("estimates.json"))?;
        let (Some(variant), Some(case)) = (identity.function_id, identity.value_str) else {
            return Ok(());
        };
        let nanoseconds = estimates.median.point_estimate;
        let group = identity.group_id;
        let counts = COUNTING.contains(&group.as_str()) && COUNTED.contains(&variant.as_str());
        let gflops = match identity.throughput {
            Some(Throughput::Elements(operations)) if counts => {
                Some(operations as f64 / nanoseconds)
            }
            _ => None,
        };
        let measured = Measured {
            median_ms: nanoseconds * 1e-6,
            gflops,
        };
        let variants = self.groups.entry(group).or_default();
        variants.entry(variant).or_default().insert(case, measured);
        Ok(())
    }
}

fn read_json<T: for<'de> Deserialize<'de>>(path: &Path) -> Result<T, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}
