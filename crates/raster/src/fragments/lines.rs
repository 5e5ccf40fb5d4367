//! The edges that are painted on eight triangles, computed for their records.

use super::context::ShadeContext;
use super::layout::{RecordShape, lined, outlined};
use super::perspective::perspective;
use super::sorted::SortedTriangles;
use crate::EdgeFlags;
use crate::bin::TriangleRef;
use crate::ink::{FaceLine, Ink, LineColumns, VisibleFaces};
use crate::primitive::Corners;
use crate::simd::{
    F32, I32, InlineMap, LANES, Mask, Row, Simd, greater, inlined, lesser, prelude::*, transpose,
};

/// The radius in pixels of faces whose exact size does not matter.
const HUGE: f32 = 1e9;

/// The least radius and the shortest perimeter in pixels: nothing is divided by 0.
const LEAST: f32 = 1e-6;

/// What is painted on eight triangles, and what others have to know of it.
pub(crate) struct FaceLines {
    /// Those of [`lined`], and two that only fill up the eight that are transposed.
    columns: [Row; LANES],
    /// Those of outlined edges, if there are any.
    outlined: Option<[Row; outlined::COUNT]>,
    half: [f32; LANES],
    beyond: [f32; LANES],
    radius: [f32; LANES],
    /// Whether the draw has any.
    shows_edges: bool,
}

impl FaceLines {
    #[inline(always)]
    pub(crate) fn new<S: Simd>(
        simd: S,
        context: &ShadeContext<'_>,
        ink: &Ink,
        sorted: &SortedTriangles<S>,
        triangles: [TriangleRef; LANES],
        primitives: [u32; LANES],
    ) -> Self {
        let geometry = context.geometry();
        let shows_edges = geometry.shows_edges();
        let flags = primitives.each(
            #[inline(always)]
            |primitive| if shows_edges { geometry.edge_flags(primitive) } else { EdgeFlags::NONE },
        );
        let is_edge = edges_of(simd, sorted, flags);
        let lengths = lengths_of(sorted);
        let mut radius = radius_of(simd, sorted, lengths, is_edge, flags);
        let is_cut = triangles.each(|triangle| corners_of(context, triangle).is_some());
        if is_cut.contains(&true) {
            let cut = Mask::from_bitmask(simd, bits(is_cut));
            radius = cut.select(F32::splat(simd, HUGE), radius);
        }
        let line = LineColumns::new(simd, ink, radius);
        let inverse = inverses(simd, sorted, lengths);
        let columns = Self::columns(simd, inverse, is_edge, &line);
        let outlined = ink.has_outlines().then(|| {
            line.outlined(simd, ink, radius).each(
                #[inline(always)]
                |column| column.bitcast::<I32<S>>().into(),
            )
        });
        let mut lines = Self {
            columns,
            outlined,
            half: line.half.into(),
            beyond: line.beyond.into(),
            radius: radius.into(),
            shows_edges,
        };
        for lane in (0..LANES).filter(|&lane| is_cut[lane]) {
            lines.cut(context, sorted, triangles[lane], flags[lane], lane);
        }
        lines
    }

    #[inline(always)]
    fn columns<S: Simd>(
        simd: S,
        inverse: [F32<S>; 3],
        is_edge: [Mask<S>; 3],
        line: &LineColumns<S>,
    ) -> [Row; LANES] {
        let LineColumns { half, weight, floor, .. } = *line;
        let [a, b, c] = [0, 1, 2].each(
            #[inline(always)]
            |corner| is_edge[corner].select(inverse[corner] * weight, F32::splat(simd, -1.0)),
        );
        let most = lesser(half * 2.0, F32::splat(simd, 1.0)) * weight;
        [a, b, c, (half + 0.5) * weight, most, floor, floor, floor].each(
            #[inline(always)]
            |column| column.bitcast::<I32<S>>().into(),
        )
    }

    /// Corrects the lane of a triangle that was cut: the edges are those of the whole one,
    /// and corners' raw weights are sums over its vertices.
    #[cold]
    fn cut<S: Simd>(
        &mut self,
        context: &ShadeContext<'_>,
        sorted: &SortedTriangles<S>,
        triangle: TriangleRef,
        flags: EdgeFlags,
        lane: usize,
    ) {
        let Some((weights, order)) = corners_of(context, triangle) else { return };
        let weights = context.draw.chunk_of(triangle).weights[weights as usize];
        let [x, y]: [[Row; 3]; 2] = [sorted.x, sorted.y].map(|axis| axis.map(Into::into));
        let q: [[f32; LANES]; 3] = sorted.inverse_w[0].token().vectorize(
            #[inline(always)]
            || {
                perspective(sorted.inverse_w[0].token(), sorted.inverse_w).0.each(
                    #[inline(always)]
                    |q| q.into(),
                )
            },
        );
        let way = |from: usize, to: usize| {
            [f64::from(y[to][lane] - y[from][lane]), f64::from(x[from][lane] - x[to][lane])]
        };
        // Opposite each vertex; their signs do not matter, as they are all the same.
        let steps = [way(1, 2), way(2, 0), way(0, 1)];
        for column in 0..3 {
            let slope = |axis: usize| {
                (0..3).map(|i| f64::from(weights[i][column]) * f64::from(q[i][lane]) * steps[i][axis]).sum()
            };
            let (right, down): (f64, f64) = (slope(0), slope(1));
            let slope = (right * right + down * down).sqrt() * 256.0;
            let is_edge = flags.contains((usize::from(order[column]) + 1) % 3) && slope > 0.0;
            let inverse = if is_edge { (1.0 / slope) as f32 } else { -1.0 };
            self.columns[lined::INVERSE + column][lane] = inverse.to_bits().cast_signed();
        }
    }

    /// Writes the columns to the records of the first `count` triangles.
    #[inline(always)]
    pub(crate) fn store<S: Simd>(&self, simd: S, rows: &mut [Row], shape: RecordShape, count: usize) {
        let Some(first) = shape.lines else { return };
        let mut turned = [[0; LANES]; LANES];
        transpose(simd, self.columns.each_ref(), &mut turned);
        for (record, turned) in rows.chunks_exact_mut(shape.rows()).zip(&turned[..count]) {
            let values = record.as_flattened_mut()[first..].first_chunk_mut().expect("there is room");
            let made: &[i32; lined::COUNT] = turned.first_chunk().expect("there are as many");
            *values = *made;
        }
        if let (Some(first), Some(columns)) = (shape.outlined, &self.outlined) {
            for (lane, record) in rows.chunks_exact_mut(shape.rows()).take(count).enumerate() {
                let values = &mut record.as_flattened_mut()[first..first + outlined::COUNT];
                values.iter_mut().zip(columns).for_each(|(value, column)| *value = column[lane]);
            }
        }
    }

    /// Notes what the search for outer halves of lines needs of the visible triangles.
    #[inline(always)]
    pub(crate) fn note<S: Simd>(
        &self,
        simd: S,
        sorted: &SortedTriangles<S>,
        visible: &[u32],
        outer: &mut VisibleFaces,
    ) {
        let [a, b, c] = sorted.depth;
        let greatest = greater(greater(a, b), c);
        let none = F32::splat(simd, f32::NEG_INFINITY);
        if self.shows_edges {
            let is_painted = F32::simd_from(simd, self.beyond).simd_gt(0.0);
            let least = is_painted.select(lesser(lesser(a, b), c), none);
            outer.note_eight(simd, visible, [least, greatest], [self.half, self.beyond, self.radius]);
        } else {
            let FaceLine { half, weight, radius } = FaceLine::UNLINED;
            outer.note_eight(
                simd,
                visible,
                [none, greatest],
                [[half; LANES], [weight; LANES], [radius; LANES]],
            );
        }
    }
}

/// Where the edges opposite the sorted vertices are edges of the face.
#[inline(always)]
fn edges_of<S: Simd>(simd: S, sorted: &SortedTriangles<S>, flags: [EdgeFlags; LANES]) -> [Mask<S>; 3] {
    let opposite = I32::simd_from(
        simd,
        flags.each(
            #[inline(always)]
            |flags| flags.opposite_corners(),
        ),
    );
    sorted.corners.each(
        #[inline(always)]
        |corner| {
            let corner = I32::simd_from(simd, corner);
            // 1, 2, 4 of 0, 1, 2.
            let bit = corner + (corner >> 1) + 1;
            !(opposite & bit).simd_eq(I32::splat(simd, 0))
        },
    )
}

/// The lengths in pixels of the sides opposite the sorted vertices.
#[inline(always)]
fn lengths_of<S: Simd>(sorted: &SortedTriangles<S>) -> [F32<S>; 3] {
    let length = inlined(
        #[inline(always)]
        |(from, to): (usize, usize)| {
            let [x, y] = [sorted.x, sorted.y].each(
                #[inline(always)]
                |axis| (axis[to] - axis[from]).to_float::<F32<S>>() * (1.0 / 256.0),
            );
            (x * x + y * y).sqrt()
        },
    );
    [length((1, 2)), length((2, 0)), length((0, 1))]
}

/// The inner radii in pixels of the faces that triangles belong to.
#[inline(always)]
fn radius_of<S: Simd>(
    simd: S,
    sorted: &SortedTriangles<S>,
    lengths: [F32<S>; 3],
    is_edge: [Mask<S>; 3],
    flags: [EdgeFlags; LANES],
) -> F32<S> {
    let zero = F32::splat(simd, 0.0);
    let [a, b, c] = [0, 1, 2].each(
        #[inline(always)]
        |side| is_edge[side].select(lengths[side], zero),
    );
    // In the middle of a face there are no edges.
    let has_edges = is_edge[0] | is_edge[1] | is_edge[2];
    let perimeter = has_edges.select(a + b + c, lengths[0] + lengths[1] + lengths[2]);
    let least = F32::splat(simd, LEAST);
    let [ux, uy, vx, vy] = [(sorted.x, 1), (sorted.y, 1), (sorted.x, 2), (sorted.y, 2)].each(
        #[inline(always)]
        |(axis, to)| (axis[to] - axis[0]).to_float::<F32<S>>() * (1.0 / 256.0),
    );
    let ratio = F32::simd_from(
        simd,
        flags.each(
            #[inline(always)]
            |flags| flags.radius_ratio(),
        ),
    );
    let doubled_area = (ux * vy - uy * vx).abs();
    lesser(greater(doubled_area / greater(perimeter, least) * ratio, least), F32::splat(simd, HUGE))
}

/// The factors that turn raw weights of corners into distances in pixels.
#[inline(always)]
fn inverses<S: Simd>(simd: S, sorted: &SortedTriangles<S>, lengths: [F32<S>; 3]) -> [F32<S>; 3] {
    let (q, _) = perspective(simd, sorted.inverse_w);
    [0, 1, 2].each(
        #[inline(always)]
        // Edge functions are in 1/256 pixel on both axes.
        |corner| 1.0 / (q[corner] * lengths[corner] * 65536.0),
    )
}

/// The index of the weights of a triangle that was cut, and the corners of their columns.
#[inline(always)]
fn corners_of(context: &ShadeContext<'_>, triangle: TriangleRef) -> Option<(u32, [u8; 3])> {
    // Most are whole, and to find the chunk of one takes a search.
    if triangle.is_whole() {
        return None;
    }
    match context.draw.chunk_of(triangle).made(triangle)?.corners {
        Corners::Cut { weights, order } => Some((weights, order)),
        Corners::Whole(_) | Corners::Ends(_) => None,
    }
}

/// A bit for each lane.
fn bits(lanes: [bool; LANES]) -> u64 {
    (0..LANES).fold(0, |bits, lane| bits | u64::from(lanes[lane]) << lane)
}
