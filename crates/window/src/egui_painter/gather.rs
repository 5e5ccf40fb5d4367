//! Converts egui's meshes in points to the painter's in pixels: only triangles that touch a
//! rectangle.

use egui::epaint::{Mesh, Vertex};
use trigon_raster::paint2d::{self, Image, Rect};

use super::ChannelOrder;

/// Triangles of one mesh; its memory is reused.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    vertices: Vec<paint2d::Vertex>,
    /// 0, 1, 2 and so on, up to the largest number of vertices so far.
    indices: Vec<u32>,
}

impl Gathered {
    /// Takes the triangles that touch `rect`. Vertices without a valid position are left out.
    pub(super) fn gather(&mut self, mesh: &Mesh, rect: Rect, pixels_per_point: f32, order: ChannelOrder) {
        self.vertices.clear();
        let near = Near::new(rect, pixels_per_point);
        for indices in mesh.indices.as_chunks::<3>().0 {
            let [Some(a), Some(b), Some(c)] = indices.map(|index| mesh.vertices.get(index as usize)) else {
                continue;
            };
            if near.has([a, b, c]) {
                self.vertices.extend([a, b, c].map(|vertex| in_pixels(vertex, pixels_per_point, order)));
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

    /// Whether the box around a triangle touches it.
    fn has(&self, [a, b, c]: [&Vertex; 3]) -> bool {
        let touches = |a: f32, b: f32, c: f32, axis: usize| {
            a.min(b).min(c) <= self.max[axis] && a.max(b).max(c) >= self.min[axis]
        };
        touches(a.pos.x, b.pos.x, c.pos.x, 0) && touches(a.pos.y, b.pos.y, c.pos.y, 1)
    }
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
