//! Whether the header of a log can be used.

use std::io::BufRead;

use adslam_agent::GateProbability;
use adslam_diagnostics::InputError;
use adslam_names::{LengthUnit, Named};

use super::format::{FORMAT, LogHeader, VERSION};
use super::lines::Lines;

/// As many features as a scenario may have: the covariance of more would not fit into memory.
const MOST_FEATURES: usize = 2_000;
/// Entries of a covariance that mirror each other may differ by rounding, relative to the variances.
const ASYMMETRY: f64 = 1e-9;

/// Checks all but the truth, of which steps have their own. `lines` is for messages.
///
/// # Errors
/// [`InputError`] with the line, what is wrong with it, and what to do.
pub(super) fn check_header<R: BufRead>(
    header: &LogHeader,
    lines: &Lines<R>,
) -> Result<(), InputError> {
    let wrong = |what: String, help: &str| Err(lines.error(&what, help));
    if header.format != FORMAT {
        let what = format!("has the format {:?}", header.format);
        return wrong(what, &format!("write \"format\": \"{FORMAT}\""));
    }
    if header.version != VERSION {
        let what = format!("has version {}", header.version);
        return wrong(what, &format!("this program reads version {VERSION}"));
    }
    if LengthUnit::named(&header.length_unit).is_err() {
        let what = format!("has the length unit {:?}", header.length_unit);
        return wrong(what, "write mm, cm or m, and use it for every length");
    }
    if header.features == 0 {
        return wrong(
            "says that there are 0 features".to_owned(),
            "a log needs at least one",
        );
    }
    if header.features > MOST_FEATURES {
        let what = format!("says that there are {} features", header.features);
        return wrong(what, &format!("a log may have up to {MOST_FEATURES}"));
    }
    if header.initial.features.len() != header.features {
        let what = format!(
            "says that there are {} features, and gives the first positions of {}",
            header.features,
            header.initial.features.len()
        );
        return wrong(what, "make the two agree");
    }
    check_sigmas(header, lines)?;
    check_pose_covariance(header, lines)?;
    check_filter(header, lines)
}

/// Sigmas are never negative, and what is divided by is above 0.
fn check_sigmas<R: BufRead>(header: &LogHeader, lines: &Lines<R>) -> Result<(), InputError> {
    let (noise, initial) = (&header.noise, &header.initial);
    let may_be_zero = [
        ("noise.rotation_sigma", noise.rotation_sigma),
        ("noise.translation_sigma", noise.translation_sigma),
        ("noise.feature_motion_sigma", noise.feature_motion_sigma),
        ("initial.feature_sigma", initial.feature_sigma),
    ];
    let above_zero = [
        (
            "noise.feature_measurement_sigma",
            noise.feature_measurement_sigma,
        ),
        (
            "noise.structure_measurement_sigma",
            noise.structure_measurement_sigma,
        ),
    ];
    for (key, sigma) in may_be_zero {
        if sigma < 0.0 {
            let what = format!("has {sigma} in {key}");
            return Err(lines.error(&what, "a sigma is not negative: write 0 or more"));
        }
    }
    for (key, sigma) in above_zero {
        if sigma <= 0.0 {
            let what = format!("has {sigma} in {key}");
            let help =
                "no measurement is exact, and none has a negative sigma: write a number above 0";
            return Err(lines.error(&what, help));
        }
    }
    Ok(())
}

/// Whether it can be a covariance at first sight; whether it really is one the first belief checks.
fn check_pose_covariance<R: BufRead>(
    header: &LogHeader,
    lines: &Lines<R>,
) -> Result<(), InputError> {
    let covariance = &header.initial.pose_covariance;
    for (i, row) in covariance.iter().enumerate() {
        let variance = row[i];
        if variance < 0.0 {
            let what = format!("has the variance {variance} in pose_covariance[{i}][{i}]");
            return Err(lines.error(&what, "variances are squares of sigmas: write 0 or more"));
        }
        for (j, other) in covariance.iter().enumerate().take(i) {
            let (below, above) = (row[j], other[i]);
            let scale = variance.max(other[j]).max(below.abs());
            if (below - above).abs() > ASYMMETRY * scale {
                let what = format!(
                    "has {below} in pose_covariance[{i}][{j}] and {above} in \
                     pose_covariance[{j}][{i}]"
                );
                return Err(lines.error(&what, "a covariance is symmetric: make them equal"));
            }
        }
    }
    Ok(())
}

/// Whether there can be such a filter; whether there is one of its name is known where it is built.
fn check_filter<R: BufRead>(header: &LogHeader, lines: &Lines<R>) -> Result<(), InputError> {
    let Some(filter) = &header.filter else {
        return Ok(());
    };
    if let Some(probability) = filter.gate_probability
        && GateProbability::new(probability).is_none()
    {
        let what = format!("has the gate probability {probability}");
        return Err(lines.error(&what, "write a number above 0 and below 1, or leave it out"));
    }
    Ok(())
}
