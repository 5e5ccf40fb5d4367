//! Turns what a user points at into a command that selects it.
//!
//! The scene's [`Picker`] finds elements of the meshes as drawn. Here they are mapped to elements
//! of the edited meshes: elements of other objects hide what lies behind them but are never
//! selected, and neither are hidden elements.

use std::collections::BTreeMap;

use fixedbitset::FixedBitSet;
use trigon_mesh::math::DVec2;
use trigon_modelling::{EdgeId, EditMesh, FaceId, VertexId};
use trigon_scene::{ElementSet, MeshId, NodeId, Picker, Reach, Region};

use super::element::{Numbering, Target, distance, exists, is_selectable};
use crate::command::{Command, ElementsOf, ObjectName, Select, SelectAction, SelectElements, SelectNone};
use crate::document::Document;
use crate::selection::{
    ElementKind, ElementKinds, Elements, MeshSelection, edge_loop, edge_ring, face_loop, shortest_path,
};

/// The largest distance from the pointer at which an element is picked, in logical pixels, as in
/// Blender.
pub const PICK_RADIUS: f64 = 25.0;

/// Turns points and regions of an image into commands that select what is there.
///
/// The picker's scene is the document's, or a copy that has followed all its changes
/// ([`Document::take_scene_changes`]). After an edit that added or removed elements nothing is
/// found until the scene is brought up to date.
pub struct Picks<'p> {
    pub(super) document: &'p Document,
    pub(super) picker: &'p Picker<'p>,
    /// Pixels to world, for distances between the pointer and elements.
    pub(super) projector: trigon_scene::camera::Projector,
    /// Whether hidden surfaces count: X-ray.
    pub(super) reach: Reach,
}

impl<'p> Picks<'p> {
    /// For the image of a picker. The projector has the camera and the size of the same image; all
    /// points are in its pixels.
    #[must_use]
    pub fn new(
        document: &'p Document,
        picker: &'p Picker<'p>,
        projector: trigon_scene::camera::Projector,
        reach: Reach,
    ) -> Self {
        Self { document, picker, projector, reach }
    }

    /// A click: selects the nearest element within a radius in pixels, or the nearest object. On
    /// empty space it clears the selection; [`SelectAction::Add`], `Remove` and `Toggle` do nothing
    /// there.
    ///
    /// If several kinds of elements are selected, a vertex comes first within half the radius, then an edge,
    /// then the nearest face; without a face, the nearest of both within the radius. An element of another kind
    /// than the first is selected by its parts, and counts as selected if all of these are.
    #[must_use]
    pub fn click(&self, point: DVec2, radius: f64, action: SelectAction) -> Option<Command> {
        if !self.document.selection().is_editing() {
            return self.objects_of(self.object(point, radius), action);
        }
        match self.nearest_of_kinds(point, radius) {
            Some((kind, target)) => self.select_by_parts(kind, &target, action),
            None => nothing(action),
        }
    }

    /// The nearest element of those kinds that are selected.
    fn nearest_of_kinds(&self, point: DVec2, radius: f64) -> Option<(ElementKind, Target)> {
        let kinds = self.document.selection().kinds();
        let nearest = |kind: ElementKind, radius: f64| Some((kind, self.nearest(kind, point, radius)?));
        let (lines, faces): (Vec<_>, Vec<_>) = kinds.iter().partition(|&kind| kind != ElementKind::Face);
        let near = if kinds == ElementKinds::one(kinds.first()) { radius } else { 0.5 * radius };
        let first = lines.iter().find_map(|&kind| nearest(kind, near));
        let face = || faces.iter().find_map(|&kind| nearest(kind, radius));
        first.or_else(face).or_else(|| lines.iter().find_map(|&kind| nearest(kind, radius)))
    }

    /// Selects an element by its parts of the first kind.
    fn select_by_parts(&self, kind: ElementKind, target: &Target, action: SelectAction) -> Option<Command> {
        let first = self.document.selection().kind();
        if kind == first {
            return Some(target.select(vec![target.element], action));
        }
        let parts = self.parts(kind, target.mesh, [target.element])?;
        let selected = self.document.selection().of(target.mesh)?;
        let action = match action {
            SelectAction::Toggle if parts.indices().all(|part| selected.contains(part)) => {
                SelectAction::Remove
            }
            SelectAction::Toggle => SelectAction::Add,
            action => action,
        };
        Some(target.select(parts.indices().collect(), action))
    }

    /// Elements of a kind as elements of the first kind that is selected.
    fn parts(
        &self,
        kind: ElementKind,
        id: MeshId,
        elements: impl IntoIterator<Item = u32>,
    ) -> Option<MeshSelection> {
        let elements = elements.into_iter();
        let elements = match kind {
            ElementKind::Vertex => Elements::Vertices(elements.map(VertexId::new).collect()),
            ElementKind::Edge => Elements::Edges(elements.map(EdgeId::new).collect()),
            ElementKind::Face => Elements::Faces(elements.map(FaceId::new).collect()),
        };
        let mut parts = MeshSelection::default();
        parts.select(self.document.mesh(id)?, self.document.selection().kind(), &elements);
        Some(parts)
    }

    /// All elements of the selected kinds in a region, or all objects.
    #[must_use]
    pub fn region(&self, region: &Region, action: SelectAction) -> Option<Command> {
        if !self.document.selection().is_editing() {
            return self.objects_of(self.picker.nodes(region, self.reach), action);
        }
        let parts: Vec<ElementsOf> = self
            .in_region(region)
            .into_values()
            .map(|(node, bits)| ElementsOf::new(ObjectName::of(node), bits.ones().map(|bit| bit as u32)))
            .collect();
        if parts.is_empty() { nothing(action) } else { Some(SelectElements { parts, action }.into()) }
    }

    /// The edge loop through the edge under the pointer; in face mode, the loop of faces across it.
    #[must_use]
    pub fn edge_loop(&self, point: DVec2, radius: f64, action: SelectAction) -> Option<Command> {
        self.along_edge(point, radius, action, |mesh, kind, edge| match kind {
            ElementKind::Face => Elements::Faces(face_loop(mesh, edge)),
            _ => Elements::Edges(edge_loop(mesh, edge)),
        })
    }

    /// The edge ring from the edge under the pointer; in face mode, the faces between its edges.
    #[must_use]
    pub fn edge_ring(&self, point: DVec2, radius: f64, action: SelectAction) -> Option<Command> {
        self.along_edge(point, radius, action, |mesh, kind, edge| match kind {
            ElementKind::Face => Elements::Faces(face_loop(mesh, edge)),
            _ => Elements::Edges(edge_ring(mesh, edge)),
        })
    }

    /// The shortest path from the active element to the one under the pointer, which becomes active. Only
    /// that one, if there is no active element in the same part of the same mesh.
    #[must_use]
    pub fn path(&self, point: DVec2, radius: f64) -> Option<Command> {
        let kind = self.document.selection().kind();
        let target = self.nearest(kind, point, radius)?;
        let mesh = self.document.mesh(target.mesh)?;
        let from = self.document.selection().of(target.mesh)?.order().last().copied();
        let path = from
            .filter(|&from| exists(mesh, kind, from))
            .and_then(|from| shortest_path(mesh, kind, from, target.element));
        let path = path.unwrap_or_else(|| vec![target.element]).into_iter();
        let visible = path.filter(|&element| is_selectable(mesh, kind, element)).collect();
        Some(target.select(visible, SelectAction::Add))
    }

    /// Everything connected to the element under the pointer, or to the face there.
    #[must_use]
    pub fn linked(&self, point: DVec2, radius: f64, action: SelectAction) -> Option<Command> {
        let kind = self.document.selection().kind();
        let exact = self.nearest(kind, point, radius).map(|target| (kind, target));
        let (of, target) =
            exact.or_else(|| Some((ElementKind::Face, self.nearest(ElementKind::Face, point, radius)?)))?;
        let mut linked = self.parts(of, target.mesh, [target.element])?;
        linked.grow_linked(self.document.mesh(target.mesh)?, kind);
        Some(self.select_bits(&target, linked.bits(), action))
    }

    fn along_edge(
        &self,
        point: DVec2,
        radius: f64,
        action: SelectAction,
        along: impl Fn(&EditMesh, ElementKind, EdgeId) -> Elements,
    ) -> Option<Command> {
        let target = self.nearest(ElementKind::Edge, point, radius)?;
        let (mesh, kind) = (self.document.mesh(target.mesh)?, self.document.selection().kind());
        let mut found = MeshSelection::default();
        found.select(mesh, kind, &along(mesh, kind, EdgeId::new(target.element)));
        Some(self.select_bits(&target, found.bits(), action))
    }

    fn select_bits(&self, target: &Target, bits: &FixedBitSet, action: SelectAction) -> Command {
        let kind = self.document.selection().kind();
        let all = bits.ones().map(|bit| bit as u32);
        let visible = all.filter(|&element| {
            self.document.mesh(target.mesh).is_some_and(|mesh| is_selectable(mesh, kind, element))
        });
        let parts = vec![ElementsOf::new(ObjectName::of(target.node), visible)];
        SelectElements { parts, action }.into()
    }

    /// The object visible at a point, or nearest to it.
    fn object(&self, point: DVec2, radius: f64) -> Option<NodeId> {
        let under = Region::Point(point);
        let visible = self.picker.nodes(&under, Reach::Visible).into_iter().next();
        visible.or_else(|| {
            let nearest = self.picker.nearest(point, radius, self.reach);
            nearest.face.or(nearest.edge).or(nearest.vertex).map(|(node, _)| node)
        })
    }

    fn objects_of(&self, nodes: impl IntoIterator<Item = NodeId>, action: SelectAction) -> Option<Command> {
        let objects: Vec<ObjectName> = nodes.into_iter().map(ObjectName::of).collect();
        if objects.is_empty() {
            return nothing(action);
        }
        Some(Select { objects, elements: Vec::new(), action }.into())
    }

    /// The elements that the picker finds in a region, of all meshes.
    pub(super) fn elements(&self, kind: ElementKind, region: &Region) -> ElementSet {
        match kind {
            ElementKind::Vertex => self.picker.vertices(region, self.reach),
            ElementKind::Edge => self.picker.edges(region, self.reach),
            ElementKind::Face => self.picker.faces(region, self.reach),
        }
    }

    /// The selectable elements in a region of all kinds that are selected, as elements of the first of them.
    fn in_region(&self, region: &Region) -> BTreeMap<MeshId, (NodeId, FixedBitSet)> {
        let selection = self.document.selection();
        let first = selection.kind();
        let mut all = self.edited(first, &self.elements(first, region));
        for kind in selection.kinds().iter().filter(|&kind| kind != first) {
            for (id, (node, bits)) in self.edited(kind, &self.elements(kind, region)) {
                let Some(parts) = self.parts(kind, id, bits.ones().map(|bit| bit as u32)) else { continue };
                let all = all.entry(id).or_insert_with(|| (node, FixedBitSet::new()));
                all.1.union_with(parts.bits());
            }
        }
        all
    }

    /// The selectable ones, by their numbers in the edited meshes, with the first object that shows
    /// the mesh.
    pub(super) fn edited(
        &self,
        kind: ElementKind,
        found: &ElementSet,
    ) -> BTreeMap<MeshId, (NodeId, FixedBitSet)> {
        let mut all: BTreeMap<MeshId, (NodeId, FixedBitSet)> = BTreeMap::new();
        for (node, bits) in found.nodes() {
            let Some(numbering) = self.numbering(node) else { continue };
            let elements = numbering.elements(kind, bits);
            if !elements.is_clear() {
                let all = all.entry(numbering.id).or_insert_with(|| (node, FixedBitSet::new()));
                all.1.union_with(&elements);
            }
        }
        all
    }

    /// The numbers of an edited object; `None` for others.
    fn numbering(&self, node: NodeId) -> Option<Numbering<'_>> {
        let id = self.document.nodes().node(node)?.mesh?;
        self.document.selection().of(id)?;
        Some(Numbering {
            id,
            mesh: self.document.mesh(id)?,
            map: self.document.shown_elements(id)?,
            numbers: self.document.shown_numbers(id)?,
        })
    }

    /// An element of the scene as an edited one; `None` if it cannot be selected.
    pub(super) fn target(&self, kind: ElementKind, node: NodeId, number: u32) -> Option<Target> {
        let numbering = self.numbering(node)?;
        Some(Target { node, mesh: numbering.id, element: numbering.element(kind, number)? })
    }

    /// The nearest selectable element.
    pub(super) fn nearest(&self, kind: ElementKind, point: DVec2, radius: f64) -> Option<Target> {
        let nearest = self.picker.nearest(point, radius, self.reach);
        let found = match kind {
            ElementKind::Vertex => nearest.vertex,
            ElementKind::Edge => nearest.edge,
            ElementKind::Face => nearest.face,
        };
        let (node, number) = found?;
        self.target(kind, node, number).or_else(|| self.nearest_of_others(kind, point, radius))
    }

    /// The same if the very nearest cannot be selected: the nearest of all within the radius.
    fn nearest_of_others(&self, kind: ElementKind, point: DVec2, radius: f64) -> Option<Target> {
        let found = self.elements(kind, &Region::Circle { center: point, radius });
        let targets = found.iter().filter_map(|(node, number)| self.target(kind, node, number));
        targets
            .map(|target| (distance(self.document, &self.projector, kind, &target, point), target))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, target)| target)
    }
}

impl Target {
    /// Selects elements of one mesh individually.
    fn select(&self, elements: Vec<u32>, action: SelectAction) -> Command {
        Select { objects: vec![ObjectName::of(self.node)], elements, action }.into()
    }
}

/// The effect of pointing at nothing.
fn nothing(action: SelectAction) -> Option<Command> {
    let clears = matches!(action, SelectAction::Replace | SelectAction::Intersect);
    clears.then(|| SelectNone {}.into())
}

#[cfg(test)]
mod tests;
