//! The planner of `--planner`.

use std::ffi::OsStr;

use adslam_experiment::scenario::PlannerName;
use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};

/// Reads a planner's name with the library's own advice, and tells shells the names to complete.
#[derive(Clone)]
pub(crate) struct PlannerParser;

impl TypedValueParser for PlannerParser {
    type Value = PlannerName;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<PlannerName, Error> {
        StringValueParser::new()
            .try_map(|name| name.parse::<PlannerName>())
            .parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = PlannerName::ALL.map(|name| PossibleValue::new(name.as_str()));
        Some(Box::new(names.into_iter()))
    }
}
