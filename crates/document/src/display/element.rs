//! Elements by their numbers in an image: which of them can be selected, and how far they are from the
//! pointer.

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_mesh::math::DVec2;
use trigon_modelling::{EdgeId, EditMesh, ElementMap, ElementNumbers, FaceId, VertexId};
use trigon_scene::camera::Projector;
use trigon_scene::{MeshId, NodeId};

use crate::document::Document;
use crate::selection::ElementKind;

/// An edited element, with an object that shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Target {
    pub(super) node: NodeId,
    pub(super) mesh: MeshId,
    /// Its number among elements of the requested kind.
    pub(super) element: u32,
}

/// Pixels from a point to a vertex, to an edge's line, or to a face's centre; infinite if it is not
/// on the screen.
pub(super) fn distance(
    document: &Document,
    projector: &Projector,
    kind: ElementKind,
    target: &Target,
    point: DVec2,
) -> f64 {
    let Some(mesh) = document.mesh(target.mesh) else { return f64::INFINITY };
    let world = document.nodes().world_transform(target.node);
    let at = |vertex: VertexId| projector.to_screen(world.transform_point3(mesh.position(vertex).as_dvec3()));
    let found = match kind {
        ElementKind::Vertex => at(VertexId::new(target.element)).map(|at| at.distance(point)),
        ElementKind::Edge => {
            let [a, b] = mesh.edge_vertices(EdgeId::new(target.element)).map(at);
            a.zip(b).map(|(a, b)| distance_to_line([a, b], point))
        }
        ElementKind::Face => {
            let center = world.transform_point3(mesh.face_center(FaceId::new(target.element)));
            projector.to_screen(center).map(|center| center.distance(point))
        }
    };
    found.unwrap_or(f64::INFINITY)
}

/// From a point to the line between two others.
fn distance_to_line([a, b]: [DVec2; 2], point: DVec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * share).distance(point)
}

/// The elements of a mesh by their numbers in an image.
pub(super) struct Numbering<'d> {
    pub(super) id: MeshId,
    pub(super) mesh: &'d EditMesh,
    pub(super) map: &'d ElementMap,
    pub(super) numbers: &'d ElementNumbers,
}

impl Numbering<'_> {
    /// The element with a number; `None` if it cannot be selected.
    pub(super) fn element(&self, kind: ElementKind, number: u32) -> Option<u32> {
        let element = match kind {
            ElementKind::Vertex => self.map.vertices.get(number as usize)?.index(),
            ElementKind::Edge => self.numbers.edge_of_mesh(number)?.index(),
            ElementKind::Face => self.map.faces.get(number as usize)?.index(),
        };
        is_selectable(self.mesh, kind, element).then_some(element)
    }

    /// Those of some numbers that can be selected.
    pub(super) fn elements(&self, kind: ElementKind, numbers: &FixedBitSet) -> FixedBitSet {
        /// Numbers that a thread takes at a time.
        const SHARE: usize = 1 << 14;
        let starts: Vec<usize> = (0..numbers.len()).step_by(SHARE).collect();
        let shares = starts.into_par_iter().map(|start| {
            let share = start..numbers.len().min(start + SHARE);
            let own = share.filter(|&number| numbers.contains(number));
            own.filter_map(|number| self.element(kind, number as u32)).collect::<Vec<u32>>()
        });
        let shares: Vec<Vec<u32>> = shares.collect();
        let mut elements = FixedBitSet::with_capacity(kind.capacity(self.mesh));
        shares.iter().flatten().for_each(|&element| elements.insert(element as usize));
        elements
    }
}

pub(super) fn exists(mesh: &EditMesh, kind: ElementKind, element: u32) -> bool {
    match kind {
        ElementKind::Vertex => mesh.has_vertex(VertexId::new(element)),
        ElementKind::Edge => mesh.has_edge(EdgeId::new(element)),
        ElementKind::Face => mesh.has_face(FaceId::new(element)),
    }
}

pub(super) fn is_selectable(mesh: &EditMesh, kind: ElementKind, element: u32) -> bool {
    exists(mesh, kind, element)
        && !match kind {
            ElementKind::Vertex => mesh.is_vertex_hidden(VertexId::new(element)),
            ElementKind::Edge => mesh.is_edge_hidden(EdgeId::new(element)),
            ElementKind::Face => mesh.is_face_hidden(FaceId::new(element)),
        }
}

/// Bits in a word of a set.
const WORD: usize = usize::BITS as usize;

/// Words that a thread takes at a time, at least.
const WORDS: usize = 256;

/// So many bits that are set.
pub(super) fn all(count: usize) -> FixedBitSet {
    let mut all = FixedBitSet::with_capacity(count);
    all.insert_range(..);
    all
}

/// So many bits, of which some are set.
pub(super) fn bits(count: usize, numbers: impl Iterator<Item = u32>) -> FixedBitSet {
    let mut bits = FixedBitSet::with_capacity(count);
    numbers.for_each(|number| bits.insert(number as usize));
    bits
}

/// So many bits, of which those are set whose numbers pass a test: word by word, on all threads.
pub(super) fn bits_where(count: usize, is_set: impl Fn(usize) -> bool + Sync) -> FixedBitSet {
    let words = (0..count.div_ceil(WORD)).into_par_iter().with_min_len(WORDS);
    let word = |number: usize| {
        let first = number * WORD;
        let bits = first..count.min(first + WORD);
        bits.fold(0, |word, bit| word | usize::from(is_set(bit)) << (bit - first))
    };
    FixedBitSet::with_capacity_and_blocks(count, words.map(word).collect::<Vec<usize>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_that_pass_however_many_there_are() {
        for count in [0, 1, 63, 64, 65, 127, 128, 100_000] {
            let is_set = |number: usize| number % 3 == 1 || number % 64 == 63;
            let expected =
                bits(count, (0..count).filter(|&number| is_set(number)).map(|number| number as u32));
            assert_eq!(bits_where(count, is_set), expected, "of {count}");
            assert_eq!(bits_where(count, |_| true), all(count), "all {count}");
        }
    }
}
