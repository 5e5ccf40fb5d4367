//! Scenes at random for regions: balls, grids, solids, meshes that are no surface, in and
//! through each other, single- and double-sided, mirrored, and cut by the near plane.

use trigon_camera::{Camera, Projection, orientation_looking};
use trigon_math::{DQuat, DVec2, DVec3, Vec3};
use trigon_mesh::{Mesh, MeshBuilder, primitives};

use super::super::Region;
use crate::{Material, Scene, Transform};

/// G. Marsaglia, "Xorshift RNGs", 2003. It is not `trigon_math::SplitMix64`, because the oracle of these tests shares nothing with
/// the engine.
pub(super) struct Random(pub(super) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn below(&mut self, end: u64) -> u64 {
        (self.next() >> 20) % end
    }

    fn vector(&mut self, reach: f64) -> DVec3 {
        DVec3::new(self.within(-reach, reach), self.within(-reach, reach), self.within(-reach, reach))
    }

    fn rotation(&mut self) -> DQuat {
        let [axis, w] = [self.vector(1.0), DVec3::splat(self.within(0.1, 1.0))];
        DQuat::from_xyzw(axis.x, axis.y, axis.z, w.x).normalize()
    }
}

/// Three sides at one edge, a face twice, one with a repeated vertex, a star-shaped one,
/// and loose edges and points.
fn no_surface() -> Mesh {
    let mut builder = MeshBuilder::new();
    let mut vertex = |x, y, z| builder.push_vertex(Vec3::new(x, y, z));
    let [low, high] = [vertex(0.0, -0.5, 0.0), vertex(0.0, 0.6, 0.1)];
    let ends = [(0.7, 0.1), (-0.5, 0.6), (-0.4, -0.7)].map(|(x, z)| [vertex(x, -0.6, z), vertex(x, 0.5, z)]);
    let loose = [vertex(0.2, 0.9, 0.3), vertex(-0.8, -0.2, -0.9), vertex(0.9, 0.9, -0.2)];
    let star = [(0.5, 0.0), (0.1, 0.1), (0.0, 0.5), (-0.1, 0.1), (-0.5, -0.4), (0.0, -0.1)]
        .map(|(x, z)| vertex(x, 0.75, z));
    vertex(3.0, 3.0, 3.0);
    for [lower, upper] in ends {
        builder.push_face(&[low, lower, upper, high]).expect("its vertices are there");
    }
    builder.push_face(&[low, ends[0][0], ends[0][1], high]).expect("the first one again");
    builder.push_face(&[loose[0], low, low, loose[2]]).expect("a vertex twice");
    builder.push_face(&star).expect("not convex");
    builder.push_loose_edge(loose[0], loose[1]).expect("its vertices are there");
    builder.push_loose_edge(loose[1], high).expect("its vertices are there");
    builder.push_loose_point(loose[2]).expect("its vertex is there");
    builder.build()
}

fn mesh(random: &mut Random) -> Mesh {
    match random.below(7) {
        0 => primitives::uv_sphere(0.8, 11, 6),
        1 => primitives::icosphere(0.9, 1),
        2 => primitives::grid(2.0, 1.6, 7, 6),
        3 => primitives::cube(1.1),
        4 => primitives::torus(0.7, 0.3, 12, 7),
        5 => primitives::dodecahedron(0.6),
        _ => no_surface(),
    }
}

/// Three to five objects around the origin.
pub(super) fn scene(random: &mut Random) -> Scene {
    let mut scene = Scene::new();
    for number in 0..3 + random.below(3) {
        let material = Material { double_sided: random.below(2) == 0, ..Material::default() };
        let node = scene.add_object(format!("object {number}"), mesh(random), material);
        let mirror = if random.below(3) == 0 { -1.0 } else { 1.0 };
        let scale =
            DVec3::new(random.within(0.6, 1.4) * mirror, random.within(0.6, 1.4), random.within(0.6, 1.4));
        let (rotation, place) = (random.rotation(), random.vector(0.8));
        let node = scene.node_mut(node).expect("just added");
        node.transform = Transform::from_scale_rotation_translation(scale, rotation, place);
    }
    scene
}

/// In a perspective or parallel, and in every third through the near plane.
pub(super) fn camera(random: &mut Random) -> Camera {
    let direction = random.vector(1.0).normalize();
    let distance = random.within(3.5, 5.0);
    let near = if random.below(3) == 0 { distance - random.within(0.0, 0.8) } else { 0.05 };
    let far = if random.below(2) == 0 { Some(distance + random.within(0.3, 4.0)) } else { None };
    let projection = if random.below(2) == 0 {
        Projection::perspective(random.within(0.4, 0.9), near, far)
    } else {
        Projection::orthographic(random.within(2.0, 4.0), near, far.unwrap_or(20.0))
    };
    Camera {
        position: random.vector(0.3) - direction * distance,
        orientation: orientation_looking(direction, DVec3::Y),
        projection: projection.expect("in range"),
    }
}

/// One of each kind, on and around an image.
pub(super) fn regions(random: &mut Random, size: DVec2) -> [Region; 4] {
    let mut point = |beside: f64| {
        DVec2::new(random.within(-beside, size.x + beside), random.within(-beside, size.y + beside))
    };
    let (a, b, middle) = (point(5.0), point(5.0), point(0.0));
    let corners = (0..7).map(|_| point(10.0)).collect();
    let target = point(0.0);
    [
        Region::Point(target),
        Region::Rectangle { min: a.min(b), max: a.max(b) },
        Region::Circle { center: middle, radius: random.within(2.0, 0.4 * size.x) },
        Region::Lasso(corners),
    ]
}
