//! Vectors and other triples, and lists that are not empty.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;

use adslam_surface::MIN_COORDINATE_CM;
use nalgebra::{Point3, Vector3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::{Serialize, Serializer};

use super::{Finite, ValueError};

pub use adslam_documents::LONGEST_LIST;

/// Three finite numbers: a position, a vector, or roll, pitch and yaw.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vec3(Vector3<f64>);

impl Vec3 {
    /// The three numbers, if each is finite and sensible.
    ///
    /// # Errors
    /// When one is not.
    pub fn new(numbers: [f64; 3]) -> Result<Self, ValueError> {
        for number in numbers {
            Finite::new(number)?;
        }
        Ok(Self::of(numbers))
    }

    /// What is nearer to 0 than a surface can tell from it is 0.
    fn of(numbers: [f64; 3]) -> Self {
        let is_zero = |number: f64| number.abs() < MIN_COORDINATE_CM;
        Self(numbers.map(|x| if is_zero(x) { 0.0 } else { x }).into())
    }

    /// The point that the vector leads to from the origin.
    pub fn point(self) -> Point3<f64> {
        Point3::from(self.0)
    }

    /// The numbers, taken as degrees, in radians.
    pub fn degrees_in_rad(self) -> Vector3<f64> {
        self.0.map(f64::to_radians)
    }
}

impl Deref for Vec3 {
    type Target = Vector3<f64>;

    fn deref(&self) -> &Vector3<f64> {
        &self.0
    }
}

impl<'de> Deserialize<'de> for Vec3 {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let numbers = Triple::<Finite>::deserialize(deserializer)?;
        Ok(Self::of(numbers.map(|number| *number)))
    }
}

impl Serialize for Vec3 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        <[f64; 3]>::from(self.0).serialize(serializer)
    }
}

impl JsonSchema for Vec3 {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Vec3".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Triple::<Finite>::json_schema(generator)
    }
}

/// Three values, no more and no fewer: serde's own arrays let toml drop a fourth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Triple<T>(pub [T; 3]);

impl<T> Deref for Triple<T> {
    type Target = [T; 3];

    fn deref(&self) -> &[T; 3] {
        &self.0
    }
}

impl<T> TryFrom<Vec<T>> for Triple<T> {
    type Error = ValueError;

    fn try_from(values: Vec<T>) -> Result<Self, ValueError> {
        values.try_into().map(Self).map_err(|values: Vec<T>| {
            ValueError::new(
                format!("these are {} values", values.len()),
                "write three, such as [1, 0, 2]",
            )
        })
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Triple<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expects = "three numbers, such as [1, 0, 2]";
        deserializer.deserialize_any(SequenceVisitor {
            expects,
            of: PhantomData,
        })
    }
}

impl<T: JsonSchema> JsonSchema for Triple<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Triple_of_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": items, "minItems": 3, "maxItems": 3 })
    }
}

/// A list of at least one element and at most [`LONGEST_LIST`].
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct List<T>(Vec<T>);

impl<T> Deref for List<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> TryFrom<Vec<T>> for List<T> {
    type Error = ValueError;

    fn try_from(elements: Vec<T>) -> Result<Self, ValueError> {
        match elements.len() {
            0 => Err(ValueError::new(
                "the list is empty",
                "write at least one element",
            )),
            1..=LONGEST_LIST => Ok(Self(elements)),
            many => Err(ValueError::new(
                format!("the list has {many} elements"),
                format!("write at most {LONGEST_LIST}"),
            )),
        }
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expects = "a list in brackets, such as [1.0, 2.0] or [\"a\", \"b\"]";
        deserializer.deserialize_any(SequenceVisitor {
            expects,
            of: PhantomData,
        })
    }
}

impl<T: JsonSchema> JsonSchema for List<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("List_of_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": items, "minItems": 1, "maxItems": LONGEST_LIST })
    }
}

/// Reads a sequence of `T` into a `C`. It is checked in here, where an error still gets its place.
struct SequenceVisitor<T, C> {
    expects: &'static str,
    of: PhantomData<(T, C)>,
}

impl<'de, T, C> Visitor<'de> for SequenceVisitor<T, C>
where
    T: Deserialize<'de>,
    C: TryFrom<Vec<T>, Error = ValueError>,
{
    type Value = C;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expects)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<C, A::Error> {
        let mut elements: Vec<T> = Vec::new();
        while let Some(element) = access.next_element()? {
            elements.push(element);
        }
        C::try_from(elements).map_err(A::Error::custom)
    }
}
