//! The subcommands.

mod check;
mod filter;
mod mesh;
mod replay;
mod run;
mod tables;

pub use check::check;
pub use filter::filter;
pub use mesh::mesh;
pub use replay::replay;
pub use run::run;
pub use tables::tables;
