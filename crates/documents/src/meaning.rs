//! Whether two values are the same, however they are written.

use toml::de::DeValue;

use super::tables::in_order;

/// A text that values have in common exactly if they mean the same, as 2, 2.0 and 0x2 do, and "a" and 'a'.
pub(super) fn meaning(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("{text:?}"),
        DeValue::Integer(written) => {
            let number = i128::from_str_radix(written.as_str(), written.radix());
            number.map_or_else(|_| written.to_string(), |number| number.to_string())
        }
        // Shown as an integer is where it is one. What is added makes 0 of -0.
        DeValue::Float(written) => match written.as_str().parse::<f64>() {
            Ok(number) => (number + 0.0).to_string(),
            Err(_) => written.to_string(),
        },
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(time) => time.to_string(),
        DeValue::Array(elements) => {
            let elements = elements.iter().map(|element| meaning(element.get_ref()));
            format!("[{}]", elements.collect::<Vec<_>>().join(","))
        }
        DeValue::Table(table) => {
            let entries = in_order(table).into_iter();
            let mut entries: Vec<String> = entries
                .map(|(key, value)| format!("{:?}:{}", key.get_ref(), meaning(value.get_ref())))
                .collect();
            entries.sort_unstable();
            format!("{{{}}}", entries.join(","))
        }
    }
}

#[cfg(test)]
mod tests {
    use toml::de::DeTable;

    use super::*;

    fn meaning_of(text: &str) -> String {
        let text = format!("key = {text}");
        let table = DeTable::parse(&text).unwrap();
        meaning(table.get_ref().get("key").unwrap().get_ref())
    }

    #[test]
    fn values_are_the_same_however_they_are_written() {
        for same in [
            &["2", "2.0", "+2", "0x2", "0b10", "20e-1"][..],
            &["1000", "1_000", "1e3"],
            &["0", "0.0", "-0.0"],
            &["0.1", "1e-1", "0.10"],
            &["10000000000000000", "1e16"],
            &["\"a\"", "'a'", "\"\\u0061\"", "\"\"\"a\"\"\""],
            &["[1, 2.0]", "[ 1.0, 2, ]"],
            &[
                "{ a = 1, b = 'x' }",
                "{ b = \"x\", a = 1.0 }",
                "{ \"a\" = 1, b = 'x' }",
            ],
            &["inf", "+inf"],
        ] {
            let first = meaning_of(same[0]);
            for other in same {
                assert_eq!(meaning_of(other), first, "{other}");
            }
        }
        let different = [
            "2",
            "\"2\"",
            "[2]",
            "[[2]]",
            "[2, 2]",
            "{ a = 2 }",
            "{ a = \"2\" }",
            "2.5",
            "-2",
            "true",
            "\"true\"",
            "\"a,b\"",
            "[\"a\", \"b\"]",
            "[\"a,b\"]",
            "[]",
            "{}",
            "\"\"",
            "inf",
            "-inf",
            "nan",
            "2000-01-01",
        ];
        let meanings: std::collections::HashSet<String> =
            different.iter().map(|text| meaning_of(text)).collect();
        assert_eq!(meanings.len(), different.len());
    }
}
