//! The values of elements, one by one: marks of edges, materials of faces, texture
//! coordinates and colours of corners.

use trigon_math::{Vec2, Vec3, Vec4};

use super::column::Column;
use super::edit_mesh::EditMesh;
use super::ids::{CornerId, EdgeId, FaceId, VertexId};
use super::layers::{Layer, LayerKind, LayerValues, Pins};
use super::records::{HIDDEN, SEAM, SHARP, SMOOTH};

/// Sets or clears one flag.
fn set_flag(flags: &mut u32, flag: u32, is_set: bool) {
    *flags = if is_set { *flags | flag } else { *flags & !flag };
}

impl EditMesh {
    /// Whether an edge stays sharp in smooth shading.
    #[must_use]
    pub fn is_sharp(&self, edge: EdgeId) -> bool {
        self.edges[edge.0].flags & SHARP != 0
    }

    /// Declares an edge sharp, or not.
    pub fn set_sharp(&mut self, edge: EdgeId, is_sharp: bool) {
        set_flag(&mut self.edges.write(edge.0).flags, SHARP, is_sharp);
    }

    /// Whether texture coordinates are cut at an edge when they are laid out.
    #[must_use]
    pub fn is_seam(&self, edge: EdgeId) -> bool {
        self.edges[edge.0].flags & SEAM != 0
    }

    /// Declares an edge a seam, or not.
    pub fn set_seam(&mut self, edge: EdgeId, is_seam: bool) {
        set_flag(&mut self.edges.write(edge.0).flags, SEAM, is_seam);
    }

    /// How sharp an edge stays in Catmull-Clark subdivision: 0 (smooth) to 1 (sharp).
    #[must_use]
    pub fn crease(&self, edge: EdgeId) -> f32 {
        self.edges[edge.0].crease
    }

    /// Sets how sharp an edge stays: 0 to 1. A value out of range is clamped, NaN is 0.
    pub fn set_crease(&mut self, edge: EdgeId, crease: f32) {
        self.edges.write(edge.0).crease = if crease > 0.0 { crease.min(1.0) } else { 0.0 };
    }

    /// The material slot of a face.
    #[must_use]
    pub fn material(&self, face: FaceId) -> u32 {
        self.faces[face.0].material
    }

    /// Sets the material slot of a face.
    pub fn set_material(&mut self, face: FaceId, material: u32) {
        self.faces.write(face.0).material = material;
    }

    /// Whether a face is shaded smoothly where its corners have no normals of their own.
    #[must_use]
    pub fn is_smooth(&self, face: FaceId) -> bool {
        self.faces[face.0].flags & SMOOTH != 0
    }

    /// Sets whether a face is shaded smoothly.
    pub fn set_smooth(&mut self, face: FaceId, is_smooth: bool) {
        set_flag(&mut self.faces.write(face.0).flags, SMOOTH, is_smooth);
    }

    /// Whether a vertex is hidden from the user.
    #[must_use]
    pub fn is_vertex_hidden(&self, vertex: VertexId) -> bool {
        self.vertices[vertex.0].flags & HIDDEN != 0
    }

    /// Hides a vertex, or shows it. Its edges and faces are for the caller.
    pub fn set_vertex_hidden(&mut self, vertex: VertexId, is_hidden: bool) {
        set_flag(&mut self.vertices.write(vertex.0).flags, HIDDEN, is_hidden);
    }

    /// Whether an edge is hidden from the user.
    #[must_use]
    pub fn is_edge_hidden(&self, edge: EdgeId) -> bool {
        self.edges[edge.0].flags & HIDDEN != 0
    }

    /// Hides an edge, or shows it. Its vertices and faces are for the caller.
    pub fn set_edge_hidden(&mut self, edge: EdgeId, is_hidden: bool) {
        set_flag(&mut self.edges.write(edge.0).flags, HIDDEN, is_hidden);
    }

    /// Whether a face is hidden from the user.
    #[must_use]
    pub fn is_face_hidden(&self, face: FaceId) -> bool {
        self.faces[face.0].flags & HIDDEN != 0
    }

    /// Hides a face, or shows it. Its edges and vertices are for the caller.
    pub fn set_face_hidden(&mut self, face: FaceId, is_hidden: bool) {
        set_flag(&mut self.faces.write(face.0).flags, HIDDEN, is_hidden);
    }

    /// How many sets of texture coordinates there are.
    #[must_use]
    pub fn uv_set_count(&self) -> usize {
        self.corner_layers.iter().filter(|layer| layer.kind == LayerKind::Uv).count()
    }

    /// The texture coordinates of a corner in one of the sets; `None` where there is no such set.
    #[must_use]
    pub fn uv(&self, set: usize, corner: CornerId) -> Option<Vec2> {
        let mut sets = self.corner_layers.iter().filter(|layer| layer.kind == LayerKind::Uv);
        match &sets.nth(set)?.values {
            LayerValues::Vec2(column) => Some(column[corner.0]),
            _ => None,
        }
    }

    /// Sets the texture coordinates of a corner in one of the sets; nothing happens where there is
    /// no such set.
    pub fn set_uv(&mut self, set: usize, corner: CornerId, uv: Vec2) {
        let mut sets = self.corner_layers.iter_mut().filter(|layer| layer.kind == LayerKind::Uv);
        if let Some(LayerValues::Vec2(column)) = sets.nth(set).map(|layer| &mut layer.values) {
            *column.write(corner.0) = uv;
        }
    }

    /// Whether the texture coordinates of a corner are pinned in a set: unwrapping leaves them where they are.
    #[must_use]
    pub fn is_uv_pinned(&self, set: usize, corner: CornerId) -> bool {
        set < Self::MOST_PINNED_SETS && self.pins().is_some_and(|pins| pins[corner.0].0 >> set & 1 != 0)
    }

    /// Pins the texture coordinates of a corner in a set, or frees them; nothing happens from the set
    /// [`Self::MOST_PINNED_SETS`] on.
    pub fn set_uv_pinned(&mut self, set: usize, corner: CornerId, is_pinned: bool) {
        if set < Self::MOST_PINNED_SETS && self.is_uv_pinned(set, corner) != is_pinned {
            set_flag(&mut self.pins_mut().write(corner.0).0, 1 << set, is_pinned);
        }
    }

    /// In how many sets of texture coordinates corners can be pinned.
    pub const MOST_PINNED_SETS: usize = 32;

    /// The pins by corner, if there were ever any.
    pub(super) fn pins(&self) -> Option<&Column<Pins>> {
        self.corner_layers.iter().find_map(|layer| match &layer.values {
            LayerValues::Pins(column) => Some(column),
            _ => None,
        })
    }

    /// The same for writing: the layer is added where it is missing.
    pub(super) fn pins_mut(&mut self) -> &mut Column<Pins> {
        if self.pins().is_none() {
            let values = LayerValues::Pins(Column::new(vec![Pins::default(); self.corner_capacity()]));
            self.corner_layers.push(Layer { kind: LayerKind::Pins, values });
        }
        let found = self.corner_layers.iter_mut().find_map(|layer| match &mut layer.values {
            LayerValues::Pins(column) => Some(column),
            _ => None,
        });
        found.expect("it was added")
    }

    /// The colour of a corner: linear light, straight alpha; `None` where the mesh has no colours.
    #[must_use]
    pub fn color(&self, corner: CornerId) -> Option<Vec4> {
        let layer = self.corner_layers.iter().find(|layer| layer.kind == LayerKind::Color)?;
        match &layer.values {
            LayerValues::Vec4(column) => Some(column[corner.0]),
            _ => None,
        }
    }

    /// Sets the colour of a corner; nothing happens where the mesh has no colours.
    pub fn set_color(&mut self, corner: CornerId, color: Vec4) {
        let layer = self.corner_layers.iter_mut().find(|layer| layer.kind == LayerKind::Color);
        if let Some(LayerValues::Vec4(column)) = layer.map(|layer| &mut layer.values) {
            *column.write(corner.0) = color;
        }
    }

    /// The normal that was given for a corner; `None` where none was.
    #[must_use]
    pub fn custom_normal(&self, corner: CornerId) -> Option<Vec3> {
        let layer = self.corner_layers.iter().find(|layer| layer.kind == LayerKind::Normal)?;
        match &layer.values {
            LayerValues::Vec3(column) => Some(column[corner.0]).filter(|&normal| normal != Vec3::ZERO),
            _ => None,
        }
    }

    /// Gives a corner a normal, or none (zero); nothing happens where the mesh has no normals.
    pub fn set_custom_normal(&mut self, corner: CornerId, normal: Vec3) {
        let layer = self.corner_layers.iter_mut().find(|layer| layer.kind == LayerKind::Normal);
        if let Some(LayerValues::Vec3(column)) = layer.map(|layer| &mut layer.values) {
            *column.write(corner.0) = normal;
        }
    }

    /// Gives a corner all values of another: texture coordinates, colour, normal.
    pub fn copy_corner(&mut self, from: CornerId, to: CornerId) {
        for layer in &mut self.corner_layers {
            layer.copy(from.0, to.0);
        }
    }

    /// Gives a corner of a face that stands upright on another what both share there: texture
    /// coordinates and colour, but no directions.
    pub(crate) fn copy_corner_upright(&mut self, from: CornerId, to: CornerId) {
        for layer in self.corner_layers.iter_mut().filter(|layer| !layer.kind.is_direction()) {
            layer.copy(from.0, to.0);
        }
    }

    /// Gives a corner the weighted mean of all values of others; weights sum to 1.
    pub(crate) fn blend_corner(&mut self, parts: &[(CornerId, f64)], to: CornerId) {
        if self.corner_layers.is_empty() {
            return;
        }
        let parts: smallvec::SmallVec<[(u32, f64); 8]> =
            parts.iter().map(|&(corner, weight)| (corner.0, weight)).collect();
        for layer in &mut self.corner_layers {
            layer.blend(&parts, to.0);
        }
    }

    /// Gives a vertex all values of another but its place: skin weights, morph targets.
    pub(crate) fn copy_vertex(&mut self, from: VertexId, to: VertexId) {
        for layer in &mut self.vertex_layers {
            layer.copy(from.0, to.0);
        }
        self.vertices.write(to.0).flags = self.vertices[from.0].flags;
    }

    /// Gives a vertex the weighted mean of all values of others but their places; weights sum
    /// to 1. The first position is theirs, too.
    pub(crate) fn blend_vertex(&mut self, parts: &[(VertexId, f64)], to: VertexId) {
        let mut first = trigon_math::DVec3::ZERO;
        for &(vertex, weight) in parts {
            first += self.first_positions[vertex.0].as_dvec3() * weight;
        }
        *self.first_positions.write(to.0) = first.as_vec3();
        if self.vertex_layers.is_empty() {
            return;
        }
        let parts: smallvec::SmallVec<[(u32, f64); 8]> =
            parts.iter().map(|&(vertex, weight)| (vertex.0, weight)).collect();
        for layer in &mut self.vertex_layers {
            layer.blend(&parts, to.0);
        }
    }

    /// Gives an edge the marks of another: sharp, seam, crease, hidden.
    pub(crate) fn copy_edge(&mut self, from: EdgeId, to: EdgeId) {
        let (flags, crease) = (self.edges[from.0].flags, self.edges[from.0].crease);
        let record = self.edges.write(to.0);
        record.flags = flags;
        record.crease = crease;
    }

    /// Adds the marks of one edge to those of another that takes its place.
    pub(crate) fn unite_edge_marks(&mut self, from: EdgeId, into: EdgeId) {
        let (flags, crease) = (self.edges[from.0].flags, self.edges[from.0].crease);
        let record = self.edges.write(into.0);
        record.flags |= flags & (SHARP | SEAM);
        if crease > record.crease {
            record.crease = crease;
        }
    }

    /// Reveals edges and vertices of a face in view: it may have come to those of hidden faces.
    pub(crate) fn reveal_outline(&mut self, face: FaceId) {
        if self.is_face_hidden(face) {
            return;
        }
        let mut corner = CornerId(self.faces[face.0].corner);
        for _ in 0..self.face_size(face) {
            let (vertex, edge) = (self.corner_vertex(corner), self.corner_edge(corner));
            if self.is_edge_hidden(edge) {
                self.set_edge_hidden(edge, false);
            }
            if self.is_vertex_hidden(vertex) {
                self.set_vertex_hidden(vertex, false);
            }
            corner = self.next_corner(corner);
        }
    }

    /// Gives a face the values of another: material, smooth, hidden.
    pub(crate) fn copy_face(&mut self, from: FaceId, to: FaceId) {
        let (material, flags) = (self.faces[from.0].material, self.faces[from.0].flags);
        let record = self.faces.write(to.0);
        record.material = material;
        record.flags = flags;
    }
}
