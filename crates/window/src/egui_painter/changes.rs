//! The difference between two passes: the triangles that were added, removed, or changed. A pixel
//! that none of them touches is painted by the same triangles in the same order as before, and so
//! keeps its colour.

use egui::epaint::{ClippedPrimitive, Mesh, Primitive, Vertex};
use trigon_raster::paint2d::Rect;

use super::damage::Damage;
use super::gather::to_pixels;
use super::textures::Textures;
use super::unchanged::unchanged;

/// Marks what differs between two lists of primitives.
pub(super) fn mark(
    damage: &mut Damage,
    pixels_per_point: f32,
    [before, after]: [&[ClippedPrimitive]; 2],
    textures: &Textures,
) {
    let first = common(before.iter().zip(after), are_alike);
    let [rest_before, rest_after] = [&before[first..], &after[first..]];
    let last = common(rest_before.iter().rev().zip(rest_after.iter().rev()), are_alike);
    let mut marker = Marker { damage, pixels_per_point, clip: Rect::default() };
    for primitive in [rest_before, rest_after].iter().flat_map(|rest| &rest[..rest.len() - last]) {
        marker.all(primitive);
    }
    let ends = [before, after].map(|list| list[..first].iter().chain(&list[list.len() - last..]));
    let [before, after] = ends;
    for (before, after) in before.zip(after) {
        marker.differences([before, after], textures);
    }
}

/// The length of the common prefix of pairs that are alike.
fn common<T>(mut pairs: impl Iterator<Item = (T, T)>, alike: impl Fn(T, T) -> bool) -> usize {
    let mut count = 0;
    while let Some((a, b)) = pairs.next()
        && alike(a, b)
    {
        count += 1;
    }
    count
}

/// Whether two primitives may differ by some triangles only.
fn are_alike(before: &ClippedPrimitive, after: &ClippedPrimitive) -> bool {
    let same_texture = match (&before.primitive, &after.primitive) {
        (Primitive::Mesh(before), Primitive::Mesh(after)) => before.texture_id == after.texture_id,
        (Primitive::Callback(_), Primitive::Callback(_)) => true,
        _ => false,
    };
    same_texture && before.clip_rect == after.clip_rect
}

/// Marks triangles of one primitive.
struct Marker<'a> {
    damage: &'a mut Damage,
    pixels_per_point: f32,
    clip: Rect,
}

impl Marker<'_> {
    /// All of a primitive.
    fn all(&mut self, primitive: &ClippedPrimitive) {
        self.clip = to_pixels(primitive.clip_rect, self.pixels_per_point);
        if let Primitive::Mesh(mesh) = &primitive.primitive {
            triangles(mesh).for_each(|triangle| self.triangle(&triangle));
        }
    }

    /// Marks the differences between two primitives that are alike.
    fn differences(&mut self, pair: [&ClippedPrimitive; 2], textures: &Textures) {
        let [Primitive::Mesh(before), Primitive::Mesh(after)] = pair.map(|one| &one.primitive) else {
            return;
        };
        self.clip = to_pixels(pair[1].clip_rect, self.pixels_per_point);
        if before != after {
            self.rearranged([before, after]);
        }
        let changed = textures.changed(after.texture_id);
        if changed.is_positive() {
            let shows_it =
                |triangle: &Triangle<'_>| around(triangle.map(|vertex| vertex.uv)).intersects(changed);
            triangles(after).filter(shows_it).for_each(|triangle| self.triangle(&triangle));
        }
    }

    /// Marks the triangles of two meshes that are not in both, or not in the same order. Between the common beginning
    /// and the common end, others may remain: where lines come and go, most of them do.
    fn rearranged(&mut self, meshes: [&Mesh; 2]) {
        let [before, after] = meshes.map(triangles);
        let first = common(before.zip(after), |a, b| a == b);
        let [before, after] = meshes.map(|mesh| triangles(mesh).skip(first).rev());
        let last = common(before.zip(after), |a, b| a == b);
        let between = meshes.map(|mesh| {
            let count = triangles(mesh).len() - last;
            triangles(mesh).take(count).skip(first).collect::<Vec<_>>()
        });
        let unchanged = unchanged(between.each_ref().map(Vec::as_slice), key);
        for (triangle, is_unchanged) in between.iter().flatten().zip(unchanged.iter().flatten()) {
            if !is_unchanged {
                self.triangle(triangle);
            }
        }
    }

    fn triangle(&mut self, triangle: &Triangle<'_>) {
        let corner =
            |vertex: &Vertex| [vertex.pos.x, vertex.pos.y].map(|point| point * self.pixels_per_point);
        self.damage.mark_triangle(triangle.map(corner), self.clip);
    }
}

type Triangle<'a> = [&'a Vertex; 3];

/// The positions and colours of a triangle's corners. Triangles that differ in their texture coordinates only
/// have the same key; those of one mesh hardly ever do.
fn key(corners: &Triangle<'_>) -> [[u32; 3]; 3] {
    corners.map(|Vertex { pos, color, .. }| {
        [pos.x.to_bits(), pos.y.to_bits(), u32::from_ne_bytes(color.to_array())]
    })
}

/// The triangles of a mesh. A triangle with an index that no vertex has is not painted.
fn triangles(mesh: &Mesh) -> impl DoubleEndedIterator<Item = Triangle<'_>> + ExactSizeIterator {
    static NOWHERE: Vertex =
        Vertex { pos: egui::Pos2::ZERO, uv: egui::Pos2::ZERO, color: egui::Color32::TRANSPARENT };
    let vertex = move |index: u32| mesh.vertices.get(index as usize).unwrap_or(&NOWHERE);
    mesh.indices.as_chunks::<3>().0.iter().map(move |indices| indices.map(vertex))
}

/// The box around three positions.
fn around(corners: [egui::Pos2; 3]) -> egui::Rect {
    egui::Rect::from_points(&corners)
}
