//! The subcommands.

mod check;
mod completions;
mod consistency;
mod export;
mod filter;
mod mesh;
mod new;
mod replay;
mod run;
mod schema;
mod study;
mod sweep;
mod tables;

pub use check::check;
pub use completions::completions;
pub use consistency::consistency;
pub use export::export;
pub use filter::filter;
pub use mesh::mesh;
pub use new::new;
pub use replay::replay;
pub use run::run;
pub use schema::{schema, schema_text};
pub use sweep::sweep;
pub use tables::tables;
