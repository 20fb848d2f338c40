//! Where the results of a study are written: beside its records when all runs are there, and apart until then.

use std::collections::HashSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_record::prepare_folder;

use super::Study;

/// Folders of the results that have files by what was run.
const FOLDERS: [&str; 1] = ["figures"];

impl<R> Study<'_, R> {
    /// Whether all units have been done.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.records.iter().all(Option::is_some)
    }

    /// Writes results with `write`, which gets a folder and returns the paths of its files: into the study's folder
    /// if all units have been done, else into `partial` in it, so that they never take the place of whole ones.
    /// Removes what an earlier time left there that belongs to these no more.
    ///
    /// # Errors
    /// Those of `write`, and a folder that cannot be made.
    pub fn write_results(
        &self,
        write: impl FnOnce(&Path) -> Result<Vec<PathBuf>, Failure>,
    ) -> Result<Vec<PathBuf>, Failure> {
        let folder = if self.is_complete() {
            self.folder.path().to_owned()
        } else {
            self.folder.partial()
        };
        prepare_folder(&folder)?;
        let written = write(&folder)?;
        remove_stale(&folder, &written)?;
        Ok(written)
    }
}

/// Removes figures and Parquet tables that were written once and are not among `written`: of a label that is
/// another now, or by a build with other features.
fn remove_stale(folder: &Path, written: &[PathBuf]) -> Result<(), Failure> {
    let written: HashSet<&Path> = written.iter().map(PathBuf::as_path).collect();
    let within = FOLDERS.map(|name| folder.join(name));
    for (at, extensions) in std::iter::once((folder, &["parquet"][..]))
        .chain(within.iter().map(|at| (at.as_path(), &["svg", "png"][..])))
    {
        let Ok(entries) = fs::read_dir(at) else {
            continue;
        };
        for path in entries.flatten().map(|entry| entry.path()) {
            let extension = path.extension().and_then(OsStr::to_str);
            let is_ours = extension.is_some_and(|extension| extensions.contains(&extension));
            if is_ours && !written.contains(path.as_path()) {
                fs::remove_file(&path).map_err(Failure::output(&path))?;
            }
        }
    }
    Ok(())
}
