//! Many setups at once.

use adslam_diagnostics::InputError;
use adslam_scenario::Scenario;
use rayon::prelude::*;

use super::Setup;

impl Setup {
    /// The setup of every scenario, in order. An object that several have is built once: a phantom takes as long
    /// as some runs.
    ///
    /// # Errors
    /// As [`Setup::new`].
    pub fn of_all<'a>(
        scenarios: impl Iterator<Item = &'a Scenario>,
    ) -> Result<Vec<Self>, InputError> {
        let scenarios: Vec<&Scenario> = scenarios.collect();
        let mut first_with: Vec<&Scenario> = Vec::new();
        let object_of: Vec<usize> = scenarios
            .iter()
            .map(|scenario| {
                let same = |first: &&Scenario| first.object == scenario.object;
                first_with.iter().position(same).unwrap_or_else(|| {
                    first_with.push(scenario);
                    first_with.len() - 1
                })
            })
            .collect();
        let built: Vec<_> = first_with
            .par_iter()
            .map(|first| Self::new(first))
            .collect();
        let built: Vec<Self> = built.into_iter().collect::<Result<_, _>>()?;
        let varied: Vec<_> = scenarios
            .par_iter()
            .zip(&object_of)
            .map(|(scenario, &object)| built[object].varied(scenario))
            .collect();
        varied.into_iter().collect()
    }
}
