//! A surface and a cloud of features for each step, as PLY.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_record::{AtomicFile, HistoryStep, RunHistory, prepare_folder};
use ply_rs_bw::ply::{
    Addable, Comment, ElementDef, Encoding, Ply, PropertyAccess, PropertyDef, PropertyType,
    ScalarType,
};
use ply_rs_bw::writer::Writer;

use crate::failed;

/// The numbers of a vertex or a feature, in the order of their properties, or the corners of a
/// face.
#[derive(Debug)]
enum Element {
    Numbers {
        names: &'static [&'static str],
        values: Vec<f64>,
        visible: u8,
    },
    Face(Vec<i32>),
}

const VERTEX: &[&str] = &["x", "y", "z"];
const FEATURE: &[&str] = &[
    "x",
    "y",
    "z",
    "estimated_x",
    "estimated_y",
    "estimated_z",
    "sigma_x",
    "sigma_y",
    "sigma_z",
];

/// Writes surface-0001.ply, the drawn surface, and features-0001.ply, the true features with
/// estimate, standard deviation and whether they are seen, and so on for each step into `folder`,
/// which is made if it does not exist; binary, world frame, cm. Returns how many files.
///
/// # Errors
/// A folder or file that cannot be written.
pub fn write_ply(history: &RunHistory, folder: &Path) -> Result<usize, Failure> {
    prepare_folder(folder)?;
    let about = |step: usize| {
        format!(
            "{}, {}, seed {}, step {step}; cm, world frame",
            history.scenario, history.planner, history.seed
        )
    };
    let faces: Vec<Vec<i32>> = history.drawn_faces().iter().map(corners).collect();
    for (index, step) in history.steps.iter().enumerate() {
        let number = index + 1;
        let path = |kind: &str| -> PathBuf { folder.join(format!("{kind}-{number:04}.ply")) };
        let surface = surface(history, index, &faces, about(number));
        write(&path("surface"), surface)?;
        write(&path("features"), features(step, about(number)))?;
    }
    Ok(2 * history.steps.len())
}

/// Vertices are far fewer than an `i32` counts; one that it cannot count would name none.
fn corners(face: &[usize; 3]) -> Vec<i32> {
    face.iter()
        .map(|&i| i32::try_from(i).unwrap_or(-1))
        .collect()
}

fn write(path: &Path, mut ply: Ply<Element>) -> Result<(), Failure> {
    let mut file = AtomicFile::create(path)?;
    Writer::new()
        .write_ply(&mut file, &mut ply)
        .map_err(failed(path))?;
    file.commit()
}

fn surface(history: &RunHistory, index: usize, faces: &[Vec<i32>], about: String) -> Ply<Element> {
    let vertices = history.drawn_vertices(index);
    let vertices = vertices.iter().map(|p| Element::Numbers {
        names: VERTEX,
        values: p.iter().copied().collect(),
        visible: 0,
    });
    let mut ply = document(about, VERTEX, false, vertices.collect());
    let mut face = ElementDef::new("face".to_owned());
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    face.properties
        .add(PropertyDef::new("vertex_indices".to_owned(), list));
    ply.header.elements.add(face);
    let faces = faces.iter().cloned().map(Element::Face).collect();
    ply.payload.insert("face".to_owned(), faces);
    ply
}

fn features(step: &HistoryStep, about: String) -> Ply<Element> {
    let all = step.features.iter().zip(&step.estimated_features);
    let all = all.zip(&step.feature_covariances).enumerate();
    let elements = all.map(|(i, ((truth, estimate), [xx, _, _, yy, _, zz]))| {
        let sigmas = [xx, yy, zz].map(|variance| variance.max(0.0).sqrt());
        Element::Numbers {
            names: FEATURE,
            values: [*truth, *estimate, sigmas].concat(),
            visible: u8::from(step.visible.contains(&i)),
        }
    });
    document(about, FEATURE, true, elements.collect())
}

fn document(
    about: String,
    numbers: &[&str],
    has_visible: bool,
    elements: Vec<Element>,
) -> Ply<Element> {
    let mut ply = Ply::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    ply.header.comments.push(about as Comment);
    let mut definition = ElementDef::new("vertex".to_owned());
    let mut property = |name: &str, kind: ScalarType| {
        let kind = PropertyType::Scalar(kind);
        definition
            .properties
            .add(PropertyDef::new(name.to_owned(), kind));
    };
    for name in numbers {
        property(name, ScalarType::Double);
    }
    if has_visible {
        property("visible", ScalarType::UChar);
    }
    ply.header.elements.add(definition);
    ply.payload.insert("vertex".to_owned(), elements);
    ply
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::Face(Vec::new())
    }

    fn get_double(&self, name: &str) -> Option<f64> {
        let Self::Numbers { names, values, .. } = self else {
            return None;
        };
        let place = names.iter().position(|known| *known == name)?;
        values.get(place).copied()
    }

    fn get_uchar(&self, name: &str) -> Option<u8> {
        match self {
            Self::Numbers { visible, .. } if name == "visible" => Some(*visible),
            _ => None,
        }
    }

    fn get_list_int(&self, name: &str) -> Option<&[i32]> {
        match self {
            Self::Face(corners) if name == "vertex_indices" => Some(corners),
            _ => None,
        }
    }
}
