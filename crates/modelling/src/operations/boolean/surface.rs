//! The kernel's triangles as a surface: without parts that `f32` cannot hold, and in connected parts of patches.

use std::collections::{BTreeMap, HashMap, HashSet};

use trigon_math::{DVec3, DisjointSets, Vec3};

use super::kernel::{PatchTriangle, PatchedTriangles};
use super::solid::FLATNESS;

/// A connected part of a patch.
#[derive(Debug)]
pub(super) struct PatchPart {
    pub(super) patch: u32,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// The sides of a triangle.
pub(super) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The connected parts of all patches, in the order of their first triangles.
pub(super) fn regions(triangles: &[PatchTriangle]) -> Vec<PatchPart> {
    let mut owners: HashMap<[u32; 2], u32> = HashMap::with_capacity(3 * triangles.len());
    for (number, triangle) in (0u32..).zip(triangles) {
        owners.extend(sides(triangle.vertices).map(|side| (side, number)));
    }
    let mut sets = DisjointSets::new(triangles.len());
    for (number, triangle) in (0u32..).zip(triangles) {
        for [from, to] in sides(triangle.vertices) {
            let other = owners.get(&[to, from]);
            if let Some(&other) = other.filter(|&&other| triangles[other as usize].patch == triangle.patch) {
                sets.join(number, other);
            }
        }
    }
    let mut regions: BTreeMap<u32, PatchPart> = BTreeMap::new();
    for (number, triangle) in (0u32..).zip(triangles) {
        let empty = || PatchPart { patch: triangle.patch, triangles: Vec::new() };
        regions.entry(sets.root(number)).or_insert_with(empty).triangles.push(triangle.vertices);
    }
    regions.into_values().collect()
}

/// The triangles without edges whose ends round to the same position, and without flat parts, which bound nothing.
pub(super) fn tidied(solid: &PatchedTriangles) -> Vec<PatchTriangle> {
    let merged = without_zero_edges(solid);
    without_flat_parts(&merged, &solid.positions)
}

/// Collapses edges whose ends round to the same position, but those where more than two triangles would then meet at
/// an edge.
fn without_zero_edges(solid: &PatchedTriangles) -> Vec<PatchTriangle> {
    // Both zeros are the same position.
    let rounded: Vec<Vec3> = solid.positions.iter().map(|position| position.as_vec3() + Vec3::ZERO).collect();
    let all = solid.triangles.iter().flat_map(|triangle| sides(triangle.vertices));
    let mut zeros: Vec<[u32; 2]> =
        all.filter(|&[from, to]| from < to && rounded[from as usize] == rounded[to as usize]).collect();
    loop {
        let mut sets = DisjointSets::new(rounded.len());
        zeros.iter().for_each(|&[from, to]| sets.join(from, to));
        let collapsed = |triangle: &PatchTriangle| {
            let vertices = triangle.vertices.map(|vertex| sets.root(vertex));
            let [a, b, c] = vertices;
            (a != b && b != c && c != a).then_some(PatchTriangle { vertices, ..*triangle })
        };
        let merged: Vec<PatchTriangle> = solid.triangles.iter().filter_map(collapsed).collect();
        if zeros.is_empty() {
            return merged;
        }
        let crowded = crowded(&merged);
        let before = zeros.len();
        zeros.retain(|&[from, _]| !crowded.contains(&sets.root(from)));
        if zeros.len() == before {
            return merged;
        }
    }
}

/// The ends of edges along which several triangles run in the same direction.
fn crowded(triangles: &[PatchTriangle]) -> HashSet<u32> {
    let mut known: HashSet<[u32; 2]> = HashSet::with_capacity(3 * triangles.len());
    let all = triangles.iter().flat_map(|triangle| sides(triangle.vertices));
    all.filter(|&side| !known.insert(side)).flatten().collect()
}

/// Without connected parts that lie in a plane as a whole: they are sheets with two sides and nothing between them.
fn without_flat_parts(triangles: &[PatchTriangle], positions: &[DVec3]) -> Vec<PatchTriangle> {
    let mut sets = DisjointSets::new(positions.len());
    for triangle in triangles {
        let [a, b, c] = triangle.vertices;
        sets.join(a, b);
        sets.join(b, c);
    }
    let position = |vertex: u32| positions[vertex as usize];
    // For each part its largest triangle: the normal, whose length is twice the area, and a corner.
    let mut largest: HashMap<u32, [DVec3; 2]> = HashMap::new();
    for triangle in triangles {
        let [a, b, c] = triangle.vertices.map(position);
        let normal = (b - a).cross(c - a);
        let entry = largest.entry(sets.root(triangle.vertices[0])).or_insert([normal, a]);
        if normal.length_squared() > entry[0].length_squared() {
            *entry = [normal, a];
        }
    }
    let mut solid: HashSet<u32> = HashSet::new();
    for vertex in triangles.iter().flat_map(|triangle| triangle.vertices) {
        let part = sets.root(vertex);
        let Some(&[normal, corner]) = largest.get(&part) else { continue };
        let scale = position(vertex).abs().max_element().max(corner.abs().max_element());
        if (position(vertex) - corner).dot(normal.normalize_or_zero()).abs() > FLATNESS * scale {
            solid.insert(part);
        }
    }
    triangles.iter().filter(|triangle| solid.contains(&sets.root(triangle.vertices[0]))).copied().collect()
}
