//! The values of the corners at a vertex, and which of these corners can still be one render vertex.

use trigon_math::Vec3;

use super::fans::{FanPiece, FoundFans};
use super::local_normals::LocalNormals;
use super::neighborhood::Neighborhood;
use super::render_update::UpdatedVertex;
use crate::Mesh;
use crate::groups::Groups;
use crate::weld::{AttributeComparison, bits};

/// What is known of a mesh to find out what its corners show.
pub(super) struct VertexValues<'a> {
    vertex_of_corner: &'a [u32],
    corners_at: &'a Groups<u32>,
    /// `None` if render vertices have no normals.
    normals: Option<LocalNormals<'a>>,
    attributes: AttributeComparison<'a>,
    /// The vertices that were moved, increasing.
    moved: &'a [u32],
    /// Whether corners that were one render vertex can differ in nothing but normals.
    same_attributes: bool,
}

/// What the corners at some vertices show.
#[derive(Default)]
pub(super) struct Shown {
    /// By render vertices that there are.
    pub(super) kept: Vec<UpdatedVertex>,
    /// Those of `kept` that show other values than normals, as indices.
    pub(super) replaced: Vec<u32>,
    /// By new ones.
    pub(super) split: Vec<SplitOff>,
}

/// Corners that no longer agree with others of their render vertex.
pub(super) struct SplitOff {
    pub(super) corners: Vec<u32>,
    /// The one whose values they show, and its normal.
    pub(super) shown: (u32, Vec3),
}

/// A corner, its normal, its render vertex so far, and the corner whose values that one is
/// to show, with its normal.
struct CornerValue {
    corner: u32,
    normal: Vec3,
    before: u32,
    shown: (u32, Vec3),
}

impl<'a> VertexValues<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        vertex_of_corner: &'a [u32],
        corners_at: &'a Groups<u32>,
        normals: Option<LocalNormals<'a>>,
        around: &'a Neighborhood,
    ) -> Self {
        Self {
            vertex_of_corner,
            corners_at,
            normals,
            attributes: AttributeComparison::new(mesh),
            moved: &around.moved,
            same_attributes: around.corners.is_empty(),
        }
    }

    /// Tells fans from other vertices; they increase.
    pub(super) fn fans_of(&self, vertices: &[u32]) -> FoundFans {
        let mut found = FoundFans::default();
        found.shown.reserve(vertices.len());
        let mut moved = self.moved;
        for &vertex in vertices {
            let is_moved = is_next(&mut moved, vertex);
            if let Some(updated) = self.fan(self.corners_at.get(vertex), &mut found.fans) {
                found.replaced.extend(is_moved.then_some(found.shown.len() as u32));
                found.shown.push(updated);
            } else {
                found.others.push(vertex);
            }
        }
        found
    }

    /// What is shown at some vertices, fans or not; they increase.
    pub(super) fn at(&self, vertices: &[u32]) -> Shown {
        let mut shown = Shown { kept: Vec::with_capacity(vertices.len()), ..Shown::default() };
        let (mut around, mut normals, mut values) = (Vec::new(), Vec::new(), Vec::new());
        let mut moved = self.moved;
        for &vertex in vertices {
            let first = shown.kept.len() as u32;
            let is_moved = is_next(&mut moved, vertex);
            let corners = self.corners_at.get(vertex);
            match &self.normals {
                Some(of_corners) => of_corners.at_corners(corners, &mut around, &mut normals),
                None => {
                    normals.clear();
                    normals.resize(corners.len(), Vec3::ZERO);
                }
            }
            if let Some(updated) = self.whole(corners, &normals).filter(|_| self.same_attributes) {
                shown.kept.push(updated);
                shown.replaced.extend(is_moved.then_some(first));
                continue;
            }
            values.clear();
            values.extend(corners.iter().zip(&normals).map(|(&corner, &normal)| CornerValue {
                corner,
                normal,
                before: self.vertex_of_corner[corner as usize],
                shown: (corner, normal),
            }));
            self.parts(&mut values, &mut shown);
            // They may show the values of other corners than before.
            shown.replaced.extend(first..shown.kept.len() as u32);
        }
        shown
    }

    /// The render vertex of all corners at a vertex, if they had the same one, can differ in
    /// nothing but normals, and all take these from the vertex.
    fn fan(&self, corners: &[u32], fans: &mut FanPiece) -> Option<UpdatedVertex> {
        let (vertex, corner) = self.same_before(corners).filter(|_| self.same_attributes)?;
        let normal = self.normals.as_ref()?.add_fan(corners, fans)?;
        Some(UpdatedVertex { vertex, corner, normal })
    }

    /// The render vertex of all corners at a vertex, if they had the same one and agree in
    /// their normals.
    fn whole(&self, corners: &[u32], normals: &[Vec3]) -> Option<UpdatedVertex> {
        let (vertex, corner) = self.same_before(corners)?;
        let normal = *normals.first()?;
        let agree = normals.iter().all(|&other| tells_apart(other) == tells_apart(normal));
        agree.then_some(UpdatedVertex { vertex, corner, normal })
    }

    /// The render vertex that all corners at a vertex had, and the first of them.
    fn same_before(&self, corners: &[u32]) -> Option<(u32, u32)> {
        let &first = corners.first()?;
        let vertex = self.vertex_of_corner[first as usize];
        let had_same = corners.iter().all(|&other| self.vertex_of_corner[other as usize] == vertex);
        had_same.then_some((vertex, first))
    }

    /// The render vertices of the corners at one vertex: one for all that agreed before and
    /// agree now.
    fn parts(&self, values: &mut [CornerValue], found: &mut Shown) {
        values.sort_unstable_by(|a, b| {
            let order = tells_apart(a.normal).cmp(&tells_apart(b.normal));
            order.then_with(|| self.attributes.order(a.corner, b.corner)).then(a.corner.cmp(&b.corner))
        });
        // All that agree now show the values of the first of them, as when they are welded.
        // (They differ in nothing but the signs of zeros.)
        let agree = |a: &CornerValue, b: &CornerValue| {
            tells_apart(a.normal) == tells_apart(b.normal) && self.attributes.equal(a.corner, b.corner)
        };
        for alike in values.chunk_by_mut(agree) {
            let first = (alike[0].corner, alike[0].normal);
            alike.iter_mut().for_each(|value| value.shown = first);
        }
        values.sort_unstable_by_key(|value| (value.before, value.shown.0, value.corner));
        let mut last = None;
        for alike in values.chunk_by(|a, b| (a.before, a.shown.0) == (b.before, b.shown.0)) {
            let CornerValue { before, shown, .. } = alike[0];
            // The first of those that agreed before keep their vertex.
            if last.replace(before) == Some(before) {
                let corners = alike.iter().map(|value| value.corner).collect();
                found.split.push(SplitOff { corners, shown });
            } else {
                found.kept.push(UpdatedVertex { vertex: before, corner: shown.0, normal: shown.1 });
            }
        }
    }
}

/// Whether a sorted list holds an element; leaves what comes after it. Elements are asked for in increasing order.
fn is_next(list: &mut &[u32], element: u32) -> bool {
    if list.first().is_some_and(|&first| first < element) {
        *list = &list[list.partition_point(|&other| other < element)..];
    }
    list.first() == Some(&element)
}

fn tells_apart(normal: Vec3) -> [u32; 3] {
    bits(normal.to_array())
}
