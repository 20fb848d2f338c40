//! What the numbers were made on: the times depend on it, nothing else does.

use std::fmt;

use sysinfo::{CpuRefreshKind, RefreshKind, System};

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
        let what = RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing());
        let processor = System::new_with_specifics(what).ok().and_then(|system| {
            let brand = system.cpus().first()?.brand().trim().to_owned();
            (!brand.is_empty()).then_some(brand)
        });
        let system = System::long_os_version();
        Self {
            processor,
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            system: system.unwrap_or_else(|_| std::env::consts::OS.to_owned()),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let processor = self.processor.as_deref();
        let processor = processor.unwrap_or(std::env::consts::ARCH);
        let plural = if self.threads == 1 { "" } else { "s" };
        let Self {
            threads, system, ..
        } = self;
        write!(f, "{processor}, {threads} thread{plural}, {system}")
    }
}
