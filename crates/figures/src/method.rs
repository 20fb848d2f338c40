//! A method, as all figures show it.

use adslam_names::{Look, PlannerName};
use adslam_record::RunHistory;

use crate::style::{AXIS, Colour, Stroke};

/// A planner with its look.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Method {
    name: PlannerName,
    look: Look,
}

impl Method {
    /// A planner with a look of its own, or that by which all know it.
    #[must_use]
    pub fn new(name: PlannerName, look: Option<Look>) -> Self {
        Self {
            name,
            look: look.unwrap_or_else(|| Look::of_planner(name)),
        }
    }

    /// That of a run.
    pub(crate) fn of(history: &RunHistory) -> Self {
        Self::new(history.planner, history.planner_look.clone())
    }

    /// The planner.
    #[must_use]
    pub const fn name(&self) -> PlannerName {
        self.name
    }

    /// What it is called.
    pub(crate) fn label(&self) -> &str {
        &self.look.label
    }

    /// The same in the least space.
    pub(crate) fn short_label(&self) -> String {
        match self.name {
            PlannerName::PREDETERMINED => "Pre".to_owned(),
            PlannerName::COMBINED => "Comb.".to_owned(),
            _ if self.look.label.chars().count() <= SHORT => self.look.label.clone(),
            _ => self
                .look
                .label
                .chars()
                .take(SHORT - 1)
                .chain(['.'])
                .collect(),
        }
    }

    /// Its colour, the same everywhere.
    pub(crate) const fn colour(&self) -> Colour {
        let [red, green, blue] = self.look.colour;
        Colour(red, green, blue)
    }

    /// Its colour for thin lines: the predetermined path's is a darker grey, as grey on grey would not be seen.
    pub(crate) fn line_colour(&self) -> Colour {
        if self.name == PlannerName::PREDETERMINED {
            AXIS
        } else {
            self.colour()
        }
    }

    /// Its line in a chart.
    pub(crate) fn stroke(&self) -> Stroke {
        if self.name == PlannerName::PREDETERMINED {
            Stroke::dashed(self.colour(), 1.4, (4.0, 2.0))
        } else {
            Stroke::solid(self.colour(), 1.4)
        }
    }
}

/// Characters of a short label, at most.
const SHORT: usize = 7;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_planner_of_ones_own_has_its_own_look() {
        let name = PlannerName::literal("frontier");
        let own = Method::new(name, Some(Look::new("Frontier based", [1, 2, 3])));
        assert_eq!(
            (own.label(), own.short_label().as_str()),
            ("Frontier based", "Fronti.")
        );
        assert_eq!(own.colour(), Colour(1, 2, 3));
        assert_eq!(Method::new(name, None).label(), "frontier");
        assert_eq!(Method::new(PlannerName::LOCAL, None).short_label(), "Local");
    }
}
