//! TOML documents that know where every key stands: read into types, with overrides of their keys laid over them, and
//! errors that point at the place and say what to write instead.
//!
//! Which keys there are is said by the types that read a document ([`Advice`]); nothing here knows a scenario.

mod document;
mod explain;
mod key_path;
mod meaning;
mod overlay;
mod overrides;
mod schema;

pub use document::Document;
pub use explain::unknown_choice;
pub use key_path::json_at;
pub use overlay::{LONGEST_LIST, Layer};
pub use schema::{Advice, paths, root_schema};
