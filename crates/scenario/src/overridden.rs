//! A scenario with some of its keys overridden by another file.

use adslam_diagnostics::InputError;
use adslam_documents::{Document, Layer};

use super::Scenario;

/// More overrides of one scenario are a mistake: it has fewer keys.
const MOST_OVERRIDES: usize = 1_000;

/// Tables in which one of several keys is chosen: setting another key there chooses that one.
const CHOICES: [&str; 6] = [
    "object",
    "viewpoints",
    "motion.translation",
    "motion.deformation",
    "known_motion.translation",
    "known_motion.deformation",
];

impl Scenario {
    /// This scenario with overrides from `file` laid over it, one layer after the other.
    ///
    /// # Errors
    /// Where the scenario is not valid any more: the error points at the override that is to blame.
    pub fn overridden(&self, file: &Document, layers: Vec<Layer>) -> Result<Self, InputError> {
        let tables: Vec<String> = layers
            .iter()
            .map(|layer| layer.table().to_owned())
            .collect();
        let merged = self.document.with_overrides(file, layers, &CHOICES);
        let overrides = merged.overrides();
        if overrides.is_empty() {
            return Ok(self.clone());
        }
        let count = overrides.len();
        if count > MOST_OVERRIDES {
            let table = tables.last().map_or("", String::as_str);
            return Err(file
                .error_at(table, format!("there are {count} overrides"))
                .with_help(format!(
                    "write at most {MOST_OVERRIDES}, and the rest into a scenario of its own"
                )));
        }
        let error = match Self::from_document(merged.clone(), &self.registry) {
            Err(error) if merged.is_in_base(&error) => error,
            result => return result,
        };
        // The scenario is valid by itself, so an override is to blame where it points: the one
        // without which all would be well.
        let guilty = overrides
            .iter()
            .find(|one| Self::from_document(merged.without_override(one), &self.registry).is_ok());
        let message = format!("with this override, {}", error.message());
        let blamed = match guilty {
            Some(one) => merged.error_at_override(one, message),
            None => file.error_at(tables.last().map_or("", String::as_str), message),
        };
        let key = error
            .pointed_at()
            .filter(|text| !text.contains('\n'))
            .unwrap_or_default();
        let label = format!("does not go with `{key}` in {}", error.path().display());
        let blamed = if key.is_empty() {
            blamed
        } else {
            blamed.with_label(label)
        };
        Err(match error.remedy() {
            Some(remedy) => blamed.with_help(remedy),
            None => blamed,
        })
    }
}
