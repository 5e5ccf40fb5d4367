//! Converts a mesh that is shown and saved to an editable one.

use smallvec::SmallVec;
use trigon_math::Vec3;
use trigon_mesh::{Attributes, Deltas, Mesh, SkinWeights};

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::euler::is_simple;
use super::ids::{CornerId, FaceId, NONE, VertexId};
use super::layers::{Layer, LayerKind, LayerValues};
use super::records::{ALIVE, CornerRecord, EdgeRecord, FaceRecord, POINT, SMOOTH, Slots, VertexRecord};
use super::skin::Influences;

/// What of a mesh has no place in one that is edited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct LeftOut {
    /// Corners at the same vertex as the next corner of their face.
    pub repeated_corners: usize,
    /// Faces that visited a vertex twice, and became simple ones: as they have a hole at the end of a bridge, touch
    /// themselves or run along an edge and back.
    pub cut_faces: usize,
    /// Vertices that follow more joints than are kept: the lightest are left out.
    pub skinned_vertices: usize,
}

impl LeftOut {
    /// What a user should know, for a mesh of this name: a line for each kind.
    pub fn warnings(&self, mesh: &str) -> impl Iterator<Item = String> {
        let corners = (self.repeated_corners > 0).then(|| {
            let count = self.repeated_corners;
            format!("{mesh}: corners at the same vertex as the next one are left out: {count}")
        });
        let skinned = (self.skinned_vertices > 0).then(|| {
            let count = self.skinned_vertices;
            format!(
                "{mesh}: of more than eight joints at a vertex the lightest are left out, at {count} vertices"
            )
        });
        let cut = (self.cut_faces > 0).then(|| {
            let count = self.cut_faces;
            format!("{mesh}: faces that visit a vertex twice are cut into ones that do not: {count}")
        });
        corners.into_iter().chain(cut).chain(skinned)
    }
}

impl EditMesh {
    /// Makes a mesh editable. Vertices, edges, faces and corners keep their numbers as indices,
    /// and each vertex can be reset to where it is now.
    ///
    /// A corner at the same vertex as the next of its face is left out: nothing would tell which
    /// edge is between them. A face that visits a vertex twice is cut into faces that do not, or goes if it encloses
    /// nothing; the first one keeps its number, the others come after all faces. Of the joints that a vertex follows the heaviest eight are kept.
    pub fn from_mesh(mesh: &Mesh) -> (Self, LeftOut) {
        let (mut editable, mut left_out) = Self::from_mesh_uncut(mesh);
        left_out.cut_faces = editable.make_all_simple();
        (editable, left_out)
    }

    /// The same, but faces may visit vertices twice.
    pub(super) fn from_mesh_uncut(mesh: &Mesh) -> (Self, LeftOut) {
        let mut left_out = LeftOut::default();
        let mut editable = Self::new();
        editable.add_vertices(mesh);
        editable.add_edges(mesh);
        editable.add_faces(mesh);
        editable.vertex_layers = vertex_layers(mesh, &mut left_out);
        editable.corner_layers = corner_layers(mesh.attributes(), mesh.corner_count());
        left_out.repeated_corners = mesh.corner_count() - editable.corner_count();
        (editable, left_out)
    }

    /// Makes simple faces of those that visit a vertex twice. Returns how many did.
    pub(super) fn make_all_simple(&mut self) -> usize {
        let mut count = 0;
        for face in (0..self.faces.len()).map(FaceId) {
            let vertices: SmallVec<[VertexId; 8]> = self.face_vertices(face).collect();
            if !is_simple(&vertices) {
                count += 1;
                let corners: SmallVec<[CornerId; 8]> = self.face_corners(face).collect();
                self.lay_simple_parts(face, &corners, &vertices);
            }
        }
        count
    }

    fn add_vertices(&mut self, mesh: &Mesh) {
        let mut records = vec![VertexRecord { edge: NONE, flags: ALIVE }; mesh.vertex_count()];
        for &point in mesh.loose_points() {
            records[point as usize].flags |= POINT;
        }
        self.slots.vertices = Slots { free: NONE, alive: records.len() as u32 };
        self.vertices = Column::with_spare_capacity(records.into_iter());
        self.positions = Column::with_spare_capacity(mesh.positions().iter().copied());
        self.first_positions = Column::with_spare_capacity(mesh.positions().iter().copied());
    }

    fn add_edges(&mut self, mesh: &Mesh) {
        let ends = mesh.edges();
        let record = |&vertices: &[u32; 2]| EdgeRecord {
            vertices,
            next: [NONE; 2],
            previous: [NONE; 2],
            corner: NONE,
            crease: 0.0,
            flags: ALIVE,
        };
        self.edges = Column::with_spare_capacity(ends.iter().map(record));
        self.slots.edges = Slots { free: NONE, alive: ends.len() as u32 };
        for edge in 0..ends.len() as u32 {
            self.link_at_vertex(edge, 0);
            self.link_at_vertex(edge, 1);
        }
    }

    fn add_faces(&mut self, mesh: &Mesh) {
        let attributes = mesh.attributes();
        let mut corners = Vec::with_capacity(mesh.corner_count() + mesh.corner_count() / 8);
        let mut faces = Vec::with_capacity(mesh.face_count() + mesh.face_count() / 8);
        for (face, range) in mesh.faces().enumerate() {
            let smooth = attributes.face_smooth.as_ref().is_some_and(|smooth| smooth[face]);
            faces.push(FaceRecord {
                corner: range.start as u32,
                size: range.len() as u32,
                material: attributes.face_materials.as_ref().map_or(0, |materials| materials[face]),
                flags: ALIVE | if smooth { SMOOTH } else { 0 },
            });
            for corner in range.clone() {
                corners.push(CornerRecord {
                    vertex: mesh.corner_vertices()[corner],
                    edge: mesh.corner_edge(corner).unwrap_or(NONE),
                    face: face as u32,
                    next: if corner + 1 == range.end { range.start } else { corner + 1 } as u32,
                    previous: if corner == range.start { range.end - 1 } else { corner - 1 } as u32,
                    radial_next: NONE,
                    radial_previous: NONE,
                });
            }
        }
        self.slots.faces = Slots { free: NONE, alive: faces.len() as u32 };
        self.slots.corners = Slots { free: NONE, alive: corners.len() as u32 };
        self.corners = Column::new(corners);
        self.faces = Column::new(faces);
        for corner in 0..self.corners.len() {
            match self.corners[corner].edge {
                NONE => self.leave_out(corner),
                edge => self.link_at_edge(corner, edge),
            }
        }
    }

    /// Frees a corner without an edge.
    fn leave_out(&mut self, corner: u32) {
        let record = self.corners[corner];
        self.link_in_face(record.previous, record.next);
        let face = self.faces.write(record.face);
        face.size -= 1;
        if face.corner == corner {
            face.corner = record.next;
        }
        self.free_corner(corner);
    }
}

fn corner_layers(attributes: &Attributes, corners: usize) -> Vec<Layer> {
    let mut layers = Vec::new();
    let mut add = |kind, values| layers.push(Layer { kind, values });
    for set in &attributes.uv_sets {
        add(LayerKind::Uv, LayerValues::Vec2(Column::with_spare_capacity(set.iter().copied())));
    }
    if let Some(colors) = &attributes.corner_colors {
        add(LayerKind::Color, LayerValues::Vec4(Column::with_spare_capacity(colors.iter().copied())));
    }
    if let Some(normals) = &attributes.corner_normals {
        add(LayerKind::Normal, LayerValues::Vec3(Column::with_spare_capacity(normals.iter().copied())));
    }
    if let Some(tangents) = &attributes.corner_tangents {
        add(LayerKind::Tangent, LayerValues::Vec4(Column::with_spare_capacity(tangents.iter().copied())));
    }
    for (number, target) in (0u16..).zip(&attributes.morph_targets) {
        if !target.normals.is_empty() {
            add(LayerKind::MorphNormal(number), dense(&target.normals, corners));
        }
        if !target.tangents.is_empty() {
            add(LayerKind::MorphTangent(number), dense(&target.tangents, corners));
        }
    }
    layers
}

fn vertex_layers(mesh: &Mesh, left_out: &mut LeftOut) -> Vec<Layer> {
    let attributes = mesh.attributes();
    let mut layers = Vec::new();
    if let Some(skin) = &attributes.skin {
        layers.push(Layer { kind: LayerKind::Skin, values: influences(skin, left_out) });
    }
    if let Some(colors) = &attributes.vertex_colors {
        let values = LayerValues::Vec4(Column::with_spare_capacity(colors.iter().copied()));
        layers.push(Layer { kind: LayerKind::Color, values });
    }
    for (number, target) in (0u16..).zip(&attributes.morph_targets) {
        let values = dense(&target.positions, mesh.vertex_count());
        layers.push(Layer { kind: LayerKind::MorphPosition(number), values });
    }
    layers
}

fn dense(deltas: &Deltas, count: usize) -> LayerValues {
    let mut values = vec![Vec3::ZERO; count];
    for (index, value) in deltas.iter() {
        values[index as usize] = value;
    }
    LayerValues::Vec3(Column::with_spare_capacity(values.into_iter()))
}

fn influences(skin: &SkinWeights, left_out: &mut LeftOut) -> LayerValues {
    let of_vertex = |vertex: usize| {
        let mut all: Vec<(u16, f64)> = Vec::new();
        for (joint, weight) in skin.influences(vertex).filter(|&(_, weight)| weight > 0.0) {
            match all.iter_mut().find(|(known, _)| *known == joint) {
                Some((_, sum)) => *sum += f64::from(weight),
                None => all.push((joint, f64::from(weight))),
            }
        }
        left_out.skinned_vertices += usize::from(all.len() > super::skin::MOST);
        Influences::heaviest(all)
    };
    LayerValues::Influences(Column::with_spare_capacity((0..skin.vertex_count()).map(of_vertex)))
}

#[cfg(test)]
mod tests {

    use trigon_math::Vec4;

    use super::*;

    /// A line from a black vertex to a white one.
    fn colored_line() -> Mesh {
        let mut line = trigon_mesh::primitives::polyline(&[Vec3::ZERO, Vec3::X]);
        let vertex_colors = Some(vec![Vec4::W, Vec4::ONE]);
        line.set_attributes(Attributes { vertex_colors, ..Attributes::default() }).expect("one for each");
        line
    }

    #[test]
    fn colours_of_lines_and_points_are_edited_along() {
        let line = colored_line();
        let (mut mesh, _) = EditMesh::from_mesh(&line);
        assert_eq!(mesh.to_mesh().0, line, "the same again");
        mesh.split_edge(crate::EdgeId::new(0), 0.25).expect("an edge");
        mesh.add_vertex(Vec3::Y).expect("there is room");
        let colors = mesh.to_mesh().0.attributes().vertex_colors.clone();
        let quarter = Vec3::splat(0.25).extend(1.0);
        assert_eq!(
            colors,
            Some(vec![Vec4::W, Vec4::ONE, quarter, Vec4::ONE]),
            "a mean, and white without any"
        );
    }

    #[test]
    fn each_kind_of_what_is_left_out_has_a_warning_and_what_is_not_has_none() {
        let warnings = |repeated_corners, cut_faces, skinned_vertices| -> Vec<String> {
            LeftOut { repeated_corners, cut_faces, skinned_vertices }.warnings("cloth").collect()
        };
        assert!(warnings(0, 0, 0).is_empty(), "nothing was left out");
        let [corners, cut, skinned] = [warnings(3, 0, 0), warnings(0, 4, 0), warnings(0, 0, 5)];
        assert!(cut.len() == 1 && cut[0].starts_with("cloth") && cut[0].contains('4'), "{cut:?}");
        assert!(
            corners.len() == 1 && corners[0].starts_with("cloth") && corners[0].contains('3'),
            "{corners:?}"
        );
        assert!(
            skinned.len() == 1 && skinned[0].starts_with("cloth") && skinned[0].contains('5'),
            "{skinned:?}"
        );
        assert_eq!(warnings(3, 4, 5), [corners, cut, skinned].concat(), "all");
    }
}
