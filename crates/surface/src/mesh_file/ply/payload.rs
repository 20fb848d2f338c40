//! What follows the header of a PLY file: numbers, as text or as bytes.

use super::super::text::{self, PassedOver};
use super::header::{Element, Encoding, Header, PropertyKind, Scalar};
use super::malformed;
use crate::SurfaceError;

/// The numbers of one element after another.
pub(super) struct Payload<'a> {
    source: Source<'a>,
    /// The element that is read.
    element: (&'a str, u64),
}

enum Source<'a> {
    /// An element stands on one line. To read on in the next one where numbers are missing would
    /// take every number for another.
    Text {
        lines: Box<dyn Iterator<Item = (usize, &'a [u8])> + 'a>,
        number: usize,
        rest: &'a [u8],
        /// Lines with more words than their element has numbers.
        longer: PassedOver,
    },
    Bytes {
        rest: &'a [u8],
        is_big_endian: bool,
    },
}

impl<'a> Payload<'a> {
    pub(super) fn new(header: &'a Header<'_>) -> Self {
        let body: &'a [u8] = header.body;
        let source = match header.encoding {
            Encoding::Text => {
                let first = header.body_line;
                let lines = text::lines(body).map(move |(n, line)| (first + n - 1, line));
                Source::Text {
                    lines: Box::new(lines),
                    number: first,
                    rest: b"",
                    longer: PassedOver::default(),
                }
            }
            encoding => Source::Bytes {
                rest: body,
                is_big_endian: encoding == Encoding::BigEndian,
            },
        };
        let element = ("vertex", 0);
        Self { source, element }
    }

    /// Goes to the next element.
    pub(super) fn begin(&mut self, element: &'a Element, number: u64) -> Result<(), SurfaceError> {
        self.element = (&element.name, number);
        self.end_line();
        if let Source::Text {
            lines,
            number: line,
            rest,
            ..
        } = &mut self.source
        {
            let filled = lines.find(|(_, text)| !text.trim_ascii().is_empty());
            match filled {
                Some(found) => (*line, *rest) = found,
                None => {
                    let Element { name, count, .. } = element;
                    let reason = format!("end of file after {number} of {count} elements {name}");
                    return Err(self.error(reason));
                }
            }
        }
        Ok(())
    }

    /// Reads a property; hands each of its numbers to `take`.
    pub(super) fn property(
        &mut self,
        kind: PropertyKind,
        mut take: impl FnMut(f64),
    ) -> Result<(), SurfaceError> {
        match kind {
            PropertyKind::Number(scalar) => take(self.number(scalar)?),
            PropertyKind::List(length, item) => {
                let length = self.number(length)?;
                if length < 0.0 || length.fract() != 0.0 {
                    return Err(self.error(format!("a list of {length} numbers")));
                }
                let mut read = 0.0;
                while read < length {
                    take(self.number(item)?);
                    read += 1.0;
                }
            }
        }
        Ok(())
    }

    /// What is left after the last element, and what was passed over.
    pub(super) fn notes(mut self) -> Vec<String> {
        self.end_line();
        match self.source {
            Source::Text { lines, longer, .. } => {
                let mut beyond = PassedOver::default();
                lines
                    .filter(|(_, line)| !line.trim_ascii().is_empty())
                    .for_each(|(number, _)| beyond.add(number));
                let longer = longer.note("longer than the header says, the rest left out");
                let beyond = beyond.note("after the last element, left out");
                longer.into_iter().chain(beyond).collect()
            }
            Source::Bytes { rest: [], .. } => Vec::new(),
            Source::Bytes { rest, .. } => {
                let count = rest.len();
                vec![format!("{count} bytes after the last element are left out")]
            }
        }
    }

    fn end_line(&mut self) {
        if let Source::Text {
            number,
            rest,
            longer,
            ..
        } = &mut self.source
        {
            if !rest.trim_ascii().is_empty() {
                longer.add(*number);
            }
            *rest = b"";
        }
    }

    fn number(&mut self, scalar: Scalar) -> Result<f64, SurfaceError> {
        let number = match &mut self.source {
            Source::Text { rest, .. } => next_word(rest)
                .ok_or_else(|| "it has fewer numbers than the header says".to_owned())
                .and_then(|word| of_text(word, scalar)),
            Source::Bytes {
                rest,
                is_big_endian,
            } => of_bytes(rest, scalar, *is_big_endian)
                .ok_or_else(|| "end of file within it".to_owned()),
        };
        number.map_err(|reason| self.error(reason))
    }

    fn error(&self, reason: String) -> SurfaceError {
        let place = match self.source {
            Source::Text { number, .. } => format!("line {number}"),
            Source::Bytes { .. } => format!("{} {}", self.element.0, self.element.1),
        };
        malformed(place, reason)
    }
}

fn next_word<'a>(line: &mut &'a [u8]) -> Option<&'a [u8]> {
    let text = line.trim_ascii_start();
    let end = text.iter().position(u8::is_ascii_whitespace);
    let (word, rest) = text.split_at(end.unwrap_or(text.len()));
    *line = rest;
    (!word.is_empty()).then_some(word)
}

/// As a binary file would have it, so that the same numbers are joined.
fn of_text(word: &[u8], scalar: Scalar) -> Result<f64, String> {
    let number = match scalar {
        Scalar::F32 => text::number::<f32>(word).map(f64::from),
        _ => text::number(word),
    };
    number.ok_or_else(|| format!("{} is not a number", text::quoted(word)))
}

fn of_bytes(rest: &mut &[u8], scalar: Scalar, is_big_endian: bool) -> Option<f64> {
    fn take<const N: usize>(rest: &mut &[u8], is_big_endian: bool) -> Option<[u8; N]> {
        let (bytes, after) = rest.split_first_chunk::<N>()?;
        *rest = after;
        let mut bytes = *bytes;
        if is_big_endian {
            bytes.reverse();
        }
        Some(bytes)
    }
    Some(match scalar {
        Scalar::I8 => i8::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::U8 => u8::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::I16 => i16::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::U16 => u16::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::I32 => i32::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::U32 => u32::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::F32 => f32::from_le_bytes(take(rest, is_big_endian)?).into(),
        Scalar::F64 => f64::from_le_bytes(take(rest, is_big_endian)?),
    })
}
