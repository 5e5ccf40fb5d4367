//! What does a shadow's edge cost? A ball of triangles above a floor, lit from one direction: shadow maps of
//! several sizes and filters, rays, and the engine's own of both kinds, compared with the exact shadow of the
//! same triangles.

use std::num::NonZeroUsize;

use trigon_classic::{Edges, Field, weighted};
use trigon_math::{Bvh, DVec3, Ray, Vec3};
use trigon_mesh::{Mesh, primitives};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    Frame, Light, Lighting, Material, Node, Outputs, RenderSettings, Renderer, Scene, Shading, Shadows,
    Transform,
};

use super::metric::Difference;

/// How the four texels about a point are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapFilter {
    /// The nearest.
    Nearest,
    /// All four, weighted.
    Linear,
}

/// A way to find shadows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shadow {
    /// A depth map of so many texels a side.
    Map(usize, MapFilter),
    /// A ray to the light from each pixel, against a ball of triangles.
    Rays,
}

impl Shadow {
    /// All methods that are compared.
    pub const ALL: [Self; 9] = [
        Self::Map(64, MapFilter::Nearest),
        Self::Map(64, MapFilter::Linear),
        Self::Map(256, MapFilter::Nearest),
        Self::Map(256, MapFilter::Linear),
        Self::Map(1024, MapFilter::Nearest),
        Self::Map(1024, MapFilter::Linear),
        Self::Map(4096, MapFilter::Nearest),
        Self::Map(4096, MapFilter::Linear),
        Self::Rays,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Map(side, MapFilter::Nearest) => format!("map {side}"),
            Self::Map(side, MapFilter::Linear) => format!("map {side}, filtered"),
            Self::Rays => "rays".to_owned(),
        }
    }

    /// What says how much light a point of the floor gets, made ready.
    #[must_use]
    pub fn ready(self) -> Box<dyn Fn([f64; 2]) -> f64> {
        match self {
            Self::Map(side, filter) => {
                let map = ShadowMap::new(side);
                Box::new(move |point| map.light(point, filter))
            }
            Self::Rays => {
                let rays = ShadowRays::new();
                Box::new(move |point| rays.light(point))
            }
        }
    }
}

/// The light on a floor of `side` by `side` pixels as something says it.
pub fn draw(side: usize, light: &dyn Fn([f64; 2]) -> f64) -> Field<f64> {
    let mut image = Field::new([side; 2], 0.0);
    draw_into(&mut image, light);
    image
}

/// The same into a square image.
pub fn draw_into(image: &mut Field<f64>, light: &dyn Fn([f64; 2]) -> f64) {
    let [side, _] = image.size();
    for (y, row) in image.rows_mut().enumerate() {
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = light(point([x, y], side));
        }
    }
}

/// The light as it is: 0 where a triangle of the ball is between a pixel's centre and the light,
/// else 1.
#[must_use]
pub fn exact(side: usize) -> Field<f64> {
    exact_light(side)
}

/// How far an image is from right, in the pixels that lie within two of the shadow's edge.
#[must_use]
pub fn error(drawn: &Field<f64>, right: &Field<f64>) -> Difference {
    let is_near_edge = |[x, y]: [usize; 2]| {
        let around =
            (y.saturating_sub(2)..=y + 2).flat_map(|y| (x.saturating_sub(2)..=x + 2).map(move |x| [x, y]));
        let mut lights = around.filter_map(|position| right.get(position.map(|part| part as i32)));
        lights.any(|light| *light != right[[x, y]])
    };
    let near = drawn.pixels().filter(|(position, _)| is_near_edge(*position));
    Difference::of(near.map(|(position, &light)| [light, right[position]]))
}

/// Towards the light; of length 1.
const LIGHT: DVec3 = DVec3::new(2.0 / 7.0, 6.0 / 7.0, 3.0 / 7.0);

/// The middle of the ball.
const BALL: DVec3 = DVec3::new(0.4, 1.2, 0.6);

/// How wide and deep the floor is.
const FLOOR: f64 = 4.0;

/// The ball about its own middle.
fn ball() -> Mesh {
    primitives::icosphere(1.0, 4)
}

/// The triangles of the ball where it stands: what maps and rays get alike.
fn triangles() -> Vec<[DVec3; 3]> {
    let mesh = ball();
    let corner = |&vertex: &u32| mesh.positions()[vertex as usize].as_dvec3() + BALL;
    let triangle = |face: usize| {
        let corners = mesh.face_vertices(face);
        [corner(&corners[0]), corner(&corners[1]), corner(&corners[2])]
    };
    (0..mesh.face_count()).map(triangle).collect()
}

/// Two directions across the light.
fn across() -> [DVec3; 2] {
    let one = LIGHT.cross(DVec3::X).normalize();
    [one, LIGHT.cross(one)]
}

/// The place on the floor, in metres from its middle, of a pixel's centre.
fn point(pixel: [usize; 2], side: usize) -> [f64; 2] {
    pixel.map(|part| ((part as f64 + 0.5) / side as f64 - 0.5) * FLOOR)
}

/// In space.
fn on_floor([x, z]: [f64; 2]) -> DVec3 {
    DVec3::new(x, 0.0, z)
}

/// The light in each pixel of the floor, 0 or 1: the triangles are moved along the light onto the
/// floor, and what one of them covers there is dark. In `f64`, by nothing that draws elsewhere.
fn exact_light(side: usize) -> Field<f64> {
    let mut light = Field::new([side; 2], 1.0);
    for triangle in triangles() {
        // In pixels, whole numbers at their centres.
        let [a, b, c] = triangle.map(|corner| {
            let fallen = corner - LIGHT * (corner.y / LIGHT.y);
            [fallen.x, fallen.z].map(|part| (part / FLOOR + 0.5) * side as f64 - 0.5)
        });
        let [columns, rows] = [0, 1].map(|axis| {
            let [low, high] = crate::fill::range([a[axis], b[axis], c[axis]]);
            // Within the image: the whole shadow falls on the floor, and numbers below zero become zero.
            low.ceil() as usize..=high.floor() as usize
        });
        for [x, y] in rows.flat_map(|y| columns.clone().map(move |x| [x, y])) {
            let turn = |p: [f64; 2], q: [f64; 2]| {
                (q[0] - p[0]) * (y as f64 - p[1]) - (q[1] - p[1]) * (x as f64 - p[0])
            };
            let turns = [turn(a, b), turn(b, c), turn(c, a)];
            if turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0) {
                light[[x, y]] = 0.0;
            }
        }
    }
    light
}

/// The scene and what it takes to draw it again and again, on one thread.
pub struct ShadowDrawer {
    scene: Scene,
    camera: Camera,
    renderer: Renderer,
    frame: Frame,
}

impl ShadowDrawer {
    /// An image of `side` by `side` pixels that shows the floor and nothing else.
    #[must_use]
    pub fn new(shadows: Shadows, side: usize) -> Self {
        let mut settings = RenderSettings::new(side as u32, side as u32);
        settings.samples_per_axis = 1;
        settings.threads = Some(NonZeroUsize::MIN);
        settings.lighting = Lighting::Scene;
        settings.outputs = Outputs { color: false, radiance: true, ..Outputs::default() };
        settings.effects.shadows = shadows;
        Self { scene: scene(), camera: camera(), renderer: Renderer::new(settings), frame: Frame::default() }
    }

    /// Draws the image. What can be kept of it, maps and trees, is kept for the next one.
    pub fn draw(&mut self) {
        let drawn = self.renderer.render_into(&self.scene, &self.camera, &mut self.frame);
        drawn.expect("images of the study have a size in range");
    }

    /// The share of light in each pixel.
    pub fn light(&self) -> Field<f64> {
        let radiance = self.frame.radiance.as_ref().expect("it was asked for");
        let most = radiance.iter().map(|color| color.x).fold(0.0, f32::max);
        let side = self.frame.width as usize;
        Field::from_fn([side; 2], |[x, y]| f64::from(radiance[y * side + x].x / most))
    }
}

fn scene() -> Scene {
    let mut scene = Scene::new();
    let white = Material { shading: Shading::Lambert, ..Material::from_color(Vec3::ONE) };
    scene.add_object("floor", primitives::plane(FLOOR as f32, FLOOR as f32), white);
    let mesh = scene.add_mesh("ball", ball());
    let material = scene.add_material(Material::from_color(Vec3::ONE));
    scene.add(Node::from_mesh(mesh, material).at(BALL));
    let orientation = Camera::look_at(LIGHT, DVec3::ZERO, DVec3::Y).orientation;
    let sun = Transform::from_scale_rotation_translation(DVec3::ONE, orientation, DVec3::ZERO);
    scene.add(Node::from_light(Light::directional(1.0)).with_transform(sun));
    scene
}

/// Looks straight down from below the ball, whose lowest point is 0.2 metres above the floor.
fn camera() -> Camera {
    let eye = DVec3::new(0.0, 0.1, 0.0);
    let projection = Projection::orthographic(FLOOR, 0.01, 1.0).expect("the planes are in order");
    Camera { projection, ..Camera::look_at(eye, DVec3::ZERO, DVec3::NEG_Z) }
}

/// Shadow maps (L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978): the map stores the
/// depth nearest to the light. Filtering is percentage-closer (W. T. Reeves, D. H. Salesin and R. L. Cook,
/// "Rendering antialiased shadows with depth maps", SIGGRAPH 1987): results of comparisons are averaged, not
/// depths.
///
/// The distance of the nearest triangle from the light's plane through the origin, by texel; minus
/// infinity where there is none.
pub struct ShadowMap {
    texels: Field<f32>,
}

/// The map reaches so far from the ball's middle: just round it.
const REACH: f64 = 1.05;

impl ShadowMap {
    /// As a light sees the ball, with a square of texels round it: its triangles, drawn with a
    /// z-buffer.
    #[must_use]
    pub fn new(side: usize) -> Self {
        let mut texels = Field::new([side; 2], f32::NEG_INFINITY);
        let across = across();
        let pixel = |corner: DVec3| {
            across.map(|axis| {
                let texel = ((corner - BALL).dot(axis) / REACH + 1.0) / 2.0 * side as f64;
                (texel * 256.0).round() as i64
            })
        };
        for triangle in triangles() {
            let Some(edges) = Edges::new(triangle.map(pixel), 256) else { continue };
            let depths = edges.shares(triangle.map(|corner| corner.dot(LIGHT)));
            edges.each_covered(&edges.bounding_box([side as i32; 2]), |[x, y], weights| {
                let nearest = &mut texels[[x as usize, y as usize]];
                let depth = weighted(&depths, weights) as f32;
                if depth > *nearest {
                    *nearest = depth;
                }
            });
        }
        Self { texels }
    }

    /// The share of light that a point of the floor gets.
    #[must_use]
    pub fn light(&self, point: [f64; 2], filter: MapFilter) -> f64 {
        let point = on_floor(point);
        let side = self.texels.size()[0] as f64;
        // In texels, whole numbers at their centres.
        let [u, v] = across().map(|axis| ((point - BALL).dot(axis) / REACH + 1.0) / 2.0 * side - 0.5);
        match filter {
            MapFilter::Nearest => self.is_lit([u.round(), v.round()], point),
            MapFilter::Linear => {
                let [left, top] = [u.floor(), v.floor()];
                let (x, y) = (u - left, v - top);
                let corner = |dx: f64, dy: f64| self.is_lit([left + dx, top + dy], point);
                let [above, below] = [0.0, 1.0].map(|dy| corner(0.0, dy) * (1.0 - x) + corner(1.0, dy) * x);
                above * (1.0 - y) + below * y
            }
        }
    }

    /// 1 unless the texel holds something nearer to the light. The floor lies far enough
    /// from the ball for no bias to be needed.
    fn is_lit(&self, texel: [f64; 2], point: DVec3) -> f64 {
        let nearest = self.texels.get(texel.map(|part| part as i32));
        let is_hidden = nearest.is_some_and(|&depth| f64::from(depth) > point.dot(LIGHT));
        if is_hidden { 0.0 } else { 1.0 }
    }
}

/// A ray from each point to the light (T. Whitted, "An improved illumination model for shaded display", CACM
/// 23(6), 1980), tested against a tree of triangles.
///
/// A ball of 5,120 triangles in a tree.
pub struct ShadowRays {
    tree: Bvh,
}

impl Default for ShadowRays {
    fn default() -> Self {
        Self::new()
    }
}

impl ShadowRays {
    /// Builds the tree.
    #[must_use]
    pub fn new() -> Self {
        let triangles: Vec<[Vec3; 3]> =
            triangles().into_iter().map(|triangle| triangle.map(|corner| corner.as_vec3())).collect();
        Self { tree: Bvh::new(&triangles) }
    }

    /// 0 or 1.
    #[must_use]
    pub fn light(&self, point: [f64; 2]) -> f64 {
        let ray = Ray { origin: on_floor(point).as_vec3(), direction: LIGHT.as_vec3() };
        if self.tree.occluded(&ray, 0.0..f32::INFINITY) { 0.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests;
