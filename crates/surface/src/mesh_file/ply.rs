//! PLY, binary and ASCII.

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
};

use super::{Joiner, MOST_VERTICES, MeshFormat, check_corners, check_faces};
use crate::SurfaceError;

/// Whether this is PLY by its first line.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// A vertex or a face; what other elements have is let go.
#[derive(Debug, Default)]
struct Element {
    place: [f64; 3],
    corners: Vec<u32>,
}

/// Reads the faces; returns whether the file is binary.
pub(super) fn parse(bytes: &[u8], joiner: &mut Joiner) -> Result<bool, SurfaceError> {
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(bytes);
    let header = parser.read_header(&mut reader).map_err(|e| in_text(&e))?;
    let is_binary = header.encoding != Encoding::Ascii;
    check_header(&header, bytes.len())?;
    if !is_binary {
        check_lines(bytes)?;
    }
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for (name, definition) in &header.elements {
        let elements = parser
            .read_payload_for_element(&mut reader, definition, &header)
            .map_err(|e| if is_binary { in_bytes(&e) } else { in_text(&e) })?;
        match name.as_str() {
            "vertex" => positions = elements,
            "face" => faces = elements,
            _ => {}
        }
    }
    let mut corners = Vec::new();
    for (number, face) in faces.iter().enumerate() {
        check_corners(face.corners.len())?;
        corners.clear();
        for &index in &face.corners {
            let vertex = usize::try_from(index).ok().and_then(|i| positions.get(i));
            let count = positions.len();
            let vertex = vertex.ok_or_else(|| {
                malformed(
                    format!("face {number}"),
                    format!("it names vertex {index}, and there are {count}, numbered from 0"),
                )
            })?;
            corners.push(vertex.place);
        }
        joiner.add_polygon(&corners)?;
    }
    Ok(is_binary)
}

/// The longest line of a text file, in bytes: the reader makes a string of each of its words.
const LONGEST_LINE: usize = 1 << 20;

/// Refuses lines that would take much more memory than they have bytes.
fn check_lines(bytes: &[u8]) -> Result<(), SurfaceError> {
    let mut lines = bytes.split(|b| *b == b'\n').zip(1..);
    match lines.find(|(line, _)| line.len() > LONGEST_LINE) {
        None => Ok(()),
        Some((_, number)) => Err(malformed(
            format!("line {number}"),
            format!("it has more than {LONGEST_LINE} bytes"),
        )),
    }
}

/// Refuses what cannot be a mesh, and counts that the file is too short for: an element takes a
/// byte at least, so that nothing is read, or stored, for longer than there are bytes.
fn check_header(header: &Header, bytes: usize) -> Result<(), SurfaceError> {
    let in_header = |reason: String| malformed("in the header".to_owned(), reason);
    for (
        name,
        ElementDef {
            count, properties, ..
        },
    ) in &header.elements
    {
        if *count > 0 && properties.is_empty() {
            return Err(in_header(format!("element {name} has no properties")));
        }
        if *count as u64 > MOST_VERTICES {
            return Err(in_header(format!(
                "{count} of element {name} are announced, and {MOST_VERTICES} are the most"
            )));
        }
        if *count > bytes {
            return Err(in_header(format!(
                "{count} of element {name} are announced, and the file has {bytes} bytes"
            )));
        }
    }
    let find = |name: &str| {
        let element = header.elements.get(name);
        element.ok_or_else(|| in_header(format!("there is no element {name}")))
    };
    let vertex = find("vertex")?;
    for axis in ["x", "y", "z"] {
        match vertex.properties.get(axis).map(|p| &p.data_type) {
            Some(PropertyType::Scalar(_)) => {}
            _ => return Err(in_header(format!("element vertex has no number {axis}"))),
        }
    }
    let face = find("face")?;
    let is_list = |name: &str| {
        let property = face.properties.get(name);
        property.is_some_and(|p| matches!(p.data_type, PropertyType::List(..)))
    };
    if !CORNERS.iter().any(|name| is_list(name)) {
        let names = CORNERS.join(" or ");
        return Err(in_header(format!("element face has no list {names}")));
    }
    check_faces(face.count as u64)
}

/// What the list of a face's corners is called, by programs of different age.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ if CORNERS.contains(&name) => {
                return match indices(property) {
                    Some(corners) => {
                        self.corners = corners;
                        PropertyAccessResult::Set
                    }
                    None => PropertyAccessResult::UnsupportedType,
                };
            }
            _ => return PropertyAccessResult::Ignored,
        };
        match number(&property) {
            Some(value) => {
                self.place[axis] = value;
                PropertyAccessResult::Set
            }
            None => PropertyAccessResult::UnsupportedType,
        }
    }
}

fn number(property: &Property) -> Option<f64> {
    Some(match *property {
        Property::Char(v) => f64::from(v),
        Property::UChar(v) => f64::from(v),
        Property::Short(v) => f64::from(v),
        Property::UShort(v) => f64::from(v),
        Property::Int(v) => f64::from(v),
        Property::UInt(v) => f64::from(v),
        Property::Float(v) => f64::from(v),
        Property::Double(v) => v,
        _ => return None,
    })
}

/// None where one is negative or no whole number.
fn indices(property: Property) -> Option<Vec<u32>> {
    fn all<T: TryInto<u32>>(list: Vec<T>) -> Option<Vec<u32>> {
        list.into_iter()
            .map(|index| index.try_into().ok())
            .collect()
    }
    match property {
        Property::ListChar(list) => all(list),
        Property::ListUChar(list) => all(list),
        Property::ListShort(list) => all(list),
        Property::ListUShort(list) => all(list),
        Property::ListInt(list) => all(list),
        Property::ListUInt(list) => Some(list),
        _ => None,
    }
}

fn malformed(place: String, reason: String) -> SurfaceError {
    SurfaceError::Malformed {
        format: MeshFormat::Ply,
        place,
        reason,
    }
}

fn in_text(error: &ParseError) -> SurfaceError {
    let place = error.line().map(|line| format!("line {line}"));
    malformed(
        place.unwrap_or_else(|| "at its start".to_owned()),
        said(error),
    )
}

fn in_bytes(error: &ParseError) -> SurfaceError {
    malformed("after the header".to_owned(), said(error))
}

/// What the reader said, on one line, without the place and at a length to read.
fn said(error: &ParseError) -> String {
    const MOST: usize = 200;
    let text = error.to_string();
    let text = match error.line() {
        Some(line) => text.trim_start_matches(&format!("Line {line}: ")),
        None => &text,
    };
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.trim_end_matches('.').to_owned(),
    }
}
