//! Triangles that are written anew, with their edge flags and sides.

use std::mem::replace;

use trigon_mesh::{Mesh, Triangulation};
use trigon_raster::EdgeFlags;

use super::super::edge_flags::{Diagonal, flags_of_face};
use super::super::side_edges::{NO_EDGE, sides_of_triangle};
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

    /// Triangulates faces and writes their triangles; `first` is the slot where the lists begin. `None` if a face
    /// needs more slots than it has.
    pub(super) fn replace(
        mut self,
        mesh: &Mesh,
        vertex_of_corner: &[u32],
        places: &mut [FacePlace],
        first: usize,
    ) -> Option<Replaced> {
        /// Faces whose triangles and flags are made before the first of them are written: many a load is under
        /// way then, since little else is done.
        const GROUP: usize = 128;
        let (mut replaced, mut are_full) = (Replaced::default(), true);
        replaced.counts.reserve(places.len());
        for places in places.chunks_mut(GROUP) {
            let cut = CutFaces::new(mesh, places, !self.flags.is_empty());
            let (mut triangles, mut flags) = (cut.triangles.as_slice(), cut.flags.as_slice());
            for (place, &count) in places.iter_mut().zip(&cut.counts) {
                let own = triangles.split_off(..count as usize)?;
                let own_flags = flags.split_off(..count as usize).unwrap_or_default();
                if place.slots().len() < own.len() {
                    return None;
                }
                are_full &= place.slots().len() == own.len();
                let diagonal = Diagonal::of(mesh.face_corners(place.face as usize).start as u32, own);
                if diagonal.is_some() && diagonal == place.diagonal {
                    self.write_flags(place.slots().start, first, own_flags, &mut replaced.triangles);
                    continue;
                }
                place.diagonal = diagonal;
                self.write(mesh, vertex_of_corner, (place, first), (own, own_flags), &mut replaced.triangles);
            }
            replaced.counts.extend(cut.counts);
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

    /// Writes the triangles of a face over corners, and records the slots that have changed.
    fn write(
        &mut self,
        mesh: &Mesh,
        vertex_of_corner: &[u32],
        (place, first): (&FacePlace, usize),
        (triangles, flags): (&[[u32; 3]], &[EdgeFlags]),
        replaced: &mut Vec<u32>,
    ) {
        let mut fillers = fillers_of(mesh, place.face, triangles);
        for (number, slot) in place.slots().enumerate() {
            let (at, triangle) = (slot - first, triangles.get(number));
            let corners = triangle.copied().unwrap_or_else(|| [fillers.next(); 3]);
            let corners = corners.map(|corner| vertex_of_corner[corner as usize]);
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
struct CutFaces {
    /// Over the corners of the mesh.
    triangles: Vec<[u32; 3]>,
    /// Of the triangles; none if nobody needs them.
    flags: Vec<EdgeFlags>,
    /// How many triangles each face has.
    counts: Vec<u32>,
}

impl CutFaces {
    fn new(mesh: &Mesh, places: &[FacePlace], has_flags: bool) -> Self {
        let Triangulation { triangles, triangle_faces } =
            mesh.triangulation_of(places.iter().map(|place| place.face));
        let (mut of_triangles, mut faces) = (triangles.as_slice(), triangle_faces.as_slice());
        let (mut counts, mut flags) = (Vec::with_capacity(places.len()), Vec::new());
        flags.reserve(if has_flags { triangles.len() } else { 0 });
        for place in places {
            let count = faces.iter().take_while(|&&face| face == place.face).count();
            let own;
            (own, of_triangles) = of_triangles.split_at(count);
            faces = &faces[count..];
            counts.push(count as u32);
            if has_flags {
                flags_of_face(mesh, (place.face, own), |made| flags.push(made));
            }
        }
        Self { triangles, flags, counts }
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
