//! The estimators, by name.

use std::fmt;
use std::sync::Arc;

use adslam_estimator::{Estimator, EstimatorError, EstimatorKind, FilterNoise, Parallelism};
use adslam_names::{EstimatorName, Look, UnknownName};
use adslam_statistics::chi_squared;
use thiserror::Error;

/// The part of good feature measurements that a filter's gate believes, between 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateProbability(f64);

impl GateProbability {
    const SMALLEST: f64 = 1e-9;

    /// The probability, if it can be that of a gate; none unless it is above 0 and below 1 by 10⁻⁹ at least.
    #[must_use]
    pub fn new(probability: f64) -> Option<Self> {
        let allowed = Self::SMALLEST..=1.0 - Self::SMALLEST;
        allowed.contains(&probability).then_some(Self(probability))
    }

    /// As a number.
    #[must_use]
    pub const fn get(self) -> f64 {
        self.0
    }

    /// The squared distance, χ² with 3 degrees of freedom, that good measurements of a feature keep with this
    /// probability.
    #[must_use]
    pub fn squared_distance(self) -> f64 {
        chi_squared::quantile(self.0, 3)
    }
}

type Build = dyn Fn(
        FilterNoise,
        Option<GateProbability>,
        Parallelism,
    ) -> Result<Box<dyn Estimator>, EstimatorError>
    + Send
    + Sync;

/// An estimator: its name, how it is shown, and how it is built.
#[derive(Clone)]
pub struct EstimatorEntry {
    /// What it is called in files and on the command line.
    pub name: EstimatorName,
    /// What it looks like in results.
    pub look: Look,
    /// What it takes for the error of a state, in a sentence: editors show it.
    pub meaning: String,
    build: Arc<Build>,
}

impl EstimatorEntry {
    /// An estimator that is built from the noise that it assumes, the gate of its feature measurements if it has one, and
    /// whether it may use several threads.
    #[must_use]
    pub fn new(
        name: EstimatorName,
        build: impl Fn(
            FilterNoise,
            Option<GateProbability>,
            Parallelism,
        ) -> Result<Box<dyn Estimator>, EstimatorError>
        + Send
        + Sync
        + 'static,
    ) -> Self {
        Self {
            name,
            look: Look::of_estimator(name),
            meaning: String::new(),
            build: Arc::new(build),
        }
    }

    /// Shown under a label and in a colour (red, green, blue) of its own.
    #[must_use]
    pub fn shown_as(self, label: &str, colour: [u8; 3]) -> Self {
        Self {
            look: Look::new(label, colour),
            ..self
        }
    }

    /// With a sentence that says what it is.
    #[must_use]
    pub fn described_as(self, meaning: &str) -> Self {
        Self {
            meaning: meaning.to_owned(),
            ..self
        }
    }

    /// The estimator.
    ///
    /// # Errors
    /// A sigma that cannot be used, see [`FilterNoise::validate`].
    pub fn build(
        &self,
        noise: FilterNoise,
        gate: Option<GateProbability>,
        parallelism: Parallelism,
    ) -> Result<Box<dyn Estimator>, EstimatorError> {
        (self.build)(noise, gate, parallelism)
    }
}

impl fmt::Debug for EstimatorEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.name.fmt(f)
    }
}

/// The estimators that there are. To copy it is cheap.
#[derive(Clone, Debug)]
pub struct Estimators(Arc<Vec<EstimatorEntry>>);

/// Two things were to have the same name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is an estimator called {0} already; give yours another name")]
pub struct EstimatorNameTaken(EstimatorName);

impl Estimators {
    /// Ours.
    #[must_use]
    pub fn standard() -> Self {
        let ours = |name, kind: EstimatorKind, meaning| {
            let build = move |noise, gate: Option<GateProbability>, parallelism| {
                kind.build(
                    noise,
                    gate.map(GateProbability::squared_distance),
                    parallelism,
                )
            };
            EstimatorEntry::new(name, build).described_as(meaning)
        };
        Self(Arc::new(vec![
            ours(
                EstimatorName::EULER_EKF,
                EstimatorKind::EulerEkf,
                "The paper's EKF: differences of Euler angles and of positions.",
            ),
            ours(
                EstimatorName::SO3_EKF,
                EstimatorKind::So3Ekf,
                "The error-state EKF with the orientation's error on SO(3).",
            ),
            ours(
                EstimatorName::RIGHT_INVARIANT_EKF,
                EstimatorKind::RightInvariantEkf,
                "The right-invariant EKF: one error of robot and features together, which takes no more of where everything \
                 is and heads for known than was measured.",
            ),
        ]))
    }

    /// With one more.
    ///
    /// # Errors
    /// Where another has its name.
    pub fn with(mut self, entry: EstimatorEntry) -> Result<Self, EstimatorNameTaken> {
        if self.0.iter().any(|known| known.name == entry.name) {
            return Err(EstimatorNameTaken(entry.name));
        }
        Arc::make_mut(&mut self.0).push(entry);
        Ok(self)
    }

    /// All of them, ours first.
    #[must_use]
    pub fn all(&self) -> &[EstimatorEntry] {
        &self.0
    }

    /// The one of that name.
    ///
    /// # Errors
    /// Where there is none, with the names that there are.
    pub fn get(&self, name: &str) -> Result<&EstimatorEntry, UnknownName> {
        let found = self.0.iter().find(|entry| entry.name.as_str() == name);
        found.ok_or_else(|| {
            let known = self.0.iter().map(|entry| entry.name.to_string());
            UnknownName::new("estimator", name, known.collect())
        })
    }
}

impl Default for Estimators {
    fn default() -> Self {
        Self::standard()
    }
}
