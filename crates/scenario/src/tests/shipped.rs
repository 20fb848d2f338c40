//! The shipped scenarios hold the constants of the paper.

use std::f64::consts::PI;

use adslam_deformation::ObjectMotion;
use adslam_names::LengthUnit;
use adslam_planning::Nearest;
use approx::assert_relative_eq;
use nalgebra::{Point3, Vector3};

use super::super::*;
use super::{HEART, POLYGON, ROTATING, parsed, polygon_with, repository};

fn positions(scenario: &Scenario) -> Vec<Point3<f64>> {
    match &scenario.object {
        Object::Points(points) => points.positions_cm.iter().map(|p| p.point()).collect(),
        _ => Vec::new(),
    }
}

fn grid(scenario: &Scenario) -> &Grid {
    match &scenario.viewpoints {
        Viewpoints::Sampled(grid) => grid,
        Viewpoints::Fixed(_) => panic!("viewpoints are sampled in {}", scenario.name),
    }
}

#[test]
fn all_load_from_their_files() {
    for name in ["polygon", "heart", "rotating"] {
        let scenario = Scenario::load(&repository(&format!("scenarios/{name}.toml"))).unwrap();
        assert_eq!(&*scenario.name, name);
    }
}

#[test]
fn the_polygon_is_that_of_tables_one_and_two() {
    let polygon = parsed(POLYGON).unwrap();
    assert_eq!(polygon.steps.get(), 100);
    assert_eq!(positions(&polygon).len(), 14);
    assert_eq!(positions(&polygon)[8], Point3::new(2.0, -0.5, 3.0));
    assert_eq!(polygon.robot.actions.count(), 675);
    assert_eq!(grid(&polygon).candidates().len(), 396);
    assert_eq!(*polygon.planners.combined.nearest_fraction.unwrap(), 0.1);
    assert_eq!(polygon.planners.combined.nearest(), Nearest::Fraction(0.1));
    let rotation = polygon.planners.predetermined.rotation_deg.degrees_in_rad();
    assert_relative_eq!(rotation, Vector3::new(0.0, 0.0, PI / 12.0), epsilon = 1e-15);
    assert_eq!(polygon.robot.start_cm.point(), Point3::origin());
    assert_eq!(*polygon.sensor.min_range_cm, 0.1);
}

#[test]
fn the_polygons_faces_close_it_and_look_outwards() {
    let polygon = parsed(POLYGON).unwrap();
    let points = positions(&polygon);
    let Object::Points(Points {
        faces: Some(faces), ..
    }) = &polygon.object
    else {
        panic!("the polygon gives its faces")
    };
    assert_eq!(faces.len(), 24);
    let inside = Point3::new(1.5, 0.0, 2.0);
    let mut edges = std::collections::BTreeSet::new();
    for face in faces.iter() {
        let [a, b, c] = face.map(|corner| corner.get());
        let normal = (points[b] - points[a]).cross(&(points[c] - points[a]));
        assert!(normal.dot(&(points[a] - inside)) > 0.0, "face {a} {b} {c}");
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge), "edge {edge:?} twice");
        }
    }
    assert!(edges.iter().all(|(a, b)| edges.contains(&(*b, *a))));
}

#[test]
fn the_heart_is_that_of_tables_three_and_four() {
    let heart = parsed(HEART).unwrap();
    assert_eq!(heart.steps.get(), 200);
    assert_eq!(heart.object.feature_count(), 50);
    assert_eq!(grid(&heart).candidates().len(), 246);
    assert_eq!(heart.planners.global.samples.get(), 500);
    assert_eq!(heart.planners.combined.nearest(), Nearest::Fraction(0.05));
    assert_eq!(*heart.robot.clearance_cm, 3.0);
}

#[test]
fn the_filter_assumes_the_true_noise_unless_told_otherwise() {
    let polygon = parsed(POLYGON).unwrap();
    let assumed = polygon.filter_noise();
    assert_relative_eq!(
        assumed.feature_motion_sigma_cm(),
        0.0034_f64.sqrt(),
        epsilon = 1e-15
    );
    assert_eq!(assumed.initial_feature_sigma_cm, 0.02);
    assert_eq!(polygon.local_planning_sigma_cm(), 0.02);

    let own = "[filter]\nfeature_measurement_sigma_cm = 0.04\nstructure = \"none\"\n[sensor]";
    let told = polygon_with("[sensor]", own).unwrap();
    assert_eq!(told.filter_noise().initial_feature_sigma_cm, 0.04);
    assert_eq!(told.combined_planning_sigma_cm(), 0.04);
    assert_eq!(*told.noise.feature_measurement_sigma_cm, 0.02);
    assert_eq!(told.filter.structure, Structure::None);
}

#[test]
fn the_polygon_moves_as_the_paper_says() {
    let polygon = parsed(POLYGON).unwrap();
    let rest = positions(&polygon);
    let motion = polygon.true_motion(&rest).unwrap();
    let moved: Vec<Vector3<f64>> = (1..=6)
        .map(|n| motion.feature_motion(&rest[1], n))
        .collect();
    for (n, y) in [-0.2, -0.2, -0.2, 0.2, 0.2, 0.2].into_iter().enumerate() {
        let x = if n % 2 == 0 { 0.1 } else { -0.1 };
        assert_relative_eq!(moved[n], Vector3::new(x, y, 0.0), epsilon = 1e-12);
    }
}

#[test]
fn the_filter_may_believe_in_another_motion() {
    let rigid = polygon_with("[noise]", "[known_motion]\n[noise]").unwrap();
    let rest = positions(&rigid);
    let at_rest = |motion: ObjectMotion| motion.feature_motion(&rest[1], 1) == Vector3::zeros();
    assert!(at_rest(rigid.believed_motion(&rest).unwrap()));
    assert!(!at_rest(rigid.true_motion(&rest).unwrap()));
    let polygon = parsed(POLYGON).unwrap();
    assert!(!at_rest(polygon.believed_motion(&rest).unwrap()));
}

#[test]
fn the_truth_departs_and_the_belief_stays() {
    let keys = "[mismatch]\ndeformation_factor = 2\ntime_factor = 0.5\ndelay_steps = -1\n\
        [mismatch.rotation]\naxis = [0, 0, 3]\nrate_deg_per_step = 90\n[noise]";
    let (departed, plain) = (
        polygon_with("[noise]", keys).unwrap(),
        parsed(POLYGON).unwrap(),
    );
    let rest = positions(&departed);
    let believed = departed.believed_motion(&rest).unwrap();
    let (truth, own) = (
        departed.true_motion(&rest).unwrap(),
        plain.true_motion(&rest).unwrap(),
    );
    for n in 1..9 {
        for p in &rest {
            assert_eq!(believed.feature_motion(p, n), own.feature_motion(p, n));
        }
    }
    // Step 1 shows time 1.5 and with it half of 0.2 cm twice; step 3 shows time 2.5 turned by 180°
    // about the centroid of the rest positions, which is that of the prism's axis.
    let [at_1, at_3] = [1, 3].map(|n| rest[1] + truth.offset(&rest[1], n));
    assert_relative_eq!(at_1, Point3::new(1.5, -1.2, 1.0), epsilon = 1e-12);
    assert_relative_eq!(at_3, Point3::new(1.5, 1.6, 1.0), epsilon = 1e-12);
    // Half of the way forth is behind it at time 1.5; at 2 it turns back.
    let x = |n| truth.translation_step(n).x;
    assert_relative_eq!(x(1), 0.05, epsilon = 1e-12);
    assert_relative_eq!(x(2), -0.05, epsilon = 1e-12);
    let known = polygon_with("[noise]", &format!("[known_motion]\n{keys}")).unwrap();
    let believed = known.believed_motion(&rest).unwrap();
    assert_eq!(believed.feature_motion(&rest[1], 2), Vector3::zeros());
}

#[test]
fn both_rotations_of_the_third_scenario_turn_about_different_axes() {
    let rotating = parsed(ROTATING).unwrap();
    assert_eq!(
        rotating.noise.deformation_noise,
        DeformationNoise::Accumulating
    );
    let motion = rotating.true_motion(&positions(&rotating)).unwrap();
    let axis = |rotation: &dyn adslam_deformation::Rotation| rotation.at(2.0).axis().unwrap();
    assert!(axis(&*motion.r_t).dot(&axis(&*motion.r_d)).abs() < 1e-12);
    assert_relative_eq!(
        motion.r_t.at(2.0).angle(),
        23_f64.to_radians(),
        epsilon = 1e-12
    );
    assert_relative_eq!(
        motion.r_d.at(2.0).angle(),
        8_f64.to_radians(),
        epsilon = 1e-12
    );
}

#[test]
fn every_generator_can_be_written() {
    let text = POLYGON
        .replace(
            "[motion.translation.back_and_forth]",
            "[motion.translation.sinusoid]",
        )
        .replace(
            "step_cm =",
            "period_steps = 8\nphase_deg = 90\namplitude_cm =",
        )
        .replace(
            "[motion.deformation.anchored]",
            "[motion.deformation.anchored_sinusoid]",
        )
        .replace("\"horizontal\"", "\"radial\"")
        .replace(
            "amounts_cm = [0.0, 0.2, 0.4, 0.6, 0.4, 0.2]",
            "amplitude_cm = 0.5\nperiod_steps = 4",
        );
    let scenario = parsed(&text).unwrap();
    let rest = positions(&scenario);
    let motion = scenario.true_motion(&rest).unwrap();
    assert_relative_eq!(
        motion.translation_step(1).x,
        0.1 * (PI / 4.0).cos() - 0.1,
        epsilon = 1e-12
    );
    assert_relative_eq!(motion.offset(&rest[1], 2).norm(), 0.5, epsilon = 1e-12);
    let none = polygon_with(
        "[motion.translation.back_and_forth]\nstep_cm = [0.1, 0.0, 0.0]",
        "[motion]\ntranslation = \"none\"",
    );
    assert_eq!(none.unwrap().motion.translation, Translation::None);
}

#[test]
fn an_anchor_beyond_the_features_found_is_an_error() {
    let heart = parsed(&HEART.replace("anchor = 0", "anchor = 45")).unwrap();
    let error = heart.true_motion(&[Point3::origin(); 43]).unwrap_err();
    assert_eq!(error.pointed_at(), Some("45"));
    assert!(error.message().contains("43"), "{error}");
}

#[test]
fn a_mesh_from_the_command_line_takes_the_placement_of_the_scenario() {
    let Object::Mesh(mesh) = parsed(HEART).unwrap().with_mesh("Heart.stl").object else {
        panic!("no mesh")
    };
    assert_eq!(mesh.file, Path::new("Heart.stl"));
    assert_eq!(mesh.unit, LengthUnit::Mm);
    assert_eq!(*mesh.offset_cm, Vector3::new(5.0, 18.0, 110.0));
    assert_eq!((mesh.features.get(), mesh.feature_seed.get()), (50, 1));
}

#[test]
fn a_mesh_file_counts_from_the_scenarios_folder() {
    let text = HEART.replace(
        "[object.phantom]",
        "[object.mesh]\nfile = \"heart.stl\"\nunit = \"cm\"",
    );
    let scenario = Scenario::parse(&text, Path::new("some/where/x.toml")).unwrap();
    let Object::Mesh(mesh) = &scenario.object else {
        panic!("no mesh")
    };
    assert_eq!(mesh.file, Path::new("some/where/heart.stl"));
    assert_eq!(mesh.unit.in_cm(), 1.0);

    let without_placement = text.replace(
        "[mesh_placement]\nunit = \"mm\"\noffset_cm = [5.0, 18.0, 110.0]",
        "",
    );
    let own = parsed(&without_placement).unwrap().with_mesh("other.stl");
    let Object::Mesh(mesh) = &own.object else {
        panic!("no mesh")
    };
    assert_eq!(
        (mesh.unit, mesh.file.as_path()),
        (LengthUnit::Cm, Path::new("other.stl"))
    );
}
