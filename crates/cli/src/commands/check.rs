//! `adslam check`

use std::path::PathBuf;

use adslam_experiment::ExperimentError;
use adslam_experiment::config::check_file;

/// Checks every file and says what each is; the errors of all are shown, the last one returned.
///
/// # Errors
/// The last file's that is not valid.
pub fn check(files: &[PathBuf]) -> Result<(), ExperimentError> {
    let mut last = None;
    for path in files {
        match check_file(path) {
            Ok(kind) => println!("{}: valid {kind}", path.display()),
            Err(error) => {
                if let Some(earlier) = last.replace(error) {
                    eprintln!("{:?}", miette::Report::new(earlier));
                }
            }
        }
    }
    last.map_or(Ok(()), |error| Err(error.into()))
}
