//! Whatever a file holds, reading it ends with a scenario or an error that can be shown.

use proptest::prelude::*;

use super::written::given_back;
use super::{HEART, POLYGON, ROTATING, miette_report, parsed};

fn survives(text: &str) {
    match parsed(text) {
        Ok(scenario) => given_back(&scenario),
        Err(error) => drop((miette_report(&error), error.pointed_at().map(str::len))),
    }
}

/// Pieces that upset parsers more than random letters do.
const PIECES: [&str; 16] = [
    "[",
    "]",
    "=",
    "\"",
    "nan",
    "-inf",
    "1e400",
    "-1",
    "\n",
    "[[",
    "{",
    "}",
    "é",
    "\0",
    "99999999999999999999",
    ".",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in "\\PC*") {
        survives(&text);
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        survives(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_shipped_file_with_pieces_cut_and_put(
        file in prop::sample::select(vec![POLYGON, HEART, ROTATING]),
        edits in prop::collection::vec(
            (any::<prop::sample::Index>(), 0_usize..40, prop::sample::select(PIECES.to_vec())), 1..5),
    ) {
        let mut characters: Vec<char> = file.chars().collect();
        for (place, cut, put) in edits {
            let start = place.index(characters.len());
            let end = (start + cut).min(characters.len());
            characters.splice(start..end, put.chars());
        }
        survives(&characters.iter().collect::<String>());
    }

    #[test]
    fn a_shipped_file_with_other_values(
        file in prop::sample::select(vec![POLYGON, HEART, ROTATING]),
        line in any::<prop::sample::Index>(),
        value in prop::sample::select(vec![
            "0", "-1", "1e-300", "1e300", "nan", "[]", "[[]]", "{}", "\"\"", "true", "1979-05-27",
            "[1, 2, 3]", "[1e6, 1e6, 1e6]", "9223372036854775807", "-9223372036854775808", "{ x = {} }",
        ]),
    ) {
        let mut lines: Vec<String> = file.lines().map(str::to_owned).collect();
        let assignments: Vec<usize> =
            (0..lines.len()).filter(|&i| lines[i].contains(" = ")).collect();
        let line = assignments[line.index(assignments.len())];
        let key = lines[line].split(" = ").next().unwrap_or_default().to_owned();
        lines[line] = format!("{key} = {value}");
        survives(&lines.join("\n"));
    }
}
