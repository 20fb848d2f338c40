//! The folder of a study: locked, of one plan, without litter.

use std::collections::HashSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::difference::difference;
use super::plan::FORMAT;
use super::record::RecordFile;
use super::{StudyPlan, StudyUnit};
use crate::ExperimentError;
use crate::diagnostics::InputError;
use crate::output::{AtomicFile, prepare_folder, remove_leftovers};

const LOCK: &str = "study.lock";
const PLAN: &str = "plan.json";
const RECORDS: &str = "records";
/// Larger plans are not ours: a hundred thousand points take some tens of megabytes.
const LARGEST_PLAN: u64 = 1 << 28;
const ANOTHER_FOLDER: &str = "give another folder with --out, or one that does not exist yet";

/// A folder that this process may write records into.
#[derive(Debug)]
pub(super) struct StudyFolder {
    records: PathBuf,
    /// Checksum of the plan, to tell its records from those of another study.
    study: String,
    /// Held until this is dropped. The system gives it back too when the process dies.
    lock: File,
}

impl StudyFolder {
    /// Locks the folder, makes sure that it holds this study or none, and removes what was half-written.
    pub(super) fn open<'a>(
        folder: &Path,
        plan: StudyPlan<'a>,
    ) -> Result<(Self, Vec<StudyUnit<'a>>), ExperimentError> {
        prepare_folder(folder)?;
        let lock = locked(folder)?;
        let records = folder.join(RECORDS);
        let json = plan.to_json();
        let text = format!("{json:#}\n");
        let is_there = same_plan(folder, &json)?;
        refuse_strangers(&records, &plan.units)?;
        for folder in [folder, &records] {
            fs::create_dir_all(folder)
                .and_then(|()| remove_leftovers(folder))
                .map_err(ExperimentError::output(folder))?;
        }
        if !is_there {
            AtomicFile::with_content(&folder.join(PLAN), text.as_bytes())?.commit()?;
        }
        let folder = Self {
            records,
            study: checksum(text.as_bytes()),
            lock,
        };
        Ok((folder, plan.units))
    }

    /// Says in the lock's file who is at work, for whoever comes second to read; the lock holds without it.
    pub(super) fn sign(&mut self) {
        let _ = self
            .lock
            .set_len(0)
            .and_then(|()| write!(self.lock, "{}", std::process::id()));
    }

    /// The file of a unit's record.
    pub(super) fn record(&self, unit: &StudyUnit<'_>) -> RecordFile<'_> {
        RecordFile::new(&self.records, &self.study, unit.key())
    }
}

/// A checksum as text.
pub(super) fn checksum(bytes: &[u8]) -> String {
    format!("{:08x}", crc32fast::hash(bytes))
}

/// Takes the lock of a folder.
fn locked(folder: &Path) -> Result<File, ExperimentError> {
    let path = folder.join(LOCK);
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    let lock = options
        .open(&path)
        .map_err(ExperimentError::output(&path))?;
    let cause = match lock.try_lock() {
        Ok(()) => return Ok(lock),
        Err(cause) => cause,
    };
    let shown = folder.display();
    Err(match cause {
        TryLockError::WouldBlock => {
            let mut holder = String::new();
            let read = (&lock).take(20).read_to_string(&mut holder);
            let holder = match (read, holder.parse::<u32>()) {
                (Ok(_), Ok(process)) => format!(" (process {process})"),
                _ => String::new(),
            };
            let message = format!("another adslam{holder} is at work in {shown}");
            InputError::about_file(folder, message)
                .with_help(
                    "wait until it has ended, or stop it, and give the command again: it goes on with what is \
                     there; or give another folder with --out",
                )
                .into()
        }
        TryLockError::Error(cause) if cause.kind() == io::ErrorKind::Unsupported => {
            let message = format!("the file system of {shown} cannot lock files: {cause}");
            InputError::about_file(folder, message)
                .with_help("give a folder on a local disk with --out")
                .into()
        }
        TryLockError::Error(cause) => ExperimentError::output(&path)(cause),
    })
}

/// Whether the folder holds the study of this plan; not, if it holds none.
fn same_plan(folder: &Path, plan: &Value) -> Result<bool, InputError> {
    let path = folder.join(PLAN);
    let about =
        |message: String| Err(InputError::about_file(&path, message).with_help(ANOTHER_FOLDER));
    let file = match File::open(&path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(InputError::unreadable(&path, error)),
    };
    let mut text = Vec::new();
    let read = file.take(LARGEST_PLAN).read_to_end(&mut text);
    read.map_err(|error| InputError::unreadable(&path, error))?;
    let there: Value = match serde_json::from_slice(&text) {
        Ok(there) => there,
        Err(cause) => {
            return about(format!("{} is no plan of a study: {cause}", path.display()));
        }
    };
    if there["format"] != FORMAT {
        return about(format!("{} is no plan of a study", path.display()));
    }
    match difference(&there, plan) {
        None => Ok(true),
        Some(difference) => {
            let shown = folder.display();
            about(format!("{shown} holds another study: {difference}"))
        }
    }
}

/// Refuses a folder of records with files of other names. Hidden ones are the system's business.
fn refuse_strangers(records: &Path, units: &[StudyUnit<'_>]) -> Result<(), InputError> {
    let known: HashSet<String> = units
        .iter()
        .map(|unit| RecordFile::name(&unit.key()))
        .collect();
    let entries = match fs::read_dir(records) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries.map_err(|error| InputError::unreadable(records, error))?,
    };
    for entry in entries {
        let entry = entry.map_err(|error| InputError::unreadable(records, error))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if !name.starts_with('.') && !known.contains(&name) {
            let path = entry.path();
            let message = format!("{} is no record of this study", path.display());
            return Err(InputError::about_file(&path, message)
                .with_help("move it out of the folder; nothing but records belongs there"));
        }
    }
    Ok(())
}
