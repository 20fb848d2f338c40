//! The object as it is before it moves, and what is said if it cannot be built.

use adslam_diagnostics::InputError;
use adslam_scenario as scenario;
use adslam_scenario::{Object, Scenario, values};
use adslam_surface::{Mesh, MeshFile, SurfaceError, Topology, heart_phantom, pick_features};
use nalgebra::Point3;

use crate::near_vertices;

/// Features, the surface over them, the surface that is drawn, and what is to be known of the file
/// that it was read from.
pub(super) struct RestObject {
    pub(super) features: Vec<Point3<f64>>,
    pub(super) topology: Topology,
    pub(super) drawn: Mesh,
    pub(super) notes: Vec<String>,
}

impl RestObject {
    pub(super) fn build(scenario: &Scenario) -> Result<Self, InputError> {
        let blame = |key: &'static str| move |error| blamed(scenario, key, &error);
        match &scenario.object {
            Object::Points(points) => {
                let features: Vec<Point3<f64>> =
                    points.positions_cm.iter().map(|p| p.point()).collect();
                let topology = match &points.faces {
                    Some(faces) => {
                        let faces: Vec<[usize; 3]> =
                            faces.iter().map(|face| face.map(|n| n.get())).collect();
                        Topology::from_faces(&features, &faces)
                            .map_err(blame("object.points.faces"))?
                    }
                    None => Topology::convex_hull(&features)
                        .map_err(blame("object.points.positions_cm"))?,
                };
                let faces = topology.faces().to_vec();
                let drawn = Mesh {
                    vertices: features.clone(),
                    faces,
                };
                Ok(Self {
                    features,
                    topology,
                    drawn,
                    notes: Vec::new(),
                })
            }
            Object::Mesh(mesh) => {
                refuse_missing(scenario, mesh)?;
                let (read, notes) = closed_mesh(scenario, mesh)?;
                let object = Self::picked(mesh.placed(read), mesh.features, mesh.feature_seed)
                    .map_err(blame("object.mesh.features"))?;
                Ok(Self { notes, ..object })
            }
            Object::Phantom(phantom) => {
                let generated = heart_phantom(*phantom.spacing_cm)
                    .map_err(blame("object.phantom.spacing_cm"))?;
                Self::picked(generated, phantom.features, phantom.feature_seed)
                    .map_err(blame("object.phantom.features"))
            }
        }
    }

    fn picked(
        drawn: Mesh,
        count: values::FeatureCount,
        seed: values::Seed,
    ) -> Result<Self, SurfaceError> {
        let (features, topology) = features_of(&drawn, count.get(), seed.as_u64())?;
        Ok(Self {
            features,
            topology,
            drawn,
            notes: Vec::new(),
        })
    }
}

/// The mesh in its own unit, its near vertices joined, and the notes on it.
fn closed_mesh(
    scenario: &Scenario,
    given: &scenario::Mesh,
) -> Result<(Mesh, Vec<String>), InputError> {
    let blame = |error| blamed(scenario, "object.mesh.file", &error);
    let MeshFile {
        mut mesh,
        mut notes,
        ..
    } = MeshFile::read(&given.file).map_err(blame)?;
    let in_cm = given.unit.in_cm();
    let joined = mesh.join_within(*given.join_within_cm / in_cm);
    notes.extend(near_vertices::joined_note(
        &joined,
        *given.join_within_cm,
        in_cm,
    ));
    let Err(cause) = mesh.check_closed() else {
        let file = given.file.display();
        let about_file = |note| format!("mesh file {file}: {note}");
        return Ok((mesh, notes.into_iter().map(about_file).collect()));
    };
    let error = blame(SurfaceError::InFile {
        path: given.file.clone(),
        cause: Box::new(cause),
    });
    Err(match near_vertices::closing_advice(&mesh, in_cm) {
        Some((_, advice)) => error.with_help(advice),
        None => error,
    })
}

/// So many vertices of the mesh, and the hull over them.
pub fn features_of(
    mesh: &Mesh,
    count: usize,
    seed: u64,
) -> Result<(Vec<Point3<f64>>, Topology), SurfaceError> {
    let picked = pick_features(mesh, count, seed)?;
    let features: Vec<Point3<f64>> = picked.iter().map(|&i| mesh.vertices[i]).collect();
    let topology = Topology::convex_hull(&features)?;
    Ok((features, topology))
}

fn refuse_missing(scenario: &Scenario, mesh: &scenario::Mesh) -> Result<(), InputError> {
    if mesh.file.exists() {
        return Ok(());
    }
    let message = format!("there is no file {}", mesh.file.display());
    Err(if scenario.mesh_is_given {
        InputError::about_file(&mesh.file, message)
            .with_help("--mesh takes the path of an STL, OBJ or PLY file, from the current folder")
    } else {
        scenario
            .error_at("object.mesh.file", message)
            .with_help("the path counts from the scenario's folder")
    })
}

/// An error of the surface as one of the input: at `key` of the scenario, or about the mesh file
/// that was given beside it.
pub(super) fn blamed(scenario: &Scenario, key: &str, error: &SurfaceError) -> InputError {
    let text = error.to_string();
    let (message, remedy) = parted(&text);
    let remedy = remedy.unwrap_or("docs/scenario.md says what an object needs");
    let error = match &scenario.object {
        Object::Mesh(mesh) if scenario.mesh_is_given => {
            let file = mesh.file.display().to_string();
            let message = if message.contains(&file) {
                message.to_owned()
            } else {
                format!("mesh file {file}: {message}")
            };
            InputError::about_file(&mesh.file, message)
        }
        _ => scenario.error_at(key, message),
    };
    error.with_help(remedy)
}

/// The message of a surface's error without the remedy that ends it, after a semicolon or else a
/// colon, and that remedy.
pub fn parted(text: &str) -> (&str, Option<&str>) {
    let parted = text.rsplit_once("; ").or_else(|| text.rsplit_once(": "));
    parted.map_or((text, None), |(message, remedy)| (message, Some(remedy)))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    const POLYGON: &str = include_str!("../../../scenarios/polygon.toml");

    #[test]
    fn messages_of_surfaces_are_parted_from_their_remedies() {
        let scenario = Scenario::parse(POLYGON, Path::new("polygon.toml")).unwrap();
        let given = scenario.clone().with_mesh("heart.stl");
        for (error, message, remedy) in [
            (
                SurfaceError::Flat { count: 5 },
                "all 5 points lie on one plane",
                "move at least one of them off it",
            ),
            (
                SurfaceError::TooFewFeatures {
                    wanted: 50,
                    found: 4,
                    vertices: 8,
                },
                "no 50 of the mesh's 8 vertices are found in convex position with this seed: 4 at \
                 most",
                "ask for fewer features or use a finer mesh",
            ),
        ] {
            let at = blamed(&scenario, "object", &error);
            assert_eq!((at.message(), at.remedy()), (message, Some(remedy)));
            assert!(at.span().is_some());
            let about = blamed(&given, "object", &error);
            assert_eq!(about.message(), format!("mesh file heart.stl: {message}"));
            assert_eq!((about.remedy(), about.span()), (Some(remedy), None));
        }
    }
}
