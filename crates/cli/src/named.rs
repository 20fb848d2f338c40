//! Arguments such as `--planner` that are one of a few names.

use std::ffi::OsStr;
use std::marker::PhantomData;

use adslam_names::Named;
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
