//! What the numbers were made on: the times depend on it, nothing else does.

use std::{env, fmt, fs, thread};

/// A machine, as far as it matters to those who read its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The processor by its maker's name; none where the system does not say.
    pub processor: Option<String>,
    /// Threads that run at a time.
    pub threads: usize,
    /// The operating system.
    pub system: String,
}

impl Machine {
    /// The one that this runs on.
    #[must_use]
    pub fn this() -> Self {
        let system = value_in("/etc/os-release", "PRETTY_NAME", '=');
        Self {
            processor: value_in("/proc/cpuinfo", "model name", ':'),
            threads: thread::available_parallelism().map_or(1, usize::from),
            system: system.unwrap_or_else(|| env::consts::OS.to_owned()),
        }
    }
}

/// The value of the first line `KEY separator VALUE` of a file; `None` where the system has no such file or line.
fn value_in(path: &str, key: &str, separator: char) -> Option<String> {
    let text = fs::read_to_string(path).ok()?;
    let mut pairs = text.lines().filter_map(|line| line.split_once(separator));
    let (_, value) = pairs.find(|(name, _)| name.trim() == key)?;
    let value = value.trim().trim_matches('"');
    (!value.is_empty()).then(|| value.to_owned())
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let processor = self.processor.as_deref();
        let processor = processor.unwrap_or(env::consts::ARCH);
        let plural = if self.threads == 1 { "" } else { "s" };
        let Self {
            threads, system, ..
        } = self;
        write!(f, "{processor}, {threads} thread{plural}, {system}")
    }
}
