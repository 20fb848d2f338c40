//! The arguments of each subcommand.

use std::path::PathBuf;

use adslam_experiment::ExperimentError;
use adslam_experiment::config::Selection;
use adslam_experiment::diagnostics::FileKind;
use adslam_experiment::run::Interrupt;
use adslam_experiment::scenario::values::{GateProbability, ValueError};
use adslam_experiment::scenario::{EstimatorName, LengthUnit, PlannerName};
use clap::builder::RangedU64ValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use crate::commands;
use crate::named::NameParser;

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "adslam",
    version,
    about = "Active SLAM in deforming 3D environments",
    long_about = "Plans the motion of a robot that maps an object which moves and deforms, in \
                  simulation, and filters recorded logs.\n\nExit codes: 0 all went well, 1 the \
                  work failed, 2 the input cannot be used, 130 interrupted.",
    after_help = "Try:\n  adslam run scenarios/polygon.toml --planner combined --seed 1 --out run\n  \
                  adslam tables configs/paper.toml --out results\n  \
                  adslam check scenarios/*.toml configs/*.toml sweeps/*.toml\n  \
                  adslam new scenario --out mine.toml"
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run one planner once and write the run down
    #[command(after_help = "Writes into the folder given with --out:\n  \
        summary.json   the run in a few numbers\n  \
        steps.csv      a row a step, units in the header\n  \
        features.csv   the features at the end\n  \
        truth.tum, estimate.tum   trajectories for the evo tools\n  \
        history.json   everything that adslam replay shows\n  \
        replay.html    that, as a page to open in a browser, with --html\n\n\
        Example:\n  \
        adslam run scenarios/heart.toml --planner local --seed 3 --out results/heart-local-3")]
    Run(RunArgs),
    /// Make a page of one or two runs to turn around and play in a browser
    #[command(
        after_help = "Takes folders that adslam run wrote. The page is one file and opens offline; \
        two runs stay in step. docs/replay.md shows what is on it.\n\n\
        Example:\n  adslam replay results/global results/combined --out results/replay.html"
    )]
    Replay(ReplayArgs),
    /// Write a run in the format of another tool: MCAP for Foxglove, PLY or CSV
    #[command(
        after_help = "Takes a folder that adslam run wrote; docs/export.md says what is in each \
        format.\n\n\
        Example:\n  adslam export results/run --format mcap --out run.mcap"
    )]
    Export(ExportArgs),
    /// Run the estimator over a recorded log
    #[command(
        after_help = "The log is JSON lines, a header and a line a step; docs/log.md is its \
        reference. The output has a line of estimates for each step.\n\n\
        Example:\n  adslam filter recording.jsonl --out estimates.jsonl"
    )]
    Filter(FilterArgs),
    /// Run everything that a configuration asks for and tabulate it
    #[command(after_help = "Writes into the folder given with --out:\n  \
        tables.md, tables.json   the tables, and every run\n  \
        report.html, replays/    a page with figures and replays to open in a browser, with \
        --html\n\n\
        Example:\n  adslam tables configs/accumulating.toml --runs 20 --out results/accumulating")]
    Tables(TablesArgs),
    /// Vary keys of a scenario, run every planner at each point, and compare them
    #[command(
        after_help = "Every finished run is kept in a file. Stopped or killed, the same command goes on \
        with what is missing. Writes into the folder given with --out:\n  \
        table.md           means with intervals, and which planners differ\n  \
        runs.*             a row a run, as CSV and as JSON lines\n  \
        table.*            a row for each planner at each point\n  \
        comparisons.*      a row for each pair of planners, metric by metric\n  \
        plan.json, records/, study.lock   what it goes on from\n\n\
        docs/sweep.md says how intervals and tests are computed.\n\n\
        Example:\n  adslam sweep sweeps/amplitude.toml --out results/amplitude"
    )]
    Sweep(SweepArgs),
    /// Say whether estimators know how wrong they are: NEES and NIS of many runs
    #[command(
        after_help = "Runs every planner of the configuration with each estimator. Stopped at any moment, \
        the same command goes on. Writes into the folder given with --out:\n  \
        consistency.md, consistency.json   the verdicts, for people and for machines\n  \
        verdicts.csv, steps.csv (.jsonl)   as tables, over all steps and step by step\n  \
        figures/                           NEES and NIS against the step\n\n\
        Example:\n  adslam consistency configs/consistency.toml --runs 20 --out results/consistency"
    )]
    Consistency(ConsistencyArgs),
    /// Say what a mesh file holds and whether it will serve as an object
    #[command(
        after_help = "Reads STL, OBJ and PLY. Exit code 2 where the mesh will not serve, with what \
        to do about it.\n\nExample:\n  adslam mesh heart.stl --unit mm"
    )]
    Mesh(MeshArgs),
    /// Say whether scenarios, configurations and sweeps are valid, and what is wrong with them
    #[command(
        after_help = "Example:\n  adslam check scenarios/*.toml configs/*.toml sweeps/*.toml"
    )]
    Check(CheckArgs),
    /// Write a commented scenario, configuration or sweep to start from
    #[command(subcommand, after_help = "Example:\n  adslam new scenario")]
    New(NewFile),
    /// Print the JSON Schema of scenarios, configurations or sweeps, for editors
    #[command(
        after_help = "A TOML file whose first line is `#:schema PATH` is completed and checked by \
        editors with a TOML language server. docs/scenario.md says more.\n\n\
        Example:\n  adslam schema scenario > scenario.schema.json"
    )]
    Schema {
        /// The kind of file
        #[arg(value_name = "KIND")]
        kind: SchemaKind,
    },
    /// Print a script that makes a shell complete the arguments of this command
    #[command(
        after_help = "Where the script belongs depends on the shell; bash, for one, reads it there:\n  \
        adslam completions bash > ~/.local/share/bash-completion/completions/adslam\n\n\
        Example:\n  adslam completions zsh > ~/.zfunc/_adslam"
    )]
    Completions {
        /// The shell
        shell: Shell,
    },
}

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

/// `adslam tables`
#[derive(Debug, Args)]
pub struct TablesArgs {
    /// The configuration file: what is run
    pub config: PathBuf,
    /// What of it is run
    #[command(flatten)]
    pub selection: SelectionArgs,
    /// The folder to write to; made if it does not exist
    #[arg(long, default_value = "results", value_name = "DIR")]
    pub out: PathBuf,
    /// Write report.html too, a page with figures to open in a browser, and replays beside it
    #[arg(long)]
    pub html: bool,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
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
    #[arg(long = "estimator", value_name = "NAME", value_parser = NameParser::<EstimatorName>::new())]
    pub estimators: Vec<EstimatorName>,
    /// The folder to write to and to go on in; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Answer with one JSON object
    #[arg(long)]
    pub json: bool,
}

/// `adslam mesh`
#[derive(Debug, Args)]
pub struct MeshArgs {
    /// The mesh file
    pub file: PathBuf,
    /// The unit of its coordinates: mm, cm or m
    #[arg(long, default_value = "mm", value_name = "UNIT")]
    pub unit: LengthUnit,
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

fn probability(given: &str) -> Result<GateProbability, ValueError> {
    // What is no number is answered like one that is out of range.
    GateProbability::new(given.parse().unwrap_or(f64::NAN))
}

impl Command {
    /// Does it.
    ///
    /// # Errors
    /// Bad input, a failure, or an interruption; see [`crate::exit_code`].
    pub fn execute(&self, interrupt: &Interrupt) -> Result<(), ExperimentError> {
        match self {
            Self::Run(args) => commands::run(args, interrupt),
            Self::Replay(args) => commands::replay(args),
            Self::Export(args) => commands::export(args),
            Self::Filter(args) => commands::filter(args, interrupt),
            Self::Tables(args) => commands::tables(args, interrupt),
            Self::Sweep(args) => commands::sweep(args, interrupt),
            Self::Consistency(args) => commands::consistency(args, interrupt),
            Self::Mesh(args) => commands::mesh(args),
            Self::Check(args) => commands::check(args),
            Self::New(file) => commands::new(file),
            Self::Schema { kind } => {
                commands::schema(*kind);
                Ok(())
            }
            Self::Completions { shell } => {
                commands::completions(*shell);
                Ok(())
            }
        }
    }
}
