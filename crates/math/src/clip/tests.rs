//! Small cases with answers worked out by hand. The properties on random and
//! hostile input are tested for the whole workspace, in exact rationals.

use glam::Vec4;

use super::*;

fn near() -> ClipVolume {
    ClipVolume::before_the_eye(f32::MIN_POSITIVE).unwrap().with(HalfSpace::NEAR)
}

fn positions(triangle: [Vec4; 3], volume: &ClipVolume) -> Vec<Vec4> {
    let polygon = clip_triangle(triangle, volume);
    polygon.vertices().iter().map(|vertex| vertex.position).collect()
}

/// A point at `x`, `y` and distance `w` from the eye, with the near plane at 1.
fn at(x: f32, y: f32, w: f32) -> Vec4 {
    Vec4::new(x, y, 1.0, w)
}

/// Source row A7: near clipping of a triangle.
#[test]
fn source_a7_one_vertex_cut_off_gives_two_triangles_two_give_one() {
    let (a, b) = (at(-1.0, 0.0, 3.0), at(1.0, 0.0, 3.0));
    let one_off = positions([a, b, at(0.0, 4.0, 0.0)], &near());
    assert_eq!(one_off.len() - 2, 2, "a quadrilateral is two triangles");
    // From w = 3 to w = 0 the plane w = 1 is met at two thirds.
    assert_eq!(one_off[..2], [a, b], "what is inside stays");
    for (vertex, x) in one_off[2..].iter().zip([1.0 / 3.0, -1.0 / 3.0]) {
        let expected = at(x, 8.0 / 3.0, 1.0);
        assert!((*vertex - expected).abs().max_element() < 1e-6, "cut at {vertex}");
    }

    let two_off = positions([a, at(1.0, 0.0, -1.0), at(0.0, 4.0, 0.0)], &near());
    assert_eq!(two_off.len() - 2, 1, "one triangle");
    assert_eq!(two_off[0], a, "its corner inside");
    assert_eq!(two_off[1], at(0.0, 0.0, 1.0), "half-way from w = 3 to w = -1");
}

#[test]
fn inside_stays_and_outside_goes() {
    let inside = [at(0.0, 0.0, 2.0), at(1.0, 0.0, 2.0), at(0.0, 1.0, 5.0)];
    assert_eq!(positions(inside, &near()), inside, "untouched");
    let behind = inside.map(|p| -p);
    assert_eq!(positions(behind, &near()), [], "behind the eye");
}

/// The border is inside, but what only touches it has no area.
#[test]
fn touching_the_border_leaves_no_area() {
    let (on, also_on) = (at(0.0, 0.0, 1.0), at(1.0, 0.0, 1.0));
    let (inside, outside) = (at(0.0, 1.0, 2.0), at(0.0, 1.0, 0.5));
    assert_eq!(positions([on, also_on, outside], &near()), [], "an edge");
    assert_eq!(positions([on, outside, outside + Vec4::X], &near()), [], "a corner");
    assert_eq!(positions([on, also_on, inside], &near()), [on, also_on, inside], "inside");
    let split = positions([on, inside, outside], &near());
    assert_eq!(split.len(), 3, "the border's corner is its own cut point");
    assert_eq!(split[..2], [on, inside], "kept");
}

#[test]
fn all_sides_of_the_view_volume_cut_a_huge_triangle_to_a_rectangle() {
    let volume = near().with(HalfSpace::FAR).with_bands(Band::VIEW, Band::at_most(2.0).unwrap());
    let huge = [
        Vec4::new(-100.0, -100.0, 0.5, 1.0),
        Vec4::new(100.0, -100.0, 0.5, 1.0),
        Vec4::new(0.0, 300.0, 0.5, 1.0),
    ];
    let mut corners = positions(huge, &volume);
    corners.sort_by(|p, q| (p.x, p.y).partial_cmp(&(q.x, q.y)).unwrap());
    let expected = [(-1.0, -2.0), (-1.0, 2.0), (1.0, -2.0), (1.0, 2.0)];
    assert_eq!(corners, expected.map(|(x, y)| Vec4::new(x, y, 0.5, 1.0)), "exact corners");
}

/// Hard case 20.
#[test]
fn a_position_that_is_no_number_leaves_nothing() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..4 {
            let mut triangle = [at(0.0, 0.0, 2.0), at(1.0, 0.0, 2.0), at(0.0, 1.0, 5.0)];
            triangle[1][axis] = bad;
            assert_eq!(positions(triangle, &near()), [], "{bad} on axis {axis}");
            let segment = [triangle[0], triangle[1]];
            assert!(clip_segment(segment, &near()).is_none(), "{bad} on axis {axis}");
        }
    }
}

#[test]
fn a_segment_keeps_its_direction() {
    let (inside, outside) = (at(0.0, 0.0, 3.0), at(4.0, 8.0, -1.0));
    let [start, end] = clip_segment([inside, outside], &near()).unwrap();
    assert_eq!((start.position, start.weights), (inside, [1.0, 0.0]), "the end inside");
    assert_eq!((end.position, end.weights), (at(2.0, 4.0, 1.0), [0.5, 0.5]), "the cut");
    let [first, last] = clip_segment([outside, inside], &near()).unwrap();
    assert_eq!((first.position, last.position), (end.position, start.position), "reversed");
    assert!(clip_segment([outside, outside], &near()).is_none(), "outside");
    let touching = [at(0.0, 0.0, 1.0), outside];
    assert!(clip_segment(touching, &near()).is_none(), "no length is left");
}

#[test]
fn outcodes_name_the_half_spaces_in_order() {
    let volume = near().with(HalfSpace::FAR).with_bands(Band::VIEW, Band::VIEW);
    let cases = [
        (Vec4::new(0.0, 0.0, 0.5, 1.0), 0b000_0000),
        (Vec4::new(0.0, 0.0, 2.0, 1.0), 0b000_0010),
        (Vec4::new(0.0, 0.0, -1.0, 1.0), 0b000_0100),
        (Vec4::new(-2.0, 0.0, 0.5, 1.0), 0b000_1000),
        (Vec4::new(2.0, 0.0, 0.5, 1.0), 0b001_0000),
        (Vec4::new(0.0, -2.0, 0.5, 1.0), 0b010_0000),
        (Vec4::new(0.0, 2.0, 0.5, 1.0), 0b100_0000),
        (Vec4::new(0.0, 0.0, 0.5, 0.0), 0b000_0011),
        (Vec4::NAN, 0b1111_1111),
    ];
    for (position, bits) in cases {
        assert_eq!(volume.outcode(position).bits(), bits, "outcode of {position}");
    }
}

#[test]
fn bands_are_powers_of_two_not_above_the_factor() {
    let factor = |limit| Band::at_most(limit).map(Band::factor);
    for (limit, expected) in [(1.0, 1.0), (1.99, 1.0), (34.13, 32.0), (64.0, 64.0)] {
        assert_eq!(factor(limit), Some(expected), "at most {limit}");
    }
    assert_eq!(factor(f32::INFINITY), Some(65536.0), "the widest");
    for limit in [0.99, 0.0, -2.0, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(factor(limit), None, "{limit} would cut off what is visible");
    }
}

#[test]
fn a_minimum_of_w_that_bounds_nothing_is_refused() {
    for minimum in [0.0, -1.0, f32::NAN, f32::INFINITY, f32::from_bits(1)] {
        assert!(ClipVolume::before_the_eye(minimum).is_none(), "{minimum} is no bound");
    }
}
