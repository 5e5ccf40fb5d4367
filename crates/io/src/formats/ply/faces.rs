//! The faces and edges of a PLY. Triangle strips lie in one list, separated by −1, as in the Stanford scans.

use trigon_math::Vec2;

use super::header::{Element, Kind, Scalar};
use super::values::{Fault, Values};
use super::values::{Outcome, report, skip, stopped};
use super::vertices::Channels;
use crate::import::Import;
use crate::polygons::{Polygons, most_corners};

/// The names of the list of a face's vertices.
pub(super) const INDICES: &[&str] = &["vertex_indices", "vertex_index"];

/// The properties of faces that mean something.
struct Roles {
    indices: Option<usize>,
    /// A list of u and v for each corner.
    uvs: Option<usize>,
    /// Red, green, blue and alpha.
    color: [Option<usize>; 4],
    /// The values of opaque white.
    full: [f64; 4],
    /// The number of its image.
    texture: Option<usize>,
}

impl Roles {
    fn new(element: &Element) -> Self {
        let is_list = |&index: &usize| matches!(element.properties[index].kind, Kind::List { .. });
        let color = [["red", "r"], ["green", "g"], ["blue", "b"], ["alpha", "a"]];
        let color = color.map(|names| element.position(&names).filter(|index| !is_list(index)));
        Self {
            indices: element.position(INDICES).filter(is_list),
            uvs: element.position(&["texcoord"]).filter(is_list),
            texture: element.position(&["texnumber"]).filter(|index| !is_list(index)),
            full: Channels::new(element, color).full(),
            color,
        }
    }

    /// Whether faces may differ in their images.
    fn has_textures(&self) -> bool {
        self.texture.is_some() || self.uvs.is_some()
    }

    fn has_color(&self) -> bool {
        self.color[..3].iter().all(Option::is_some)
    }
}

/// One face.
#[derive(Default)]
struct Face {
    vertices: Vec<u32>,
    /// As they are in the file.
    uvs: Vec<f64>,
    channels: [f64; 4],
    texture: f64,
}

/// Where the values of faces go.
struct FaceSink<'p> {
    polygons: &'p mut Polygons,
    colors: Channels,
}

impl Face {
    fn read<V: Values>(
        &mut self,
        element: &Element,
        roles: &Roles,
        vertices: u32,
        values: &mut V,
        most_corners: usize,
    ) -> Result<(), Fault> {
        values.begin_row()?;
        self.vertices.clear();
        self.uvs.clear();
        self.channels = roles.full;
        self.texture = 0.0;
        for (index, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::List { count, item } if roles.indices == Some(index) => {
                    let count = values.count(count)?;
                    if count as usize > most_corners {
                        return Err(Fault::TooMany);
                    }
                    for _ in 0..count {
                        self.vertices.push(vertex(values, item, vertices)?);
                    }
                }
                Kind::List { count, item } if roles.uvs == Some(index) => {
                    let count = values.count(count)?;
                    for _ in 0..count {
                        self.uvs.push(values.value(item)?);
                    }
                }
                Kind::Scalar(scalar) => match roles.color.iter().position(|role| *role == Some(index)) {
                    Some(channel) => self.channels[channel] = values.value(scalar)?,
                    None if roles.texture == Some(index) => self.texture = values.value(scalar)?,
                    None => values.pass(scalar, 1)?,
                },
                kind @ Kind::List { .. } => values.skip(kind)?,
            }
        }
        values.end_row();
        Ok(())
    }

    fn push(&self, roles: &Roles, FaceSink { polygons, colors }: &mut FaceSink<'_>) {
        polygons.face_sizes.push(self.vertices.len() as u32);
        polygons.corner_vertices.extend_from_slice(&self.vertices);
        if roles.has_color() {
            colors.push(self.channels, &mut polygons.face_colors);
        }
        if roles.uvs.is_some() {
            let uv = |corner: usize| match self.uvs.get(2 * corner..2 * corner + 2) {
                Some(&[u, v]) => Vec2::new(u as f32, (1.0 - v) as f32),
                _ => Vec2::ZERO,
            };
            let uvs = (0..self.vertices.len()).map(uv);
            polygons.corner_uvs.extend(uvs.map(|uv| if uv.is_finite() { uv } else { Vec2::ZERO }));
        }
        if roles.has_textures() && !polygons.textures.names.is_empty() {
            polygons.textures.of_faces.push(self.texture_number(roles));
        }
    }

    /// The number of its image; that of none if it has no coordinates there.
    fn texture_number(&self, roles: &Roles) -> u32 {
        let is_placed = roles.uvs.is_none() || self.uvs.len() >= 2 * self.vertices.len();
        let is_number = self.texture >= 0.0 && self.texture < f64::from(u32::MAX);
        if is_placed && is_number { self.texture as u32 } else { u32::MAX }
    }
}

/// The number of a vertex, of which there are so many.
fn vertex<V: Values>(values: &mut V, scalar: Scalar, vertices: u32) -> Result<u32, Fault> {
    let index = values.value(scalar)?;
    checked(index, vertices)
}

/// A number as that of a vertex, of which there are so many.
pub(super) fn checked(index: f64, vertices: u32) -> Result<u32, Fault> {
    if index >= 0.0 && index < f64::from(vertices) && index.fract() == 0.0 {
        return Ok(index as u32);
    }
    Err(Fault::Bad(format!("names vertex {index}, and the vertices are 0 to {}", i64::from(vertices) - 1)))
}

pub(super) fn read_faces<V: Values>(
    import: &mut Import<'_>,
    element: &Element,
    values: &mut V,
    vertices: u32,
    polygons: &mut Polygons,
) -> Outcome {
    let roles = Roles::new(element);
    if roles.indices.is_none() {
        return skip(import, element, values);
    }
    let bytes = values.progress().1 as u64;
    polygons.face_sizes.reserve(element.count.min(bytes) as usize);
    if let Some(Kind::List { item, .. }) = roles.indices.map(|index| element.properties[index].kind) {
        // Of triangles, or as many as there may be.
        let most = bytes / values.least_bytes(item);
        polygons.corner_vertices.reserve(element.count.saturating_mul(3).min(most) as usize);
    }
    let mut face = Face::default();
    let mut sink = FaceSink { polygons, colors: Channels::new(element, roles.color) };
    let mut outcome = Ok(());
    for row in 0..element.count {
        report(import, row, values)?;
        let most = most_corners(import).saturating_sub(sink.polygons.corner_vertices.len());
        match face.read(element, &roles, vertices, values, most) {
            Ok(()) => face.push(&roles, &mut sink),
            Err(fault) => {
                outcome = stopped(import, element, row, values, fault)?;
                break;
            }
        }
    }
    sink.colors.finish(&mut sink.polygons.face_colors, &mut import.warnings);
    Ok(outcome)
}

pub(super) fn read_edges<V: Values>(
    import: &mut Import<'_>,
    element: &Element,
    values: &mut V,
    vertices: u32,
    polygons: &mut Polygons,
) -> Outcome {
    let ends = [element.position(&["vertex1"]), element.position(&["vertex2"])];
    if ends.contains(&None) {
        return skip(import, element, values);
    }
    for row in 0..element.count {
        report(import, row, values)?;
        let most = most_corners(import).saturating_sub(2 * polygons.edges.len());
        match read_edge(element, ends, values, vertices) {
            Ok(_) if most < 2 => return stopped(import, element, row, values, Fault::TooMany),
            Ok(edge) => polygons.edges.push(edge),
            Err(fault) => return stopped(import, element, row, values, fault),
        }
    }
    Ok(Ok(()))
}

fn read_edge<V: Values>(
    element: &Element,
    ends: [Option<usize>; 2],
    values: &mut V,
    vertices: u32,
) -> Result<[u32; 2], Fault> {
    let mut edge = [0; 2];
    values.begin_row()?;
    for (index, property) in element.properties.iter().enumerate() {
        match (property.kind, ends.iter().position(|end| *end == Some(index))) {
            (Kind::Scalar(scalar), Some(end)) => edge[end] = vertex(values, scalar, vertices)?,
            (kind, _) => values.skip(kind)?,
        }
    }
    values.end_row();
    Ok(edge)
}

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
