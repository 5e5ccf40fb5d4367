//! Shadow maps in use: depth images seen from each lamp (L. Williams, "Casting Curved Shadows on Curved
//! Surfaces", 1978).
//!
//! **View.** A map depends on its lamp, all casters and its size, never on the camera: parallel
//! light is fitted to the box of the casters, a cone is one view, and a point light six. So a map
//! is drawn again only if one of the three changes.
//!
//! **Bias.** A map holds the depth at the centres of its texels; a point on the same plane lies up to √2 texels
//! away, and would shadow itself. So points are moved along the normal of the surface. A plane needs √2 · sin θ
//! texels, where θ is the angle between the normal and the axis of the map. A quarter of a texel is added for
//! curvature and rounding. (In a perspective map, that of a spot light or one of the six of a point light, texels
//! of equal depth lie in a plane perpendicular to the axis, not to the ray.) No constant is added to depths. A
//! shadow therefore begins at most 1.7 texels away from its caster.
//!
//! Interpolated normals lean away from the triangle, by more than a quarter of a texel makes up for where a mesh is
//! coarse (10° and more). There points are moved as far as the triangle itself needs, along its interpolated normal.
//!
//! Four depths around a point are compared, and the results mixed bilinearly. [`shadow_maps`](crate::shadow_maps) draws
//! the maps.

use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

use trigon_camera::{Camera, Projection};
use trigon_math::{Bounds3, DAffine3, DMat4, DVec3, DVec4, Mat4, Vec3, elementary};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, LANES, Simd, greater, inlined, lanes_of, lesser};

use super::casters::Casters;
use super::penumbra::{MapPoints, NearestDepths, Penumbra};
use crate::lanes::{V3, dot, mapped, mix, positive, scaled, splat, sum};
use crate::lighting::LitPoints;
use crate::work::{Work, note};

/// The casters' depth as seen from a lamp.
#[derive(Clone, Debug)]
pub(crate) struct ShadowMap {
    pub(crate) view: View,
    pub(crate) resolution: u32,
    /// Reversed depth, 0 where nothing is; row by row.
    pub(crate) depths: Vec<f32>,
    /// For lamps with an extent.
    pub(crate) nearest: Option<NearestDepths>,
}

/// The shadow maps of a frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowMaps {
    /// For each lamp its views; none where it casts no shadow.
    pub(crate) lamps: Vec<Vec<PlacedMap>>,
}

/// A shadow map and its map from the frame's camera.
#[derive(Clone, Debug)]
pub(crate) struct PlacedMap {
    map: Arc<ShadowMap>,
    /// From camera space to texels, depth and w.
    to_texels: Mat4,
    /// The width of a texel in metres, where w is 1.
    texel: f32,
    /// The direction in which the map looks, in camera space, if its rays meet in the lamp; parallel
    /// ones come from the direction of the light.
    axis: Option<Vec3>,
    /// The columns and rows at the edges that another map shows as well.
    shown_elsewhere: f32,
    /// Of a lamp with an extent.
    penumbra: Option<Penumbra>,
}

impl PlacedMap {
    /// A map of a lamp of this radius.
    pub(crate) fn new(map: Arc<ShadowMap>, radius: f32, camera_to_world: &DAffine3) -> Self {
        let half = f64::from(map.resolution) / 2.0;
        // From -1…1, y up, to 0…resolution, y down.
        let to_texels = DMat4::from_cols(
            DVec4::new(half, 0.0, 0.0, 0.0),
            DVec4::new(0.0, -half, 0.0, 0.0),
            DVec4::Z,
            DVec4::new(half, half, 0.0, 1.0),
        );
        let from_camera = map.view.world_to_clip() * DMat4::from(*camera_to_world);
        let texel = map.view.width_at_one / f64::from(map.resolution);
        let exact = to_texels * from_camera;
        let penumbra = Penumbra::new(radius, &map.view, map.resolution, &exact);
        let shown_elsewhere = ((1.0 - map.view.own_part) * half) as f32;
        let to_texels = exact.as_mat4();
        if map.view.camera.projection.is_orthographic() {
            return Self { to_texels, texel: texel as f32, axis: None, shown_elsewhere, penumbra, map };
        }
        let along = map.view.camera.orientation * DVec3::NEG_Z;
        let axis = camera_to_world.matrix3.inverse() * along;
        // A point that is moved away from the lamp comes to where texels are wider: by the share
        // sin θ · cos θ · √2 of a texel at most, and all of it counts again.
        let wider = texel / (1.0 - FRAC_1_SQRT_2 * texel).max(0.5);
        let axis = Some(axis.normalize_or_zero().as_vec3());
        Self { to_texels, texel: wider as f32, axis, shown_elsewhere, penumbra, map }
    }

    /// The fraction of the light that arrives at eight points, and which of them lie inside the
    /// map.
    #[inline(always)]
    fn share<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        leaning: &Leaning<S>,
        towards: V3<S>,
    ) -> (F32<S>, trigon_raster::simd::Mask<S>) {
        const ASIDE: f32 = std::f32::consts::SQRT_2;
        const CURVATURE: f32 = 0.25;
        /// A point where two maps of a point light meet may lie outside of both by rounding, which is less than this
        /// for maps of 8192 texels: so each map reaches as far beyond its edge.
        const SEAM: f32 = 1.0 / 64.0;
        let along = match self.axis {
            Some(axis) => splat(simd, axis),
            None => towards,
        };
        let cosine = dot(points.facing, along);
        let sine = positive(1.0 - cosine * cosine).sqrt();
        let w = mapped(&self.to_texels, points.position)[3];
        let texels = greater(leaning.texels(along) * ASIDE, sine * ASIDE + CURVATURE);
        let offset = texels * w * self.texel;
        let moved = sum(points.position, scaled(points.facing, offset));
        let [x, y, depth, w] = mapped(&self.to_texels, moved);
        let inverse = F32::splat(simd, 1.0) / w;
        let [x, y, depth] = [x * inverse, y * inverse, depth * inverse];
        let start = self.shown_elsewhere - SEAM;
        let end = self.map.resolution as f32 - start;
        let is_known = w.simd_gt(0.0) & x.simd_ge(start) & y.simd_ge(start) & x.simd_lt(end) & y.simd_lt(end);
        let Some(penumbra) = &self.penumbra else {
            return (self.map.compared(simd, [x, y], depth), is_known);
        };
        let at = MapPoints { texels: [x, y], depth, position: moved, is_known };
        (penumbra.share(simd, &self.map, points, &at), is_known)
    }
}

/// How normals lean away from their triangles.
struct Leaning<S: Simd> {
    /// Perpendicular to the triangles, the square of its length, and its part along the normals.
    plane: V3<S>,
    square: F32<S>,
    upright: F32<S>,
}

impl<S: Simd> Leaning<S> {
    #[inline(always)]
    fn new(points: &LitPoints<S>) -> Self {
        let plane = points.plane;
        let square = dot(plane, plane);
        // A normal that leans by more than 60° says nothing about its triangle.
        let upright = greater(dot(plane, points.facing).abs(), square.sqrt() * 0.5);
        Self { plane, square, upright }
    }

    /// How far to move along the normal to rise by sin θ above the triangle, θ being the angle between its own normal
    /// and a unit vector; not a number for triangles without area.
    #[inline(always)]
    fn texels(&self, along: V3<S>) -> F32<S> {
        let part = dot(self.plane, along);
        positive(self.square - part * part).sqrt() / self.upright
    }
}

impl ShadowMap {
    /// The fraction of four texels around points that are at least as far from the lamp as the
    /// points.
    #[inline(always)]
    pub(super) fn compared<S: Simd>(&self, simd: S, position: [F32<S>; 2], depth: F32<S>) -> F32<S> {
        let (zero, side) = (F32::splat(simd, 0.0), F32::splat(simd, self.resolution as f32));
        // The two texels on either side, at the edge of the map the nearest one twice; and the weight of the second.
        let axis = inlined(
            #[inline(always)]
            |value: F32<S>| {
                let held = lesser(greater(value, zero), side) - 0.5;
                let first = held.floor();
                let [first_texel, second_texel] = [greater(first, zero), lesser(first + 1.0, side - 1.0)];
                ([first_texel.to_int::<I32<S>>(), second_texel.to_int()], held - first)
            },
        );
        let ((columns, across), (rows, down)) = (axis(position[0]), axis(position[1]));
        let rows = [rows[0] * self.resolution as i32, rows[1] * self.resolution as i32];
        let lit = inlined(
            #[inline(always)]
            |[right, below]: [usize; 2]| {
                let texels: [i32; LANES] = (rows[below] + columns[right]).into();
                let stored = F32::simd_from(
                    simd,
                    lanes_of(
                        #[inline(always)]
                        |lane| self.depths[texels[lane] as usize],
                    ),
                );
                (stored.simd_le(depth) | stored.simd_eq(zero)).select(F32::splat(simd, 1.0), zero)
            },
        );
        let above = mix(lit([0, 0]), lit([1, 0]), across);
        mix(above, mix(lit([0, 1]), lit([1, 1]), across), down)
    }
}

impl ShadowMaps {
    /// The fraction of a lamp's light that arrives at eight points; `None` if it casts no shadow.
    pub(crate) fn share<S: Simd>(
        &self,
        simd: S,
        lamp: usize,
        points: &LitPoints<S>,
        towards: V3<S>,
    ) -> Option<F32<S>> {
        let maps = self.lamps.get(lamp).filter(|maps| !maps.is_empty())?;
        note(Work::ShadowLookUp);
        Some(simd.vectorize(
            #[inline(always)]
            || {
                let mut share = F32::splat(simd, 1.0);
                let leaning = Leaning::new(points);
                for map in maps {
                    let (found, known) = map.share(simd, points, &leaning, towards);
                    share = known.select(found, share);
                }
                share
            },
        ))
    }

    /// Their memory in bytes.
    pub(crate) fn byte_count(&self) -> usize {
        self.lamps.iter().flatten().map(|placed| size_of_val(placed.map.depths.as_slice())).sum()
    }

    /// What lamps with an extent add to it.
    pub(crate) fn extent_byte_count(&self) -> usize {
        let nearest = self.lamps.iter().flatten().filter_map(|placed| placed.map.nearest.as_ref());
        nearest.map(NearestDepths::byte_count).sum()
    }
}

/// A lamp's position and direction, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LampPose {
    /// Parallel light; the unit vector points along it.
    Directional(DVec3),
    /// Within a cone of half this angle (radians), or all around.
    Point { position: DVec3, cone: Option<(DVec3, f64)> },
}

/// A lamp as shadow maps see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LampView {
    pub(crate) pose: LampPose,
    /// Whether it has an extent.
    pub(crate) is_soft: bool,
}

/// The widest cone (radians, the whole angle) that one view covers; wider ones would waste most
/// texels on their edges.
const WIDEST: f64 = 2.2;

/// A lamp's camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) camera: Camera,
    /// Width over height.
    pub(crate) aspect: f64,
    /// Its width in metres where w is 1, in its longer direction.
    pub(crate) width_at_one: f64,
    /// The part of its width and height in which no other view of the lamp shows more.
    pub(crate) own_part: f64,
}

impl View {
    /// From the world to clip space.
    pub(crate) fn world_to_clip(&self) -> DMat4 {
        self.camera.view_projection(self.aspect)
    }

    /// Its width and height in metres where w is 1.
    pub(crate) fn sizes_at_one(&self) -> [f64; 2] {
        let (longer, aspect) = (self.width_at_one, self.aspect);
        if aspect >= 1.0 { [longer, longer / aspect] } else { [longer * aspect, longer] }
    }
}

/// The views of a lamp; none if there is nothing that it could see.
pub(crate) fn views(lamp: &LampView, casters: &Casters) -> Vec<View> {
    /// How much farther the views of a lamp with an extent reach, in radians, to each side: a penumbra may need it.
    const BESIDE: f64 = 0.12;
    if casters.bounds.is_empty() {
        return Vec::new();
    }
    let beside = if lamp.is_soft { BESIDE } else { 0.0 };
    match lamp.pose {
        LampPose::Directional(along) => parallel(along, casters).into_iter().collect(),
        LampPose::Point { position, cone: Some((along, half)) } if 2.0 * half < WIDEST => {
            // Slightly wider, so that the edge has neighbours.
            let angle = 2.0 * (half + beside) + 0.02;
            meeting(position, along, angle, &casters.bounds).into_iter().collect()
        }
        LampPose::Point { position, .. } => {
            let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
            let angle = std::f64::consts::FRAC_PI_2 + 2.0 * beside;
            let own_part = if lamp.is_soft { 1.0 / elementary::tan(0.5 * angle) } else { 1.0 };
            let views = sides.filter_map(|along| meeting(position, along, angle, &casters.bounds));
            views.map(|view| View { own_part, ..view }).collect()
        }
    }
}

/// Parallel rays through the box of all casters, seen along them.
fn parallel(along: DVec3, casters: &Casters) -> Option<View> {
    let turned = Camera::look_at(DVec3::ZERO, along, DVec3::Y);
    let mut extent = Bounds3::EMPTY;
    for bounds in casters.boxes() {
        bounds.corners().into_iter().for_each(|corner| extent.include(turned.to_camera(corner)));
    }
    let (middle, size) = (extent.center()?, extent.size());
    // A flat caster still has two sides, and no caster lies at the ends.
    let margin = 1e-3 * size.length() + 1e-30;
    let (width, height, depth) = (size.x + margin, size.y + margin, size.z / 2.0 + margin);
    let projection = Projection::orthographic(height, -depth, depth).ok()?;
    let camera = Camera { position: turned.to_world(middle), projection, ..turned };
    let width_at_one = if width > height { width } else { height };
    Some(View { camera, aspect: width / height, width_at_one, own_part: 1.0 })
}

/// Rays that meet in the lamp.
fn meeting(position: DVec3, along: DVec3, angle: f64, casters: &Bounds3) -> Option<View> {
    /// Objects down to this fraction of the farthest caster's distance cast shadows. Reversed depth is as exact however
    /// small it is; f32 still holds it where the farthest caster is 10⁻¹⁹ m away. A power of two times what it once was:
    /// depths that it only scales compare as they did.
    const NEAREST: f64 = 1e-4 / (1_u64 << 46) as f64;
    let farthest = casters.corners().into_iter().map(|corner| corner.distance(position));
    let farthest = farthest.fold(0.0, |far, distance| if distance > far { distance } else { far });
    let projection = Projection::perspective(angle, farthest * NEAREST, None).ok()?;
    let camera = Camera { projection, ..Camera::look_at(position, position + along, DVec3::Y) };
    let width_at_one = 2.0 * elementary::tan(angle * 0.5);
    Some(View { camera, aspect: 1.0, width_at_one, own_part: 1.0 })
}
