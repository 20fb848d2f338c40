//! Tasks of the project: `cargo xtask TASK`.

mod bench_report;
mod docs;
mod environment;
mod figures;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use adslam_cli::{SelectionArgs, TablesArgs, exit_code, stop_on_signals, tables};
use clap::Parser;

use bench_report::BenchReportArgs;
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
        /// The folder to write tables.md, tables.json and report.html to
        #[arg(long, default_value = "results", value_name = "DIR")]
        out: PathBuf,
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
}

fn main() -> ExitCode {
    let interrupt = stop_on_signals();
    match Task::parse() {
        Task::ReproduceTables {
            runs,
            out,
            scenario,
            mesh,
        } => {
            let args = TablesArgs {
                config: paper(),
                selection: SelectionArgs {
                    runs: Some(runs),
                    only: scenario.labels(),
                    mesh,
                },
                out,
                html: true,
                json: false,
            };
            exit_code(tables(&args, interrupt))
        }
        Task::ReproduceFigures(args) => figures::reproduce(&args, interrupt),
        Task::BenchReport(args) => bench_report::report(&args),
        Task::Docs => docs::renew(&workspace()),
    }
}

/// The folder of the workspace, wherever the task is started from.
fn workspace() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent();
    folder.unwrap_or(Path::new(".")).to_owned()
}

/// The configuration of the paper's experiments.
fn paper() -> PathBuf {
    workspace().join("configs/paper.toml")
}
