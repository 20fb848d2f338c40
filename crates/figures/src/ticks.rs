//! Round numbers along an axis, and how they are written.

use std::ops::Range;

/// The multiples of a round number, at least `least_step`, within a range, and how they are written.
pub(crate) fn tick_labels(range: Range<f64>, least_step: f64) -> Vec<(f64, String)> {
    let step = round_step(least_step);
    let first = (range.start / step - 1e-6).ceil();
    let decimals = decimals_of(step);
    (0..100u8)
        .map(|k| (first + f64::from(k)) * step)
        .take_while(|tick| *tick <= range.end + 1e-6 * step)
        .map(|tick| (tick, number(tick, decimals)))
        .collect()
}

/// Ticks at the decades between two logarithms; at their doubles and fives as well where there are
/// few, and with a number at every second where there are many.
pub(crate) fn log_ticks(start: f64, end: f64) -> Vec<(f64, String)> {
    const MOST_DECADES: f64 = 24.0;
    let decades = end - start;
    if decades.is_nan() || decades > MOST_DECADES {
        return Vec::new();
    }
    let factors: &[f64] = if decades < 1.5 {
        &[1.0, 2.0, 5.0]
    } else {
        &[1.0]
    };
    let every = if decades > 7.0 { 2.0 } else { 1.0 };
    let mut ticks = Vec::new();
    for k in 0..=30u8 {
        let exponent = start.floor() + f64::from(k);
        for factor in factors {
            let value = factor * 10f64.powf(exponent);
            if (start - 1e-9..=end + 1e-9).contains(&value.log10()) {
                let has_number = (exponent / every).fract() == 0.0;
                let shown = has_number.then(|| number(value, decimals_of(value)));
                ticks.push((value, shown.unwrap_or_default()));
            }
        }
    }
    ticks
}

/// 1, 2 or 5 times a power of ten, at least `least`.
pub(crate) fn round_step(least: f64) -> f64 {
    if !(least.is_finite() && least > 0.0) {
        return 1.0;
    }
    let power = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|k| k * power);
    let fits = steps.iter().find(|step| **step >= least * (1.0 - 1e-9));
    fits.copied().unwrap_or(10.0 * power)
}

/// How many decimals multiples of `step` need.
fn decimals_of(step: f64) -> usize {
    (0..12)
        .find(|k| {
            let scaled = step * 10f64.powi(*k);
            (scaled - scaled.round()).abs() < 1e-6 && scaled.round() >= 1.0
        })
        .and_then(|k| usize::try_from(k).ok())
        .unwrap_or(0)
}

/// A number as it stands at a tick, with a true minus sign.
fn number(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let is_zero = text.chars().all(|c| c == '0' || c == '.');
    if value < 0.0 && !is_zero {
        format!("−{text}")
    } else {
        text
    }
}
