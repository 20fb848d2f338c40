//! run.json: what a run is, and which files are its parts.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use adslam_diagnostics::{Failure, InputError, is_there, read_text};
use adslam_names::PlannerName;
use adslam_record::{AtomicFile, checksum};
use adslam_setup::Setup;
use serde::{Deserialize, Serialize};

use crate::provenance::Build;

/// The name of the file in a run's folder.
pub const RUN_FILE: &str = "run.json";

const FORMAT: &str = "adslam-run";
const VERSION: u32 = 1;
/// Larger ones are not ours.
const LARGEST_FILE: u64 = 1 << 20;
const AGAIN: &str = "make the run again with `adslam run`";

/// What a run in a folder is, by which program it was made, and the checksums of its files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunManifest {
    format: String,
    version: u32,
    /// Whether the folder holds the whole run. Not, while its files are being put there.
    pub complete: bool,
    /// The scenario's name; scenario.toml has all its keys.
    pub scenario: String,
    /// The planner.
    pub planner: PlannerName,
    /// The seed of all noise.
    pub seed: u64,
    /// The checksum of the object at rest: see [`Setup::object_checksum`].
    pub object_checksum: String,
    /// The program.
    pub made_by: Build,
    /// The CRC-32 of each of the other files.
    pub files: BTreeMap<String, String>,
}

impl RunManifest {
    /// Of a run that has no files yet.
    pub(super) fn new(setup: &Setup, planner: PlannerName, seed: u64) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            complete: false,
            scenario: setup.name().to_owned(),
            planner,
            seed,
            object_checksum: setup.object_checksum(),
            made_by: Build::this(),
            files: BTreeMap::new(),
        }
    }

    /// Takes files for parts of the run.
    pub(super) fn take(&mut self, files: &mut [AtomicFile]) -> Result<(), Failure> {
        for file in files {
            let name = file.path().file_name().unwrap_or_default();
            let name = name.to_string_lossy().into_owned();
            self.files.insert(name, file.checksum()?);
        }
        Ok(())
    }

    /// As a file that will lie in `folder`.
    pub(super) fn to_file(&self, folder: &Path) -> Result<AtomicFile, Failure> {
        let mut file = AtomicFile::create(&folder.join(RUN_FILE))?;
        file.add_json(self)?;
        Ok(file)
    }

    /// Reads that of the run in `folder`; none where there is none, as in the folders of versions before it.
    ///
    /// # Errors
    /// A file that cannot be read, is of another kind or version, or says that the folder holds half a run.
    pub fn load(folder: &Path) -> Result<Option<Self>, InputError> {
        let path = folder.join(RUN_FILE);
        if !is_there(&path)? {
            return Ok(None);
        }
        let shown = path.display();
        let about = |message: String| InputError::about_file(&path, message).with_help(AGAIN);
        let text = read_text(&path, LARGEST_FILE, AGAIN)?;
        let json: serde_json::Value = serde_json::from_str(&text)
            .map_err(|cause| about(format!("{shown} cannot be read: {cause}")))?;
        if json["format"] != FORMAT {
            return Err(about(format!("{shown} is not that of a run")));
        }
        if json["version"] != VERSION {
            return Err(about(format!(
                "{shown} has version {}; this adslam reads version {VERSION}",
                json["version"]
            )));
        }
        let manifest: Self = serde_json::from_value(json)
            .map_err(|cause| about(format!("{shown} cannot be read: {cause}")))?;
        if !manifest.complete {
            let folder = folder.display();
            return Err(about(format!(
                "{folder} does not hold a whole run: adslam was stopped while it put the files there, or is at it"
            )));
        }
        Ok(Some(manifest))
    }

    /// Whether the file `name`, whose content is `content`, is this run's.
    ///
    /// # Errors
    /// Where it is not.
    pub(super) fn expect(
        &self,
        folder: &Path,
        name: &str,
        content: &[u8],
    ) -> Result<(), InputError> {
        let sum = checksum(content).ok();
        if sum.is_some() && self.files.get(name) == sum.as_ref() {
            return Ok(());
        }
        let path = folder.join(name);
        let message = format!("{} {NOT_OF_THIS_RUN}", path.display());
        Err(InputError::about_file(&path, message).with_help(AGAIN))
    }

    /// A text for each file in `folder` that should be this run's, is there and is not.
    pub(super) fn strangers(&self, folder: &Path) -> Vec<String> {
        let differs = |(name, sum): (&String, &String)| {
            let path = folder.join(name);
            let there = File::open(&path).and_then(checksum).ok()?;
            (there != *sum).then(|| format!("{} {NOT_OF_THIS_RUN}", path.display()))
        };
        self.files.iter().filter_map(differs).collect()
    }
}

const NOT_OF_THIS_RUN: &str =
    "is not the file that run.json beside it names: it is of another run, or was changed";
