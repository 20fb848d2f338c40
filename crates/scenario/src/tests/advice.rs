//! What the schemas say to the author of a wrong file.

use adslam_documents::Advice;

use crate::Scenario;
use crate::config::ConfigFile;

#[test]
fn a_key_is_known_by_its_place() {
    let advice = Advice::of::<Scenario>();
    assert_eq!(advice.tables_with("range_cm", "robot"), ["sensor"]);
    assert_eq!(
        advice.tables_with("step_cm", "motion.translation"),
        ["motion.translation.back_and_forth"]
    );
    assert_eq!(advice.tables_with("phantom", ""), ["object"]);
    assert_eq!(advice.tables_with("steps", "robot"), [""]);
    assert!(advice.is_table("noise") && !advice.is_table("steps"));
    assert!(advice.tables_with("colour", "").is_empty());
    assert_eq!(advice.choices_at("object"), ["points", "mesh", "phantom"]);
    assert!(advice.choices_at("sensor").is_empty());
    assert!(advice.meaning("sensor.range_cm").unwrap().contains("(cm)"));
}

#[test]
fn elements_of_lists_are_alike() {
    let advice = Advice::of::<ConfigFile>();
    let meaning = advice.meaning("experiments[3].scenario").unwrap();
    assert!(meaning.contains("path counts from"), "{meaning}");
    assert!(advice.tables_with("rotation_sigma_rad", "").is_empty());
}
