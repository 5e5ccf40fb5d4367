//! The soft edge of a shadow in a shadow map: percentage-closer soft shadows (R. Fernando, "Percentage-Closer Soft
//! Shadows", 2005).
//!
//! Seen from the middle of a lamp, the rest of the lamp hides behind what is near a point's place in the map. The cone
//! from the point to the lamp's disc is a disc in the map, too. In units of the stored depth, which in perspective is an
//! inverse of the distance, its radius is in proportion to how much nearer to the lamp the map is cut:
//! [`Penumbra::cone`] has the factor.
//!
//! **Search.** A pyramid of the nearest depths bounds the disc that can hold casters; where it is empty all light arrives.
//! Texels of the disc are looked up, and those that lie above the surface and within the cone at their own depth are
//! casters. **Filter.** At the depth of the one that is nearest to the surface the cone is as wide as the penumbra. The
//! fraction of the texels of this disc that are no casters is the fraction of the lamp that is visible. Behind a straight
//! edge that is exact. (Fernando takes the mean of the depths. But what the lamp sees of something round lies nearer to it
//! than the silhouette that casts the shadow, so the mean makes penumbras too wide and umbras too bright.)
//!
//! Each texel is compared with the plane of the surface at the texel's own place, so that a plane casts no shadow on
//! itself however wide the disc is.

use std::sync::LazyLock;

use trigon_math::{DMat4, Mat4, Vec2};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, InlineMap, LANES, Mask, Simd, greater, lanes_of, lesser};

use super::rays::{DiscPattern, GOLDEN_ANGLE, RayPart};
use super::shadow::{ShadowMap, View};
use crate::effect_settings::RaySampling;
use crate::lanes::{V3, dot, lesser_of, positive};
use crate::lighting::LitPoints;
use crate::work::{Work, note};

/// The texels that are looked up in search of casters.
static SEARCHED: LazyLock<DiscPattern> =
    LazyLock::new(|| DiscPattern::new(32, RaySampling::Full, GOLDEN_ANGLE));

/// The texels that are compared.
static COMPARED: LazyLock<DiscPattern> =
    LazyLock::new(|| DiscPattern::new(32, RaySampling::Full, GOLDEN_ANGLE));

/// A penumbra narrower than this, in texels, is as sharp as the map.
const SHARP: f32 = 1.0;

/// The nearest depths of ever larger squares of texels.
#[derive(Clone, Debug)]
pub(crate) struct NearestDepths {
    /// Squares of 2, 4, 8 … texels; the last level is one square.
    levels: Vec<Level>,
}

#[derive(Clone, Debug)]
struct Level {
    side: u32,
    depths: Vec<f32>,
}

impl NearestDepths {
    pub(crate) fn new(side: u32, depths: &[f32]) -> Self {
        let mut levels: Vec<Level> = Vec::new();
        let (mut side, mut below) = (side, depths);
        loop {
            let half = side.div_ceil(2);
            let level = Level { side: half, depths: halved(side, below) };
            levels.push(level);
            if half <= 1 {
                return Self { levels };
            }
            let last = levels.last().expect("one was just added");
            (side, below) = (last.side, &last.depths);
        }
    }

    /// The nearest depth of all.
    fn of_all(&self) -> f32 {
        self.levels.last().map_or(0.0, |level| level.depths[0])
    }

    /// The nearest depth in squares of texels around eight places, and perhaps of some more around them.
    #[inline(always)]
    fn around<S: Simd>(&self, simd: S, texels: [F32<S>; 2], radius: F32<S>) -> F32<S> {
        let [x, y]: [[f32; LANES]; 2] = texels.map(Into::into);
        let radius: [f32; LANES] = radius.into();
        F32::simd_from(
            simd,
            lanes_of(
                #[inline(always)]
                |lane| self.around_one([x[lane], y[lane]], radius[lane]),
            ),
        )
    }

    fn around_one(&self, texels: [f32; 2], radius: f32) -> f32 {
        // Two squares of this level, across and down, cover the disc.
        let mut size = 2.0;
        let mut number = 0;
        while size < 2.0 * radius && number + 1 < self.levels.len() {
            (size, number) = (size * 2.0, number + 1);
        }
        let level = &self.levels[number];
        let last = level.side as usize - 1;
        // Casts from f32 saturate.
        let ends = texels
            .map(|middle| [middle - radius, middle + radius].map(|end| ((end / size) as usize).min(last)));
        let [[left, right], [top, bottom]] = ends;
        let mut nearest = 0.0;
        for row in [top, bottom] {
            for column in [left, right] {
                let depth = level.depths[row * level.side as usize + column];
                nearest = if depth > nearest { depth } else { nearest };
            }
        }
        nearest
    }

    pub(crate) fn byte_count(&self) -> usize {
        self.levels.iter().map(|level| size_of_val(level.depths.as_slice())).sum()
    }
}

/// The greatest of each square of two by two.
fn halved(side: u32, depths: &[f32]) -> Vec<f32> {
    let (side, half) = (side as usize, side.div_ceil(2) as usize);
    let mut nearest = vec![0.0_f32; half * half];
    for (row, depths) in depths.chunks(side).enumerate() {
        let nearest = &mut nearest[row / 2 * half..][..half];
        for (nearest, pair) in nearest.iter_mut().zip(depths.chunks(2)) {
            for &depth in pair {
                *nearest = if depth > *nearest { depth } else { *nearest };
            }
        }
    }
    nearest
}

/// How a lamp with an extent sees the scene of a frame through one of its maps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Penumbra {
    /// The radius of the cone to the lamp in texels, across and down, per difference of depth.
    cone: [f32; 2],
    /// From planes of camera space to those of texels and depth.
    planes: Mat4,
    /// The middle of the map in texels, and what a texel is of the distance along its axis; 0 for parallel light.
    middle: f32,
    slope: f32,
}

/// Eight points in a map.
#[derive(Clone, Copy)]
pub(super) struct MapPoints<S: Simd> {
    pub(super) texels: [F32<S>; 2],
    pub(super) depth: F32<S>,
    /// In camera space, off the surface.
    pub(super) position: V3<S>,
    pub(super) is_known: Mask<S>,
}

impl Penumbra {
    /// Of a lamp of some radius. `None` for 0, and for what is as little in numbers of f32.
    pub(super) fn new(radius: f32, view: &View, resolution: u32, to_texels: &DMat4) -> Option<Self> {
        let (projection, sizes) = (view.camera.projection, view.sizes_at_one());
        let matrix = projection.matrix(view.aspect);
        let is_parallel = projection.is_orthographic();
        let per_depth = if is_parallel { matrix.z_axis.z } else { matrix.w_axis.z };
        let texels = sizes.map(|size| f64::from(resolution) / size);
        let largest = f64::from(f32::MAX);
        let cone = texels.map(|texels| (f64::from(radius) * texels / per_depth).abs().min(largest) as f32);
        let is_possible = cone.iter().all(|factor| *factor > 0.0);
        let slope = if is_parallel { 0.0 } else { 1.0 / texels[0] };
        is_possible.then(|| Self {
            cone,
            planes: to_texels.inverse().transpose().as_mat4(),
            middle: resolution as f32 / 2.0,
            slope: slope as f32,
        })
    }

    /// The fraction of the lamp that is visible from eight points, which are sharp by themselves.
    pub(super) fn share<S: Simd>(
        &self,
        simd: S,
        map: &ShadowMap,
        points: &LitPoints<S>,
        at: &MapPoints<S>,
    ) -> F32<S> {
        note(Work::PenumbraLookUp);
        simd.vectorize(
            #[inline(always)]
            || {
                let one = F32::splat(simd, 1.0);
                let Some(nearest) = &map.nearest else { return one };
                let disc = self.disc(simd, points, at);
                let widest = self.widest_cone(simd, nearest, &disc);
                let active = Mask::from_bitmask(simd, points.lanes.active);
                let is_shaded = active & at.is_known & widest.simd_gt(0.0);
                if !is_shaded.any_true() {
                    return one;
                }
                let (caster, is_found) = self.casters(simd, map, &disc, widest);
                let is_found = (is_found | disc.is_past_lamp) & is_shaded;
                if !is_found.any_true() {
                    return one;
                }
                let radius = is_found.select(caster - disc.depth, F32::splat(simd, 0.0));
                let is_narrow =
                    (radius * self.cone[0]).simd_lt(SHARP) | (radius * self.cone[1]).simd_lt(SHARP);
                let is_sharp = is_narrow | disc.is_past_lamp;
                let lit = disc.lit(simd, map, radius);
                let lit = match (is_sharp & is_found).any_true() {
                    true => is_sharp.select(map.compared(simd, at.texels, at.depth), lit),
                    false => lit,
                };
                is_found.select(lit, one)
            },
        )
    }
}

/// The discs of cones in a map around eight points.
struct Disc<S: Simd> {
    texels: [F32<S>; 2],
    depth: F32<S>,
    /// What the surface's depth changes by from texel to texel.
    slopes: [F32<S>; 2],
    /// Where points were moved so far off their surface that the lamp lies behind them: a plane there says nothing of texels
    /// beside theirs.
    is_past_lamp: Mask<S>,
    /// Seen beside the axis, discs are ellipses, which are longer in this direction by the last factor.
    aside: [F32<S>; 2],
    longer: F32<S>,
    /// Sines and cosines of how the pattern is turned.
    turns: [F32<S>; 2],
    cone: [f32; 2],
}

impl Penumbra {
    #[inline(always)]
    fn disc<S: Simd>(&self, simd: S, points: &LitPoints<S>, at: &MapPoints<S>) -> Disc<S> {
        let one = F32::splat(simd, 1.0);
        let aside = at.texels.each(
            #[inline(always)]
            |texel| (texel - self.middle) * self.slope,
        );
        let square = aside[0] * aside[0] + aside[1] * aside[1];
        let turns = COMPARED.turns(points.lanes.pixels, RayPart::All);
        let turns = [turns.map(|turn| turn.x), turns.map(|turn| turn.y)].each(
            #[inline(always)]
            |values| F32::simd_from(simd, values),
        );
        let (slopes, is_past_lamp) = self.slopes(points, at.position);
        Disc {
            texels: at.texels,
            depth: at.depth,
            slopes,
            is_past_lamp,
            aside,
            // √(1 + square) − 1, over the square.
            longer: one / ((square + 1.0).sqrt() + 1.0),
            turns,
            cone: self.cone,
        }
    }

    /// What the depth of the surfaces' planes through these positions changes by per texel, and where the lamp is not on the side
    /// that they face.
    #[inline(always)]
    fn slopes<S: Simd>(&self, points: &LitPoints<S>, position: V3<S>) -> ([F32<S>; 2], Mask<S>) {
        let normal = points.plane;
        let (zero, offset) = (F32::splat(position[0].token(), 0.0), -dot(normal, position));
        let [x, y, depth, _] = self.planes.transpose().to_cols_array_2d().each(
            #[inline(always)]
            |[a, b, c, d]| normal[0] * a + normal[1] * b + normal[2] * c + offset * d,
        );
        let slopes = [x, y].each(
            #[inline(always)]
            |along| {
                let slope = -along / depth;
                // A plane that contains the lamp has none.
                slope.abs().simd_lt(f32::MAX).select(slope, zero)
            },
        );
        // In the map a lamp lies at the origin with a positive depth and w = 0, as does the direction of parallel light: there a
        // plane's value has the sign of this coefficient. The normal may point to either side.
        let above = dot(normal, points.facing).simd_lt(0.0).select(-depth, depth);
        (slopes, !above.simd_gt(0.0))
    }

    /// How much nearer to the lamp than the points casters in their cones may lie; 0 where none do.
    #[inline(always)]
    fn widest_cone<S: Simd>(&self, simd: S, nearest: &NearestDepths, disc: &Disc<S>) -> F32<S> {
        /// Each bounds the next one.
        const STEPS: usize = 4;
        let [across, down] = self.cone;
        let largest = if across > down { across } else { down };
        // The longer axis of an ellipse.
        let [x, y] = disc.aside;
        let scale = ((x * x + y * y) * disc.longer + 1.0) * largest;
        let mut widest = positive(F32::splat(simd, nearest.of_all()) - disc.depth);
        for _ in 0..STEPS {
            if !widest.simd_gt(0.0).any_true() {
                break;
            }
            let around = nearest.around(simd, disc.texels, widest * scale);
            widest = positive(around - disc.depth);
        }
        widest
    }

    /// The depth of the casters in cones of up to some width that are nearest to the surface, and where there are any.
    #[inline(always)]
    fn casters<S: Simd>(
        &self,
        simd: S,
        map: &ShadowMap,
        disc: &Disc<S>,
        widest: F32<S>,
    ) -> (F32<S>, Mask<S>) {
        let (zero, none) = (F32::splat(simd, 0.0), F32::splat(simd, f32::INFINITY));
        // The middle is within cones of any width: the others miss casters at a small fraction of the widest one.
        let (stored, is_nearer) = disc.texel(simd, map, Vec2::ZERO, zero);
        let mut nearest = is_nearer.select(stored, none);
        for (index, point) in SEARCHED.points().iter().enumerate() {
            // More in the middle, where the cones of casters next to the point are.
            let square = SEARCHED.square(index);
            let (stored, is_nearer) = disc.texel(simd, map, *point * square.sqrt(), widest);
            let is_inside = (widest * square).simd_le(stored - disc.depth);
            nearest = lesser((is_nearer & is_inside).select(stored, none), nearest);
        }
        (nearest, nearest.simd_lt(none))
    }
}

impl<S: Simd> Disc<S> {
    /// The fraction of discs of some width that is nothing but lit.
    #[inline(always)]
    fn lit(&self, simd: S, map: &ShadowMap, radius: F32<S>) -> F32<S> {
        let (zero, one) = (F32::splat(simd, 0.0), F32::splat(simd, 1.0));
        let mut lit = zero;
        for point in COMPARED.points() {
            let (_, is_nearer) = self.texel(simd, map, *point, radius);
            lit += is_nearer.select(zero, one);
        }
        lit / COMPARED.points().len() as f32
    }

    /// The depth of a texel of the discs, and where it is nearer to the lamp than the points and above their surface.
    #[inline(always)]
    fn texel(&self, simd: S, map: &ShadowMap, point: Vec2, radius: F32<S>) -> (F32<S>, Mask<S>) {
        let [sine, cosine] = [self.turns[1], self.turns[0]];
        let [x, y] = [cosine * point.x - sine * point.y, sine * point.x + cosine * point.y];
        let along = (self.aside[0] * x + self.aside[1] * y) * self.longer;
        let [x, y] = [x + self.aside[0] * along, y + self.aside[1] * along];
        let found =
            [self.texels[0] + x * (radius * self.cone[0]), self.texels[1] + y * (radius * self.cone[1])];
        let side = map.resolution as f32;
        let [column, row] = found.each(
            #[inline(always)]
            |at| lesser_of(positive(at), side - 1.0).floor(),
        );
        let is_inside =
            found[0].simd_ge(0.0) & found[1].simd_ge(0.0) & found[0].simd_lt(side) & found[1].simd_lt(side);
        let [columns, rows]: [I32<S>; 2] = [column.to_int(), row.to_int()];
        let indices: [i32; LANES] = (rows * map.resolution as i32 + columns).into();
        let stored = F32::simd_from(
            simd,
            lanes_of(
                #[inline(always)]
                |lane| map.depths[indices[lane] as usize],
            ),
        );
        let plane = self.depth
            + (column + 0.5 - self.texels[0]) * self.slopes[0]
            + (row + 0.5 - self.texels[1]) * self.slopes[1];
        (stored, is_inside & stored.simd_gt(greater(plane, self.depth)))
    }
}
