//! Tasks of the project: `cargo xtask TASK`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use adslam_cli::{TablesArgs, exit_code, stop_on_ctrl_c, tables};
use clap::{Parser, ValueEnum};

#[derive(Debug, Parser)]
#[command(name = "cargo xtask", about = "Tasks of the adslam project")]
enum Task {
    /// Run every method on both environments and print Tables I–IV beside the published values
    ReproduceTables {
        /// Runs of each method
        #[arg(long, default_value_t = 5, value_name = "N")]
        runs: usize,
        /// The folder to write tables.md and tables.json to
        #[arg(long, default_value = "results", value_name = "DIR")]
        out: PathBuf,
        /// Which environment
        #[arg(long, default_value = "all")]
        scenario: Environment,
        /// An STL file, in mm, to take for the heart in place of the built-in phantom
        #[arg(long, value_name = "FILE")]
        mesh: Option<PathBuf>,
    },
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Environment {
    Polygon,
    Heart,
    All,
}

impl Environment {
    fn labels(self) -> Vec<String> {
        let labels: &[&str] = match self {
            Self::Polygon => &["polygon"],
            Self::Heart => &["heart"],
            Self::All => &[],
        };
        labels.iter().map(ToString::to_string).collect()
    }
}

fn main() -> ExitCode {
    let interrupt = stop_on_ctrl_c();
    match Task::parse() {
        Task::ReproduceTables {
            runs,
            out,
            scenario,
            mesh,
        } => {
            let config = workspace().join("configs/paper.toml");
            let only = scenario.labels();
            let args = TablesArgs {
                config,
                runs: Some(runs),
                only,
                mesh,
                out,
            };
            exit_code(tables(&args, interrupt))
        }
    }
}

/// The folder of the workspace, wherever the task is started from.
fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap_or(Path::new("."))
}
