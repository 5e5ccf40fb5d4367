//! The properties that hold for every clipped triangle, stated once.

use trigon_math::elementary::exp2;
use trigon_math::{ClipPolygon, ClipVertex, Vec4, clip_triangle};

use super::input::Planes;

/// Whether a position satisfies the planes, exactly: products of an `f32` and a
/// power of two are exact in `f64`, and comparisons do not round.
fn is_inside(planes: &Planes, position: Vec4) -> bool {
    let [x, y, z, w] = position.to_array().map(f64::from);
    let within = |value: f64, band: Option<f32>| band.is_none_or(|band| value.abs() <= f64::from(band) * w);
    w >= f64::from(planes.minimal_w)
        && (!planes.near || z <= w)
        && (!planes.far || z >= 0.0)
        && within(x, planes.horizontal)
        && within(y, planes.vertical)
}

/// Weights in [0, 1], whose sum is 1 up to the rounding to `f32`: each is within
/// 2⁻²⁵ of a number below 1, and those three sum to 1 within 2⁻⁴⁸ (seven cuts,
/// each with less than 4 roundings of 2⁻⁵³).
pub(super) fn weights_are_convex<const N: usize>(vertex: &ClipVertex<N>) {
    let weights = vertex.weights.map(f64::from);
    assert!(
        weights.iter().all(|weight| (0.0..=1.0).contains(weight)),
        "a weight of {vertex:?} is out of range"
    );
    let excess = weights.iter().sum::<f64>() - 1.0;
    let bound = 3.0 * exp2(-25.0) + exp2(-48.0);
    assert!(excess.abs() <= bound, "the weights of {vertex:?} sum to 1 + {excess}");
}

/// Clips, and checks all that needs no oracle.
pub(super) fn clip(triangle: [Vec4; 3], planes: &Planes) -> ClipPolygon {
    let polygon = clip_triangle(triangle, &planes.volume());
    let vertices = polygon.vertices();
    let most = 3 + planes.equations().len();
    assert!(
        vertices.is_empty() || (3..=most).contains(&vertices.len()),
        "{} vertices of {triangle:?} by {planes:?}",
        vertices.len()
    );
    for vertex in vertices {
        assert!(is_inside(planes, vertex.position), "{vertex:?} is outside; {triangle:?} by {planes:?}");
        assert!(vertex.position.is_finite(), "{vertex:?} is not finite");
        weights_are_convex(vertex);
    }
    corners_inside_are_kept(triangle, planes, &polygon);
    polygon
}

/// A corner inside comes out as it went in, with its own weight alone.
fn corners_inside_are_kept(triangle: [Vec4; 3], planes: &Planes, polygon: &ClipPolygon) {
    let inside = triangle.map(|corner| is_inside(planes, corner));
    if inside == [true; 3] {
        assert_eq!(polygon.vertices().len(), 3, "nothing is cut off {triangle:?}");
    }
    if polygon.is_empty() {
        return;
    }
    for index in (0..3).filter(|&index| inside[index]) {
        let mut weights = [0.0; 3];
        weights[index] = 1.0;
        let corner = ClipVertex { position: triangle[index], weights };
        assert!(
            polygon.vertices().contains(&corner),
            "corner {index} of {triangle:?} is missing; {planes:?}"
        );
    }
}

/// The bits of a position: +0 and -0 are different.
pub(super) fn bits(position: Vec4) -> [u32; 4] {
    position.to_array().map(f32::to_bits)
}
