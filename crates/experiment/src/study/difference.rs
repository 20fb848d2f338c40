//! How two values differ, in words.

use serde_json::Value;

fn differs_below(path: &str, there: &Value, here: &Value) -> Option<String> {
    match (there, here) {
        (Value::Object(there), Value::Object(here)) => {
            let dot = if path.is_empty() { "" } else { "." };
            let new_keys = here.keys().filter(|key| !there.contains_key(*key));
            there.keys().chain(new_keys).find_map(|key| {
                let path = format!("{path}{dot}{key}");
                differs_optionally(&path, there.get(key), here.get(key))
            })
        }
        (Value::Array(there), Value::Array(here)) => {
            let longest = there.len().max(here.len());
            (0..longest).find_map(|index| {
                let path = format!("{path}[{index}]");
                differs_optionally(&path, there.get(index), here.get(index))
            })
        }
        _ if there == here => None,
        _ => {
            let (there, here) = (shortened(there), shortened(here));
            Some(format!("`{path}` is {there} there and {here} here"))
        }
    }
}

/// The first place at or below `path` at which two values differ, such as "`points[2].steps` is 5 there and 7 here";
/// none if they are equal.
pub(super) fn differs_optionally(
    path: &str,
    there: Option<&Value>,
    here: Option<&Value>,
) -> Option<String> {
    match (there, here) {
        (Some(there), Some(here)) => differs_below(path, there, here),
        (Some(there), None) => {
            let value = shortened(there);
            Some(format!("`{path}` is {value} there and not given here"))
        }
        (None, here) => {
            here.map(|here| format!("`{path}` is not given there and {} here", shortened(here)))
        }
    }
}

/// A value in a few words: a text may be a whole file.
fn shortened(value: &Value) -> String {
    const LONGEST: usize = 40;
    let text = value.to_string();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn the_first_difference_is_named_with_its_place() {
        let there = json!({"runs": 3, "points": [{"set": {"steps": 5}}, {"set": {"steps": 6}}]});
        let changed = |pointer: &str, value: Value| {
            let mut here = there.clone();
            *here.pointer_mut(pointer).unwrap() = value;
            differs_optionally("", Some(&there), Some(&here))
        };
        assert_eq!(differs_optionally("", Some(&there), Some(&there)), None);
        assert_eq!(
            changed("/points/1/set/steps", json!(7)).unwrap(),
            "`points[1].set.steps` is 6 there and 7 here"
        );
        assert_eq!(
            changed("/points/1/set", json!({})).unwrap(),
            "`points[1].set.steps` is 6 there and not given here"
        );
        let set = json!({"steps": 6, "name": "long ".repeat(20)});
        let said = changed("/points/1/set", set).unwrap();
        assert!(said.starts_with("`points[1].set.name` is not given there and \"long "));
        assert!(said.ends_with("… here"), "{said}");
        assert_eq!(
            changed("/points", json!([{"set": {"steps": 5}}])).unwrap(),
            "`points[1]` is {\"set\":{\"steps\":6}} there and not given here"
        );
    }
}
