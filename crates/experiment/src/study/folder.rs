//! The folder of a study: locked, of one plan, without litter.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use adslam_diagnostics::{Failure, InputError, is_there, read_text};
use adslam_record::{AtomicFile, FolderLock, make_folder, prepare_folder};
use serde::Deserialize;

use super::growth::Grown;
use super::kept::{FORMAT, KeptPlan, VERSION};
use super::record::RecordFile;
use super::{OtherBuilds, StudyPlan, StudyUnit};
use crate::provenance::Build;

const LOCK: &str = "study.lock";
const PLAN: &str = "plan.json";
const RECORDS: &str = "records";
const PARTIAL: &str = "partial";
/// Larger plans are not ours: ten thousand points take some megabytes.
const LARGEST_PLAN: u64 = 1 << 28;
const WAIT: &str = "wait until it has ended, or stop it, and give the command again: it resumes with what is there; \
    or give another folder with --out";
/// Files that tell that a folder holds results of something else, where it holds no plan.
const RESULTS: [&str; 8] = [
    "run.json",
    "summary.json",
    "history.json",
    "steps.csv",
    "tables.json",
    "report.html",
    "table.md",
    "consistency.json",
];
const ANOTHER_FOLDER: &str = "give another folder with --out, or one that does not exist yet";

/// The folder of a study, locked by this process.
#[derive(Debug)]
pub(super) struct StudyFolder {
    path: PathBuf,
    records: PathBuf,
    /// What plan.json holds, if it is there.
    there: Option<KeptPlan>,
    /// What it is to hold.
    grown: Grown,
    /// The number of this build among those of the plan.
    build: usize,
    _lock: FolderLock,
}

impl StudyFolder {
    /// Locks the folder, which is made if need be, and makes sure that it holds this study, a part of it, or none.
    /// Returns the units of the plan too.
    pub(super) fn lock<'a>(
        path: &Path,
        plan: &StudyPlan<'a>,
        other_builds: OtherBuilds,
    ) -> Result<(Self, Vec<StudyUnit<'a>>), Failure> {
        make_folder(path)?;
        let lock = FolderLock::take(path, LOCK, WAIT)?;
        let there = kept_plan(path)?;
        let build = Build::this();
        let mut grown = Grown::from(there.as_ref(), plan, &build).map_err(|differences| {
            let (shown, differences) = (path.display(), differences.join("; "));
            let message = format!("{shown} holds another study: {differences}");
            InputError::about_file(&path.join(PLAN), message).with_help(
                "a study may grow, by runs, points and planners, but all of its own must stay in it; otherwise give \
                 another folder with --out, or one that does not exist yet",
            )
        })?;
        let known = grown.plan.builds.iter().position(|known| *known == build);
        let build = match (known, other_builds) {
            (Some(known), _) => known,
            (None, OtherBuilds::Accept) => {
                grown.plan.builds.push(build);
                grown.plan.builds.len() - 1
            }
            (None, OtherBuilds::Refuse) => {
                return Err(another_build(path, &grown.plan, &build).into());
            }
        };
        let records = path.join(RECORDS);
        let units = plan.units(&grown.numbers);
        refuse_strangers(&records, &units)?;
        let folder = Self {
            path: path.to_owned(),
            records,
            there,
            grown,
            build,
            _lock: lock,
        };
        Ok((folder, units))
    }

    /// Makes it ready for records: removes what was half-written and the tables of a part of the runs, and writes
    /// the plan where it is another than before.
    pub(super) fn prepare(&self) -> Result<(), Failure> {
        prepare_folder(&self.path)?;
        prepare_folder(&self.records)?;
        if self.there.is_some() {
            remove_folder(&self.partial())?;
        }
        if self.there.as_ref() == Some(&self.grown.plan) {
            return Ok(());
        }
        let mut file = AtomicFile::create(&self.path.join(PLAN))?;
        file.add_json(&self.grown.plan)?;
        file.commit()
    }

    /// The file of a unit's record.
    pub(super) fn record(&self, unit: &StudyUnit<'_>) -> RecordFile<'_> {
        let identity = self.grown.identity(unit);
        RecordFile::new(&self.records, identity, unit.key(), &self.grown.plan.builds)
    }

    /// The builds that may add records.
    pub(super) fn builds(&self) -> &[Build] {
        &self.grown.plan.builds
    }

    /// The number of this build among them.
    pub(super) const fn build(&self) -> usize {
        self.build
    }

    /// Where results belong.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Where results belong as long as runs are missing.
    pub(super) fn partial(&self) -> PathBuf {
        self.path.join(PARTIAL)
    }
}

/// Removes a folder of results, if it is there.
fn remove_folder(folder: &Path) -> Result<(), Failure> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(Failure::output(folder)(error))
        }
        _ => Ok(()),
    }
}

/// The error of a folder in which this build may not work.
fn another_build(folder: &Path, plan: &KeptPlan, here: &Build) -> InputError {
    let last = plan.builds.last();
    let differences = last
        .map(|there| there.differences(here))
        .unwrap_or_default();
    let (shown, differences) = (folder.display(), differences.join("; "));
    let message = format!("{shown} holds a study of another build: {differences}");
    InputError::about_file(&folder.join(PLAN), message).with_help(
        "its runs may differ from those that this build would do. Go on nevertheless with --accept-build, and the \
         tables will say so; or give another folder with --out",
    )
}

/// The plan of the study that the folder holds; none, if it holds nothing.
fn kept_plan(folder: &Path) -> Result<Option<KeptPlan>, InputError> {
    let path = folder.join(PLAN);
    if !is_there(&path)? {
        for name in RESULTS {
            let path = folder.join(name);
            if is_there(&path)? {
                let message = format!(
                    "{} holds results of something else: {name}",
                    folder.display()
                );
                return Err(InputError::about_file(&path, message).with_help(ANOTHER_FOLDER));
            }
        }
        return Ok(None);
    }
    let text = read_text(&path, LARGEST_PLAN, ANOTHER_FOLDER)?;
    let no_plan = |cause: String| {
        let message = format!("{} is no plan of a study{cause}", path.display());
        InputError::about_file(&path, message).with_help(ANOTHER_FOLDER)
    };
    let head: PlanHead =
        serde_json::from_str(&text).map_err(|cause| no_plan(format!(": {cause}")))?;
    if head.format != FORMAT {
        return Err(no_plan(String::new()));
    }
    if head.version != VERSION {
        let message = format!(
            "{} was written by another version of adslam: its form is {} and {VERSION} is needed",
            path.display(),
            head.version
        );
        return Err(InputError::about_file(&path, message).with_help(ANOTHER_FOLDER));
    }
    let plan: KeptPlan =
        serde_json::from_str(&text).map_err(|cause| no_plan(format!(": {cause}")))?;
    if plan.builds.is_empty() || plan.runs == 0 {
        return Err(no_plan(": it has no builds or no runs".to_owned()));
    }
    Ok(Some(plan))
}

/// What every version of plan.json has.
#[derive(Deserialize)]
struct PlanHead {
    #[serde(default)]
    format: String,
    #[serde(default)]
    version: u32,
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
