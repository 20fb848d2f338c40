//! The paper's environments as an argument.

use clap::ValueEnum;

/// One of the paper's environments, or both.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Environment {
    Polygon,
    Heart,
    All,
}

impl Environment {
    /// Their labels in the configuration; none for all.
    pub fn labels(self) -> Vec<String> {
        let labels: &[&str] = match self {
            Self::Polygon => &["polygon"],
            Self::Heart => &["heart"],
            Self::All => &[],
        };
        labels.iter().map(ToString::to_string).collect()
    }
}
