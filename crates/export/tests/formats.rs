//! What is written, read back and compared with the run.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use std::collections::BTreeMap;
use std::path::Path;

use adslam_diagnostics::Interrupt;
use adslam_experiment::run::simulate;
use adslam_export::{Period, write_csv, write_mcap, write_ply};
use adslam_names::PlannerName;
use adslam_record::{DrawnSurface, HistoryRecorder, RunHistory};
use adslam_scenario::Scenario;
use adslam_setup::Setup;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use nalgebra::Point3;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Ply, Property};
use serde_json::Value;

const STEPS: usize = 4;

/// A short run around the heart, whose mesh is not its features' surface.
fn history() -> RunHistory {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/heart.toml");
    let mut setup = Setup::new(&Scenario::load(&path).unwrap()).unwrap();
    setup.model.steps = STEPS;
    let mut recorder = HistoryRecorder::new(&setup.model, PlannerName::PREDETERMINED, 1);
    let planner = PlannerName::PREDETERMINED;
    simulate(&setup, planner, 1, &Interrupt::new(), &mut recorder).unwrap();
    recorder.into_history()
}

/// The messages of each topic: time in ns, schema's name, schema, message.
type Topics = BTreeMap<String, Vec<(u64, String, Value, Value)>>;

fn mcap(history: &RunHistory, seconds: f64) -> Topics {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    write_mcap(history, Period::from_seconds(seconds).unwrap(), &path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    assert!(summary.stats.is_some(), "the file has its index");
    let mut topics = Topics::new();
    for message in mcap::MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let schema = message.channel.schema.clone().unwrap();
        assert_eq!(
            (
                schema.encoding.as_str(),
                message.channel.message_encoding.as_str()
            ),
            ("jsonschema", "json")
        );
        topics
            .entry(message.channel.topic.clone())
            .or_default()
            .push((
                message.log_time,
                schema.name.clone(),
                serde_json::from_slice(&schema.data).unwrap(),
                serde_json::from_slice(&message.data).unwrap(),
            ));
    }
    topics
}

/// Whether a message has just what its schema says, everywhere.
fn fits(schema: &Value, message: &Value, at: &str) {
    let is = schema["type"].as_str().unwrap();
    match (is, message) {
        ("object", Value::Object(fields)) => {
            let properties = schema["properties"].as_object().unwrap();
            let mut names: Vec<&String> = fields.keys().collect();
            let mut known: Vec<&String> = properties.keys().collect();
            names.sort();
            known.sort();
            // A step may lack numbers, such as the NEES of an exactly known pose.
            if schema["title"] == "adslam.Metrics" {
                assert!(
                    names.iter().all(|name| known.contains(name)),
                    "{at}: {names:?}"
                );
            } else {
                assert_eq!(names, known, "{at}");
            }
            for (name, value) in fields {
                fits(&properties[name], value, &format!("{at}.{name}"));
            }
        }
        ("array", Value::Array(items)) => {
            items
                .iter()
                .for_each(|item| fits(&schema["items"], item, at));
        }
        ("integer", Value::Number(n)) => assert!(n.is_u64(), "{at}: {n}"),
        ("number", Value::Number(_))
        | ("string", Value::String(_))
        | ("boolean", Value::Bool(_)) => {}
        (is, other) => panic!("{at} is {other}, not {is}"),
    }
}

fn xyz(value: &Value) -> [f64; 3] {
    ["x", "y", "z"].map(|axis| value[axis].as_f64().unwrap())
}

#[track_caller]
fn same_place(metres: [f64; 3], cm: [f64; 3]) {
    for (m, cm) in metres.into_iter().zip(cm) {
        assert!((100.0 * m - cm).abs() < 1e-6, "{m} m, {cm} cm");
    }
}

#[test]
fn mcap_has_every_topic_at_every_step_in_the_form_of_its_schema() {
    let history = history();
    let topics = mcap(&history, 0.25);
    let expected = [
        ("/features/estimate", "foxglove.PointCloud", 1),
        ("/features/truth", "foxglove.PointCloud", 1),
        ("/metrics", "adslam.Metrics", 1),
        ("/path/estimate", "foxglove.PosesInFrame", 1),
        ("/path/truth", "foxglove.PosesInFrame", 1),
        ("/pose/estimate", "foxglove.PoseInFrame", 1),
        ("/pose/truth", "foxglove.PoseInFrame", 1),
        ("/surface", "foxglove.SceneUpdate", 1),
        ("/tf", "foxglove.FrameTransform", 2),
        ("/uncertainty", "foxglove.SceneUpdate", 1),
    ];
    assert!(
        topics.keys().eq(expected.iter().map(|(topic, _, _)| topic)),
        "{:?}",
        topics.keys()
    );
    for (topic, name, per_step) in expected {
        let messages = &topics[topic];
        assert_eq!(messages.len(), per_step * STEPS, "{topic}");
        for (i, (time, schema_name, schema, message)) in messages.iter().enumerate() {
            let step = i / per_step + 1;
            assert_eq!(
                (*time, schema_name.as_str()),
                (step as u64 * 250_000_000, name)
            );
            fits(schema, message, topic);
        }
    }
}

#[test]
fn mcap_holds_the_run_in_metres() {
    let history = history();
    let topics = mcap(&history, 0.1);
    for (index, step) in history.steps.iter().enumerate() {
        let message = |topic: &str| &topics[topic][index].3;
        let pose = &message("/pose/estimate")["pose"];
        let [_, _, _, x, y, z] = step.estimated_pose;
        same_place(xyz(&pose["position"]), [x, y, z]);
        let q = step.estimate().orientation.quaternion();
        assert!((pose["orientation"]["w"].as_f64().unwrap() - q.w).abs() < 1e-12);
        assert_eq!(topics["/tf"][2 * index].3["child_frame_id"], "robot");

        let cloud = message("/features/truth");
        let data = BASE64_STANDARD
            .decode(cloud["data"].as_str().unwrap())
            .unwrap();
        let stride = usize::try_from(cloud["point_stride"].as_u64().unwrap()).unwrap();
        assert_eq!(data.len(), stride * step.features.len());
        for (i, point) in data.chunks(stride).enumerate() {
            let number = |at: usize| f64::from_le_bytes(point[at..at + 8].try_into().unwrap());
            same_place([number(0), number(8), number(16)], step.features[i]);
            assert_eq!(
                u32::from_le_bytes(point[24..28].try_into().unwrap()) as usize,
                i
            );
            assert_eq!(point[28] == 1, step.visible.contains(&i));
        }

        let surface = &message("/surface")["entities"][0]["triangles"][0];
        let vertices = history.drawn_vertices(index);
        let points = surface["points"].as_array().unwrap();
        assert_eq!(points.len(), vertices.len());
        for (point, vertex) in points.iter().zip(&vertices) {
            let off = Point3::from(xyz(point)) * 100.0 - vertex;
            assert!(off.amax() < 0.000_51, "{point}, {vertex}");
        }
        let indices = surface["indices"].as_array().unwrap();
        assert_eq!(indices.len(), 3 * history.drawn_faces().len());

        let spheres = &message("/uncertainty")["entities"][0]["spheres"];
        assert_eq!(spheres.as_array().unwrap().len(), step.features.len());
        let size = xyz(&spheres[0]["size"]).map(|s| 100.0 * s / 6.0);
        let variance: f64 = size.iter().map(|sigma| sigma * sigma).sum();
        let [xx, _, _, yy, _, zz] = step.feature_covariances[0];
        assert!((variance / (xx + yy + zz) - 1.0).abs() < 1e-3);
        let trace = message("/metrics")["trace"].as_f64().unwrap();
        assert_eq!(trace, step.metrics.trace);
    }
}

/// The way so far at every step, and the viewpoints once.
#[test]
fn mcap_has_paths_and_viewpoints() {
    let mut history = history();
    history.viewpoints_cm = vec![[1.0, 2.0, 3.0], [-4.0, 5.0, 6.0]];
    let topics = mcap(&history, 0.1);
    let poses = |topic: &str, i: usize| topics[topic][i].3["poses"].as_array().unwrap().clone();
    for index in 0..STEPS {
        for topic in ["/path/truth", "/path/estimate"] {
            let poses = poses(topic, index);
            assert_eq!(poses.len(), index + 1);
            for (pose, step) in poses.iter().zip(&history.steps) {
                let [_, _, _, x, y, z] = match topic {
                    "/path/truth" => step.pose,
                    _ => step.estimated_pose,
                };
                same_place(xyz(&pose["position"]), [x, y, z]);
            }
        }
    }
    assert_eq!(topics["/viewpoints"].len(), 1);
    let viewpoints = poses("/viewpoints", 0);
    assert_eq!(viewpoints.len(), 2);
    for (pose, place) in viewpoints.iter().zip(&history.viewpoints_cm) {
        same_place(xyz(&pose["position"]), *place);
    }
}

/// However many steps, the file grows with their number and not its square, and the end of a path is there.
#[test]
fn long_paths_are_thinned() {
    let mut history = history();
    let step = history.steps.pop().unwrap();
    history.drawn = DrawnSurface::Features;
    history.steps = (0..601)
        .map(|i| {
            let mut step = step.clone();
            step.pose[3] = f64::from(i);
            step
        })
        .collect();
    let topics = mcap(&history, 0.1);
    for (index, message) in topics["/path/truth"].iter().enumerate() {
        let poses = message.3["poses"].as_array().unwrap();
        assert!((1..=500).contains(&poses.len()) && poses.len() > index / 3);
        let last = xyz(&poses.last().unwrap()["position"]);
        assert!((100.0 * last[0] - index as f64).abs() < 1e-6);
    }
}

/// A surface that stays is written once; `/metrics` has a schema of its own that says what each number is.
#[test]
fn mcap_writes_what_is_new() {
    let mut history = history();
    let still = history.steps[1].object.clone();
    history.steps[2].object = still;
    let topics = mcap(&history, 0.1);
    let times: Vec<u64> = topics["/surface"].iter().map(|message| message.0).collect();
    assert_eq!(times, [1, 2, 4].map(|step| step * 100_000_000));
    for (_, name, schema, _) in &topics["/metrics"] {
        assert_eq!(
            (name.as_str(), &schema["title"]),
            ("adslam.Metrics", &Value::from(&**name))
        );
        for (metric, schema) in schema["properties"].as_object().unwrap() {
            let what = schema["description"].as_str().unwrap();
            let unit = metric.rsplit('_').next().unwrap();
            assert!(
                !["cm", "rad"].contains(&unit) || what.ends_with(unit),
                "{metric}: {what}"
            );
        }
    }
    let first = topics["/metrics"][0].3.as_object().unwrap();
    assert!(!first.contains_key("pose_nees"), "{first:?}");
    assert!(topics["/metrics"][3].3["pose_nees"].is_f64());
}

fn ply(path: &Path) -> Ply<DefaultElement> {
    let bytes = std::fs::read(path).unwrap();
    Parser::new().read_ply(&mut bytes.as_slice()).unwrap()
}

fn double(element: &DefaultElement, name: &str) -> f64 {
    match element[name] {
        Property::Double(value) => value,
        ref other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn ply_files_hold_surface_and_features_of_every_step() {
    let history = history();
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/ply");
    assert_eq!(write_ply(&history, &out).unwrap(), 2 * STEPS);
    for (index, step) in history.steps.iter().enumerate() {
        let surface = ply(&out.join(format!("surface-{:04}.ply", index + 1)));
        let vertices = history.drawn_vertices(index);
        assert_eq!(surface.payload["vertex"].len(), vertices.len());
        for (element, vertex) in surface.payload["vertex"].iter().zip(&vertices) {
            let place = ["x", "y", "z"].map(|axis| double(element, axis));
            assert_eq!(place, <[f64; 3]>::from(*vertex));
        }
        for (element, face) in surface.payload["face"].iter().zip(history.drawn_faces()) {
            let Property::ListInt(corners) = &element["vertex_indices"] else {
                panic!("{element:?}");
            };
            assert!(
                corners
                    .iter()
                    .map(|&i| usize::try_from(i).unwrap())
                    .eq(face.iter().copied())
            );
        }
        let features = ply(&out.join(format!("features-{:04}.ply", index + 1)));
        let elements = &features.payload["vertex"];
        assert_eq!(elements.len(), step.features.len());
        for (i, element) in elements.iter().enumerate() {
            let estimate = ["estimated_x", "estimated_y", "estimated_z"];
            assert_eq!(
                estimate.map(|name| double(element, name)),
                step.estimated_features[i]
            );
            assert_eq!(
                double(element, "sigma_y"),
                step.feature_covariances[i][3].sqrt()
            );
            let seen = u8::from(step.visible.contains(&i));
            assert_eq!(element["visible"], Property::UChar(seen));
        }
        assert!(
            features.header.comments[0].contains("cm"),
            "{:?}",
            features.header
        );
    }
}

#[test]
fn tables_hold_every_component_of_every_step() {
    let history = history();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("state.csv");
    write_csv(&history, &path).unwrap();
    let mut reader = csv::Reader::from_path(&path).unwrap();
    let header = "step,feature,component,unit,truth,estimate,sigma,visible";
    assert_eq!(
        reader
            .headers()
            .unwrap()
            .iter()
            .collect::<Vec<_>>()
            .join(","),
        header
    );
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let per_step = 6 + 3 * history.feature_count();
    assert_eq!(rows.len(), STEPS * per_step);
    let last = &history.steps[STEPS - 1];
    let start = (STEPS - 1) * per_step;
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    assert_eq!(
        &rows[start + 2].iter().take(4).collect::<Vec<_>>(),
        &["4", "", "yaw", "rad"]
    );
    assert_eq!(number(start + 2, 4), last.pose[2]);
    assert_eq!(number(start + 2, 6), last.pose_sigma[2]);
    let row = start + 6 + 3 * 7 + 1;
    assert_eq!(
        &rows[row].iter().take(4).collect::<Vec<_>>(),
        &["4", "7", "y", "cm"]
    );
    assert_eq!(number(row, 5), last.estimated_features[7][1]);
    assert_eq!(number(row, 6), last.feature_covariances[7][3].sqrt());
}
