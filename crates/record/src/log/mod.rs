//! Recorded logs: the filter over controls and measurements from any source.
//!
//! A log is JSON lines: a header, then a line a step. `docs/log.md` is the reference of the format.

mod estimates;
mod explain;
mod format;
mod header;
mod lines;
mod read;
mod record;
mod replay;
mod source;
mod summary;
mod trajectory;

pub use estimates::{EstimateErrors, EstimateLine};
pub use format::{FORMAT, LogFilter, LogHeader, LogStep, LogTruth, VERSION};
pub use read::LogReader;
pub use record::{LOG_FILE, LogRecorder};
pub use replay::{FilterChoice, GateChoice, Replay, TailPolicy, filter_log};
pub use summary::{ReplayErrors, ReplayNumbers, ReplaySummary};
pub use trajectory::Trajectory;
