//! Wavefront OBJ: the lines `v` and `f`. All others are about looks, curves and names.
//!
//! Read here rather than by a crate, so that an error names its line, coordinates keep 64 bits,
//! and neither materials nor wrong numbers of normals are in the way of the shape.

use super::{Joiner, MOST_VERTICES, MeshFormat, check_corners};
use crate::SurfaceError;

/// Words that begin a line of an OBJ file.
const KEYWORDS: [&[u8]; 15] = [
    b"v", b"vn", b"vt", b"vp", b"f", b"l", b"p", b"o", b"g", b"s", b"mtllib", b"usemtl", b"cstype",
    b"deg", b"curv",
];

/// Whether this is OBJ by the first word that is not a comment.
pub(super) fn is_obj(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii);
    lines
        .find(|line| !line.is_empty() && !line.starts_with(b"#"))
        .is_some_and(|line| {
            let word = line.split(u8::is_ascii_whitespace).next();
            word.is_some_and(|word| KEYWORDS.contains(&word))
        })
}

/// Reads the faces.
pub(super) fn parse(bytes: &[u8], joiner: &mut Joiner) -> Result<(), SurfaceError> {
    let mut positions: Vec<[f64; 3]> = Vec::new();
    let mut corners = Vec::new();
    for (number, line) in logical_lines(bytes) {
        let at_line = |reason: String| SurfaceError::Malformed {
            format: MeshFormat::Obj,
            place: format!("line {number}"),
            reason,
        };
        // Names and comments may be in any encoding; the lines that are read are ASCII.
        let text = String::from_utf8_lossy(&line);
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                if positions.len() as u64 == MOST_VERTICES {
                    let reason = format!("there are more than {MOST_VERTICES} vertices");
                    return Err(at_line(reason));
                }
                positions.push(position(words).map_err(at_line)?);
            }
            Some("f") => {
                corners.clear();
                for word in words {
                    corners.push(corner(word, &positions).map_err(at_line)?);
                    check_corners(corners.len())?;
                }
                if corners.len() < 3 {
                    let count = corners.len();
                    return Err(at_line(format!("a face with {count} corners")));
                }
                joiner.add_polygon(&corners)?;
            }
            _ => {}
        }
    }
    Ok(())
}

/// Lines with the number of their first one; a backslash at the end joins a line to the next.
fn logical_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Vec<u8>)> {
    let mut lines = bytes.split(|b| *b == b'\n').zip(1..);
    std::iter::from_fn(move || {
        let (first, number) = lines.next()?;
        let mut line = first.trim_ascii_end().to_vec();
        while line.last() == Some(&b'\\') {
            line.pop();
            let Some((next, _)) = lines.next() else { break };
            line.push(b' ');
            line.extend_from_slice(next.trim_ascii_end());
        }
        Some((number, line))
    })
}

/// x, y and z; what follows is a weight or a colour.
fn position<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], String> {
    let mut place = [0.0; 3];
    for coordinate in &mut place {
        let word = words
            .next()
            .ok_or("a vertex with fewer than 3 coordinates")?;
        *coordinate = word
            .parse()
            .map_err(|_| format!("{word:?} is not a number"))?;
    }
    Ok(place)
}

/// The place that a face's corner names, as `7`, `7/1`, `7//3` or `7/1/3`: counted from 1, or
/// backwards from −1.
fn corner(word: &str, positions: &[[f64; 3]]) -> Result<[f64; 3], String> {
    let index = word.split('/').next().unwrap_or_default();
    let number: i64 = index
        .parse()
        .map_err(|_| format!("{word:?} is not the number of a vertex"))?;
    let count = positions.len();
    let index = usize::try_from(number.unsigned_abs())
        .ok()
        .and_then(|distance| match number {
            1.. => distance.checked_sub(1),
            0 => None,
            _ => count.checked_sub(distance),
        });
    index
        .and_then(|index| positions.get(index).copied())
        .ok_or_else(|| format!("a face names vertex {number}, and {count} came before it"))
}
