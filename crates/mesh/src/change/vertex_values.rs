//! The values of the corners at a vertex, and which of these corners can still be one render vertex.

use trigon_math::Vec3;

use super::normals::VertexNormals;
use super::render_links::UpdatedVertex;
use crate::groups::Groups;
use crate::weld::{AttributeComparison, bits};

/// What is known of a mesh to find out what its corners show.
pub(super) struct VertexValues<'a> {
    /// The render vertex of each corner.
    pub(super) vertex_of_corner: &'a [u32],
    pub(super) corners_at: &'a Groups<u32>,
    /// `None` if render vertices have no normals.
    pub(super) normals: Option<VertexNormals<'a>>,
    pub(super) attributes: AttributeComparison<'a>,
    /// The vertices that were moved, increasing.
    pub(super) moved: &'a [u32],
    /// Whether corners that were one render vertex can differ in nothing but normals.
    pub(super) has_same_attributes: bool,
}

/// What the corners at some vertices show.
#[derive(Default)]
pub(super) struct ShownVertices {
    /// By render vertices that there are.
    pub(super) kept: Vec<UpdatedVertex>,
    /// By new ones.
    pub(super) split: Vec<SplitOff>,
}

/// Corners that no longer agree with others of their render vertex.
pub(super) struct SplitOff {
    pub(super) corners: Vec<u32>,
    /// What they show; the vertex is still the one that they had.
    pub(super) shown: UpdatedVertex,
}

/// A corner, its normal, its render vertex so far, and the corner whose values that one is
/// to show.
#[derive(Clone, Copy)]
struct CornerValue {
    corner: u32,
    normal: Vec3,
    before: u32,
    shown_corner: u32,
    shown_normal: Vec3,
}

impl VertexValues<'_> {
    /// What is shown at some vertices.
    pub(super) fn at(&self, vertices: &[u32]) -> ShownVertices {
        let mut shown = ShownVertices { kept: Vec::with_capacity(vertices.len()), split: Vec::new() };
        let (mut normals, mut values) = (Vec::new(), Vec::new());
        for &vertex in vertices {
            let corners = self.corners_at.get(vertex);
            match &self.normals {
                Some(of_corners) => of_corners.at_corners(corners, &mut normals),
                None => {
                    normals.clear();
                    normals.resize(corners.len(), Vec3::ZERO);
                }
            }
            if let Some(updated) = self.whole(corners, &normals) {
                let is_normal_alone = self.moved.binary_search(&vertex).is_err();
                shown.kept.push(UpdatedVertex { is_normal_alone, ..updated });
                continue;
            }
            values.clear();
            values.extend(corners.iter().zip(&normals).map(|(&corner, &normal)| CornerValue {
                corner,
                normal,
                before: self.vertex_of_corner[corner as usize],
                shown_corner: corner,
                shown_normal: normal,
            }));
            self.parts(&mut values, &mut shown);
        }
        shown
    }

    /// The render vertex of all corners at a vertex, if they had the same one, can differ in nothing but normals, and
    /// agree in these. Most vertices of most meshes are such.
    fn whole(&self, corners: &[u32], normals: &[Vec3]) -> Option<UpdatedVertex> {
        let (&corner, &normal) = (corners.first()?, normals.first()?);
        let vertex = self.vertex_of_corner[corner as usize];
        let agrees = |(&other, &other_normal): (&u32, &Vec3)| {
            self.vertex_of_corner[other as usize] == vertex
                && normal_bits(other_normal) == normal_bits(normal)
        };
        let is_whole = self.has_same_attributes && corners.iter().zip(normals).all(agrees);
        is_whole.then_some(UpdatedVertex { vertex, corner, normal, is_normal_alone: false })
    }

    /// The render vertices of the corners at one vertex: one for all that agreed before and
    /// agree now.
    fn parts(&self, values: &mut [CornerValue], found: &mut ShownVertices) {
        values.sort_unstable_by(|a, b| {
            let order = normal_bits(a.normal).cmp(&normal_bits(b.normal));
            order.then_with(|| self.attributes.order(a.corner, b.corner)).then(a.corner.cmp(&b.corner))
        });
        // All that agree now show the values of the first of them, as when they are welded.
        // (They differ in nothing but the signs of zeros.)
        let agree = |a: &CornerValue, b: &CornerValue| {
            normal_bits(a.normal) == normal_bits(b.normal) && self.attributes.equal(a.corner, b.corner)
        };
        for alike in values.chunk_by_mut(agree) {
            let CornerValue { corner, normal, .. } = alike[0];
            alike.iter_mut().for_each(|value| (value.shown_corner, value.shown_normal) = (corner, normal));
        }
        values.sort_unstable_by_key(|value| (value.before, value.shown_corner, value.corner));
        let mut last = None;
        let are_one =
            |a: &CornerValue, b: &CornerValue| (a.before, a.shown_corner) == (b.before, b.shown_corner);
        for alike in values.chunk_by(are_one) {
            let CornerValue { before, shown_corner, shown_normal, .. } = alike[0];
            // They may show the values of another corner than before.
            let shown = UpdatedVertex {
                vertex: before,
                corner: shown_corner,
                normal: shown_normal,
                is_normal_alone: false,
            };
            // The first of those that agreed before keep their vertex.
            if last.replace(before) == Some(before) {
                let corners = alike.iter().map(|value| value.corner).collect();
                found.split.push(SplitOff { corners, shown });
            } else {
                found.kept.push(shown);
            }
        }
    }
}

/// What tells normals apart.
fn normal_bits(normal: Vec3) -> [u32; 3] {
    bits(normal.to_array())
}
