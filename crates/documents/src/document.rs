//! A TOML file, or a TOML file with overrides from another, that knows where every key stands.

use std::fmt::Display;
use std::ops::Range;
use std::path::Path;

use adslam_diagnostics::{InputError, read_text};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use crate::explain::{Surroundings, explain};
use crate::overlay::Overlay;
use crate::tables::{Source, in_order, parse, table_at};
use crate::{Advice, key_path};

/// Files above this size are not ours: the largest that a person writes has a few kilobytes, and the
/// longest lists that are allowed make a megabyte or two.
const LARGEST_FILE: u64 = 4 << 20;

/// A TOML document, kept as its text: it is parsed again when a place is looked up, which happens
/// when something is wrong and costs next to nothing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Document {
    pub(super) base: Source,
    pub(super) overlay: Option<Overlay>,
}

impl Document {
    /// Takes `text`, which came from `path`.
    ///
    /// # Errors
    /// When it is empty or not TOML.
    pub fn parse(text: &str, path: &Path) -> Result<Self, InputError> {
        let base = Source {
            path: path.to_owned(),
            text: text.into(),
        };
        let document = Self {
            base,
            overlay: None,
        };
        let tables = document.tables()?;
        if tables.is_empty() {
            let message = format!("{} has no keys", path.display());
            return Err(InputError::about_file(path, message).with_help(
                "`adslam new` writes scenarios, configurations and sweeps to start from",
            ));
        }
        drop(tables);
        Ok(document)
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// When it cannot be read, is no text, is absurdly large, empty, or not TOML.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let remedy = "scenarios and configurations are short TOML texts; is it another file?";
        Self::parse(&read_text(path, LARGEST_FILE, remedy)?, path)
    }

    /// The file that the document, overrides apart, came from.
    pub fn path(&self) -> &Path {
        &self.base.path
    }

    /// The text of that file.
    pub fn text(&self) -> &str {
        &self.base.text
    }

    /// The keys of the document's root or, with a path, of the table there, in the order of the file.
    pub fn keys(&self, path: &str) -> Vec<String> {
        let Ok(tables) = self.tables() else {
            return Vec::new();
        };
        let table = if path.is_empty() {
            Some(&tables)
        } else {
            table_at(&tables, path)
        };
        let entries = table.into_iter().flat_map(in_order);
        entries.map(|(key, _)| key.get_ref().to_string()).collect()
    }

    /// The document as JSON.
    pub fn to_json(&self) -> Value {
        let json = self.tables().ok().and_then(|tables| {
            let root = Spanned::new(0..0, tables);
            Value::deserialize(Deserializer::from(root)).ok()
        });
        json.unwrap_or_default()
    }

    /// Reads the document as a `T`.
    ///
    /// # Errors
    /// When a key is unknown or missing, or a value is not what `T` wants there.
    pub fn deserialize<T: DeserializeOwned + JsonSchema>(&self) -> Result<T, InputError> {
        self.deserialize_without(&[])
    }

    /// Reads all but the tables at the paths `left_out` as a `T`.
    ///
    /// # Errors
    /// As [`Document::deserialize`].
    pub fn deserialize_without<T: DeserializeOwned + JsonSchema>(
        &self,
        left_out: &[String],
    ) -> Result<T, InputError> {
        let tables = self.tables()?;
        let mut rest = tables.clone();
        for path in left_out {
            remove(&mut rest, &key_path::steps(path));
        }
        T::deserialize(Deserializer::from(Spanned::new(0..0, rest)))
            .map_err(|error| self.explained::<T>(&error, &tables, ""))
    }

    /// Reads the table at `path` as a `T`; none where there is no such table.
    ///
    /// # Errors
    /// As [`Document::deserialize`], and where something else than a table is there.
    pub fn deserialize_at<T: DeserializeOwned + JsonSchema>(
        &self,
        path: &str,
    ) -> Result<Option<T>, InputError> {
        let tables = self.tables()?;
        let place = key_path::find(&tables, &key_path::steps(path)).filter(|place| place.whole);
        let Some(place) = place else {
            return Ok(None);
        };
        let Some(table) = place.value.get_ref().as_table() else {
            let error = self.error_at(path, format!("`{path}` is a table, not a value"));
            return Err(error.with_help(format!("write a table [{path}]")));
        };
        let root = Spanned::new(place.value.span(), table.clone());
        T::deserialize(Deserializer::from(root))
            .map(Some)
            .map_err(|error| self.explained::<T>(&error, &tables, path))
    }

    /// An error of serde in the table at `root`, which was to be a `T`.
    fn explained<T: JsonSchema>(
        &self,
        error: &toml::de::Error,
        tables: &DeTable<'_>,
        root: &str,
    ) -> InputError {
        let span = error.span().unwrap_or(0..0);
        let (path, keys) = key_path::at_span(tables, &span);
        let place = Surroundings {
            path: path
                .strip_prefix(root)
                .unwrap_or(&path)
                .trim_start_matches('.'),
            keys,
            advice: &Advice::of::<T>(),
        };
        explain(error, &place)
            .applied_to(self.error_in(span, ""))
            .with_help_if_none("docs/scenario.md says what belongs here")
    }

    /// An error about the value of the key at `path`, such as `object.points.positions_cm[3]`. It
    /// points at the value or, where that takes several lines, at its key; and where the key is
    /// not there (its value being a default) at the innermost table that is.
    pub fn error_at(&self, path: &str, message: impl Display) -> InputError {
        let steps = key_path::steps(path);
        let span = self.tables().ok().and_then(|tables| {
            let place = key_path::find(&tables, &steps)?;
            let value = place.value.span();
            let long = self.text_of(&value).is_none_or(|text| text.contains('\n'));
            Some(place.key.filter(|_| long).unwrap_or(value))
        });
        self.error_in(span.unwrap_or(0..0), message)
    }

    /// An error about the key at `path`, at which it points, or at the innermost table that is there.
    pub fn error_at_key(&self, path: &str, message: impl Display) -> InputError {
        let span = self.tables().ok().and_then(|tables| {
            let place = key_path::find(&tables, &key_path::steps(path))?;
            Some(place.key.unwrap_or(place.value.span()))
        });
        self.error_in(span.unwrap_or(0..0), message)
    }

    /// Whether a span of the merged tables lies in the overrides.
    fn in_overlay(&self, span: &Range<usize>) -> bool {
        span.start > self.base.text.len()
    }

    /// Whether `error` points at the document itself, not at one of its overrides.
    pub fn is_in_base(&self, error: &InputError) -> bool {
        error.path() == self.base.path
    }

    fn text_of(&self, span: &Range<usize>) -> Option<&str> {
        match &self.overlay {
            Some(overlay) if self.in_overlay(span) => {
                let offset = self.overlay_offset();
                overlay
                    .source
                    .text
                    .get(span.start - offset..span.end.checked_sub(offset)?)
            }
            _ => self.base.text.get(span.clone()),
        }
    }

    fn error_in(&self, span: Range<usize>, message: impl Display) -> InputError {
        match &self.overlay {
            Some(Overlay { source, .. }) if self.in_overlay(&span) => {
                let offset = self.overlay_offset();
                let span = span.start - offset..span.end.saturating_sub(offset);
                InputError::in_text(&source.path, &source.text, span, message)
            }
            _ => InputError::in_text(&self.base.path, &self.base.text, span, message),
        }
    }

    /// Where the overlay's text starts: one behind the base's end, which is still the base's.
    fn overlay_offset(&self) -> usize {
        self.base.text.len() + 1
    }

    pub(super) fn tables(&self) -> Result<DeTable<'_>, InputError> {
        let mut root = parse(&self.base)?;
        if let Some(overlay) = &self.overlay {
            overlay.lay_over(&mut root, &self.base, self.overlay_offset())?;
        }
        Ok(root)
    }
}

/// Takes the value at a path out of the table.
fn remove(table: &mut DeTable<'_>, path: &[key_path::Step]) {
    match path {
        [key_path::Step::Key(key)] => drop(table.remove(key.as_str())),
        [key_path::Step::Key(key), rest @ ..] => {
            let child = table.get_mut(key.as_str()).map(Spanned::get_mut);
            if let Some(DeValue::Table(child)) = child {
                remove(child, rest);
            }
        }
        _ => {}
    }
}
