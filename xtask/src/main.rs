//! Tasks of the project: `cargo xtask TASK`.

mod bench_report;
mod docs;
mod environment;
mod figures;
mod golden_runs;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use adslam_cli::{SelectionArgs, TablesArgs, exit_code, stop_on_signals, tables};
use adslam_scenario::registry::Registry;
use bench_report::BenchReportArgs;
use clap::Parser;
use environment::Environment;
use figures::FiguresArgs;

#[derive(Debug, Parser)]
#[command(name = "cargo xtask", about = "Tasks of the adslam project")]
enum Task {
    /// Run every method on both environments, print Tables I–IV beside the published values, and
    /// make a report of them
    ReproduceTables {
        /// Runs of each method
        #[arg(long, default_value_t = 5, value_name = "N")]
        runs: usize,
        /// The folder to write tables.md, tables.json and report.html to, and to go on in. Where not given,
        /// results/paper, with the environment and `mesh` added where they are given
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Go on with runs that another build did, and say so in the tables
        #[arg(long)]
        accept_build: bool,
        /// Which environment
        #[arg(long, default_value = "all")]
        scenario: Environment,
        /// An STL, OBJ or PLY file, in mm, to take for the heart in place of the built-in phantom
        #[arg(long, value_name = "FILE")]
        mesh: Option<PathBuf>,
    },
    /// Draw Figures 1–5, and those that the paper lacks, from new runs, as SVG and PNG
    ReproduceFigures(FiguresArgs),
    /// Run all benchmarks; write results/bench.json and the tables of docs/performance.md
    BenchReport(BenchReportArgs),
    /// Renew the files made from the code: docs/scenario.md and schemas/
    Docs,
    /// Renew tests/fixtures/golden/runs.txt, what every planner decides in whole runs. Refuses to where
    /// decisions have changed and RESULTS_VERSION has not been raised
    GoldenRuns,
}

fn main() -> ExitCode {
    let interrupt = stop_on_signals();
    match Task::parse() {
        Task::ReproduceTables {
            runs,
            out,
            accept_build,
            scenario,
            mesh,
        } => {
            let out = out.unwrap_or_else(|| folder_for(scenario, mesh.is_some()));
            let args = TablesArgs {
                config: paper(),
                selection: SelectionArgs {
                    runs: Some(runs),
                    only: scenario.labels(),
                    mesh,
                },
                out: Some(out),
                accept_build,
                html: true,
                json: false,
            };
            exit_code(tables(&args, &Registry::standard(), interrupt))
        }
        Task::ReproduceFigures(args) => figures::reproduce(&args, interrupt),
        Task::BenchReport(args) => bench_report::report(&args),
        Task::Docs => docs::renew(&workspace()),
        Task::GoldenRuns => golden_runs::renew(interrupt),
    }
}

/// The folder of the workspace, wherever the task is started from.
fn workspace() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder.unwrap_or(Path::new(".")).to_owned()
}

/// The folder of the paper's tables, another for each choice of what is run.
fn folder_for(scenario: Environment, is_other_mesh: bool) -> PathBuf {
    let mut name = "paper".to_owned();
    for label in scenario.labels() {
        name += &format!("-{label}");
    }
    if is_other_mesh {
        name += "-mesh";
    }
    Path::new("results").join(name)
}

/// The configuration of the paper's experiments.
fn paper() -> PathBuf {
    workspace().join("configs/paper.toml")
}
