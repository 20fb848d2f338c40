//! The subcommands.

mod check;
mod filter;
mod run;
mod tables;

pub use check::check;
pub use filter::filter;
pub use run::run;
pub use tables::tables;
