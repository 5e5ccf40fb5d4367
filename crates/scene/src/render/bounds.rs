//! Records draws; in large scenes with where they lie in the image, so that the rasterizer leaves out those that are
//! hidden as a whole.

use trigon_math::{Bounds3, DVec3};
use trigon_raster::{DrawBounds, Pass};

use super::record::{DrawSource, Record};
use crate::placement::Placement;

/// Scenes of fewer triangles are drawn before much could be saved. In tests all scenes count as large.
const LARGE: usize = if cfg!(test) { 1 } else { 1 << 20 };

/// Records the draws of a pass.
pub(super) fn record_all<'a>(draws: &'a [Box<dyn Record + '_>], pass: &mut Pass<'a>) {
    let triangles: usize = draws.iter().map(|draw| draw.source().triangles.len()).sum();
    for draw in draws {
        draw.record(pass);
        let DrawSource { geometry, triangles: own, placement, .. } = draw.source();
        if triangles >= LARGE && !own.is_empty() {
            clip_bounds(&placement, &geometry.bounds()).map(|bounds| pass.bounds(bounds));
        }
    }
}

/// Where the vertices in a box lie in the image, as [`Placement::clip`] computes them in f32. `None` if some may not be in
/// front of the eye.
fn clip_bounds(placement: &Placement, bounds: &Bounds3) -> Option<DrawBounds> {
    /// A coordinate is a sum of four products of rounded differences: it has at most seven roundings, and its quotient one
    /// more. Each is at most half of this number of what is rounded. The rest is room for roundings here.
    const ERROR: f64 = 8.0 * f32::EPSILON as f64;
    /// Far from where numbers of f32 lose bits.
    const LEAST_W: f64 = 1e-20;
    let anchor = placement.anchor.as_dvec3();
    let within = Bounds3 { min: bounds.min - anchor, max: bounds.max - anchor };
    if !(within.min.is_finite() && within.max.is_finite() && placement.to_clip.is_finite()) {
        return None;
    }
    let to_clip = placement.to_clip.as_dmat4();
    let corners = within.corners().map(|corner| to_clip * corner.extend(1.0));
    let sizes = Bounds3 { min: -within.max, max: -within.min }.union(within).max.extend(1.0);
    let errors = to_clip.transpose().to_cols_array_2d().map(|row| {
        let terms = row.into_iter().zip(sizes.to_array());
        terms.map(|(factor, size)| (factor * size).abs()).sum::<f64>() * ERROR
    });
    let [.., w_error] = errors;
    let least_w =
        corners.iter().fold(f64::INFINITY, |least, corner| if corner.w < least { corner.w } else { least });
    let least_w = least_w - w_error;
    if least_w <= LEAST_W {
        return None;
    }
    // What lies between the corners has a quotient between theirs.
    let quotients = Bounds3::from_points(corners.map(|corner| corner.truncate() / corner.w));
    let slack = DVec3::from_array([0, 1, 2].map(|axis| {
        let largest = quotients.min[axis].abs() + quotients.max[axis].abs();
        (errors[axis] + largest * w_error) / least_w + largest * ERROR
    }));
    let [least, greatest] = [quotients.min - slack, quotients.max + slack];
    Some(DrawBounds { least: [least.x, least.y], greatest: [greatest.x, greatest.y], nearest: greatest.z })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::baseline;
    use crate::placement::Eye;
    use crate::scene::NodePlacement;
    use proptest::prelude::*;
    use trigon_camera::{Camera, Projection};
    use trigon_math::glam::{DAffine3, DQuat};
    use trigon_math::{DMat3, Vec3};
    use trigon_raster::simd::prelude::*;
    use trigon_raster::simd::{F32, InlineMap, LANES};

    /// A box, flat in some directions or none, and a place in it for each axis.
    fn boxes() -> impl Strategy<Value = (Vec3, Vec3, [[f32; LANES]; 3])> {
        let side = prop_oneof![Just(0.0_f32), 1e-6_f32..1e-3, 0.1_f32..10.0, 1e3_f32..1e6];
        let middle = prop_oneof![-1.0_f32..1.0, -1e5_f32..1e5];
        let within = prop::array::uniform(prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..1.0]);
        let axis = || (middle.clone(), side.clone(), within.clone());
        [axis(), axis(), axis()].prop_map(|axes| {
            let least = Vec3::from_array(axes.each_ref().map(|(middle, ..)| *middle));
            let greatest = least + Vec3::from_array(axes.each_ref().map(|(_, side, _)| *side));
            (least, greatest, axes.map(|(.., within)| within))
        })
    }

    fn cameras() -> impl Strategy<Value = Camera> {
        let distance = prop_oneof![0.01_f64..1.0, 1.0_f64..1e3, 1e3_f64..1e7];
        let perspective = (0.05_f64..2.5, prop_oneof![Just(1e-4), 0.01_f64..10.0], any::<bool>());
        let perspective = perspective.prop_map(|(angle, near, ends)| {
            Projection::perspective(angle, near, ends.then_some(1e5)).expect("in range")
        });
        let parallel =
            (0.1_f64..1e4).prop_map(|height| Projection::orthographic(height, 0.1, 1e5).expect("in range"));
        let direction = [-1.0_f64..1.0, -1.0_f64..1.0, 0.1_f64..1.0];
        (distance, direction, prop_oneof![3 => perspective, 1 => parallel]).prop_map(
            |(distance, direction, projection)| {
                let position = DVec3::from(direction).normalize() * distance;
                Camera::look_at(position, DVec3::ZERO, DVec3::Y).with_projection(projection)
            },
        )
    }

    fn worlds() -> impl Strategy<Value = DAffine3> {
        let scale = || prop_oneof![Just(-1.0_f64), 1e-3_f64..1e3, Just(0.0)];
        let moved = || prop_oneof![-1.0_f64..1.0, -1e4_f64..1e4];
        ([scale(), scale(), scale()], [moved(), moved(), moved()], -3.0_f64..3.0).prop_map(
            |(scale, to, turn)| {
                let matrix3 =
                    DMat3::from_quat(DQuat::from_rotation_z(turn)) * DMat3::from_diagonal(scale.into());
                DAffine3 { matrix3, translation: to.into() }
            },
        )
    }

    proptest! {
        /// Against the positions themselves, as the vertex stage computes them (at any level: all give the same bits).
        #[test]
        fn no_vertex_leaves_the_bounds_of_its_box(
            (least, greatest, within) in boxes(),
            camera in cameras(),
            world in worlds(),
        ) {
            let bounds = Bounds3 { min: least.as_dvec3(), max: greatest.as_dvec3() };
            let eye = Eye::new(&camera, 1.5);
            let placement = eye.placement(&NodePlacement { world, is_mirrored: false }, &bounds);
            let Some(found) = clip_bounds(&placement, &bounds) else { return Ok(()) };
            let at = |axis: usize| {
                within[axis].map(|part| {
                    let at = least[axis] + (greatest[axis] - least[axis]) * part;
                    at.clamp(least[axis], greatest[axis])
                })
            };
            let simd = baseline();
            let position = placement.clip(simd, [0, 1, 2].map(|axis| F32::simd_from(simd, at(axis))));
            let position: [[f32; LANES]; 4] = position.each(Into::into);
            for lane in 0..LANES {
                    let [x, y, z, w] = position.map(|axis| axis[lane]);
                    prop_assert!(w > 0.0, "{w}");
                    let quotient = |value: f32| f64::from(value) / f64::from(w);
                    for (axis, value) in [quotient(x), quotient(y)].into_iter().enumerate() {
                        let [from, to] = [found.least[axis], found.greatest[axis]];
                        prop_assert!(from <= value && value <= to, "{value} of {from} to {to}");
                    }
                    let depth = f64::from(z / w);
                    prop_assert!(depth <= found.nearest, "{depth}, at most {}", found.nearest);
            }
        }
    }
}
