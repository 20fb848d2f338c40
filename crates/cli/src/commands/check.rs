//! `adslam check`

use std::path::PathBuf;

use adslam_experiment::ExperimentError;
use adslam_experiment::config::check_file;
use adslam_experiment::diagnostics::InputError;

use crate::print::{say, tell, warn};

/// Checks every file and says what each is, or what is wrong with it.
///
/// # Errors
/// That of a single file; of several, that some are not valid, after each has been explained.
pub fn check(files: &[PathBuf]) -> Result<(), ExperimentError> {
    let mut wrong = Vec::new();
    for path in files {
        match check_file(path) {
            Ok(checked) => {
                warn(&checked.warnings);
                say(format_args!("{}: valid {}", path.display(), checked.kind));
            }
            Err(error) if files.len() == 1 => return Err(error.into()),
            Err(error) => {
                tell(format_args!("{:?}", miette::Report::new(error)));
                wrong.push(path);
            }
        }
    }
    let Some(first) = wrong.first() else {
        return Ok(());
    };
    let message = format!("{} of {} files are not valid", wrong.len(), files.len());
    Err(InputError::about_file(first, message)
        .with_help("each is explained above; the others can be used")
        .into())
}
