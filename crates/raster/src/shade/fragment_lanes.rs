//! What a pipeline knows when it shades eight pixels.

use super::weights::Weights;
use crate::geometry::Geometry;
use crate::simd::{Each, F32, I32, LANES, Simd, greater, lesser, prelude::*};
use crate::{Fragment, Varyings};
use trigon_math::{UVec2, Vec2};

/// A varying at the three corners of each lane's triangle.
#[derive(Clone, Copy)]
pub(crate) struct CornerValues {
    pub(crate) corners: [[f32; LANES]; 3],
    pub(crate) low: [f32; LANES],
    pub(crate) high: [f32; LANES],
}

impl CornerValues {
    pub(crate) const ZERO: Self = Self { corners: [[0.0; LANES]; 3], low: [0.0; LANES], high: [0.0; LANES] };

    /// The values with their range.
    #[inline(always)]
    pub(crate) fn new<S: Simd>(simd: S, corners: [[f32; LANES]; 3]) -> Self {
        let [a, b, c] = corners.each(
            #[inline(always)]
            |corner| F32::simd_from(simd, corner),
        );
        let low = lesser(lesser(a, b), c).into();
        let high = greater(greater(a, b), c).into();
        Self { corners, low, high }
    }
}

/// What the lanes' triangles are.
#[derive(Clone, Copy)]
pub(crate) struct LaneTriangles<'a> {
    pub(crate) geometry: &'a Geometry<'a>,
    pub(crate) primitives: [u32; LANES],
    /// The corners that the shares belong to.
    pub(crate) corners: [[i32; LANES]; 3],
    /// The lanes that show their back.
    pub(crate) backs: u64,
    /// Whether there are edges to measure a distance to.
    pub(crate) has_edges: bool,
}

/// Up to eight visible pixels, to be shaded together.
///
/// Every lane is a function of its own triangle and pixel alone. Lanes beyond
/// the count hold something, and what they give is ignored.
pub struct FragmentLanes<'a, S: Simd> {
    pub(crate) simd: S,
    pub(crate) count: usize,
    pub(crate) varyings: &'a [CornerValues],
    pub(crate) place: Weights<S>,
    /// In 1/256 internal pixel.
    pub(crate) x: I32<S>,
    pub(crate) y: I32<S>,
    /// Internal pixels for each output pixel and axis.
    pub(crate) supersampling: u32,
    pub(crate) triangles: &'a LaneTriangles<'a>,
}

impl<S: Simd> FragmentLanes<'_, S> {
    /// How many lanes there are, 1 to 8.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The varying `index`, perspective-correct, within the range of the
    /// vertices' values and exactly constant where those are equal.
    #[inline(always)]
    pub fn varying(&self, index: usize) -> F32<S> {
        let values = &self.varyings[index];
        let [a, b, c] = values.corners.each(
            #[inline(always)]
            |corner| F32::simd_from(self.simd, corner),
        );
        let [u, v, w] = self.place.weights;
        let value = a * u + b * v + c * w;
        let [low, high] = [values.low, values.high].each(
            #[inline(always)]
            |bound| F32::simd_from(self.simd, bound),
        );
        lesser(greater(value, low), high)
    }

    /// The varyings from `first` on, as many as the array asks for.
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
        let [a, b, c] = self.varyings[index].corners.each(
            #[inline(always)]
            |corner| F32::simd_from(self.simd, corner),
        );
        let [to_b, to_c] = [b - a, c - a];
        let [v, w] = self.place.slopes;
        [to_b * v[0] + to_c * w[0], to_b * v[1] + to_c * w[1]]
    }

    /// 1/w, interpolated; > 0.
    #[inline(always)]
    pub fn inverse_w(&self) -> F32<S> {
        self.place.inverse_w
    }

    /// Reversed depth: 1 at the near plane, 0 at the far plane or infinity.
    #[inline(always)]
    pub fn depth(&self) -> F32<S> {
        self.place.depth
    }

    /// Where the fragments lie in pixels of the target, x to the right, y down;
    /// the centre of the first pixel is (0.5, 0.5).
    #[inline(always)]
    pub fn position(&self) -> [F32<S>; 2] {
        let pixel = F32::splat(self.simd, 256.0 * self.supersampling as f32);
        [self.x, self.y].each(
            #[inline(always)]
            |place| place.to_float::<F32<S>>() / pixel,
        )
    }

    /// The index of the triangle, segment or point in its draw, for each lane.
    #[inline(always)]
    pub fn primitives(&self) -> [u32; LANES] {
        self.triangles.primitives
    }

    /// Calls `visit` with each lane as a fragment of its own.
    #[inline(always)]
    pub(crate) fn for_each(&self, mut visit: impl FnMut(usize, RawFragment<'_>)) {
        let mut rows = Rows::new();
        for index in 0..self.varyings.len() {
            let [dx, dy] = self.gradient(index);
            rows.set(index, [self.varying(index), dx, dy]);
        }
        let [x, y]: [[f32; LANES]; 2] = self.position().each(Into::into);
        let depth: [f32; LANES] = self.place.depth.into();
        let inverse_w: [f32; LANES] = self.place.inverse_w.into();
        let distances: [[f32; LANES]; 3] = self.place.distances.each(Into::into);
        for lane in 0..self.count {
            let LaneTriangles { geometry, primitives, backs, .. } = *self.triangles;
            let edge_distances =
                self.triangles.distances(lane, distances.map(|d| d[lane] / self.supersampling as f32));
            let fragment = Fragment {
                varyings: (),
                ddx: (),
                ddy: (),
                pixel: UVec2::new(x[lane] as u32, y[lane] as u32),
                position: Vec2::new(x[lane], y[lane]),
                depth: depth[lane],
                inverse_w: inverse_w[lane],
                triangle: primitives[lane],
                face: geometry.face(primitives[lane]),
                front_facing: backs >> lane & 1 == 0,
                edge_distances,
                edge_flags: geometry.edge_flags(primitives[lane]),
            };
            let [varyings, ddx, ddy] = rows.of(lane, self.varyings.len());
            visit(lane, RawFragment { fragment, varyings, ddx, ddy });
        }
    }
}

impl LaneTriangles<'_> {
    /// A lane's distances to the edges, from those to the sides opposite the
    /// shares' corners.
    #[inline(always)]
    fn distances(&self, lane: usize, opposite: [f32; 3]) -> [f32; 3] {
        let mut distances = [f32::INFINITY; 3];
        if self.has_edges {
            for (corner, distance) in self.corners.iter().zip(opposite) {
                // Opposite to corner k lies the edge from k + 1 to k + 2.
                distances[(corner[lane] as usize + 1) % 3] = distance;
            }
        }
        distances
    }
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

/// The most varyings that a pipeline may have.
pub const MAX_VARYINGS: usize = 64;

/// Values and derivatives, turned from columns of lanes to rows of components.
struct Rows([[[f32; MAX_VARYINGS]; LANES]; 3]);

impl Rows {
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
