//! The subcommands.

mod check;
mod export;
mod filter;
mod mesh;
mod replay;
mod run;
mod tables;

pub use check::check;
pub use export::export;
pub use filter::filter;
pub use mesh::mesh;
pub use replay::replay;
pub use run::run;
pub use tables::tables;
