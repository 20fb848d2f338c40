//! `adslam schema`

use adslam_diagnostics::Failure;
use adslam_scenario::FileKind;
use adslam_scenario::registry::Registry;
use adslam_scenario::schema::json_schema;

use crate::args::SchemaKind;
use crate::print::print;

/// Prints the JSON Schema of a kind of file.
///
/// # Errors
/// A standard output that cannot be written to.
pub fn schema(kind: SchemaKind, registry: &Registry) -> Result<(), Failure> {
    print(schema_text(kind.into(), registry).trim_end())
}

/// The JSON Schema of a kind of file as text that ends with a line break, as files do.
#[must_use]
pub fn schema_text(kind: FileKind, registry: &Registry) -> String {
    format!("{:#}\n", json_schema(kind, registry))
}
