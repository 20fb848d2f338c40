//! The header of a PLY file: its elements, and their properties.

use super::super::{MOST_VERTICES, MeshFormat, check_faces, text};
use super::malformed;
use crate::SurfaceError;

/// What the list of a face's corners is called, by programs of different age.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The elements that are lists of corners.
const LISTS: [&str; 2] = ["face", "tristrips"];

const AXES: [&str; 3] = ["x", "y", "z"];

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// What kind of number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PropertyKind {
    Number(Scalar),
    /// The kinds of its length and of its items.
    List(Scalar, Scalar),
}

#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: PropertyKind,
}

#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// What follows the header, and the number of its first line.
    pub(super) body: &'a [u8],
    pub(super) body_line: usize,
}

/// Whether this is PLY by its first line.
pub(in super::super) fn is_ply(bytes: &[u8]) -> bool {
    let mut lines = text::lines(text::unmarked(bytes));
    lines
        .next()
        .is_some_and(|(_, line)| line.trim_ascii().eq_ignore_ascii_case(b"ply"))
}

impl<'a> Header<'a> {
    /// Reads and checks the header.
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, SurfaceError> {
        text::check_encoding(MeshFormat::Ply, bytes)?;
        let bytes = text::unmarked(bytes);
        if !is_ply(bytes) {
            let reason = "its first line is not \"ply\"".to_owned();
            return Err(malformed("line 1".to_owned(), reason));
        }
        let mut header = Self {
            encoding: Encoding::Text,
            elements: Vec::new(),
            body: bytes,
            body_line: 1,
        };
        let separator = last_of_line_ending(bytes);
        let mut has_format = false;
        loop {
            let place = format!("line {}", header.body_line);
            let Some(end) = header.body.iter().position(|b| *b == separator) else {
                let reason = "the header has no line \"end_header\"";
                return Err(malformed(place, reason.to_owned()));
            };
            let line = header.body[..end].to_ascii_lowercase();
            let words: Vec<&[u8]> = text::words(&line).collect();
            let is_end = words == [b"end_header"];
            has_format |= words.first() == Some(&&b"format"[..]);
            header
                .line(&words)
                .map_err(|reason| malformed(place, reason))?;
            header.body = &header.body[end + 1..];
            header.body_line += 1;
            if is_end {
                break;
            }
        }
        if !has_format {
            return Err(in_header("there is no line \"format\"".to_owned()));
        }
        header.check(bytes.len() as u64)?;
        Ok(header)
    }

    /// Takes a line's words, in small letters.
    fn line(&mut self, words: &[&[u8]]) -> Result<(), String> {
        match words {
            [] | [b"ply" | b"end_header"] | [b"comment" | b"obj_info", ..] => {}
            [b"format", name, _] => self.encoding = encoding(name)?,
            [b"element", name, count] => self.elements.push(Element {
                name: String::from_utf8_lossy(name).into_owned(),
                count: text::number(count).ok_or_else(|| {
                    let (count, name) = (text::quoted(count), text::quoted(name));
                    format!("{count} is not the number of elements {name}")
                })?,
                properties: Vec::new(),
            }),
            [b"property", kind @ .., name] => {
                let name = String::from_utf8_lossy(name).into_owned();
                let kind = property_kind(kind)?;
                let element = self.elements.last_mut();
                let element = element.ok_or("a property of no element")?;
                element.properties.push(Property { name, kind });
            }
            _ => {
                let line = words.join(&b' ');
                return Err(format!("{} is not understood", text::quoted(&line)));
            }
        }
        Ok(())
    }

    pub(super) fn is_binary(&self) -> bool {
        self.encoding != Encoding::Text
    }

    /// Refuses what cannot be a mesh, and counts that the file is too short for: an element takes a
    /// byte at least, so that nothing is read, or stored, for longer than there are bytes.
    fn check(&self, bytes: u64) -> Result<(), SurfaceError> {
        for element in &self.elements {
            let Element {
                name,
                count,
                properties,
            } = element;
            if *count > 0 && properties.is_empty() {
                return Err(in_header(format!("element {name} has no properties")));
            }
            if *count > MOST_VERTICES {
                return Err(in_header(format!(
                    "{count} of element {name} are announced, and {MOST_VERTICES} are the most"
                )));
            }
            if *count > bytes {
                return Err(in_header(format!(
                    "{count} of element {name} are announced, and the file has {bytes} bytes"
                )));
            }
            if name == "vertex" {
                let mut axes = AXES.iter().zip(element.axes());
                if let Some((axis, _)) = axes.find(|(_, found)| found.is_none()) {
                    return Err(in_header(format!("element vertex has no number {axis}")));
                }
            }
            if LISTS.contains(&name.as_str()) && element.corners().is_none() {
                let names = CORNERS.join(" or ");
                return Err(in_header(format!("element {name} has no list {names}")));
            }
            if name == "face" {
                check_faces(*count)?;
            }
        }
        let has = |name: &str| self.elements.iter().any(|element| element.name == name);
        if !has("vertex") {
            return Err(in_header("there is no element vertex".to_owned()));
        }
        if !LISTS.iter().any(|name| has(name)) {
            let names = LISTS.join(" or ");
            return Err(in_header(format!("there is no element {names}")));
        }
        Ok(())
    }
}

impl Element {
    /// Which of the properties are x, y and z.
    pub(super) fn axes(&self) -> [Option<usize>; 3] {
        AXES.map(|axis| {
            let is_axis =
                |p: &Property| p.name == axis && matches!(p.kind, PropertyKind::Number(_));
            self.properties.iter().position(is_axis)
        })
    }

    /// Which of the properties is the list of corners.
    pub(super) fn corners(&self) -> Option<usize> {
        let is_list = |p: &Property| {
            CORNERS.contains(&p.name.as_str()) && matches!(p.kind, PropertyKind::List(..))
        };
        self.properties.iter().position(is_list)
    }
}

/// The byte that every line of the header ends with: the body of a binary file may begin with any.
fn last_of_line_ending(bytes: &[u8]) -> u8 {
    let mut ending = bytes.iter().skip_while(|b| !matches!(b, b'\n' | b'\r'));
    match (ending.next(), ending.next()) {
        (Some(b'\r'), next) if next != Some(&b'\n') => b'\r',
        _ => b'\n',
    }
}

fn encoding(name: &[u8]) -> Result<Encoding, String> {
    match name {
        b"ascii" => Ok(Encoding::Text),
        b"binary_little_endian" => Ok(Encoding::LittleEndian),
        b"binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(format!(
            "{} is no format: there are ascii, binary_little_endian and binary_big_endian",
            text::quoted(name)
        )),
    }
}

fn property_kind(words: &[&[u8]]) -> Result<PropertyKind, String> {
    match words {
        [b"list", length, item] => Ok(PropertyKind::List(scalar(length)?, scalar(item)?)),
        [kind] => scalar(kind).map(PropertyKind::Number),
        _ => Err("a property needs a type and a name".to_owned()),
    }
}

fn scalar(word: &[u8]) -> Result<Scalar, String> {
    Ok(match word {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => return Err(format!("{} is no type of number", text::quoted(word))),
    })
}

fn in_header(reason: String) -> SurfaceError {
    malformed("in the header".to_owned(), reason)
}
