//! What the text formats share: marks of the encoding, lines, words, numbers.

use super::MeshFormat;
use crate::SurfaceError;

/// The UTF-8 byte order mark.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// Most letters of a word that an error or a note quotes.
const QUOTED: usize = 40;

/// The text without a byte order mark.
pub(super) fn unmarked(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(MARK).unwrap_or(bytes)
}

/// Refuses text of two or four bytes for each letter, which would else look like a binary file.
pub(super) fn check_encoding(format: MeshFormat, bytes: &[u8]) -> Result<(), SurfaceError> {
    let wide = match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, 0, 0xfe, 0xff, ..] => true,
        [a, 0, b, 0, ..] | [0, a, 0, b, ..] => {
            [a, b].iter().all(|letter| (1..128).contains(*letter))
        }
        _ => false,
    };
    if wide {
        return Err(SurfaceError::Malformed {
            format,
            place: "at its start".to_owned(),
            reason: "its text is in UTF-16 or UTF-32, and should be in ASCII or UTF-8".to_owned(),
        });
    }
    Ok(())
}

/// The lines with their numbers from 1. They end with a line feed, a carriage return, or both.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut rest = Some(bytes);
    let ended = std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.iter().position(|b| matches!(b, b'\n' | b'\r')) else {
            rest = None;
            return Some(text);
        };
        let ending = if text[end..].starts_with(b"\r\n") {
            2
        } else {
            1
        };
        rest = Some(&text[end + ending..]);
        Some(&text[..end])
    });
    (1..).zip(ended)
}

/// What blanks part. Names may be in any encoding, so that words are bytes.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// A word as a number of any kind.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The next word as a number.
pub(super) fn coordinate<'a, T: std::str::FromStr>(
    words: &mut impl Iterator<Item = &'a [u8]>,
) -> Result<T, String> {
    let word = words
        .next()
        .ok_or("a vertex with fewer than 3 coordinates")?;
    number(word).ok_or_else(|| format!("{} is not a number", quoted(word)))
}

/// A word as errors and notes show it.
pub(super) fn quoted(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(word);
    match text.char_indices().nth(QUOTED) {
        Some((end, _)) => format!("{:?}…", &text[..end]),
        None => format!("{text:?}"),
    }
}

/// Lines that were passed over.
#[derive(Debug, Default)]
pub(super) struct PassedOver {
    count: usize,
    first: usize,
}

impl PassedOver {
    pub(super) fn add(&mut self, line: usize) {
        if self.count == 0 {
            self.first = line;
        }
        self.count += 1;
    }

    /// Which they are, and what about them; `None` if there are none.
    pub(super) fn note(&self, what: &str) -> Option<String> {
        let Self { count, first } = self;
        match count {
            0 => None,
            1 => Some(format!("line {first}: {what}")),
            _ => Some(format!(
                "{count} lines, the first of them line {first}: {what}"
            )),
        }
    }
}
