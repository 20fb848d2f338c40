//! The folder of a study: locked, of one plan, without litter.

use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::difference::difference;
use super::plan::FORMAT;
use super::record::RecordFile;
use super::{StudyPlan, StudyUnit};
use crate::ExperimentError;
use crate::diagnostics::{InputError, is_there, read_text};
use crate::output::{AtomicFile, FolderLock, make_folder, prepare_folder};
use crate::run::refuse_run;

const LOCK: &str = "study.lock";
const PLAN: &str = "plan.json";
const RECORDS: &str = "records";
/// Larger plans are not ours: a hundred thousand points take some tens of megabytes.
const LARGEST_PLAN: u64 = 1 << 28;
const WAIT: &str = "wait until it has ended, or stop it, and give the command again: it goes on with what is there; \
    or give another folder with --out";
const ANOTHER_FOLDER: &str = "give another folder with --out, or one that does not exist yet";

/// The folder of a study, locked by this process.
#[derive(Debug)]
pub(super) struct StudyFolder {
    path: PathBuf,
    records: PathBuf,
    /// The content of plan.json, there or not yet.
    plan: String,
    plan_is_there: bool,
    /// Checksum of the plan, to tell its records from those of another study.
    study: String,
    _lock: FolderLock,
}

impl StudyFolder {
    /// Locks the folder, which is made if need be, and makes sure that it holds this study or none.
    pub(super) fn lock(path: &Path, plan: &StudyPlan<'_>) -> Result<Self, ExperimentError> {
        make_folder(path)?;
        refuse_run(path)?;
        let lock = FolderLock::take(path, LOCK, WAIT)?;
        let records = path.join(RECORDS);
        let json = plan.to_json();
        let plan_is_there = same_plan(path, &json)?;
        refuse_strangers(&records, &plan.units)?;
        let plan = format!("{json:#}\n");
        Ok(Self {
            path: path.to_owned(),
            records,
            study: checksum(plan.as_bytes()),
            plan,
            plan_is_there,
            _lock: lock,
        })
    }

    /// Makes it ready for records: removes what was half-written, and writes the plan if it is not there.
    pub(super) fn prepare(&self) -> Result<(), ExperimentError> {
        prepare_folder(&self.path)?;
        prepare_folder(&self.records)?;
        if self.plan_is_there {
            return Ok(());
        }
        AtomicFile::with_content(&self.path.join(PLAN), self.plan.as_bytes())?.commit()
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

/// Whether the folder holds the study of this plan; not, if it holds none.
fn same_plan(folder: &Path, plan: &Value) -> Result<bool, InputError> {
    let path = folder.join(PLAN);
    let about =
        |message: String| Err(InputError::about_file(&path, message).with_help(ANOTHER_FOLDER));
    if !is_there(&path)? {
        return Ok(false);
    }
    let text = read_text(&path, LARGEST_PLAN, ANOTHER_FOLDER)?;
    let there: Value = match serde_json::from_str(&text) {
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
