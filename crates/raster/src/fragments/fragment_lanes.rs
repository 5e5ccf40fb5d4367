//! The input of a pipeline that shades eight fragments at a time.

use super::barycentrics::Barycentrics;
use super::columns::Columns;
use super::context::ShadeContext;
use super::layout::{cold, flag};
use super::records::{Records, Tag};
use super::task::FragmentBatch;
use crate::simd::{F32, I32, InlineMap, LANES, Mask, Row, Simd, greater, lesser, prelude::*};
use crate::{Fragment, MAX_VARYINGS, Varyings};
use trigon_math::{UVec2, Vec2};

/// Up to eight visible fragments, one in each lane.
///
/// Every lane depends on its own triangle and pixel alone. Lanes that are not
/// [active](Self::active) hold arbitrary values, and their results are ignored.
pub struct FragmentLanes<'a, S: Simd> {
    pub(crate) simd: S,
    /// The varyings at each of the three corners: equally many.
    pub(crate) varyings: [&'a [Row]; 3],
    pub(crate) columns: &'a Columns,
    pub(crate) barycentrics: Barycentrics<S>,
    /// In 1/256 internal pixel from the tile's corner.
    pub(crate) point: [I32<S>; 2],
    pub(crate) vector: &'a FragmentBatch<'a, S>,
    pub(crate) records: &'a Records,
    pub(crate) context: &'a ShadeContext<'a>,
}

impl<S: Simd> FragmentLanes<'_, S> {
    /// The lanes whose results are used: bit `i` for lane `i`, at least one.
    #[inline(always)]
    pub fn active(&self) -> u64 {
        self.vector.active
    }

    /// The varying `index`, perspective-correct, within the range of the
    /// corners' values (also if the triangle was cut) and exactly constant where
    /// those are equal.
    #[inline(always)]
    pub fn varying(&self, index: usize) -> F32<S> {
        let [a, b, c] = self.corners(index);
        let [u, v, w] = self.barycentrics.weights;
        let value = a * u + b * v + c * w;
        let (low, high) = (lesser(lesser(a, b), c), greater(greater(a, b), c));
        lesser(greater(value, low), high)
    }

    #[inline(always)]
    fn cold(&self) -> [Row; cold::COUNT] {
        self.records.cold(self.simd, self.context, self.vector.slots())
    }

    #[inline(always)]
    fn tags(&self) -> [Tag; LANES] {
        self.vector.slots().each(
            #[inline(always)]
            |slot| self.records.tag(slot),
        )
    }

    /// A varying at the three corners.
    #[inline(always)]
    fn corners(&self, index: usize) -> [F32<S>; 3] {
        self.varyings.each(
            #[inline(always)]
            |corner| I32::simd_from(self.simd, corner[index]).bitcast(),
        )
    }

    /// The varyings from `first` on, as many as the array holds.
    #[inline(always)]
    pub fn varyings<const N: usize>(&self, first: usize) -> [F32<S>; N] {
        let mut values = [F32::splat(self.simd, 0.0); N];
        for (index, value) in values.iter_mut().enumerate() {
            *value = self.varying(first + index);
        }
        values
    }

    /// The analytic derivatives of the varying `index`, to the right and
    /// downwards, per pixel (with supersampling: per step of the finer grid):
    /// what a texture look-up needs.
    #[inline(always)]
    pub fn gradient(&self, index: usize) -> [F32<S>; 2] {
        let [a, b, c] = self.corners(index);
        let [to_b, to_c] = [b - a, c - a];
        let [v, w] = self.barycentrics.slopes;
        [to_b * v[0] + to_c * w[0], to_b * v[1] + to_c * w[1]]
    }

    /// 1/w, interpolated; > 0.
    #[inline(always)]
    pub fn inverse_w(&self) -> F32<S> {
        self.barycentrics.inverse_w(self.simd, &self.cold())
    }

    /// Reversed depth: 1 at the near plane, 0 at the far plane or infinity.
    #[inline(always)]
    pub fn depth(&self) -> F32<S> {
        self.barycentrics.depth(self.simd, &self.cold())
    }

    /// Where the fragments lie in pixels of the target, x to the right, y down;
    /// the centre of the first pixel is (0.5, 0.5).
    #[inline(always)]
    pub fn position(&self) -> [F32<S>; 2] {
        let pixel = F32::splat(self.simd, 256.0 * self.context.supersampling as f32);
        [0, 1].each(
            #[inline(always)]
            |axis| {
                let position = self.point[axis] + self.context.area.origin[axis] * 256;
                position.to_float::<F32<S>>() / pixel
            },
        )
    }

    /// The index of the triangle, segment or point in its draw, for each lane.
    #[inline(always)]
    pub fn primitives(&self) -> [u32; LANES] {
        self.tags().each(
            #[inline(always)]
            |tag| tag.primitive,
        )
    }

    /// Whether the corners wind counter-clockwise on the screen; see
    /// [`Fragment::front_facing`].
    #[inline(always)]
    pub fn front_facing(&self) -> Mask<S> {
        let flags = self.tags().each(
            #[inline(always)]
            |tag| tag.flags,
        );
        (I32::simd_from(self.simd, flags) & flag::BACK).simd_eq(I32::splat(self.simd, 0))
    }

    /// Calls `visit` with each active lane as a separate fragment.
    #[inline(always)]
    pub(crate) fn for_each(&self, mut visit: impl FnMut(usize, RawFragment<'_>)) {
        let (mut rows, count) = (ComponentRows::new(), self.varyings[0].len());
        for index in 0..count {
            let [dx, dy] = self.gradient(index);
            rows.set(index, [self.varying(index), dx, dy]);
        }
        let [x, y]: [[f32; LANES]; 2] = self.position().each(Into::into);
        let cold = self.cold();
        let depth: [f32; LANES] = self.barycentrics.depth(self.simd, &cold).into();
        let inverse_w: [f32; LANES] = self.barycentrics.inverse_w(self.simd, &cold).into();
        let geometry = self.context.geometry();
        let supersampling = self.context.supersampling as f32;
        let distances: [[f32; LANES]; 3] = self.barycentrics.distances.each(Into::into);
        let tags = self.tags();
        for lane in (0..LANES).filter(|lane| self.active() >> lane & 1 != 0) {
            let Tag { primitive, flags } = tags[lane];
            let opposite = distances.map(|d| d[lane] / supersampling);
            let fragment = Fragment {
                varyings: (),
                ddx: (),
                ddy: (),
                pixel: UVec2::new(x[lane] as u32, y[lane] as u32),
                position: Vec2::new(x[lane], y[lane]),
                depth: depth[lane],
                inverse_w: inverse_w[lane],
                triangle: primitive,
                face: geometry.face(primitive),
                front_facing: flags & flag::BACK == 0,
                edge_distances: edge_distances(flags, opposite),
                edge_flags: geometry.edge_flags(primitive),
            };
            let [varyings, ddx, ddy] = rows.of(lane, count);
            visit(lane, RawFragment { fragment, varyings, ddx, ddy });
        }
    }
}

/// Distances to the edges, from those to the sides opposite the vertices.
#[inline(always)]
fn edge_distances(flags: i32, opposite: [f32; 3]) -> [f32; 3] {
    let mut distances = [f32::INFINITY; 3];
    if flags & flag::EDGES != 0 {
        for (vertex, distance) in opposite.into_iter().enumerate() {
            // Opposite to corner k lies the edge from k + 1 to k + 2.
            let corner = (flags >> (2 * vertex) & 3) as usize;
            distances[(corner + 1) % 3] = distance;
        }
    }
    distances
}

/// A fragment whose varyings are still rows of components.
#[doc(hidden)]
pub struct RawFragment<'r> {
    fragment: Fragment<()>,
    varyings: &'r [f32],
    ddx: &'r [f32],
    ddy: &'r [f32],
}

impl RawFragment<'_> {
    #[inline]
    pub(crate) fn typed<V: Varyings>(&self) -> Fragment<V> {
        let Fragment { pixel, position, depth, inverse_w, triangle, face, front_facing, .. } = self.fragment;
        Fragment {
            varyings: V::load(self.varyings),
            ddx: V::load(self.ddx),
            ddy: V::load(self.ddy),
            pixel,
            position,
            depth,
            inverse_w,
            triangle,
            face,
            front_facing,
            edge_distances: self.fragment.edge_distances,
            edge_flags: self.fragment.edge_flags,
        }
    }
}

/// Values and derivatives, turned from columns of lanes to rows of components.
struct ComponentRows([[[f32; MAX_VARYINGS]; LANES]; 3]);

impl ComponentRows {
    #[inline(always)]
    fn new() -> Self {
        Self([[[0.0; MAX_VARYINGS]; LANES]; 3])
    }

    #[inline(always)]
    fn set<S: Simd>(&mut self, index: usize, columns: [F32<S>; 3]) {
        for (rows, column) in self.0.iter_mut().zip(columns) {
            let column: [f32; LANES] = column.into();
            for (row, value) in rows.iter_mut().zip(column) {
                row[index] = value;
            }
        }
    }

    #[inline(always)]
    fn of(&self, lane: usize, components: usize) -> [&[f32]; 3] {
        self.0.each_ref().each(
            #[inline(always)]
            |rows| &rows[lane][..components],
        )
    }
}
