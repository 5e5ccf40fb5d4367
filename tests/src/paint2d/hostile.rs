//! Input that no honest program makes: nothing panics or hangs, what cannot be
//! painted is left out and counted.

use super::shapes::{EVERYWHERE, SIZE, Shape, background, painted, painted_over};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_raster::paint2d::{Image, Mesh, Painted, Vertex};

/// Any float, and those that hurt.
fn float() -> impl Strategy<Value = f32> {
    let limit = (1 << 22) as f32;
    let nasty = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN_POSITIVE,
        -0.0,
        limit,
        -limit,
        limit.next_up(),
        8e9,
        0.5,
    ];
    prop_oneof![
        2 => any::<u32>().prop_map(f32::from_bits),
        2 => proptest::sample::select(nasty.to_vec()),
        3 => -4e6..4e6_f32,
        3 => -10.0..50.0_f32,
    ]
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn any_bits_are_painted_or_refused(
        vertices in proptest::collection::vec(([float(), float()], [float(), float()], any::<[u8; 4]>()), 3..9),
        indices in proptest::collection::vec(0..10_u32, 0..20),
        textured in any::<bool>(),
    ) {
        let vertices = vertices.into_iter().map(|(position, uv, color)| Vertex { position, uv, color }).collect();
        let image = textured.then(|| Image::new(2, 2, vec![[50, 90, 20, 180]; 4]).expect("two by two"));
        let shape = Shape { scissor: EVERYWHERE, vertices, indices, image };
        let (pixels, painted) = painted_over(&background(), &[shape.mesh()]);
        prop_assert_eq!(painted.triangles, shape.indices.len().div_ceil(3));
        let positions = shape.indices.iter().map(|&index| shape.vertices.get(index as usize));
        let lost = |position: f32| position.is_nan() || f64::from(position).abs() > f64::from(1 << 22) + 0.5;
        let bad = positions.clone().filter(|vertex| vertex.is_none_or(|vertex| vertex.position.into_iter().any(lost)));
        if bad.count() == shape.indices.len() {
            prop_assert_eq!(painted.refused, painted.triangles);
            prop_assert_eq!(pixels, background(), "nothing is painted");
        }
    }
}

/// What is counted for these indices of three good vertices and a bad one.
fn counts(indices: &[u32]) -> Painted {
    let vertex = |position| Vertex { position, uv: [0.0; 2], color: [255; 4] };
    let vertices = [[0.0, 0.0], [30.0, 0.0], [0.0, 31.0], [f32::NAN, 1.0]].map(vertex).to_vec();
    painted_over(&background(), &[Shape::new(vertices, indices).mesh()]).1
}

#[test]
fn what_is_refused_is_counted() {
    let expect = |triangles, refused| Painted { triangles, refused, in_rectangles: 0 };
    assert_eq!(counts(&[0, 1, 2]), expect(1, 0), "a good triangle");
    assert_eq!(counts(&[0, 1, 2, 0, 1, 4]), expect(2, 1), "an index beyond the vertices");
    assert_eq!(counts(&[0, 1, u32::MAX, 0, 1, 2]), expect(2, 1), "one far beyond");
    assert_eq!(counts(&[0, 1, 3]), expect(1, 1), "a position that is no number");
    assert_eq!(counts(&[0, 1, 2, 0, 1]), expect(2, 1), "a triangle with two indices");
    assert_eq!(counts(&[0, 1, 1]), expect(1, 0), "one without area is good, and no pixel's");
}

#[test]
fn places_out_of_range_are_refused_with_an_image_only() {
    for uv in [f32::NAN, f32::INFINITY, 1e30, -1e6] {
        let vertex = |position| Vertex { position, uv: [uv, 0.5], color: [255; 4] };
        let mut shape = Shape::new([[0.0, 0.0], [30.0, 0.0], [0.0, 31.0]].map(vertex).to_vec(), &[0, 1, 2]);
        assert_eq!(painted_over(&background(), &[shape.mesh()]).1.refused, 0, "{uv} without an image");
        shape.image = Some(Image::new(1, 1, vec![[255; 4]]).expect("one texel"));
        let (pixels, counts) = painted_over(&background(), &[shape.mesh()]);
        assert_eq!(counts.refused, 1, "{uv} with an image");
        assert_eq!(pixels, background(), "nothing is painted");
    }
}

/// A triangle of 8 million pixels a side has as many rows; only those in sight
/// may cost anything.
#[test]
fn huge_triangles_cost_what_is_seen_of_them() {
    const LIMIT: f32 = (1 << 22) as f32;
    let vertex = |position| Vertex { position, uv: [0.0; 2], color: [10, 20, 30, 255] };
    let corners = [[-LIMIT, -LIMIT], [LIMIT, -LIMIT], [-LIMIT, LIMIT], [LIMIT, LIMIT]];
    let shape = Shape::new(corners.map(vertex).to_vec(), &[0, 1, 2]);
    let indices = [[0, 1, 2].repeat(20_000), [3, 1, 2].repeat(20_000)].concat();
    let pixels = painted(&[Mesh { indices: &indices, ..shape.mesh() }]);
    assert_eq!(pixels, vec![[10, 20, 30, 255]; (SIZE[0] * SIZE[1]) as usize], "all is covered");
}
