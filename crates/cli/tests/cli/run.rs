//! `adslam run`

use std::collections::BTreeSet;

use super::support::{PLANNERS, Place, RUN_KEYS, STEPS, polygon};

/// Columns without a unit.
const COUNTS: [&str; 18] = [
    "step",
    "pose_nees",
    "feature_nees",
    "joint_nees_per_dof",
    "feature_nis",
    "feature_nis_dof",
    "structure_nis",
    "structure_nis_dof",
    "rejected_measurements",
    "visible_features",
    "features_seen_so_far",
    "goal_number",
    "admissible_actions",
    "safe_actions",
    "scored_actions",
    "compromised",
    "limits_waived",
    "abandoned_goal_number",
];

fn has_unit(column: &str) -> bool {
    ["_rad", "_cm", "_rad_cm", "_rad2_cm2", "_ms"]
        .iter()
        .any(|unit| column.ends_with(unit))
}

fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    (header, rows.collect())
}

#[test]
fn every_planner_writes_a_whole_run() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    for planner in PLANNERS {
        let said = place.succeeds(&format!(
            "run polygon.toml --planner {planner} --seed 3 --out runs/{planner}"
        ));
        assert!(
            said.out
                .starts_with(&format!("polygon, {planner}, seed 3: observed")),
            "{said:?}"
        );
        let file = |name: &str| format!("runs/{planner}/{name}");

        let summary = place.json(&file("summary.json"));
        let keys: BTreeSet<&str> = summary.as_object().unwrap().keys().map(|k| &**k).collect();
        let missing: Vec<_> = RUN_KEYS.iter().filter(|key| !keys.contains(*key)).collect();
        assert!(missing.is_empty(), "{missing:?} in {summary}");
        assert_eq!(summary["seed"], 3);
        let times = summary["decision_ms"].as_object().unwrap();
        assert!(
            ["median", "p95", "max"]
                .iter()
                .all(|key| times[*key].is_number())
        );

        let steps = place.read(&file("steps.csv"));
        let (header, rows) = table(&steps);
        assert_eq!(rows.len(), STEPS);
        for column in &header {
            assert!(has_unit(column) || COUNTS.contains(column), "{column}");
        }
        for (n, row) in rows.iter().enumerate() {
            assert_eq!((row.len(), row[0]), (header.len(), &*(n + 1).to_string()));
        }

        for name in ["truth.tum", "estimate.tum"] {
            let text = place.read(&file(name));
            let poses = text.lines().filter(|line| !line.starts_with('#'));
            let poses: Vec<Vec<f64>> = poses
                .map(|line| {
                    line.split(' ')
                        .map(|number| number.parse().unwrap())
                        .collect()
                })
                .collect();
            assert_eq!(poses.len(), STEPS);
            for pose in poses {
                assert_eq!(pose.len(), 8);
                let norm: f64 = pose[4..].iter().map(|q| q * q).sum();
                assert!((norm - 1.0).abs() < 1e-12, "a unit quaternion");
            }
        }

        let features = place.read(&file("features.csv"));
        let (header, rows) = table(&features);
        assert_eq!(rows.len(), 14);
        for column in header {
            let count = ["feature", "first_seen_step", "times_seen", "nees_mean"].contains(&column);
            assert!(has_unit(column) || count, "{column}");
        }
    }
}

/// The same numbers but for the time that decisions took; other numbers at another seed.
#[test]
fn a_seed_gives_the_same_run_again() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    let run = |seed: u64, out: &str| {
        place.succeeds(&format!(
            "run polygon.toml --planner combined --seed {seed} --out {out}"
        ));
        let steps = place.read(&format!("{out}/steps.csv"));
        let (header, rows) = table(&steps);
        let time = header
            .iter()
            .position(|c| *c == "decision_time_ms")
            .unwrap();
        let mut text = String::new();
        for mut row in rows {
            row.remove(time);
            text += &row.join(",");
            text.push('\n');
        }
        (text, place.read(&format!("{out}/features.csv")))
    };
    let first = run(7, "first");
    assert_eq!(first, run(7, "again"));
    assert_ne!(first, run(8, "other"));
}

#[test]
fn an_old_run_is_replaced_whole() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    let run = |seed| format!("run polygon.toml --planner predetermined --seed {seed} --out run");
    place.succeeds(&run(1));
    place.succeeds(&run(2));
    assert_eq!(place.json("run/summary.json")["seed"], 2);
    let names: Vec<_> = std::fs::read_dir(place.path("run"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    assert!(
        names.iter().all(|name| !name.starts_with('.')),
        "litter: {names:?}"
    );
}

#[test]
fn a_start_nearer_than_the_clearance_is_a_warning() {
    let near = polygon(&[("[robot] ", "[robot]\nstart_cm = [0.8, 0.0, 2.0]\n")]);
    let place = Place::new(&[("near.toml", &near)]);
    let said = place.succeeds("run near.toml --planner local --out run");
    for word in [
        "warning: polygon: the robot starts 0.2",
        "nearer than its clearance of 0.3 cm",
    ] {
        assert!(said.err.contains(word), "{said:?}");
    }
    assert!(place.path("run/summary.json").is_file());
}

#[test]
fn features_that_no_viewpoint_sees_are_named() {
    let one = "[viewpoints.fixed]\npositions_cm = [[-0.5, 0.0, 0.0]]\n[planners.predetermined]";
    let text = polygon(&[("[planners.predetermined]", one)]);
    let from = text.find("[viewpoints.sampled]").unwrap();
    let to = text.find("[viewpoints.fixed]").unwrap();
    let place = Place::new(&[("one.toml", &(text[..from].to_owned() + &text[to..]))]);
    let said = place.succeeds("run one.toml --planner global --out run");
    assert!(
        said.err
            .contains("warning: polygon: no viewpoint sees features"),
        "{said:?}"
    );
}

#[test]
fn a_world_in_which_nothing_is_seen_is_warned_of() {
    let blind = polygon(&[("range_cm = 3.0", "range_cm = 0.2")]);
    let place = Place::new(&[("blind.toml", &blind)]);
    let said = place.succeeds("run blind.toml --planner predetermined --out run");
    assert!(
        said.err
            .contains("warning: polygon, predetermined: the robot saw no feature"),
        "{said:?}"
    );
    assert!(said.out.contains("observed 0 feature times"), "{said:?}");
}

/// Colours and bars are for terminals.
#[test]
fn what_is_read_by_a_program_has_no_escapes() {
    let typo = polygon(&[("range_cm = 3.0", "rang_cm = 3.0")]);
    let place = Place::new(&[("polygon.toml", &polygon(&[])), ("typo.toml", &typo)]);
    for arguments in [
        "run polygon.toml --planner local --out run",
        "check typo.toml",
        "check --help",
        "fly",
    ] {
        let mut command = place.command(arguments);
        let output = command.env_remove("NO_COLOR").output().unwrap();
        let said = [output.stdout, output.stderr].concat();
        assert!(!said.is_empty() && !said.contains(&0x1b), "{arguments}");
    }
}
