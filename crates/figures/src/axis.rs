//! Axes: what they measure, from where to where, and their ticks.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use crate::ticks::{log_ticks, round_step, tick_labels};

/// How values lie along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Linear,
    Log,
}

/// An axis. Places along it are the values, or their decimal logarithms.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub label: String,
    scale: Scale,
    /// The places of its ends.
    ends: Range<f64>,
    /// Values, and what stands there.
    ticks: Vec<(f64, String)>,
}

impl Axis {
    /// A linear axis that just holds the values, ends at ticks where `to_ticks`, and has about
    /// `count` of them.
    fn linear_with(label: &str, values: Range<f64>, count: f64, to_ticks: bool) -> Self {
        let Range { mut start, mut end } = values;
        if !(start.is_finite() && end.is_finite()) || start > end {
            (start, end) = (0.0, 1.0);
        }
        if end - start < 1e-9 * (1.0 + start.abs()) {
            (start, end) = (start.min(0.0), end.max(start + 1.0));
        }
        let step = round_step((end - start) / count);
        if to_ticks {
            start = (start / step + 1e-6).floor() * step;
            end = (end / step - 1e-6).ceil() * step;
        }
        Self {
            label: label.to_owned(),
            scale: Scale::Linear,
            ends: start..end,
            ticks: tick_labels(start..end, step),
        }
    }

    /// A linear axis over the finite ones of the values, which ends at ticks.
    pub(crate) fn linear(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        Self::linear_with(label, bounds(values), 5.0, true)
    }

    /// The same from −x to x.
    pub(crate) fn symmetric(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let range = bounds(values.into_iter().map(f64::abs));
        let most = if range.end > 0.0 { range.end } else { 1.0 };
        Self::linear_with(label, -most * 1.05..most * 1.05, 5.0, false)
    }

    /// An axis of steps from 1 to `last`.
    pub(crate) fn steps(last: usize) -> Self {
        let last = (last as f64).max(2.0);
        Self::linear_with("Step", 0.0..last, 5.0, false)
    }

    /// A logarithmic axis over the positive ones of the values, from and to 1, 2 or 5 times a power
    /// of ten.
    pub(crate) fn log(label: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let range = bounds(values.into_iter().filter(|v| *v > 0.0));
        let (least, most) = if range.start <= range.end {
            (range.start, range.end)
        } else {
            (1.0, 10.0)
        };
        let end = round_step(most);
        // Rounding down is rounding up the other way round; 2 and 5 change their places.
        let start = (1.0 / round_step(1.0 / least)).min(end / 10.0);
        let (start, end) = (start.log10(), end.log10());
        Self {
            label: label.to_owned(),
            scale: Scale::Log,
            ends: start..end,
            ticks: log_ticks(start, end),
        }
    }

    /// An axis of names, each in the middle of its unit.
    pub(crate) fn names(names: &[String]) -> Self {
        let ticks = (0u32..).zip(names);
        Self {
            label: String::new(),
            scale: Scale::Linear,
            ends: 0.0..(names.len() as f64).max(1.0),
            ticks: ticks
                .map(|(k, name)| (f64::from(k) + 0.5, name.clone()))
                .collect(),
        }
    }

    /// The same axis without its label and the numbers at its ticks.
    pub(crate) fn bare(&self) -> Self {
        let ticks = self.ticks.iter().map(|(at, _)| (*at, String::new()));
        Self {
            label: String::new(),
            ticks: ticks.collect(),
            ..self.clone()
        }
    }

    /// Where a value lies; what is beyond the ends lies at them.
    fn place(&self, value: f64) -> f64 {
        let place = match self.scale {
            Scale::Linear => value,
            Scale::Log if value > 0.0 => value.log10(),
            Scale::Log => self.ends.start,
        };
        place.clamp(self.ends.start, self.ends.end)
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    #[allow(
        clippy::cast_possible_truncation,
        reason = "between two numbers of the same type; NaN becomes 0"
    )]
    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let Range { start, end } = self.ends.clone();
        let share = (self.place(*value) - start) / (end - start);
        from + (share * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.iter().map(|(at, _)| *at).collect()
        }
    }

    fn range(&self) -> Range<f64> {
        match self.scale {
            Scale::Linear => self.ends.clone(),
            Scale::Log => 10f64.powf(self.ends.start)..10f64.powf(self.ends.end),
        }
    }
}

impl ValueFormatter<f64> for Axis {
    fn format(value: &f64) -> String {
        value.to_string()
    }

    /// What stands at a tick.
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|(at, _)| at == value);
        tick.map_or_else(String::new, |(_, label)| label.clone())
    }
}

/// Smallest and largest of the finite values; an empty range of none.
pub(crate) fn bounds(values: impl IntoIterator<Item = f64>) -> Range<f64> {
    let none = f64::INFINITY..f64::NEG_INFINITY;
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold(none, |range, v| range.start.min(v)..range.end.max(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        let axis = Axis::linear("x", [0.03, 0.71, f64::NAN]);
        assert_eq!(labels(&axis), ["0.0", "0.2", "0.4", "0.6", "0.8"]);
        assert_eq!((axis.ends.start, axis.map(&0.8, (0, 80))), (0.0, 80));
        let axis = Axis::symmetric("x", [-0.21, 0.1]);
        assert_eq!(labels(&axis), ["−0.2", "−0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(
            labels(&Axis::steps(100)),
            ["0", "20", "40", "60", "80", "100"]
        );
        assert_eq!(
            labels(&Axis::log("t", [0.004, 30.0, 0.0])),
            ["0.01", "0.1", "1", "10"]
        );
    }

    #[test]
    fn many_decades_have_a_number_at_every_second() {
        let few = Axis::log("t", [0.06, 0.4]);
        assert_eq!(labels(&few), ["0.05", "0.1", "0.2", "0.5"]);
        let axis = Axis::log("t", [3e-6, 30.0]);
        assert_eq!(labels(&axis), ["", "0.0001", "", "0.01", "", "1", ""]);
        assert!(
            Axis::log("t", [1e-300, 1e300]).ticks.is_empty(),
            "no more than fit"
        );
    }

    #[test]
    fn nothing_to_show_still_makes_an_axis() {
        for axis in [
            Axis::linear("x", []),
            Axis::linear("x", [3.0]),
            Axis::linear("x", [0.0, 0.0]),
            Axis::symmetric("x", []),
            Axis::symmetric("x", [0.0]),
            Axis::log("x", [0.0]),
            Axis::log("x", [1.0]),
            Axis::steps(0),
            Axis::names(&[]),
        ] {
            let Range { start, end } = axis.ends.clone();
            assert!(
                start < end && start.is_finite() && end.is_finite(),
                "{axis:?}"
            );
        }
    }
}
