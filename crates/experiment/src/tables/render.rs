//! Tables for people: in the terminal, and as Markdown.

use std::fmt::Write;

use comfy_table::{CellAlignment, Table, TableStyle, presets};

use super::{ResultCell, ResultTable, Tables};

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
    let legend = "In each cell: the published value, then ours, the mean over the runs (range).";
    format!("{legend}\n\n{}", render(tables, setting))
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
        text.push_str("**Incomplete: some runs failed or were interrupted.**\n\n");
    }
    let _ = writeln!(
        text,
        "{} runs of each planner. In each cell: published / ours, the mean over the runs with the \
         range in brackets.\n",
        tables.runs
    );
    text + &render(tables, setting)
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
    let ours = cell.ours.to_string();
    let Some(published) = cell.published.map(|value| value.to_string()) else {
        return ours;
    };
    let is_wide = published.chars().count() + ours.chars().count() > WIDE;
    let separator = if is_wide { wide_separator } else { " / " };
    published + separator + &ours
}
