//! What is said about values that cannot be, and where the caret points.

use super::refused;

#[test]
fn keys() {
    refused(
        "range_cm",
        "rnage_cm",
        "unknown key `rnage_cm`",
        "rnage_cm",
        "did you mean `range_cm`?",
    );
    refused(
        "[sensor]",
        "[sonsor]",
        "unknown key `sonsor`",
        "sonsor",
        "did you mean `sensor`?",
    );
    refused(
        "dz_cm",
        "colour",
        "unknown key `colour`",
        "colour",
        "`dx_cm`, `dz_cm`",
    );
    refused(
        "max_roll_deg = 30.0",
        "",
        "the key `max_roll_deg` is missing",
        "[robot.actions]",
        "add `max_roll_deg",
    );
    refused(
        "steps = 100",
        "",
        "the key `steps` is missing",
        "",
        "add `steps",
    );
    refused(
        "steps = 100",
        "steps = 100\nsteps = 7",
        "duplicate key",
        "steps",
        "",
    );
}

/// A key in the wrong table, and a table that is not named in full.
#[test]
fn places() {
    refused(
        "clearance_cm = 0.3",
        "clearance_cm = 0.3\nmin_range_cm = 0.2",
        "unknown key `min_range_cm`",
        "min_range_cm",
        "`min_range_cm` belongs into [sensor]; the keys here: `start_deg`",
    );
    refused(
        "[motion.translation.back_and_forth]",
        "[motion.translation]",
        "`step_cm` is not one of the choices",
        "step_cm",
        "`step_cm` belongs into [motion.translation.back_and_forth]",
    );
    refused(
        "range_cm = 3.0",
        "",
        "the key `range_cm` is missing",
        "[sensor]",
        "add `range_cm = …` here. Features farther away than this are not seen (cm).",
    );
    refused(
        "[viewpoints.sampled]",
        "[viewpoints]\n[viewpoint.sampled]",
        "unknown key `viewpoint`",
        "viewpoint",
        "did you mean `viewpoints`?",
    );
}

#[test]
fn no_choice() {
    let remedy = |more: &str| {
        let error = super::parsed(&format!("name = \"a\"\nsteps = 3\n{more}")).unwrap_err();
        error.remedy().unwrap().to_owned()
    };
    assert_eq!(
        remedy("[object]\n"),
        "write one of [object.points], [object.mesh], [object.phantom]"
    );
    assert!(remedy("").starts_with("add one of [object.points], "));
    assert!(remedy("[object.phantom]\n").starts_with("add a table [noise]. "));
    assert_eq!(
        remedy("[motion]\ntranslation = \"sinusoid\"\n"),
        "write one of [motion.translation.back_and_forth], [motion.translation.sinusoid]"
    );
    assert_eq!(
        remedy("[object.phantom]\nsteps = 5\n"),
        "`steps` belongs into the file's own keys, above the first [table]; the keys here: \
         `features`, `feature_seed`, `spacing_cm`"
    );
}

#[test]
fn kinds_of_values() {
    refused(
        "range_cm = 3.0",
        "range_cm = \"3\"",
        "string \"3\"",
        "\"3\"",
        "a number above 0",
    );
    refused(
        "steps = 100",
        "steps = 10.5",
        "floating point `10.5`",
        "10.5",
        "a whole number from 1",
    );
    refused(
        "steps = 100",
        "steps = [1]",
        "sequence",
        "[1]",
        "a whole number",
    );
    refused(
        "name = \"polygon\"",
        "name = 7",
        "integer `7`",
        "7",
        "a name",
    );
    refused(
        "[2.0, -0.5, 1.0], # 2",
        "2.0,",
        "floating point `2.0`",
        "2.0",
        "three numbers",
    );
    refused(
        "[2.0, -0.5, 1.0], # 2",
        "[2.0, -0.5],",
        "these are 2 values",
        "[2.0, -0.5]",
        "three",
    );
    refused(
        "\"horizontal\"",
        "\"sideways\"",
        "`sideways` is not one",
        "\"sideways\"",
        "`horizontal`, `radial`",
    );
    refused(
        "anchor = 0",
        "anchor = -1",
        "-1 is too small",
        "-1",
        "from 0 to",
    );
    refused(
        "name = \"polygon\"",
        "name = \"a/b\"",
        "\"a/b\" is no name",
        "\"a/b\"",
        "letters",
    );
    refused(
        "name = \"polygon\"",
        "name = \"\"",
        "is no name",
        "\"\"",
        "letters",
    );
}

#[test]
fn numbers() {
    refused(
        "range_cm = 3.0",
        "range_cm = -3.0",
        "-3 is not above 0",
        "-3.0",
        "above 0",
    );
    refused(
        "range_cm = 3.0",
        "range_cm = 0",
        "0 is not above 0",
        "0",
        "above 0",
    );
    refused(
        "rotation_sigma_rad = 0.02",
        "rotation_sigma_rad = -0.02",
        "-0.02 is below 0",
        "-0.02",
        "0 or a number",
    );
    refused(
        "rotation_sigma_rad = 0.02",
        "rotation_sigma_rad = 5.0",
        "5 is below 0, or more than half a turn",
        "5.0",
        "1 degree is 0.01745",
    );
    refused(
        "0.5, 1.0], # 3",
        "nan, 1.0],",
        "nan is not a number",
        "nan",
        "write a number",
    );
    refused(
        "0.5, 1.0], # 3",
        "-inf, 1.0],",
        "-inf is not a finite number",
        "-inf",
        "write a number",
    );
    refused(
        "range_cm = 3.0",
        "range_cm = nan",
        "nan is not a number",
        "nan",
        "above 0",
    );
    refused(
        "range_cm = 3.0",
        "range_cm = 1e300",
        "out of any sensible range",
        "1e300",
        "above 0",
    );
    refused(
        "range_cm = 3.0",
        "range_cm = 1e400",
        "overflow",
        "1e400",
        "",
    );
    refused(
        "steps = 100",
        "steps = 0",
        "0 is too small",
        "0",
        "from 1 to 1000000",
    );
    refused(
        "steps = 100",
        "steps = 99999999999999999999",
        "too large",
        "99999999999999999999",
        "from 1",
    );
    refused(
        "nearest_fraction = 0.1",
        "nearest_fraction = 1.5",
        "1.5 is no fraction",
        "1.5",
        "up to 1",
    );
    refused(
        "[sensor]",
        "truncate_at_sigmas = 0.01\n[sensor]",
        "0.01 is no sensible",
        "0.01",
        "0.5 and 100",
    );
}
