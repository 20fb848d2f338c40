//! Programs that tests need and cargo does not bring, such as a browser.
//!
//! On a desk a test without its program says so and passes. Where `CI` is `true` it fails, as nobody reads
//! there what a passing test says, unless `ADSLAM_MAY_SKIP` lists what may be missing: `browser,evo`.

use std::env;
use std::ffi::OsStr;
use std::path::PathBuf;

/// A program that a test needs.
#[derive(Clone, Copy, Debug)]
pub struct Program<'a> {
    /// The word for it in `ADSLAM_MAY_SKIP`.
    pub what: &'a str,
    /// The environment variable that names its file, where it is not on the path.
    pub variable: &'a str,
    /// What it is called on the path, the first that is there counts.
    pub names: &'a [&'a str],
    /// The command that brings it.
    pub remedy: &'a str,
}

impl Program<'_> {
    /// Where it is. `None` where it is missing and may be: the test should end then.
    ///
    /// # Panics
    /// Where it is missing and `CI` is `true`, unless `ADSLAM_MAY_SKIP` lists it.
    #[must_use]
    #[expect(clippy::panic, reason = "it fails the test that asks")]
    pub fn find(&self) -> Option<PathBuf> {
        let found = env::var_os(self.variable)
            .filter(|named| !named.is_empty())
            .map(PathBuf::from)
            .or_else(|| on_path(self.names));
        if found.is_none() {
            let Self { what, remedy, .. } = self;
            let variables = [env::var_os("CI"), env::var_os("ADSLAM_MAY_SKIP")];
            let [ci, may_skip] = variables.each_ref().map(|value| value.as_deref());
            if !may_be_missing(what, ci, may_skip) {
                panic!("{what} is missing ({remedy}), and ADSLAM_MAY_SKIP does not list it");
            }
            println!("skipped: {what} is missing ({remedy})");
        }
        found
    }
}

/// Whether a test may pass without `what`.
fn may_be_missing(what: &str, ci: Option<&OsStr>, may_skip: Option<&OsStr>) -> bool {
    let listed = may_skip.and_then(OsStr::to_str).unwrap_or_default();
    ci.is_none_or(|ci| ci != "true") || listed.split(',').any(|word| word.trim() == what)
}

/// The first of these programs that is on the path.
fn on_path(names: &[&str]) -> Option<PathBuf> {
    let path = env::var_os("PATH")?;
    names
        .iter()
        .flat_map(|name| env::split_paths(&path).map(move |folder| folder.join(name)))
        .find(|program| program.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ci_skips_only_what_is_listed() {
        let may = |ci: Option<&str>, listed: Option<&str>| {
            may_be_missing("evo", ci.map(OsStr::new), listed.map(OsStr::new))
        };
        assert!(may(None, None), "on a desk");
        assert!(may(Some("false"), None));
        assert!(!may(Some("true"), None));
        assert!(!may(Some("true"), Some("")));
        assert!(!may(Some("true"), Some("browser,evolution")));
        assert!(may(Some("true"), Some("browser, evo")));
    }

    #[test]
    fn programs_are_found_on_the_path() {
        let cargo = on_path(&["no-such-program", "cargo"]).unwrap();
        assert_eq!(cargo.file_name().unwrap(), "cargo");
        assert_eq!(on_path(&["no-such-program"]), None);
    }
}
