//! Where a key of a TOML document stands in its text.

use std::fmt;
use std::ops::Range;

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// One step from a table or an array to what it holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Step {
    /// A key of a table.
    Key(String),
    /// An element of an array, from 0.
    Element(usize),
}

/// The steps of a path such as `object.points.positions_cm[3]`, from the root.
///
/// A path that is no path (an empty key, a bracket without a number) gives a key that no document
/// of ours has, and so is reported as unknown by whoever looks it up.
pub(super) fn steps(path: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (key, indices) = part.split_once('[').unwrap_or((part, ""));
        let numbers: Option<Vec<usize>> = indices
            .split_terminator('[')
            .map(|index| {
                index
                    .strip_suffix(']')
                    .and_then(|number| number.parse().ok())
            })
            .collect();
        match numbers {
            Some(numbers) => {
                steps.push(Step::Key(key.to_owned()));
                steps.extend(numbers.into_iter().map(Step::Element));
            }
            None => steps.push(Step::Key(part.to_owned())),
        }
    }
    steps
}

/// A place in a document.
pub(super) struct Place<'a, 'i> {
    /// Where the key stands that leads to the value, if it is not an element of an array.
    pub(super) key: Option<Range<usize>>,
    /// The value.
    pub(super) value: &'a Spanned<DeValue<'i>>,
    /// Whether this is where the whole path leads, not only its beginning.
    pub(super) whole: bool,
}

/// The place that all of `path` leads to, or else the last one that is there; none when not even
/// the first key is.
pub(super) fn find<'a, 'i>(root: &'a DeTable<'i>, path: &[Step]) -> Option<Place<'a, 'i>> {
    let (first, rest) = path.split_first()?;
    let Step::Key(first) = first else { return None };
    let mut place = child(root, first)?;
    for step in rest {
        let next = match (step, place.value.get_ref()) {
            (Step::Key(key), DeValue::Table(table)) => child(table, key),
            (Step::Element(index), DeValue::Array(array)) => array.get(*index).map(|value| Place {
                key: None,
                value,
                whole: true,
            }),
            _ => None,
        };
        match next {
            Some(next) => place = next,
            None => {
                place.whole = false;
                break;
            }
        }
    }
    Some(place)
}

/// What all of `path` leads to in a document as JSON; none where it leads nowhere.
pub fn json_at<'a>(root: &'a Value, path: &str) -> Option<&'a Value> {
    steps(path).iter().try_fold(root, |value, step| match step {
        Step::Key(key) => value.get(key),
        Step::Element(index) => value.get(index),
    })
}

/// The path of the value that stands at `span`, or of the table that has a key there, and the keys of
/// that table; the root where there is none.
pub(super) fn at_span<'a>(root: &'a DeTable<'_>, span: &Range<usize>) -> (String, Vec<&'a str>) {
    let mut values = Vec::new();
    values_below(root, "", &mut values);
    let table = |value: &'a Spanned<DeValue<'_>>| value.get_ref().as_table();
    let has_key = |table: &DeTable<'_>| table.keys().any(|key| key.span() == *span);
    // A table whose head is nowhere written stands where its key does, so values go first.
    let (path, table) = values
        .iter()
        .find(|(_, value)| value.span() == *span)
        .or_else(|| {
            values
                .iter()
                .find(|(_, value)| table(value).is_some_and(has_key))
        })
        .map_or((String::new(), Some(root)), |(path, value)| {
            (path.clone(), table(value))
        });
    let keys = table.into_iter().flat_map(DeTable::keys);
    (path, keys.map(|key| &**key.get_ref()).collect())
}

/// Every value below `table`, which is at `path`.
fn values_below<'a, 'i>(
    table: &'a DeTable<'i>,
    path: &str,
    values: &mut Vec<(String, &'a Spanned<DeValue<'i>>)>,
) {
    let dot = if path.is_empty() { "" } else { "." };
    for (key, value) in table {
        note_value(value, format!("{path}{dot}{}", key.get_ref()), values);
    }
}

fn note_value<'a, 'i>(
    value: &'a Spanned<DeValue<'i>>,
    path: String,
    values: &mut Vec<(String, &'a Spanned<DeValue<'i>>)>,
) {
    match value.get_ref() {
        DeValue::Table(table) => values_below(table, &path, values),
        DeValue::Array(array) => {
            for (index, element) in array.iter().enumerate() {
                note_value(element, format!("{path}[{index}]"), values);
            }
        }
        _ => {}
    }
    values.push((path, value));
}

fn child<'a, 'i>(table: &'a DeTable<'i>, key: &str) -> Option<Place<'a, 'i>> {
    let (key, value) = table.iter().find(|(known, _)| known.get_ref() == key)?;
    Some(Place {
        key: Some(key.span()),
        value,
        whole: true,
    })
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key(key) => write!(f, ".{key}"),
            Self::Element(index) => write!(f, "[{index}]"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_cut_into_steps() {
        let key = |key: &str| Step::Key(key.to_owned());
        assert_eq!(
            steps("a.b_cm[3][10].c"),
            [
                key("a"),
                key("b_cm"),
                Step::Element(3),
                Step::Element(10),
                key("c")
            ]
        );
    }

    #[test]
    fn what_is_no_path_is_an_unknown_key() {
        for odd in [
            "", "[", "a[", "a[]", "a[x]", "a]", "a[1", "a..b", "[[", "a[-1]",
        ] {
            assert!(!steps(odd).is_empty(), "{odd}");
        }
        assert_eq!(steps("a[x]"), [Step::Key("a[x]".to_owned())]);
    }

    #[test]
    fn finds_what_is_there_or_the_last_that_is() {
        let text = "[a.b]\nc = [1, [2, 3]]\n";
        let table = DeTable::parse(text).unwrap();
        let at = |path| find(table.get_ref(), &steps(path)).map(|p| &text[p.value.span()]);
        assert_eq!(at("a.b.c[1][0]"), Some("2"));
        assert_eq!(at("a.b.c[7]"), Some("[1, [2, 3]]"));
        assert_eq!(at("a.b.d"), Some("[a.b]"));
        assert_eq!(at("x"), None);
    }
}
