//! The start of a transform: the world positions of the selection, its axes, and the pivot, which is the
//! fixed point of rotations and scales.

use trigon_document::mesh::math::{DAffine3, DMat3, DVec3};
use trigon_document::modelling::{EdgeId, EditMesh, FaceId, VertexId};
use trigon_document::scene::MeshId;
use trigon_document::{Document, ElementKind, MeshSelection};

/// The selected vertices, or the origins of the selected objects, before anything moves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Selected {
    /// In the world.
    pub(crate) points: Vec<DVec3>,
    /// The middle of what was selected last.
    pub(crate) active: Option<DVec3>,
    /// The origin of the active object.
    pub(crate) origin: DVec3,
    /// The own axes of the active object, unit length, in columns.
    pub(crate) local: DMat3,
    /// z along the mean normal of what is selected; the own axes where there is none.
    pub(crate) normal: DMat3,
    /// Whether elements of meshes are selected.
    pub(crate) is_editing: bool,
}

impl Selected {
    /// What is selected in a document; `None` where nothing is.
    pub(crate) fn of(document: &Document) -> Option<Self> {
        let selected = Self::without_normal(document)?;
        let normal = mean_normal_in_world(document).try_normalize();
        Some(Self { normal: normal.map_or(selected.normal, axes_with_z), ..selected })
    }

    /// The same with the own axes instead of those along the normal, which takes a pass over all selected faces.
    pub(crate) fn without_normal(document: &Document) -> Option<Self> {
        let selected =
            if document.selection().is_editing() { of_elements(document) } else { of_objects(document) };
        Some(selected).filter(|selected| !selected.points.is_empty())
    }

    /// The mean of all points.
    pub(crate) fn median(&self) -> DVec3 {
        self.points.iter().sum::<DVec3>() / self.points.len() as f64
    }

    /// The middle of the box around all points.
    pub(crate) fn bounds_center(&self) -> DVec3 {
        let low = self.points.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let high = self.points.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        (low + high) * 0.5
    }
}

fn of_objects(document: &Document) -> Selected {
    let (scene, selection) = (document.nodes(), document.selection());
    let points: Vec<DVec3> =
        selection.objects.iter().map(|&object| scene.world_transform(object).translation).collect();
    let active = selection.active.filter(|active| selection.objects.contains(active));
    let placement = active
        .or(selection.objects.first().copied())
        .map_or(DAffine3::IDENTITY, |object| scene.world_transform(object));
    let local = unit_axes(&placement);
    Selected {
        points,
        active: active.map(|active| scene.world_transform(active).translation),
        origin: placement.translation,
        local,
        normal: local,
        is_editing: false,
    }
}

fn of_elements(document: &Document) -> Selected {
    let kind = document.selection().kind();
    let (mut points, mut active, mut placement) = (Vec::new(), None, None);
    for (id, selection) in document.selection().meshes() {
        let Some(mesh) = document.mesh(id).filter(|_| !selection.is_empty()) else { continue };
        let to_world = document.mesh_transform(id);
        placement.get_or_insert(to_world);
        let vertices = selection.vertices(mesh, kind);
        points.extend(vertices.iter().map(|&vertex| placed(mesh, vertex, &to_world)));
        active = active.or_else(|| last_element(document, id, mesh, selection));
    }
    let placement = placement.unwrap_or(DAffine3::IDENTITY);
    let local = unit_axes(&placement);
    Selected { points, active, origin: placement.translation, local, normal: local, is_editing: true }
}

/// The mean normal of the selected elements, not of unit length; zero in object mode.
fn mean_normal_in_world(document: &Document) -> DVec3 {
    let kind = document.selection().kind();
    let of_mesh = |(id, selection): (MeshId, &MeshSelection)| {
        let mesh = document.mesh(id).filter(|_| !selection.is_empty())?;
        Some(direction_in_world(mean_normal(mesh, selection, kind), &document.mesh_transform(id)))
    };
    document.selection().meshes().filter_map(of_mesh).sum()
}

pub(crate) fn placed(mesh: &EditMesh, vertex: VertexId, to_world: &DAffine3) -> DVec3 {
    to_world.transform_point3(mesh.position(vertex).as_dvec3())
}

/// Not of unit length.
fn mean_normal(mesh: &EditMesh, selection: &MeshSelection, kind: ElementKind) -> DVec3 {
    let faces = selection.faces(mesh, kind);
    if faces.is_empty() {
        let vertices = selection.vertices(mesh, kind);
        return vertices.iter().map(|&vertex| mesh.vertex_normal(vertex)).sum();
    }
    faces.iter().map(|&face| mesh.face_area_vector(face)).sum()
}

/// Normals are turned by the cofactors, so that they stay perpendicular where lengths are scaled
/// unevenly.
fn direction_in_world(normal: DVec3, to_world: &DAffine3) -> DVec3 {
    let DMat3 { x_axis, y_axis, z_axis } = to_world.matrix3;
    let cofactors = DMat3::from_cols(y_axis.cross(z_axis), z_axis.cross(x_axis), x_axis.cross(y_axis));
    (cofactors * normal).normalize_or_zero()
}

/// The middle of the element that was selected last.
fn last_element(
    document: &Document,
    id: MeshId,
    mesh: &EditMesh,
    selection: &MeshSelection,
) -> Option<DVec3> {
    let index = *selection.order().last()?;
    let (vertex, edge, face) = (VertexId::new(index), EdgeId::new(index), FaceId::new(index));
    let vertices: Vec<VertexId> = match document.selection().kind() {
        ElementKind::Vertex if mesh.has_vertex(vertex) => vec![vertex],
        ElementKind::Edge if mesh.has_edge(edge) => mesh.edge_vertices(edge).to_vec(),
        ElementKind::Face if mesh.has_face(face) => mesh.face_vertices(face).collect(),
        _ => return None,
    };
    let to_world = document.mesh_transform(id);
    let sum: DVec3 = vertices.iter().map(|&vertex| placed(mesh, vertex, &to_world)).sum();
    Some(sum / vertices.len() as f64)
}

fn unit_axes(placement: &DAffine3) -> DMat3 {
    let DMat3 { x_axis, y_axis, z_axis } = placement.matrix3;
    let unit = |axis: DVec3, otherwise| axis.normalize_or(otherwise);
    DMat3::from_cols(unit(x_axis, DVec3::X), unit(y_axis, DVec3::Y), unit(z_axis, DVec3::Z))
}

/// Right-handed axes with a given z; x is as level as it can be.
fn axes_with_z(z: DVec3) -> DMat3 {
    let x = DVec3::Y.cross(z).try_normalize().unwrap_or(DVec3::X);
    DMat3::from_cols(x, z.cross(x), z)
}

/// The centre of turns and scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Pivot {
    /// The mean of the selected vertices, or of the origins of objects.
    #[default]
    Median,
    /// Each part that hangs together about its own middle, each object about its own origin.
    Individual,
    /// The origin of the active object.
    Origin,
    /// The middle of the box around what is selected.
    Bounds,
    /// What was selected last; the median where nothing is.
    Active,
    /// The 3D cursor.
    Cursor,
}

impl Pivot {
    /// Where the pivot is drawn; of individual ones their median.
    pub(crate) fn point(self, selected: &Selected, cursor: DVec3) -> DVec3 {
        match self {
            Self::Median | Self::Individual => selected.median(),
            Self::Origin => selected.origin,
            Self::Bounds => selected.bounds_center(),
            Self::Active => selected.active.unwrap_or_else(|| selected.median()),
            Self::Cursor => cursor,
        }
    }

    /// The centre for a command; individual ones are left to it.
    pub(crate) fn center(self, selected: &Selected, cursor: DVec3) -> Option<[f64; 3]> {
        (self != Self::Individual).then(|| self.point(selected, cursor).to_array())
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::mesh::math::DMat3;

    use super::*;

    #[test]
    fn each_pivot_is_where_it_says() {
        let selected = Selected {
            points: vec![DVec3::ZERO, DVec3::ZERO, DVec3::X * 6.0],
            active: Some(DVec3::Y),
            origin: DVec3::Z,
            local: DMat3::IDENTITY,
            normal: DMat3::IDENTITY,
            is_editing: true,
        };
        let cursor = DVec3::NEG_X;
        for (pivot, point) in [
            (Pivot::Median, DVec3::X * 2.0),
            (Pivot::Individual, DVec3::X * 2.0),
            (Pivot::Bounds, DVec3::X * 3.0),
            (Pivot::Origin, DVec3::Z),
            (Pivot::Active, DVec3::Y),
            (Pivot::Cursor, cursor),
        ] {
            assert_eq!(pivot.point(&selected, cursor), point, "{pivot:?}");
            assert_eq!(pivot.center(&selected, cursor).is_none(), pivot == Pivot::Individual, "{pivot:?}");
        }
        let none = Selected { active: None, ..selected };
        assert_eq!(Pivot::Active.point(&none, cursor), DVec3::X * 2.0, "nothing was selected one by one");
    }
}
