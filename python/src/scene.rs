//! Scenes: built from arrays or loaded, changed, and drawn.

use std::path::PathBuf;
use std::sync::Mutex;
use std::time::Instant;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use trigon_camera::Camera;
use trigon_math::{Bounds3, DAffine3, DVec3, Vec3};
use trigon_mesh::{Attributes, Mesh, MeshBuilder};
use trigon_scene::quality::TimeBudget;
use trigon_scene::{Frame, Light, Node, NodeId, Omission, RenderError, Renderer, Scene, Transform};

use crate::arrays::{Channels, affine, colors, coordinates, faces, vectors, vertices};
use crate::camera::PyCamera;
use crate::errors::{render_error, value_error, warn};
use crate::frame::PyFrame;
use crate::material::PyMaterial;
use crate::options::Options;

/// A scene: meshes, points, lights and cameras.
///
/// Methods that add something return the number of its node, which is what `object_ids` of a frame hold.
///
/// >>> import trigon3d
/// >>> scene = trigon3d.Scene()
/// >>> triangle = scene.add_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
/// >>> frame = scene.render(64, 48, outputs=("color", "object_ids"))
/// >>> frame.color.shape, int(frame.object_ids.max())
/// ((48, 64, 4), 0)
#[pyclass(name = "Scene", module = "trigon3d")]
pub(crate) struct PyScene {
    pub(crate) scene: Scene,
    /// Those that are not drawing, with their threads and memory.
    renderers: Mutex<Vec<Renderer>>,
    /// Of all that is visible, until something changes.
    bounds: Mutex<Option<Bounds3>>,
}

/// Waiting renderers; more are dropped.
const MOST_RENDERERS: usize = 4;

impl PyScene {
    pub(crate) fn new(scene: Scene) -> Self {
        Self { scene, renderers: Mutex::default(), bounds: Mutex::default() }
    }

    /// The scene, to be changed.
    fn changed(&mut self) -> &mut Scene {
        *self.bounds.get_mut().unwrap_or_else(|poisoned| poisoned.into_inner()) = None;
        &mut self.scene
    }

    pub(crate) fn visible_bounds(&self) -> Bounds3 {
        let mut bounds = self.bounds.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        *bounds.get_or_insert_with(|| self.scene.tight_bounds())
    }

    pub(crate) fn node_id(&self, node: usize) -> PyResult<NodeId> {
        let id = self.scene.nodes().id_at(node);
        id.ok_or_else(|| pyo3::exceptions::PyIndexError::new_err(format!("there is no node {node}")))
    }

    /// The camera that was given, or one that sees everything. Fisheye lenses only draw images.
    pub(crate) fn camera(&self, camera: Option<&PyCamera>, aspect: f64) -> PyResult<Camera> {
        match camera {
            Some(camera) if camera.lens.is_some() => Err(value_error(
                "this needs a camera without a fisheye lens; Scene.render draws ids through one",
            )),
            Some(camera) => Ok(camera.placed(&self.visible_bounds())),
            None => Ok(self.scene.overview(aspect)),
        }
    }

    /// Does something with a renderer of these settings.
    pub(crate) fn with_renderer<T>(
        &self,
        options: &Options,
        work: impl FnOnce(&mut Renderer) -> Result<T, RenderError>,
    ) -> Result<T, RenderError> {
        let lock = || self.renderers.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let waiting = lock().pop();
        let mut renderer = waiting.unwrap_or_else(|| Renderer::new(options.settings.clone()));
        *renderer.settings_mut() = options.settings.clone();
        let done = work(&mut renderer);
        let mut renderers = lock();
        if renderers.len() < MOST_RENDERERS {
            renderers.push(renderer);
        }
        done
    }

    /// Draws into a frame, whose memory is used again.
    pub(crate) fn draw_into(
        &self,
        camera: &Camera,
        options: &Options,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        self.with_renderer(options, |renderer| {
            let Some(limit) = options.time_budget else {
                return renderer.render_into(&self.scene, camera, frame);
            };
            let (mut budget, started) = (TimeBudget::new(limit), Instant::now());
            let clock = &mut || started.elapsed();
            budget.calibrate(renderer, &self.scene, camera, clock)?;
            *frame = budget.render(renderer, &self.scene, camera, clock)?.0;
            Ok(())
        })
    }

    /// As [`draw_into`](Self::draw_into), through any lens, while other threads of Python run. What a fisheye lens leaves
    /// out is warned of.
    pub(crate) fn draw_through(
        &self,
        py: Python<'_>,
        camera: Option<&PyCamera>,
        options: &Options,
        frame: &mut Frame,
    ) -> PyResult<()> {
        let Some(fisheye) = camera.and_then(PyCamera::as_fisheye) else {
            return py.detach(|| {
                let camera = self.camera(camera, options.settings.aspect())?;
                self.draw_into(&camera, options, frame).map_err(render_error)
            });
        };
        if options.time_budget.is_some() {
            return Err(value_error("time_budget is not for fisheye lenses; set quality or samples"));
        }
        warn(py, Omission::all(&self.scene, &options.settings))?;
        let draw = || self.with_renderer(options, |renderer| renderer.render_fisheye(&self.scene, &fisheye));
        *frame = py.detach(draw).map_err(render_error)?;
        Ok(())
    }

    /// A frame for Python.
    pub(crate) fn frame(
        &self,
        py: Python<'_>,
        camera: Option<&PyCamera>,
        options: &Options,
    ) -> PyResult<PyFrame> {
        let mut frame = Frame::default();
        self.draw_through(py, camera, options, &mut frame)?;
        PyFrame::new(py, frame)
    }

    /// A light at a place, shining along a direction.
    fn light_node(light: Light, position: DVec3, direction: DVec3) -> Node {
        let turn = Camera::look_at(position, position + direction, DVec3::Y).orientation;
        let transform = Transform::from_scale_rotation_translation(DVec3::ONE, turn, position);
        Node::from_light(light).with_transform(transform)
    }
}

#[pymethods]
impl PyScene {
    #[new]
    fn empty() -> Self {
        Self::new(Scene::new())
    }

    /// Adds a mesh of (n, 3) vertices and faces: an array of (m, k) indices, or a list of polygons of any lengths.
    ///
    /// `normals` (3), `uvs` (2) and `colors` (3 or 4; bytes, or numbers from 0 to 1; sRGB) have a row for each vertex,
    /// or for each corner of all faces. Without normals faces are flat; with `smooth_angle` they are smooth across edges
    /// at which they meet at no more than so many degrees.
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    /// >>> scene.add_mesh(square, [[0, 1, 2, 3]], colors=[[255, 0, 0]] * 4, name="square")
    /// 0
    #[pyo3(signature = (
        vertices, faces, *, normals=None, uvs=None, colors=None, material=None, pose=None, smooth_angle=None,
        name="mesh".to_owned()
    ))]
    fn add_mesh(
        &mut self,
        vertices: &Bound<'_, PyAny>,
        faces: &Bound<'_, PyAny>,
        normals: Option<&Bound<'_, PyAny>>,
        uvs: Option<&Bound<'_, PyAny>>,
        colors: Option<&Bound<'_, PyAny>>,
        material: Option<PyRef<'_, PyMaterial>>,
        pose: Option<&Bound<'_, PyAny>>,
        smooth_angle: Option<f64>,
        name: String,
    ) -> PyResult<usize> {
        let mut mesh = polygons(&self::vertices(vertices, "vertices")?, faces)?;
        let normals = normals.map(|normals| vectors(normals, "normals")).transpose()?;
        let uvs = uvs.map(|uvs| coordinates(uvs, "uvs")).transpose()?;
        let colors = colors.map(|given| self::colors(given, "colors")).transpose()?;
        let has_colors = colors.is_some();
        let attributes = Attributes {
            corner_normals: normals.map(|normals| of_corners(&mesh, normals, "normals")).transpose()?,
            uv_sets: uvs.map(|uvs| of_corners(&mesh, uvs, "uvs")).transpose()?.into_iter().collect(),
            corner_colors: colors.map(|colors| of_corners(&mesh, colors, "colors")).transpose()?,
            ..Attributes::default()
        };
        let has_normals = attributes.corner_normals.is_some();
        if smooth_angle.is_some_and(|angle| !(0.0..=180.0).contains(&angle)) {
            return Err(value_error("smooth_angle goes from 0 to 180 degrees"));
        }
        mesh.set_attributes(attributes).map_err(value_error)?;
        if let Some(angle) = smooth_angle.filter(|_| !has_normals) {
            mesh.smooth_by_angle(angle.to_radians());
        }
        let pose = pose.map_or(Ok(DAffine3::IDENTITY), |pose| affine(pose, "pose"))?;
        let scene = self.changed();
        let material = match material {
            Some(material) => material.add_to(scene),
            // Colours are multiplied with the material's.
            None if has_colors => scene.add_material(trigon_scene::Material::from_color(Vec3::ONE)),
            None => scene.add_material(trigon_scene::Material::default()),
        };
        let mesh = scene.add_mesh(name.clone(), mesh);
        let node = Node::from_mesh(mesh, material).with_name(name).with_transform(Transform::Affine(pose));
        Ok(scene.add(node).index())
    }

    /// Adds a cloud of (n, 3) points, with a colour for each.
    #[pyo3(signature = (points, *, colors=None, pose=None, name="points".to_owned()))]
    fn add_points(
        &mut self,
        points: &Bound<'_, PyAny>,
        colors: Option<&Bound<'_, PyAny>>,
        pose: Option<&Bound<'_, PyAny>>,
        name: String,
    ) -> PyResult<usize> {
        let points = vertices(points, "points")?;
        let mut builder = MeshBuilder::with_capacity(points.len(), 0, 0);
        for &point in &points {
            let vertex = builder.push_vertex(point);
            builder.push_loose_point(vertex).map_err(value_error)?;
        }
        let mut mesh = builder.build();
        if let Some(colors) = colors {
            let vertex_colors = Some(self::colors(colors, "colors")?);
            mesh.set_attributes(Attributes { vertex_colors, ..Attributes::default() })
                .map_err(value_error)?;
        }
        let pose = pose.map_or(Ok(DAffine3::IDENTITY), |pose| affine(pose, "pose"))?;
        let scene = self.changed();
        let material = scene.add_material(trigon_scene::Material::from_color(Vec3::ONE));
        let mesh = scene.add_mesh(name.clone(), mesh);
        let node = Node::from_mesh(mesh, material).with_name(name).with_transform(Transform::Affine(pose));
        Ok(scene.add(node).index())
    }

    /// Adds a light: "ambient", "directional", "point" or "spot". A scene without lights has studio lights.
    ///
    /// `angle` is the half angle of a spot in degrees. Within `inner_angle`, 0.8 of it unless it is given, the light is
    /// not yet weaker. Above a `radius` of 0 the shadows are soft: in metres, and of a directional light at a distance
    /// of one metre (0.00465 for the sun).
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> scene.add_light("directional", direction=(0, -1, -1), intensity=2.0)
    /// 0
    #[pyo3(signature = (
        kind="directional", *, color=Channels::white(), intensity=1.0, position=[0.0; 3], direction=[0.0, 0.0, -1.0],
        angle=45.0, inner_angle=None, radius=0.0
    ))]
    fn add_light(
        &mut self,
        kind: &str,
        color: Channels,
        intensity: f32,
        position: [f64; 3],
        direction: [f64; 3],
        angle: f32,
        inner_angle: Option<f32>,
        radius: f32,
    ) -> PyResult<usize> {
        let (position, direction) = (DVec3::from_array(position), DVec3::from_array(direction));
        let is_sound = position.is_finite() && direction.is_finite() && direction != DVec3::ZERO;
        let inner_angle = inner_angle.unwrap_or(0.8 * angle);
        let has_angles = (0.0..=90.0).contains(&angle) && (0.0..=angle).contains(&inner_angle);
        let is_amount = |value: f32| value.is_finite() && value >= 0.0;
        if !(is_sound && is_amount(intensity) && is_amount(radius) && has_angles) {
            return Err(value_error(
                "a light has a finite position, a direction that is not 0, an intensity and a radius of at least 0, an angle up to 90 and an inner_angle up to that",
            ));
        }
        let light = match kind {
            "ambient" => Light::ambient(intensity),
            "directional" => Light::directional(intensity),
            "point" => Light::point(intensity),
            "spot" => {
                let [inner, outer] = [inner_angle, angle].map(f32::to_radians);
                let kind = trigon_scene::LightKind::Spot { inner, outer };
                Light { kind, ..Light::spot(intensity) }
            }
            other => {
                return Err(value_error(format!(
                    "kind is {other:?}, not \"ambient\", \"directional\", \"point\" or \"spot\""
                )));
            }
        };
        let light = light.with_color(color.linear("color")?.truncate()).with_radius(radius);
        Ok(self.changed().add(Self::light_node(light, position, direction)).index())
    }

    /// Adds the nodes of a file, as `load` does for a scene of its own; returns the numbers of its topmost nodes.
    #[pyo3(signature = (path, *, pose=None))]
    fn add_file(
        &mut self,
        py: Python<'_>,
        path: PathBuf,
        pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<usize>> {
        let pose = pose.map(|pose| affine(pose, "pose")).transpose()?;
        let other = crate::load::load(py, path, None)?;
        let scene = self.changed();
        let added = scene.append(&other.scene);
        let tops: Vec<NodeId> = added
            .into_iter()
            .filter(|&id| scene.node(id).is_some_and(|node| node.parent().is_none()))
            .collect();
        for (&id, pose) in tops.iter().zip(std::iter::repeat(pose)) {
            if let (Some(pose), Some(node)) = (pose, scene.node_mut(id)) {
                node.transform = Transform::Affine(pose * node.transform.to_affine());
            }
        }
        Ok(tops.into_iter().map(NodeId::index).collect())
    }

    /// Moves a node: a matrix of 4 × 4 from its space to its parent's.
    fn set_pose(&mut self, node: usize, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        let (id, pose) = (self.node_id(node)?, affine(pose, "pose")?);
        let node = self.changed().node_mut(id).expect("an id that was just looked up");
        node.transform = Transform::Affine(pose);
        Ok(())
    }

    /// Shows or hides a node and all below it.
    fn set_visible(&mut self, node: usize, visible: bool) -> PyResult<()> {
        let id = self.node_id(node)?;
        self.changed().node_mut(id).expect("an id that was just looked up").visible = visible;
        Ok(())
    }

    /// Gives the vertices of a node's mesh new positions; there must be as many as before.
    fn set_vertices(&mut self, node: usize, vertices: &Bound<'_, PyAny>) -> PyResult<()> {
        let (id, vertices) = (self.node_id(node)?, self::vertices(vertices, "vertices")?);
        let mesh_id = self.scene.node(id).and_then(|node| node.mesh);
        let mesh_id = mesh_id.ok_or_else(|| value_error(format!("node {node} has no mesh")))?;
        let asset = self.scene.meshes().get(mesh_id).expect("a node's mesh is in its scene");
        let mut mesh = asset.mesh().clone();
        if vertices.len() != mesh.vertex_count() {
            return Err(value_error(format!(
                "vertices has {} rows, but the mesh has {} vertices",
                vertices.len(),
                mesh.vertex_count()
            )));
        }
        mesh.positions_mut().copy_from_slice(&vertices);
        self.changed().replace_mesh(mesh_id, mesh);
        Ok(())
    }

    /// Removes a node and all below it.
    fn remove(&mut self, node: usize) -> PyResult<()> {
        let id = self.node_id(node)?;
        self.changed().remove(id);
        Ok(())
    }

    /// Draws an image. Without a camera everything is in view.
    ///
    /// Named arguments: `outputs` (names of `Frame`'s arrays), `samples` along each side of a pixel (1 to 4, default
    /// 3), `quality` ("draft", "standard", "high", "reference"), `time_budget` in seconds, `background` (a colour in
    /// sRGB, "transparent", "default"), `lighting` ("auto", "scene", "studio"), `exposure` ("auto", by a light meter for
    /// lamps that a display cannot show, or stops: 0 leaves light as it is), `shadows`, `flat`, `point_size`,
    /// `line_width`, `threads`, `simd`. Other threads of Python run meanwhile.
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
    /// >>> frame = scene.render(9, 9, camera, outputs=("depth", "face_ids"))
    /// >>> float(frame.depth[4, 4]), int(frame.face_ids[4, 4]), int(frame.face_ids[0, 0])
    /// (5.0, 0, -1)
    #[pyo3(signature = (width, height, camera=None, **named))]
    fn render(
        &self,
        py: Python<'_>,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<PyFrame> {
        let options = Options::new(width, height, named)?;
        self.frame(py, camera.as_deref(), &options)
    }

    fn __repr__(&self) -> String {
        format!("Scene({} nodes, {} meshes)", self.scene.nodes().len(), self.scene.meshes().len())
    }
}

/// The mesh of vertices and faces.
fn polygons(vertices: &[Vec3], indices: &Bound<'_, PyAny>) -> PyResult<Mesh> {
    let faces = faces(indices, vertices.len())?;
    let face_count = faces.sizes.as_ref().map_or(faces.corners.len() / 3, Vec::len);
    let mut builder = MeshBuilder::with_capacity(vertices.len(), face_count, faces.corners.len());
    for &vertex in vertices {
        builder.push_vertex(vertex);
    }
    match &faces.sizes {
        None => builder.push_triangles(faces.corners.as_chunks::<3>().0).map_err(value_error)?,
        Some(sizes) => {
            let mut rest = &faces.corners[..];
            for &size in sizes {
                let (face, others) = rest.split_at(size);
                builder.push_face(face).map_err(value_error)?;
                rest = others;
            }
        }
    }
    Ok(builder.build())
}

/// Values of vertices, or of corners, as values of corners.
fn of_corners<T: Copy>(mesh: &Mesh, values: Vec<T>, name: &str) -> PyResult<Vec<T>> {
    if values.len() == mesh.vertex_count() {
        return Ok(mesh.corner_vertices().iter().map(|&vertex| values[vertex as usize]).collect());
    }
    if values.len() == mesh.corner_count() {
        return Ok(values);
    }
    Err(value_error(format!(
        "{name} has {} rows, but the mesh has {} vertices and {} corners",
        values.len(),
        mesh.vertex_count(),
        mesh.corner_count()
    )))
}
