//! The filter against estimates from an independent implementation of Algorithm 1.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a helper that fails is a test that fails"
)]

use std::fs::{self, File};
use std::io::BufReader;

use adslam_agent::Estimators;
use adslam_diagnostics::Interrupt;
use adslam_record::AtomicFile;
use adslam_record::log::{EstimateLine, FilterChoice, TailPolicy, filter_log};
use adslam_tests::fixture;

fn estimates(text: &str) -> Vec<EstimateLine> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn numbers(line: &EstimateLine) -> Vec<f64> {
    let matrix = line.pose_covariance.iter().flatten();
    let features = line.features.iter().flatten();
    let all = line
        .pose
        .iter()
        .chain(matrix)
        .chain(features)
        .chain(&line.covariance_diagonal);
    all.copied().chain([line.trace]).collect()
}

#[test]
fn the_log_gives_the_golden_estimates() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("estimates.jsonl");
    let log = fixture("golden/polygon.log.jsonl");
    let reader = BufReader::new(File::open(&log).unwrap());
    let mut out = AtomicFile::create(&path).unwrap();
    let policy = TailPolicy::Refuse;
    let summary = filter_log(
        reader,
        &log,
        FilterChoice::default(),
        &Estimators::standard(),
        policy,
        &Interrupt::new(),
        &mut |line| out.add_json_line(line),
    )
    .unwrap();
    out.commit().unwrap();
    assert_eq!((summary.steps, summary.features), (29, 14));

    let ours = estimates(&fs::read_to_string(path).unwrap());
    let golden = estimates(&fs::read_to_string(fixture("golden/polygon.estimates.jsonl")).unwrap());
    assert_eq!(ours.len(), golden.len());
    for (ours, golden) in ours.iter().zip(&golden) {
        assert_eq!(ours.step, golden.step);
        let (a, b) = (numbers(ours), numbers(golden));
        assert_eq!(a.len(), b.len());
        for (i, (a, b)) in a.iter().zip(&b).enumerate() {
            assert!(
                (a - b).abs() <= 1e-9,
                "step {}, number {i}: {a} is not {b}",
                ours.step
            );
            // The variances are small numbers: 1e-9 of them, too.
            if b.abs() > 1e-12 {
                assert!(
                    (a / b - 1.0).abs() <= 1e-7,
                    "step {}, number {i}: {a}, {b}",
                    ours.step
                );
            }
        }
    }
}
