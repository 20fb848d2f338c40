//! The one error type of this crate.

use std::path::PathBuf;

use crate::{MAX_COORDINATE_CM, MIN_COORDINATE_CM, MeshFormat};

/// What can be wrong with points, faces, mesh files and requests. Points and faces are numbered
/// from 0 and coordinates are in the unit of the input (cm unless a file says otherwise).
///
/// Every message is complete: it contains that of its cause, and `source` gives none.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A coordinate is NaN, infinite, or too large or too near to 0 for exact predicates.
    #[error(
        "point {index} lies at {at:?}: every coordinate must be finite, within \
         ±{MAX_COORDINATE_CM:e} cm, and no nearer to 0 than {MIN_COORDINATE_CM:e} cm but 0; check the unit and the estimate that it comes from"
    )]
    UnusablePoint {
        /// Number of the point.
        index: usize,
        /// Its coordinates.
        at: [f64; 3],
    },
    /// Fewer points than a solid has corners.
    #[error("{count} points cannot enclose a volume: give at least 4")]
    TooFewPoints {
        /// How many were given.
        count: usize,
    },
    /// Two points of a set are equal.
    #[error("points {first} and {second} are the same, {at:?}: remove or move one of them")]
    RepeatedPoint {
        /// Number of the first.
        first: usize,
        /// Number of the second.
        second: usize,
        /// Where both are.
        at: [f64; 3],
    },
    /// All points lie on one plane, line or spot.
    #[error("all {count} points lie on one plane: move at least one of them off it")]
    Flat {
        /// How many points were given.
        count: usize,
    },
    /// A surface without faces.
    #[error("there are no faces: a closed surface needs at least 4")]
    NoFaces,
    /// A face names a point that does not exist.
    #[error(
        "face {face} names point {point}, but there are {count} points, numbered from 0: correct \
         the index"
    )]
    UnknownPoint {
        /// Number of the face.
        face: usize,
        /// The index that is out of range.
        point: usize,
        /// How many points there are.
        count: usize,
    },
    /// A face with two equal corners.
    #[error("face {face} has point {point} as a corner twice: remove the face or mend its corners")]
    RepeatedCorner {
        /// Number of the face.
        face: usize,
        /// The point that is repeated.
        point: usize,
    },
    /// The faces do not close up.
    #[error(
        "the surface is not closed: {count} edges are not shared by exactly two faces, the first \
         by {shared}, between points {} {:?} and {} {:?}; fill the holes and remove inner or \
         doubled faces",
        edge[0], ends[0], edge[1], ends[1]
    )]
    Open {
        /// How many edges are wrong.
        count: usize,
        /// The two points of the first one.
        edge: [usize; 2],
        /// Their coordinates.
        ends: [[f64; 3]; 2],
        /// How many faces share it.
        shared: usize,
    },
    /// The surface has only one side, like a Klein bottle.
    #[error(
        "the faces cannot all be turned the same way round: the contradiction shows at face \
         {face}; a closed surface must have an inside"
    )]
    OneSided {
        /// A face at which the contradiction shows.
        face: usize,
    },
    /// A connected part of the surface that encloses nothing.
    #[error(
        "the part of the surface with face {face} encloses a volume of {volume_cm3} cm³, so that \
         its outside cannot be told: give a reference placement that is not flat"
    )]
    NoVolume {
        /// A face of that part.
        face: usize,
        /// Its signed volume.
        volume_cm3: f64,
    },
    /// A placement with the wrong number of points.
    #[error("{given} points were given for a topology over {expected}: give one for each")]
    PointCount {
        /// How many the topology has.
        expected: usize,
        /// How many were given.
        given: usize,
    },
    /// The operating system could not read a file.
    #[error("cannot read the file: {cause}; check that it exists and may be read")]
    Unreadable {
        /// What the operating system said.
        cause: std::io::Error,
    },
    /// A directory or device where a file should be.
    #[error("this is not a regular file: give the path of an STL, OBJ or PLY file")]
    NotAFile,
    /// More bytes than [`MAX_MESH_BYTES`](crate::MAX_MESH_BYTES).
    #[error("the file has {bytes} bytes, more than the limit of {limit}: simplify the mesh")]
    TooManyBytes {
        /// Its size.
        bytes: u64,
        /// The most that is read.
        limit: u64,
    },
    /// More triangles than [`MAX_MESH_FACES`](crate::MAX_MESH_FACES).
    #[error("the mesh has {faces} triangles or more; the limit is {limit}: simplify the mesh")]
    TooManyFaces {
        /// How many were counted or announced.
        faces: u64,
        /// The most that is read.
        limit: u64,
    },
    /// A concave polygon of very many corners.
    #[error(
        "a polygon that is not convex has {corners} corners, and {limit} are the most: cut it into triangles in the \
         program that it comes from"
    )]
    LongPolygon {
        /// How many it has.
        corners: usize,
        /// The most that are cut.
        limit: usize,
    },
    /// A file of no bytes or no triangles.
    #[error("the file holds no triangles: export the mesh again")]
    EmptyMesh,
    /// A binary STL file whose size does not fit its header.
    #[error(
        "the binary STL header announces {faces} triangles, {expected} bytes in all, but there \
         are {given} bytes: the file is damaged, cut short or not STL; export it again"
    )]
    WrongSize {
        /// Triangles by the header.
        faces: u64,
        /// Bytes that these need.
        expected: u64,
        /// Bytes that there are.
        given: u64,
    },
    /// Bytes that are not of the format they should be.
    #[error("this cannot be read as {format}, {place}: {reason}; export the mesh again")]
    Malformed {
        /// What it should be.
        format: MeshFormat,
        /// Where the reader stopped, such as a line or a triangle.
        place: String,
        /// What is wrong there.
        reason: String,
    },
    /// A file whose name says one format and whose content another.
    #[error(
        "the name says {named}, and the content is {found}; let the name end in .{}",
        found.extension()
    )]
    OtherFormat {
        /// What the name says.
        named: MeshFormat,
        /// What the content is.
        found: MeshFormat,
    },
    /// A file whose name says no format that is read.
    #[error("{}", unknown_format(*found))]
    UnknownFormat {
        /// What the content looks like.
        found: Option<MeshFormat>,
    },
    /// An error in a file, with the path.
    #[error("mesh file {}: {cause}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        cause: Box<SurfaceError>,
    },
    /// A grid spacing that the phantom cannot be built with.
    #[error(
        "a phantom with a spacing of {spacing_cm} cm cannot be built: use {min_cm} to {max_cm} cm"
    )]
    Spacing {
        /// What was asked for.
        spacing_cm: f64,
        /// Finest allowed.
        min_cm: f64,
        /// Coarsest allowed.
        max_cm: f64,
    },
    /// A number of features that no solid can have.
    #[error("{count} features cannot be picked: a hull has at least 4 corners")]
    FeatureCount {
        /// What was asked for.
        count: usize,
    },
    /// A mesh whose hull never has the corners asked for.
    #[error(
        "no {wanted} of the mesh's {vertices} vertices are found in convex position with this \
         seed: {found} at most; ask for fewer features or use a finer mesh"
    )]
    TooFewFeatures {
        /// What was asked for.
        wanted: usize,
        /// The most corners that a hull had on the way.
        found: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
}

impl From<std::io::Error> for SurfaceError {
    fn from(cause: std::io::Error) -> Self {
        Self::Unreadable { cause }
    }
}

fn unknown_format(found: Option<MeshFormat>) -> String {
    match found {
        Some(found) => format!(
            "the name does not say what format it is of, and the content looks like {found}; let \
             the name end in .{}",
            found.extension()
        ),
        None => "the name ends in none of .stl, .obj and .ply; export the mesh in one of these \
                 formats"
            .to_owned(),
    }
}
