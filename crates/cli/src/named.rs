//! Arguments such as `--planner` that are one of a few names.

use std::ffi::OsStr;
use std::marker::PhantomData;

use adslam_names::{EstimatorName, Named, PlannerName, UnknownName};
use adslam_scenario::registry::Registry;
use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};

/// Reads a name with the library's own advice, and tells shells the names to complete.
pub(crate) struct NameParser<T>(PhantomData<fn() -> T>);

impl<T> NameParser<T> {
    pub(crate) const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<T> Clone for NameParser<T> {
    fn clone(&self) -> Self {
        Self::new()
    }
}

impl<T: Named + Send + Sync> TypedValueParser for NameParser<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<T, Error> {
        StringValueParser::new()
            .try_map(|name| T::named(&name))
            .parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = T::ALL.iter().map(|one| PossibleValue::new(one.as_str()));
        Some(Box::new(names))
    }
}

/// What a registry has names for.
pub(crate) trait Registered: Copy + Send + Sync + 'static {
    /// The one of that name.
    fn named(registry: &Registry, text: &str) -> Result<Self, UnknownName>;

    /// All names.
    fn all(registry: &Registry) -> Vec<String>;
}

impl Registered for PlannerName {
    fn named(registry: &Registry, text: &str) -> Result<Self, UnknownName> {
        registry.planner_named(text).map(|entry| entry.name)
    }

    fn all(registry: &Registry) -> Vec<String> {
        let planners = registry.planners().iter();
        planners.map(|entry| entry.name.to_string()).collect()
    }
}

impl Registered for EstimatorName {
    fn named(registry: &Registry, text: &str) -> Result<Self, UnknownName> {
        registry.estimators().get(text).map(|entry| entry.name)
    }

    fn all(registry: &Registry) -> Vec<String> {
        let estimators = registry.estimators().all().iter();
        estimators.map(|entry| entry.name.to_string()).collect()
    }
}

/// Reads a name that the registry knows.
pub(crate) struct RegistryParser<T> {
    registry: Registry,
    kind: PhantomData<fn() -> T>,
}

impl<T> RegistryParser<T> {
    pub(crate) const fn new(registry: Registry) -> Self {
        Self {
            registry,
            kind: PhantomData,
        }
    }
}

impl<T> Default for RegistryParser<T> {
    fn default() -> Self {
        Self::new(Registry::standard())
    }
}

impl<T> Clone for RegistryParser<T> {
    fn clone(&self) -> Self {
        Self::new(self.registry.clone())
    }
}

impl<T: Registered> TypedValueParser for RegistryParser<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<T, Error> {
        let registry = self.registry.clone();
        StringValueParser::new()
            .try_map(move |name| T::named(&registry, &name))
            .parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = T::all(&self.registry).into_iter();
        Some(Box::new(names.map(PossibleValue::new)))
    }
}
