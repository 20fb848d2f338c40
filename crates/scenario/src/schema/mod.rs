//! JSON Schemas of the TOML files, generated from the very types that read them: editors complete
//! keys with them and show what each means, and `docs/scenario.md` is made of them.

mod overrides;

use adslam_documents::root_schema;
use serde_json::Value;

use crate::config::{ConfigFile, Published};
use crate::registry::Registry;
use crate::sweep::SweepFile;
use crate::{FileKind, Scenario};

pub(crate) use overrides::{lists_of_overrides, overrides};

/// The JSON Schema of a kind of file, in draft 7, which the editors of TOML understand.
///
/// It tells the keys, what each means and in which unit, what has to be there, and the range of each
/// value. What several keys must agree on, and what a file refers to, is beyond it: only reading
/// the file tells.
#[must_use]
pub fn json_schema(kind: FileKind, registry: &Registry) -> Value {
    let mut schema = match kind {
        FileKind::Scenario => root_schema::<Scenario>(),
        FileKind::Configuration => root_schema::<ConfigFile>(),
        FileKind::Published => root_schema::<Published>(),
        FileKind::Sweep => root_schema::<SweepFile>(),
    };
    registry.complete(&mut schema);
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_defaults_and_what_must_be_there_are_those_of_the_reader() {
        let schema = json_schema(FileKind::Scenario, &Registry::standard());
        let phantom = &schema["definitions"]["Phantom"]["properties"];
        assert_eq!(phantom["features"]["minimum"], 4);
        assert_eq!(phantom["features"]["maximum"], 2000);
        assert_eq!(phantom["features"]["default"], 50);
        assert_eq!(phantom["spacing_cm"]["maximum"], 0.6);
        let sensor = &schema["definitions"]["Sensor"];
        assert_eq!(sensor["required"], serde_json::json!(["range_cm"]));
        assert_eq!(sensor["properties"]["range_cm"]["minimum"], 1e-9);
        assert_eq!(sensor["properties"]["min_range_cm"]["minimum"], 0.0);
        assert_eq!(sensor["additionalProperties"], false);
    }

    #[test]
    fn an_override_has_the_schema_of_the_key_it_sets() {
        let schema = json_schema(FileKind::Configuration, &Registry::standard());
        let set = &schema["definitions"]["Experiment"]["properties"]["set"];
        let sigma = &set["properties"]["noise.rotation_sigma_rad"];
        assert_eq!(sigma["minimum"], 0.0);
        assert!(sigma["description"].is_string(), "{sigma}");
        assert!(set["properties"]["viewpoints.fixed.positions_cm"].is_object());
        assert!(set["properties"]["known_motion.deformation.anchored.anchor"].is_object());
        let element = &set["patternProperties"][r"^object\.points\.positions_cm\[\d+\]$"];
        assert_eq!(element["minItems"], 3);
        assert_eq!(set["additionalProperties"], false);
        assert!(schema["definitions"]["Scenario"].is_null());
    }

    #[test]
    fn a_grid_has_lists_of_what_a_key_may_be() {
        let schema = json_schema(FileKind::Sweep, &Registry::standard());
        let sigma = &schema["properties"]["grid"]["properties"]["noise.rotation_sigma_rad"];
        assert_eq!(sigma["items"]["minimum"], 0.0);
        assert_eq!(
            (&sigma["minItems"], &sigma["uniqueItems"]),
            (&1.into(), &true.into())
        );
        let elements = &schema["properties"]["grid"]["patternProperties"];
        let element = &elements[r"^object\.points\.positions_cm\[\d+\]$"];
        assert_eq!(element["items"]["minItems"], 3);
        let set = &schema["definitions"]["SweepPoint"]["properties"]["set"];
        assert_eq!(set["properties"]["sensor.range_cm"]["minimum"], 1e-9);
    }

    #[test]
    fn choices_are_told_apart_by_their_keys() {
        let definitions = &json_schema(FileKind::Scenario, &Registry::standard())["definitions"];
        let object = &definitions["Object"];
        assert_eq!(object["maxProperties"], 1);
        assert!(object["properties"]["phantom"]["description"].is_string());
        let translation = &definitions["Translation"];
        assert_eq!(translation["pattern"], "^(none)$");
        assert!(translation["properties"]["sinusoid"].is_object());
        let unit = &definitions["LengthUnit"];
        assert_eq!(unit["enum"], serde_json::json!(["mm", "cm", "m"]));
    }

    #[test]
    fn nothing_is_null_which_toml_has_not() {
        for kind in FileKind::ALL {
            let text = json_schema(kind, &Registry::standard()).to_string();
            assert!(!text.contains("null"), "{text}");
        }
    }
}
