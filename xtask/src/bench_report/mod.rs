//! `cargo xtask bench-report`: every benchmark in one go, as JSON and as a section of docs/performance.md.

mod measured;
mod page;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::{env, fs, thread};

use adslam_cli::FAILURE;
use adslam_record::AtomicFile;
use clap::Args;
use measured::Report;

/// The arguments of the task.
#[derive(Debug, Args)]
pub struct BenchReportArgs {
    /// Up to 200 features, without the textbook, fewer and shorter samples: under three minutes after the build
    #[arg(long)]
    quick: bool,
    /// Measure nothing: write down what was measured last
    #[arg(long, conflicts_with = "quick")]
    no_run: bool,
    /// The file for the numbers
    #[arg(long, default_value = "results/bench.json", value_name = "FILE")]
    out: PathBuf,
    /// The page whose marked section is written anew
    #[arg(long, default_value = "docs/performance.md", value_name = "FILE")]
    page: PathBuf,
}

/// The benchmarks: package and target.
const BENCHES: [(&str, &str); 3] = [
    ("adslam-surface", "visibility"),
    ("adslam-tests", "decision"),
    ("adslam-estimator", "filter"),
];

/// What a quick run measures: neither what takes seconds a call nor the largest states.
const QUICK: &str = "/(fast.*|direct|one_by_one|local|combined|global|clearance|visibility)/\
    (polygon|heart50|heart200)$";

/// Does it, says what was written, and returns the exit code.
pub fn report(args: &BenchReportArgs) -> ExitCode {
    match args.run() {
        Ok(()) => {
            println!("wrote {} and {}", args.out.display(), args.page.display());
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(FAILURE)
        }
    }
}

impl BenchReportArgs {
    fn run(&self) -> Result<(), String> {
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
        let folder = target.join("bench-report");
        if !self.no_run {
            // Results of earlier runs must not be mixed in.
            if folder.exists() {
                fs::remove_dir_all(&folder).map_err(named(&folder))?;
            }
            for (package, bench) in BENCHES {
                self.measure(package, bench, &folder)?;
            }
        }
        let report = Report::read(&folder)?;
        let page = fs::read_to_string(&self.page).map_err(named(&self.page))?;
        let page = page::renew(&page, &report, &machine()).map_err(named(&self.page))?;
        let json = serde_json::to_string_pretty(&report).map_err(named(&self.out))? + "\n";
        if let Some(parent) = self.out.parent() {
            fs::create_dir_all(parent).map_err(named(parent))?;
        }
        for (path, content) in [(&self.out, json), (&self.page, page)] {
            AtomicFile::with_content(path, content.as_bytes())
                .and_then(AtomicFile::commit)
                .map_err(named(path))?;
        }
        Ok(())
    }

    fn measure(&self, package: &str, bench: &str, folder: &Path) -> Result<(), String> {
        let folder = std::path::absolute(folder).map_err(named(folder))?;
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo
            .args([
                "bench",
                "--locked",
                "--package",
                package,
                "--bench",
                bench,
                "--",
            ])
            .env("CRITERION_HOME", folder);
        if self.quick {
            cargo.args(["--sample-size", "10", "--warm-up-time", "0.1"]);
            cargo.args(["--measurement-time", "0.3", QUICK]);
        }
        let status = cargo.status().map_err(named(Path::new("cargo")))?;
        if status.success() {
            return Ok(());
        }
        Err(format!(
            "the benchmark {bench} of {package} failed ({status})"
        ))
    }
}

/// The processor, its number of threads, and the compiler.
fn machine() -> String {
    let information = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = information
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or("A processor of unknown name", |(_, name)| name.trim());
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let compiler = Command::new("rustc").arg("--version").output();
    let compiler = compiler.map_or_else(
        |_| "an unknown compiler".into(),
        |output| String::from_utf8_lossy(&output.stdout).trim().to_owned(),
    );
    format!("{model}, {threads} threads, {compiler}")
}

/// Puts the file that an error is about in front of it.
fn named<E: std::fmt::Display>(path: &Path) -> impl FnOnce(E) -> String {
    let path = path.display().to_string();
    move |error| format!("{path}: {error}")
}
