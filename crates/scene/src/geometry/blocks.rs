//! Bounding boxes of 64 consecutive triangles each, and of eight within them. Consecutive triangles are mostly
//! neighbours, so a query about a small part of space skips most of them 64 at a time, and then eight at a time.

use std::ops::Range;

use rayon::prelude::*;
use trigon_mesh::Mesh;

use super::Geometry;

/// Triangles per box.
const BLOCK: usize = 64;

/// Triangles in a part of a box. A part gets its own box when the whole one is near; it is far smaller where a row
/// of quads crosses waves.
const PART: usize = 8;

/// Boxes per task.
const SHARE: usize = 64;

/// Boxes around all triangles of a mesh, in its own space.
#[derive(Clone, Debug)]
pub(crate) struct Blocks {
    boxes: Vec<BlockBox>,
    triangles: usize,
    /// Faces with corners that no triangle has, because they cross themselves or have no area. Increasing.
    pub(crate) scant_faces: Vec<u32>,
}

/// The least and the greatest coordinates, leaving out NaN; infinite without any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BlockBox {
    pub(crate) min: [f32; 3],
    pub(crate) max: [f32; 3],
}

impl Blocks {
    pub(super) fn new(source: &Mesh, geometry: &Geometry) -> Self {
        let (triangles, positions) = (&geometry.triangles, &geometry.columns.positions);
        let blocks = triangles.par_chunks(BLOCK).with_min_len(SHARE);
        Self {
            boxes: blocks.map(|block| BlockBox::around(block, positions)).collect(),
            triangles: triangles.len(),
            scant_faces: scant_faces(source, geometry),
        }
    }

    /// Triangles in boxes that pass a test, from the first one on, a few at a time.
    pub(crate) fn within(
        &self,
        geometry: &Geometry,
        may_hold: impl Fn(&BlockBox) -> bool + Copy,
    ) -> impl Iterator<Item = Range<usize>> {
        let parts = move |(start, block): (usize, &BlockBox)| {
            let end = if may_hold(block) { self.triangles.min(start + BLOCK) } else { start };
            (start..end).step_by(PART).map(move |start| start..end.min(start + PART))
        };
        let is_near = move |part: &Range<usize>| {
            let triangles = &geometry.triangles[part.clone()];
            may_hold(&BlockBox::around(triangles, &geometry.columns.positions))
        };
        let all = (0..self.triangles).step_by(BLOCK).zip(&self.boxes);
        all.flat_map(parts).filter(is_near)
    }
}

impl BlockBox {
    fn around(triangles: &[[u32; 3]], positions: &[Vec<f32>; 3]) -> Self {
        let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for &corner in triangles.as_flattened() {
            for axis in 0..3 {
                let value = positions[axis][corner as usize];
                min[axis] = if value < min[axis] { value } else { min[axis] };
                max[axis] = if value > max[axis] { value } else { max[axis] };
            }
        }
        Self { min, max }
    }
}

/// Faces with fewer triangles than their number of corners less two. With exactly that many, each triangle
/// cuts off one corner, and the last has three, so every corner has a triangle.
fn scant_faces(source: &Mesh, geometry: &Geometry) -> Vec<u32> {
    let mut counts = vec![0; source.face_count()];
    for (triangle, &[a, b, c]) in geometry.triangles.iter().enumerate() {
        counts[geometry.face(triangle) as usize] += usize::from(a != b || b != c);
    }
    let faces = (0..).zip(counts.iter().zip(source.faces()));
    faces.filter(|(_, (count, corners))| *count + 2 < corners.len()).map(|(face, _)| face).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_mesh::primitives;

    fn scant(mesh: &Mesh) -> Vec<u32> {
        scant_faces(mesh, &Geometry::new(mesh))
    }

    #[test]
    fn faces_whose_corners_all_have_triangles_are_not_scant() {
        for mesh in [primitives::cube(1.0), primitives::cone(1.0, 1.0, 9), primitives::icosphere(1.0, 1)] {
            assert!(scant(&mesh).is_empty(), "{:?}", scant(&mesh));
        }
    }

    #[test]
    fn boxes_hold_their_triangles() {
        let mesh = primitives::torus(1.0, 0.4, 40, 20);
        let geometry = Geometry::new(&mesh);
        let blocks = Blocks::new(&mesh, &geometry);
        let all: Vec<usize> = blocks.within(&geometry, |_| true).flatten().collect();
        assert!(all.iter().copied().eq(0..geometry.triangles.len()), "each once, in order");
        // Of those to the right all are found, and not many others.
        let is_right = |triangle: &usize| {
            let corners = geometry.triangles[*triangle];
            corners.iter().any(|&corner| geometry.columns.positions[0][corner as usize] > 1.2)
        };
        let found: Vec<usize> = blocks.within(&geometry, |part| part.max[0] > 1.2).flatten().collect();
        assert!((0..geometry.triangles.len()).filter(is_right).all(|triangle| found.contains(&triangle)));
        assert!(found.len() < all.len(), "{} of {}", found.len(), all.len());
        assert_eq!(blocks.within(&geometry, |_| false).count(), 0);
    }
}
