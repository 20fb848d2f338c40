//! The observer that remembers a run.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_models::{Control, FeatureId, Pose};
use adslam_names::{Look, PlannerName};
use adslam_simulation::{EpisodeModel, StepView};
use nalgebra::{Point3, Vector3};

use super::compact::{coarse, covariance, decimals, digits, fine, vector};
use super::{
    DrawnSurface, HISTORY_FORMAT, HISTORY_VERSION, HistoryDecision, HistoryMetrics, HistoryStep,
    ObjectStep, RunHistory,
};
use crate::{AtomicFile, Observer};

/// Remembers every step of a run as a [`RunHistory`].
#[derive(Clone, Debug)]
pub struct HistoryRecorder {
    model: EpisodeModel,
    history: RunHistory,
    base: Vector3<f64>,
    seen: Vec<bool>,
}

impl HistoryRecorder {
    /// Ready for the run of `planner` with `seed` that an [`Episode`](adslam_simulation::Episode) is about
    /// to do.
    #[must_use]
    pub fn new(model: &EpisodeModel, planner: PlannerName, seed: u64) -> Self {
        let planning = &model.planning;
        let controls = planning.actions.controls();
        Self {
            model: model.clone(),
            history: RunHistory {
                format: HISTORY_FORMAT.to_owned(),
                version: HISTORY_VERSION,
                scenario: model.name.clone(),
                planner,
                planner_look: None,
                seed,
                sensor_min_cm: planning.sensor.min_range,
                sensor_max_cm: planning.sensor.max_range,
                clearance_cm: planning.clearance,
                topology: planning.topology.faces().to_vec(),
                drawn: drawn_surface(model),
                actions: controls.iter().map(control_numbers).collect(),
                viewpoints_cm: Vec::new(),
                steps: Vec::new(),
            },
            base: Vector3::zeros(),
            seen: vec![false; model.world.rest.len()],
        }
    }

    /// Shown as this planner looks, where its name does not say it.
    #[must_use]
    pub fn with_look(mut self, look: Option<Look>) -> Self {
        self.history.planner_look = look;
        self
    }

    /// What has been seen so far.
    #[must_use]
    pub const fn history(&self) -> &RunHistory {
        &self.history
    }

    /// The run, to draw it without a file.
    #[must_use]
    pub fn into_history(self) -> RunHistory {
        self.history
    }

    /// The run as a file that will lie in `folder`; it still has to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn finish(self, folder: &Path) -> Result<AtomicFile, Failure> {
        self.history.to_file(folder)
    }

    /// Writes the run to `folder`; returns the path.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn commit(self, folder: &Path) -> Result<PathBuf, Failure> {
        let file = self.finish(folder)?;
        let path = file.path().to_owned();
        file.commit()?;
        Ok(path)
    }

    /// Where the object is at the step of `view`, noise apart.
    fn object(&self, n: usize) -> ObjectStep {
        let motion = &self.model.world.motion;
        let turn = motion.turn_at(n);
        let rows = |rotation| ObjectStep::rows(rotation).map(|x| decimals(x, 7));
        ObjectStep {
            base_cm: vector(&(self.base + turn.translation.vector)),
            turn: motion.turn.is_some().then(|| rows(&turn.rotation)),
            r_d: rows(&motion.r_d_at(n)),
            amounts: (0..motion.deformation.mode_count())
                .map(|k| decimals(motion.amount(k, n), 6))
                .collect(),
        }
    }

    fn decision(&self, view: &StepView<'_>) -> Option<HistoryDecision> {
        let (decision, milliseconds) = view.decision?;
        let mut scores: Vec<(usize, f64)> = view
            .scores
            .iter()
            .filter_map(|s| Some((s.index?, s.trace)))
            .collect();
        scores.sort_unstable_by_key(|(index, _)| *index);
        Some(HistoryDecision {
            control: control_numbers(&decision.control),
            action: self
                .model
                .planning
                .actions
                .controls()
                .iter()
                .position(|c| *c == decision.control),
            goal: decision.goal.map(|(place, _)| place),
            admissible: decision.admissible,
            safe: decision.safe,
            compromised: decision.compromised,
            predicted_trace: decision.predicted_trace.map(|trace| digits(trace, 7)),
            milliseconds: digits(milliseconds, 4),
            scored: scores.iter().map(|(index, _)| *index).collect(),
            traces: scores.iter().map(|(_, trace)| digits(*trace, 7)).collect(),
        })
    }

    fn metrics(&self, view: &StepView<'_>) -> HistoryMetrics {
        let m = view.metrics;
        let errors = &m.feature_errors;
        let number = |x: f64| digits(x, 6);
        HistoryMetrics {
            pose_error: number(m.pose_error),
            orientation_error_rad: number(m.orientation_error),
            position_error_cm: number(m.position_error),
            drift_floor_cm: Some(number(view.drift_floor)),
            relative_pose_error: number(m.relative_pose_error),
            feature_error_mean_cm: number(errors.iter().sum::<f64>() / errors.len().max(1) as f64),
            feature_error_max_cm: number(errors.iter().copied().fold(0.0, f64::max)),
            relative_feature_error_cm: number(m.relative_feature_error),
            pose_nees: m.pose_nees.map(number),
            feature_nees: m.feature_nees_mean().map(number),
            trace: digits(view.belief.covariance.trace(), 7),
            covered: self.seen.iter().filter(|seen| **seen).count(),
            surface_distance_cm: number(view.surface_distance),
        }
    }
}

impl Observer for HistoryRecorder {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        if view.step > 1 {
            self.base += self.model.world.motion.translation_step(view.step - 1);
        }
        for feature in view.visible {
            if let Some(seen) = self.seen.get_mut(feature.0) {
                *seen = true;
            }
        }
        let belief = view.belief;
        let sigma = belief
            .covariance
            .pose()
            .diagonal()
            .map(|v| v.max(0.0).sqrt());
        let count = belief.state.features.len();
        self.history.viewpoints_cm = points(view.viewpoints);
        self.history.steps.push(HistoryStep {
            pose: pose_numbers(view.pose),
            estimated_pose: pose_numbers(&belief.state.pose),
            pose_sigma: sigma.map(|s| digits(s, 5)).into(),
            features: points(view.features),
            estimated_features: points(&belief.state.features),
            feature_covariances: (0..count)
                .map(|i| covariance(&belief.covariance.feature(FeatureId(i))))
                .collect(),
            visible: view.visible.iter().map(|feature| feature.0).collect(),
            object: self.object(view.step),
            decision: self.decision(view),
            metrics: self.metrics(view),
        });
        Ok(())
    }
}

/// A drawn mesh that is the features' own surface is not stored twice.
fn drawn_surface(model: &EpisodeModel) -> DrawnSurface {
    let (drawn, topology) = (&model.drawn, &model.planning.topology);
    if drawn.vertices == model.world.rest && drawn.faces == topology.faces() {
        return DrawnSurface::Features;
    }
    let deformation = &model.world.motion.deformation;
    let mode = |k: usize| {
        let at = |p: &Point3<f64>| coarse(&deformation.mode(k, p));
        drawn.vertices.iter().map(at).collect()
    };
    DrawnSurface::Mesh {
        rest_cm: drawn.vertices.iter().map(|p| coarse(&p.coords)).collect(),
        faces: drawn.faces.clone(),
        modes: (0..deformation.mode_count()).map(mode).collect(),
    }
}

fn points(points: &[Point3<f64>]) -> Vec<[f64; 3]> {
    points.iter().map(|p| vector(&p.coords)).collect()
}

fn pose_numbers(pose: &Pose) -> [f64; 6] {
    pose.to_vector().map(fine).into()
}

fn control_numbers(control: &Control) -> [f64; 6] {
    let (r, t) = (&control.rotation, &control.translation);
    [r.x, r.y, r.z, t.x, t.y, t.z].map(|x| decimals(x, 7))
}
