//! The arguments of the commands about many runs.

use std::path::{Path, PathBuf};

use adslam_names::EstimatorName;
use adslam_scenario::config::Selection;
use clap::Args;

use crate::named::RegistryParser;

/// `adslam tables`
#[derive(Debug, Args)]
pub struct TablesArgs {
    /// The configuration file: what is run
    pub config: PathBuf,
    /// What of it is run
    #[command(flatten)]
    pub selection: SelectionArgs,
    /// The folder to write to, and to go on in; made if it does not exist. Where not given, results/NAME for the
    /// configuration NAME.toml
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Go on with runs that another build of adslam did, and say so in the tables
    #[arg(long)]
    pub accept_build: bool,
    /// Write report.html too, a page with figures to open in a browser, and replays beside it
    #[arg(long)]
    pub html: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

impl TablesArgs {
    /// The folder to write to.
    #[must_use]
    pub fn folder(&self) -> PathBuf {
        let named = || Path::new("results").join(self.config.file_stem().unwrap_or_default());
        self.out.clone().unwrap_or_else(named)
    }
}

/// `adslam sweep`
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// The sweep file: what is varied
    pub sweep: PathBuf,
    /// Runs of each planner at each point; as the sweep says where not given
    #[arg(long, value_name = "N")]
    pub runs: Option<usize>,
    /// The folder to write to, and to go on in; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Go on with runs that another build of adslam did, and say so in the tables
    #[arg(long)]
    pub accept_build: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// What of a configuration is run
#[derive(Debug, Args)]
pub struct SelectionArgs {
    /// Runs of each planner; as the configuration says where not given
    #[arg(long, value_name = "N")]
    pub runs: Option<usize>,
    /// Only this experiment of the configuration; may be given again
    #[arg(long, value_name = "LABEL")]
    pub only: Vec<String>,
    /// An STL, OBJ or PLY file to take for the object of every experiment with a mesh or a phantom
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
}

impl SelectionArgs {
    /// As the library takes it.
    #[must_use]
    pub fn selection(&self) -> Selection {
        Selection {
            runs: self.runs,
            only: self.only.clone(),
            mesh: self.mesh.clone(),
        }
    }
}

/// `adslam consistency`
#[derive(Debug, Args)]
pub struct ConsistencyArgs {
    /// The configuration file: what is run
    pub config: PathBuf,
    /// What of it is run
    #[command(flatten)]
    pub selection: SelectionArgs,
    /// Only this estimator: euler_ekf, so3_ekf or right_invariant_ekf; may be given again. All where not given
    #[arg(long = "estimator", value_name = "NAME", value_parser = RegistryParser::<EstimatorName>::default())]
    pub estimators: Vec<EstimatorName>,
    /// The folder to write to, and to go on in; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Go on with runs that another build of adslam did, and say so in the tables
    #[arg(long)]
    pub accept_build: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}
