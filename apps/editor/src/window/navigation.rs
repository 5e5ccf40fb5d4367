//! View changes by keys and menus; the window itself handles drags.

use std::collections::BTreeSet;

use trigon_document::scene::{MeshId, NodeId};
use trigon_document::{Document, ObjectName, Rotation, SetTransform, TransformSpace};
use trigon_window::Stage;
use trigon_window::scene::camera::{AxisView, Camera, DEFAULT_MARGIN, Orbit, Projection, Viewport};
use trigon_window::scene::math::{DVec3, Vec3, elementary};

use super::editor::{Editor, Message};
use super::settings::ThroughCamera;
use crate::request::{DisplayMode, ImageKind, ViewRequest};

impl Editor {
    /// Does what is asked for.
    pub(super) fn navigate(&mut self, stage: &mut Stage, request: ViewRequest) {
        if self.frame_uvs(stage, request) {
            return;
        }
        let editor = self;
        match request {
            ViewRequest::Axis(view) => look_at_side(editor, stage, view),
            ViewRequest::Opposite => stage.orbit.orbit(std::f64::consts::PI, 0.0),
            ViewRequest::ToggleOrthographic => {
                stage.orbit.toggle_orthographic();
                editor.view.side = None;
            }
            ViewRequest::Orbit(right, up) => stage.orbit.orbit(right.to_radians(), up.to_radians()),
            ViewRequest::Roll(angle) => stage.orbit.roll(angle.to_radians()),
            ViewRequest::Zoom(factor) => stage.orbit.zoom(factor),
            ViewRequest::Pan(right, up) => {
                let height = stage.orbit.height_at_target();
                stage.orbit.pan(right * height, up * height);
            }
            ViewRequest::FrameSelected => frame_selected(editor, stage),
            ViewRequest::FrameAll => frame_all(stage),
            ViewRequest::ToggleLocal => toggle_local(editor, stage),
            ViewRequest::Camera => look_through_camera(editor, stage),
            ViewRequest::CameraToView => camera_to_view(editor, stage),
            ViewRequest::Display(mode) => editor.view.display = mode,
            ViewRequest::ToggleWireframe => toggle_wireframe(editor),
            ViewRequest::ToggleFourViews => stage.four_views = !stage.four_views,
            ViewRequest::Solid(color) => editor.view.solid = color,
            ViewRequest::Render => editor.render_camera(stage),
            ViewRequest::Screenshot => editor.ask_for_image(ImageKind::Screenshot),
            ViewRequest::UvLayout => editor.ask_for_image(ImageKind::UvLayout),
            ViewRequest::ToggleXRay => editor.view.x_ray = !editor.view.x_ray,
            ViewRequest::ToggleOverlays => editor.view.overlays = !editor.view.overlays,
        }
    }
}

/// Sides are looked at in parallel projection, as drawings show them.
fn look_at_side(editor: &mut Editor, stage: &mut Stage, view: AxisView) {
    stage.orbit.set_view(view);
    if !stage.orbit.is_orthographic() || editor.view.side.is_some() {
        editor.view.side = Some(stage.orbit.orientation());
    }
    if !stage.orbit.is_orthographic() {
        stage.orbit.toggle_orthographic();
    }
}

impl Editor {
    /// A side that is left is seen in perspective again, if it was before.
    pub(super) fn leave_side(&mut self, stage: &mut Stage) {
        if self.view.side.is_some_and(|side| side != stage.orbit.orientation()) {
            self.view.side = None;
            if stage.orbit.is_orthographic() {
                stage.orbit.toggle_orthographic();
            }
        }
    }

    /// A view through the scene's camera goes where that goes; whoever turns or moves the view itself has left it.
    pub(super) fn follow_camera(&mut self, stage: &mut Stage) {
        let Some(through) = self.view.camera else { return };
        self.view.camera = match camera(&self.document) {
            Some((_, camera)) if camera != through.camera => {
                stage.orbit = self.orbit_through(stage, &camera);
                Some(ThroughCamera { set: stage.orbit, camera, ..through })
            }
            Some(_) if through.set == stage.orbit => Some(through),
            _ => None,
        };
    }

    /// The view through a camera, with the frame of its image.
    fn orbit_through(&self, stage: &Stage, camera: &Camera) -> Orbit {
        let mut orbit = Orbit::from_camera(camera, stage.orbit.distance(), DVec3::Y);
        let choices = &self.images.choices;
        let image = Viewport { width: choices.width, height: choices.height };
        widen(&mut orbit, image.aspect() / stage.visible_area().size.aspect());
        orbit
    }
}

fn toggle_wireframe(editor: &mut Editor) {
    let view = &mut editor.view;
    if view.display == DisplayMode::Wireframe {
        view.display = view.before_wireframe;
    } else {
        view.before_wireframe = std::mem::replace(&mut view.display, DisplayMode::Wireframe);
    }
    if view.display == DisplayMode::Wireframe && view.before_wireframe == DisplayMode::Wireframe {
        view.before_wireframe = DisplayMode::Solid;
    }
}

pub(crate) fn frame_selected(editor: &Editor, stage: &mut Stage) {
    let points = selected_points(&editor.document);
    match &points[..] {
        [] => frame_all(stage),
        // A point has no size that the view could be fitted to.
        [point] => stage.orbit.set_target(*point),
        _ => frame(stage, &points),
    }
}

/// Takes all meshes into the image, seen from the same side. Lights and empties may be far away.
pub(crate) fn frame_all(stage: &mut Stage) {
    let points: Vec<DVec3> = stage.scene.visible_points().collect();
    frame(stage, &points);
}

/// Takes points into the view.
fn frame(stage: &mut Stage, points: &[DVec3]) {
    /// The width of the view, as a share of the window's, before the panels were laid out.
    const USUAL: f64 = 0.7;
    let share = if stage.view_area.is_some() { 1.0 } else { USUAL };
    let aspect = stage.visible_area().size.aspect() * share;
    stage.orbit.fit_points(points, aspect, DEFAULT_MARGIN);
}

/// The places of all selected vertices in the world; of objects those of all their vertices, or their origins.
fn selected_points(document: &Document) -> Vec<DVec3> {
    let (scene, selection) = (document.nodes(), document.selection());
    let mut points = Vec::new();
    // An empty object stands for what hangs on it.
    let has_mesh = |id: NodeId| scene.node(id).is_some_and(|node| node.mesh.is_some());
    let is_selected = |id: NodeId| {
        let mut above = scene.ancestors(id);
        above.any(|at| selection.objects.contains(&at) && (at == id || !has_mesh(at)))
    };
    for (id, node) in scene.nodes().iter() {
        let world = scene.world_transform(id);
        let mut add = |position: Vec3| points.push(world.transform_point3(position.as_dvec3()));
        match node.mesh {
            Some(mesh) if selection.is_editing() => {
                if let (Some(elements), Some(edited)) = (selection.of(mesh), document.mesh(mesh)) {
                    let vertices = elements.vertices(edited, selection.kind());
                    vertices.into_iter().for_each(|vertex| add(edited.position(vertex)));
                }
            }
            Some(mesh) if is_selected(id) => {
                let asset = scene.meshes().get(mesh);
                asset
                    .into_iter()
                    .flat_map(|asset| asset.mesh().positions())
                    .for_each(|position| add(*position));
            }
            None if is_selected(id) => add(Vec3::ZERO),
            _ => {}
        }
    }
    points
}

/// The selected objects, or those that are edited.
fn objects_at_hand(document: &Document) -> BTreeSet<NodeId> {
    let selection = document.selection();
    if !selection.is_editing() {
        return selection.objects.clone();
    }
    let is_edited = |mesh: Option<MeshId>| mesh.is_some_and(|mesh| selection.of(mesh).is_some());
    document.nodes().nodes().iter().filter(|(_, node)| is_edited(node.mesh)).map(|(id, _)| id).collect()
}

fn toggle_local(editor: &mut Editor, stage: &mut Stage) {
    let selected = objects_at_hand(&editor.document);
    if editor.view.local.take().is_some() {
        if let Some(before) = editor.view.before_local.take() {
            stage.orbit = before;
        }
    } else {
        if selected.is_empty() {
            let text = "Local View: needs an object: click one first";
            editor.message = Message::Refusal(text.into());
            return;
        }
        editor.view.local = Some(selected);
        editor.view.before_local = Some(stage.orbit);
        frame_selected(editor, stage);
    }
}

fn look_through_camera(editor: &mut Editor, stage: &mut Stage) {
    if let Some(ThroughCamera { before, .. }) = editor.view.camera.take() {
        stage.orbit = before;
        return;
    }
    let Some((_, camera)) = camera(&editor.document) else {
        editor.message = Message::Refusal("Camera: the scene has no camera; Add has one".into());
        return;
    };
    let before = stage.orbit;
    stage.orbit = editor.orbit_through(stage, &camera);
    editor.view.camera = Some(ThroughCamera { before, set: stage.orbit, camera });
}

/// Sees more than a camera does, from the same eye, so that the frame of its image lies within the view. The image is
/// wider than the view by this factor.
fn widen(orbit: &mut Orbit, wider: f64) {
    /// Of the view's height or width, for the frame.
    const SHARE: f64 = 0.92;
    let factor = wider.max(1.0) / SHARE;
    if orbit.is_orthographic() {
        return orbit.set_distance(orbit.distance() * factor);
    }
    // Twice the tangent of half the angle.
    let height = orbit.perspective().height_at(1.0) * factor;
    let angle = 2.0 * elementary::atan2(0.5 * height, 1.0);
    let projection = Projection::perspective(angle, orbit.perspective().near(), orbit.perspective().far());
    if let (None, Ok(projection)) = (orbit.perspective().own_aspect(), projection) {
        orbit.set_projection(projection);
    }
}

/// The active object, if it is a camera, or else the first camera of the scene.
pub(super) fn camera(document: &Document) -> Option<(NodeId, Camera)> {
    let (cameras, active) = (document.nodes().cameras(), document.selection().active);
    let is_active = |(id, _): &&(NodeId, Camera)| Some(*id) == active;
    cameras.iter().find(is_active).or(cameras.first()).copied()
}

/// The camera goes where the view looks from, and the view looks through it.
fn camera_to_view(editor: &mut Editor, stage: &mut Stage) {
    let Some((id, _)) = camera(&editor.document) else {
        editor.message = Message::Refusal("Camera to View: the scene has no camera; Add has one".into());
        return;
    };
    let camera_now = stage.camera();
    let command = SetTransform {
        object: Some(ObjectName::of(id)),
        space: TransformSpace::World,
        location: Some(camera_now.position.to_array()),
        rotation: Some(Rotation::Quaternion { xyzw: camera_now.orientation.to_array() }),
        scale: None,
    };
    editor.run(command.into());
    if editor.view.camera.is_none() {
        look_through_camera(editor, stage);
    }
}
