//! Documents with overrides from others, and the tables that these come from.

use std::collections::HashMap;
use std::fmt::Display;
use std::ops::Range;

use adslam_diagnostics::InputError;
use toml::Spanned;
use toml::de::DeValue;

use crate::document::Document;
use crate::meaning::meaning;
use crate::overlay::{Layer, Overlay, OverrideId, Placed};
use crate::tables::{Source, in_order, parse, refuse_unquoted, table_at};

/// The longest list that a file may hold.
pub const LONGEST_LIST: usize = 100_000;

impl Document {
    /// This document with layers of overrides from `other`, later ones over earlier ones. `choices` are the paths of
    /// tables in which one of several keys is chosen: setting another key there chooses that one.
    pub fn with_overrides(
        &self,
        other: &Self,
        layers: Vec<Layer>,
        choices: &'static [&'static str],
    ) -> Self {
        let overlay = Overlay {
            source: other.base.clone(),
            layers,
            choices,
            without: None,
        };
        Self {
            base: self.base.clone(),
            overlay: Some(overlay),
        }
    }

    /// Every override of this document.
    pub fn overrides(&self) -> Vec<OverrideId> {
        let Some(overlay) = &self.overlay else {
            return Vec::new();
        };
        let Ok(tables) = parse(&overlay.source) else {
            return Vec::new();
        };
        let placed = overlay.placed(&tables).into_iter();
        placed
            .map(|one| (one.layer, one.key.get_ref().to_string()))
            .collect()
    }

    /// The same document without one of its overrides.
    pub fn without_override(&self, one: &OverrideId) -> Self {
        let mut document = self.clone();
        if let Some(overlay) = &mut document.overlay {
            overlay.without = Some(one.clone());
        }
        document
    }

    /// An error about an override, pointing at it.
    pub fn error_at_override(&self, one: &OverrideId, message: impl Display) -> InputError {
        let Some(overlay) = &self.overlay else {
            return self.error_at("", message);
        };
        let span = parse(&overlay.source).ok().and_then(|tables| {
            let placed = overlay.placed(&tables).into_iter();
            let is_meant = |placed: &Placed<'_, '_>| {
                placed.layer == one.0 && *placed.key.get_ref() == one.1.as_str()
            };
            placed.filter(is_meant).map(|placed| placed.span).next()
        });
        let Source { path, text } = &overlay.source;
        InputError::in_text(path, text, span.unwrap_or(0..0), message)
    }

    /// The keys of a table of lists with the lengths of those, in the order of the file; empty where there is no
    /// such table.
    ///
    /// # Errors
    /// At a path that is not in quotes, and at a value that is no list, an empty one, one that is far too long,
    /// or one with an element twice.
    pub fn lists(&self, table: &str) -> Result<Vec<(String, usize)>, InputError> {
        let tables = self.tables()?;
        let text = |value: &Spanned<DeValue<'_>>| self.base.text.get(value.span());
        let at = |span: Range<usize>, message: String| {
            InputError::in_text(&self.base.path, &self.base.text, span, message)
        };
        let mut lists = Vec::new();
        for (key, value) in table_at(&tables, table).into_iter().flat_map(in_order) {
            refuse_unquoted(&self.base, key, value)?;
            let Some(elements) = value.get_ref().as_array() else {
                let message = format!("`{}` has one value, not a list of them", key.get_ref());
                return Err(at(value.span(), message).with_help(
                    "write a list, such as [1.0, 2.0]; what is the same for all belongs into [set]",
                ));
            };
            if elements.is_empty() || elements.len() > LONGEST_LIST {
                let message = format!("this list has {} values", elements.len());
                let help = format!("write at least one and at most {LONGEST_LIST}");
                return Err(at(value.span(), message).with_help(help));
            }
            let mut seen = HashMap::new();
            for element in elements {
                let Some(first) = seen.insert(meaning(element.get_ref()), element) else {
                    continue;
                };
                let message = match (text(first), text(element)) {
                    (Some(one), Some(other)) if one != other => {
                        format!("{one} and {other} are the same")
                    }
                    (_, twice) => format!("{} is listed twice", twice.unwrap_or("this")),
                };
                return Err(at(element.span(), message)
                    .with_help("list each value once; for more runs raise `runs`"));
            }
            lists.push((key.get_ref().to_string(), elements.len()));
        }
        Ok(lists)
    }
}
