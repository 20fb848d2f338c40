//! Overrides of a document by tables of another, whose keys are paths into it.

use std::ops::Range;

use adslam_diagnostics::InputError;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use crate::overrides;
use crate::tables::{Source, in_order, parse, refuse_unquoted, table_at};

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
    pub(super) layers: Vec<Layer>,
    /// Tables in which one of several keys is chosen: setting another key there chooses that one.
    pub(super) choices: &'static [&'static str],
    /// An override to leave out, to find out whether it is to blame.
    pub(super) without: Option<OverrideId>,
}

/// An override where it stands in its file.
pub(super) struct Placed<'a, 'i> {
    pub(super) layer: usize,
    pub(super) key: &'a Spanned<DeString<'i>>,
    pub(super) value: &'a Spanned<DeValue<'i>>,
    /// Where to point: at key and value, or at the element of a list that holds.
    pub(super) span: Range<usize>,
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

impl Overlay {
    /// The overrides, in the order in which they are laid over.
    pub(super) fn placed<'a, 'i>(&self, tables: &'a DeTable<'i>) -> Vec<Placed<'a, 'i>> {
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
