//! `cargo xtask golden-runs`

use std::fs;
use std::io::ErrorKind;
use std::process::ExitCode;

use adslam_cli::{FAILURE, exit_code};
use adslam_diagnostics::Interrupt;
use adslam_tests::fixture;
use adslam_tests::golden_runs::{GOLDEN_RUNS, GoldenRuns, Renewal};

/// Does the runs, writes the file if it has to change and may, and returns the exit code.
pub fn renew(interrupt: &Interrupt) -> ExitCode {
    let runs = match GoldenRuns::record(interrupt) {
        Ok(runs) => runs,
        Err(error) => return exit_code(Err(error)),
    };
    match write(&runs) {
        Ok(message) => {
            println!("{message}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(FAILURE)
        }
    }
}

fn write(runs: &GoldenRuns) -> Result<String, String> {
    let path = fixture(GOLDEN_RUNS);
    let shown = path.display();
    let file = match fs::read_to_string(&path) {
        Ok(text) => Some(text),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(format!("cannot read {shown}: {error}")),
    };
    match runs.renewal_of(file.as_deref())? {
        Renewal::UpToDate => Ok(format!("{shown} is up to date")),
        Renewal::Write(text) => match fs::write(&path, text) {
            Ok(()) => Ok(format!("wrote {shown}")),
            Err(error) => Err(format!("cannot write {shown}: {error}")),
        },
    }
}
