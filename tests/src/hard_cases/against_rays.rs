//! A triangle as it is drawn against what rays meet of it.

use crate::coverage_support::{SIDE, Values, draw, pixel};
use trigon_math::{DVec2, UVec2, Vec4};
use trigon_raster::{Culling, Draw, Pass};
use trigon_study::oracle::ray::{Facet, Tolerance};

/// Holds every pixel that is clear of the outline to the rays: whether the triangle is
/// there, and how deep.
pub(super) fn check(corners: [Vec4; 3], tolerance: Tolerance) {
    // In the near plane itself rounding would decide what a ray meets: what is seen is the
    // same from half as deep on.
    let is_in_plane = corners.iter().all(|corner| corner.z == corner.w);
    let before = if is_in_plane { corners.map(|c| Vec4::new(c.x, c.y, 0.5 * c.z, c.w)) } else { corners };
    let facet = Facet::new(before, UVec2::splat(SIDE as u32));
    let pipeline = Values::ones(corners);
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
    let images = draw(&pass);
    let (ids, depths) = (images.triangles.expect("asked for"), images.depth.expect("asked for"));
    for (index, (&id, &depth)) in ids.iter().zip(&depths).enumerate() {
        assert!((0.0..=1.0).contains(&depth), "depth {depth}");
        let point = DVec2::from(pixel(index).map(f64::from)) + 0.5;
        if facet.distance_to_outline(point) <= tolerance.outline {
            continue;
        }
        let met = facet.meets(point);
        assert_eq!(id == 0, met.is_some(), "at {point} of {corners:?}");
        let Some(exact) = met else { continue };
        let exact = if is_in_plane { 1.0 } else { exact };
        let bound = facet.steepness() * tolerance.outline + tolerance.depth;
        assert!((f64::from(depth) - exact).abs() <= bound, "depth {depth} instead of {exact} at {point}");
    }
}
