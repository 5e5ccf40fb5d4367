//! Many weighted sums of corners' values at once, all computed from the old values.

use smallvec::SmallVec;
use trigon_math::DVec3;

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::ids::CornerId;
use super::layers::{Blend, Layer, LayerKind, LayerValues, blended, heaviest, unit_or_zero};

/// Weighted sums of corners' values, and the corners that get them.
///
/// An operation collects them while it reads the old mesh and applies them after changing the
/// structure, so a corner can both contribute its old value and receive a new one.
#[derive(Debug, Default)]
pub(super) struct CornerBlends {
    parts: Vec<(u32, f64)>,
    /// The end of each sum's parts.
    ends: Vec<u32>,
    /// A corner, and the sum that becomes its value.
    targets: Vec<(u32, u32)>,
}

impl CornerBlends {
    /// With reserved memory for this many parts, sums and targets.
    pub(super) fn with_capacity(parts: usize, sums: usize, targets: usize) -> Self {
        Self {
            parts: Vec::with_capacity(parts),
            ends: Vec::with_capacity(sums),
            targets: Vec::with_capacity(targets),
        }
    }

    /// Adds a sum, whose weights add up to 1, and returns its number.
    pub(super) fn sum(&mut self, parts: impl IntoIterator<Item = (CornerId, f64)>) -> u32 {
        self.parts.extend(parts.into_iter().map(|(corner, weight)| (corner.0, weight)));
        self.ends.push(self.parts.len() as u32);
        self.ends.len() as u32 - 1
    }

    /// The parts of a sum.
    pub(super) fn parts(&self, sum: u32) -> impl Iterator<Item = (CornerId, f64)> + Clone + '_ {
        self.of(sum as usize).iter().map(|&(corner, weight)| (CornerId(corner), weight))
    }

    /// Gives a corner the value of a sum.
    pub(super) fn assign(&mut self, sum: u32, corner: CornerId) {
        self.targets.push((corner.0, sum));
    }

    fn of(&self, sum: usize) -> &[(u32, f64)] {
        let start = if sum == 0 { 0 } else { self.ends[sum - 1] };
        &self.parts[start as usize..self.ends[sum] as usize]
    }
}

impl EditMesh {
    /// Assigns the sums to their corners, in all layers.
    pub(super) fn blend_corners(&mut self, blends: &CornerBlends) {
        for layer in &mut self.corner_layers {
            layer.blend_corners(blends);
        }
    }

    /// Whether two corners have the same texture coordinates in all sets.
    pub(super) fn have_same_uvs(&self, a: CornerId, b: CornerId) -> bool {
        self.corner_layers.iter().all(|layer| match (&layer.values, layer.kind) {
            (LayerValues::Vec2(column), LayerKind::Uv) => column[a.0] == column[b.0],
            _ => true,
        })
    }

    /// The parts of the value at an offset from a corner, within its face: the component of the offset
    /// outside the plane of the corner's edges is ignored, and all of it if these define no plane.
    pub(super) fn parts_beside(&self, corner: CornerId, way: DVec3) -> [(CornerId, f64); 3] {
        let (next, previous) = (self.next_corner(corner), self.previous_corner(corner));
        let here = self.point(self.corner_vertex(corner));
        let [a, b] = [next, previous].map(|other| self.point(self.corner_vertex(other)) - here);
        let [alpha, beta] = in_plane(way, a, b).unwrap_or_default();
        [(corner, 1.0 - alpha - beta), (next, alpha), (previous, beta)]
    }
}

/// The least squares of `way = alpha a + beta b`; `None` if `a` and `b` define no plane.
pub(super) fn in_plane(way: DVec3, a: DVec3, b: DVec3) -> Option<[f64; 2]> {
    let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
    let determinant = aa * bb - ab * ab;
    let (wa, wb) = (way.dot(a), way.dot(b));
    let solution = [(wa * bb - wb * ab) / determinant, (wb * aa - wa * ab) / determinant];
    // Edges that almost coincide would send values far away.
    let is_plane = determinant > 1e-12 * aa * bb && solution.iter().all(|part| part.is_finite());
    is_plane.then_some(solution)
}

impl Layer {
    fn blend_corners(&mut self, blends: &CornerBlends) {
        match (&mut self.values, self.kind) {
            (LayerValues::Vec2(column), _) => write(column, blends, |value, _| value),
            (LayerValues::Vec3(column), LayerKind::Normal) => {
                write(column, blends, |normal, _| unit_or_zero(normal));
            }
            (LayerValues::Vec3(column), _) => write(column, blends, |value, _| value),
            (LayerValues::Vec4(column), LayerKind::Tangent) => {
                write(column, blends, |tangent, heaviest| {
                    unit_or_zero(tangent.truncate()).extend(heaviest.w)
                });
            }
            (LayerValues::Vec4(column), _) => write(column, blends, |value, _| value),
            (LayerValues::Influences(column), _) => write(column, blends, |value, _| value),
            (LayerValues::Pins(column), _) => write(column, blends, |value, _| value),
            (LayerValues::Weights(column), _) => write(column, blends, |value, _| value),
        }
    }
}

/// Reads all sums before it writes the first. `finish` gets a sum and the value of its heaviest
/// part.
fn write<T: Blend>(column: &mut Column<T>, blends: &CornerBlends, finish: impl Fn(T, T) -> T) {
    let mut values = SmallVec::<[T; 16]>::with_capacity(blends.ends.len());
    for sum in 0..blends.ends.len() {
        let parts = blends.of(sum);
        values.push(finish(blended(column, parts), column[heaviest(parts)]));
    }
    for &(corner, sum) in &blends.targets {
        *column.write(corner) = values[sum as usize];
    }
}
