//! Whole runs of every planner on both environments, decision for decision, against those kept in
//! `tests/fixtures/golden/runs.txt`.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::fs;

use adslam_diagnostics::Interrupt;
use adslam_experiment::provenance::RESULTS_VERSION;
use adslam_tests::fixture;
use adslam_tests::golden_runs::{GOLDEN_RUNS, GoldenRun, GoldenRuns, Renewal};

#[test]
fn every_planner_decides_as_in_the_golden_runs() {
    let golden = GoldenRuns::parse(&fs::read_to_string(fixture(GOLDEN_RUNS)).unwrap()).unwrap();
    assert_eq!(
        golden.version, RESULTS_VERSION,
        "`cargo xtask golden-runs` has to follow RESULTS_VERSION"
    );
    let now = GoldenRuns::record(&Interrupt::new()).unwrap();
    assert!(golden.names().eq(now.names()));
    if let Some(difference) = golden.first_difference(&now) {
        panic!(
            "{difference}\nWhere that is meant, raise RESULTS_VERSION and run `cargo xtask golden-runs`."
        );
    }
}

const STEPS: [&str; 3] = [
    "viewpoint 0  -0.500000  -1.000000   2.000000",
    "   1   0.000000   0.000000   0.000000   1.000000   2.000000   3.000000  337  0 675 258  25 0.123456",
    "   2   0.100000   0.000000   0.000000   1.000000   2.000000   3.000000",
];

fn runs(version: u32, lines: &[&str]) -> GoldenRuns {
    GoldenRuns {
        version,
        runs: ["first", "second"]
            .map(|name| GoldenRun {
                name: name.to_owned(),
                lines: lines.iter().map(ToString::to_string).collect(),
            })
            .into(),
    }
}

/// The runs with a part of the second one's text replaced.
fn changed(version: u32, old: &str, new: &str) -> GoldenRuns {
    let mut runs = runs(version, &STEPS);
    for line in &mut runs.runs[1].lines {
        *line = line.replacen(old, new, 1);
    }
    assert_ne!(runs.runs[0].lines, runs.runs[1].lines);
    runs
}

#[test]
fn a_file_is_read_as_it_was_written() {
    let runs = runs(7, &STEPS);
    assert_eq!(GoldenRuns::parse(&runs.to_string()), Ok(runs));
    for (text, wrong) in [
        ("", "version"),
        ("[first]\n   1 0.5", "version"),
        ("results_version = 1\n   1 0.5", "before any run"),
    ] {
        let error = GoldenRuns::parse(text).unwrap_err();
        assert!(error.contains(wrong), "{error}");
    }
}

#[test]
fn the_first_decision_that_differs_is_named() {
    let golden = runs(1, &STEPS);
    let message = |now: &GoldenRuns| golden.first_difference(now).map(|d| d.to_string());
    assert_eq!(message(&golden), None);

    let text = message(&changed(1, " 337 ", " 338 ")).unwrap();
    assert!(text.starts_with("second: step 1 is the first"), "{text}");
    assert!(text.contains(STEPS[1]), "as it was: {text}");
    assert!(text.contains(" 338  0 675"), "as it is: {text}");
    let text = message(&changed(1, "-0.500000", "-0.500003")).unwrap();
    assert!(text.starts_with("second: viewpoint 0 "), "{text}");

    for runs_of_other_lengths in [&STEPS[..2], &[STEPS[0], STEPS[1], STEPS[2], STEPS[2]]] {
        let text = message(&runs(1, runs_of_other_lengths)).unwrap();
        assert!(text.starts_with("first: step 2 "), "{text}");
        assert!(text.contains("the run is over"), "{text}");
    }
}

#[test]
fn numbers_may_differ_by_one_of_the_last_digit_and_counts_not_at_all() {
    let golden = runs(1, &STEPS);
    let differs = |old, new| golden.first_difference(&changed(1, old, new)).is_some();
    assert!(!differs("0.123456", "0.123457"));
    assert!(!differs("0.100000", "0.099999"));
    assert!(!differs(" 0.000000", "-0.000000"));
    assert!(differs("0.123456", "0.123458"));
    assert!(differs("0.123456", "-"));
    assert!(differs("0.123456", "0.123456 0.5"));
    assert!(differs(" 0.123456", ""));
    assert!(differs(" 258 ", " 259 "));
}

#[test]
fn changed_runs_are_written_for_a_raised_version_only() {
    let golden = runs(3, &STEPS);
    let file = golden.to_string();
    let renewed = |now: &GoldenRuns| now.renewal_of(Some(&file));
    let written = |now: &GoldenRuns| Ok(Renewal::Write(now.to_string()));

    assert_eq!(renewed(&golden), Ok(Renewal::UpToDate));
    let last_digits = changed(3, "0.123456", "0.123457");
    assert_eq!(renewed(&last_digits), Ok(Renewal::UpToDate));
    assert_eq!(golden.renewal_of(None), written(&golden));
    assert_eq!(renewed(&runs(4, &STEPS)), written(&runs(4, &STEPS)));

    let error = renewed(&changed(3, " 337 ", " 338 ")).unwrap_err();
    assert!(error.contains("second: step 1"), "{error}");
    assert!(error.contains("raise RESULTS_VERSION"), "{error}");
    let raised = changed(4, " 337 ", " 338 ");
    assert_eq!(renewed(&raised), written(&raised));

    let error = renewed(&runs(2, &STEPS)).unwrap_err();
    assert!(error.contains("version 3"), "{error}");

    let mut more = golden.clone();
    more.runs[0].name = "another".to_owned();
    assert_eq!(
        renewed(&more),
        written(&more),
        "other runs say nothing of the results"
    );
    more.runs[1].lines.pop();
    assert!(renewed(&more).is_err(), "but the runs that stay do");
}
