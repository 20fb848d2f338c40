//! What kind of file a TOML file is.

use std::fmt;
use std::path::Path;

use adslam_diagnostics::InputError;
use adslam_documents::Document;

/// The kinds of TOML files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A scenario: what the world is.
    Scenario,
    /// A configuration: what is run.
    Configuration,
    /// Published results.
    Published,
    /// A sweep: a scenario with some of its keys varied.
    Sweep,
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scenario => "scenario",
            Self::Configuration => "configuration",
            Self::Published => "file of published tables",
            Self::Sweep => "sweep",
        })
    }
}

impl FileKind {
    /// The kind in a word, for the command line and for the names of schemas.
    #[must_use]
    pub const fn short_name(self) -> &'static str {
        match self {
            Self::Scenario => "scenario",
            Self::Configuration => "config",
            Self::Published => "published",
            Self::Sweep => "sweep",
        }
    }

    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Scenario,
        Self::Configuration,
        Self::Published,
        Self::Sweep,
    ];

    /// Keys of the root that tell of this kind.
    const fn telling_keys(self) -> &'static [&'static str] {
        match self {
            Self::Scenario => &[
                "object",
                "noise",
                "sensor",
                "robot",
                "viewpoints",
                "planners",
                "motion",
                "steps",
            ],
            Self::Configuration => &["experiments", "published", "runs", "first_seed"],
            Self::Published => &["tables"],
            Self::Sweep => &["grid", "points", "set", "scenario", "runs", "first_seed"],
        }
    }

    /// The kind that most of the keys in the file at `path` tell of.
    ///
    /// # Errors
    /// A file that cannot be read or is not TOML, or of which no key tells.
    pub fn of_file(path: &Path) -> Result<Self, InputError> {
        Self::of(&Document::read(path)?).ok_or_else(|| {
            let message = format!(
                "{} is neither a scenario nor a configuration nor a sweep",
                path.display()
            );
            InputError::about_file(path, message).with_help(
                "a scenario has [object], [noise], [robot], …; a configuration [[experiments]]; a sweep \
                 [grid] or [[points]]; a file of published results [tables.…]. `adslam new` writes one with all keys",
            )
        })
    }

    /// The kind that most of the document's keys tell of; none where no key tells.
    fn of(document: &Document) -> Option<Self> {
        let keys = document.keys("");
        let told = |kind: &Self| {
            let telling = kind.telling_keys();
            keys.iter()
                .filter(|key| telling.contains(&key.as_str()))
                .count()
        };
        // Of equals the last is taken: `runs` alone makes a configuration.
        [
            Self::Scenario,
            Self::Published,
            Self::Sweep,
            Self::Configuration,
        ]
        .into_iter()
        .filter(|kind| told(kind) > 0)
        .max_by_key(told)
    }

    /// Refuses a document that is plainly of another kind, in better words than by its first key
    /// that does not belong here.
    pub(crate) fn expect(self, document: &Document) -> Result<(), InputError> {
        let Some(found) = Self::of(document).filter(|found| *found != self) else {
            return Ok(());
        };
        let path = document.path();
        let message = format!("{} is a {found}, and a {self} is needed", path.display());
        let help = match (self, found) {
            (Self::Scenario, Self::Configuration) => {
                "`adslam tables` runs a configuration; or give one of the scenarios that it names"
            }
            (Self::Configuration, Self::Scenario) => {
                "`adslam run` runs a scenario; or name it in a configuration, under [[experiments]]"
            }
            (_, Self::Sweep) => "`adslam sweep` runs a sweep",
            (Self::Sweep, Self::Scenario) => {
                "`adslam run` runs a scenario; or name it in a sweep, as `scenario = …`"
            }
            (Self::Sweep, Self::Configuration) => "`adslam tables` runs a configuration",
            _ => "docs/scenario.md says what belongs into scenarios, configurations and sweeps",
        };
        Err(InputError::about_file(path, message).with_help(help))
    }
}
