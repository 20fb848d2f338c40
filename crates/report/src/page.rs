//! The page as a whole.

use std::path::Path;

use adslam_experiment::provenance::remark;
use adslam_experiment::tables::{Agreement, ExperimentTables, NEAR_WITHIN, SourceFile, Tables};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::drawings::figures;
use crate::machine::Machine;
use crate::marks::mark;
use crate::tables::{overview, table};
use crate::{REPLAYS_FOLDER, replays_of};

const STYLE: &str = include_str!("report.css");

/// What the page may load: nothing but what is in it.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

pub(crate) fn page(tables: &Tables, machine: &Machine) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="color-scheme" content="light dark";
                title { (tables.title) " · adslam report" }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (tables.title) }
                    p .facts { (runs(tables)) ", made by adslam " (env!("CARGO_PKG_VERSION")) }
                    (contents(tables))
                }
                main {
                    (troubles(tables))
                    section {
                        (overview(tables))
                        (legend(tables))
                    }
                    @for experiment in &tables.experiments { (section(experiment)) }
                    (made_of(tables, machine))
                }
            }
        }
    }
}

fn runs(tables: &Tables) -> String {
    let last = tables.first_seed.wrapping_add(tables.runs as u64 - 1);
    match tables.runs {
        1 => format!("1 run of each method, seed {last}"),
        runs => format!(
            "{runs} runs of each method, seeds {} to {last}",
            tables.first_seed
        ),
    }
}

fn contents(tables: &Tables) -> Markup {
    html! {
        nav {
            @for experiment in &tables.experiments {
                a href={ "#" (experiment.label) } { (experiment.label) }
            }
            a href="#made-of" { "what it was made of" }
        }
    }
}

/// What went wrong, or what the reader should know.
fn troubles(tables: &Tables) -> Markup {
    html! {
        @if tables.interrupted {
            p .warning { "Interrupted: the runs that had finished are tabulated." }
        }
        @if let Some(remark) = remark(&tables.builds) {
            p .warning { (remark.replace("**", "")) }
        }
        @for failure in &tables.failures { p .warning { "A run failed: " (failure) } }
        @for warning in &tables.warnings { p .warning { (warning) } }
    }
}

/// How to read the cells; empty where none is compared.
fn legend(tables: &Tables) -> Markup {
    if tables.experiments.iter().all(|e| e.published.is_none()) {
        return html! {};
    }
    let near = format!("{:.0} %", 100.0 * NEAR_WITHIN);
    let meaning = |agreement| match agreement {
        Agreement::Agrees => {
            "the published value lies where as many runs of ours as were published would lie in \
             95 % of cases"
                .to_owned()
        }
        Agreement::Near => format!("it does not, but ours is within {near} of it"),
        Agreement::Lower => "ours is farther below".to_owned(),
        Agreement::Higher => "ours is farther above".to_owned(),
    };
    html! {
        div .legend {
            p {
                "In each cell: " span .published { "the published value" } ", then "
                span .ours { "ours, the mean over the runs (range)" }
                ". The strip shows our mean and range as multiples of the published value, \
                 which is the line in the middle; its ends are a quarter and four times of it. \
                 The ratio beside it is that of what is compared: of means ours over theirs, of largest errors \
                 the largest expected of as many runs of ours. The value of a single published run is compared \
                 with all our runs."
            }
            ul {
                @for agreement in Agreement::ALL {
                    li { (mark(agreement)) " " b { (agreement.as_str()) } ": " (meaning(agreement)) }
                }
            }
        }
    }
}

fn section(experiment: &ExperimentTables) -> Markup {
    html! {
        section id=(experiment.label) {
            h2 { (experiment.label) }
            @for results in experiment.paper_tables() { (table(&results)) }
            (table(&experiment.further_table()))
            (replays(experiment))
            (figures(experiment))
        }
    }
}

fn replays(experiment: &ExperimentTables) -> Markup {
    if experiment.histories.is_empty() {
        return html! {};
    }
    html! {
        p .replays {
            "Replays to turn around and play: "
            @for (file, history) in replays_of(experiment) {
                a href={ (REPLAYS_FOLDER) "/" (file) } {
                    (history.planner) ", seed " (history.seed)
                }
                " "
            }
        }
    }
}

/// The files, the program and the machine.
fn made_of(tables: &Tables, machine: &Machine) -> Markup {
    html! {
        section id="made-of" {
            h2 { "What it was made of" }
            dl {
                dt { "program" }
                dd { "adslam " (env!("CARGO_PKG_VERSION")) }
                dt { "machine" }
                dd { (machine) }
                dt { "runs" }
                dd { (runs(tables)) }
                @if let Some(mesh) = &tables.mesh {
                    dt { "mesh" }
                    dd { (mesh.display()) ", in place of the scenarios' meshes and phantoms" }
                }
            }
            p {
                "The same files and seeds give the same numbers on every machine, but for the \
                 times of decisions."
            }
            @for source in &tables.sources { (file(source)) }
        }
    }
}

fn file(source: &SourceFile) -> Markup {
    let name = Path::new(source.path.file_name().unwrap_or(source.path.as_os_str()));
    html! {
        details {
            summary { (name.display()) }
            pre { (source.text) }
        }
    }
}
