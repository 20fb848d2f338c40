//! The arguments of each subcommand.

mod files;
mod many;
mod single;

use adslam_names::{EstimatorName, PlannerName};
use adslam_scenario::registry::Registry;
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

pub use files::{CheckArgs, MeshArgs, NewArgs, NewFile, SchemaKind};
pub use many::{ConsistencyArgs, SelectionArgs, SweepArgs, TablesArgs};
pub use single::{ExportArgs, ExportFormat, FilterArgs, ReplayArgs, RunArgs};

use crate::named::RegistryParser;

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "adslam",
    version,
    about = "Active SLAM in deforming 3D environments",
    long_about = "Plans the motion of a robot that maps an object which moves and deforms, in \
                  simulation, and filters recorded logs.\n\nExit codes: 0 all went well, 1 the \
                  work failed, 2 the input cannot be used, 130 stopped by a signal.",
    after_help = "Try:\n  adslam run scenarios/polygon.toml --planner combined --seed 1 --out run\n  \
                  adslam tables configs/paper.toml\n  \
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
        run.json       what the run is, and its files\n  \
        scenario.toml  the scenario as it was run\n  \
        summary.json   the run in a few numbers\n  \
        steps.csv      a row a step, units in the header\n  \
        pose_covariance.csv   of the estimated pose, a row a step\n  \
        features.csv   the features at the end\n  \
        truth.tum, estimate.tum   trajectories for the evo tools\n  \
        history.json   everything that adslam replay shows\n  \
        replay.html    that, as a page to open in a browser, with --html\n  \
        log.jsonl      the run as a log for adslam filter, with --log\n\n\
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
        Example:\n  adslam filter samples/polygon.log.jsonl --out estimates.jsonl\n  \
        gzip -dc recording.jsonl.gz | adslam filter - --out - | jq .trace"
    )]
    Filter(FilterArgs),
    /// Run everything that a configuration asks for and tabulate it
    #[command(
        after_help = "Every finished run is kept in a file. Stopped or killed, the same command goes on \
        with what is missing. Writes into the folder given with --out:\n  \
        tables.md, tables.json   the tables, and every run\n  \
        report.html, replays/    a page with figures and replays to open in a browser, with \
        --html\n  \
        plan.json, records/, study.lock   what it goes on from\n\n\
        Example:\n  adslam tables configs/accumulating.toml --runs 20 \
        --out results/twenty"
    )]
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
        verdicts, steps, features (.csv, .jsonl)   as tables: over all steps, step by step, and for each feature\n  \
        figures/                           NEES and NIS against the step\n\n\
        Example:\n  adslam consistency configs/consistency.toml --runs 20 \
        --out results/nees-20"
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

impl Arguments {
    /// The command line of a program with this registry.
    #[must_use]
    pub fn command_with(registry: &Registry) -> clap::Command {
        let planners = RegistryParser::<PlannerName>::new(registry.clone());
        let estimators = RegistryParser::<EstimatorName>::new(registry.clone());
        let of_filter = estimators.clone();
        Self::command()
            .mut_subcommand("run", |run| {
                run.mut_arg("planner", |planner| planner.value_parser(planners))
            })
            .mut_subcommand("filter", |filter| {
                filter.mut_arg("estimator", |one| one.value_parser(of_filter))
            })
            .mut_subcommand("consistency", |consistency| {
                consistency.mut_arg("estimators", |one| one.value_parser(estimators))
            })
    }
}

impl Command {
    /// Whether it looks at its interrupt as it goes on. The others are short, and end at once by what the system does
    /// with a signal.
    #[must_use]
    pub const fn heeds_interrupts(&self) -> bool {
        matches!(
            self,
            Self::Run(_)
                | Self::Filter(_)
                | Self::Tables(_)
                | Self::Sweep(_)
                | Self::Consistency(_)
        )
    }
}
