//! Picking: what of a scene is under a pixel or in a rectangle of them, down to the
//! vertices and edges of its polygons.
//!
//! All of it is read from the ids of a picture, so only what is visible is found, and
//! a pixel costs the corners of one polygon whatever the scene's size.

mod outline;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use trigon_camera::{Camera, Projector, Viewport};
use trigon_math::DVec2;

use crate::frame::{Frame, Hit};
use crate::scene::{NodeId, PlacedMesh, Scene};
use outline::Outline;

/// How far from a pixel's centre its vertices and edges may be to count as seen in a
/// rectangle, in pixels: in a sharp corner the next pixel that is covered is up to a
/// diagonal away.
const REACH: f64 = 1.5;

/// Finds vertices and edges under the pixels of a picture.
///
/// ```
/// use trigon_scene::mesh::primitives;
/// use trigon_scene::{Material, Outputs, Picker, RenderSettings, Scene, render};
///
/// let mut scene = Scene::new();
/// let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
/// let outputs = Outputs { ids: true, ..Outputs::NONE };
/// let settings = RenderSettings { outputs, ..RenderSettings::new(40, 30) };
/// let camera = scene.overview(settings.aspect());
/// let frame = render(&scene, &camera, &settings)?;
///
/// let picker = Picker::new(&scene, &camera, &frame);
/// let pick = picker.at(20, 15).expect("the cube is in the middle");
/// assert_eq!(pick.hit.node, cube);
/// let seen = picker.within(0..40, 0..30);
/// // Of its 8 corners one is hidden; of 12 edges those three that meet there.
/// assert_eq!((seen.faces.len(), seen.vertices.len(), seen.edges.len()), (3, 7, 9));
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
pub struct Picker<'p> {
    scene: &'p Scene,
    frame: &'p Frame,
    projector: Projector,
    objects: BTreeMap<u32, PlacedMesh<'p>>,
}

/// What is under a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pick {
    /// The node and its polygon.
    pub hit: Hit,
    /// Of the polygon's vertices the one that is seen nearest to the pixel's centre;
    /// of equally near ones the first. `None` for lines and points.
    pub vertex: Option<u32>,
    /// Of the polygon's edges the one that is seen nearest, as an index into
    /// [`Mesh::edges`](trigon_mesh::Mesh::edges); of equally near ones the first. `None` for lines and points.
    pub edge: Option<u32>,
}

/// What is seen in a rectangle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picked {
    /// Nodes.
    pub nodes: BTreeSet<NodeId>,
    /// Polygons of nodes.
    pub faces: BTreeSet<(NodeId, u32)>,
    /// Vertices of nodes, of polygons that are seen within one and a half pixels of them.
    pub vertices: BTreeSet<(NodeId, u32)>,
    /// Edges of nodes, likewise.
    pub edges: BTreeSet<(NodeId, u32)>,
}

impl<'p> Picker<'p> {
    /// For a frame with ids, of the scene as it was drawn. Poses are found anew, once
    /// for each object that is seen.
    pub fn new(scene: &'p Scene, camera: &Camera, frame: &'p Frame) -> Self {
        let viewport = Viewport { width: frame.width, height: frame.height };
        let mut objects = BTreeMap::new();
        let mut last = u32::MAX;
        for &object in frame.object_ids.iter().flatten() {
            if object != last && object != u32::MAX && !objects.contains_key(&object) {
                objects.extend(seen(scene, object).map(|mesh| (object, mesh)));
            }
            last = object;
        }
        Self { scene, frame, projector: Projector::new(camera, viewport), objects }
    }

    /// What is under a pixel; `None` for background, and outside the picture.
    pub fn at(&self, x: u32, y: u32) -> Option<Pick> {
        let hit = self.frame.hit(self.scene.nodes(), x, y)?;
        let outline = self.outline(&hit);
        let center = center(x, y);
        let nearest = |candidates: &[(u32, f64)]| {
            candidates.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
        };
        let [vertex, edge] = match &outline {
            Some(outline) => [nearest(&outline.vertices(center)), nearest(&outline.edges(center))],
            None => [None; 2],
        };
        Some(Pick { hit, vertex, edge })
    }

    /// Everything that is seen in some columns and rows of the picture; what lies
    /// beyond its borders is left out.
    pub fn within(&self, columns: Range<u32>, rows: Range<u32>) -> Picked {
        let mut picked = Picked::default();
        let [columns, rows] = [(columns, self.frame.width), (rows, self.frame.height)]
            .map(|(range, end)| range.start..range.end.min(end));
        // Neighbours mostly see the same polygon.
        let mut last: Option<(Hit, Option<Outline<'_>>)> = None;
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            let Some(hit) = self.frame.hit(self.scene.nodes(), x, y) else { continue };
            if last.as_ref().is_none_or(|(known, _)| *known != hit) {
                last = Some((hit, self.outline(&hit)));
            }
            picked.nodes.insert(hit.node);
            let Some((_, Some(outline))) = &last else { continue };
            picked.faces.extend(hit.face.map(|face| (hit.node, face as u32)));
            let near = |candidates: Vec<(u32, f64)>| {
                let near = candidates.into_iter().filter(|(_, distance)| *distance <= REACH);
                near.map(|(index, _)| (hit.node, index))
            };
            picked.vertices.extend(near(outline.vertices(center(x, y))));
            picked.edges.extend(near(outline.edges(center(x, y))));
        }
        picked
    }

    /// The polygon of a hit on the screen; `None` for lines and points.
    fn outline(&self, hit: &Hit) -> Option<Outline<'_>> {
        let object = self.objects.get(&(hit.node.index() as u32))?;
        let face = hit.face.filter(|&face| face < object.mesh().face_count())?;
        Some(Outline::new(object.mesh(), face, &self.projector, |vertex| object.place(vertex)))
    }
}

/// The mesh of a node by its number, where it is.
fn seen(scene: &Scene, index: u32) -> Option<PlacedMesh<'_>> {
    let id = scene.nodes().id_at(index as usize)?;
    scene.placed_mesh(id, scene.world_transform(id))
}

fn center(x: u32, y: u32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}
