//! The scenes are what they are said to be.

use super::*;
use trigon_classic::{Corner, Method};
use trigon_math::{DMat3, DVec2, elementary};

const SIDE: usize = 64;
const SIZE: f64 = SIDE as f64;

/// A corner in pixels.
fn point(corner: &Corner) -> DVec3 {
    DVec3::from_array(corner.map(f64::from)) / f64::from(STEPS_PER_PIXEL)
}

fn points(body: &Body) -> Vec<DVec3> {
    body.corners.iter().map(point).collect()
}

/// The mean of a body's corners: the middle of a ball.
fn middle(body: &Body) -> DVec3 {
    points(body).into_iter().sum::<DVec3>() / body.corners.len() as f64
}

/// Whether all corners lie so far from a point, but for rounding to the grid.
fn is_ball(body: &Body, middle: DVec3, radius: f64) -> bool {
    points(body)
        .iter()
        .all(|point| (point.distance(middle) - radius).abs() < 2.0 / f64::from(STEPS_PER_PIXEL))
}

#[test]
fn a_pose_turns_about_the_upright_axis_and_then_tilts_towards_the_eye() {
    let turned = |angle, tilt| Pose::new(angle, tilt, 1.0, DVec3::ZERO).turn;
    let (s, c) = elementary::sin_cos(0.7);
    let [turn, tilt] = [turned(0.7, 0.0), turned(0.0, 0.7)];
    assert!((turn * DVec3::X).distance(DVec3::new(c, 0.0, -s)) < 1e-12, "to the right, and away");
    assert!((turn * DVec3::Y).distance(DVec3::Y) < 1e-12, "what is upright stays so");
    assert!((tilt * DVec3::X).distance(DVec3::X) < 1e-12, "what is level stays so");
    assert!((tilt * DVec3::Y).distance(DVec3::new(0.0, c, s)) < 1e-12, "the top comes nearer");
    let both = turned(0.4, 0.7);
    assert!((both - tilt * turned(0.4, 0.0)).to_cols_array().iter().all(|part| part.abs() < 1e-12));
    let product = both * both.transpose() - DMat3::IDENTITY;
    assert!(product.to_cols_array().iter().all(|part| part.abs() < 1e-12) && both.determinant() > 0.0);
}

#[test]
fn balls_lie_at_chance_places_within_the_image() {
    for (count, radius, seed) in [(1, 3.0, 9), (40, SIZE / 14.0, 1), (7, 20.0, 3)] {
        let scene = balls(SIDE, count, radius, seed);
        assert_eq!((scene.bodies().len(), scene.face_count()), (count, 80 * count), "80 faces each");
        let middles: Vec<DVec3> = scene.bodies().iter().map(middle).collect();
        for (body, &middle) in scene.bodies().iter().zip(&middles) {
            assert!(is_ball(body, middle, radius), "{middle}");
            let (least, most) = (radius - 0.01, SIZE - radius + 0.01);
            assert!(middle.min_element() > least && middle.max_element() < most, "{middle} of {radius}");
        }
        assert!(middles.windows(2).all(|pair| (pair[0] - pair[1]).abs().min_element() > 0.0));
        assert_ne!(scene.bodies(), balls(SIDE, count, radius, seed + 1).bodies(), "another seed");
    }
    assert_eq!(VisibilityCase::Balls.scene(SIDE).bodies().len(), 40);
}

#[test]
fn sheets_cover_the_image_one_behind_the_other() {
    for tilt in [0, 5, SIDE as i32] {
        let scene = sheets(SIDE, tilt);
        assert_eq!(scene.bodies().len(), 16);
        let mut tilted = Vec::new();
        for (i, body) in (0..).zip(scene.bodies()) {
            let [a, b, c, behind] = points(body)[..] else { panic!("a tetrahedron has four corners") };
            // A triangle whose middle third is the image.
            let corners = [a, b, c].map(|corner| corner.truncate() / SIZE);
            assert_eq!(corners, [DVec2::new(-1.0, -1.0), DVec2::new(3.0, -1.0), DVec2::new(-1.0, 3.0)]);
            assert_eq!(behind, DVec3::new(SIZE, SIZE, 0.0), "its far side is a point");
            // A pixel from sheet to sheet, all of them nearer than any far side.
            let depths = [a.z, b.z, c.z].map(|depth| (depth - (1.5 * SIZE + f64::from(i))) as i32);
            let mut sorted = depths;
            sorted.sort_unstable();
            assert_eq!(sorted, [-tilt, 0, tilt], "sheet {i} of tilt {tilt}");
            tilted.push(depths);
        }
        let differs = |pair: &[[i32; 3]]| (0..3).all(|corner| pair[0][corner] != pair[1][corner]);
        assert!(tilt == 0 || tilted.windows(2).all(differs), "neighbours are tilted at other corners");
    }
}

#[test]
fn crossing_balls_stick_in_their_neighbours() {
    let scene = VisibilityCase::Crossing.scene(SIDE);
    let middles: Vec<DVec3> = scene.bodies().iter().map(middle).collect();
    assert_eq!(middles.len(), 12, "two rows of six");
    let radius = SIZE / 9.0;
    for (i, (body, &at)) in scene.bodies().iter().zip(&middles).enumerate() {
        assert!(is_ball(body, at, radius), "ball {i} at {at}");
        assert!(at.truncate().min_element() > radius && at.truncate().max_element() < SIZE - radius, "{at}");
        if i % 6 > 0 {
            let step = at - middles[i - 1];
            assert!(step.length() < 2.0 * radius, "ball {i} sticks in the one before");
            assert!((step.x - 0.14 * SIZE).abs() < 0.02 && step.y.abs() < 0.02, "in a row: {step}");
        }
        // Nearer to the eye than the first one by up to six steps.
        let nearer = (at.z - middles[0].z) / (0.02 * SIZE);
        assert!((nearer - nearer.round()).abs() < 0.02 && (-0.1..6.1).contains(&nearer), "{i}: {nearer}");
    }
    let deepest = middles.iter().map(|at| at.z).fold(0.0, f64::max);
    assert!((deepest - middles[0].z - 0.12 * SIZE).abs() < 0.02, "not all at one depth: {deepest}");
    assert!((middles[6].y - middles[0].y - 0.3 * SIZE).abs() < 0.02, "the rows lie apart");
}

#[test]
fn each_bar_of_the_ring_has_its_far_end_under_the_one_before_it() {
    let scene = VisibilityCase::Ring.scene(SIDE);
    let ends = [[0.1, 0.2], [0.9, 0.3], [0.4, 0.9]].map(|end| DVec2::from_array(end) * SIZE);
    let drawn = Method::Warnock.draw(&scene).unwrap().faces;
    for (i, body) in scene.bodies().iter().enumerate() {
        let along = ends[(i + 1) % 3] - ends[i];
        let [a, b, c, d] = points(body)[..] else { panic!("a tetrahedron has four corners") };
        assert_eq!(
            [a.z, b.z, c.z].map(|z| z / SIZE),
            [0.5, 0.5, 0.2].map(|z: f64| (z * 16384.0).round() / 16384.0)
        );
        assert!(d.z > c.z && d.z < 0.22 * SIZE, "it has a far edge: {d}");
        let mean = |one: DVec3, other: DVec3| (one.truncate() + other.truncate()) / 2.0;
        assert!(mean(a, b).distance(ends[i] - 0.12 * along) < 0.01, "from before a corner");
        assert!(mean(c, d).distance(ends[i] + 1.12 * along) < 0.01, "to beyond the next");
        for across in [(a - b).truncate(), (c - d).truncate()] {
            assert!(across.dot(along).abs() < 0.01 * along.length(), "{across} is square to {along}");
            assert!((across.length() - 0.16 * along.length()).abs() < 0.01, "{across}");
        }
        let [x, y] = ends[i].to_array().map(|part| part as usize);
        assert_eq!(scene.face(drawn[[x, y]]).body, i, "at its own corner it is seen");
    }
}

#[test]
fn a_mesh_stands_in_the_middle_of_the_image() {
    for (case, mesh, scale) in [
        (VisibilityCase::Torus, primitives::torus(1.0, 0.4, 48, 24), SIZE / 3.2),
        (VisibilityCase::Teapot, primitives::teapot(6), SIZE / 7.0),
    ] {
        let scene = case.scene(SIDE);
        let [body] = scene.bodies() else { panic!("one body") };
        let bounds = mesh.bounds();
        let center = (bounds.min + bounds.max) / 2.0;
        let turn = Pose::new(0.7, 0.5, 1.0, DVec3::ZERO).turn;
        assert_eq!(body.corners.len(), mesh.positions().len());
        for (position, found) in mesh.positions().iter().zip(points(body)) {
            let visible = turn * (position.as_dvec3() - center) * scale;
            let expected = DVec3::splat(SIZE / 2.0) + DVec3::new(visible.x, -visible.y, visible.z);
            assert!(found.distance(expected) < 0.01, "{case:?}: {found}, not {expected}");
            assert!(found.min_element() >= 0.0 && found.truncate().max_element() < SIZE, "{found}");
        }
    }
}
