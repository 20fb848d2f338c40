//! The page of real runs: what is on it, and that it needs nothing from elsewhere.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::tables::{ResultCell, TablePlan, Tables};
use adslam_names::PlannerName;
use adslam_report::{Machine, html, write};
use adslam_scenario::config::{Config, Selection};

/// Two runs of two quick planners around the polygon, the first of each recorded or not.
fn tables(record: bool) -> Tables {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut config = Config::load(&root.join("configs/paper.toml")).unwrap();
    for plan in &mut config.experiments {
        plan.planners
            .retain(|p| matches!(*p, PlannerName::PREDETERMINED | PlannerName::GLOBAL));
    }
    let selection = Selection {
        runs: Some(2),
        only: vec!["polygon".to_owned()],
        mesh: None,
    };
    let plan = TablePlan::new(config, &selection).unwrap();
    let mut tables = plan.run(&Interrupt::new(), &|| ());
    if record {
        plan.record(&mut tables, &Interrupt::new()).unwrap();
    }
    tables
}

fn machine() -> Machine {
    Machine {
        processor: Some("A <fast> & old one".to_owned()),
        threads: 1,
        system: "Test OS".to_owned(),
    }
}

#[test]
fn every_compared_cell_has_its_mark_and_the_sources_are_there() {
    let tables = tables(false);
    let page = html(&tables, &machine());
    let shown = tables.experiments[0].paper_tables();
    let cells: Vec<&ResultCell> = shown
        .iter()
        .flat_map(|t| &t.rows)
        .flat_map(|r| &r.cells)
        .collect();
    let compared = cells
        .iter()
        .filter(|cell| cell.agreement().is_some())
        .count();
    assert!(compared > 20, "{compared}");
    // Beside those: four in the head of the overview and four in the legend.
    assert_eq!(page.matches("<svg class=\"mark ").count(), compared + 8);
    for cell in cells {
        assert!(page.contains(&format!(
            "<span class=\"ours\" title=\"ours\">{}</span>",
            cell.ours
        )));
    }
    for part in [
        "Table I: Coverage, polygon",
        "Table II: Estimation error, polygon",
        "A &lt;fast&gt; &amp; old one, 1 thread, Test OS",
        "seeds 1 to 2",
        "<summary>paper.toml</summary>",
        "<summary>polygon.toml</summary>",
        "[[experiments]]",
        "[robot.actions]",
    ] {
        assert!(page.contains(part), "no {part:?}");
    }
    for absent in ["id=\"heart\"", "<summary>heart.toml"] {
        assert!(!page.contains(absent), "{absent} was not asked for");
    }
}

#[test]
fn nothing_comes_from_elsewhere() {
    let page = html(&tables(false), &machine());
    assert!(page.contains("default-src 'none'"));
    assert!(!page.contains("<script") && !page.contains("@import") && !page.contains("url("));
    for link in page.split("src=\"").skip(1) {
        assert!(link.starts_with("data:image/svg+xml;base64,"), "{link:.40}");
    }
}

#[test]
fn recorded_runs_give_figures_and_replays() {
    let (plain, recorded) = (tables(false), tables(true));
    let folder = tempfile::tempdir().unwrap();
    let path = write(&recorded, folder.path()).unwrap();
    let page = std::fs::read_to_string(&path).unwrap();
    // The box plots need no recorded run.
    assert_eq!(html(&plain, &machine()).matches("<figure>").count(), 1);
    assert_eq!(page.matches("<figure>").count(), 7);
    assert_eq!(page.matches("<figure><img").count(), 7, "all are drawn");
    for planner in ["predetermined", "global"] {
        let replay = format!("replays/polygon-{planner}.html");
        assert!(page.contains(&format!("<a href=\"{replay}\">")), "{replay}");
        let replay = std::fs::read_to_string(folder.path().join(replay)).unwrap();
        let histories = adslam_replay::embedded_histories(&replay).unwrap();
        assert_eq!((histories[0].seed, histories[0].steps.len()), (1, 100));
    }
    let folder = tempfile::tempdir().unwrap();
    write(&plain, folder.path()).unwrap();
    assert!(!folder.path().join("replays").exists());
}

#[test]
fn what_went_wrong_is_on_the_page() {
    let mut tables = tables(false);
    tables.failures.push("[polygon] <it> failed".to_owned());
    tables.interrupted = true;
    let page = html(&tables, &Machine::this());
    assert!(page.contains("[polygon] &lt;it&gt; failed"));
    assert!(page.contains("Interrupted"));
}
