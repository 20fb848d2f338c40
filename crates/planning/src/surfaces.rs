//! The object as the belief has it, before and after its known motion.

use adslam_surface::Surface;
use nalgebra::Point3;

use crate::{PlanningError, Situation};

/// The surface of the estimated features before and after their known motion, kept from decision to
/// decision.
#[derive(Clone, Debug, Default)]
pub struct ObjectSurfaces {
    placed: Option<[Surface; 2]>,
    moved: Vec<Point3<f64>>,
}

impl ObjectSurfaces {
    /// The surfaces of a situation: as the object is estimated to be now, and as it will be.
    /// Allocates for the first situation of a topology only.
    ///
    /// # Errors
    /// Estimates that do not fit the surface's faces or are not finite.
    pub fn place(&mut self, situation: &Situation<'_>) -> Result<[&Surface; 2], PlanningError> {
        let topology = &situation.model.topology;
        let features = &situation.belief.state.features;
        self.moved.clear();
        let moved = features.iter().zip(situation.feature_motion);
        self.moved.extend(moved.map(|(p, motion)| p + motion));
        let known = self.placed.take().filter(|[now, _]| now.is_over(topology));
        let [mut now, mut after] = match known {
            Some(surfaces) => surfaces,
            None => {
                let now = Surface::new(topology, features)?;
                [now.clone(), now]
            }
        };
        now.place(features)?;
        after.place(&self.moved)?;
        Ok(self.placed.insert([now, after]).each_ref())
    }
}
