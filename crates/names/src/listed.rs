//! Lists in words.

/// A list of numbers for a message, cut where it gets long.
#[must_use]
pub fn numbers(values: impl IntoIterator<Item = usize>) -> String {
    const SHOWN: usize = 12;
    let values: Vec<usize> = values.into_iter().collect();
    let shown: Vec<String> = values.iter().take(SHOWN).map(ToString::to_string).collect();
    let rest = values.len().saturating_sub(SHOWN);
    let more = if rest == 0 {
        String::new()
    } else {
        format!(" and {rest} more")
    };
    format!("{}{more}", shown.join(", "))
}
