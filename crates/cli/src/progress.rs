//! Progress bars. They draw on the standard error stream, and only if that is a terminal.

use std::fs::File;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `total` pieces of work, with the time left.
pub(crate) fn bar(total: usize, unit: &str) -> ProgressBar {
    let template = format!("{{bar:30}} {{pos}}/{{len}} {unit}, {{elapsed}} gone, {{eta}} left");
    let style =
        ProgressStyle::with_template(&template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(total as u64).with_style(style);
    bar.enable_steady_tick(Duration::from_millis(250));
    bar
}

/// A bar over the bytes of a file, with the time left; of a pipe or the standard input, whose size is not
/// known, a count. Its message stands behind it.
pub(crate) fn reading(file: Option<&File>) -> ProgressBar {
    let size = file
        .and_then(|file| file.metadata().ok())
        .map_or(0, |metadata| metadata.len());
    let (bar, template) = if size > 0 {
        let template = "{bar:30} {bytes}/{total_bytes}, {msg}, {elapsed} gone, {eta} left";
        (ProgressBar::new(size), template)
    } else {
        (
            ProgressBar::no_length(),
            "{spinner} {bytes}, {msg}, {elapsed}",
        )
    };
    let style =
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner());
    bar.with_style(style)
}
