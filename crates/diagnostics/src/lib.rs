//! Bad input, told so that its author can mend it: what is wrong, where, and what to write instead.
//!
//! ```
//! use std::path::Path;
//!
//! use adslam_diagnostics::InputError;
//!
//! let text = "range_cm = -3\n";
//! let error = InputError::in_text(Path::new("a.toml"), text, 11..13, "-3 is no range").with_help("write 3");
//! assert_eq!(error.line_and_column(), Some((1, 12)));
//! assert_eq!(error.pointed_at(), Some("-3"));
//! ```

mod failure;
mod interrupt;
mod text_file;

use std::fmt::Display;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

pub use failure::Failure;
pub use interrupt::Interrupt;
pub use text_file::{is_there, read_text};

/// Input that cannot be used: a file that cannot be read, or whose content is wrong.
///
/// Printed by miette's report handler it shows the file, the line with a caret under the place,
/// and a remedy; [`Display`] gives the message alone. The command ends with the exit code of bad
/// input on it.
#[derive(Debug, Error, Diagnostic)]
#[error(transparent)]
#[diagnostic(transparent)]
pub struct InputError(Box<Details>);

#[derive(Debug, Error, Diagnostic)]
#[error("{message}{place}")]
struct Details {
    message: String,
    /// Where it is, in words, where the text is too long to show.
    place: String,
    path: PathBuf,
    #[source_code]
    text: Option<NamedSource<String>>,
    #[label("{label}")]
    span: Option<SourceSpan>,
    line_and_column: Option<(usize, usize)>,
    label: String,
    #[help]
    help: Option<String>,
    #[source]
    cause: Option<io::Error>,
}

impl InputError {
    /// Something is wrong with the file at `path` as a whole. The message should name the file.
    pub fn about_file(path: &Path, message: impl Display) -> Self {
        Self(Box::new(Details {
            message: message.to_string(),
            place: String::new(),
            path: path.to_owned(),
            text: None,
            span: None,
            line_and_column: None,
            label: "here".to_owned(),
            help: None,
            cause: None,
        }))
    }

    /// The file at `path` cannot be read.
    pub fn unreadable(path: &Path, cause: io::Error) -> Self {
        let mut error = Self::about_file(path, format_args!("cannot read {}", path.display()));
        error.0.help = Some(match cause.kind() {
            io::ErrorKind::NotFound => "check the path".to_owned(),
            io::ErrorKind::PermissionDenied => "make the file readable".to_owned(),
            _ => "give the path of a readable file".to_owned(),
        });
        error.0.cause = Some(cause);
        error
    }

    /// Something is wrong in `text`, the content of the file at `path`, at the bytes `span`.
    ///
    /// A span that does not fit into the text is cut to what does, and one over many lines to the first
    /// of them. Where the lines are too long to be shown, the message says where they are.
    pub fn in_text(path: &Path, text: &str, span: Range<usize>, message: impl Display) -> Self {
        let start = floor_char_boundary(text, span.start);
        let end = floor_char_boundary(text, span.end).max(start);
        let end = end.min(start + bytes_of_lines(&text[start..], MOST_LINES_SHOWN));
        let (line, column) = line_and_column(text, start);
        let mut error = Self::about_file(path, message);
        error.0.span = Some((start, end - start).into());
        error.0.line_and_column = Some((line, column));
        // A line before and one after are shown with them.
        let from = text[..start].rmatch_indices('\n').nth(1);
        let from = from.map_or(0, |(at, _)| at);
        if end - from + bytes_of_lines(&text[end..], 2) > MOST_BYTES_SHOWN {
            error.0.place = format!(" (line {line}, column {column})");
        } else {
            error.0.text = Some(NamedSource::new(
                path.display().to_string(),
                text.to_owned(),
            ));
        }
        error
    }

    /// The same error with a remedy: what to write or do instead.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// The same error with this remedy, if it had none.
    #[must_use]
    pub fn with_help_if_none(mut self, help: &str) -> Self {
        self.0.help.get_or_insert_with(|| help.to_owned());
        self
    }

    /// The same error with other words beside the caret (default: "here").
    #[must_use]
    pub fn with_label(mut self, label: impl Into<String>) -> Self {
        self.0.label = label.into();
        self
    }

    /// The same error with another message.
    #[must_use]
    pub fn with_message(mut self, message: impl Into<String>) -> Self {
        self.0.message = message.into();
        self
    }

    /// What is wrong, in a line.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// What to write or do instead.
    pub fn remedy(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// The words beside the caret.
    pub fn label(&self) -> &str {
        &self.0.label
    }

    /// The file that is to blame.
    pub fn path(&self) -> &Path {
        &self.0.path
    }

    /// The bytes of the file that are to blame, if it is a part of it.
    pub fn span(&self) -> Option<Range<usize>> {
        self.0
            .span
            .map(|span| span.offset()..span.offset() + span.len())
    }

    /// Line and column, from 1, of the place that is to blame, if it is a part of the file; columns
    /// count characters.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        self.0.line_and_column
    }

    /// The text that is to blame, as it stands in the file: what the caret points at. None where that is
    /// too long to be shown.
    pub fn pointed_at(&self) -> Option<&str> {
        self.0.text.as_ref()?.inner().get(self.span()?)
    }
}

/// Lines that a report points at, at most.
const MOST_LINES_SHOWN: usize = 8;
/// Bytes of the lines that a report shows, at most: a screen or two.
const MOST_BYTES_SHOWN: usize = 4_000;

/// How many bytes the first `count` lines of `text` have, the end of the last not among them.
fn bytes_of_lines(text: &str, count: usize) -> usize {
    let end = text.match_indices('\n').nth(count - 1);
    end.map_or(text.len(), |(at, _)| at)
}

/// Line and column of a byte of `text`, from 1; columns count characters.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = before.matches('\n').count() + 1;
    (line, before[line_start..].chars().count() + 1)
}

/// The last character boundary at or before `index`.
fn floor_char_boundary(text: &str, index: usize) -> usize {
    let index = index.min(text.len());
    (0..=index)
        .rev()
        .find(|&i| text.is_char_boundary(i))
        .unwrap_or(0)
}
