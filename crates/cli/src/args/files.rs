//! The arguments of the commands about files.

use std::path::PathBuf;

use adslam_names::LengthUnit;
use adslam_scenario::FileKind;
use adslam_scenario::values::{NonNegative, ValueError};
use clap::builder::RangedU64ValueParser;
use clap::{Args, Subcommand, ValueEnum};

use crate::named::NameParser;

/// `adslam check`
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// Scenario, configuration, sweep and published-table files
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `adslam new`
#[derive(Debug, Subcommand)]
pub enum NewFile {
    /// A scenario: what the world is
    #[command(after_help = "Example:\n  adslam new scenario --out scenarios/mine.toml")]
    Scenario(NewArgs),
    /// A configuration: which planners run in which scenarios, and how often
    #[command(
        after_help = "Example:\n  adslam new config --scenario scenarios/mine.toml --out configs/mine.toml"
    )]
    Config {
        /// Where, and how to answer
        #[command(flatten)]
        args: NewArgs,
        /// The scenario to run; where not given, the scenario.toml beside the configuration
        #[arg(long, value_name = "FILE")]
        scenario: Option<PathBuf>,
    },
    /// A sweep: which keys of a scenario are varied, over which values
    #[command(
        after_help = "Example:\n  adslam new sweep --scenario scenarios/mine.toml --out sweeps/mine.toml"
    )]
    Sweep {
        /// Where, and how to answer
        #[command(flatten)]
        args: NewArgs,
        /// The scenario to vary; where not given, the scenario.toml beside the sweep
        #[arg(long, value_name = "FILE")]
        scenario: Option<PathBuf>,
    },
}

/// `adslam new scenario`, and what the others have in common with it
#[derive(Debug, Args)]
pub struct NewArgs {
    /// The file to write; where not given, scenario.toml, config.toml or sweep.toml
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace what is there
    #[arg(long)]
    pub force: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// The kinds of files that have a schema.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum SchemaKind {
    /// What the world is
    Scenario,
    /// What is run
    Config,
    /// Published results to compare with
    Published,
    /// What is varied
    Sweep,
}

impl From<SchemaKind> for FileKind {
    fn from(kind: SchemaKind) -> Self {
        match kind {
            SchemaKind::Scenario => Self::Scenario,
            SchemaKind::Config => Self::Configuration,
            SchemaKind::Published => Self::Published,
            SchemaKind::Sweep => Self::Sweep,
        }
    }
}

/// `adslam mesh`
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The mesh file
    pub file: PathBuf,
    /// The unit of its coordinates
    #[arg(long, default_value_t, value_name = "UNIT", value_parser = NameParser::<LengthUnit>::new())]
    pub unit: LengthUnit,
    /// Join vertices that lie within this distance of each other, in cm; 0 joins equal ones only
    #[arg(long, default_value = "0", value_name = "CM", value_parser = distance)]
    pub join_within: NonNegative,
    /// Features that a scenario would pick from it
    #[arg(
        long,
        default_value_t = 50,
        value_name = "N",
        value_parser = RangedU64ValueParser::<usize>::new().range(4..=2000)
    )]
    pub features: usize,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

fn distance(given: &str) -> Result<NonNegative, ValueError> {
    // What is no number is answered like one that is out of range.
    NonNegative::new(given.parse().unwrap_or(f64::NAN))
}
