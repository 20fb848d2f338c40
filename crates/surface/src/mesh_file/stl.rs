//! STL, binary and text.
//!
//! Read here rather than by a crate, so that an error names its line, and several solids, keywords in
//! capitals and names in any encoding are read.

use super::text::{self, PassedOver};
use super::{Joiner, MeshFormat, check_faces};
use crate::SurfaceError;

/// Bytes before the first triangle of a binary file: a free text and the count.
const HEADER: usize = 84;
/// Bytes of a binary triangle: normal, corners, attribute.
const RECORD: usize = 50;

/// Whether this is STL by its first word, or by its size for a binary file.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    has_binary_size(bytes) || first_word(bytes).eq_ignore_ascii_case(b"solid")
}

/// Reads the triangles; returns whether the file is binary.
pub(super) fn parse(
    bytes: &[u8],
    joiner: &mut Joiner,
    notes: &mut Vec<String>,
) -> Result<bool, SurfaceError> {
    if bytes.is_empty() {
        return Err(SurfaceError::EmptyMesh);
    }
    // Many binary files begin with "solid" too; the size tells.
    if has_binary_size(bytes) {
        parse_binary(bytes, joiner, notes)?;
        return Ok(true);
    }
    text::check_encoding(MeshFormat::Stl, bytes)?;
    // Nor has text a zero byte, which the count of a binary file ends with.
    let is_binary = bytes.iter().take(HEADER).any(|b| *b == 0);
    if is_binary {
        parse_binary(bytes, joiner, notes)?;
    } else {
        Text::default().parse(text::unmarked(bytes), joiner, notes)?;
    }
    Ok(is_binary)
}

fn first_word(bytes: &[u8]) -> &[u8] {
    text::words(text::unmarked(bytes))
        .next()
        .unwrap_or_default()
}

/// The count in the header, if the bytes are long enough to be a binary file.
fn announced_faces(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}

fn size_of(faces: u64) -> u64 {
    HEADER as u64 + RECORD as u64 * faces
}

fn has_binary_size(bytes: &[u8]) -> bool {
    announced_faces(bytes).is_some_and(|faces| size_of(faces) == bytes.len() as u64)
}

fn parse_binary(
    bytes: &[u8],
    joiner: &mut Joiner,
    notes: &mut Vec<String>,
) -> Result<(), SurfaceError> {
    let given = bytes.len() as u64;
    let not_stl = |reason: String| malformed("at its start".to_owned(), reason);
    let Some(faces) = announced_faces(bytes) else {
        return Err(not_stl(format!(
            "{given} bytes are fewer than the {HEADER} of a binary header"
        )));
    };
    // The size first: of bytes that are not STL the count means nothing.
    let expected = size_of(faces);
    if expected > given {
        return Err(SurfaceError::WrongSize {
            faces,
            expected,
            given,
        });
    }
    check_faces(faces)?;
    let left_over = given - expected;
    if faces == 0 && left_over > 0 {
        return Err(not_stl(format!(
            "the binary header announces no triangles, and {left_over} bytes follow it"
        )));
    }
    let (records, _) = bytes[HEADER..].as_chunks::<RECORD>();
    // As many as a file of acceptable size has.
    let faces = usize::try_from(faces).unwrap_or(usize::MAX);
    for record in records.iter().take(faces) {
        let (numbers, _) = record.as_chunks::<4>();
        let number = |i: usize| f64::from(f32::from_le_bytes(numbers[i]));
        // The first three are the normal.
        let corner = |first: usize| [number(first), number(first + 1), number(first + 2)];
        joiner.add([corner(3), corner(6), corner(9)])?;
    }
    if left_over > 0 {
        notes.push(format!(
            "{left_over} bytes after the last triangle are left out"
        ));
    }
    Ok(())
}

/// What has been read of a text file.
#[derive(Debug, Default)]
struct Text {
    in_solid: bool,
    /// The line where the facet that is being read begins, and its corners so far.
    facet: Option<(usize, Vec<[f64; 3]>)>,
    has_solids: bool,
    /// Lines that begin a solid without an `endsolid`.
    unclosed: PassedOver,
    /// Lines outside of every solid.
    outside: PassedOver,
}

impl Text {
    fn parse(
        mut self,
        bytes: &[u8],
        joiner: &mut Joiner,
        notes: &mut Vec<String>,
    ) -> Result<(), SurfaceError> {
        let mut last = 0;
        let mut solid_line = 0;
        for (number, line) in text::lines(bytes) {
            last = number;
            let mut words = text::words(text::unmarked(line));
            let Some(first) = words.next() else { continue };
            let is = |keyword: &str| first.eq_ignore_ascii_case(keyword.as_bytes());
            let at_line = |reason: String| malformed(format!("line {number}"), reason);
            if is("solid") {
                self.refuse_open_facet("a solid begins").map_err(at_line)?;
                if self.in_solid {
                    self.unclosed.add(solid_line);
                }
                (self.in_solid, self.has_solids, solid_line) = (true, true, number);
            } else if is("endsolid") {
                self.refuse_open_facet("a solid ends").map_err(at_line)?;
                self.in_solid = false;
            } else if self.in_solid {
                if let Some(corners) = self.line_of_solid(number, first, words).map_err(at_line)? {
                    joiner.add(corners)?;
                }
            } else if is("facet") {
                return Err(at_line("a facet outside of every solid".to_owned()));
            } else {
                self.outside.add(number);
            }
        }
        self.refuse_open_facet("the file ends")
            .map_err(|reason| malformed(format!("line {last}"), reason))?;
        if !self.has_solids {
            let reason = "it is neither binary, nor has it a line that begins with \"solid\"";
            return Err(malformed("at its start".to_owned(), reason.to_owned()));
        }
        if self.in_solid {
            self.unclosed.add(solid_line);
        }
        let unclosed = "a solid begins that no \"endsolid\" ends; is the file cut short?";
        notes.extend(self.unclosed.note(unclosed));
        notes.extend(self.outside.note("outside of every solid, left out"));
        Ok(())
    }

    fn refuse_open_facet(&self, what: &str) -> Result<(), String> {
        match &self.facet {
            None => Ok(()),
            Some((line, _)) => Err(format!(
                "{what} within the facet that begins in line {line}"
            )),
        }
    }

    /// Reads a line within a solid; the corners of the facet that it ends.
    fn line_of_solid<'a>(
        &mut self,
        number: usize,
        first: &[u8],
        mut words: impl Iterator<Item = &'a [u8]>,
    ) -> Result<Option<[[f64; 3]; 3]>, String> {
        let is = |keyword: &str| first.eq_ignore_ascii_case(keyword.as_bytes());
        if is("facet") {
            // The normal says nothing that the corners do not, and some programs write "nan" there.
            self.refuse_open_facet("a facet begins")?;
            self.facet = Some((number, Vec::with_capacity(3)));
        } else if is("vertex") {
            let Some((_, corners)) = &mut self.facet else {
                return Err("a vertex outside of every facet".to_owned());
            };
            let mut place = [0.0; 3];
            for coordinate in &mut place {
                // STL has 32-bit numbers, in text as in bytes.
                *coordinate = f64::from(text::coordinate::<f32>(&mut words)?);
            }
            if words.next().is_some() {
                return Err("a vertex with more than 3 coordinates".to_owned());
            }
            if corners.len() == 3 {
                return Err("a facet with more than 3 corners".to_owned());
            }
            corners.push(place);
        } else if is("endfacet") {
            let Some((_, corners)) = self.facet.take() else {
                return Err("\"endfacet\" outside of every facet".to_owned());
            };
            return <[[f64; 3]; 3]>::try_from(corners)
                .map(Some)
                .map_err(|corners| format!("a facet with {} corners", corners.len()));
        } else if !is("outer") && !is("endloop") {
            return Err(format!("{} is not understood", text::quoted(first)));
        }
        Ok(None)
    }
}

fn malformed(place: String, reason: String) -> SurfaceError {
    SurfaceError::Malformed {
        format: MeshFormat::Stl,
        place,
        reason,
    }
}
