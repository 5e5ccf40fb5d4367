//! View changes by keys and menus; the window itself handles drags.

use trigon_document::scene::NodeId;
use trigon_document::{Document, ObjectName, Rotation, SetTransform, TransformSpace};
use trigon_window::scene::camera::{AxisView, Camera, DEFAULT_MARGIN, Orbit};
use trigon_window::scene::math::{DVec2, DVec3, Vec3};
use trigon_window::{Area, Stage};

use super::editor::{Editor, Message};
use crate::request::{DisplayMode, ImageKind, ViewRequest};

impl Editor {
    /// Does what is asked for.
    pub(super) fn navigate(&mut self, stage: &mut Stage, request: ViewRequest) {
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
            ViewRequest::FrameAll => frame_all(editor, stage),
            ViewRequest::ToggleLocal => toggle_local(editor, stage),
            ViewRequest::Camera => look_through_camera(editor, stage),
            ViewRequest::CameraToView => camera_to_view(editor, stage),
            ViewRequest::Display(mode) => editor.view.display = mode,
            ViewRequest::ToggleWireframe => toggle_wireframe(editor),
            ViewRequest::ToggleFourViews => editor.toggle_four_views(stage),
            ViewRequest::Solid(color) => editor.view.solid = color,
            ViewRequest::Render => editor.render_camera(stage),
            ViewRequest::Screenshot => editor.ask_for_image(ImageKind::Screenshot),
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
        [] => frame_all(editor, stage),
        // A point has no size that the view could be fitted to.
        [point] => stage.orbit.set_target(*point),
        _ => frame(editor, stage, &points),
    }
}

/// Takes all meshes into the image, seen from the same side. Lights and empties may be far away.
pub(crate) fn frame_all(editor: &Editor, stage: &mut Stage) {
    let points: Vec<DVec3> = stage.scene.visible_points().collect();
    frame(editor, stage, &points);
}

/// Takes points into the part of the image that no panel covers. What the view turns around stays in
/// the middle of the window, so that they get the room that is on both sides of it.
fn frame(editor: &Editor, stage: &mut Stage, points: &[DVec3]) {
    /// Before the panels were laid out, as shares of the window.
    const USUAL: DVec2 = DVec2::new(0.55, 0.85);
    /// However much is covered.
    const LEAST: f64 = 0.2;
    if let Some(Area { size, .. }) = stage.four_views {
        // No panel covers any of them.
        return stage.orbit.fit_points(points, size.aspect(), DEFAULT_MARGIN);
    }
    let points_to_pixels = stage.scale() * f64::from(stage.text_scale);
    let (size, viewport) = (stage.viewport().size() / points_to_pixels, stage.viewport());
    let free_share = editor.free.map_or(USUAL, |free| {
        let (min, max) = (DVec2::new(free.min.x.into(), free.min.y.into()), free.max);
        let max = DVec2::new(max.x.into(), max.y.into());
        (size * 0.5 - min).min(max - size * 0.5) / (size * 0.5)
    });
    let free_share = free_share.clamp(DVec2::splat(LEAST), DVec2::ONE);
    stage.orbit.fit_points(points, viewport.aspect() * free_share.x / free_share.y, DEFAULT_MARGIN);
    stage.orbit.zoom(free_share.y);
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

fn toggle_local(editor: &mut Editor, stage: &mut Stage) {
    let selected = &editor.document.selection().objects;
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
        editor.view.local = Some(selected.clone());
        editor.view.before_local = Some(stage.orbit);
        frame_selected(editor, stage);
    }
}

fn look_through_camera(editor: &mut Editor, stage: &mut Stage) {
    if let Some(before) = editor.view.before_camera.take() {
        stage.orbit = before;
        return;
    }
    let Some((_, camera)) = camera(&editor.document) else {
        editor.message = Message::Refusal("Camera: the scene has no camera; Add has one".into());
        return;
    };
    editor.view.before_camera = Some(stage.orbit);
    stage.orbit = Orbit::from_camera(&camera, stage.orbit.distance(), DVec3::Y);
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
}
