//! What a user should know of many runs, in few words.

/// The warnings of many runs, each once, in order. Those that differ only in what stands in brackets at their end are
/// one, which then has the number of its runs there.
pub(crate) fn merged<'a>(runs: impl IntoIterator<Item = &'a [String]>) -> Vec<String> {
    let mut kinds: Vec<(&str, &str, usize)> = Vec::new();
    for warnings in runs {
        for warning in warnings {
            let gist = gist(warning);
            match kinds.iter_mut().find(|(known, ..)| *known == gist) {
                Some((_, _, count)) => *count += 1,
                None => kinds.push((gist, warning, 1)),
            }
        }
    }
    let told = |(gist, first, count): (&str, &str, usize)| match count {
        1 => first.to_owned(),
        _ => format!("{gist} (in {count} runs)"),
    };
    kinds.into_iter().map(told).collect()
}

/// A warning without the brackets at its end.
fn gist(warning: &str) -> &str {
    warning
        .strip_suffix(')')
        .and_then(|warning| warning.rsplit_once(" ("))
        .map_or(warning, |(gist, _)| gist)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_in_brackets_only_is_said_once() {
        let texts = |texts: &[&str]| texts.iter().map(ToString::to_string).collect::<Vec<_>>();
        let runs = [
            texts(&["a (3 of 4)", "b"]),
            texts(&[]),
            texts(&["c (1)", "a (4 of 4)"]),
            texts(&["b"]),
        ];
        let merged = merged(runs.iter().map(Vec::as_slice));
        assert_eq!(merged, ["a (in 2 runs)", "b (in 2 runs)", "c (1)"]);
    }
}
