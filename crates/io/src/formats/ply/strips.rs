//! Triangle strips in one list, separated by −1, as in the Stanford scans.

use super::faces::{INDICES, checked};
use super::header::{Element, Kind};
use super::outcome::{Outcome, report, skip, stopped};
use super::values::{Fault, Values};
use crate::import::Import;
use crate::polygons::{Polygons, most_corners};

pub(super) fn read_strips<V: Values>(
    import: &mut Import<'_>,
    element: &Element,
    values: &mut V,
    vertices: u32,
    polygons: &mut Polygons,
) -> Outcome {
    let list = element.position(INDICES);
    let Some(list) = list.filter(|&index| matches!(element.properties[index].kind, Kind::List { .. })) else {
        return skip(import, element, values);
    };
    let most = most_corners(import);
    for row in 0..element.count {
        report(import, row, values)?;
        if let Err(fault) = read_row(element, list, values, vertices, polygons, most) {
            return stopped(import, element, row, values, fault);
        }
    }
    Ok(Ok(()))
}

fn read_row<V: Values>(
    element: &Element,
    list: usize,
    values: &mut V,
    vertices: u32,
    polygons: &mut Polygons,
    most: usize,
) -> Result<(), Fault> {
    values.begin_row()?;
    for (index, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::List { count, item } if index == list => {
                let mut strip = Strip::default();
                for _ in 0..values.count(count)? {
                    let next = values.value(item)?;
                    if next == -1.0 {
                        strip = Strip::default();
                    } else if let Some(triangle) = strip.triangle(checked(next, vertices)?) {
                        polygons.face_sizes.push(3);
                        polygons.corner_vertices.extend(triangle);
                    }
                    if polygons.corner_vertices.len() > most {
                        return Err(Fault::TooMany);
                    }
                }
            }
            kind => values.skip(kind)?,
        }
    }
    values.end_row();
    Ok(())
}

/// The last vertices of a strip. Every second triangle is turned round.
#[derive(Default)]
struct Strip {
    before: Option<u32>,
    last: Option<u32>,
    is_odd: bool,
}

impl Strip {
    /// The triangle that ends in a vertex, if there is one with three different vertices: repeated
    /// ones join strips.
    fn triangle(&mut self, vertex: u32) -> Option<[u32; 3]> {
        let (before, last) = (self.before, self.last);
        (self.before, self.last) = (last, Some(vertex));
        let (a, b) = (before?, last?);
        self.is_odd = !self.is_odd;
        if a == b || b == vertex || vertex == a {
            return None;
        }
        Some(if self.is_odd { [a, b, vertex] } else { [b, a, vertex] })
    }
}
