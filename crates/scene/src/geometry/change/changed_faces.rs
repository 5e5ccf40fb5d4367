//! Faces that are cut into triangles again, and their triangles, edge flags and sides.

use std::mem::replace;
use std::ops::Range;

use trigon_mesh::{Mesh, RenderLinks};
use trigon_raster::EdgeFlags;

use super::super::edge_flags::push_flags_of_face;
use crate::geometry::edge_flags::{NO_EDGE, sides_of_triangle};

/// Faces per task.
pub(super) const FACES_PER_TASK: usize = 1024;

/// A face and the slots of its triangles in the geometry.
pub(super) struct ChangedFace {
    pub(super) face: u32,
    pub(super) start: u32,
    pub(super) end: u32,
}

impl ChangedFace {
    pub(super) fn slots(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Per-triangle data of consecutive triangles, or nothing where it is unknown.
pub(super) struct TriangleLists<'a> {
    pub(super) triangles: &'a mut [[u32; 3]],
    pub(super) flags: &'a mut [EdgeFlags],
    pub(super) sides: &'a mut [[u32; 3]],
}

impl TriangleLists<'_> {
    /// Splits off the first `count` triangles and returns them.
    pub(super) fn split_off(&mut self, count: usize) -> Self {
        fn first<'a, T>(list: &mut &'a mut [T], count: usize) -> &'a mut [T] {
            list.split_off_mut(..count).unwrap_or_default()
        }
        Self {
            triangles: first(&mut self.triangles, count),
            flags: first(&mut self.flags, count),
            sides: first(&mut self.sides, count),
        }
    }
}

/// Faces whose triangles are written, in the order of their slots.
pub(super) struct ChangedFaces<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) links: &'a RenderLinks,
    pub(super) faces: &'a [ChangedFace],
    /// The slot where the lists begin.
    pub(super) first_slot: usize,
    pub(super) lists: TriangleLists<'a>,
}

/// What has become of the slots of some faces.
#[derive(Default)]
pub(super) struct Rewritten {
    /// The slots that have other corners, edge flags or sides now, increasing.
    pub(super) triangles: Vec<u32>,
    /// The slots without a triangle, increasing.
    pub(super) fillers: Vec<u32>,
}

/// What is written into a slot.
struct SlotTriangle {
    corners: [u32; 3],
    flags: EdgeFlags,
    sides: [u32; 3],
}

impl ChangedFaces<'_> {
    /// Cuts the faces into triangles and writes these. `None` if a face needs more slots than it has.
    pub(super) fn rewrite(mut self) -> Option<Rewritten> {
        let mesh = self.mesh;
        let cut = mesh.triangulation_of(self.faces.iter().map(|changed| changed.face));
        let (mut rest, mut rest_faces) = (cut.triangles.as_slice(), cut.triangle_faces.as_slice());
        let (mut rewritten, mut flags) = (Rewritten::default(), Vec::new());
        for changed in self.faces {
            let count = rest_faces.iter().take_while(|&&face| face == changed.face).count();
            if count > changed.slots().len() {
                return None;
            }
            let triangles;
            (triangles, rest) = rest.split_at(count);
            rest_faces = &rest_faces[count..];
            flags.clear();
            if !self.lists.flags.is_empty() && count > 0 {
                push_flags_of_face(mesh, changed.face, triangles, &mut flags);
            }
            self.write(changed, triangles, &flags, &mut rewritten);
        }
        Some(rewritten)
    }

    /// Writes the triangles of a face.
    fn write(
        &mut self,
        changed: &ChangedFace,
        triangles: &[[u32; 3]],
        flags: &[EdgeFlags],
        rewritten: &mut Rewritten,
    ) {
        let (mesh, links) = (self.mesh, self.links);
        let mut fillers = fillers_of(mesh, changed.face, triangles);
        let has_sides = !self.lists.sides.is_empty();
        for (number, slot) in changed.slots().enumerate() {
            let triangle = triangles.get(number);
            if triangle.is_none() {
                rewritten.fillers.push(slot as u32);
            }
            let corners = triangle.copied().unwrap_or_else(|| [fillers.next(); 3]);
            let sides_of = |triangle| sides_of_triangle(mesh, changed.face, triangle);
            let made = SlotTriangle {
                corners: corners.map(|corner| links.vertex_of_corner()[corner as usize]),
                flags: flags.get(number).copied().unwrap_or(EdgeFlags::NONE),
                sides: triangle.filter(|_| has_sides).map_or([NO_EDGE; 3], sides_of),
            };
            if self.write_slot(slot - self.first_slot, made) {
                rewritten.triangles.push(slot as u32);
            }
        }
    }

    /// Writes into a slot of the lists; whether anything there differs from before.
    fn write_slot(&mut self, at: usize, made: SlotTriangle) -> bool {
        let TriangleLists { triangles, flags, sides } = &mut self.lists;
        let mut differs = replace(&mut triangles[at], made.corners) != made.corners;
        if let Some(own) = flags.get_mut(at) {
            differs |= replace(own, made.flags) != made.flags;
        }
        if let Some(own) = sides.get_mut(at) {
            differs |= replace(own, made.sides) != made.sides;
        }
        differs
    }
}

/// The corners that the fillers of a face use.
pub(super) struct Fillers {
    /// First those that no triangle of the face uses, so that no corner is left without a triangle.
    unused: std::vec::IntoIter<u32>,
    first: u32,
}

pub(super) fn fillers_of(mesh: &Mesh, face: u32, triangles: &[[u32; 3]]) -> Fillers {
    let corners = mesh.face_corners(face as usize);
    let first = corners.start as u32;
    let mut unused = Vec::new();
    if triangles.len() + 2 < corners.len() {
        let mut is_used = vec![false; corners.len()];
        triangles.as_flattened().iter().for_each(|corner| is_used[(corner - first) as usize] = true);
        unused.extend((first..).zip(is_used).filter(|(_, is_used)| !is_used).map(|(corner, _)| corner));
    }
    Fillers { unused: unused.into_iter(), first }
}

impl Fillers {
    pub(super) fn next(&mut self) -> u32 {
        self.unused.next().unwrap_or(self.first)
    }
}
