//! Studies that grow, and those that several builds work on.

use std::fs;
use std::path::Path;

use adslam_diagnostics::{Failure, InputError};
use adslam_names::PlannerName;
use adslam_scenario::Scenario;
use adslam_setup::Setup;

use super::super::{OtherBuilds, Study, StudyPlan};
use super::{Said, names, of_points, open, plan, setup, work};
use crate::provenance::{BUILD, Build, remark};
use crate::test_files::POLYGON;

fn with_range(range_cm: &str) -> Setup {
    let text = POLYGON.replacen("range_cm = 3.0", &format!("range_cm = {range_cm}"), 1);
    Setup::new(&Scenario::parse(&text, Path::new("polygon.toml")).unwrap()).unwrap()
}

fn refused(folder: &Path, plan: &StudyPlan<'_>) -> InputError {
    match open(folder, plan) {
        Err(Failure::Input(error)) => error,
        other => panic!("{other:?}"),
    }
}

/// More seeds on both sides, another planner, points before and between those that are there: only what is missing
/// is done, and the records that are there keep their names.
#[test]
fn only_what_is_missing_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let [two, three, four, five] = ["2.0", "3.0", "4.0", "5.0"].map(with_range);
    let few = StudyPlan {
        first_seed: 3,
        ..of_points(&[&three, &five], 2)
    };
    assert_eq!(work(folder.path(), &few).0, 2 * 2 * 2);
    let before = names(&folder.path().join("records"));
    let begun = work(folder.path(), &of_points(&[&three, &five], 6)).0;
    assert_eq!(begun, 2 * 2 * 4, "seeds 1, 2, 5 and 6");
    let all = [&two, &three, &four, &five];
    assert_eq!(work(folder.path(), &of_points(&all, 6)).0, 2 * 2 * 6);
    let mut more = of_points(&all, 6);
    for point in &mut more.points {
        point.planners = &[
            PlannerName::COMBINED,
            PlannerName::GLOBAL,
            PlannerName::LOCAL,
        ];
    }
    let seeds: Vec<u64> = more.units(&[1; 4]).iter().map(|unit| unit.seed).collect();
    let (begun, records) = work(folder.path(), &more);
    assert_eq!(begun, 4 * 6);
    let said: Vec<u64> = records.iter().map(|record| record.seed).collect();
    assert_eq!(said, seeds, "in the order of the plan");
    assert_eq!(work(folder.path(), &more).0, 0);
    let after = names(&folder.path().join("records"));
    assert_eq!(after.len(), 4 * 3 * 6);
    assert!(before.iter().all(|name| after.contains(name)));
}

/// Killed as soon as the plan has grown: all that was there is there, and nothing is done twice.
#[test]
fn growth_that_is_cut_off_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let [three, five] = ["3.0", "5.0"].map(with_range);
    work(folder.path(), &of_points(&[&three], 2));
    drop(open(folder.path(), &of_points(&[&five, &three], 3)).unwrap());
    let grown = fs::read(folder.path().join("plan.json")).unwrap();
    let records = names(&folder.path().join("records"));
    assert_eq!(records.len(), 4);
    let (begun, _) = work(folder.path(), &of_points(&[&five, &three], 3));
    assert_eq!(begun, 2 * 2 * 3 - 4);
    let plan = fs::read(folder.path().join("plan.json")).unwrap();
    assert_eq!(plan, grown);
}

/// A plan without runs that are there: seeds, planners and points are named, all of them.
#[test]
fn a_study_does_not_shrink() {
    let folder = tempfile::tempdir().unwrap();
    let [three, four, five] = ["3.0", "4.0", "5.0"].map(with_range);
    work(folder.path(), &of_points(&[&three, &five], 20));
    let mut other = of_points(&[&four, &three], 10);
    for point in &mut other.points {
        point.planners = &[PlannerName::LOCAL];
    }
    let said = refused(folder.path(), &other).message().to_owned();
    let expected = "holds another study: seeds 1–20 there and 1–10 here; planners local, global there and local here; \
        `sensor.range_cm` is 5.0 there and 4.0 here";
    assert!(said.ends_with(expected), "{said}");
    let said = refused(folder.path(), &of_points(&[&three], 30))
        .message()
        .to_owned();
    let expected =
        "seeds 1–20 there and 1–30 here; the point with `sensor.range_cm` = 5.0 there is not here";
    assert!(said.ends_with(expected), "{said}");
}

/// A default that changed is another value of a key that no file sets.
#[test]
fn a_changed_default_is_seen() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    assert!(!POLYGON.contains("crossing_penalty"));
    work(folder.path(), &plan(&setup, 1));
    let path = folder.path().join("plan.json");
    let text = fs::read_to_string(&path).unwrap();
    let other = text.replacen(
        "\"crossing_penalty_cm\": 1.0",
        "\"crossing_penalty_cm\": 2.0",
        1,
    );
    assert_ne!(other, text, "every key is there, its default too");
    fs::write(&path, other).unwrap();
    let said = refused(folder.path(), &plan(&setup, 1));
    let key = "`planners.global.crossing_penalty_cm` is 2.0 there and 1.0 here";
    assert!(said.message().contains(key), "{said}");
}

/// A study of one planner's run, as if another build or machine had done it.
fn by_another(change: impl Fn(&str) -> String) -> tempfile::TempDir {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    let records = folder.path().join("records");
    let mut files = vec![folder.path().join("plan.json")];
    files.extend(names(&records).iter().map(|name| records.join(name)));
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let other = change(&text);
        assert_ne!(other, text);
        fs::write(&file, other).unwrap();
    }
    folder
}

#[test]
fn another_build_is_refused_until_it_is_accepted_and_is_told_of() {
    let setup = setup();
    let here = Build::this();
    let cases: [(&str, &str, &str); 3] = [
        (BUILD, "1a2b3c4d", "the build is 1a2b3c4d there"),
        (
            &here.arithmetic,
            "00ff00ff",
            "the arithmetic is 00ff00ff there",
        ),
        (
            &here.program,
            "adslam 0.0.0",
            "the program is adslam 0.0.0 there",
        ),
    ];
    for (old, new, said) in cases {
        let folder = by_another(|text| text.replace(old, new));
        let error = refused(folder.path(), &plan(&setup, 2));
        assert!(error.message().contains(said), "{error}");
        assert!(error.remedy().unwrap().contains("--accept-build"));

        let mut study: Study<'_, Said> =
            Study::open(folder.path(), &plan(&setup, 2), OtherBuilds::Accept).unwrap();
        assert_eq!(study.done(), 2);
        let end = study.finish(&Default::default(), &|| (), |unit, _| Ok(Said::of(unit)));
        end.unwrap();
        let builds = study.builds();
        let runs: Vec<usize> = builds.iter().map(|of| of.runs).collect();
        assert_eq!(runs, [2, 2]);
        assert_eq!(builds[1].build, here);
        let remark = remark(&builds).unwrap();
        assert!(remark.contains(new), "{remark}");
        drop(study);
        // Once accepted it stays so.
        assert_eq!(work(folder.path(), &plan(&setup, 2)).0, 0);
    }
}

/// A record that was put there from a folder of another build.
#[test]
fn the_record_of_another_build_alone_is_named() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    work(folder.path(), &plan(&setup, 1));
    let record = folder.path().join("records/0001-local-seed1.jsonl");
    let text = fs::read_to_string(&record).unwrap();
    fs::write(&record, text.replace(BUILD, "1a2b3c4d")).unwrap();
    let error = refused(folder.path(), &plan(&setup, 1));
    let said = "0001-local-seed1.jsonl was made by another build: adslam ";
    assert!(error.message().contains(said), "{error}");
}

#[test]
fn results_of_something_else_are_no_place_for_a_study() {
    let (folder, setup) = (tempfile::tempdir().unwrap(), setup());
    fs::write(folder.path().join("tables.json"), "{}").unwrap();
    let error = refused(folder.path(), &plan(&setup, 1));
    let said = "holds results of something else: tables.json";
    assert!(error.message().contains(said), "{error}");
}

/// Ten thousand points take some megabytes, not a scenario each.
#[test]
fn plans_of_many_points_stay_small() {
    let folder = tempfile::tempdir().unwrap();
    let setups: Vec<Setup> = (0..100)
        .map(|k| with_range(&format!("{}.5", k + 2)))
        .collect();
    let points: Vec<&Setup> = setups.iter().collect();
    drop(open(folder.path(), &of_points(&points, 1)).unwrap());
    let one = tempfile::tempdir().unwrap();
    drop(open(one.path(), &of_points(&points[..1], 1)).unwrap());
    let size = |folder: &Path| fs::metadata(folder.join("plan.json")).unwrap().len();
    let each = (size(folder.path()) - size(one.path())) / 99;
    assert!(each < 400, "{each} bytes");
}
