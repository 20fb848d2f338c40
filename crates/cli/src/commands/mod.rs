//! The subcommands.

mod check;
mod filter;
mod replay;
mod run;
mod schema;
mod tables;

pub use check::check;
pub use filter::filter;
pub use replay::replay;
pub use run::run;
pub use schema::{schema, schema_text};
pub use tables::tables;
