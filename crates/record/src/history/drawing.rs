//! What pictures and replays ask of a history.

use adslam_models::{Control, Pose, move_pose};
use nalgebra::{Matrix3, Point3, Vector3, Vector6};

use super::{DrawnSurface, HistoryStep, RunHistory};

/// An action that was scored, and where it would have led.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// Its place in the action set.
    pub action: usize,
    /// The pose that it would lead to, without noise.
    pub pose: Pose,
    /// trace(Pₙ₊₁) after it, rad² + cm².
    pub trace: f64,
}

impl RunHistory {
    /// The number of features M.
    #[must_use]
    pub fn feature_count(&self) -> usize {
        self.steps.first().map_or(0, |step| step.features.len())
    }

    /// The triangles of the drawn surface.
    #[must_use]
    pub fn drawn_faces(&self) -> &[[usize; 3]] {
        match &self.drawn {
            DrawnSurface::Features => &self.topology,
            DrawnSurface::Mesh { faces, .. } => faces,
        }
    }

    /// The vertices of the drawn surface at `steps[index]`, cm; none if there is no such step.
    #[must_use]
    pub fn drawn_vertices(&self, index: usize) -> Vec<Point3<f64>> {
        let Some(step) = self.steps.get(index) else {
            return Vec::new();
        };
        let (rest, modes) = match &self.drawn {
            DrawnSurface::Features => return step.true_features(),
            DrawnSurface::Mesh { rest_cm, modes, .. } => (rest_cm, modes),
        };
        let object = &step.object;
        let base = Vector3::from(object.base_cm);
        let turn = object.turn.map(|rows| Matrix3::from_row_slice(&rows));
        let turn = turn.unwrap_or_else(Matrix3::identity);
        let r_d = Matrix3::from_row_slice(&object.r_d);
        let vertex = |(v, p): (usize, &[f64; 3])| {
            let fields = modes.iter().zip(&object.amounts);
            let displacement: Vector3<f64> = fields
                .filter_map(|(mode, amount)| Some(Vector3::from(*mode.get(v)?) * *amount))
                .sum();
            turn * (Point3::from(*p) + r_d * displacement) + base
        };
        rest.iter().enumerate().map(vertex).collect()
    }

    /// The actions that were scored for the decision that led to `steps[index]`, with the poses
    /// that they would have led to from the estimate of the step before.
    #[must_use]
    pub fn candidates(&self, index: usize) -> Vec<Candidate> {
        let before = index.checked_sub(1).and_then(|i| self.steps.get(i));
        let decision = self.steps.get(index).and_then(|s| s.decision.as_ref());
        let (Some(before), Some(decision)) = (before, decision) else {
            return Vec::new();
        };
        let from = Pose::from_vector(&Vector6::from(before.estimated_pose));
        let scored = decision.scored.iter().zip(&decision.traces);
        scored
            .filter_map(|(action, &trace)| {
                let [a, b, c, x, y, z] = *self.actions.get(action)?;
                let control = Control {
                    rotation: Vector3::new(a, b, c),
                    translation: Vector3::new(x, y, z),
                };
                let pose = move_pose(&from, &control, &Vector6::zeros());
                Some(Candidate {
                    action,
                    pose,
                    trace,
                })
            })
            .collect()
    }
}

impl HistoryStep {
    /// The true pose.
    #[must_use]
    pub fn true_pose(&self) -> Pose {
        Pose::from_vector(&Vector6::from(self.pose))
    }

    /// The estimated pose.
    #[must_use]
    pub fn estimate(&self) -> Pose {
        Pose::from_vector(&Vector6::from(self.estimated_pose))
    }

    /// The true features, cm.
    #[must_use]
    pub fn true_features(&self) -> Vec<Point3<f64>> {
        self.features.iter().map(|p| Point3::from(*p)).collect()
    }

    /// The covariance of feature `i`, cm²; none if there is no such feature.
    #[must_use]
    pub fn feature_covariance(&self, i: usize) -> Option<Matrix3<f64>> {
        let [xx, xy, xz, yy, yz, zz] = *self.feature_covariances.get(i)?;
        Some(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
    }
}
