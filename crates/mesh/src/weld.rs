//! Welding: which corners of a mesh form one render vertex.

use std::cmp::Ordering;

use trigon_math::{Vec2, Vec3, Vec4};

use crate::Mesh;
use crate::attributes::classes;
use crate::flat_faces::flat_classes;
use crate::groups::Groups;

/// Groups of up to this many corners are compared pairwise; larger ones (the centre of a large fan,
/// the pole of a fine sphere) are sorted, so that no mesh takes quadratic time.
const SMALL_GROUP: usize = 24;

/// The result of welding, in both directions.
pub(crate) struct Welded {
    /// The first corner of each welded vertex.
    pub(crate) corner_of_vertex: Vec<u32>,
    /// The welded vertex of each corner.
    pub(crate) vertex_of_corner: Vec<u32>,
}

/// Welds corners at the same vertex whose values agree, with
/// these normals in place of the mesh's own, or without any.
pub(crate) fn weld(mesh: &Mesh, normals: &[Vec3]) -> Welded {
    let compare = Comparison::new(mesh, normals);
    if compare.is_trivial() {
        return number_vertices(mesh);
    }
    let corners = mesh.corner_vertices().iter().copied().zip(0u32..);
    let mut groups = Groups::new(mesh.vertex_count(), corners);
    let mut first_alike = vec![0u32; mesh.corner_count()];
    for group in groups.iter_mut() {
        match group.len() {
            0..=SMALL_GROUP => link_small(group, &compare, &mut first_alike),
            _ => link_large(group, &compare, &mut first_alike),
        }
    }
    number(first_alike)
}

/// Corners without values: the vertices that have corners, in order of first use.
fn number_vertices(mesh: &Mesh) -> Welded {
    /// Not used yet.
    const NONE: u32 = u32::MAX;
    let mut numbers = vec![NONE; mesh.vertex_count()];
    let mut corner_of_vertex = Vec::new();
    let number = |(corner, &vertex): (u32, &u32)| {
        let number = &mut numbers[vertex as usize];
        if *number == NONE {
            *number = corner_of_vertex.len() as u32;
            corner_of_vertex.push(corner);
        }
        *number
    };
    let vertex_of_corner = (0..).zip(mesh.corner_vertices()).map(number).collect();
    Welded { corner_of_vertex, vertex_of_corner }
}

/// Turns "the first equal corner" into numbers in order of first use.
fn number(mut first_alike: Vec<u32>) -> Welded {
    let mut corner_of_vertex = Vec::new();
    for corner in 0..first_alike.len() {
        let first = first_alike[corner] as usize;
        first_alike[corner] = if first == corner {
            corner_of_vertex.push(corner as u32);
            corner_of_vertex.len() as u32 - 1
        } else {
            // An earlier corner, which has its number already.
            first_alike[first]
        };
    }
    Welded { corner_of_vertex, vertex_of_corner: first_alike }
}

fn link_small(group: &mut [u32], compare: &Comparison, first_alike: &mut [u32]) {
    let mut distinct = 0;
    for i in 0..group.len() {
        let corner = group[i];
        let known = group[..distinct].iter().find(|&&other| compare.equal(corner, other));
        first_alike[corner as usize] = match known {
            Some(&first) => first,
            None => {
                // Corners after `i` are still to come; those before it that are not distinct are
                // finished.
                group[distinct] = corner;
                distinct += 1;
                corner
            }
        };
    }
}

fn link_large(group: &mut [u32], compare: &Comparison, first_alike: &mut [u32]) {
    group.sort_unstable_by(|&a, &b| compare.order(a, b).then(a.cmp(&b)));
    for alike in group.chunk_by(|&a, &b| compare.equal(a, b)) {
        for &corner in alike {
            first_alike[corner as usize] = alike[0];
        }
    }
}

/// All values of all corners, compared by their bits (NaN equals itself and the two zeros are
/// equal).
struct Comparison<'a> {
    /// Empty if they do not count.
    normals: &'a [Vec3],
    others: AttributeComparison<'a>,
}

/// The same without normals.
pub(crate) struct AttributeComparison<'a> {
    uv_sets: &'a [Vec<Vec2>],
    /// Empty if the mesh has none.
    colors: &'a [Vec4],
    /// Empty if the mesh has none.
    tangents: &'a [Vec4],
    /// The effect of morph targets on each corner; empty if there are none.
    morphs: Vec<u32>,
    /// The flat face of each corner, if a pose can rotate faces apart; otherwise empty.
    flat: Vec<u32>,
}

impl<'a> Comparison<'a> {
    fn new(mesh: &'a Mesh, normals: &'a [Vec3]) -> Self {
        Self { normals, others: AttributeComparison::new(mesh) }
    }

    /// Whether corners have no values.
    fn is_trivial(&self) -> bool {
        self.normals.is_empty() && self.others.is_trivial()
    }

    fn normal(&self, corner: u32) -> [f32; 3] {
        self.normals.get(corner as usize).map_or([0.0; 3], |normal| normal.to_array())
    }

    fn equal(&self, a: u32, b: u32) -> bool {
        bits(self.normal(a)) == bits(self.normal(b)) && self.others.equal(a, b)
    }

    /// A total order in which only equal corners compare equal.
    fn order(&self, a: u32, b: u32) -> Ordering {
        by_bits(self.normal(a), self.normal(b)).then_with(|| self.others.order(a, b))
    }
}

impl<'a> AttributeComparison<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let attributes = mesh.attributes();
        Self {
            uv_sets: &attributes.uv_sets,
            colors: attributes.corner_colors.as_deref().unwrap_or(&[]),
            tangents: attributes.corner_tangents.as_deref().unwrap_or(&[]),
            morphs: match attributes.morph_targets.as_slice() {
                [] => Vec::new(),
                targets => classes(targets, mesh.corner_count()),
            },
            flat: flat_classes(mesh),
        }
    }

    /// Whether corners have no values.
    fn is_trivial(&self) -> bool {
        let has_no_vectors = self.colors.is_empty() && self.tangents.is_empty();
        self.uv_sets.is_empty() && has_no_vectors && self.morphs.is_empty() && self.flat.is_empty()
    }

    pub(crate) fn equal(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a as usize, b as usize];
        self.uv_sets.iter().all(|set| bits(set[a].to_array()) == bits(set[b].to_array()))
            && [self.colors, self.tangents]
                .iter()
                .all(|values| values.is_empty() || bits(values[a].to_array()) == bits(values[b].to_array()))
            && [&self.morphs, &self.flat].iter().all(|classes| classes.is_empty() || classes[a] == classes[b])
    }

    /// A total order in which only equal corners compare equal.
    pub(crate) fn order(&self, a: u32, b: u32) -> Ordering {
        let [a, b] = [a as usize, b as usize];
        let mut order = Ordering::Equal;
        for set in self.uv_sets {
            order = order.then_with(|| by_bits(set[a].to_array(), set[b].to_array()));
        }
        for values in [self.colors, self.tangents].into_iter().filter(|values| !values.is_empty()) {
            order = order.then_with(|| by_bits(values[a].to_array(), values[b].to_array()));
        }
        for classes in [&self.morphs, &self.flat].into_iter().filter(|classes| !classes.is_empty()) {
            order = order.then(classes[a].cmp(&classes[b]));
        }
        order
    }
}

fn by_bits<const N: usize>(a: [f32; N], b: [f32; N]) -> Ordering {
    bits(a).cmp(&bits(b))
}

/// What distinguishes values.
pub(crate) fn bits<const N: usize>(values: [f32; N]) -> [u32; N] {
    // Adding zero turns -0 into +0 and changes nothing else.
    values.map(|value| (value + 0.0).to_bits())
}
