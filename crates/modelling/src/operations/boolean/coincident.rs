//! Faces of several operands that lie on each other: all of the result that could be either's is the first one's.

use std::collections::HashMap;

use trigon_math::DVec3;

use super::kernel::PatchedTriangles;
use super::solid::{FLATNESS, Patch};
use super::surface::sides;

/// The triangles of which operands consist, as positions: patch after patch.
pub(super) struct PatchTriangles<'s> {
    patches: &'s [Patch],
    triangles: Vec<[DVec3; 3]>,
}

impl<'s> PatchTriangles<'s> {
    pub(super) fn of(operands: &[PatchedTriangles], patches: &'s [Patch]) -> Self {
        let positions = |operand: &PatchedTriangles| -> Vec<[DVec3; 3]> {
            let position = |vertex: u32| operand.positions[vertex as usize];
            operand.triangles.iter().map(|triangle| triangle.vertices.map(position)).collect()
        };
        Self { patches, triangles: operands.iter().flat_map(positions).collect() }
    }

    /// Gives triangles beside one of an earlier operand's patch that lie on this patch, too, that patch.
    pub(super) fn prefer_first(&self, solid: &mut PatchedTriangles) {
        let mut owners: HashMap<[u32; 2], usize> = HashMap::with_capacity(3 * solid.triangles.len());
        for (number, triangle) in solid.triangles.iter().enumerate() {
            owners.extend(sides(triangle.vertices).map(|side| (side, number)));
        }
        let mut waiting: Vec<usize> = (0..solid.triangles.len()).rev().collect();
        while let Some(here) = waiting.pop() {
            for [from, to] in sides(solid.triangles[here].vertices) {
                let Some(&there) = owners.get(&[to, from]) else { continue };
                let patch = solid.triangles[here].patch;
                let [own, other] = [here, there].map(|number| self.operand(solid.triangles[number].patch));
                let corners =
                    |number: usize| solid.triangles[number].vertices.map(|v| solid.positions[v as usize]);
                if own < other && self.lies_on(patch, corners(there), corners(here)) {
                    solid.triangles[there].patch = patch;
                    waiting.push(there);
                }
            }
        }
    }

    fn operand(&self, patch: u32) -> usize {
        self.patches[patch as usize].operand
    }

    /// Whether a triangle lies on a patch, and looks where one beside it looks that is a part of the patch.
    fn lies_on(&self, patch: u32, triangle: [DVec3; 3], beside: [DVec3; 3]) -> bool {
        let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let triangles = &self.triangles[self.patches[patch as usize].triangles.clone()];
        let largest = triangles.iter().max_by(|a, b| {
            let squared = |triangle: &[DVec3; 3]| normal(*triangle).length_squared();
            squared(a).total_cmp(&squared(b))
        });
        let Some(&largest) = largest else { return false };
        let across = normal(largest).normalize_or_zero();
        let is_near = |position: DVec3| {
            let scale = position.abs().max_element().max(largest[0].abs().max_element());
            (position - largest[0]).dot(across).abs() <= FLATNESS * scale
        };
        let center = triangle.into_iter().sum::<DVec3>() / 3.0;
        triangle.into_iter().all(is_near)
            && normal(triangle).dot(normal(beside)) > 0.0
            && [center]
                .into_iter()
                .chain(triangle)
                .all(|position| triangles.iter().any(|other| is_within(*other, position)))
    }
}

/// Whether a point of its plane lies within a triangle, or on its border but for rounding.
fn is_within([a, b, c]: [DVec3; 3], position: DVec3) -> bool {
    let normal = (b - a).cross(c - a);
    let side = |from: DVec3, to: DVec3| (from - position).cross(to - position).dot(normal);
    let least = -1e-9 * normal.length_squared();
    side(a, b) >= least && side(b, c) >= least && side(c, a) >= least
}
