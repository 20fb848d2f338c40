//! Recorded logs: the filter over controls and measurements from any source.
//!
//! A log is JSON lines: a header, then a line a step. `docs/log.md` is the reference of the format.

mod explain;
mod format;
mod lines;
mod read;
mod replay;

pub use format::{EstimateLine, FORMAT, LogHeader, LogStep, VERSION};
pub use read::LogReader;
pub use replay::{FilterChoice, Replay, ReplaySummary, TailPolicy, filter_log};
