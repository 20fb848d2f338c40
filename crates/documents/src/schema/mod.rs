//! What the types that read a file say of its keys.

mod advice;
mod paths;
mod tidy;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::Value;

pub use advice::Advice;
pub use paths::paths;

/// The JSON schema, draft 7, of a file that is read as a `T`, as editors of TOML make the best of it.
#[must_use]
pub fn root_schema<T: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft07().with_transform(RecursiveTransform(tidy::tidy));
    settings
        .into_generator()
        .into_root_schema_for::<T>()
        .to_value()
}
