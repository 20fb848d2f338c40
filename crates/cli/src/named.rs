//! Arguments such as `--planner` that are one of a few names.

use std::ffi::OsStr;
use std::marker::PhantomData;

use adslam_names::{Named, PlannerName};
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

/// Reads the name of a planner that the registry knows.
#[derive(Clone, Default)]
pub(crate) struct PlannerParser {
    registry: Registry,
}

impl PlannerParser {
    pub(crate) const fn new(registry: Registry) -> Self {
        Self { registry }
    }
}

impl TypedValueParser for PlannerParser {
    type Value = PlannerName;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<PlannerName, Error> {
        let registry = self.registry.clone();
        StringValueParser::new()
            .try_map(move |name| registry.planner_named(&name))
            .parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let planners = self.registry.planners().iter();
        let names = planners.map(|entry| PossibleValue::new(entry.name.to_string()));
        Some(Box::new(names))
    }
}
