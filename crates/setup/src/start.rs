//! What can be said of a scenario before it runs: what cannot work, and what is worth a warning.

use adslam_diagnostics::InputError;
use adslam_models::predicted_pose;
use adslam_names::numbers;
use adslam_planning::can_be_reached;
use adslam_scenario::Viewpoints;
use adslam_surface::Surface;
use nalgebra::Point3;

use super::Setup;
use super::rest_object::blamed;

impl Setup {
    /// Looks at the start: a robot inside the object is refused, as are viewpoints of which none can be
    /// visited; one too near, actions that all lead beyond the limits, viewpoints that cannot be reached, and features
    /// that can never be seen are worth a warning.
    pub(crate) fn checked(mut self) -> Result<Self, InputError> {
        let at_start: Vec<Point3<f64>> = self
            .model
            .world
            .rest
            .iter()
            .map(|p| p + self.model.world.motion.offset(p, 1))
            .collect();
        let surface = Surface::new(&self.model.planning.topology, &at_start)
            .map_err(|error| blamed(&self.scenario, "object", &error))?;
        let distance = surface.signed_distance(&self.model.world.start.position);
        if distance <= 0.0 {
            let message = format!(
                "the robot starts {:.3} cm inside the object, where it can neither move nor see",
                -distance
            );
            return Err(self
                .scenario
                .error_at("robot.start_cm", message)
                .with_help("move the start, or the object, so that the robot is outside"));
        }
        let of_viewpoints = self.check_viewpoints(&surface)?;
        let clearance = self.model.planning.clearance;
        if distance <= clearance {
            self.warnings.push(format!(
                "{}: the robot starts {distance:.3} cm from the object, nearer than its clearance \
                 of {clearance} cm; it may have no safe action at first",
                self.model.name
            ));
        }
        if !self.keeps_limits_at_first() {
            self.warnings.push(format!(
                "{}: no action keeps the limits of roll and pitch from the start; planners waive them until one \
                 does",
                self.model.name
            ));
        }
        self.warnings.extend(of_viewpoints);
        let hidden = self.model.planning.topology.points_off_surface();
        if !hidden.is_empty() {
            self.warnings.push(format!(
                "{}: features {} are not on the object's surface and will never be seen",
                self.model.name,
                numbers(hidden)
            ));
        }
        Ok(self)
    }

    fn keeps_limits_at_first(&self) -> bool {
        let actions = &self.model.planning.actions;
        let after = |control| predicted_pose(&self.model.world.start, control).orientation;
        let mut controls = actions.controls().iter();
        controls.any(|control| actions.admits(after(control)))
    }

    /// A viewpoint inside the object cannot be visited. What the user should know of the others.
    fn check_viewpoints(&self, surface: &Surface) -> Result<Option<String>, InputError> {
        let reached_within = *self.scenario.planners.global.reached_within_cm;
        let clearance = self.model.planning.clearance;
        let inside = |p: &Point3<f64>| surface.signed_distance(p) <= 0.0;
        let reached = |p: &Point3<f64>| can_be_reached(p, surface, clearance, reached_within);
        match &self.scenario.viewpoints {
            Viewpoints::Fixed(fixed) => {
                let points: Vec<Point3<f64>> =
                    fixed.positions_cm.iter().map(|p| p.point()).collect();
                if let Some(i) = points.iter().position(inside) {
                    let key = format!("viewpoints.fixed.positions_cm[{i}]");
                    return Err(self
                        .scenario
                        .error_at(&key, "this viewpoint lies inside the object")
                        .with_help("move it outside"));
                }
                let too_near: Vec<usize> = (0..points.len())
                    .filter(|&i| !reached(&points[i]))
                    .collect();
                Ok((!too_near.is_empty()).then(|| {
                    format!(
                        "{}: viewpoints {} cannot be reached: a robot that keeps its clearance of {clearance} cm \
                         from the object at rest does not come within {reached_within} cm of them",
                        self.model.name,
                        numbers(too_near)
                    )
                }))
            }
            Viewpoints::Sampled(grid) => {
                let candidates = grid.candidates();
                if candidates.iter().any(reached) {
                    return Ok(None);
                }
                let count = candidates.len();
                let (message, help) = if candidates.iter().all(inside) {
                    (
                        format!("none of the {count} viewpoint candidates lies outside the object"),
                        "widen the grid, or make it finer",
                    )
                } else {
                    (
                        format!(
                            "none of the {count} viewpoint candidates can be reached: a robot that keeps its \
                             clearance of {clearance} cm does not come within {reached_within} cm of any"
                        ),
                        "widen the grid, or raise planners.global.reached_within_cm",
                    )
                };
                Err(self
                    .scenario
                    .error_at("viewpoints.sampled", message)
                    .with_help(help))
            }
        }
    }
}
