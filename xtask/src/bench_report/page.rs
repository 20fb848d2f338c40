//! The section of docs/performance.md that is measured.

use std::fmt::Write;

use super::measured::Report;

const CASES: [&str; 5] = ["polygon", "heart50", "heart200", "heart500", "heart1000"];
const START: &str = "<!-- measured: cargo xtask bench-report -->";
const END: &str = "<!-- end of what is measured -->";

/// The page with its marked section written anew.
///
/// # Errors
/// A page without the marks.
pub fn renew(page: &str, report: &Report, machine: &str) -> Result<String, String> {
    let marks = page.find(START).zip(page.find(END));
    let Some((start, end)) = marks.filter(|(start, end)| start < end) else {
        return Err(format!("lacks the lines\n{START}\n{END}"));
    };
    let (before, after) = (&page[..start + START.len()], &page[end..]);
    Ok(format!("{before}\n\n{}\n{after}", section(report, machine)))
}

fn section(report: &Report, machine: &str) -> String {
    let mut text = format!(
        "{machine}. Dense matrix product, one thread: {:.1} Gflop/s. Times are medians, of one call.\n",
        report.matrix_product_gflops
    );
    for (group, title) in [
        ("local_decision", "Scoring of a local decision"),
        ("combined_decision", "Scoring of a combined decision"),
    ] {
        let columns = [
            ("fast, ms", Cell::Time("fast")),
            ("direct, ms", Cell::Time("direct")),
            ("textbook, ms", Cell::Time("textbook")),
            ("direct : fast", Cell::Ratio("direct", "fast")),
            ("fast, Gflop/s", Cell::Rate("fast")),
            ("of the product's rate", Cell::Share("fast")),
        ];
        table(&mut text, report, group, title, &columns);
    }
    let columns = [
        ("local, ms", Cell::Time("local")),
        ("combined, ms", Cell::Time("combined")),
        ("global, ms", Cell::Time("global")),
    ];
    let title = "Whole decisions, clearance and visibility included";
    table(&mut text, report, "whole_decision", title, &columns);
    let columns = [
        ("clearance, ms", Cell::Time("clearance")),
        ("visibility, ms", Cell::Time("visibility")),
    ];
    let title = "What a local decision needs besides scoring";
    table(&mut text, report, "decision_parts", title, &columns);
    for (group, title) in [
        ("ekf_step", "One step of the filter, all pairs measured"),
        ("structure_update", "The update with all pairs alone"),
        (
            "feature_update",
            "The update with what the sensor sees alone",
        ),
    ] {
        let columns = [
            ("fast, ms", Cell::Time("fast")),
            ("two threads, ms", Cell::Time("fast_two_threads")),
            ("speed-up", Cell::Ratio("fast", "fast_two_threads")),
            ("direct, ms", Cell::Time("direct")),
            ("textbook, ms", Cell::Time("textbook")),
            ("fast, Gflop/s", Cell::Rate("fast")),
            ("of the product's rate", Cell::Share("fast")),
        ];
        table(&mut text, report, group, title, &columns);
    }
    let columns = [
        ("fast, ms", Cell::Time("fast")),
        ("one by one, ms", Cell::Time("one_by_one")),
        ("one by one : fast", Cell::Ratio("one_by_one", "fast")),
    ];
    let title = "All lines of sight from a lattice of places";
    table(&mut text, report, "visibility", title, &columns);
    text
}

/// What a column shows of a variant, or of two.
enum Cell {
    Time(&'static str),
    Ratio(&'static str, &'static str),
    Rate(&'static str),
    Share(&'static str),
}

impl Cell {
    fn show(&self, report: &Report, group: &str, case: &str) -> Option<String> {
        let measured = |variant| report.get(group, variant, case);
        Some(match self {
            Self::Time(variant) => significant(measured(variant)?.median_ms),
            Self::Ratio(over, under) => {
                format!(
                    "{:.1}",
                    measured(over)?.median_ms / measured(under)?.median_ms
                )
            }
            Self::Rate(variant) => significant(measured(variant)?.gflops?),
            Self::Share(variant) => {
                let share = measured(variant)?.gflops? / report.matrix_product_gflops;
                format!("{:.0} %", 100.0 * share)
            }
        })
    }
}

/// A heading and a table of the cases that were run; nothing if none was, and no empty columns.
fn table(text: &mut String, report: &Report, group: &str, title: &str, columns: &[(&str, Cell)]) {
    let of_case = |case, cell: &Cell| cell.show(report, group, case);
    let columns: Vec<&(&str, Cell)> = columns
        .iter()
        .filter(|(_, cell)| CASES.iter().any(|case| of_case(case, cell).is_some()))
        .collect();
    if columns.is_empty() {
        return;
    }
    let heads: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "\n### {title} (`{group}`)\n");
    let _ = writeln!(text, "| case | {} |", heads.join(" | "));
    let _ = writeln!(text, "| --- |{}", " ---: |".repeat(heads.len()));
    for case in CASES {
        let cells: Vec<Option<String>> = columns
            .iter()
            .map(|(_, cell)| of_case(case, cell))
            .collect();
        if cells.iter().any(Option::is_some) {
            let cells: Vec<String> = cells.into_iter().map(Option::unwrap_or_default).collect();
            let _ = writeln!(text, "| {case} | {} |", cells.join(" | "));
        }
    }
}

/// Three significant digits.
fn significant(value: f64) -> String {
    let digits = match value {
        v if v < 0.1 => 4,
        v if v < 1.0 => 3,
        v if v < 10.0 => 2,
        v if v < 100.0 => 1,
        _ => 0,
    };
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_marked_section_changes() {
        let page = format!("before\n{START}\nold\n{END}\nafter\n");
        let renewed = renew(&page, &Report::default(), "A machine").unwrap();
        assert!(renewed.starts_with("before\n") && renewed.ends_with("\nafter\n"));
        assert!(renewed.contains("A machine. Dense") && !renewed.contains("old"));
        let again = renew(&renewed, &Report::default(), "A machine").unwrap();
        assert_eq!(renewed, again);
        assert!(renew("no marks", &Report::default(), "").is_err());
    }

    #[test]
    fn three_digits_are_shown() {
        let shown = [0.012_34, 0.1234, 1.234, 12.34, 123.4].map(significant);
        assert_eq!(shown, ["0.0123", "0.123", "1.23", "12.3", "123"]);
    }
}
