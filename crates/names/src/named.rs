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
        found.copied().ok_or_else(|| UnknownName {
            kind: Self::KIND,
            given: given.to_owned(),
            known: Self::ALL.iter().map(|one| one.as_str()).collect(),
        })
    }
}

/// A name that nothing has.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no {kind} is called {given:?}; {}", self.advice())]
pub struct UnknownName {
    kind: &'static str,
    given: String,
    known: Vec<&'static str>,
}

impl UnknownName {
    fn advice(&self) -> String {
        let names = self.known.join(", ");
        match nearest(&self.given, self.known.iter().copied()) {
            Some(near) => format!("did you mean {near}? There are {names}"),
            None => format!("there are {names}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::EstimatorName;
    use crate::LengthUnit;
    use crate::PlannerName;

    fn go_there_and_back<T: Named + PartialEq + std::fmt::Debug>() {
        for &one in T::ALL {
            assert_eq!(T::named(one.as_str()), Ok(one));
        }
    }

    #[test]
    fn names_go_there_and_back() {
        go_there_and_back::<PlannerName>();
        go_there_and_back::<EstimatorName>();
        go_there_and_back::<LengthUnit>();
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let error = PlannerName::named("combind").unwrap_err().to_string();
        assert!(error.contains("did you mean combined?"), "{error}");
        let all = "predetermined, local, global, combined";
        assert!(error.contains(all), "{error}");
        let error = EstimatorName::named("kalman").unwrap_err().to_string();
        assert!(error.starts_with("no estimator is called"), "{error}");
    }
}
