//! Tables for people: in the terminal, and as Markdown.

use std::fmt::Write;

use comfy_table::{CellAlignment, Table, TableStyle, presets};

use super::{Agreement, ExperimentTables, NEAR_WITHIN, ResultCell, ResultTable, Tables};
use crate::provenance::remark;

/// How the tables are set.
#[derive(Clone, Copy)]
struct Setting {
    style: TableStyle,
    heading: &'static str,
    /// Between a published value and ours where both together are wide.
    wide_separator: &'static str,
}

/// All tables, drawn with lines.
#[must_use]
pub fn terminal(tables: &Tables) -> String {
    let setting = Setting {
        style: presets::UTF8_FULL_CONDENSED,
        heading: "",
        wide_separator: "\n",
    };
    let mut text = String::new();
    if !tables.is_complete() {
        text += "Incomplete: some runs failed or were not done.\n\n";
    }
    text += "In each cell: the published value, then ours, the mean over the runs (range).";
    if is_compared(tables) {
        let _ = write!(text, " {}", legend());
    }
    format!("{text}\n\n{}", render(tables, setting))
}

/// All tables as Markdown.
#[must_use]
pub fn markdown(tables: &Tables) -> String {
    let setting = Setting {
        style: presets::ASCII_MARKDOWN,
        heading: "## ",
        wide_separator: " / ",
    };
    let mut text = format!("# {}\n\n", tables.title);
    if !tables.is_complete() {
        text.push_str("**Incomplete: some runs failed or were not done.**\n\n");
    }
    let last_seed = tables.first_seed.wrapping_add(tables.runs as u64 - 1);
    let _ = writeln!(
        text,
        "{} runs of each planner, seeds {} to {last_seed}. In each cell: published / ours, the mean over the runs \
         with the range in brackets.\n",
        tables.runs, tables.first_seed
    );
    if is_compared(tables) {
        let _ = writeln!(text, "{}\n", legend());
    }
    if let Some(remark) = remark(&tables.builds) {
        let _ = writeln!(text, "{remark}\n");
    }
    text + &render(tables, setting)
}

fn is_compared(tables: &Tables) -> bool {
    let published = |experiment: &ExperimentTables| experiment.published.is_some();
    tables.experiments.iter().any(published)
}

/// What the ratios and signs say.
fn legend() -> String {
    let [agrees, near, lower, higher] = Agreement::ALL.map(Agreement::sign);
    format!(
        "Then ours over the published value, and a sign: {agrees} the published value lies where as many runs of ours \
         as were published would lie in 95 % of cases, {near} it does not, but ours is within {:.0} % of it, {lower} \
         ours is lower, {higher} higher. Of largest errors, the largest of as many runs is compared, not the mean.",
        100.0 * NEAR_WITHIN
    )
}

fn render(tables: &Tables, setting: Setting) -> String {
    let mut text = String::new();
    for experiment in &tables.experiments {
        let of_paper = experiment.paper_tables();
        for table in of_paper.iter().chain([&experiment.further_table()]) {
            let (title, table) = (&table.title, draw(table, setting));
            let _ = writeln!(text, "{}{title}\n\n{table}\n", setting.heading);
        }
    }
    text
}

fn draw(results: &ResultTable, setting: Setting) -> Table {
    let mut table = Table::new();
    let names = results.planners.iter().map(ToString::to_string);
    table
        .load_style(setting.style)
        .set_header(std::iter::once(String::new()).chain(names));
    for row in &results.rows {
        let cells = row
            .cells
            .iter()
            .map(|cell| text_of(cell, setting.wide_separator));
        table.add_row(std::iter::once(row.name.clone()).chain(cells));
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn text_of(cell: &ResultCell, wide_separator: &str) -> String {
    const WIDE: usize = 16;
    let mut ours = cell.ours.to_string();
    let sign = cell
        .agreement()
        .map(|agreement| agreement.sign().to_owned());
    let compared: Vec<String> = cell.ratio().into_iter().chain(sign).collect();
    if !compared.is_empty() {
        ours = format!("{ours}, {}", compared.join(" "));
    }
    let Some(published) = cell.published.map(|value| value.to_string()) else {
        return ours;
    };
    let is_wide = published.chars().count() + ours.chars().count() > WIDE;
    let separator = if is_wide { wide_separator } else { " / " };
    published + separator + &ours
}
