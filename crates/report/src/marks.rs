//! The marks of agreement, and the strips that show how far ours are from the published value.
//!
//! Marks differ in shape as well as in colour, and have their word as a text for screen readers.

use adslam_experiment::tables::{Agreement, ResultCell};
use maud::{Markup, html};

/// The width of a strip, and the half of it.
const WIDTH: f64 = 104.0;
const MIDDLE: f64 = WIDTH / 2.0;
/// The ends of a strip are this many doublings away from the published value.
const DOUBLINGS: f64 = 2.0;
/// Room at both ends for arrows.
const MARGIN: f64 = 8.0;

/// The mark of an agreement.
pub(crate) fn mark(agreement: Agreement) -> Markup {
    let word = agreement.as_str();
    html! {
        svg .mark .(word) viewBox="0 0 12 12" role="img" aria-label=(word) {
            title { (word) }
            @match agreement {
                Agreement::Agrees => circle cx="6" cy="6" r="4.5" fill="currentColor" {},
                Agreement::Near => {
                    circle cx="6" cy="6" r="4" fill="none" stroke="currentColor" stroke-width="1.4" {}
                    path d="M6 2a4 4 0 0 0 0 8z" fill="currentColor" {}
                }
                Agreement::Lower => path d="M1 2h10l-5 9z" fill="currentColor" {},
                Agreement::Higher => path d="M1 10h10l-5 -9z" fill="currentColor" {},
            }
        }
    }
}

/// Our mean and range as multiples of the published value, on a logarithmic axis with that value
/// in the middle and a quarter and four times of it at the ends. Nothing where either is missing
/// or the published value is zero.
pub(crate) fn strip(cell: &ResultCell) -> Option<Markup> {
    let published = cell.published?.mean().filter(|value| *value > 0.0)?;
    let spread = cell.ours.spread()?;
    let [low, mean, high] = [spread.min, spread.mean, spread.max].map(|v| v / published);
    let label = format!(
        "our mean is {} of the published value, our runs are from {} to {}",
        times(mean),
        times(low),
        times(high)
    );
    let (left, right) = (place(low), place(high));
    let at = place(mean);
    Some(html! {
        @if let Some(ratio) = cell.ratio() { span .ratio { (ratio) } }
        svg .strip viewBox={ "0 0 " (WIDTH) " 14" } role="img" aria-label=(label) {
            title { (label) }
            line .axis x1=(MARGIN) x2=(WIDTH - MARGIN) y1="7" y2="7" {}
            line .published x1=(MIDDLE) x2=(MIDDLE) y1="0" y2="14" {}
            line .range x1=(number(left)) x2=(number(right)) y1="7" y2="7" {}
            @if is_beyond(low) { path .beyond d="M7 3.5l-5 3.5l5 3.5" {} }
            @if is_beyond(high) { path .beyond d={ "M" (WIDTH - 7.0) " 3.5l5 3.5l-5 3.5" } {} }
            circle .mean cx=(number(at)) cy="7" r="3.2" {}
        }
    })
}

/// Where a multiple stands on the strip; at its end if it lies beyond.
fn place(multiple: f64) -> f64 {
    let doublings = multiple.max(f64::MIN_POSITIVE).log2();
    MIDDLE + doublings.clamp(-DOUBLINGS, DOUBLINGS) / DOUBLINGS * (MIDDLE - MARGIN)
}

fn is_beyond(multiple: f64) -> bool {
    multiple.max(f64::MIN_POSITIVE).log2().abs() > DOUBLINGS
}

fn times(multiple: f64) -> String {
    let digits = if multiple < 10.0 { 2 } else { 0 };
    format!("{multiple:.digits$}×")
}

fn number(x: f64) -> String {
    format!("{x:.1}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use adslam_experiment::tables::CellValue;
    use adslam_experiment::tables::Spread;

    fn cell(published: f64, ours: [f64; 3]) -> ResultCell {
        ResultCell {
            published: Some(CellValue::Number {
                value: published,
                digits: 3,
            }),
            ours: CellValue::Spread {
                spread: Spread::of(ours).unwrap(),
                digits: 3,
            },
            comparison: None,
        }
    }

    #[test]
    fn the_published_value_is_in_the_middle_and_four_times_at_the_end() {
        assert_eq!(place(1.0), MIDDLE);
        assert_eq!(place(4.0), WIDTH - MARGIN);
        assert_eq!(place(0.25), MARGIN);
        assert_eq!(place(0.0), MARGIN);
        assert_eq!(place(1e9), WIDTH - MARGIN);
    }

    #[test]
    fn what_lies_beyond_has_an_arrow_and_nothing_is_compared_with_nothing() {
        let within = strip(&cell(1.0, [0.5, 1.0, 2.0])).unwrap().into_string();
        assert!(within.contains("our mean is 1.17× of") && !within.contains("beyond"));
        let beyond = strip(&cell(1.0, [0.0, 1.0, 9.0])).unwrap().into_string();
        assert_eq!(beyond.matches("beyond").count(), 2);
        assert!(strip(&cell(0.0, [0.5, 1.0, 2.0])).is_none());
    }
}
