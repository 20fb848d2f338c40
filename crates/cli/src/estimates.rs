//! Where the estimates of `adslam filter` go.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_record::log::EstimateLine;
use adslam_record::{AtomicFile, prepare_folder};

use crate::paths::folder_of;

/// Whether a path stands for the standard input or output.
pub(crate) fn is_standard(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// A file that appears when it is complete, or the standard output as lines come.
pub(crate) enum Estimates {
    File(AtomicFile),
    Standard,
}

impl Estimates {
    /// Starts to write to `out`.
    pub(crate) fn create(out: &Path) -> Result<Self, Failure> {
        if is_standard(out) {
            return Ok(Self::Standard);
        }
        prepare_folder(folder_of(out))?;
        AtomicFile::create(out).map(Self::File)
    }

    /// Adds a line.
    pub(crate) fn add(&mut self, line: &EstimateLine) -> Result<(), Failure> {
        match self {
            Self::File(file) => file.add_json_line(line),
            Self::Standard => print(line).map_err(|cause| Failure::Output {
                path: PathBuf::from("standard output"),
                cause,
            }),
        }
    }

    /// The file, which still has to be committed.
    pub(crate) fn finish(self) -> Option<AtomicFile> {
        match self {
            Self::File(file) => Some(file),
            Self::Standard => None,
        }
    }
}

fn print(line: &EstimateLine) -> io::Result<()> {
    let mut bytes = serde_json::to_vec(line)?;
    bytes.push(b'\n');
    let mut out = io::stdout().lock();
    out.write_all(&bytes)?;
    out.flush()
}
