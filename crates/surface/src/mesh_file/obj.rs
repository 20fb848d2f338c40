//! Wavefront OBJ: the lines `v` and `f`. All others are about looks, curves and names.
//!
//! Read here rather than by a crate, so that an error names its line, coordinates keep 64 bits,
//! and neither materials nor wrong numbers of normals are in the way of the shape.

use super::text::{self, PassedOver};
use super::{Joiner, MOST_VERTICES, MeshFormat, check_corners};
use crate::SurfaceError;

/// Words that begin a line with numbers or indices.
const SHAPES: [&str; 27] = [
    "v", "vn", "vt", "vp", "f", "l", "p", "s", "mg", "cstype", "deg", "bmat", "step", "curv",
    "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "bevel", "c_interp",
    "d_interp", "lod",
];

/// Words that begin a line with names. A backslash at its end is part of a path.
const NAMES: [&str; 13] = [
    "o",
    "g",
    "mtllib",
    "usemtl",
    "maplib",
    "usemap",
    "call",
    "csh",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "newmtl",
];

/// Whether this is OBJ by the first word that is not a comment.
pub(super) fn is_obj(bytes: &[u8]) -> bool {
    let mut firsts = text::lines(text::unmarked(bytes)).filter_map(|(_, line)| first_word(line));
    firsts.next().is_some_and(is_keyword)
}

/// Reads the faces.
pub(super) fn parse(
    bytes: &[u8],
    joiner: &mut Joiner,
    notes: &mut Vec<String>,
) -> Result<(), SurfaceError> {
    text::check_encoding(MeshFormat::Obj, bytes)?;
    let bytes = text::unmarked(bytes);
    // All vertices first: a face may name one that comes after it.
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut passed_over = PassedOver::default();
    for (number, line) in logical_lines(bytes) {
        let mut words = text::words(&line);
        let Some(first) = words.next() else { continue };
        if first.eq_ignore_ascii_case(b"v") {
            if positions.len() as u64 == MOST_VERTICES {
                let reason = format!("there are more than {MOST_VERTICES} vertices");
                return Err(at_line(number, reason));
            }
            positions.push(position(words).map_err(|reason| at_line(number, reason))?);
        } else if !is_keyword(first) {
            check_harmless(&line).map_err(|reason| at_line(number, reason))?;
            passed_over.add(number);
        }
    }
    let mut before = 0;
    let mut corners = Vec::new();
    for (number, line) in logical_lines(bytes) {
        let mut words = text::words(&line);
        let Some(first) = words.next() else { continue };
        before += usize::from(first.eq_ignore_ascii_case(b"v"));
        if first.eq_ignore_ascii_case(b"f") {
            corners.clear();
            for word in words {
                let place = corner(word, &positions, before);
                corners.push(place.map_err(|reason| at_line(number, reason))?);
                check_corners(corners.len())?;
            }
            if corners.len() < 3 {
                let reason = format!("a face with {} corners", corners.len());
                return Err(at_line(number, reason));
            }
            joiner.add_polygon(&corners)?;
        }
    }
    notes.extend(passed_over.note("not understood, left out"));
    Ok(())
}

fn at_line(number: usize, reason: String) -> SurfaceError {
    SurfaceError::Malformed {
        format: MeshFormat::Obj,
        place: format!("line {number}"),
        reason,
    }
}

/// The first word of a line unless that is a comment. Files that were joined have marks within.
fn first_word(line: &[u8]) -> Option<&[u8]> {
    text::words(text::unmarked(line))
        .next()
        .filter(|word| !word.starts_with(b"#"))
}

fn is_one_of(word: &[u8], keywords: &[&str]) -> bool {
    let mut keywords = keywords.iter();
    keywords.any(|keyword| word.eq_ignore_ascii_case(keyword.as_bytes()))
}

fn is_keyword(word: &[u8]) -> bool {
    is_one_of(word, &SHAPES) || is_one_of(word, &NAMES)
}

/// Refuses a line that is not understood if it may be a vertex or a face: without it, all that
/// comes after would be numbered wrongly.
fn check_harmless(line: &[u8]) -> Result<(), String> {
    let is_number = |word: &&[u8]| {
        let index = word.split(|b| *b == b'/').next();
        index.and_then(text::number::<f64>).is_some()
    };
    let begins_alike = line
        .trim_ascii_start()
        .first()
        .is_some_and(|letter| b"vVfF".contains(letter));
    if begins_alike || text::words(line).filter(is_number).count() >= 3 {
        let first = text::words(line).next().unwrap_or_default();
        return Err(format!(
            "{} is no keyword of OBJ, and the line may be a vertex or a face",
            text::quoted(first)
        ));
    }
    Ok(())
}

/// Lines without comments, with the number of their first one; a backslash at the end joins a line
/// to the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> {
    let mut lines = text::lines(bytes);
    let without_comment = |line: &[u8]| -> Vec<u8> {
        let line = text::unmarked(line).split(|b| *b == b'#').next();
        line.unwrap_or_default().trim_ascii_end().to_vec()
    };
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut line = without_comment(first);
        let is_name = first_word(&line).is_some_and(|word| is_one_of(word, &NAMES));
        while !is_name && line.last() == Some(&b'\\') {
            line.pop();
            let Some((_, next)) = lines.next() else { break };
            line.push(b' ');
            line.extend(without_comment(next));
        }
        Some((number, line))
    })
}

/// x, y and z; what follows is a weight or a colour.
fn position<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<[f64; 3], String> {
    let mut place = [0.0; 3];
    for coordinate in &mut place {
        *coordinate = text::coordinate(&mut words)?;
    }
    Ok(place)
}

/// The place that a face's corner names, as `7`, `7/1`, `7//3` or `7/1/3`: counted from 1, or
/// backwards from −1, the last of those `before` the face.
fn corner(word: &[u8], positions: &[[f64; 3]], before: usize) -> Result<[f64; 3], String> {
    let index = word.split(|b| *b == b'/').next().unwrap_or_default();
    let number: i64 = text::number(index)
        .ok_or_else(|| format!("{} is not the number of a vertex", text::quoted(word)))?;
    let index = usize::try_from(number.unsigned_abs())
        .ok()
        .and_then(|distance| match number {
            1.. => distance.checked_sub(1),
            0 => None,
            _ => before.checked_sub(distance),
        });
    let place = index.and_then(|index| positions.get(index).copied());
    place.ok_or_else(|| match number {
        ..0 => format!("a face names vertex {number}, and {before} came before it"),
        _ => format!(
            "a face names vertex {number}, and there are {}, numbered from 1",
            positions.len()
        ),
    })
}
