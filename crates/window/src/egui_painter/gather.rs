//! Converts egui's meshes in points to the painter's in pixels: only triangles that touch a
//! rectangle.

use egui::epaint::{ClippedPrimitive, Mesh, Primitive, Vertex};
use trigon_raster::paint2d::{self, Image, Rect};

use super::ChannelOrder;
use super::extent::columns;

/// Triangles of one mesh; its memory is reused.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    vertices: Vec<paint2d::Vertex>,
    /// 0, 1, 2 and so on, up to the largest number of vertices so far.
    indices: Vec<u32>,
}

impl Gathered {
    /// Takes the triangles that touch `rect`; `boxes` are those of the mesh. Vertices without a valid position are
    /// left out.
    pub(super) fn gather(
        &mut self,
        mesh: &Mesh,
        boxes: &Boxes,
        rect: Rect,
        pixels_per_point: f32,
        order: ChannelOrder,
    ) {
        self.vertices.clear();
        let near = Near::new(rect, pixels_per_point);
        for (run, _) in runs(mesh).zip(&boxes.0).filter(|(_, around)| near.touches(around)) {
            for corners in run.iter().filter_map(|indices| corners(mesh, indices)) {
                if near.touches(&around(corners)) && near.meets(corners) {
                    self.vertices.extend(corners.map(|vertex| in_pixels(vertex, pixels_per_point, order)));
                }
            }
        }
        let known = self.indices.len();
        self.indices.extend((known..self.vertices.len()).map(|index| index as u32));
    }

    /// The result as a mesh.
    pub(super) fn mesh<'a>(&'a self, scissor: Rect, image: &'a Image) -> paint2d::Mesh<'a> {
        let indices = &self.indices[..self.vertices.len()];
        paint2d::Mesh { scissor, vertices: &self.vertices, indices, image: Some(image) }
    }
}

/// A rectangle in points, slightly larger than requested.
struct Near {
    min: [f32; 2],
    max: [f32; 2],
}

impl Near {
    fn new(rect: Rect, pixels_per_point: f32) -> Self {
        // A pixel is more than all rounding of positions: to f32, and to 1/256 pixel.
        let point = |pixel: i32, by: i32| (pixel + by) as f32 / pixels_per_point;
        Self { min: rect.min.map(|pixel| point(pixel, -1)), max: rect.max.map(|pixel| point(pixel, 1)) }
    }

    fn touches(&self, around: &egui::Rect) -> bool {
        let touches = |min: f32, max: f32, axis: usize| min <= self.max[axis] && max >= self.min[axis];
        touches(around.min.x, around.max.x, 0) && touches(around.min.y, around.max.y, 1)
    }

    /// Whether a triangle whose box touches it does so itself. If a corner has no number for a position, the answer
    /// does not matter: it is not painted.
    fn meets(&self, corners: [&Vertex; 3]) -> bool {
        let corners = corners.map(|corner| [f64::from(corner.pos.x), f64::from(corner.pos.y)]);
        let [left, right] = columns(&corners, [f64::from(self.min[1]), f64::from(self.max[1])]);
        left <= f64::from(self.max[0]) && right >= f64::from(self.min[0])
    }
}

/// Triangles in a run: about two segments of a line, or eight letters.
const RUN: usize = 16;

/// Boxes around runs of consecutive triangles of a mesh, in points. Most of an interface is far from most of what is
/// repainted, and consecutive triangles are near to each other.
#[derive(Debug, Default)]
pub(super) struct Boxes(Vec<egui::Rect>);

impl Boxes {
    pub(super) fn of(primitive: &ClippedPrimitive) -> Self {
        let Primitive::Mesh(mesh) = &primitive.primitive else { return Self::default() };
        let around_run = |run: &[[u32; 3]]| {
            let triangles = run.iter().filter_map(|indices| corners(mesh, indices));
            triangles.fold(egui::Rect::NOTHING, |all, triangle| all | around(triangle))
        };
        Self(runs(mesh).map(around_run).collect())
    }
}

fn runs(mesh: &Mesh) -> impl Iterator<Item = &[[u32; 3]]> {
    mesh.indices.as_chunks::<3>().0.chunks(RUN)
}

/// The corners of a triangle; `None` if it has an index that no vertex has.
fn corners<'a>(mesh: &'a Mesh, indices: &[u32; 3]) -> Option<[&'a Vertex; 3]> {
    let [a, b, c] = indices.map(|index| mesh.vertices.get(index as usize));
    Some([a?, b?, c?])
}

/// The box around a triangle, but for coordinates that are no numbers.
pub(super) fn around(corners: [&Vertex; 3]) -> egui::Rect {
    let [a, b, c] = corners.map(|corner| corner.pos);
    egui::Rect { min: a.min(b).min(c), max: a.max(b).max(c) }
}

fn in_pixels(vertex: &Vertex, pixels_per_point: f32, order: ChannelOrder) -> paint2d::Vertex {
    paint2d::Vertex {
        position: [vertex.pos.x * pixels_per_point, vertex.pos.y * pixels_per_point],
        uv: [vertex.uv.x, vertex.uv.y],
        color: order.arrange(vertex.color.to_array()),
    }
}

/// A clip rectangle of egui: its sides are rounded to whole pixels. NaN counts as 0.
pub(super) fn to_pixels(clip: egui::Rect, pixels_per_point: f32) -> Rect {
    let pixel = |point: f32| (point * pixels_per_point).round() as i32;
    Rect::new([pixel(clip.min.x), pixel(clip.min.y)], [pixel(clip.max.x), pixel(clip.max.y)])
}
