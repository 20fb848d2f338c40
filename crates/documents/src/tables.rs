//! The text of a document as tables.

use std::path::PathBuf;
use std::sync::Arc;

use adslam_diagnostics::InputError;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::explain::explain_syntax;
use crate::key_path;

/// A text and where it came from.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: Arc<str>,
}

/// The entries of a table, in the order of the file.
pub(super) fn in_order<'a, 'i>(
    table: &'a DeTable<'i>,
) -> Vec<(&'a Spanned<DeString<'i>>, &'a Spanned<DeValue<'i>>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries
}

pub(super) fn table_at<'a, 'i>(root: &'a DeTable<'i>, path: &str) -> Option<&'a DeTable<'i>> {
    let place = key_path::find(root, &key_path::steps(path))?;
    match place.value.get_ref() {
        DeValue::Table(table) if place.whole => Some(table),
        _ => None,
    }
}

pub(super) fn parse(source: &Source) -> Result<DeTable<'_>, InputError> {
    let parsed = DeTable::parse(&source.text).map_err(|error| {
        let span = error.span().unwrap_or(0..0);
        explain_syntax(&error).applied_to(InputError::in_text(&source.path, &source.text, span, ""))
    })?;
    Ok(parsed.into_inner())
}

/// A path without quotes is read as tables in tables.
pub(super) fn refuse_unquoted(
    source: &Source,
    key: &Spanned<DeString<'_>>,
    value: &Spanned<DeValue<'_>>,
) -> Result<(), InputError> {
    let Source { path, text } = source;
    let is_inline = || {
        text.get(value.span())
            .is_some_and(|text| text.starts_with('{'))
    };
    if !value.get_ref().is_table() || is_inline() {
        return Ok(());
    }
    let name = key.get_ref();
    let message = format!("the path that starts with `{name}` is not in quotes");
    Err(InputError::in_text(path, text, key.span(), message)
        .with_help(format!("put all of it in quotes: \"{name}.…\" = …")))
}
