//! By which program results were made.

mod arithmetic;

use std::fmt;

use serde::{Deserialize, Serialize};

/// Counts up whenever the program's results change: whole runs with the same scenario, planner and seed
/// give other numbers than before.
pub const RESULTS_VERSION: u32 = 1;

/// A checksum of the code, of its locked dependencies, of the compiler and of what it was told. It is the same
/// wherever the same code is compiled alike.
pub const BUILD: &str = env!("ADSLAM_BUILD");

/// What made a result: the program, and the arithmetic of the machine that it ran on.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Build {
    /// Name and version.
    pub program: String,
    /// [`RESULTS_VERSION`].
    pub results_version: u32,
    /// [`BUILD`].
    pub build: String,
    /// A checksum of every bit of a few short runs, of every planner and estimator: machines whose arithmetic
    /// differs have another.
    pub arithmetic: String,
}

impl Build {
    /// This program on this machine. The first call does the short runs, in some milliseconds.
    #[must_use]
    pub fn this() -> Self {
        Self {
            program: concat!("adslam ", env!("CARGO_PKG_VERSION")).to_owned(),
            results_version: RESULTS_VERSION,
            build: BUILD.to_owned(),
            arithmetic: arithmetic::checksum().to_owned(),
        }
    }

    /// What differs between two of them, in words, such as "the build is 1a2b3c4d there and 99aabbcc here".
    #[must_use]
    pub fn differences(&self, here: &Self) -> Vec<String> {
        let mut said = Vec::new();
        let mut compare = |what: &str, there: &dyn fmt::Display, here: &dyn fmt::Display| {
            let (there, here) = (there.to_string(), here.to_string());
            if there != here {
                said.push(format!("the {what} is {there} there and {here} here"));
            }
        };
        compare("program", &self.program, &here.program);
        let versions = (self.results_version, here.results_version);
        compare("version of results", &versions.0, &versions.1);
        compare("build", &self.build, &here.build);
        compare("arithmetic", &self.arithmetic, &here.arithmetic);
        said
    }
}

impl fmt::Display for Build {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            program,
            results_version,
            build,
            arithmetic,
        } = self;
        write!(
            f,
            "{program}, results version {results_version}, build {build}, arithmetic {arithmetic}"
        )
    }
}

/// How many runs a build did.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BuildRuns {
    /// Which.
    #[serde(flatten)]
    pub build: Build,
    /// Runs that it did.
    pub runs: usize,
}

/// A paragraph for tables whose runs were not all done by the program that tabulates them; none where they were.
#[must_use]
pub fn remark(builds: &[BuildRuns]) -> Option<String> {
    let here = Build::this();
    if builds.iter().all(|of| of.build == here) {
        return None;
    }
    let each = builds
        .iter()
        .map(|of| format!("{} by {}", of.runs, of.build));
    let each: Vec<String> = each.collect();
    Some(format!(
        "**Made by another build than these tables, or by several, as --accept-build allowed.** Runs: {}. Tabulated \
         by {here}.",
        each.join("; ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_is_named() {
        let here = Build::this();
        assert_eq!(here.differences(&here), Vec::<String>::new());
        let there = Build {
            results_version: 0,
            build: "1a2b3c4d".to_owned(),
            ..here.clone()
        };
        let version = format!("the version of results is 0 there and {RESULTS_VERSION} here");
        let build = format!("the build is 1a2b3c4d there and {BUILD} here");
        assert_eq!(there.differences(&here), [version, build]);
    }

    #[test]
    fn tables_of_one_build_need_no_remark() {
        let here = Build::this();
        let other = Build {
            arithmetic: "00000000".to_owned(),
            ..here.clone()
        };
        let of = |build: &Build, runs| BuildRuns {
            build: build.clone(),
            runs,
        };
        assert_eq!(remark(&[of(&here, 3)]), None);
        assert_eq!(remark(&[]), None);
        for builds in [vec![of(&other, 3)], vec![of(&other, 2), of(&here, 1)]] {
            let said = remark(&builds).unwrap();
            for of in &builds {
                assert!(
                    said.contains(&format!("{} by {}", of.runs, of.build)),
                    "{said}"
                );
            }
        }
    }

    #[test]
    fn a_build_is_eight_digits() {
        assert_eq!(BUILD.len(), 8);
        assert!(BUILD.chars().all(|c| c.is_ascii_hexdigit()));
    }
}
