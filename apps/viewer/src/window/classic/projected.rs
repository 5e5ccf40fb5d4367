//! A scene in the form that the classical algorithms need: bodies on the pixel grid.

use std::collections::HashMap;

use trigon_camera::{Camera, Projector, Viewport};
use trigon_classic::{Body, Corner, DEPTH_LIMIT, STEPS_PER_PIXEL, Scene as Bodies};
use trigon_math::{DAffine3, DVec2, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::math::color;
use trigon_scene::{Node, RenderSettings, Scene};

/// Steps of the grid in a pixel.
const STEPS: f64 = STEPS_PER_PIXEL as f64;

/// The greatest depth that they take, towards the eye.
const DEEPEST: f64 = DEPTH_LIMIT as f64 - 1.0;

/// Pixels from the image's corner within which their integers are exact: the
/// engine's guard band.
const FARTHEST: f64 = 32_768.0;

/// Part of the light that comes from everywhere; the rest comes from the eye.
const AMBIENT: f64 = 0.2;

/// Bodies before the eye, and the colour of each of their faces.
pub(super) struct Projected {
    pub(super) bodies: Bodies,
    /// sRGB, by the number of the face.
    pub(super) colors: Vec<[u8; 4]>,
}

/// A point on the screen: pixels, and the depth of the depth buffer.
type ProjectedVertex = (DVec2, f64);

impl Projected {
    /// What the camera sees. Bodies are the parts of meshes that share no point with
    /// another; meshes are taken at rest.
    ///
    /// # Errors
    /// When something lies behind the eye or far outside of the image: the algorithms
    /// do not clip.
    pub(super) fn new(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Self, String> {
        let viewport = Viewport { width: settings.width, height: settings.height };
        let projector = Projector::new(camera, viewport);
        let mut parts = Vec::new();
        let transforms = scene.visible_transforms();
        for (id, node) in scene.nodes().iter() {
            let Some(Some(transform)) = transforms.get(id.index()).copied() else { continue };
            let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
            let (mesh, albedo) = (asset.mesh(), albedo(scene, node));
            parts.extend(cut(mesh, &placed(mesh, &transform, &projector)?, |corners| {
                shade(
                    corners.map(|vertex| transform.transform_point3(mesh.positions()[vertex].as_dvec3())),
                    camera,
                    albedo,
                )
            }));
        }
        Ok(Self::of_parts(parts, viewport))
    }

    fn of_parts(parts: Vec<Part>, viewport: Viewport) -> Self {
        let depths = || parts.iter().flat_map(|part| part.vertices.iter().map(|(_, depth)| *depth));
        // Depths of the depth buffer are plane on the screen, and remain so.
        let (least, most) =
            depths().fold((f64::INFINITY, 0.0_f64), |(low, high), z| (low.min(z), high.max(z)));
        let scale = DEEPEST / (most - least).max(f64::MIN_POSITIVE);
        let corner = |(point, depth): &ProjectedVertex| -> Corner {
            let depth = ((depth - least) * scale).clamp(0.0, DEEPEST);
            [point.x * STEPS, point.y * STEPS, depth].map(|part| part.round() as i32)
        };
        let colors = parts.iter().flat_map(|part| part.colors.iter().copied()).collect();
        let bodies = parts.into_iter().map(|part| Body {
            corners: part.vertices.iter().map(corner).collect(),
            triangles: part.triangles,
        });
        let size = [viewport.width as usize, viewport.height as usize];
        Self { bodies: Bodies::new(size, bodies.collect()), colors }
    }
}

/// One body on its way to the grid.
#[derive(Default)]
struct Part {
    vertices: Vec<ProjectedVertex>,
    triangles: Vec<[usize; 3]>,
    colors: Vec<[u8; 4]>,
}

/// Where the vertices are on the screen.
fn placed(mesh: &Mesh, transform: &DAffine3, projector: &Projector) -> Result<Vec<ProjectedVertex>, String> {
    let project = |position: &trigon_scene::math::Vec3| {
        let point = projector.to_screen_and_depth(transform.transform_point3(position.as_dvec3()));
        point.filter(|(point, depth)| point.abs().max_element() < FARTHEST && *depth <= 1.0)
    };
    let vertices: Option<Vec<ProjectedVertex>> = mesh.positions().iter().map(project).collect();
    vertices.ok_or_else(|| "parts of the model lie behind the eye or far outside the image, and this algorithm does not clip; move the camera back".to_owned())
}

/// Divides a mesh into the parts that hang together, vertices at the same place being
/// one. The colours are those of triangles, by their vertices.
fn cut(mesh: &Mesh, projected: &[ProjectedVertex], color: impl Fn([usize; 3]) -> [u8; 4]) -> Vec<Part> {
    let mut joined = Joined::new(mesh);
    let vertices = mesh.corner_vertices();
    let triangles: Vec<[usize; 3]> = mesh
        .triangulation()
        .triangles
        .iter()
        .map(|corners| corners.map(|corner| vertices[corner as usize] as usize))
        .collect();
    triangles.iter().for_each(|&[a, b, c]| {
        joined.join(a, b);
        joined.join(b, c);
    });
    let (mut parts, mut numbers): (Vec<Part>, HashMap<usize, usize>) = Default::default();
    let mut known: HashMap<usize, usize> = HashMap::new();
    for triangle in triangles {
        let number = *numbers.entry(joined.root(triangle[0])).or_insert_with(|| {
            parts.push(Part::default());
            parts.len() - 1
        });
        let part = &mut parts[number];
        let corners = triangle.map(|vertex| {
            *known.entry(joined.same(vertex)).or_insert_with(|| {
                part.vertices.push(projected[vertex]);
                part.vertices.len() - 1
            })
        });
        part.triangles.push(corners);
        part.colors.push(color(triangle));
    }
    parts
}

/// Vertices that hang together (R. E. Tarjan, "Efficiency of a good but not linear set
/// union algorithm", 1975; with halved paths).
struct Joined {
    parents: Vec<usize>,
    /// The first vertex at the same place.
    same: Vec<usize>,
}

impl Joined {
    fn new(mesh: &Mesh) -> Self {
        let mut first: HashMap<[u32; 3], usize> = HashMap::new();
        // Zeros of both signs are one place.
        let key =
            |position: &trigon_scene::math::Vec3| position.to_array().map(|part| (part + 0.0).to_bits());
        let same: Vec<usize> = mesh
            .positions()
            .iter()
            .enumerate()
            .map(|(vertex, position)| *first.entry(key(position)).or_insert(vertex))
            .collect();
        Self { parents: same.clone(), same }
    }

    fn same(&self, vertex: usize) -> usize {
        self.same[vertex]
    }

    fn root(&mut self, mut vertex: usize) -> usize {
        while self.parents[vertex] != vertex {
            self.parents[vertex] = self.parents[self.parents[vertex]];
            vertex = self.parents[vertex];
        }
        vertex
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.parents[one] = other;
    }
}

/// Linear RGB of a node: of its first material, without textures.
fn albedo(scene: &Scene, node: &Node) -> DVec3 {
    let material = node.materials.first().and_then(|&id| scene.materials.get(id));
    material.map_or(DVec3::splat(0.8), |material| material.base_color.truncate().as_dvec3())
}

/// Light from the eye on a whole triangle of the world.
fn shade([a, b, c]: [DVec3; 3], camera: &Camera, albedo: DVec3) -> [u8; 4] {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let light = AMBIENT + (1.0 - AMBIENT) * normal.dot(camera.forward()).abs();
    let [r, g, b] = (albedo * light).to_array().map(|part| color::linear_to_srgb8(part as f32));
    [r, g, b, 255]
}
