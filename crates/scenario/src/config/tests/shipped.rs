//! The shipped configurations and published tables.

use adslam_names::PlannerName;

use super::{ONE, loaded};
use crate::config::{Config, Published, PublishedPlanner};
use crate::tests::repository;
use crate::values::Name;
use crate::{DeformationNoise, Object, Translation, Viewpoints};

#[test]
fn the_shipped_configurations_load() {
    for (name, experiments) in [
        ("paper", 2),
        ("public_code", 2),
        ("accumulating", 2),
        ("stored_viewpoints", 2),
    ] {
        let config = Config::load(&repository(&format!("configs/{name}.toml"))).unwrap();
        assert_eq!(config.experiments.len(), experiments, "{name}");
        assert_eq!((config.runs, config.first_seed), (5, 1), "{name}");
        for plan in &config.experiments {
            assert_eq!(plan.planners, PlannerName::PAPER, "{name}");
            assert!(plan.published.is_some(), "{name}");
        }
    }
}

#[test]
fn the_variants_change_what_they_say() {
    let load = |name: &str| Config::load(&repository(&format!("configs/{name}.toml"))).unwrap();
    let [polygon, heart] = &load("stored_viewpoints").experiments[..] else {
        panic!("two")
    };
    for (plan, count) in [(polygon, 3), (heart, 7)] {
        let Viewpoints::Fixed(fixed) = &plan.scenario.viewpoints else {
            panic!("not fixed")
        };
        assert_eq!(fixed.positions_cm.len(), count);
    }
    for plan in load("accumulating").experiments {
        assert_eq!(
            plan.scenario.noise.deformation_noise,
            DeformationNoise::Accumulating
        );
    }
    let public = &load("public_code").experiments[0].scenario;
    assert_eq!(public.motion.translation, Translation::None);
    assert_eq!(public.local_planning_sigma_cm(), 0.05);
    assert_eq!(*public.noise.truncate_at_sigmas.unwrap(), 2.0);
    let rest: Vec<_> = match &public.object {
        Object::Points(points) => points.positions_cm.iter().map(|p| p.point()).collect(),
        _ => panic!("no points"),
    };
    let motion = public.true_motion(&rest).unwrap();
    assert!((motion.feature_motion(&rest[1], 1).y + 0.2).abs() < 1e-12);
    assert!(motion.feature_motion(&rest[1], 3).norm() < 1e-12);
}

#[test]
fn the_published_tables_are_the_papers() {
    let published = Published::load(&repository("configs/published.toml")).unwrap();
    let mean = |column: &PublishedPlanner| {
        let sum: usize = column.observed.iter().map(|count| count.get()).sum();
        sum as f64 / column.observed.len() as f64
    };
    // The means that reference.md gives in brackets.
    let expected = [
        ("polygon", "I", "II", [347.0, 695.0, 278.0, 541.0]),
        ("heart", "III", "IV", [1236.0, 2080.0, 1041.0, 1598.0]),
    ];
    for (scenario, coverage, errors, means) in expected {
        let tables = &published.tables[&Name::new(scenario).unwrap()];
        assert_eq!(
            (&*tables.coverage_table, &*tables.error_table),
            (coverage, errors)
        );
        for (planner, expected) in PlannerName::PAPER.into_iter().zip(means) {
            let column = &tables.planners[&planner];
            assert_eq!(column.observed.len(), 5);
            assert!(
                (mean(column) - expected).abs() < 1.0,
                "{planner}: {}",
                mean(column)
            );
        }
    }
    let polygon = &published.tables[&Name::new("polygon").unwrap()];
    assert!(
        polygon.planners[&PlannerName::LOCAL]
            .steps
            .iter()
            .all(|steps| steps.0.is_none())
    );
}

#[test]
fn defaults() {
    let config = loaded(ONE).unwrap();
    assert_eq!((config.runs, config.first_seed), (5, 1));
    let [plan] = &config.experiments[..] else {
        panic!("one")
    };
    assert_eq!(plan.label, "polygon");
    assert_eq!(plan.published, None);
}
