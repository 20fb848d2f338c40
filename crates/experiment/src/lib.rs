//! Many runs: done once each in a folder that survives a kill, tabulated with intervals and tests, and compared with
//! what was published.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_diagnostics::Interrupt;
//! use adslam_experiment::run::simulate;
//! use adslam_names::PlannerName;
//! use adslam_record::NoObserver;
//! use adslam_scenario::Scenario;
//! use adslam_setup::Setup;
//!
//! let mut setup = Setup::new(&Scenario::load(Path::new("../../scenarios/polygon.toml"))?)?;
//! setup.model.steps = 4;
//! let run = simulate(&setup, PlannerName::LOCAL, 1, &Interrupt::new(), &mut NoObserver)?;
//! assert!(run.summary.pose_error_mean < 0.2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
