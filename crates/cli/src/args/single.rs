//! The arguments of the commands about one run or one log.

use std::path::PathBuf;

use adslam_experiment::scenario::values::{GateProbability, ValueError};
use adslam_experiment::scenario::{EstimatorName, PlannerName};
use clap::{Args, ValueEnum};

use crate::named::NameParser;

/// `adslam run`
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The scenario file: what the world is
    pub scenario: PathBuf,
    /// The planner
    #[arg(long, value_name = "NAME", value_parser = NameParser::<PlannerName>::new())]
    pub planner: PlannerName,
    /// Seed of all noise; every planner meets the same noise at the same seed
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub seed: u64,
    /// The folder to write to; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// An STL, OBJ or PLY file to take for the object in place of the scenario's
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Write replay.html too, a page to open in a browser
    #[arg(long)]
    pub html: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `adslam replay`
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// Folders of one or two runs
    #[arg(required = true, num_args = 1..=2, value_name = "RUN_DIR")]
    pub runs: Vec<PathBuf>,
    /// The page to write
    #[arg(long, default_value = "replay.html", value_name = "FILE")]
    pub out: PathBuf,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `adslam export`
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// The folder of the run
    #[arg(value_name = "RUN_DIR")]
    pub run: PathBuf,
    /// What to write
    #[arg(long)]
    pub format: ExportFormat,
    /// The file to write, or for PLY the folder; made if it does not exist
    #[arg(long, value_name = "PATH")]
    pub out: PathBuf,
    /// Time between two steps, in seconds; only MCAP has times
    #[arg(long, default_value_t = 0.1, value_name = "SECONDS")]
    pub period: f64,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// A format of other tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ExportFormat {
    /// One file for Foxglove: frames, poses, features, surface, ellipsoids and curves
    Mcap,
    /// Two files a step: the surface, and the features
    Ply,
    /// One table: truth, estimate and sigma of every component of the state at each step
    Csv,
}

/// `adslam filter`
#[derive(Debug, Args)]
pub struct FilterArgs {
    /// The log
    pub log: PathBuf,
    /// The file of estimates to write
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// The estimator: euler_ekf, so3_ekf or right_invariant_ekf
    #[arg(long, value_name = "NAME", default_value_t, value_parser = NameParser::<EstimatorName>::new())]
    pub estimator: EstimatorName,
    /// Keep out feature measurements less likely than this: the part of good ones that pass, such as 0.999
    #[arg(long, value_name = "PROBABILITY", value_parser = probability)]
    pub gate: Option<GateProbability>,
    /// At a line that cannot be used, keep the estimates up to the line before
    #[arg(long)]
    pub keep_complete: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

fn probability(given: &str) -> Result<GateProbability, ValueError> {
    // What is no number is answered like one that is out of range.
    GateProbability::new(given.parse().unwrap_or(f64::NAN))
}
