//! Lines and points: against their definition, asked at every sample, and against masked ones,
//! which go the way of triangles.

use super::{Rasterizer, SIZE, settings};
use crate::clip::{self, Outcode};
use crate::primitive::{DepthPlane, SetupTriangle};
use crate::tile_buffer::BEHIND_ALL;
use crate::vertex::{ScreenVertex, nearer};
use crate::viewport::{SamplePattern, Viewport};
use crate::{
    BlendMode, ExecuteSettings, FixedBitSet, Fragment, Lines, MarkedPoints, Output, Pass, Pipeline,
    PointShape, Points, Smoothing, Target, TargetImages, VertexOutput,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Fixed, FixedPoint, Vec4, clip_segment};

/// What a draw consists of, with a width or size in pixels.
#[derive(Clone, Copy, Debug)]
enum Mark {
    Line(f32),
    Point(f32, PointShape),
}

/// One draw: a vertex or two for each primitive.
#[derive(Clone, Debug)]
struct Marks {
    mark: Mark,
    object: u32,
    depth_bias: f32,
    ids: Option<Vec<u32>>,
    positions: Vec<Vec4>,
    /// For each vertex.
    lights: Vec<f32>,
}

impl Pipeline for Marks {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        VertexOutput { position: self.positions[index], varyings: self.lights[index] }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(fragment.varyings, fragment.depth, fragment.inverse_w, 1.0)
    }
}

impl Marks {
    fn corners(&self) -> usize {
        if matches!(self.mark, Mark::Line(_)) { 2 } else { 1 }
    }

    /// Each primitive in a light of its own, a whole number.
    fn with_whole_lights(mut self, first: usize) -> Self {
        for (vertex, light) in self.lights.iter_mut().enumerate() {
            *light = (first + vertex / if matches!(self.mark, Mark::Line(_)) { 2 } else { 1 }) as f32;
        }
        self
    }
}

/// How an image is sampled.
#[derive(Clone, Copy, Debug)]
struct Sampling {
    samples: u32,
    per_axis: u32,
}

fn draw(
    draws: &[Marks],
    blend_mode: BlendMode,
    settings: ExecuteSettings,
    sampling: Sampling,
) -> TargetImages {
    let draws: Vec<_> = draws.iter().map(|draw| (draw, blend_mode)).collect();
    draw_on(&draws, settings, sampling)
}

/// Each with a surface of its own.
fn draw_on(draws: &[(&Marks, BlendMode)], settings: ExecuteSettings, sampling: Sampling) -> TargetImages {
    let segments: Vec<Vec<[u32; 2]>> = draws
        .iter()
        .map(|(draw, _)| (0..draw.positions.len() as u32 / 2).map(|i| [2 * i, 2 * i + 1]).collect())
        .collect();
    let points: Vec<Vec<u32>> =
        draws.iter().map(|(draw, _)| (0..draw.positions.len() as u32).collect()).collect();
    let mut pass = Pass::new();
    for ((&(draw, blend_mode), segments), points) in draws.iter().zip(&segments).zip(&points) {
        let (ids, object, depth_bias) = (draw.ids.as_deref(), draw.object, draw.depth_bias);
        match draw.mark {
            Mark::Line(width) => {
                let lines = Lines { ids, object, depth_bias, blend_mode, ..Lines::new(draw, segments) };
                pass.lines(Lines { width, ..lines });
            }
            Mark::Point(size, shape) => {
                let points =
                    Points { ids, object, depth_bias, blend_mode, ..Points::new(draw, points, size) };
                pass.points(Points { shape, ..points });
            }
        }
    }
    let [width, height] = SIZE.map(|side| side as u32);
    let outputs = [Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
    let target = Target::new(width, height, &outputs).unwrap();
    let target = target.with_samples(sampling.samples).unwrap();
    let mut target = target.with_samples_per_axis(sampling.per_axis).unwrap();
    Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
    target.into_images()
}

/// A triangle of a line or a point by its definition.
struct Known {
    points: [[i64; 2]; 3],
    disc: Option<[i64; 3]>,
    plane: DepthPlane,
    key: [u32; 4],
    light: f32,
}

impl Known {
    /// By the top-left rule, in whole numbers.
    fn covers(&self, [x, y]: [i64; 2]) -> bool {
        let cross = |[a, b]: [[i64; 2]; 2], [x, y]: [i64; 2]| {
            i128::from(b[0] - a[0]) * i128::from(y - a[1]) - i128::from(b[1] - a[1]) * i128::from(x - a[0])
        };
        let [a, mut b, mut c] = self.points;
        if cross([a, b], c) < 0 {
            std::mem::swap(&mut b, &mut c);
        }
        let inside = [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
            let value = cross([from, to], [x, y]);
            let is_left_or_top = to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]);
            value > 0 || (value == 0 && is_left_or_top)
        });
        let within = |[column, row, diameter]: [i64; 3]| {
            let [dx, dy] = [2 * (x - column), 2 * (y - row)];
            dx * dx + dy * dy < diameter * diameter
        };
        inside && self.disc.is_none_or(within)
    }
}

/// The triangles of a draw, at a resolution and with some samples.
fn known(marks: &Marks, draw: u32, sampling: Sampling) -> Vec<Known> {
    let side = |axis: usize| SIZE[axis] as u32 * sampling.per_axis;
    let viewport = Viewport { width: side(0), height: side(1) };
    let mut found = Vec::new();
    for (primitive, positions) in marks.positions.chunks_exact(marks.corners()).enumerate() {
        let id = marks.ids.as_ref().and_then(|ids| ids.get(primitive)).copied();
        let key = [marks.object, id.unwrap_or(primitive as u32), primitive as u32, draw];
        let light = marks.lights[primitive * marks.corners()];
        let mut push = |vertices: [ScreenVertex; 3], disc| {
            let points = vertices.map(|vertex| vertex.raw().map(i64::from));
            let plane = DepthPlane::of(&SetupTriangle::whole(vertices, 0));
            found.push(Known { points, disc, plane, key, light });
        };
        let outcodes: Vec<_> =
            positions.iter().map(|&position| Outcode::new(position, viewport.guard())).collect();
        if outcodes.iter().any(|outcode| outcode.is_invalid()) {
            continue;
        }
        let near = |vertex: ScreenVertex| vertex.with_depth(nearer(vertex.depth(), marks.depth_bias));
        let grid = |[x, y]: [f64; 2]| {
            let fixed = |raw: f64| Fixed::from_f64(raw / 256.0);
            Some(FixedPoint::new(fixed(x)?, fixed(y)?))
        };
        match marks.mark {
            Mark::Line(width) => {
                if outcodes[0].intersection(outcodes[1]).hides_wide() {
                    continue;
                }
                let ends = [positions[0], positions[1]];
                let ends = match outcodes.iter().any(|outcode| outcode.cuts()) {
                    true => {
                        clip_segment(ends, &clip::volume(viewport)).map(|ends| ends.map(|end| end.position))
                    }
                    false => Some(ends),
                };
                let ends = ends.map(|ends| ends.map(|end| ScreenVertex::of(end, viewport).map(near)));
                let Some([Some(a), Some(b)]) = ends else { continue };
                let corners = corners_of([a, b], width, sampling).map(|end| end.map(grid));
                let [[Some(p), Some(q)], [Some(r), Some(s)]] = corners else { continue };
                let [a, b] = in_rows([a, b]);
                push([a.at(p), a.at(q), b.at(s)], None);
                push([a.at(p), b.at(s), b.at(r)], None);
            }
            Mark::Point(size, shape) => {
                if outcodes[0].cuts() {
                    continue;
                }
                let center = near(ScreenVertex::of(positions[0], viewport).unwrap());
                let half =
                    (f64::from(size.clamp(1.0, 4096.0)) * f64::from(sampling.per_axis) * 128.0).round();
                let [x, y] = center.raw().map(f64::from);
                let corner = |i: f64, j: f64| center.at(grid([x + i * half, y + j * half]).unwrap());
                let disc = [x as i64, y as i64, 2 * half as i64];
                let disc = (shape == PointShape::Round).then_some(disc);
                push([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0)], disc);
                push([corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], disc);
            }
        }
    }
    found
}

/// The upper end first; of two in a row the left one.
fn in_rows(ends: [ScreenVertex; 2]) -> [ScreenVertex; 2] {
    let key = |end: ScreenVertex| (end.raw()[1], end.raw()[0]);
    if key(ends[1]) < key(ends[0]) { [ends[1], ends[0]] } else { ends }
}

/// For each end the corners across it: the parallelogram that the width spans across the minor
/// direction, prolonged by half the width.
fn corners_of(ends: [ScreenVertex; 2], width: f32, sampling: Sampling) -> [[[f64; 2]; 2]; 2] {
    let [from, to] = in_rows(ends).map(|end| end.raw().map(f64::from));
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let half = f64::from(width.clamp(1.0, 4096.0)) * f64::from(sampling.per_axis) * 128.0;
    let is_single = width <= 1.0 && sampling.per_axis == 1 && sampling.samples == 1;
    let is_dot = dx == 0.0 && dy == 0.0;
    let x_major = dx.abs() >= dy.abs();
    let [major, minor] = if x_major { [dx, dy] } else { [dy, dx] };
    let across = if is_single || is_dot { half } else { half * (dx * dx + dy * dy).sqrt() / major.abs() };
    let slope = if is_dot { 0.0 } else { minor / major };
    let along = if major < 0.0 { -half } else { half };
    let corner = |end: [f64; 2], along: f64, across: f64| match x_major {
        true => [end[0] + along, end[1] + along * slope + across],
        false => [end[0] + along * slope + across, end[1] + along],
    };
    [
        [corner(from, -along, -across), corner(from, -along, across)],
        [corner(to, along, -across), corner(to, along, across)],
    ]
}

/// Holds every pixel against the definition.
fn check(draws: &[Marks], settings: ExecuteSettings, sampling: Sampling) {
    let mut first = 1;
    let draws: Vec<_> = draws
        .iter()
        .map(|marks| {
            let marks = marks.clone().with_whole_lights(first);
            first += marks.positions.len();
            marks
        })
        .collect();
    let images = draw(&draws, BlendMode::Opaque, settings, sampling);
    let known: Vec<_> =
        draws.iter().zip(0..).flat_map(|(marks, draw)| known(marks, draw, sampling)).collect();
    let search = |point: [i32; 2]| {
        let covering = known.iter().filter(|known| known.covers(point.map(i64::from)));
        covering.fold((BEHIND_ALL, None::<&Known>), |(depth, seen), known| {
            let here = known.plane.at(point);
            let wins = here > depth || (here == depth && seen.is_some_and(|seen| known.key < seen.key));
            if wins { (here, Some(known)) } else { (depth, seen) }
        })
    };
    let offsets = SamplePattern::of(sampling.samples).unwrap().offsets();
    let axis = sampling.per_axis as i32;
    for index in 0..(SIZE[0] * SIZE[1]) as usize {
        let pixel = [index as i32 % SIZE[0], index as i32 / SIZE[0]];
        let mut light = 0.0;
        for cell in (0..axis * axis).map(|i| [pixel[0] * axis + i % axis, pixel[1] * axis + i / axis]) {
            for offset in offsets {
                let (_, seen) = search([0, 1].map(|i| cell[i] * 256 + offset[i]));
                light += seen.map_or(0.0, |known| known.light);
            }
        }
        let count = (axis * axis) as f32 * offsets.len() as f32;
        assert_eq!(images.linear.as_ref().unwrap()[index].x, light / count, "the light of {pixel:?}");
        let middle = [0, 1].map(|i| (pixel[i] * axis + axis / 2) * 256 + offsets[0][i]);
        let (depth, seen) = search(middle);
        assert_eq!(
            images.depth.as_ref().unwrap()[index],
            seen.map_or(0.0, |_| depth),
            "the depth of {pixel:?}"
        );
        let face = seen.map_or(u32::MAX, |known| known.key[1]);
        assert_eq!(images.faces.as_ref().unwrap()[index], face, "the id of {pixel:?}");
    }
}

/// In the image, beside it, on samples, far away and behind the eye.
fn position() -> impl Strategy<Value = Vec4> {
    let near = (0..2_usize).prop_flat_map(|steps| {
        let steps = [1, 128][steps];
        let axis = |axis: usize| (-1500..SIZE[axis] * 256 + 1500).prop_map(move |v| v / steps * steps);
        [axis(0).boxed(), axis(1).boxed()]
    });
    let far = [-9_000_000..9_000_000_i32, -9_000_000..9_000_000_i32];
    let coordinates = prop_oneof![6 => near, 1 => far];
    let depth =
        prop_oneof![2 => (0..=4_u8).prop_map(|quarters| f32::from(quarters) / 4.0), 1 => -0.1_f32..1.2];
    let w = prop_oneof![4 => Just(1.0), 2 => 0.1_f32..4.0, 1 => -1.0_f32..1.0];
    (coordinates, depth, w).prop_map(|([x, y], depth, w)| {
        let [x, y] =
            [(x, SIZE[0]), (y, SIZE[1])].map(|(v, side)| (f64::from(v) / f64::from(128 * side) - 1.0) as f32);
        Vec4::new(x * w, -y * w, depth * w, w)
    })
}

fn marks() -> impl Strategy<Value = Marks> {
    let size = || prop_oneof![2 => Just(1.0_f32), 2 => 1.0_f32..6.0, 1 => 0.2_f32..100.0];
    let shape = prop_oneof![Just(PointShape::Round), Just(PointShape::Square)];
    let mark = prop_oneof![3 => size().prop_map(Mark::Line), 1 => (size(), shape).prop_map(|(s, f)| Mark::Point(s, f))];
    let depth_bias = prop_oneof![Just(0.0), Just(0.001), Just(0.5)];
    let ids = prop::option::of(prop::collection::vec(0..4_u32, 0..8));
    let vertices = prop::collection::vec((position(), 0.0_f32..1.0), 2..14);
    (mark, 0..3_u32, depth_bias, ids, vertices).prop_map(|(mark, object, depth_bias, ids, vertices)| {
        let (positions, lights) = vertices[..vertices.len() / 2 * 2].iter().copied().unzip();
        Marks { mark, object, depth_bias, ids, positions, lights }
    })
}

fn sampling(most_per_axis: u32) -> impl Strategy<Value = Sampling> {
    let samples = prop_oneof![3 => Just(1_u32), 1 => Just(2), 2 => Just(4), 1 => Just(16)];
    (samples, 1..=most_per_axis).prop_map(|(samples, per_axis)| Sampling { samples, per_axis })
}

fn draws() -> impl Strategy<Value = Vec<Marks>> {
    prop::collection::vec(marks(), 1..4)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 8, ..ProptestConfig::default() })]

    #[test]
    fn every_sample_shows_the_line_or_point_that_it_should(
        draws in draws(),
        settings in settings(),
        sampling in sampling(2),
    ) {
        check(&draws, settings, sampling);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 6, ..ProptestConfig::default() })]

    /// Depths, ids and interpolated colours, each from the triangle that covers the sample.
    #[test]
    fn opaque_lines_and_points_are_as_those_that_a_mask_leaves_whole(
        draws in draws(),
        settings in settings(),
        threads in 1..4_usize,
        sampling in sampling(3),
    ) {
        let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..settings };
        let [opaque, masked] =
            [BlendMode::Opaque, BlendMode::MaskedPerSample].map(|blend_mode| draw(&draws, blend_mode, settings, sampling));
        // A pixel is shaded once in each triangle either way.
        prop_assert!(opaque == masked, "{:?}", settings);
        let reference = draw(&draws, BlendMode::Opaque, ExecuteSettings::default(), sampling);
        prop_assert!(opaque == reference, "{:?}", settings);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 4, ..ProptestConfig::default() })]

    /// Whatever lies below: colours are those of opaque draws, depth and ids those of an
    /// image without the overlay.
    #[test]
    fn an_overlay_hides_as_opaque_draws_do_and_writes_no_depth_and_no_ids(
        mut draws in draws(),
        settings in settings(),
        threads in 1..4_usize,
        sampling in sampling(3),
        below in prop::sample::select(vec![BlendMode::Opaque, BlendMode::Masked, BlendMode::MaskedPerSample]),
    ) {
        let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..settings };
        // Keys that do not depend on the order of draws.
        (0..).zip(&mut draws).for_each(|(object, draw)| draw.object = object);
        let on = |over: BlendMode| {
            let blend_mode = move |draw: &Marks| if draw.object % 2 == 1 { over } else { below };
            draws.iter().map(|draw| (draw, blend_mode(draw))).collect::<Vec<_>>()
        };
        let [overlay, opaque] =
            [BlendMode::Overlay, BlendMode::MaskedPerSample].map(|over| draw_on(&on(over), settings, sampling));
        prop_assert!(overlay.linear == opaque.linear, "{:?}", settings);
        let bare: Vec<_> = on(below).into_iter().step_by(2).collect();
        let bare = draw_on(&bare, settings, sampling);
        prop_assert!(
            (&overlay.depth, &overlay.objects, &overlay.faces, &overlay.triangles)
                == (&bare.depth, &bare.objects, &bare.faces, &bare.triangles),
            "{:?}", settings
        );
    }
}

/// A draw with marked points is as two draws, one of each size.
#[test]
fn marked_points_have_a_size_of_their_own() {
    let positions: Vec<_> =
        (0..40).map(|i| Vec4::new(0.05 * i as f32 - 1.0, 0.04 * (i % 7) as f32 - 0.1, 0.5, 1.0)).collect();
    let lights = (0..40).map(|i| i as f32).collect();
    let mark = Mark::Point(3.0, PointShape::Round);
    let marks = Marks { mark, object: 0, depth_bias: 0.0, ids: None, positions, lights };
    // Shorter than the draw: points beyond it are not marked.
    let set: FixedBitSet = (0..30).filter(|i| i % 3 == 0).collect();
    let all: Vec<u32> = (0..40).collect();
    let (marked, usual): (Vec<u32>, Vec<u32>) = all.iter().partition(|&&i| set.contains(i as usize));
    for smoothing in [Smoothing::Sharp, Smoothing::AntiAliased] {
        let image = |draws: &[Points<'_, Marks>]| {
            let [width, height] = SIZE.map(|side| side as u32);
            let mut target = Target::new(width, height, &[Output::Linear, Output::Depth]).unwrap();
            let mut pass = Pass::new();
            for &Points { points, ids, size, marked, .. } in draws {
                pass.points(Points { ids, marked, smoothing, ..Points::new(&marks, points, size) });
            }
            Rasterizer::default().draw(&pass, &mut target);
            target.into_images()
        };
        let together =
            Points { marked: Some(MarkedPoints { set: &set, size: 7.0 }), ..Points::new(&marks, &all, 3.0) };
        let apart = [
            Points { ids: Some(&usual), ..Points::new(&marks, &usual, 3.0) },
            Points { ids: Some(&marked), ..Points::new(&marks, &marked, 7.0) },
        ];
        assert!(image(&[together]) == image(&apart), "{smoothing:?}");
        assert!(image(&apart) != image(&[Points::new(&marks, &all, 3.0)]), "the mark is seen");
    }
}
