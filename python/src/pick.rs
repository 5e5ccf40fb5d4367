//! What a pixel or a box of an image shows, and why.

use pyo3::exceptions::{PyIndexError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use trigon_camera::{Camera, Projector};
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::{ElementSet, Frame, NodeId, Outputs, Pick, Picker, Reach, Region};

use crate::arrays::shaped;
use crate::camera::PyCamera;
use crate::errors::{render_error, value_error};
use crate::options::Options;
use crate::pixel::explained;
use crate::scene::PyScene;

/// The outputs that a picked pixel is described from.
fn described() -> Outputs {
    Outputs {
        depth: true,
        ids: true,
        material_ids: true,
        triangle_ids: true,
        barycentrics: true,
        positions: true,
        normals: true,
        uvs: true,
        ..Outputs::NONE
    }
}

/// The named arguments of a question about an image, which are those of `render` without some.
fn question(
    size: [u32; 2],
    named: Option<&Bound<'_, PyDict>>,
    method: &str,
    without: &[&str],
) -> PyResult<Options> {
    for name in without {
        if named.is_some_and(|named| named.contains(name).unwrap_or(false)) {
            return Err(PyTypeError::new_err(format!("{method}() has no argument {name:?}")));
        }
    }
    Options::new(size[0], size[1], named)
}

/// The pixel in column `x` and row `y`, if it lies in the image.
fn pixel_within([x, y]: [i64; 2], [width, height]: [u32; 2]) -> PyResult<[u32; 2]> {
    let within = |at: i64, side: u32| u32::try_from(at).ok().filter(|at| *at < side);
    match (within(x, width), within(y, height)) {
        (Some(x), Some(y)) => Ok([x, y]),
        _ => Err(PyIndexError::new_err(format!(
            "the pixel ({x}, {y}) lies outside of the image, which has {width} × {height} pixels, counted from 0"
        ))),
    }
}

#[pymethods]
impl PyScene {
    /// What the pixel in column `x` and row `y` shows, as a dict; `None` for the background.
    ///
    /// The image is the one that `render` draws with the same arguments. Keys: node, name, material, face, triangle,
    /// barycentrics, uv, position and normal (in the world), depth (along the view axis), distance (from the camera's
    /// position), vertex and edge (the vertex of the face, and the pair of vertices, that are nearest on the screen).
    /// Points and lines have no face: what belongs to faces is `None`. Translucent surfaces are looked through.
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]], name="triangle")
    /// >>> camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
    /// >>> hit = scene.pick(4, 4, 9, 9, camera)
    /// >>> hit["name"], hit["face"], round(hit["depth"], 4), hit["normal"]
    /// ('triangle', 0, 5.0, (0.0, 0.0, 1.0))
    /// >>> scene.pick(0, 0, 9, 9, camera) is None
    /// True
    #[pyo3(signature = (x, y, width, height, camera=None, **named))]
    fn pick<'py>(
        &self,
        py: Python<'py>,
        x: i64,
        y: i64,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Option<Bound<'py, PyDict>>> {
        let mut options = question([width, height], named, "pick", &["outputs", "time_budget"])?;
        let at = pixel_within([x, y], [width, height])?;
        let camera = self.camera(camera.as_deref(), options.settings.aspect())?;
        // Positions relative to the camera are exact far from the origin, too.
        options.settings.outputs = Outputs { origin: camera.position, ..described() };
        let (frame, pick) = py.detach(|| {
            let frame = self.picture(&camera, &options)?;
            let pick = Picker::new(&self.scene, &camera, &frame).at(at[0], at[1]);
            Ok::<_, PyErr>((frame, pick))
        })?;
        pick.map(|pick| self.hit(py, &frame, &Hit { pick, at, camera })).transpose()
    }

    /// What lies in a box of an image: the numbers of the nodes, or their faces, vertices or edges.
    ///
    /// The box holds the points with left ≤ x < right and top ≤ y < bottom in pixels. A node or face is there if it
    /// shows the centre of a pixel, a vertex if it is not hidden, an edge if a visible point of its is. With `through`,
    /// hidden ones count, too. Nodes are a list; others a dict from nodes to arrays: indices of faces or vertices, pairs
    /// of vertices for edges. The image has one sample per pixel.
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    /// >>> camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
    /// >>> scene.pick_box(0, 0, 64, 32, 64, 64, camera, elements="vertices")
    /// {0: array([2, 3], dtype=int32)}
    #[pyo3(signature = (left, top, right, bottom, width, height, camera=None, *, elements="nodes", through=false, **named))]
    fn pick_box<'py>(
        &self,
        py: Python<'py>,
        left: f64,
        top: f64,
        right: f64,
        bottom: f64,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        elements: &str,
        through: bool,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let without = ["outputs", "time_budget", "samples"];
        let mut options = question([width, height], named, "pick_box", &without)?;
        options.settings.samples_per_axis = 1;
        options.settings.outputs = Outputs { ids: true, ..Outputs::NONE };
        let region = Region::Rectangle { min: DVec2::new(left, top), max: DVec2::new(right, bottom) };
        let reach = if through { Reach::Through } else { Reach::Visible };
        let camera = self.camera(camera.as_deref(), options.settings.aspect())?;
        let elements = Elements::of(elements)?;
        let found = py.detach(|| {
            let frame = self.picture(&camera, &options)?;
            let picker = Picker::new(&self.scene, &camera, &frame);
            Ok::<_, PyErr>(elements.within(&picker, &region, reach))
        })?;
        self.listed(py, elements, &found)
    }

    /// Why a pixel looks as it does, as a dict: every triangle, line and point that touches it.
    ///
    /// The image is the one that `render` draws with the same arguments. Keys: pixel; color (linear, premultiplied);
    /// samples; reported, the number of the sample that ids and depth come from; text, all of it to read. A sample has
    /// position (in pixels of the finer grid), color and fragments. A fragment has node, name, face, kind, primitive,
    /// vertices (on the finer grid), edges (with the exact value of each edge function), covered, depth (1 is near, 0 is
    /// far), margin (how many floats nearer than what is seen), color, visible and verdict: "visible", "hidden", "equal
    /// depth", "behind far plane", "masked away", "layer N" (from the back), "left to joint", "outside edge N", "outside
    /// disc".
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> camera = trigon3d.Camera.look_at((0, 0, 5), (0, 0, 0))
    /// >>> pixel = scene.explain_pixel(4, 4, 9, 9, camera, samples=1)
    /// >>> [(fragment["face"], fragment["verdict"]) for fragment in pixel["samples"][0]["fragments"]]
    /// [(0, 'visible')]
    #[pyo3(signature = (x, y, width, height, camera=None, **named))]
    fn explain_pixel<'py>(
        &self,
        py: Python<'py>,
        x: i64,
        y: i64,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let options = question([width, height], named, "explain_pixel", &["outputs", "time_budget"])?;
        let [x, y] = pixel_within([x, y], [width, height])?;
        let camera = self.camera(camera.as_deref(), options.settings.aspect())?;
        let pixel = py.detach(|| {
            self.with_renderer(&options, |renderer| renderer.explain_pixel(&self.scene, &camera, x, y))
        });
        let pixel = pixel.map_err(render_error)?.expect("a pixel that lies in the image");
        explained(py, &pixel, &self.scene)
    }
}

/// A picked pixel.
struct Hit {
    pick: Pick,
    at: [u32; 2],
    camera: Camera,
}

impl PyScene {
    fn picture(&self, camera: &Camera, options: &Options) -> PyResult<Frame> {
        let mut frame = Frame::default();
        self.draw_into(camera, options, &mut frame).map_err(render_error)?;
        Ok(frame)
    }

    fn mesh_of(&self, node: NodeId) -> Option<&Mesh> {
        let mesh = self.scene.node(node)?.mesh?;
        Some(self.scene.meshes().get(mesh)?.mesh())
    }

    fn hit<'py>(&self, py: Python<'py>, frame: &Frame, hit: &Hit) -> PyResult<Bound<'py, PyDict>> {
        let Hit { pick, at: [x, y], camera } = hit;
        let at = *y as usize * frame.width as usize + *x as usize;
        let is_face = pick.hit.face.is_some();
        let of_face = |vectors: &Option<Vec<trigon_math::Vec3>>| {
            let vectors = vectors.as_ref().filter(|_| is_face)?;
            Some(vectors[at].as_dvec3())
        };
        let id = |ids: &Option<Vec<u32>>| ids.as_ref().map(|ids| ids[at]).filter(|&id| id != u32::MAX);
        let depth = f64::from(frame.depth.as_ref().map_or(f32::INFINITY, |depths| depths[at]));
        let center = DVec2::new(f64::from(*x) + 0.5, f64::from(*y) + 0.5);
        let viewport = trigon_camera::Viewport { width: frame.width, height: frame.height };
        let position = match of_face(&frame.positions) {
            Some(from_camera) => Some(frame.origin + from_camera),
            None => Projector::new(camera, viewport).at_distance(center, depth),
        };
        let edge = pick.edge.and_then(|edge| self.mesh_of(pick.hit.node)?.edges().get(edge as usize));
        let facts = PyDict::new(py);
        facts.set_item("node", pick.hit.node.index())?;
        facts.set_item("name", self.scene.node(pick.hit.node).map(|node| &node.name))?;
        facts.set_item("material", id(&frame.material_ids))?;
        facts.set_item("face", pick.hit.face)?;
        facts.set_item("triangle", id(&frame.triangle_ids))?;
        facts.set_item("barycentrics", of_face(&frame.barycentrics).map(tuple))?;
        let uv = frame.uvs.as_ref().filter(|_| is_face).map(|uvs| uvs[at]);
        facts.set_item("uv", uv.map(|uv| (uv.x, uv.y)))?;
        facts.set_item("position", position.map(tuple))?;
        facts.set_item("normal", of_face(&frame.normals).map(tuple))?;
        facts.set_item("depth", depth)?;
        facts.set_item("distance", position.map(|position| position.distance(camera.position)))?;
        facts.set_item("vertex", pick.vertex)?;
        facts.set_item("edge", edge.map(|&[from, to]| (from, to)))?;
        Ok(facts)
    }

    /// Found elements for Python.
    fn listed<'py>(&self, py: Python<'py>, elements: Elements, found: &Found) -> PyResult<Bound<'py, PyAny>> {
        let sets = match found {
            Found::Nodes(nodes) => return Ok(PyList::new(py, nodes.iter().map(|id| id.index()))?.into_any()),
            Found::Elements(sets) => sets,
        };
        let lists = PyDict::new(py);
        for (node, bits) in sets.nodes() {
            let indices = bits.ones().map(|index| index as i32);
            let edges = self.mesh_of(node).map(Mesh::edges).unwrap_or_default();
            let array = match elements {
                Elements::Edges => {
                    let pairs: Vec<i32> = bits
                        .ones()
                        .filter_map(|index| edges.get(index))
                        .flat_map(|pair| pair.map(|vertex| vertex as i32))
                        .collect();
                    let count = pairs.len() / 2;
                    shaped(py, pairs, &[count, 2])?
                }
                _ => {
                    let indices: Vec<i32> = indices.collect();
                    let count = indices.len();
                    shaped(py, indices, &[count])?
                }
            };
            lists.set_item(node.index(), array)?;
        }
        Ok(lists.into_any())
    }
}

fn tuple(vector: DVec3) -> (f64, f64, f64) {
    // Without negative zeros, which look odd.
    (vector + DVec3::ZERO).into()
}

/// What a box is searched for.
#[derive(Clone, Copy)]
enum Elements {
    Nodes,
    Faces,
    Vertices,
    Edges,
}

enum Found {
    Nodes(Vec<NodeId>),
    Elements(ElementSet),
}

impl Elements {
    fn of(name: &str) -> PyResult<Self> {
        match name {
            "nodes" => Ok(Self::Nodes),
            "faces" => Ok(Self::Faces),
            "vertices" => Ok(Self::Vertices),
            "edges" => Ok(Self::Edges),
            other => Err(value_error(format!(
                "elements is {other:?}, not \"nodes\", \"faces\", \"vertices\" or \"edges\""
            ))),
        }
    }

    fn within(self, picker: &Picker<'_>, region: &Region, reach: Reach) -> Found {
        match self {
            Self::Nodes => Found::Nodes(picker.nodes(region, reach).into_iter().collect()),
            Self::Faces => Found::Elements(picker.faces(region, reach)),
            Self::Vertices => Found::Elements(picker.vertices(region, reach)),
            Self::Edges => Found::Elements(picker.edges(region, reach)),
        }
    }
}
