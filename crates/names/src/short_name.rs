//! Names of what a registry knows.

use thiserror::Error;

/// A text that cannot be the name of anything in a registry.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0:?} is no name here; write up to 31 letters, digits, _ and -, a letter first")]
pub struct BadName(pub(crate) String);

/// Letters, digits, `_` and `-`, a letter first, 31 at most; as small as a few numbers.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct ShortName {
    bytes: [u8; Self::LONGEST],
    length: u8,
}

impl ShortName {
    const LONGEST: usize = 31;

    #[allow(clippy::panic, reason = "in a constant it ends the compilation")]
    pub(crate) const fn literal(name: &'static str) -> Self {
        match Self::checked(name) {
            Some(name) => name,
            None => panic!("a name has up to 31 letters, digits, _ and -, a letter first"),
        }
    }

    pub(crate) const fn checked(text: &str) -> Option<Self> {
        let given = text.as_bytes();
        if given.is_empty() || given.len() > Self::LONGEST || !given[0].is_ascii_alphabetic() {
            return None;
        }
        let mut bytes = [0; Self::LONGEST];
        let mut i = 0;
        while i < given.len() {
            if !(given[i].is_ascii_alphanumeric() || given[i] == b'_' || given[i] == b'-') {
                return None;
            }
            bytes[i] = given[i];
            i += 1;
        }
        Some(Self {
            bytes,
            // It is at most 31.
            #[allow(clippy::cast_possible_truncation)]
            length: given.len() as u8,
        })
    }

    pub(crate) fn as_str(&self) -> &str {
        // ASCII, as it was checked.
        std::str::from_utf8(&self.bytes[..usize::from(self.length)]).unwrap_or_default()
    }
}

/// A name of one kind of thing, and those that are ours.
macro_rules! name {
    (
        $(#[$doc:meta])* $name:ident, $kind:literal, $schema:literal,
        $(#[$all_doc:meta])* $all:ident: [$($(#[$one_doc:meta])* $one:ident = $text:literal),* $(,)?]
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash)]
        pub struct $name(ShortName);

        impl $name {
            $($(#[$one_doc])* pub const $one: Self = Self::literal($text);)*

            $(#[$all_doc])*
            pub const $all: [Self; [$($text),*].len()] = [$(Self::$one),*];

            /// The name, known when the program is written.
            ///
            /// # Panics
            /// If it is no name; in a constant, that ends the compilation.
            #[must_use]
            pub const fn literal(name: &'static str) -> Self {
                Self(ShortName::literal(name))
            }

            /// The name that `text` is.
            ///
            /// # Errors
            /// Where it is none.
            pub fn new(text: &str) -> Result<Self, BadName> {
                let name = ShortName::checked(text).map(Self);
                name.ok_or_else(|| BadName(text.to_owned()))
            }

            /// As text.
            #[must_use]
            pub fn as_str(&self) -> &str {
                self.0.as_str()
            }

            /// Ours first, in their order.
            fn rank(self) -> usize {
                let place = Self::$all.iter().position(|known| *known == self);
                place.unwrap_or(Self::$all.len())
            }
        }

        /// Ours in their order, then others by their names.
        impl Ord for $name {
            fn cmp(&self, other: &Self) -> Ordering {
                (self.rank(), self.as_str()).cmp(&(other.rank(), other.as_str()))
            }
        }

        impl PartialOrd for $name {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                Some(self.cmp(other))
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.as_str())
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(self.as_str())
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.as_str())
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct NameVisitor;

                // The text is checked in here, where an error still gets its place.
                impl Visitor<'_> for NameVisitor {
                    type Value = $name;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str(concat!("the name of ", $kind, " in quotes"))
                    }

                    fn visit_str<E: Error>(self, text: &str) -> Result<$name, E> {
                        $name::new(text).map_err(E::custom)
                    }
                }

                deserializer.deserialize_str(NameVisitor)
            }
        }

        /// Which there are is for a registry to say.
        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                $schema.into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": "string" })
            }
        }
    };
}

pub(crate) use name;
