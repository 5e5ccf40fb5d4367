//! Collects the visible meshes of a scene, transformed for a file. Corner values become vertex values for formats
//! without corner values.

use std::collections::{BTreeSet, HashMap};

use trigon_math::{DAffine3, DMat3, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::Mesh;
use trigon_scene::{MaterialId, Node, NodeId, Scene};

use super::{ExportOptions, FaceExport, Loss, Precision};
use crate::error::Location;
use crate::rebase::offset_for;
use crate::write::WriteError;

/// What to write.
pub(crate) struct Gathered<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) objects: Vec<Object<'a>>,
    /// The precision of positions.
    pub(crate) precision: Precision,
    pub(crate) losses: Vec<Loss>,
}

/// A mesh on a node.
pub(crate) struct Object<'a> {
    pub(crate) node: &'a Node,
    pub(crate) mesh: &'a Mesh,
    /// From the mesh's space to the file's.
    map: DAffine3,
    /// For normals; none if they stay as they are.
    normal_map: Option<DMat3>,
    /// The number of corners of each face that is written.
    pub(crate) face_sizes: Vec<u32>,
    /// The corners of these faces, by the mesh's numbers, counter-clockwise in the file.
    pub(crate) corners: Vec<u32>,
    /// The face of the mesh that each of these faces is, or is part of.
    pub(crate) sources: Vec<u32>,
}

impl<'a> Gathered<'a> {
    /// # Errors
    /// An object reaches farther than the numbers of files can say.
    pub(crate) fn new(scene: &'a Scene, options: &ExportOptions<'_>) -> Result<Self, WriteError> {
        let root = options.root(scene).unwrap_or(DAffine3::IDENTITY);
        let wanted: Option<BTreeSet<NodeId>> =
            options.nodes.as_ref().map(|nodes| nodes.iter().copied().collect());
        let is_wanted = |id: &NodeId| wanted.as_ref().is_none_or(|wanted| wanted.contains(id));
        let (visible, mut losses, mut objects) = (scene.visible_transforms(), Vec::new(), Vec::new());
        for (id, node) in scene.nodes().iter().filter(|(id, _)| is_wanted(id)) {
            let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
            let Some(world) = visible[id.index()] else {
                losses.push(Loss {
                    location: node_location(node),
                    what: "it is hidden and not written".to_owned(),
                });
                continue;
            };
            objects.push(Object::new(node, asset.mesh(), root * world, options.faces));
        }
        if let Some(object) = objects.iter().find(|object| object.overflows()) {
            return Err(WriteError::Overflow { node: object.node.name.clone() });
        }
        let positions = objects.iter().flat_map(|object| {
            (0..object.mesh.vertex_count() as u32).map(|vertex| object.exact_position(vertex))
        });
        let is_far = offset_for(positions) != DVec3::ZERO;
        let precision = if is_far { Precision::Double } else { Precision::Single };
        Ok(Self { scene, objects, precision, losses })
    }

    /// The position of a vertex in the file, finite and in the precision in which it is written.
    pub(crate) fn position(&self, object: &Object<'_>, vertex: u32) -> DVec3 {
        let position = object.exact_position(vertex).to_array().map(|value| self.precision.rounded(value));
        Some(DVec3::from_array(position)).filter(|position| position.is_finite()).unwrap_or_default()
    }
}

/// A node, for messages.
pub(super) fn node_location(node: &Node) -> Location {
    Location::Named(format!("node \"{}\"", node.name))
}

impl<'a> Object<'a> {
    fn new(node: &'a Node, mesh: &'a Mesh, map: DAffine3, faces: FaceExport) -> Self {
        let linear = map.matrix3;
        let normal_map = (linear != DMat3::IDENTITY).then(|| linear.inverse().transpose());
        let (face_sizes, corners, sources) = Default::default();
        let mut object = Self { node, mesh, map, normal_map, face_sizes, corners, sources };
        match faces {
            FaceExport::Polygons => {
                for (face, corners) in mesh.faces().enumerate() {
                    object.push(face as u32, corners.map(|corner| corner as u32));
                }
            }
            FaceExport::Triangles => object.cut(),
        }
        object
    }

    /// From the mesh's space to the file's.
    pub(crate) fn map(&self) -> DAffine3 {
        self.map
    }

    /// Triangulates the faces.
    pub(crate) fn cut(&mut self) {
        (self.face_sizes, self.corners, self.sources) = Default::default();
        let cut = self.mesh.triangulation();
        for (triangle, &face) in cut.triangles.iter().zip(&cut.triangle_faces) {
            self.push(face, triangle.iter().copied());
        }
    }

    /// Adds a face, unless a vertex has no valid position. A mirroring map flips faces, so their
    /// corners are reversed, starting with the same one.
    fn push(&mut self, face: u32, corners: impl ExactSizeIterator<Item = u32> + Clone) {
        let vertices = self.mesh.corner_vertices();
        let is_placed = |corner: u32| self.mesh.positions()[vertices[corner as usize] as usize].is_finite();
        if !corners.clone().all(is_placed) {
            return;
        }
        let (first, count) = (self.corners.len(), corners.len() as u32);
        self.corners.extend(corners);
        if self.map.matrix3.determinant() < 0.0 {
            self.corners[first + 1..].reverse();
        }
        self.face_sizes.push(count);
        self.sources.push(face);
    }

    /// The faces, each as its corners.
    pub(crate) fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let mut rest = self.corners.as_slice();
        self.face_sizes.iter().map(move |&size| {
            let (face, after) = rest.split_at(size as usize);
            rest = after;
            face
        })
    }

    /// The vertex of a corner.
    pub(crate) fn vertex(&self, corner: u32) -> u32 {
        self.mesh.corner_vertices()[corner as usize]
    }

    fn exact_position(&self, vertex: u32) -> DVec3 {
        let position = self.mesh.positions()[vertex as usize].as_dvec3();
        // The identity map keeps the sign of a zero.
        if self.map == DAffine3::IDENTITY { position } else { self.map.transform_point3(position) }
    }

    /// Whether a vertex that has a place has none in the file.
    fn overflows(&self) -> bool {
        let is_placed = |vertex: &u32| self.mesh.positions()[*vertex as usize].is_finite();
        let placed = (0..self.mesh.vertex_count() as u32).filter(is_placed);
        let fits = |position: DVec3| position.abs().max_element() <= f64::from(f32::MAX);
        placed
            .map(|vertex| self.exact_position(vertex))
            .any(|position| !(position.is_finite() && fits(position)))
    }

    /// The normal of a corner in the file; zero if there is none.
    pub(crate) fn normal(&self, corner: u32) -> Vec3 {
        let normals = self.mesh.attributes().corner_normals.as_ref();
        normals.map_or(Vec3::ZERO, |normals| self.turned(normals[corner as usize]))
    }

    /// Whether it has normals of its own, or smooth faces.
    pub(crate) fn is_shaded(&self) -> bool {
        let attributes = self.mesh.attributes();
        let normals = attributes.corner_normals.as_deref().unwrap_or_default();
        let smooth = attributes.face_smooth.as_deref().unwrap_or_default();
        normals.iter().any(|&normal| normal != Vec3::ZERO) || smooth.contains(&true)
    }

    /// A normal of the mesh in the file; zero if it has no direction there.
    pub(crate) fn turned(&self, normal: Vec3) -> Vec3 {
        let turned = self
            .normal_map
            .map_or(normal, |map| (map * normal.as_dvec3()).try_normalize().unwrap_or_default().as_vec3());
        if turned.is_finite() { turned } else { Vec3::ZERO }
    }

    /// The material of a face of the mesh.
    pub(crate) fn material(&self, face: u32) -> Option<MaterialId> {
        let slot = self.mesh.attributes().face_materials.as_ref().map_or(0, |slots| slots[face as usize]);
        self.node.materials.get(slot as usize).copied()
    }
}

/// Converts corner values to vertex values, for formats without corner values.
///
/// A vertex whose corners agree keeps its number. Where they differ, as at a seam or a sharp edge, additional
/// vertices at the same position follow after those of the object.
///
/// The values that vertices need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct VertexColumns {
    pub(crate) normals: bool,
    pub(crate) uvs: bool,
    pub(crate) colors: bool,
}

impl VertexColumns {
    /// Those of these that any object has.
    pub(crate) fn found(self, gathered: &Gathered<'_>) -> Self {
        let any = |has: fn(&Object<'_>) -> bool| gathered.objects.iter().any(has);
        Self {
            normals: self.normals && any(|object| object.is_shaded()),
            uvs: self.uvs && any(|object| !object.mesh.attributes().uv_sets.is_empty()),
            colors: self.colors && any(|object| object.mesh.attributes().has_colors()),
        }
    }
}

/// The values of a vertex. Values that are not requested keep those of `Default`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct VertexValues {
    pub(crate) normal: Vec3,
    pub(crate) uv: Vec2,
    /// Linear, with alpha.
    pub(crate) color: Vec4,
}

impl Default for VertexValues {
    fn default() -> Self {
        Self { normal: Vec3::ZERO, uv: Vec2::ZERO, color: Vec4::ONE }
    }
}

impl VertexValues {
    /// `normals` are those of the mesh's corners, or none of them.
    fn of(object: &Object<'_>, corner: u32, columns: VertexColumns, normals: &[Vec3]) -> Self {
        let (attributes, mut values) = (object.mesh.attributes(), Self::default());
        if let Some(&normal) = normals.get(corner as usize) {
            values.normal = object.turned(normal);
        }
        if let Some(uvs) = attributes.uv_sets.first().filter(|_| columns.uvs) {
            values.uv = Some(uvs[corner as usize]).filter(|uv| uv.is_finite()).unwrap_or_default();
        }
        if let Some(colors) = attributes.corner_colors.as_ref().filter(|_| columns.colors) {
            values.color = colors[corner as usize];
        }
        values
    }

    fn bits(&self) -> [u32; 9] {
        let Self { normal, uv, color } = self;
        [normal.x, normal.y, normal.z, uv.x, uv.y, color.x, color.y, color.z, color.w].map(f32::to_bits)
    }
}

/// The copies of an object's vertices, by the vertex and its other values.
type Others = HashMap<(u32, [u32; 9]), u32>;

/// The vertices of all objects, one object after the other.
#[derive(Default)]
pub(crate) struct ExportedVertices {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) values: Vec<VertexValues>,
    /// The vertices of all faces.
    pub(crate) corner_vertices: Vec<u32>,
    pub(crate) edges: Vec<[u32; 2]>,
    /// The number of repeated vertices.
    pub(crate) split: usize,
}

impl ExportedVertices {
    pub(crate) fn new(gathered: &Gathered<'_>, columns: VertexColumns) -> Self {
        let mut table = Self::default();
        for object in &gathered.objects {
            table.add(gathered, object, columns);
        }
        table
    }

    fn add(&mut self, gathered: &Gathered<'_>, object: &Object<'_>, columns: VertexColumns) {
        let base = self.positions.len();
        let count = object.mesh.vertex_count();
        self.positions.extend((0..count as u32).map(|vertex| gathered.position(object, vertex)));
        self.values.resize(base + count, VertexValues::default());
        let mut is_known = vec![false; count];
        // Such files know no smooth faces: their normals say it.
        let has_normals = columns.normals && object.is_shaded();
        let normals = if has_normals { object.mesh.shading_normals() } else { Vec::new() };
        let mut others = Others::new();
        for &corner in &object.corners {
            let vertex = object.vertex(corner);
            let values = VertexValues::of(object, corner, columns, &normals);
            if !std::mem::replace(&mut is_known[vertex as usize], true) {
                self.values[base + vertex as usize] = values;
            }
            let number = self.number(base, vertex, values, &mut others);
            self.corner_vertices.push(number);
        }
        let colors = object.mesh.attributes().vertex_colors.as_deref().filter(|_| columns.colors);
        for (vertex, color) in
            colors.into_iter().flatten().enumerate().filter(|(vertex, _)| !is_known[*vertex])
        {
            self.values[base + vertex].color = *color;
        }
        for &edge in object.mesh.loose_edges() {
            let edge = edge.map(|end| {
                let values = self.values[base + end as usize];
                let color = colors.map_or(values.color, |colors| colors[end as usize]);
                self.number(base, end, VertexValues { color, ..values }, &mut others)
            });
            self.edges.push(edge);
        }
    }

    /// The number of a vertex of an object with some values: its own if it has them, else that of a copy.
    fn number(&mut self, base: usize, vertex: u32, values: VertexValues, others: &mut Others) -> u32 {
        let own = base + vertex as usize;
        if self.values[own].bits() == values.bits() {
            return own as u32;
        }
        let next = self.positions.len() as u32;
        let number = *others.entry((vertex, values.bits())).or_insert(next);
        if number == next {
            self.positions.push(self.positions[own]);
            self.values.push(values);
            self.split += 1;
        }
        number
    }
}
