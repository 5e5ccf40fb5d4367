//! Welding: which corners of a mesh form one render vertex.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};

use trigon_math::{Vec2, Vec3, Vec4};

use crate::Mesh;
use crate::attributes::classes;
use crate::flat_faces::flat_classes;

/// So many welded vertices at one vertex of the mesh are compared in turn; more (at the centre of a large fan, at
/// the pole of a fine sphere) are kept in a tree, so that no mesh takes quadratic time.
const FEW: u32 = 24;

/// No welded vertex.
const NONE: u32 = u32::MAX;

/// The result of welding, in both directions.
#[derive(Clone)]
pub(crate) struct Welded {
    /// The first corner of each welded vertex.
    pub(crate) corner_of_vertex: Vec<u32>,
    /// The welded vertex of each corner.
    pub(crate) vertex_of_corner: OfCorners,
}

/// A number for each corner: in threes if all faces are triangles, which those of a render mesh are made of.
#[derive(Clone)]
pub(crate) enum OfCorners {
    Triangles(Vec<[u32; 3]>),
    Polygons(Vec<u32>),
}

impl OfCorners {
    /// In the order of the corners.
    fn new(mesh: &Mesh, mut number: impl FnMut((u32, &u32)) -> u32) -> Self {
        let numbered = (0..).zip(mesh.corner_vertices());
        if !mesh.has_only_triangles() {
            return Self::Polygons(numbered.map(number).collect());
        }
        let (triangles, _) = mesh.corner_vertices().as_chunks();
        let of = |(first, [a, b, c]): (u32, &[u32; 3])| {
            [number((first, a)), number((first + 1, b)), number((first + 2, c))]
        };
        Self::Triangles((0..).step_by(3).zip(triangles).map(of).collect())
    }

    pub(crate) fn as_slice(&self) -> &[u32] {
        match self {
            Self::Triangles(triangles) => triangles.as_flattened(),
            Self::Polygons(numbers) => numbers,
        }
    }

    pub(crate) fn into_vec(self) -> Vec<u32> {
        match self {
            Self::Triangles(triangles) => triangles.into_flattened(),
            Self::Polygons(numbers) => numbers,
        }
    }
}

/// Welds corners at the same vertex whose values agree, with
/// these normals in place of the mesh's own, or without any.
/// The welded vertices are numbered in order of first use; they come with their normals.
pub(crate) fn weld(mesh: &Mesh, normals: &[Vec3]) -> (Welded, Vec<Vec3>) {
    let compare = Comparison {
        normals,
        others: Some(AttributeComparison::new(mesh)).filter(AttributeComparison::has_any),
    };
    if compare.tells_nothing() {
        return (weld_all(mesh), Vec::new());
    }
    let mut welding = Welding::new(mesh.vertex_count());
    let number = |(corner, &vertex): (u32, &u32)| welding.number(&compare, vertex, corner);
    let vertex_of_corner = OfCorners::new(mesh, number);
    (Welded { corner_of_vertex: welding.corner_of_vertex, vertex_of_corner }, welding.normals)
}

/// Welds all corners at each vertex.
fn weld_all(mesh: &Mesh) -> Welded {
    let mut corner_of_vertex = Vec::with_capacity(mesh.vertex_count());
    let mut welded = vec![NONE; mesh.vertex_count()];
    let number = |(corner, &vertex): (u32, &u32)| {
        let number = &mut welded[vertex as usize];
        if *number == NONE {
            *number = corner_of_vertex.len() as u32;
            corner_of_vertex.push(corner);
        }
        *number
    };
    let vertex_of_corner = OfCorners::new(mesh, number);
    Welded { corner_of_vertex, vertex_of_corner }
}

/// The welded vertices so far.
struct Welding<'a> {
    /// The first corner of each welded vertex.
    corner_of_vertex: Vec<u32>,
    /// Their normals, next to each other: those of the corners are scattered over several times as much memory.
    normals: Vec<Vec3>,
    /// The first welded vertex at each vertex of the mesh.
    first: Vec<u32>,
    /// For each welded vertex the next one at the same vertex of the mesh. Shorter than the list of welded vertices if
    /// the last of them have none.
    next: Vec<u32>,
    /// Those beyond [`FEW`], by their vertices of the mesh.
    others: HashMap<u32, BTreeMap<OrderedCorner<'a>, u32>>,
}

/// A corner, compared by its values.
struct OrderedCorner<'a> {
    corner: u32,
    compare: &'a Comparison<'a>,
}

impl<'a> Welding<'a> {
    fn new(vertices: usize) -> Self {
        Self {
            // Most meshes have about as many.
            corner_of_vertex: Vec::with_capacity(vertices),
            normals: Vec::with_capacity(vertices),
            first: vec![NONE; vertices],
            next: Vec::new(),
            others: HashMap::new(),
        }
    }

    /// The welded vertex of a corner at a vertex of the mesh.
    fn number(&mut self, compare: &'a Comparison<'a>, vertex: u32, corner: u32) -> u32 {
        let mut at = self.first[vertex as usize];
        if at == NONE {
            self.first[vertex as usize] = self.corner_of_vertex.len() as u32;
            return self.push(compare, corner);
        }
        let mut passed = 1;
        loop {
            if self.is(compare, at, corner) {
                return at;
            }
            match self.next.get(at as usize) {
                Some(&next) if next != NONE => (at, passed) = (next, passed + 1),
                _ if passed == FEW => break,
                _ => {
                    self.next.resize(self.next.len().max(at as usize + 1), NONE);
                    self.next[at as usize] = self.corner_of_vertex.len() as u32;
                    return self.push(compare, corner);
                }
            }
        }
        let key = OrderedCorner { corner, compare };
        if let Some(&known) = self.others.get(&vertex).and_then(|others| others.get(&key)) {
            return known;
        }
        let new = self.push(compare, corner);
        self.others.entry(vertex).or_default().insert(key, new);
        new
    }

    /// Whether a corner at the same vertex of the mesh has the values of a welded vertex.
    fn is(&self, compare: &Comparison<'_>, welded: u32, corner: u32) -> bool {
        let has_normal = match compare.normals.get(corner as usize) {
            Some(normal) => bits(normal.to_array()) == bits(self.normals[welded as usize].to_array()),
            None => true,
        };
        let has_others =
            |others: &AttributeComparison<'_>| others.equal(corner, self.corner_of_vertex[welded as usize]);
        has_normal && compare.others.as_ref().is_none_or(has_others)
    }

    /// A new welded vertex with the values of a corner.
    fn push(&mut self, compare: &Comparison<'_>, corner: u32) -> u32 {
        self.normals.extend(compare.normals.get(corner as usize));
        self.corner_of_vertex.push(corner);
        self.corner_of_vertex.len() as u32 - 1
    }
}

impl Ord for OrderedCorner<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.compare.order(self.corner, other.corner)
    }
}

impl PartialOrd for OrderedCorner<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OrderedCorner<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for OrderedCorner<'_> {}

/// All values of all corners, compared by their bits (NaN equals itself and the two zeros are
/// equal).
struct Comparison<'a> {
    /// Empty if they do not count.
    normals: &'a [Vec3],
    /// None if there are none.
    others: Option<AttributeComparison<'a>>,
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

impl Comparison<'_> {
    /// Whether all corners at a vertex are equal.
    fn tells_nothing(&self) -> bool {
        self.normals.is_empty() && self.others.is_none()
    }

    fn normal(&self, corner: u32) -> [f32; 3] {
        self.normals.get(corner as usize).map_or([0.0; 3], |normal| normal.to_array())
    }

    /// A total order in which only equal corners compare equal.
    fn order(&self, a: u32, b: u32) -> Ordering {
        let others = || self.others.as_ref().map_or(Ordering::Equal, |others| others.order(a, b));
        by_bits(self.normal(a), self.normal(b)).then_with(others)
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

    /// Whether there are any values.
    fn has_any(&self) -> bool {
        let Self { uv_sets, colors, tangents, morphs, flat } = self;
        let is_empty = uv_sets.is_empty() && colors.is_empty() && tangents.is_empty();
        !(is_empty && morphs.is_empty() && flat.is_empty())
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
