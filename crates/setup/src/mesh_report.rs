//! What a mesh file holds, and whether it will serve as an object: `adslam mesh`.

use std::fmt;
use std::path::{Path, PathBuf};

use adslam_diagnostics::InputError;
use adslam_names::{LengthUnit, Named};
use adslam_scenario::values::NonNegative;
use adslam_surface::{Inspection, Mesh, MeshFile, SurfaceError};
use serde::Serialize;

use crate::near_vertices;
use crate::rest_object::{features_of, parted};

/// An object whose largest extent is not within these bounds, cm, is probably a unit error.
const USUAL_EXTENT_CM: std::ops::RangeInclusive<f64> = 1.0..=200.0;

/// What a mesh file is looked at for.
#[derive(Clone, Copy, Debug)]
pub struct MeshUse {
    /// The unit that its coordinates are taken for.
    pub unit: LengthUnit,
    /// Vertices within this distance of each other are joined, cm.
    pub join_within_cm: NonNegative,
    /// Features that an object is to have.
    pub features: usize,
}

/// A mesh file looked at in a unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshReport {
    /// The file.
    pub file: PathBuf,
    /// STL, OBJ or PLY.
    pub format: String,
    /// Whether its numbers are stored as bytes rather than as text.
    pub binary: bool,
    /// The unit that its coordinates are taken for.
    pub unit: &'static str,
    /// Vertices, equal ones joined.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Triangles without a third corner, which are left out.
    pub collapsed_triangles: usize,
    /// Vertices within this distance of each other were joined, cm.
    pub join_within_cm: f64,
    /// How many were joined to another that was near and not equal.
    pub joined_vertices: usize,
    /// How far away the farthest of these was, cm.
    pub farthest_joined_cm: f64,
    /// If it is not closed: the distance within which its vertices have to be joined to close it, cm; none
    /// where that does not close it.
    pub closes_within_cm: Option<f64>,
    /// Parts that no edge joins to each other.
    pub components: usize,
    /// Whether every edge is shared by exactly two triangles.
    pub closed: bool,
    /// Edges of one triangle: the borders of holes.
    pub boundary_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges whose triangles do not turn the same way round.
    pub twisted_edges: usize,
    /// Least coordinates, cm; none where a coordinate is no number.
    pub min_cm: Option<[f64; 3]>,
    /// Greatest coordinates, cm.
    pub max_cm: Option<[f64; 3]>,
    /// Area, cm².
    pub area_cm2: f64,
    /// Enclosed volume, cm³, negative if the triangles turn inward; none unless closed and not
    /// twisted.
    pub volume_cm3: Option<f64>,
    /// Features that were to be found.
    pub features: usize,
    /// Whether a scenario can have it as its object, with so many features.
    pub serves: bool,
    /// Why not.
    pub problem: Option<String>,
    /// What to do about that.
    pub remedy: Option<String>,
    /// What is no problem but may not be meant.
    pub notes: Vec<String>,
}

impl MeshReport {
    /// Looks at the mesh in `path` for a use.
    ///
    /// # Errors
    /// When the file cannot be read as a mesh at all. That a mesh will not serve is no error here.
    pub fn read(path: &Path, wanted: MeshUse) -> Result<Self, InputError> {
        let read = MeshFile::read(path).map_err(|error| {
            let text = error.to_string();
            let (message, remedy) = parted(&text);
            let error = InputError::about_file(path, message);
            match remedy {
                Some(remedy) => error.with_help(remedy),
                None => error,
            }
        })?;
        Ok(Self::of(read, path, wanted))
    }

    /// Looks at what was read from the file at `path`, as [`MeshReport::read`] does.
    #[must_use]
    pub fn of(read: MeshFile, path: &Path, wanted: MeshUse) -> Self {
        let MeshUse {
            unit,
            join_within_cm,
            features,
        } = wanted;
        let MeshFile {
            format,
            is_binary,
            mesh,
            collapsed,
            mut notes,
        } = read;
        let mut mesh = mesh.scaled_and_moved(unit.in_cm(), nalgebra::Vector3::zeros());
        let joined = mesh.join_within(*join_within_cm);
        notes.extend(near_vertices::joined_note(&joined, *join_within_cm, 1.0));
        let seen = Inspection::of(&mesh);
        let trouble = will_serve(&mesh, features).err();
        let text = trouble.map(|error| error.to_string());
        let (problem, remedy) = text.as_deref().map(parted).unzip();
        let (closes_within_cm, advice) = near_vertices::closing_advice(&mesh, 1.0).unzip();
        let remedy = advice.or(remedy.flatten().map(str::to_owned));
        let bounds = seen
            .bounds
            .filter(|(low, high)| low.iter().chain(high.iter()).all(|c| c.is_finite()));
        let mut report = Self {
            file: path.to_owned(),
            format: format.to_string(),
            binary: is_binary,
            unit: unit.as_str(),
            vertices: seen.vertices,
            triangles: seen.faces,
            collapsed_triangles: collapsed + joined.collapsed,
            join_within_cm: *join_within_cm,
            joined_vertices: joined.vertices,
            farthest_joined_cm: joined.farthest,
            closes_within_cm,
            components: seen.components,
            closed: seen.is_closed(),
            boundary_edges: seen.boundary_edges,
            non_manifold_edges: seen.crowded_edges,
            twisted_edges: seen.twisted_edges,
            min_cm: bounds.map(|(low, _)| low.into()),
            max_cm: bounds.map(|(_, high)| high.into()),
            area_cm2: seen.area,
            volume_cm3: seen.volume,
            features,
            serves: problem.is_none(),
            problem: problem.map(str::to_owned),
            remedy,
            notes,
        };
        let remarks = report.remarks();
        report.notes.extend(remarks);
        report
    }

    /// An error if it will not serve.
    ///
    /// # Errors
    /// [`MeshReport::problem`] with its remedy.
    pub fn into_result(self) -> Result<(), InputError> {
        let Some(problem) = self.problem else {
            return Ok(());
        };
        let message = format!(
            "{} will not serve as an object: {problem}",
            self.file.display()
        );
        let error = InputError::about_file(&self.file, message);
        Err(match self.remedy {
            Some(remedy) => error.with_help(remedy),
            None => error,
        })
    }

    /// Length, width and height, cm.
    #[must_use]
    pub fn size_cm(&self) -> Option<[f64; 3]> {
        let (low, high) = (self.min_cm?, self.max_cm?);
        Some(std::array::from_fn(|i| high[i] - low[i]))
    }

    fn remarks(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let largest = self
            .size_cm()
            .map(|size| size.into_iter().fold(0.0, f64::max));
        if let Some(largest) = largest.filter(|size| !USUAL_EXTENT_CM.contains(size)) {
            notes.push(format!(
                "it is {largest:.3} cm long if its unit is {}; is it another?",
                self.unit
            ));
        }
        if self.components > 1 {
            notes.push(format!(
                "it has {} parts that are not joined; all are taken for one object",
                self.components
            ));
        }
        if self.twisted_edges > 0 {
            notes.push(format!(
                "at {} edges the triangles do not turn the same way round, so its volume is \
                 not known",
                self.twisted_edges
            ));
        }
        if self.volume_cm3.is_some_and(|volume| volume < 0.0) {
            notes.push("its triangles turn inward; that does no harm".to_owned());
        }
        if self.collapsed_triangles > 0 {
            notes.push(format!(
                "{} triangles without a third corner are left out",
                self.collapsed_triangles
            ));
        }
        notes
    }
}

/// What a scenario does with a mesh before it runs.
fn will_serve(mesh: &Mesh, features: usize) -> Result<(), SurfaceError> {
    mesh.check_closed()?;
    features_of(mesh, features, 1).map(drop)
}

impl fmt::Display for MeshReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.binary { "binary" } else { "text" };
        writeln!(
            f,
            "{}: {}, {kind}, taken as {}",
            self.file.display(),
            self.format,
            self.unit
        )?;
        let mut line = |name: &str, value: String| writeln!(f, "  {name:<20}{value}");
        line("vertices", self.vertices.to_string())?;
        line("triangles", self.triangles.to_string())?;
        line("parts", self.components.to_string())?;
        let closed = if self.closed { "yes" } else { "no" };
        line("closed", closed.to_owned())?;
        line("boundary edges", self.boundary_edges.to_string())?;
        line("non-manifold edges", self.non_manifold_edges.to_string())?;
        line("twisted edges", self.twisted_edges.to_string())?;
        let triple = |[x, y, z]: [f64; 3]| format!("{x:.2}, {y:.2}, {z:.2} cm");
        if let (Some(size), Some(low), Some(high)) = (self.size_cm(), self.min_cm, self.max_cm) {
            line("size", triple(size))?;
            line("from", triple(low))?;
            line("to", triple(high))?;
        }
        line("area", format!("{:.1} cm²", self.area_cm2))?;
        if let Some(volume) = self.volume_cm3 {
            line("volume", format!("{volume:.1} cm³"))?;
        }
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        if self.serves {
            write!(
                f,
                "It will serve as an object with {} features.",
                self.features
            )
        } else {
            write!(f, "It will not serve as an object.")
        }
    }
}
