//! PLY, binary and text: vertices, faces and triangle strips.
//!
//! Read here rather than by a crate, so that strips, blank lines and numbers of every form are read, and
//! two properties of one name do not make one.

mod header;
mod payload;

use super::{Joiner, MeshFormat, check_corners};
use crate::SurfaceError;
use header::{Element, Header};
use payload::Payload;

pub(super) use header::is_ply;

/// Reads the faces; returns whether the file is binary.
pub(super) fn parse(
    bytes: &[u8],
    joiner: &mut Joiner,
    notes: &mut Vec<String>,
) -> Result<bool, SurfaceError> {
    let header = Header::parse(bytes)?;
    let mut payload = Payload::new(&header);
    let (mut positions, mut faces, mut strips) = (Vec::new(), Lists::default(), Lists::default());
    for element in &header.elements {
        for number in 0..element.count {
            payload.begin(element, number)?;
            match element.name.as_str() {
                "vertex" => positions.push(vertex(element, &mut payload)?),
                "face" => list(element, &mut payload, &mut faces)?,
                "tristrips" => list(element, &mut payload, &mut strips)?,
                _ => element
                    .properties
                    .iter()
                    .try_for_each(|property| payload.property(property.kind, |_| {}))?,
            }
        }
    }
    let mut corners = Vec::new();
    for (number, face) in faces.iter().enumerate() {
        check_corners(face.len())?;
        corners.clear();
        for &index in face {
            corners.push(place(index, &positions, "face", number)?);
        }
        joiner.add_polygon(&corners)?;
    }
    for (number, strip) in strips.iter().enumerate() {
        // A negative number ends a strip and begins another.
        for strip in strip.split(|index| *index == -1.0) {
            for (i, triple) in strip.array_windows().enumerate() {
                // Every second triangle turns the other way round.
                let [a, b, c] = *triple;
                let turned = if i % 2 == 0 { [a, b, c] } else { [b, a, c] };
                // Repeated numbers only lead the strip on.
                if a == b || b == c || c == a {
                    continue;
                }
                let [a, b, c] = turned.map(|index| place(index, &positions, "tristrips", number));
                joiner.add([a?, b?, c?])?;
            }
        }
    }
    notes.extend(payload.notes());
    Ok(header.is_binary())
}

/// Lists of indices, one after another. They are kept as they are in the file until it is known
/// how many vertices there are.
#[derive(Debug, Default)]
struct Lists {
    items: Vec<f64>,
    ends: Vec<usize>,
}

impl Lists {
    fn iter(&self) -> impl Iterator<Item = &[f64]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let list = &self.items[start..end];
            start = end;
            list
        })
    }
}

fn vertex(element: &Element, payload: &mut Payload<'_>) -> Result<[f64; 3], SurfaceError> {
    let axes = element.axes();
    let mut place = [0.0; 3];
    for (i, property) in element.properties.iter().enumerate() {
        let mut last = 0.0;
        payload.property(property.kind, |number| last = number)?;
        if let Some(axis) = axes.iter().position(|axis| *axis == Some(i)) {
            place[axis] = last;
        }
    }
    Ok(place)
}

/// Reads an element of which one property is a list of corners.
fn list(
    element: &Element,
    payload: &mut Payload<'_>,
    lists: &mut Lists,
) -> Result<(), SurfaceError> {
    let corners = element.corners();
    for (i, property) in element.properties.iter().enumerate() {
        if Some(i) == corners {
            payload.property(property.kind, |index| lists.items.push(index))?;
        } else {
            payload.property(property.kind, |_| {})?;
        }
    }
    lists.ends.push(lists.items.len());
    Ok(())
}

fn place(
    index: f64,
    positions: &[[f64; 3]],
    element: &str,
    number: usize,
) -> Result<[f64; 3], SurfaceError> {
    let count = positions.len();
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a whole number below the length of a list"
    )]
    let vertex = (index.fract() == 0.0 && (0.0..count as f64).contains(&index))
        .then(|| positions[index as usize]);
    vertex.ok_or_else(|| {
        malformed(
            format!("{element} {number}"),
            format!("it names vertex {index}, and there are {count}, numbered from 0"),
        )
    })
}

fn malformed(place: String, reason: String) -> SurfaceError {
    SurfaceError::Malformed {
        format: MeshFormat::Ply,
        place,
        reason,
    }
}
