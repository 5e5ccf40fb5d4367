//! What becomes an object of the file: a mesh with its materials, for all nodes that show it. Vertices at the same
//! position become one where that closes the surface.

use std::collections::{BTreeMap, HashMap};

use trigon_math::{DAffine3, DVec3};
use trigon_scene::{MaterialId, MeshId};

use super::closed::open_edges;
use crate::error::Location;
use crate::export::{Gathered, Loss, Object};
use crate::warning::counted;

/// An object of the file.
pub(super) struct Resource<'g> {
    /// The first one that shows it.
    pub(super) object: &'g Object<'g>,
    /// Metres.
    pub(super) positions: Vec<DVec3>,
    pub(super) faces: Vec<WrittenTriangle>,
    /// Where it is; the translation is in metres.
    pub(super) items: Vec<DAffine3>,
    /// Names of others that show it.
    other_names: usize,
    /// Of its edges.
    open: usize,
}

/// A triangle.
pub(super) struct WrittenTriangle {
    pub(super) vertices: [u32; 3],
    /// By the mesh's numbers.
    pub(super) corners: [u32; 3],
    /// The face of the mesh that it is part of.
    pub(super) source: u32,
}

impl Resource<'_> {
    pub(super) fn name(&self) -> &str {
        &self.object.node.name
    }

    /// What other programs will miss.
    pub(super) fn losses(&self) -> impl Iterator<Item = Loss> {
        let open = (self.open > 0).then(|| {
            let edges = counted(self.open, "edge");
            format!("a closed body: {edges} of its triangles are open, and a slicer may refuse or mend it")
        });
        let names = (self.other_names > 0)
            .then(|| format!("{} of its copies: an object has one", counted(self.other_names, "name")));
        let location = Location::Named(format!("node \"{}\"", self.name()));
        open.into_iter().chain(names).map(move |what| Loss { location: location.clone(), what })
    }
}

/// The objects of the file, in the order of the nodes.
pub(super) fn resources<'g>(gathered: &'g Gathered<'_>) -> Vec<Resource<'g>> {
    let mut known: BTreeMap<(MeshId, &[MaterialId]), usize> = BTreeMap::new();
    let mut resources: Vec<Resource<'g>> = Vec::new();
    for object in gathered.objects.iter().filter(|object| !object.face_sizes.is_empty()) {
        // A mirroring transform turns the surface inside out for some readers, and one that flattens is not allowed.
        let can_be_item = object.map().matrix3.determinant() > 0.0;
        let key = object.node.mesh.map(|mesh| (mesh, object.node.materials.as_slice()));
        if !can_be_item {
            let bake = |vertex| gathered.position(object, vertex);
            resources.push(resource(object, DAffine3::IDENTITY, bake));
        } else if let Some(&index) = key.as_ref().and_then(|key| known.get(key)) {
            let first = &mut resources[index];
            first.items.push(object.map());
            first.other_names += usize::from(object.node.name != first.object.node.name);
        } else {
            known.extend(key.map(|key| (key, resources.len())));
            let local = |vertex: u32| object.mesh.positions()[vertex as usize].as_dvec3();
            resources.push(resource(object, object.map(), local));
        }
    }
    resources
}

fn resource<'g>(object: &'g Object<'g>, item: DAffine3, position: impl Fn(u32) -> DVec3) -> Resource<'g> {
    let faces = || {
        object.faces().zip(&object.sources).map(|(face, &source)| {
            let corners = [face[0], face[1], face[2]];
            WrittenTriangle { vertices: corners.map(|corner| object.vertex(corner)), corners, source }
        })
    };
    let mut faces: Vec<WrittenTriangle> = faces().collect();
    let triangles: Vec<[u32; 3]> = faces.iter().map(|face| face.vertices).collect();
    let mut open = open_edges(&triangles);
    if open > 0 {
        open = weld(&mut faces, &position, open);
    }
    let positions = number_anew(&mut faces, position);
    Resource { object, positions, faces, items: vec![item], other_names: 0, open }
}

/// Unites vertices at the same position, if fewer edges are open then. How many are.
fn weld(faces: &mut Vec<WrittenTriangle>, position: impl Fn(u32) -> DVec3, open: usize) -> usize {
    let mut firsts: HashMap<[u64; 3], u32> = HashMap::new();
    let mut first = |vertex: u32| {
        // Adding zero makes −0 and +0 the same.
        let bits = (position(vertex) + DVec3::ZERO).to_array().map(f64::to_bits);
        *firsts.entry(bits).or_insert(vertex)
    };
    let united: Vec<[u32; 3]> = faces.iter().map(|face| face.vertices.map(&mut first)).collect();
    let has_area = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let sound: Vec<[u32; 3]> = united.iter().copied().filter(has_area).collect();
    let after = open_edges(&sound);
    if after >= open {
        return open;
    }
    for (face, vertices) in faces.iter_mut().zip(&united) {
        face.vertices = *vertices;
    }
    faces.retain(|face| has_area(&face.vertices));
    after
}

/// Numbers the vertices of faces from 0 on, in the order of the mesh. Their positions.
fn number_anew(faces: &mut [WrittenTriangle], position: impl Fn(u32) -> DVec3) -> Vec<DVec3> {
    let mut used: Vec<u32> = faces.iter().flat_map(|face| face.vertices).collect();
    used.sort_unstable();
    used.dedup();
    let mut numbers = vec![0; used.last().map_or(0, |&last| last as usize + 1)];
    for (number, &vertex) in (0..).zip(&used) {
        numbers[vertex as usize] = number;
    }
    for face in faces {
        face.vertices = face.vertices.map(|vertex| numbers[vertex as usize]);
    }
    used.into_iter().map(position).collect()
}
