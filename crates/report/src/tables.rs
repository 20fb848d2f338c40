//! Tables as HTML.

use adslam_experiment::tables::{Agreement, CellValue, ResultCell, ResultRow, ResultTable, Tables};
use maud::{Markup, html};

use crate::marks::{mark, strip};

/// A table with its published values and marks.
pub(crate) fn table(table: &ResultTable) -> Markup {
    html! {
        div .scroll {
            table {
                caption { (table.title) }
                thead {
                    tr {
                        td {}
                        @for planner in &table.planners { th scope="col" { (planner) } }
                    }
                }
                tbody {
                    @for row in &table.rows {
                        tr .single[is_single(row)] {
                            th scope="row" { (row.name) }
                            @for cell in &row.cells { (self::cell(cell)) }
                        }
                    }
                }
            }
        }
    }
}

/// Whether a row shows one run.
fn is_single(row: &ResultRow) -> bool {
    let single = |cell: &ResultCell| matches!(cell.ours, CellValue::Count(_) | CellValue::Absent);
    row.cells.iter().all(single)
}

fn cell(cell: &ResultCell) -> Markup {
    html! {
        td .compared[cell.published.is_some()] {
            @if let Some(agreement) = cell.agreement() { (mark(agreement)) }
            @if let Some(published) = cell.published {
                span .published title="published" { (published) }
            }
            span .ours title="ours" { (cell.ours) }
            @if let Some(strip) = strip(cell) { span .compare { (strip) } }
            @else if let Some(ratio) = cell.ratio() { span .compare { span .ratio { (ratio) } } }
        }
    }
}

/// How many cells of each of the paper's tables have each mark.
pub(crate) fn overview(tables: &Tables) -> Markup {
    let all: Vec<ResultTable> = tables
        .experiments
        .iter()
        .flat_map(|e| e.paper_tables())
        .filter(|table| cells(table).any(|cell| cell.agreement().is_some()))
        .collect();
    if all.is_empty() {
        return html! {};
    }
    let count = |table: &ResultTable, agreement: Agreement| {
        cells(table)
            .filter(|cell| cell.agreement() == Some(agreement))
            .count()
    };
    html! {
        div .scroll {
            table .overview {
                caption { "Cells of the tables by how well they agree" }
                thead {
                    tr {
                        td {}
                        @for agreement in Agreement::ALL {
                            th scope="col" { (mark(agreement)) " " (agreement.as_str()) }
                        }
                    }
                }
                tbody {
                    @for table in &all {
                        tr {
                            th scope="row" { (table.title) }
                            @for agreement in Agreement::ALL { td { (count(table, agreement)) } }
                        }
                    }
                }
            }
        }
    }
}

fn cells(table: &ResultTable) -> impl Iterator<Item = &ResultCell> {
    table.rows.iter().flat_map(|row| &row.cells)
}
