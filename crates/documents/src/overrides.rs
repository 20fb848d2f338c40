//! Laying the overrides of a configuration over a scenario, each value keeping its place.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::key_path::{self, Step};

/// The longest path of an override; those of a scenario's keys are half as long.
const LONGEST_PATH: usize = 16;

/// Sets the key at `path` in `root` to `value`; `span` is where the path itself is written. Makes the tables on the way where they are
/// missing. Fails, with the part of the path that is in the way, where the path leads through
/// something that is neither a table nor an array with that element, or is longer than any
/// scenario's: tables in tables without end could not be let go of again.
pub(super) fn set<'i>(
    root: &mut DeTable<'i>,
    path: &str,
    span: Range<usize>,
    value: Spanned<DeValue<'i>>,
    choices: &[&str],
) -> Result<(), String> {
    let steps = key_path::steps(path);
    let mut node = Node::Table(root);
    let mut walked = String::new();
    let Some((last, way)) = steps.split_last() else {
        return Err(path.to_owned());
    };
    if let Some(within) = steps.get(..LONGEST_PATH)
        && steps.len() > LONGEST_PATH
    {
        let within: String = within.iter().map(ToString::to_string).collect();
        return Err(within.trim_start_matches('.').to_owned());
    }
    for step in way {
        if let (Node::Table(table), Step::Key(key)) = (&mut node, step)
            && choices.contains(&walked.as_str())
        {
            let chosen = table.remove_entry(key.as_str());
            table.clear();
            table.extend(chosen);
        }
        walked = format!("{walked}{step}").trim_start_matches('.').to_owned();
        let fresh = || Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
        let next = match (node, step) {
            (Node::Table(table), Step::Key(key)) => table
                .entry(Spanned::new(span.clone(), key.clone().into()))
                .or_insert_with(fresh),
            (Node::Array(array), Step::Element(index)) => {
                array.get_mut(*index).ok_or_else(|| walked.clone())?
            }
            _ => return Err(walked),
        };
        node = match next.get_mut() {
            DeValue::Table(table) => Node::Table(table),
            DeValue::Array(array) => Node::Array(array),
            _ => return Err(walked),
        };
    }
    match (node, last) {
        (Node::Table(table), Step::Key(key)) => {
            if choices.contains(&walked.as_str()) {
                table.clear();
            }
            // An insertion keeps the old key and its place, so that one has to go first.
            table.remove(key.as_str());
            table.insert(Spanned::new(span, key.clone().into()), value);
            Ok(())
        }
        (Node::Array(array), Step::Element(index)) => {
            *array.get_mut(*index).ok_or_else(|| path.to_owned())? = value;
            Ok(())
        }
        _ => Err(path.to_owned()),
    }
}

enum Node<'a, 'i> {
    Table(&'a mut DeTable<'i>),
    Array(&'a mut DeArray<'i>),
}

/// The value with every span moved by `offset` bytes.
pub(super) fn shifted<'i>(value: &Spanned<DeValue<'i>>, offset: usize) -> Spanned<DeValue<'i>> {
    let inner = match value.get_ref() {
        DeValue::Array(array) => {
            let mut copy = DeArray::new();
            for element in array.iter() {
                copy.push(shifted(element, offset));
            }
            DeValue::Array(copy)
        }
        DeValue::Table(table) => DeValue::Table(
            table
                .iter()
                .map(|(key, value)| {
                    let key = Spanned::new(moved(key.span(), offset), key.get_ref().clone());
                    (key, shifted(value, offset))
                })
                .collect(),
        ),
        other => other.clone(),
    };
    Spanned::new(moved(value.span(), offset), inner)
}

/// The span moved by `offset` bytes.
pub(super) fn moved(span: Range<usize>, offset: usize) -> Range<usize> {
    span.start + offset..span.end + offset
}
