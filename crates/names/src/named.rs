//! Choices that go by a name in files and on the command line.

use thiserror::Error;

use crate::nearest;

/// One of a few things that have names.
pub trait Named: Copy + Sized + 'static {
    /// What it is one of, such as `planner`.
    const KIND: &'static str;
    /// All of them, in the order of tables.
    const ALL: &'static [Self];

    /// The name used in files and on the command line.
    fn as_str(self) -> &'static str;

    /// The one of that name.
    ///
    /// # Errors
    /// [`UnknownName`], with the names that there are.
    fn named(given: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.iter().find(|one| one.as_str() == given);
        found.copied().ok_or_else(|| {
            let known = Self::ALL.iter().map(|one| one.as_str().to_owned());
            UnknownName::new(Self::KIND, given, known.collect())
        })
    }
}

/// A name that nothing has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no {kind} is called {given:?}; {}", self.advice())]
pub struct UnknownName {
    kind: &'static str,
    given: String,
    known: Vec<String>,
}

impl UnknownName {
    /// Nothing of this kind, such as `planner`, is called `given`; those that are `known` are.
    #[must_use]
    pub fn new(kind: &'static str, given: &str, known: Vec<String>) -> Self {
        Self {
            kind,
            given: given.to_owned(),
            known,
        }
    }

    fn advice(&self) -> String {
        let names = self.known.join(", ");
        match nearest(&self.given, self.known.iter().map(String::as_str)) {
            Some(near) => format!("did you mean {near}? There are {names}"),
            None => format!("there are {names}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LengthUnit;

    fn go_there_and_back<T: Named + PartialEq + std::fmt::Debug>() {
        for &one in T::ALL {
            assert_eq!(T::named(one.as_str()), Ok(one));
        }
    }

    #[test]
    fn names_go_there_and_back() {
        go_there_and_back::<LengthUnit>();
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let error = LengthUnit::named("cn").unwrap_err().to_string();
        assert!(
            error.contains("did you mean cm? There are mm, cm, m"),
            "{error}"
        );
        let error = LengthUnit::named("furlong").unwrap_err().to_string();
        assert!(error.starts_with("no unit of length is called"), "{error}");
    }
}
