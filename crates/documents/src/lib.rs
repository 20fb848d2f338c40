//! TOML documents that know where every key stands: read into types, with overrides of their keys laid over them, and
//! errors that point at the place and say what to write instead.
//!
//! Which keys there are is said by the types that read a document ([`Advice`]); nothing here knows a scenario.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_documents::Document;
//!
//! let text = "[sensor]\nrange_cm = 3.0\n";
//! let document = Document::parse(text, Path::new("a.toml"))?;
//! let error = document.error_at("sensor.range_cm", "too far");
//! assert_eq!((error.pointed_at(), error.line_and_column()), (Some("3.0"), Some((2, 12))));
//! # Ok::<(), adslam_diagnostics::InputError>(())
//! ```

mod document;
mod explain;
mod key_path;
mod layered;
mod meaning;
mod overlay;
mod overrides;
mod schema;
mod tables;

pub use document::Document;
pub use explain::unknown_choice;
pub use key_path::json_at;
pub use layered::LONGEST_LIST;
pub use overlay::Layer;
pub use schema::{Advice, paths, root_schema};
