//! The tree answers as a look at every triangle does.

use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::*;
use crate::at_level;
use crate::simd::Token;

fn vector() -> impl Strategy<Value = Vec3> {
    // A coarse grid, too: rays then meet edges, vertices and sides of boxes.
    let coordinate = prop_oneof![-4.0_f32..4.0, (-4_i8..=4).prop_map(f32::from)];
    [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
}

/// Triangles and rays at any distance from the origin and of any size.
#[derive(Debug)]
struct FarScene {
    triangles: Vec<[Vec3; 3]>,
    rays: Vec<Ray>,
}

fn far_scene() -> impl Strategy<Value = FarScene> {
    // Powers of two.
    let size = (-20_i32..20).prop_map(|exponent| f32::from_bits(((exponent + 127) as u32) << 23));
    let far = [-1e6_f32..1e6, -1e6_f32..1e6, -1e6_f32..1e6].prop_map(Vec3::from_array);
    let middle = prop_oneof![Just(Vec3::ZERO), vector().prop_map(|v| v * 100.0), far];
    // Along a plane of two axes, as floors and walls are: their boxes have no thickness.
    let flat = prop::option::of(0_usize..3);
    let triangles = prop::collection::vec(([vector(), vector(), vector()], flat), 1..60);
    // From anywhere, at a point within a triangle or on its outline, or in any direction.
    let share = || prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..=1.0];
    let target = prop::option::of((any::<prop::sample::Index>(), share(), share()));
    let rays = prop::collection::vec((vector(), vector(), 1.0_f32..1e4, target), 20);
    (size, middle, triangles, rays).prop_map(|(size, middle, triangles, rays)| {
        let placed = |(corners, flat): ([Vec3; 3], Option<usize>)| {
            corners.map(|mut corner| {
                if let Some(axis) = flat {
                    corner[axis] = corners[0][axis];
                }
                middle + corner * size
            })
        };
        let triangles: Vec<[Vec3; 3]> = triangles.into_iter().map(placed).collect();
        let ray =
            |(from, towards, away, target): (Vec3, Vec3, f32, Option<(prop::sample::Index, f32, f32)>)| {
                let origin = middle + from * size * away;
                let direction = target.map_or(towards, |(index, along, across)| {
                    let [a, b, c] = triangles[index.index(triangles.len())];
                    a + (b - a) * along + (c - b) * (along * across) - origin
                });
                Ray { origin, direction }
            };
        let rays = rays.into_iter().map(ray).collect();
        FarScene { triangles, rays }
    })
}

/// Any finite number, from the denormal ones to the largest.
fn any_finite() -> impl Strategy<Value = f32> {
    any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |number| number.is_finite())
}

/// Numbers of one magnitude, some of any magnitude, zeros.
fn vector_of(magnitude: f32) -> impl Strategy<Value = Vec3> {
    let near = || vector().prop_map(move |v| v * magnitude);
    let any = [any_finite(), any_finite(), any_finite()].prop_map(Vec3::from_array);
    let axis = (near(), any_finite(), 0_usize..3).prop_map(|(mut v, number, axis)| {
        v[axis] = number;
        v
    });
    prop_oneof![6 => near(), 1 => any, 2 => axis]
}

/// Triangles and rays of all numbers that there are.
fn wild_scene() -> impl Strategy<Value = FarScene> {
    let magnitude = (1_u32..254).prop_map(|exponent| f32::from_bits(exponent << 23));
    magnitude.prop_flat_map(|magnitude| {
        let vector = move || vector_of(magnitude);
        let triangles = prop::collection::vec([vector(), vector(), vector()], 1..40);
        let ray = (vector(), vector(), vector_of(1.0), any::<bool>());
        (triangles, prop::collection::vec(ray, 20)).prop_map(|(triangles, rays)| {
            let ray = |(origin, to, unit, is_aimed): (Vec3, Vec3, Vec3, bool)| Ray {
                origin,
                direction: if is_aimed { to - origin } else { unit },
            };
            FarScene { triangles, rays: rays.into_iter().map(ray).collect() }
        })
    })
}

/// Corners are rounded to f32 when the ray's origin is subtracted, by 2^-24 of their distance from it, and by as
/// much twice when they are sheared. A triangle of a thousandth of that size, seen at more than a thousandth of a
/// right angle, moves by less than this share of itself.
const TOLERANCE: f64 = 0.25;

/// The least distance along a ray, as a share of that of the farthest corner, that f32 finds within [`TOLERANCE`]. Each
/// coordinate of a corner moves by up to 3 · 2^-24 of its distance; in a plane that is seen at a thousandth of a right
/// angle, a thousand times as far along the ray.
const LEAST_DISTANCE: f64 = 3.0 * 1.733 * 1e3 / (1 << 24) as f64 / TOLERANCE;

/// What f64 says of a ray and a triangle.
struct InF64 {
    /// The distance, if the ray meets it whatever is rounded.
    certain: Option<f64>,
    /// Whether the ray may meet it.
    is_possible: bool,
}

/// None of triangles that are too small or too steep for f32, or of a size at which products of two coordinates leave its
/// range or lose their digits: those are held to other ways alone.
fn in_f64(corners: &[Vec3; 3], ray: &Ray) -> Option<InF64> {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let normal = (b - a).cross(c - a);
    let slant = normal.dot(direction);
    let longest = (b - a).length().max((c - a).length()).max((c - b).length());
    let thinnest = normal.length() / longest;
    let farthest = [a, b, c].map(|corner| (corner - origin).length()).into_iter().fold(0.0, f64::max);
    if !(1e-12..1e18).contains(&farthest) {
        return None;
    }
    if slant.abs() < 1e-3 * normal.length() * direction.length() || thinnest < 1e-3 * farthest {
        return None;
    }
    let distance = (a - origin).dot(normal) / slant;
    let point = origin + direction * distance;
    let weight =
        |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / normal.length_squared();
    let least = weight(a, b).min(weight(b, c)).min(weight(c, a));
    let is_far = distance * direction.length() > LEAST_DISTANCE * farthest;
    // Below, an f32 has fewer digits; above, there is none.
    let is_number = (f64::from(f32::MIN_POSITIVE)..f64::from(f32::MAX)).contains(&distance);
    let is_certain = least > TOLERANCE && is_far && is_number;
    Some(InF64 { certain: is_certain.then_some(distance), is_possible: least > -TOLERANCE })
}

/// Holds the hits of a scene's rays to [`in_f64`].
fn check_in_f64(scene: &FarScene) {
    let bvh = Bvh::new(&scene.triangles);
    for ray in scene.rays.iter().filter(|ray| ray.direction != Vec3::ZERO) {
        let found = bvh.nearest(ray, 0.0..f32::INFINITY);
        let certain = scene.triangles.iter().filter_map(|corners| in_f64(corners, ray)?.certain);
        let nearest = certain.fold(f64::INFINITY, f64::min);
        let distance = found.map_or(f64::INFINITY, |hit| hit.distance.into());
        assert!(distance <= nearest * (1.0 + TOLERANCE), "{ray:?}: {found:?}, and one at {nearest}");
        if let Some(hit) = found
            && let Some(exact) = in_f64(&scene.triangles[hit.triangle as usize], ray)
        {
            assert!(exact.is_possible, "{ray:?} is said to meet triangle {}", hit.triangle);
        }
    }
}

/// The hit of a ray on one triangle, number by number: corners sheared in f32 as Woop, Benthin and Wald do, and everything
/// else in f64, where products of two f32 are exact.
fn on_one_triangle(corners: &[Vec3; 3], ray: &Ray) -> Option<RayHit> {
    let along = ray.direction.abs();
    let z = (0..2).fold(2, |best, axis| if along[axis] > along[best] { axis } else { best });
    let z = if z != 2 && along.x == along.y { 1 } else { z };
    let [mut x, mut y] = [(z + 1) % 3, (z + 2) % 3];
    if ray.direction[z] < 0.0 {
        std::mem::swap(&mut x, &mut y);
    }
    let shear = [x, y].map(|axis| ray.direction[axis] / ray.direction[z]);
    let [across, down] = shear.map(|shear| if shear.is_normal() { shear } else { 0.0 });
    let [a, b, c] = corners.map(|corner| {
        let from = corner - ray.origin;
        [from[x] - across * from[z], from[y] - down * from[z], from[z]].map(f64::from)
    });
    let [u, v, w] = [(c, b), (a, c), (b, a)].map(|(p, q): ([f64; 3], [f64; 3])| p[0] * q[1] - p[1] * q[0]);
    let is_inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    let sum = u + v + w;
    let inverse = 1.0 / ray.direction[z];
    let distance = ((u * a[2] + v * b[2] + w * c[2]) / sum * f64::from(inverse)) as f32;
    let weights = [u, v, w].map(|edge| (edge / sum) as f32);
    (is_inside && sum != 0.0 && distance.is_finite()).then_some(RayHit { distance, triangle: 0, weights })
}

fn by_brute_force(triangles: &[[Vec3; 3]], ray: &Ray) -> Option<RayHit> {
    let mut nearest: Option<RayHit> = None;
    for (triangle, corners) in (0_u32..).zip(triangles) {
        let hit = on_one_triangle(corners, ray).filter(|hit| hit.distance >= 0.0);
        let is_nearer = |hit: &RayHit| nearest.is_none_or(|best| hit.distance < best.distance);
        if let Some(hit) = hit.filter(is_nearer) {
            nearest = Some(RayHit { triangle, ..hit });
        }
    }
    nearest
}

/// Holds a tree to [`by_brute_force`], at every level, ray by ray and eight at a time, from the root and among
/// surroundings.
fn check_by_brute_force(triangles: &[[Vec3; 3]], rays: &[Ray]) {
    let usable = |corners: &[Vec3; 3]| corners.iter().all(|corner| corner.is_finite());
    let triangles: Vec<[Vec3; 3]> =
        triangles.iter().map(|corners| if usable(corners) { *corners } else { [Vec3::NAN; 3] }).collect();
    let is_ray =
        |ray: &Ray| ray.direction.is_finite() && ray.direction != Vec3::ZERO && ray.origin.is_finite();
    let of = |hit: Option<RayHit>| hit.map(|hit| (hit.triangle, hit.distance));
    let expected: Vec<Option<RayHit>> =
        rays.iter().map(|ray| is_ray(ray).then(|| by_brute_force(&triangles, ray)).flatten()).collect();
    for level in Token::all() {
        let bvh = Bvh { level, ..Bvh::new(&triangles) };
        for (ray, &expected) in rays.iter().zip(&expected) {
            assert_eq!(of(bvh.nearest(ray, 0.0..f32::INFINITY)), of(expected), "{level:?} {ray:?}");
            assert_eq!(bvh.occluded(ray, 0.0..f32::INFINITY), expected.is_some(), "{level:?} {ray:?}");
        }
        for (rays, expected) in rays.chunks(8).zip(expected.chunks(8)) {
            let (hits, occluded) = eight_at_once(&bvh, rays);
            for (lane, &expected) in expected.iter().enumerate() {
                assert_eq!(of(hits[lane]), of(expected), "{level:?} {:?}", rays[lane]);
                assert_eq!(occluded >> lane & 1 != 0, expected.is_some(), "{level:?} {:?}", rays[lane]);
            }
        }
    }
}

/// The first hits of up to eight rays, and which of them hit anything.
fn eight_at_once(bvh: &Bvh, rays: &[Ray]) -> ([Option<RayHit>; 8], u32) {
    let column = |of: &dyn Fn(&Ray) -> f32| std::array::from_fn(|lane| rays.get(lane).map_or(0.0, of));
    let origin: [[f32; 8]; 3] = [0, 1, 2].map(|axis| column(&|ray| ray.origin[axis]));
    let direction: [[f32; 8]; 3] = [0, 1, 2].map(|axis| column(&|ray| ray.direction[axis]));
    at_level!(bvh.level, simd => {
        let rays = Rays {
            origin: origin.map(|column| f32x8::simd_from(simd, column)),
            direction: direction.map(|column| f32x8::simd_from(simd, column)),
            start: f32x8::splat(simd, 0.0),
            end: f32x8::splat(simd, f32::INFINITY),
            active: (1 << rays.len()) - 1,
        };
        (bvh.nearest_rays(simd, &rays, &mut |_, _| true), bvh.occluded_rays(simd, &rays, None))
    })
}

/// Points on or above triangles, with rays into their hemispheres, and how far these go.
#[derive(Debug)]
struct Outlook {
    points: Vec<[Vec3; 2]>,
    /// Of each point.
    rays: Vec<Vec<Ray>>,
    distance: f32,
}

/// Rays from up to eight points of a scene: along turns, and at the middles of triangles. They end after some of the
/// scene's size.
fn outlook(scene: &FarScene, turns: &[Vec3], share: f32) -> Outlook {
    let corners = || scene.triangles.iter().flatten();
    let largest = corners().fold(0.0_f32, |most, corner| most.max(corner.abs().max_element()));
    let [least, most] = [
        corners().fold(Vec3::INFINITY, |a, b| a.min(*b)),
        corners().fold(Vec3::NEG_INFINITY, |a, b| a.max(*b)),
    ];
    let middle = |[a, b, c]: &[Vec3; 3]| (*a + *b + *c) / 3.0;
    let on = |corners: &[Vec3; 3]| {
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        [middle(corners) + normal * (64.0 * f32::EPSILON * largest), normal]
    };
    let points = scene.triangles.iter().map(on).filter(|[_, normal]| *normal != Vec3::ZERO);
    let points: Vec<[Vec3; 2]> = points.take(8).collect();
    let into = |normal: Vec3, turn: Vec3| if turn.dot(normal) < 0.0 { -turn } else { turn };
    let rays = points.iter().map(|&[origin, normal]| {
        let aims = scene.triangles.iter().map(|corners| (middle(corners) - origin).normalize_or_zero());
        let aims = aims.filter(|aim| aim.dot(normal) >= 0.0);
        let turned = turns.iter().map(|&turn| into(normal, turn.normalize_or_zero()));
        turned.chain(aims).map(|direction| Ray { origin, direction }).collect()
    });
    Outlook { rays: rays.collect(), distance: (most - least).length() * share, points }
}

/// Holds rays that start among the surroundings of all points, of two and of one to those from the root, at every level.
fn check_surroundings(scene: &FarScene, turns: &[Vec3], share: f32) {
    let Outlook { points, rays, distance } = outlook(scene, turns, share);
    let column = |side: usize, axis: usize| -> [f32; 8] {
        std::array::from_fn(|lane| points.get(lane).map_or(0.0, |point| point[side][axis]))
    };
    let columns = [0, 1].map(|side| [0, 1, 2].map(|axis| column(side, axis)));
    let all = points.len();
    let some = |count: usize| (0..all).map(move |first| first..(first + count).min(all));
    for level in Token::all() {
        let bvh = Bvh { level, ..Bvh::new(&scene.triangles) };
        for active in some(all).take(1).chain(some(2)).chain(some(1)) {
            let bits = active.clone().map(|lane| 1 << lane).sum();
            for ray in rays[active].iter().flatten() {
                let is_occluded = at_level!(level, simd => {
                    let [origin, normal] = columns.map(|axes| axes.map(|column| f32x8::simd_from(simd, column)));
                    let surroundings = bvh.surroundings(simd, &Hemispheres { origin, normal, distance, active: bits });
                    bvh.occluded_rays(simd, &Rays::one(simd, ray, 0.0..distance), Some(&surroundings)) != 0
                });
                assert_eq!(is_occluded, bvh.occluded(ray, 0.0..distance), "{level:?} {bits:b} {ray:?}");
            }
        }
    }
}

proptest! {
    /// The hits of a ray one after the other, triangles at one distance by their numbers: as if all were sorted.
    #[test]
    fn hits_that_count_come_in_their_order(
        triangles in prop::collection::vec([vector(), vector(), vector()], 1..80), origin in vector(), direction in vector(),
    ) {
        prop_assume!(direction != Vec3::ZERO);
        let (bvh, ray) = (Bvh::new(&triangles), Ray { origin, direction });
        let single = |(number, corners): (u32, &[Vec3; 3])| {
            let hit = on_one_triangle(corners, &ray).filter(|hit| hit.distance >= 0.0)?;
            Some(RayHit { triangle: number, ..hit })
        };
        let mut expected: Vec<RayHit> = (0_u32..).zip(&triangles).filter_map(single).collect();
        // Those with odd numbers do not count.
        expected.retain(|hit| hit.triangle % 2 == 0);
        expected.sort_by(|a, b| (a.distance, a.triangle).partial_cmp(&(b.distance, b.triangle)).expect("no NaN"));
        let (mut found, mut last): (Vec<RayHit>, Option<RayHit>) = (Vec::new(), None);
        loop {
            let is_behind = |hit: &RayHit| last.is_none_or(|last| (hit.distance, hit.triangle) > (last.distance, last.triangle));
            let start = last.map_or(0.0, |last| last.distance);
            last = bvh.nearest_of(&ray, start..f32::INFINITY, |hit| hit.triangle % 2 == 0 && is_behind(hit));
            let Some(hit) = last else { break };
            found.push(hit);
        }
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn a_tree_answers_as_a_look_at_every_triangle(
        triangles in prop::collection::vec([vector(), vector(), vector()], 0..120),
        rays in prop::collection::vec((vector(), vector()), 20),
    ) {
        let rays: Vec<Ray> = rays.into_iter().map(|(origin, direction)| Ray { origin, direction }).collect();
        check_by_brute_force(&triangles, &rays);
    }

    #[test]
    fn a_tree_answers_as_a_look_at_every_triangle_far_from_the_origin(scene in far_scene()) {
        check_by_brute_force(&scene.triangles, &scene.rays);
    }

    /// Triangles that move, all of them a little or some of them far.
    #[test]
    fn a_tree_of_moved_triangles_answers_as_a_look_at_every_one(
        triangles in prop::collection::vec([vector(), vector(), vector()], 0..120),
        moves in prop::collection::vec((vector(), prop_oneof![Just(0.01_f32), Just(0.3), Just(3.0)]), 120),
        rays in prop::collection::vec((vector(), vector()), 20),
    ) {
        let moved: Vec<[Vec3; 3]> =
            triangles.iter().zip(moves).map(|(corners, (by, size))| corners.map(|corner| corner + by * size)).collect();
        let Some(tree) = Bvh::new(&triangles).refit(&moved) else { return Ok(()) };
        for (origin, direction) in rays {
            let ray = Ray { origin, direction };
            let expected = if direction == Vec3::ZERO { None } else { by_brute_force(&moved, &ray) };
            prop_assert_eq!(tree.nearest(&ray, 0.0..f32::INFINITY), expected, "{:?}", ray);
            prop_assert_eq!(tree.occluded(&ray, 0.0..f32::INFINITY), expected.is_some(), "{:?}", ray);
        }
    }

    /// Rays from one place towards another, which go through one stack together.
    #[test]
    fn similar_rays_hit_what_a_look_at_every_triangle_finds(
        triangles in prop::collection::vec([vector(), vector(), vector()], 1..120), size in 0.05_f32..1.0,
        from in vector(), to in any::<prop::sample::Index>(), apart in prop_oneof![Just(0.01_f32), Just(0.1), Just(0.5)],
        moves in prop::collection::vec((vector(), vector()), 8),
    ) {
        let triangles: Vec<[Vec3; 3]> =
            triangles.into_iter().map(|[a, b, c]| [a, a + (b - a) * size, a + (c - a) * size]).collect();
        let [to, ..] = triangles[to.index(triangles.len())];
        let ray = |(start, end): (Vec3, Vec3)| {
            let origin = from * 2.0 + start * apart;
            Ray { origin, direction: to + end * apart - origin }
        };
        let rays: Vec<Ray> = moves.into_iter().map(ray).collect();
        check_by_brute_force(&triangles, &rays);
    }

    #[test]
    fn a_tree_answers_as_a_look_at_every_triangle_for_all_numbers(scene in wild_scene()) {
        check_by_brute_force(&scene.triangles, &scene.rays);
    }

    #[test]
    fn surroundings_hold_all_that_rays_into_hemispheres_hit(
        scene in far_scene(), turns in prop::collection::vec(vector(), 8), share in 0.02_f32..1.0,
    ) {
        check_surroundings(&scene, &turns, share);
    }

    #[test]
    fn surroundings_hold_all_that_rays_hit_for_all_numbers(
        scene in wild_scene(), turns in prop::collection::vec(vector(), 8), share in 0.02_f32..1.0,
    ) {
        check_surroundings(&scene, &turns, share);
    }

    /// By the cross products of Möller and Trumbore in f64, where rounding leaves no doubt.
    #[test]
    fn what_is_met_is_what_f64_says(scene in far_scene()) {
        check_in_f64(&scene);
    }

    #[test]
    fn what_is_met_is_what_f64_says_for_all_numbers(scene in wild_scene()) {
        check_in_f64(&scene);
    }

    /// A closed solid seen from inside has no holes, whatever the ray.
    #[test]
    fn no_ray_leaks_out_of_a_closed_solid(origin in vector(), direction in vector()) {
        prop_assume!(direction != Vec3::ZERO);
        let corner = |i: u32| Vec3::new(
            if i & 1 == 0 { -1.0 } else { 1.0 },
            if i & 2 == 0 { -1.0 } else { 1.0 },
            if i & 4 == 0 { -1.0 } else { 1.0 },
        );
        let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let triangles: Vec<[Vec3; 3]> = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .map(|corners| corners.map(corner))
            .collect();
        let ray = Ray { origin: origin * 0.2, direction };
        let hit = Bvh::new(&triangles).nearest(&ray, 0.0..f32::INFINITY);
        prop_assert!(hit.is_some(), "{:?} leaves the cube", ray);
    }
}

/// Squares of such distances are infinite, as are those of the distances to boxes that are not there.
#[test]
fn rays_that_go_as_far_as_numbers_go_enter_no_empty_box() {
    let triangle = [Vec3::new(-1.0, -1.0, 1.0), Vec3::new(1.0, -1.0, 1.0), Vec3::new(0.0, 1.0, 1.0)];
    for distance in [1e30, f32::MAX, f32::INFINITY] {
        for level in Token::all() {
            let bvh = Bvh { level, ..Bvh::new(&[triangle]) };
            let ray = Ray { origin: Vec3::ZERO, direction: Vec3::new(0.1, 0.1, 1.0) };
            let is_occluded = at_level!(level, simd => {
                let splat = |vector: Vec3| vector.to_array().map(|value| f32x8::splat(simd, value));
                let (origin, normal) = (splat(Vec3::ZERO), splat(Vec3::new(0.6, 0.48, 0.64)));
                let surroundings = bvh.surroundings(simd, &Hemispheres { origin, normal, distance, active: 0xff });
                bvh.occluded_rays(simd, &Rays::one(simd, &ray, 0.0..distance), Some(&surroundings)) != 0
            });
            assert!(is_occluded, "{distance} {level:?}");
        }
    }
}

#[test]
fn nothing_is_met_where_there_is_nothing() {
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::X };
    assert_eq!(Bvh::new(&[]).nearest(&ray, 0.0..1.0), None, "no triangle");
    let broken = [[Vec3::NAN, Vec3::X, Vec3::Y]];
    assert!(Bvh::new(&broken).is_empty(), "a triangle that is nowhere");
    let nowhere = Ray { direction: Vec3::ZERO, ..ray };
    let triangle = [[Vec3::new(1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, -1.0), Vec3::new(1.0, 0.0, 1.0)]];
    assert_eq!(Bvh::new(&triangle).nearest(&nowhere, 0.0..1.0), None, "a ray without direction");
    assert!(Bvh::new(&triangle).occluded(&ray, 0.0..2.0), "and one with");
}

#[test]
fn a_tree_is_built_anew_where_triangles_came_went_or_moved_apart() {
    let row = |step: f32| -> Vec<[Vec3; 3]> {
        let at = |number: u16| Vec3::X * (f32::from(number % 40) * step + f32::from(number / 40) * 0.01);
        (0..400).map(|number| [Vec3::ZERO, Vec3::Y, Vec3::Z].map(|corner| corner + at(number))).collect()
    };
    let tree = || Bvh::new(&row(2.0));
    assert!(tree().refit(&row(2.1)).is_some(), "a little");
    assert!(tree().refit(&row(2.0)[1..]).is_none(), "one less");
    assert!(tree().refit(&[row(2.0), row(2.0)].concat()).is_none(), "twice as many");
    let mut broken = row(2.0);
    broken[7][1].y = f32::NAN;
    assert!(tree().refit(&broken).is_none(), "one that is nowhere now");
    let mut mixed = row(2.0);
    (0..200).for_each(|number| mixed.swap(number, 399 - number * 7 % 200));
    assert!(tree().refit(&mixed).is_none(), "each at the place of another");
    assert!(Bvh::new(&[]).refit(&[]).is_some(), "nothing, as before");
}

#[test]
fn the_same_triangles_many_times_do_not_make_a_deep_tree() {
    let triangle = [Vec3::X, Vec3::Y, Vec3::Z];
    let bvh = Bvh::new(&vec![triangle; 5000]);
    let ray = Ray { origin: Vec3::ZERO, direction: Vec3::ONE };
    let hit = bvh.nearest(&ray, 0.0..f32::INFINITY).expect("in the way");
    assert_eq!(hit.triangle, 0, "the smallest number of equals");
}

/// Heaps of eight triangles, numbered across, far apart along one axis: a leaf that held triangles of two heaps would
/// be met by all rays between them.
#[test]
fn leaves_hold_what_lies_together() {
    const HEAPS: u32 = 32;
    for axis in 0..3 {
        let offset = |number: u32| {
            let mut offset = Vec3::splat((number / HEAPS) as f32 * 0.1);
            // Any order: 13 has no divisor in common with the number of heaps.
            offset[axis] += 10.0 * (number * 13 % HEAPS) as f32;
            offset
        };
        let triangle = |number: u32| {
            [Vec3::ZERO, Vec3::new(1.0, 0.5, 0.0), Vec3::new(0.0, 1.0, 0.5)]
                .map(|corner| corner + offset(number))
        };
        let triangles: Vec<[Vec3; 3]> = (0..8 * HEAPS).map(triangle).collect();
        let tree = Bvh::new(&triangles);
        let mut held = 0;
        for leaf in &tree.leaves {
            let numbers: Vec<u32> =
                leaf.numbers.iter().copied().filter(|&number| number != Leaf::NONE).collect();
            held += numbers.len();
            let heap = |number: &u32| number * 13 % HEAPS;
            assert!(
                numbers.iter().all(|number| heap(number) == heap(&numbers[0])),
                "axis {axis}: {numbers:?}"
            );
        }
        assert_eq!(held, triangles.len(), "each triangle once");
    }
}
