//! The command `adslam` as its users meet it: what it writes, what it says, and how it ends.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

mod bad_log_headers;
mod bad_logs;
mod bad_meshes;
mod bad_output;
mod bad_scenarios;
mod bad_tables;
mod check;
mod consistency;
mod documents;
mod evo;
mod export;
mod failures;
mod filter;
mod filter_sources;
mod filter_truth;
mod help;
#[cfg(unix)]
mod interrupt;
mod json;
#[cfg(unix)]
mod killed;
mod mesh;
mod mesh_cases;
mod new;
mod replay;
mod run;
mod run_files;
mod run_folder;
#[cfg(unix)]
mod run_folder_killed;
mod schema;
mod support;
mod sweep;
mod sweep_folder;
mod tables;
mod warnings;
