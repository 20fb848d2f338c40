//! Overrides of a document by tables of another, whose keys are paths into it.

use std::collections::HashMap;
use std::fmt::Display;
use std::ops::Range;

use adslam_diagnostics::InputError;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::document::{Document, Source, in_order, parse, table_at};
use crate::meaning::meaning;
use crate::overrides;

/// The longest list that a file may hold.
pub const LONGEST_LIST: usize = 100_000;

/// A table of overrides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layer {
    /// Its path, such as `experiments[0].set`.
    table: String,
    /// Where each key has a list: which element holds, for each key.
    elements: Option<Vec<(String, usize)>>,
}

/// An override: the number of its layer, and its key.
pub type OverrideId = (usize, String);

/// Layers of overrides, later ones over earlier ones.
///
/// Their values keep their places: in the merged tables a span of the overlay is moved behind the
/// base's text, so that every span says which of the two it belongs to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Overlay {
    pub(super) source: Source,
    layers: Vec<Layer>,
    /// Tables in which one of several keys is chosen: setting another key there chooses that one.
    choices: &'static [&'static str],
    /// An override to leave out, to find out whether it is to blame.
    without: Option<OverrideId>,
}

/// An override where it stands in its file.
struct Placed<'a, 'i> {
    layer: usize,
    key: &'a Spanned<DeString<'i>>,
    value: &'a Spanned<DeValue<'i>>,
    /// Where to point: at key and value, or at the element of a list that holds.
    span: Range<usize>,
}

impl Layer {
    /// The table at `path`, whose values hold as they are.
    pub fn of_values(path: impl Into<String>) -> Self {
        Self {
            table: path.into(),
            elements: None,
        }
    }

    /// The table of lists at `path`, of each of whose keys one element holds.
    pub fn of_elements(path: impl Into<String>, elements: Vec<(String, usize)>) -> Self {
        Self {
            table: path.into(),
            elements: Some(elements),
        }
    }

    /// The path of the table.
    pub fn table(&self) -> &str {
        &self.table
    }
}

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

impl Overlay {
    /// The overrides, in the order in which they are laid over.
    fn placed<'a, 'i>(&self, tables: &'a DeTable<'i>) -> Vec<Placed<'a, 'i>> {
        let mut all = Vec::new();
        for (number, layer) in self.layers.iter().enumerate() {
            for (key, value) in table_at(tables, &layer.table)
                .into_iter()
                .flat_map(in_order)
            {
                let (value, span) = match &layer.elements {
                    None => (value, key.span().start..value.span().end),
                    Some(chosen) => {
                        let index = chosen
                            .iter()
                            .find(|(name, _)| key.get_ref() == name.as_str());
                        let list = value.get_ref().as_array();
                        let element = index.zip(list).and_then(|((_, at), list)| list.get(*at));
                        let Some(element) = element else { continue };
                        (element, element.span())
                    }
                };
                all.push(Placed {
                    layer: number,
                    key,
                    value,
                    span,
                });
            }
        }
        all
    }

    /// Lays the overrides over the tables of `base`, their spans moved by `offset`.
    pub(super) fn lay_over<'i>(
        &'i self,
        root: &mut DeTable<'i>,
        base: &Source,
        offset: usize,
    ) -> Result<(), InputError> {
        let tables = parse(&self.source)?;
        let Source { path, text } = &self.source;
        for Placed {
            layer, key, value, ..
        } in self.placed(&tables)
        {
            let name = key.get_ref();
            let is_left_out = |(number, key): &OverrideId| *number == layer && name == key.as_str();
            if self.without.as_ref().is_some_and(is_left_out) {
                continue;
            }
            if self.layers[layer].elements.is_none() {
                refuse_unquoted(&self.source, key, value)?;
            }
            let value = overrides::shifted(value, offset);
            let span = overrides::moved(key.span(), offset);
            overrides::set(root, name, span, value, self.choices).map_err(|in_the_way| {
                let base = base.path.display();
                InputError::in_text(
                    path,
                    text,
                    key.span(),
                    format!("there is no `{name}` to set"),
                )
                .with_label("leads nowhere")
                .with_help(format!("`{in_the_way}` in {base} has no such part"))
            })?;
        }
        Ok(())
    }
}

/// A path without quotes is read as tables in tables.
fn refuse_unquoted(
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
