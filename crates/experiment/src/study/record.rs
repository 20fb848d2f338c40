//! The file of one record: a line that says what it is, and a line with the record.

use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, InputError, is_there, read_text};
use adslam_record::AtomicFile;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::provenance::Build;

const FORMAT: &str = "adslam-record";
const VERSION: u32 = 2;
/// Larger records are not ours: a million steps in a dozen numbers take some hundred megabytes.
const LARGEST_RECORD: u64 = 1 << 30;

/// The first line.
#[derive(Serialize, Deserialize)]
struct Header {
    format: String,
    version: u32,
    unit: String,
    /// Checksum of all that the run depends on.
    identity: String,
    #[serde(flatten)]
    build: Build,
    /// Of the second line.
    crc32: String,
}

/// Where the record of a unit lies, or will.
pub(super) struct RecordFile<'a> {
    path: PathBuf,
    identity: String,
    unit: String,
    /// What may have written it.
    builds: &'a [Build],
}

/// The record as a line of JSON, and as it is read back from that.
pub(super) fn encode<R>(record: &R) -> Result<(String, R), serde_json::Error>
where
    R: Serialize + DeserializeOwned,
{
    let json = serde_json::to_string(record)?;
    let record = serde_json::from_str(&json)?;
    Ok((json, record))
}

impl<'a> RecordFile<'a> {
    /// Of a unit that depends on what `identity` is the checksum of, in the folder of the records of a study.
    pub(super) fn new(folder: &Path, identity: String, unit: String, builds: &'a [Build]) -> Self {
        Self {
            path: folder.join(Self::name(&unit)),
            identity,
            unit,
            builds,
        }
    }

    /// The name of the file of a unit.
    pub(super) fn name(unit: &str) -> String {
        format!("{unit}.jsonl")
    }

    /// Writes the record, given as a line of JSON, of one of the builds.
    pub(super) fn write(&self, json: &str, build: usize) -> Result<(), Failure> {
        let header = Header {
            format: FORMAT.to_owned(),
            version: VERSION,
            unit: self.unit.clone(),
            identity: self.identity.clone(),
            build: self.builds[build].clone(),
            crc32: checksum(json.as_bytes()),
        };
        let mut file = AtomicFile::create(&self.path)?;
        file.add_json_line(&header)?;
        file.add(json)?;
        file.add("\n")?;
        file.commit()
    }

    /// Reads the record, and the number of its build; none if there is none yet.
    pub(super) fn read<R: DeserializeOwned>(&self) -> Result<Option<(R, usize)>, InputError> {
        if !is_there(&self.path)? {
            return Ok(None);
        }
        let text = read_text(&self.path, LARGEST_RECORD, &self.remedy("move it away"))?;
        let (header, record) = text
            .split_once('\n')
            .and_then(|(header, rest)| Some((header, rest.strip_suffix('\n')?)))
            .ok_or_else(|| self.damaged("it is cut short"))?;
        let header: Header = serde_json::from_str(header)
            .map_err(|error| self.damaged(&format!("its first line: {error}")))?;
        if header.format != FORMAT || header.version != VERSION {
            return Err(self.damaged("its first line is not that of a record of this version"));
        }
        if header.identity != self.identity || header.unit != self.unit {
            let message = format!("{} is a record of another study", self.path.display());
            return Err(
                InputError::about_file(&self.path, message).with_help(format!(
                    "move it out of the folder; the run {} is then done here",
                    self.unit
                )),
            );
        }
        if header.crc32 != checksum(record.as_bytes()) {
            return Err(self.damaged("its checksum is wrong"));
        }
        let known = self.builds.iter().position(|known| *known == header.build);
        let Some(build) = known else {
            let (path, build) = (self.path.display(), header.build);
            let message = format!("{path} was made by another build: {build}");
            return Err(InputError::about_file(&self.path, message)
                .with_help(self.remedy("move it out of the folder")));
        };
        serde_json::from_str(record)
            .map(|record| Some((record, build)))
            .map_err(|error| self.damaged(&format!("its second line: {error}")))
    }

    fn damaged(&self, reason: &str) -> InputError {
        let message = format!("{} is damaged: {reason}", self.path.display());
        InputError::about_file(&self.path, message).with_help(self.remedy("remove it"))
    }

    fn remedy(&self, what_to_do: &str) -> String {
        format!(
            "{what_to_do} and give the command again: the run {} is then done anew, and no other",
            self.unit
        )
    }
}

/// A checksum as text.
fn checksum(bytes: &[u8]) -> String {
    format!("{:08x}", crc32fast::hash(bytes))
}
