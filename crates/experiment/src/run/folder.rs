//! The folder of a run: one run whole, and nothing else.

use std::fs;
use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError, is_there};
use adslam_record::{
    AtomicFile, FolderLock, HISTORY_FILE, RunHistory, make_folder, prepare_folder,
};

use super::manifest::{RUN_FILE, RunManifest};

const LOCK: &str = "run.lock";
const WAIT: &str = "wait until it has ended, or give another folder with --out";

/// The page of a run, which is made of its history and may be made again.
pub const PAGE_FILE: &str = "replay.html";
/// The scenario as it was run.
pub(super) const SCENARIO_FILE: &str = "scenario.toml";

/// The files of a run, as they were before there was a run.json.
const OLD_FILES: [&str; 7] = [
    "summary.json",
    "steps.csv",
    "features.csv",
    "truth.tum",
    "estimate.tum",
    HISTORY_FILE,
    PAGE_FILE,
];
/// Those that have come since.
const NEW_FILES: [&str; 4] = [RUN_FILE, SCENARIO_FILE, "pose_covariance.csv", "log.jsonl"];

/// The folder that a run will go into, locked by this process.
#[derive(Debug)]
pub(super) struct RunFolder {
    path: PathBuf,
    _lock: FolderLock,
}

impl RunFolder {
    /// Makes and locks the folder, removes what a killed process left half-written, and makes sure that it holds
    /// a run or nothing.
    pub(super) fn lock(path: &Path) -> Result<Self, Failure> {
        make_folder(path)?;
        let lock = FolderLock::take(path, LOCK, WAIT)?.temporary();
        refuse_strangers(path)?;
        prepare_folder(path)?;
        Ok(Self {
            path: path.to_owned(),
            _lock: lock,
        })
    }

    /// Puts the files of a run into the folder, in the place of the run that was there; returns their paths.
    pub(super) fn replace(
        &self,
        mut manifest: RunManifest,
        mut files: Vec<AtomicFile>,
    ) -> Result<Vec<PathBuf>, Failure> {
        manifest.take(&mut files)?;
        let marker = manifest.to_file(&self.path)?;
        manifest.complete = true;
        files.push(manifest.to_file(&self.path)?);
        let paths = files.iter().map(|file| file.path().to_owned()).collect();
        let old: Vec<PathBuf> = OLD_FILES
            .iter()
            .chain(&NEW_FILES)
            .filter(|name| **name != RUN_FILE)
            .map(|name| self.path.join(name))
            .filter(|path| path.is_file())
            .collect();
        AtomicFile::replace_all(marker, &old, files)?;
        Ok(paths)
    }
}

/// Refuses a folder with anything but the files of a run. Hidden ones are the system's business.
fn refuse_strangers(folder: &Path) -> Result<(), InputError> {
    let unreadable = |error| InputError::unreadable(folder, error);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let name = entry.map_err(unreadable)?.file_name();
        names.push(name.to_string_lossy().into_owned());
    }
    names.retain(|name| !name.starts_with('.') && name != LOCK);
    names.sort();
    let has = |name: &str| names.iter().any(|there| there == name);
    let known: &[&[&str]] = if has(RUN_FILE) {
        &[&OLD_FILES, &NEW_FILES]
    } else if has("summary.json") {
        &[&OLD_FILES]
    } else {
        &[]
    };
    let is_known = |name: &String| known.iter().any(|known| known.contains(&name.as_str()));
    let strangers: Vec<&str> = names
        .iter()
        .filter(|name| !is_known(name))
        .map(|name| name.as_str())
        .collect();
    let (first, more) = match strangers.as_slice() {
        [] => return Ok(()),
        [one] => (one, String::new()),
        [one, others @ ..] => (one, format!(" and {} more", others.len())),
    };
    let message = format!(
        "{} holds {first}{more}, which is no part of a run",
        folder.display()
    );
    Err(InputError::about_file(folder, message).with_help(
        "give another folder with --out, or move away what is there: the folder of a run holds that run and nothing \
         else, and a run made anew replaces it as a whole",
    ))
}

/// Refuses a path for an output where a file of a run lies: it would be lost, and the folder no run any more. A page
/// may go there.
///
/// # Errors
/// [`InputError`] where there is such a file.
pub fn refuse_part_of_run(path: &Path) -> Result<(), InputError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let is_part = OLD_FILES
        .iter()
        .chain(&NEW_FILES)
        .any(|known| *known == name)
        && name != PAGE_FILE;
    if !is_part || !is_there(&path.with_file_name(RUN_FILE))? {
        return Ok(());
    }
    let message = format!("{} is a part of the run in its folder", path.display());
    Err(InputError::about_file(path, message).with_help("give another path with --out"))
}

/// A run that lies in a folder, of which the history has been read.
#[derive(Clone, Debug)]
pub struct StoredRun {
    /// Its history.
    pub history: RunHistory,
    /// Parts of the folder that are not of this run, or that nobody can tell.
    pub warnings: Vec<String>,
}

impl StoredRun {
    /// Reads the run in `folder`.
    ///
    /// # Errors
    /// As [`RunManifest::load`] and [`RunHistory::load`], and where the history is not that of the run.
    pub fn load(folder: &Path) -> Result<Self, InputError> {
        let manifest = RunManifest::load(folder)?;
        let (path, text) = RunHistory::text(folder)?;
        let warnings = match manifest {
            Some(manifest) => {
                manifest.expect(folder, HISTORY_FILE, text.as_bytes())?;
                manifest.strangers(folder)
            }
            None => vec![format!(
                "{} has no {RUN_FILE}, as those of versions before it: nothing tells whether its files are of one run",
                folder.display()
            )],
        };
        let history = RunHistory::parse(&path, &text)?;
        Ok(Self { history, warnings })
    }
}
