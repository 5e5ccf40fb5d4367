//! What each pixel of the image in the window shows. Users point at that image, which may be older than the
//! scene.
//!
//! The ids and depths of an image arrive with its colours, so picking looks up one pixel. Nothing is drawn
//! for it, and no vertex is visited.

use std::sync::{Arc, Weak};

use trigon_camera::Viewport;
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::{Frame, Hit, NodeId, Outputs, Picker, Scene, Snap};

use crate::panes::{Area, Views};

/// The outputs of the window's images.
pub(crate) const OUTPUTS: Outputs = Outputs { color: true, depth: true, ids: true, ..Outputs::NONE };

/// The nodes of a scene as it was drawn, by the indices in its images, and the meshes that they
/// had. The meshes are not kept alive.
#[derive(Debug, Default)]
pub(crate) struct DrawnNodes(Vec<Option<(NodeId, Weak<Mesh>)>>);

impl DrawnNodes {
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut nodes = vec![None; scene.nodes().index_bound()];
        for (id, _) in scene.nodes().iter() {
            nodes[id.index()] = Some((id, mesh(scene, id)));
        }
        Self(nodes)
    }
}

/// An image with ids and depths, and what it shows.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    pub(crate) frame: Arc<Frame>,
    pub(crate) views: Views,
    pub(crate) nodes: Arc<DrawnNodes>,
}

impl Shown {
    /// The hit at a point of a window, and its world position; `area` is the part of it that the image fills. Refers to
    /// the scene as it is now: a node that was removed since is not found, and a polygon only if the node still
    /// has the same mesh.
    pub(crate) fn pick(&self, at: DVec2, area: Area, scene: &Scene) -> Option<(Hit, DVec3)> {
        let pixel = self.pixel(at, area)?;
        let value = |ids: &Option<Vec<u32>>| ids.as_ref().and_then(|ids| ids.get(pixel).copied());
        let (node, drawn) = self.nodes.0.get(value(&self.frame.object_ids)? as usize)?.as_ref()?;
        scene.node(*node)?;
        let face = value(&self.frame.face_ids).filter(|&face| face != u32::MAX);
        let face = face.filter(|_| drawn.ptr_eq(&mesh(scene, *node))).map(|face| face as usize);
        let point = self.views.at_distance(at, area, self.depth(pixel)?)?;
        Some((Hit { node: *node, face }, point))
    }

    /// How far away what is seen at points of a window is, in metres along the line of sight. `None` for
    /// background and outside the window.
    pub(crate) fn distances(&self, points: impl Iterator<Item = DVec2>, area: Area) -> Vec<Option<f64>> {
        let pixels: Vec<usize> = points.map(|at| self.pixel(at, area).unwrap_or(usize::MAX)).collect();
        let depth = self.frame.depth.as_deref().unwrap_or_default();
        // Other cores have just written the depths, so each read waits for memory. In a loop that does nothing else, many
        // reads wait at the same time.
        let depths: Vec<f32> =
            pixels.iter().map(|&pixel| depth.get(pixel).copied().unwrap_or(f32::INFINITY)).collect();
        depths.into_iter().map(|depth| depth.is_finite().then_some(f64::from(depth))).collect()
    }

    fn depth(&self, pixel: usize) -> Option<f64> {
        self.frame.depth.as_ref()?.get(pixel).copied().map(f64::from)
    }

    /// The index of the frame's pixel that is shown at a point of the window; `None` outside.
    fn pixel(&self, at: DVec2, area: Area) -> Option<usize> {
        let Frame { width, height, .. } = *self.frame;
        if !area.contains(at) || width == 0 || height == 0 {
            return None;
        }
        let (at, size) = (at - area.origin(), area.size);
        let [x, y] = [(at.x, size.width, width), (at.y, size.height, height)]
            .map(|(at, area, frame)| source_pixel(at as usize, area as usize, frame as usize));
        Some(y * width as usize + x)
    }
}

impl Shown {
    /// What a pointer at a point of a window snaps to, within a radius in the window's pixels. `None` while
    /// the image is a draft, whose pixels are too large, and with four views.
    pub(crate) fn snap(&self, at: DVec2, radius: f64, area: Area, scene: &Scene) -> Option<Snap> {
        let size = Viewport { width: self.frame.width, height: self.frame.height };
        let is_whole = size == area.size && self.views.is_one();
        // An image without ids is not of the scene, or not exact.
        let is_exact = self.frame.object_ids.is_some();
        (is_whole && area.contains(at) && is_exact)
            .then(|| Picker::new(scene, &self.views.main, &self.frame).snap(at - area.origin(), radius))
            .flatten()
    }
}

/// The mesh of a node; a dangling one if it has none.
fn mesh(scene: &Scene, node: NodeId) -> Weak<Mesh> {
    let asset = scene.node(node).and_then(|node| scene.meshes().get(node.mesh?));
    asset.map_or_else(Weak::new, |asset| Arc::downgrade(asset.shared_mesh()))
}

/// Maps one of `to` columns or rows of the window to one of `from` in the frame.
pub(crate) fn source_pixel(at: usize, to: usize, from: usize) -> usize {
    // Mostly they are as many, and thousands of points are looked up: a division takes as long as the rest.
    if from == to { at } else { at * from / to }
}
