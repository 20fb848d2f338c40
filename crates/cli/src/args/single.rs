//! The arguments of the commands about one run or one log.

use std::path::PathBuf;

use adslam_agent::GateProbability;
use adslam_names::{EstimatorName, LengthUnit, PlannerName};
use adslam_record::TumFile;
use adslam_record::log::GateChoice;
use adslam_scenario::values::{self, ValueError};
use clap::{Args, ValueEnum};

use crate::named::{NameParser, RegistryParser};

/// `adslam run`
#[derive(Debug, Args)]
pub struct RunArgs {
    /// The scenario file: what the world is
    pub scenario: PathBuf,
    /// The planner
    #[arg(long, value_name = "NAME", value_parser = RegistryParser::<PlannerName>::default())]
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
    /// Write log.jsonl too: what the filter was given and the truth, for adslam filter
    #[arg(long)]
    pub log: bool,
    /// Unit of the positions in truth.tum and estimate.tum: mm, cm or m; evo expects m
    #[arg(
        long,
        default_value_t = TumFile::USUAL_UNIT,
        value_name = "UNIT",
        value_parser = NameParser::<LengthUnit>::new()
    )]
    pub unit: LengthUnit,
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
    /// The log, packed with gzip or not; - for the standard input
    pub log: PathBuf,
    /// The file of estimates to write; - for the standard output
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Write the estimated trajectory too, in the TUM format of the evo tools
    #[arg(long, value_name = "FILE")]
    pub tum: Option<PathBuf>,
    /// Unit of the positions in that trajectory: mm, cm or m; evo expects m
    #[arg(
        long,
        requires = "tum",
        default_value_t = TumFile::USUAL_UNIT,
        value_name = "UNIT",
        value_parser = NameParser::<LengthUnit>::new()
    )]
    pub unit: LengthUnit,
    /// The estimator: euler_ekf, so3_ekf or right_invariant_ekf; where not given, the log's, or else euler_ekf
    #[arg(long, value_name = "NAME", value_parser = RegistryParser::<EstimatorName>::default())]
    pub estimator: Option<EstimatorName>,
    /// Keep out feature measurements less likely than this: the part of good ones that pass, such as 0.999,
    /// or none to keep all; where not given, as the log says, or else none
    #[arg(long, value_name = "PROBABILITY", value_parser = gate)]
    pub gate: Option<GateChoice>,
    /// At a line that cannot be used, keep the estimates up to the line before
    #[arg(long)]
    pub keep_complete: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

fn gate(given: &str) -> Result<GateChoice, ValueError> {
    if given == "none" {
        return Ok(GateChoice::All);
    }
    // What is no number is answered like one that is out of range.
    let checked = values::GateProbability::new(given.parse().unwrap_or(f64::NAN))?;
    Ok(GateProbability::new(*checked).map_or(GateChoice::All, GateChoice::Probability))
}
