//! consistency.md: a table for each experiment.

use std::fmt::Write;

use comfy_table::{Cell, CellAlignment, Table, presets};

use super::{CHI_SQUARED_CONFIDENCE, ConsistencyCell, ConsistencyResults, Judgement, Measure};
use crate::provenance::remark;

/// The results as Markdown.
pub(super) fn markdown(results: &ConsistencyResults) -> String {
    let mut text = format!("# {}\n\n", results.title);
    let missing: usize = results.cells.iter().map(|c| results.runs - c.runs).sum();
    if missing > 0 {
        let _ = writeln!(text, "**Incomplete: {missing} runs failed.**\n");
    }
    let last_seed = results.first_seed.wrapping_add(results.runs as u64 - 1);
    let _ = writeln!(
        text,
        "Each cell with the seeds {} to {last_seed}. Mean over steps and runs, divided by the degrees of \
         freedom, so that 1 is consistent; in brackets the part of the steps at which the mean over the runs \
         lies within the {:.0} % interval of χ². **Bold**: the mean over the steps lies outside, with ▲ where \
         the filter is over-confident and ▼ where it is cautious. Features outside: those whose own mean NEES lies \
         outside the interval of the features'. Errors are means over steps and runs (rad and \
         cm together, the drift floor in cm).\n",
        results.first_seed,
        CHI_SQUARED_CONFIDENCE * 100.0,
    );
    if let Some(remark) = remark(&results.builds) {
        let _ = writeln!(text, "{remark}\n");
    }
    for label in results.labels() {
        let cells = results.cells.iter().filter(|cell| cell.label == label);
        let cells: Vec<&ConsistencyCell> = cells.collect();
        let _ = writeln!(text, "## {label}\n\n{}\n", table(&cells));
    }
    text
}

fn table(cells: &[&ConsistencyCell]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN);
    let mut head = vec!["Estimator".to_owned(), "Planner".to_owned()];
    head.extend(Measure::ALL.map(|measure| {
        let interval = cells
            .iter()
            .find_map(|cell| cell.judgement(measure))
            .filter(|_| measure != Measure::FeatureNis)
            .map_or(String::new(), |j| {
                format!(" ({:.3}–{:.3})", j.interval.low, j.interval.high)
            });
        format!("{}{interval}", measure.title())
    }));
    head.push("Features outside".to_owned());
    head.extend(["Pose error", "Drift floor", "Object-relative"].map(str::to_owned));
    table.set_header(head);
    for cell in cells {
        let mut row = vec![
            Cell::new(cell.estimator.to_string()),
            Cell::new(cell.planner.to_string()),
        ];
        let number = |text: String| Cell::new(text).set_alignment(CellAlignment::Right);
        row.extend(Measure::ALL.map(|measure| number(shown(cell.judgement(measure)))));
        let (outside, all) = (cell.features_outside(), cell.nees_of_features.len());
        row.push(number(format!("{outside} of {all}")));
        for error in [cell.pose_error, cell.drift_floor, cell.relative_pose_error] {
            row.push(number(
                error.map_or("–".to_owned(), |error| format!("{error:.3}")),
            ));
        }
        table.add_row(row);
    }
    table
}

fn shown(judgement: Option<&Judgement>) -> String {
    use super::Verdict;
    let Some(j) = judgement else {
        return "–".to_owned();
    };
    let inside = format!("({:.0} %)", j.steps_inside * 100.0);
    match j.verdict {
        Verdict::Consistent => format!("{:.3} {inside}", j.mean),
        Verdict::OverConfident => format!("**{:.3} ▲** {inside}", j.mean),
        Verdict::Cautious => format!("**{:.3} ▼** {inside}", j.mean),
    }
}
