//! Runs one modifier on a mesh: calls the operations that commands call, on all elements.

use trigon_math::{DAffine3, DVec3, Plane, elementary};

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::layers::{LayerKind, LayerValues};
use crate::modifier::{
    ArrayModifier, BevelModifier, BeveledEdges, BooleanModifier, DecimateSettings, MirrorModifier, Modifier,
    ScrewModifier, SolidifySettings, SubdivisionModifier, TriangulateModifier,
};
use crate::operations::{BevelSettings, BooleanTool, SpinSettings};
use crate::refusal::Refusal;
use crate::stack::objects::{ModifierObjects, NoObjects};

/// A modifier names an object that is not there, or has no mesh.
const NO_OBJECT: Refusal = Refusal::NotPossible {
    operation: "a modifier with another object",
    reason: "there is no other object of this name, or it has no mesh: choose one",
};

impl EditMesh {
    /// Changes the mesh as a modifier says; not at all where there is nothing for it to do. If it is refused half way, the
    /// caller restores the mesh.
    pub(super) fn modify(
        &mut self,
        modifier: &Modifier,
        objects: &dyn ModifierObjects,
    ) -> Result<(), Refusal> {
        modifier.check()?;
        match modifier {
            Modifier::Subdivision(settings) => self.modify_by_subdivision(settings),
            Modifier::Mirror(settings) => self.modify_by_mirror(settings),
            Modifier::Array(settings) => self.modify_by_array(settings, objects),
            Modifier::Solidify(settings) => self.modify_by_solidify(settings),
            Modifier::Bevel(settings) => self.modify_by_bevel(settings),
            Modifier::Weld(settings) => self.weld(settings.distance),
            Modifier::Triangulate(settings) => self.modify_by_triangles(settings),
            Modifier::Decimate(settings) => self.modify_by_decimate(settings),
            Modifier::Screw(settings) => self.modify_by_screw(settings),
            Modifier::Boolean(settings) => self.modify_by_boolean(settings, objects),
        }
    }

    fn modify_by_subdivision(&mut self, settings: &SubdivisionModifier) -> Result<(), Refusal> {
        if self.face_count() == 0 { Ok(()) } else { self.catmull_clark(settings.levels) }
    }

    fn modify_by_mirror(&mut self, settings: &MirrorModifier) -> Result<(), Refusal> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        for (axis, _) in axes.into_iter().zip(settings.axes).filter(|(_, is_mirrored)| *is_mirrored) {
            self.modify_by_mirror_along(if settings.flip { -axis } else { axis }, settings)?;
        }
        Ok(())
    }

    fn modify_by_mirror_along(&mut self, normal: DVec3, settings: &MirrorModifier) -> Result<(), Refusal> {
        let plane = Plane::from_point_and_normal(DVec3::ZERO, normal).expect("an axis is a direction");
        let faces: Vec<FaceId> = self.faces().collect();
        let edges: Vec<EdgeId> = self.edges().collect();
        let mut copies = Vec::new();
        if settings.bisect && !faces.is_empty() {
            let halves = self.symmetrize(&faces, &plane, settings.merge_distance.unwrap_or(0.0))?;
            copies = halves.mirrored.faces;
        } else if !faces.is_empty() || !edges.is_empty() {
            copies = self.mirror_copy(&faces, &edges, &plane, settings.merge_distance)?.faces;
        }
        if settings.mirror_u || settings.mirror_v {
            self.mirror_uvs(&copies, [settings.mirror_u, settings.mirror_v]);
        }
        Ok(())
    }

    fn mirror_uvs(&mut self, faces: &[FaceId], axes: [bool; 2]) {
        let corners: Vec<u32> =
            faces.iter().flat_map(|&face| self.face_corners(face)).map(|corner| corner.0).collect();
        for layer in self.corner_layers.iter_mut().filter(|layer| layer.kind == LayerKind::Uv) {
            let LayerValues::Vec2(column) = &mut layer.values else { continue };
            for &corner in &corners {
                let uv = column.write(corner);
                uv.x = if axes[0] { 1.0 - uv.x } else { uv.x };
                uv.y = if axes[1] { 1.0 - uv.y } else { uv.y };
            }
        }
    }

    fn modify_by_array(
        &mut self,
        settings: &ArrayModifier,
        objects: &dyn ModifierObjects,
    ) -> Result<(), Refusal> {
        let offset = DVec3::from(settings.offset) + DVec3::from(settings.relative_offset) * self.extent();
        let original = self.clone();
        let other = match settings.object.as_str() {
            "" => None,
            name => Some(objects.state(name).ok_or(NO_OBJECT)?.transform),
        };
        let mut turned = DAffine3::IDENTITY;
        for number in 1..settings.count {
            let transform = match other {
                // Computed anew for each, so that nothing is rounded twice.
                None => DAffine3::from_translation(offset * f64::from(number)),
                Some(other) => {
                    turned = turned * DAffine3::from_translation(offset) * other;
                    turned
                }
            };
            self.join_mesh(&original, &transform)?;
        }
        settings.merge_distance.map_or(Ok(()), |distance| self.weld(distance))
    }

    /// The size of its bounding box along each axis, in metres; positions that are not finite do not count.
    fn extent(&self) -> DVec3 {
        let points = || self.vertices().map(|vertex| self.point(vertex)).filter(|point| point.is_finite());
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        if low.x <= high.x { high - low } else { DVec3::ZERO }
    }

    fn weld(&mut self, distance: f64) -> Result<(), Refusal> {
        let vertices: Vec<VertexId> = self.vertices().collect();
        if vertices.is_empty() { Ok(()) } else { self.merge_by_distance(&vertices, distance).map(drop) }
    }

    fn modify_by_solidify(&mut self, settings: &SolidifySettings) -> Result<(), Refusal> {
        let faces: Vec<FaceId> = self.faces().collect();
        if faces.is_empty() { Ok(()) } else { self.solidify_faces(&faces, settings).map(drop) }
    }

    fn modify_by_bevel(&mut self, settings: &BevelModifier) -> Result<(), Refusal> {
        self.limiting_group(&settings.group)?;
        let edges = self.edges_to_bevel(settings);
        if edges.is_empty() {
            return Ok(());
        }
        let of_operation = BevelSettings {
            width: settings.width,
            segments: settings.segments as usize,
            profile: settings.profile,
            clamp_overlap: settings.clamp_overlap,
            harden_normals: settings.harden_normals,
            ..BevelSettings::default()
        };
        match self.bevel_edges(&edges, &of_operation) {
            // None of them is one that can be beveled.
            Ok(_) | Err(Refusal::NotPossible { .. }) => Ok(()),
            Err(refusal) => Err(refusal),
        }
    }

    /// The edges that a bevel replaces if it can.
    pub(super) fn edges_to_bevel(&self, settings: &BevelModifier) -> Vec<EdgeId> {
        let mut edges = self.edges_of_kind(settings);
        if let Some(group) = self.vertex_group(&settings.group) {
            let is_in = |vertex: VertexId| group.factor(vertex, settings.invert_group) >= 0.5;
            edges.retain(|&edge| self.edge_vertices(edge).into_iter().all(is_in));
        }
        edges
    }

    fn edges_of_kind(&self, settings: &BevelModifier) -> Vec<EdgeId> {
        match settings.edges {
            BeveledEdges::Angle => self.edges_by_angle(settings.angle.to_radians()),
            BeveledEdges::Sharp => self.edges().filter(|&edge| self.is_sharp(edge)).collect(),
            BeveledEdges::Creased => self.edges().filter(|&edge| self.crease(edge) > 0.0).collect(),
            BeveledEdges::All => self.edges().collect(),
        }
    }

    /// Edges that are marked sharp, and edges between two faces whose directions differ by more than an angle (in radians).
    #[must_use]
    pub fn edges_by_angle(&self, angle: f64) -> Vec<EdgeId> {
        let least = elementary::cos(angle);
        let is_sharp = |&edge: &EdgeId| {
            let between = self.edge_pair(edge).map(|pair| pair.map(|corner| self.corner_face(corner)));
            let differs = |[a, b]: [FaceId; 2]| self.face_normal(a).dot(self.face_normal(b)) < least;
            self.is_sharp(edge) || between.is_some_and(differs)
        };
        self.edges().filter(is_sharp).collect()
    }

    fn modify_by_decimate(&mut self, settings: &DecimateSettings) -> Result<(), Refusal> {
        let faces: Vec<FaceId> = self.faces().collect();
        if faces.is_empty() { Ok(()) } else { self.decimate(&faces, settings).map(drop) }
    }

    fn modify_by_screw(&mut self, settings: &ScrewModifier) -> Result<(), Refusal> {
        let &ScrewModifier { axis, angle, steps, height, turns } = settings;
        let angle = angle.to_radians();
        let of_operation = SpinSettings { center: [0.0; 3], axis, angle, steps, height, turns };
        let (edges, vertices) = (self.edges_to_sweep(), self.vertices_to_sweep());
        if edges.is_empty() && vertices.is_empty() {
            return Ok(());
        }
        self.spin(&edges, &vertices, &of_operation).map(drop)
    }

    /// The edges that are not between faces.
    pub(super) fn edges_to_sweep(&self) -> Vec<EdgeId> {
        self.edges().filter(|&edge| self.edge_corners(edge).nth(1).is_none()).collect()
    }

    /// The vertices without edges.
    pub(super) fn vertices_to_sweep(&self) -> Vec<VertexId> {
        self.vertices().filter(|&vertex| self.vertex_edges(vertex).next().is_none()).collect()
    }

    fn modify_by_boolean(
        &mut self,
        settings: &BooleanModifier,
        objects: &dyn ModifierObjects,
    ) -> Result<(), Refusal> {
        if settings.object.is_empty() {
            return Ok(());
        }
        let state = objects.state(&settings.object);
        let Some((state, mesh)) = state.zip(objects.mesh(&settings.object)) else {
            return Err(NO_OBJECT);
        };
        // Its own booleans are left out, so that two objects may use each other.
        let evaluated = mesh.evaluated(&NoObjects)?;
        let tool = BooleanTool { mesh: evaluated.as_ref().unwrap_or(&mesh), transform: state.transform };
        self.boolean(&[tool], settings.operation).map(drop)
    }

    fn modify_by_triangles(&mut self, settings: &TriangulateModifier) -> Result<(), Refusal> {
        let is_large = |face: &FaceId| self.face_size(*face) >= settings.least_corners as usize;
        let faces: Vec<FaceId> = self.faces().filter(is_large).collect();
        if faces.is_empty() { Ok(()) } else { self.triangulate_faces(&faces).map(drop) }
    }
}
