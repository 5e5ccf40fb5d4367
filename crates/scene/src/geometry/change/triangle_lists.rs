//! Triangles that are written anew, with their edge flags and sides.

use std::borrow::Cow;
use std::mem::replace;
use std::ops::Range;

use trigon_mesh::{Mesh, RenderLinks, Triangulation};
use trigon_raster::EdgeFlags;

use super::super::edge_flags::flags_of_face;
use super::super::side_edges::{NO_EDGE, sides_of_triangle};
use super::cut_quads::CutQuad;
use super::face_places::FacePlace;

/// Per-triangle data of consecutive triangles, or nothing where it is unknown.
pub(super) struct TriangleLists<'a> {
    pub(super) triangles: &'a mut [[u32; 3]],
    pub(super) flags: &'a mut [EdgeFlags],
    pub(super) sides: &'a mut [[u32; 3]],
}

/// What has become of the triangles of some faces.
#[derive(Default)]
pub(super) struct Replaced {
    /// The slots that have other corners, edge flags or sides now, increasing.
    pub(super) triangles: Vec<u32>,
    /// For each face how many triangles it has; none if each face has one in each of its slots.
    pub(super) counts: Vec<u32>,
    /// Whether a face may have more or fewer triangles than before.
    pub(super) may_differ_in_counts: bool,
}

impl<'a> TriangleLists<'a> {
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

    /// Triangulates faces, of which these quads are cut, and writes their triangles; `first` is the slot where the lists
    /// begin. `None` if a face needs more slots than it has.
    pub(super) fn replace(
        mut self,
        mesh: &Mesh,
        links: &RenderLinks,
        (places, quads): (&mut [FacePlace], &[CutQuad]),
        first: usize,
    ) -> Option<Replaced> {
        let (mut replaced, mut are_full) = (Replaced::default(), true);
        replaced.counts.reserve(places.len());
        let cut = CutFaces::new(mesh, (places, quads), !self.flags.is_empty());
        for (place, face) in places.iter_mut().zip(&cut.faces) {
            if place.slots().len() < face.count() {
                return None;
            }
            are_full &= place.slots().len() == face.count();
            replaced.counts.push(face.count() as u32);
            let cut_quad = face.quad.cut;
            if cut_quad.is_some() && cut_quad == place.cut {
                let flags = cut.flags_of(face);
                self.write_flags(place.slots().start, first, flags, &mut replaced.triangles);
                continue;
            }
            place.cut = cut_quad;
            replaced.may_differ_in_counts = true;
            self.write(mesh, links, (place, first), (&cut, face), &mut replaced.triangles);
        }
        if are_full {
            replaced.counts.clear();
        }
        Some(replaced)
    }

    /// Writes the flags of triangles that have the corners that they had, and records the slots that have changed.
    fn write_flags(&mut self, slot: usize, first: usize, flags: &[EdgeFlags], replaced: &mut Vec<u32>) {
        for (slot, &made) in (slot..).zip(flags) {
            if replace(&mut self.flags[slot - first], made) != made {
                replaced.push(slot as u32);
            }
        }
    }

    /// Writes the triangles of a face, and records the slots that have changed.
    fn write(
        &mut self,
        mesh: &Mesh,
        links: &RenderLinks,
        (place, first): (&FacePlace, usize),
        (cut, face): (&CutFaces, &CutFace),
        replaced: &mut Vec<u32>,
    ) {
        let start = mesh.face_corners(place.face as usize).start as u32;
        let (triangles, flags) = (cut.triangles_of(face, start), cut.flags_of(face));
        let mut fillers = fillers_of(mesh, place.face, &triangles);
        for (number, slot) in place.slots().enumerate() {
            let (at, triangle) = (slot - first, triangles.get(number));
            let corners = triangle.copied().unwrap_or_else(|| [fillers.next(); 3]);
            let corners = corners.map(|corner| links.vertex_of_corner()[corner as usize]);
            let mut differs = replace(&mut self.triangles[at], corners) != corners;
            if let Some(own) = self.flags.get_mut(at) {
                let made = flags.get(number).copied().unwrap_or(EdgeFlags::NONE);
                differs |= replace(own, made) != made;
            }
            if let Some(own) = self.sides.get_mut(at) {
                let of_triangle = |triangle| sides_of_triangle(mesh, place.face, triangle);
                let sides = triangle.map_or([NO_EDGE; 3], of_triangle);
                differs |= replace(own, sides) != sides;
            }
            if differs {
                replaced.push(slot as u32);
            }
        }
    }
}

/// Some faces, triangulated.
#[derive(Default)]
struct CutFaces {
    faces: Vec<CutFace>,
    /// The triangles of faces that are no quads, or need a closer look, over the corners of the mesh.
    triangles: Vec<[u32; 3]>,
    /// The flags of these; none if nobody needs them.
    flags: Vec<EdgeFlags>,
    has_flags: bool,
}

/// A face.
struct CutFace {
    quad: CutQuad,
    /// Where its triangles are in the list, unless it is a cut quad.
    listed: Range<usize>,
}

impl CutFace {
    /// How many triangles it has.
    fn count(&self) -> usize {
        self.quad.cut.map_or(self.listed.len(), |cut| cut.triangles().len())
    }
}

impl CutFaces {
    /// Triangulates faces, of which these quads are cut.
    fn new(mesh: &Mesh, (places, quads): (&[FacePlace], &[CutQuad]), has_flags: bool) -> Self {
        let face = |place: &FacePlace| {
            let quad = place.outline.map_or(CutQuad::NONE, |outline| quads[outline as usize]);
            CutFace { quad, listed: 0..0 }
        };
        let mut cut = Self { faces: places.iter().map(face).collect(), has_flags, ..Self::default() };
        cut.cut_others(mesh, places);
        cut
    }

    /// Triangulates those faces that are no quads, or need a closer look.
    fn cut_others(&mut self, mesh: &Mesh, places: &[FacePlace]) {
        let others: Vec<u32> = places
            .iter()
            .zip(&self.faces)
            .filter(|(_, face)| face.quad.cut.is_none())
            .map(|(place, _)| place.face)
            .collect();
        let Triangulation { triangles, triangle_faces } = mesh.triangulation_of(others.iter().copied());
        self.triangles = triangles;
        let mut end = 0;
        for (face, other) in self.faces.iter_mut().filter(|face| face.quad.cut.is_none()).zip(others) {
            let start = end;
            end += triangle_faces[start..].iter().take_while(|&&face| face == other).count();
            face.listed = start..end;
            if self.has_flags {
                let triangles = &self.triangles[start..end];
                flags_of_face(mesh, (other, triangles), |made| self.flags.push(made));
            }
        }
    }

    /// The triangles of a face with this first corner, over the corners of the mesh.
    fn triangles_of(&self, face: &CutFace, start: u32) -> Cow<'_, [[u32; 3]]> {
        match face.quad.cut {
            Some(cut) => {
                cut.triangles().iter().map(|triangle| triangle.map(|corner| start + corner)).collect()
            }
            None => Cow::Borrowed(&self.triangles[face.listed.clone()]),
        }
    }

    /// The flags of a face's triangles; none if nobody needs them.
    fn flags_of<'f>(&'f self, face: &'f CutFace) -> &'f [EdgeFlags] {
        match face.quad.cut {
            _ if !self.has_flags => &[],
            Some(_) => &face.quad.flags[..face.count()],
            None => &self.flags[face.listed.clone()],
        }
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
