//! Many runs: done once each in a folder that survives a kill, tabulated with intervals and tests, and compared with
//! what was published.

mod check;
pub mod consistency;
pub mod provenance;
pub mod run;
pub mod study;
pub mod sweep;
pub mod tables;
#[cfg(test)]
mod test_files;

pub use check::{CheckedFile, check_file};
