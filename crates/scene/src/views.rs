//! Cameras that see the whole scene: one, or many around it.
//!
//! [`turntable`], [`sphere`] and [`hemisphere`] generate the directions from the middle of the scene to each
//! camera; [`Scene::surround`] turns them into cameras, all at the same distance.
//!
//! Directions are unit vectors, and +Y is up. The same arguments give the same bits on every machine.

use std::f64::consts::{PI, TAU};

use trigon_camera::{Camera, DEFAULT_MARGIN, Extent};
use trigon_math::{Bounds3, DQuat, DVec3, SplitMix64, elementary};

use crate::scene::{PlacedMesh, Scene};

/// Where the overview looks in a world with +Y up: down from the upper right, in front.
pub const OVERVIEW_DIRECTION: DVec3 = DVec3::new(-1.0, -0.5, -1.0);

impl Scene {
    /// A perspective camera that sees everything visible from the upper right
    /// in front, with [`Scene::up`] up and a tenth of the image left free. `aspect`
    /// is width over height.
    #[must_use]
    pub fn overview(&self, aspect: f64) -> Camera {
        let points: Vec<DVec3> = self.visible_points().collect();
        let (direction, up) = (self.up.frame() * OVERVIEW_DIRECTION, self.up.direction());
        Camera::default().fit_points(&points, direction, up, aspect, DEFAULT_MARGIN)
    }

    /// A perspective camera at each of these viewpoints: unit vectors from the middle of
    /// the box around everything visible towards the eye, for a world with +Y up; they are
    /// turned to [`Scene::up`]. `aspect` is width over height.
    ///
    /// All stand equally far away, so that nothing grows or shrinks from one image to the next. They are as
    /// near as a ball about that middle that holds every vertex allows, with a tenth of the image left free.
    /// A camera depends on its own viewpoint only, not on the others.
    ///
    /// ```
    /// use trigon_scene::{showcase, views};
    ///
    /// let cameras: Vec<_> = showcase().surround(views::sphere(100, 42), 1.5).collect();
    /// assert_eq!(cameras.len(), 100);
    /// ```
    pub fn surround<V>(&self, viewpoints: V, aspect: f64) -> impl Iterator<Item = Camera> + use<V>
    where
        V: IntoIterator<Item = DVec3>,
    {
        let points: Vec<DVec3> = self.visible_points().collect();
        let bounds = Bounds3::from_points(points.iter().copied().filter(|point| point.is_finite()));
        let center = Extent::new(&bounds).center();
        let distance = ball_distance(&points, &bounds, aspect);
        let up = self.up;
        viewpoints.into_iter().map(move |viewpoint| {
            let eye = center + up.frame() * viewpoint * distance;
            Camera::look_at(eye, center, up.direction()).with_clip_planes(&bounds)
        })
    }

    /// The vertices of everything visible, in the world and in their poses, without
    /// those that no face, edge or point uses: what a camera is fitted to.
    pub fn visible_points(&self) -> impl Iterator<Item = DVec3> {
        self.placed_meshes().flat_map(PlacedMesh::into_used_points)
    }
}

/// How far from the middle of the box a default camera stands that sees the ball
/// around all points, with the usual margin.
fn ball_distance(points: &[DVec3], bounds: &Bounds3, aspect: f64) -> f64 {
    let extent = Extent::new(bounds);
    let reach = points.iter().map(|point| point.distance(extent.center())).filter(|reach| reach.is_finite());
    let reach = reach.fold(0.0, |farthest, reach| if reach > farthest { reach } else { farthest });
    let radius = if reach > 0.0 { reach } else { extent.radius() };
    let half_height = Camera::default().projection.height_at(1.0) * 0.5;
    let half_width = half_height * aspect;
    // The tangent of the angle between the line of sight and a line that touches the ball.
    let slope = (1.0 - DEFAULT_MARGIN) * if half_width < half_height { half_width } else { half_height };
    radius * (1.0 + 1.0 / (slope * slope)).sqrt()
}

/// The angle between one point of a Fibonacci lattice and the next: 2π less its golden
/// section.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Once around at one height: `count` viewpoints, counter-clockwise seen from above,
/// beginning in front (+Z). `elevation` is the angle above the horizon in radians,
/// −π/2 to π/2.
#[must_use]
pub fn turntable(count: usize, elevation: f64) -> impl ExactSizeIterator<Item = DVec3> {
    let (height, out) = elementary::sin_cos(elevation);
    (0..count).map(move |index| {
        let (sin, cos) = elementary::sin_cos(TAU * (index as f64 / count as f64));
        DVec3::new(out * sin, height, out * cos).normalize()
    })
}

/// `count` viewpoints spread evenly over all directions: a Fibonacci lattice, turned as
/// `seed` says; every turn is equally likely.
///
/// The lattice is that of Swinbank and Purser, "Fibonacci grids" (2006); the turn is
/// Shoemake's, "Uniform random rotations" (Graphics Gems III, 1992).
#[must_use]
pub fn sphere(count: usize, seed: u64) -> impl ExactSizeIterator<Item = DVec3> {
    let turn = random_turn(&mut SplitMix64::new(seed));
    (0..count).map(move |index| {
        let height = 1.0 - (2.0 * index as f64 + 1.0) / count as f64;
        (turn * lattice_point(index, height, 0.0)).normalize()
    })
}

/// `count` viewpoints spread evenly over the directions above the horizon, none on it:
/// a Fibonacci lattice that `seed` turns about the vertical and shifts by a part of its
/// own spacing.
#[must_use]
pub fn hemisphere(count: usize, seed: u64) -> impl ExactSizeIterator<Item = DVec3> {
    let mut random = SplitMix64::new(seed);
    let (azimuth, shift) = (TAU * random.unit(), random.unit());
    (0..count).map(move |index| {
        // Above 0, whatever is rounded: the smallest minuend is 1.
        let height = ((count - index) as f64 - shift) / count as f64;
        lattice_point(index, height, azimuth).normalize()
    })
}

/// The point at a height of −1 to 1, turned by the golden angle from the one before.
fn lattice_point(index: usize, height: f64, azimuth: f64) -> DVec3 {
    let (sin, cos) = elementary::sin_cos(azimuth + GOLDEN_ANGLE * index as f64);
    let out = (1.0 - height * height).sqrt();
    DVec3::new(out * sin, height, out * cos)
}

fn random_turn(random: &mut SplitMix64) -> DQuat {
    let [share, first, second] = [(); 3].map(|()| random.unit());
    let [(s1, c1), (s2, c2)] = [first, second].map(|turn| elementary::sin_cos(2.0 * PI * turn));
    let (near, far) = ((1.0 - share).sqrt(), share.sqrt());
    DQuat::from_xyzw(near * s1, near * c1, far * s2, far * c2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Material, Node, Transform};
    use trigon_camera::{Projector, Viewport};
    use trigon_math::DVec2;
    use trigon_mesh::primitives;

    /// A slim box far from the origin.
    fn tower() -> Scene {
        let mut scene = Scene::new();
        let id = scene.add_object("tower", primitives::cube(1.0), Material::default());
        let node: &mut Node = scene.node_mut(id).expect("just added");
        node.transform = Transform::from_scale_rotation_translation(
            DVec3::new(1.0, 9.0, 1.0),
            DQuat::IDENTITY,
            DVec3::new(1e6, -300.0, 5.0),
        );
        scene
    }

    #[test]
    fn every_camera_sees_all_from_the_same_distance() {
        let scene = tower();
        for viewport in [Viewport { width: 300, height: 200 }, Viewport { width: 100, height: 400 }] {
            let aspect = viewport.aspect();
            let middle = Extent::new(&scene.bounds()).center();
            let distances = scene.surround(sphere(40, 5), aspect).map(|camera| {
                let projector = Projector::new(&camera, viewport);
                for point in scene.visible_points() {
                    let at = projector.to_screen(point).expect("before the camera") / viewport.size();
                    // Less than the margin: perspective widens what is near, which the ball covers.
                    let free = DEFAULT_MARGIN / 2.0 - 1e-6;
                    assert!(at.cmpge(DVec2::splat(free)).all(), "{at} is in the image, {viewport:?}");
                    assert!(at.cmple(DVec2::splat(1.0 - free)).all(), "{at} is in the image, {viewport:?}");
                }
                camera.position.distance(middle)
            });
            let distances: Vec<f64> = distances.collect();
            let apart = |a: &f64| (a / distances[0] - 1.0).abs();
            assert!(distances.iter().all(|a| apart(a) < 1e-9), "equally far: {distances:?}");
        }
    }

    #[test]
    fn a_ball_fills_the_image_up_to_the_margin() {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::icosphere(2.0, 4), Material::default());
        let viewport = Viewport { width: 200, height: 200 };
        for camera in scene.surround(hemisphere(5, 1), 1.0) {
            let projector = Projector::new(&camera, viewport);
            let rows = scene.visible_points().filter_map(|point| projector.to_screen(point));
            let lowest = rows.map(|at| at.y).fold(0.0, f64::max);
            assert!((lowest - 190.0).abs() < 1.0, "a twentieth of 200 pixels stays free below: {lowest}");
        }
    }

    /// In an image that is higher than wide its width is what limits.
    #[test]
    fn a_ball_fills_a_narrow_image_from_side_to_side() {
        let mut scene = Scene::new();
        scene.add_object("ball", primitives::icosphere(2.0, 4), Material::default());
        let distance = |aspect: f64| {
            let camera = scene.surround(turntable(1, 0.0), aspect).next().expect("one viewpoint");
            camera.position.length()
        };
        for (width, height) in [(100, 200), (150, 200), (40, 200)] {
            let viewport = Viewport { width, height };
            for camera in scene.surround(turntable(3, 0.3), viewport.aspect()) {
                let projector = Projector::new(&camera, viewport);
                let columns = scene.visible_points().filter_map(|point| projector.to_screen(point));
                let right = columns.map(|at| at.x).fold(0.0, f64::max) / f64::from(width);
                assert!((right - 0.95).abs() < 0.01, "a twentieth stays free: {right} of {width}");
            }
        }
        assert_eq!(distance(1.0), distance(3.0), "in a wide one its height");
        assert!(distance(0.5) > 1.5 * distance(1.0));
    }

    #[test]
    fn a_scene_of_nothing_has_cameras_too() {
        let cameras: Vec<Camera> = Scene::new().surround(turntable(3, 0.2), 1.5).collect();
        assert_eq!(cameras.len(), 3, "one for each viewpoint");
        assert!(cameras.iter().all(|camera| camera.position.is_finite()), "{cameras:?}");
    }

    const COUNTS: [usize; 4] = [1, 2, 17, 400];

    /// The last of 17 viewpoints of each kind, as f64's bits.
    const KNOWN: [[u64; 3]; 3] = [
        [0xbfd1_aec8_4602_7789, 0x3fe4_9d6e_6946_19b8, 0x3fe6_d27c_6ea4_6394],
        [0xbfd8_83e4_1148_27ad, 0xbfec_c2ff_c556_a6f9, 0x3fcb_47df_e8ff_9220],
        [0xbf80_84f7_7d31_ceb0, 0x3fad_9cad_8c3d_9e8d, 0xbfef_f205_3c73_16eb],
    ];

    fn all(count: usize, seed: u64) -> [Vec<DVec3>; 3] {
        let height = seed as f64 / 10.0;
        [turntable(count, height).collect(), sphere(count, seed).collect(), hemisphere(count, seed).collect()]
    }

    #[test]
    fn viewpoints_are_as_many_unit_vectors_as_asked_for() {
        for count in COUNTS {
            for seed in 0..5 {
                for points in all(count, seed) {
                    assert_eq!(points.len(), count, "as many");
                    let far = points.iter().map(|point| (point.length() - 1.0).abs()).fold(0.0, f64::max);
                    assert!(far < 1e-15, "of unit length, but for {far}");
                }
            }
        }
        assert_eq!(all(0, 3), [const { Vec::new() }; 3], "none");
    }

    #[test]
    fn a_seed_reproduces_its_viewpoints_and_no_other_s() {
        for count in COUNTS {
            assert_eq!(all(count, 7), all(count, 7), "the same again");
            for (a, b) in all(count, 7).iter().zip(&all(count, 8)) {
                assert!(a.iter().zip(b).all(|(a, b)| a != b), "another seed, other viewpoints");
            }
        }
    }

    /// The bits that this machine found; every other has to find them, too.
    #[test]
    fn the_bits_are_the_same_on_every_machine() {
        let bits = |point: DVec3| point.to_array().map(f64::to_bits);
        let found = all(17, 7).map(|points| bits(points[16]));
        assert_eq!(found, KNOWN, "the last of 17: {found:#x?}");
    }

    #[test]
    fn hemispheres_are_above_the_horizon() {
        for count in COUNTS {
            for seed in 0..50 {
                assert!(hemisphere(count, seed).all(|point| point.y > 0.0), "{count} with {seed}");
            }
        }
    }

    #[test]
    fn a_turntable_goes_around_at_one_height() {
        let points: Vec<DVec3> = turntable(4, 0.5).collect();
        let (height, out) = elementary::sin_cos(0.5);
        for (point, [x, z]) in points.iter().zip([[0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]]) {
            let expected = DVec3::new(x * out, height, z * out);
            assert!(point.distance(expected) < 1e-15, "{point}, not {expected}");
        }
    }

    /// Evenly: no two are nearer than a share of the distance that the cells of a
    /// perfect lattice have, and every direction has one about as near.
    #[test]
    fn nothing_is_crowded_and_nothing_is_left_out() {
        let spacing = |area: f64, count: usize| (area / count as f64).sqrt();
        for seed in 0..4 {
            let count = 400;
            check_spread(&sphere(count, seed).collect::<Vec<_>>(), spacing(4.0 * PI, count), |_| true);
            let above = |point: &DVec3| point.y > 0.15;
            check_spread(&hemisphere(count, seed).collect::<Vec<_>>(), spacing(2.0 * PI, count), above);
        }
    }

    fn check_spread(points: &[DVec3], spacing: f64, is_covered: impl Fn(&DVec3) -> bool) {
        let nearest = |at: DVec3, but: usize| {
            let others = points.iter().enumerate().filter(|&(index, _)| index != but);
            others.map(|(_, point)| point.distance(at)).fold(f64::INFINITY, f64::min)
        };
        for (index, &point) in points.iter().enumerate() {
            let near = nearest(point, index) / spacing;
            assert!(near > 0.5, "number {index} has a neighbour at {near} spacings");
        }
        for direction in sphere(999, 12345).filter(is_covered) {
            let far = nearest(direction, usize::MAX) / spacing;
            assert!(far < 1.0, "the nearest to {direction} is {far} spacings away");
        }
    }
}
