//! Images that follow from the last one, beside those of another rasterizer that draws
//! everything.

use crate::simd::SimdLevel;
use crate::{
    Background, BlendMode, Cancel, Culling, Draw, DrawChange, EdgeFlags, ExecuteSettings, FaceEdges,
    Fragment, Lines, MarkColors, MarkedPoints, Marks, Output, Pass, Pipeline, Points, Rasterizer, Smoothing,
    Stats, Target, TileSize, VertexOutput,
};
use fixedbitset::FixedBitSet;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Vec3, Vec4};

/// A surface of quads and a line beside it, whose vertices have colours.
#[derive(Clone, Debug)]
struct Model {
    vertices: Vec<(Vec4, Vec4)>,
    triangles: Vec<[u32; 3]>,
    faces: Vec<u32>,
    flags: Vec<EdgeFlags>,
    /// The numbers of the edges that the triangles' sides are.
    sides: Vec<[u32; 3]>,
    edge_marks: Vec<u8>,
    face_marks: Vec<u8>,
    /// Its points that are larger.
    large: FixedBitSet,
    blend_mode: BlendMode,
}

impl Pipeline for Model {
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        let (position, varyings) = self.vertices[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let color = fragment.varyings;
        (color.truncate() * color.w).extend(color.w)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        fragment.varyings.x < 0.7
    }
}

/// The vertices of a model with one colour for each primitive: its points are drawn from them.
impl Pipeline for Vec<(Vec4, Vec4)> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self[index].0, varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        Vec4::new(0.01 * fragment.triangle as f32, 0.5, 0.2, 1.0)
    }
}

const QUADS: u32 = 9;

/// One for each vertex of a sheet.
const ALL_POINTS: [u32; ((QUADS + 1) * (QUADS + 1)) as usize] = {
    let mut points = [0; ((QUADS + 1) * (QUADS + 1)) as usize];
    let mut index = 0;
    while index < points.len() {
        points[index] = index as u32;
        index += 1;
    }
    points
};

impl Model {
    /// A wavy sheet in front of the camera, `shift` deep.
    fn sheet(blend_mode: BlendMode, shift: f32) -> Self {
        let side = QUADS + 1;
        let vertex = |index: u32| {
            let [x, y] = [index % side, index / side].map(|v| v as f32 / QUADS as f32);
            let w = 1.0 + 0.5 * x + shift;
            let position = Vec4::new((2.2 * x - 1.1) * w, (2.2 * y - 1.1) * w, 0.3, w);
            (position, Vec4::new(x, y, 0.5, 0.6))
        };
        let quads = (0..QUADS * QUADS).map(|quad| quad / QUADS * side + quad % QUADS);
        let halves = |at: u32| [[at, at + 1, at + side + 1], [at, at + side + 1, at + side]];
        let flags = [[true, true, false], [false, true, true]].map(EdgeFlags::new);
        let triangles: Vec<_> = quads.flat_map(halves).collect();
        // One edge to the right and one downwards from each vertex.
        let edge = |from: u32, to: u32| match from.abs_diff(to) {
            1 => from.min(to),
            across if across == side => side * side + from.min(to),
            _ => u32::MAX,
        };
        Self {
            vertices: (0..side * side).map(vertex).collect(),
            sides: triangles.iter().map(|&[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)]).collect(),
            edge_marks: (0..2 * side * side).map(|edge| (edge % 3) as u8).collect(),
            face_marks: (0..QUADS * QUADS).map(|face| (face % 5 / 3) as u8).collect(),
            large: FixedBitSet::with_capacity(4),
            triangles,
            faces: (0..2 * QUADS * QUADS).map(|triangle| triangle / 2).collect(),
            flags: (0..QUADS * QUADS).flat_map(|_| flags).collect(),
            blend_mode,
        }
    }

    fn record<'a>(&'a self, object: u32, pass: &mut Pass<'a>) {
        pass.triangles(Draw {
            faces: Some(&self.faces),
            edge_flags: Some(&self.flags),
            marks: Some(Marks { sides: &self.sides, edges: &self.edge_marks, faces: &self.face_marks }),
            object,
            culling: Culling::None,
            blend_mode: self.blend_mode,
            ..Draw::new(self, &self.triangles)
        });
    }
}

/// What becomes of a model.
#[derive(Clone, Debug)]
struct Delta {
    model: usize,
    /// Vertices with how far they move in clip space.
    moved: Vec<(u32, [f32; 4])>,
    /// Vertices with other colours.
    painted: Vec<(u32, Vec4)>,
    /// Triangles whose corners are turned on, and whose flags are others.
    turned: Vec<u32>,
    /// Edges and faces with other marks.
    marked: [Vec<(u32, u8)>; 2],
    /// Points with another size.
    resized: Vec<u32>,
}

/// The changes of a model that are passed to `redraw`.
struct Told {
    vertices: Vec<u32>,
    reshaped: Vec<u32>,
    recolored: Vec<u32>,
    resized: Vec<u32>,
}

impl Delta {
    /// Changes the model; returns what is passed to `redraw`.
    fn apply(&self, model: &mut Model) -> Told {
        self.apply_part(model, self.moved.len())
    }

    /// The same, of which only the first vertices move, `count` of them.
    fn apply_part(&self, model: &mut Model, count: usize) -> Told {
        let moved = &self.moved[..count];
        for &(vertex, way) in moved {
            model.vertices[vertex as usize].0 += Vec4::from_array(way);
        }
        for &(vertex, color) in &self.painted {
            model.vertices[vertex as usize].1 = color;
        }
        let mut turned = self.turned.clone();
        turned.sort_unstable();
        turned.dedup();
        for &triangle in &turned {
            model.triangles[triangle as usize].rotate_left(1);
            model.sides[triangle as usize].rotate_left(1);
            model.flags[triangle as usize] = EdgeFlags::new([triangle % 2 == 0, true, triangle % 3 == 0]);
        }
        let painted = self.painted.iter().map(|&(vertex, _)| vertex);
        let vertices = moved.iter().map(|&(vertex, _)| vertex).chain(painted).collect();
        let mut resized = self.resized.clone();
        resized.sort_unstable();
        resized.dedup();
        resized.iter().for_each(|&point| model.large.toggle(point as usize));
        Told { vertices, reshaped: turned, recolored: self.mark(model), resized }
    }

    /// Changes marks; the triangles that have them.
    fn mark(&self, model: &mut Model) -> Vec<u32> {
        let [edges, faces] = &self.marked;
        edges.iter().for_each(|&(edge, mark)| model.edge_marks[edge as usize] = mark);
        faces.iter().for_each(|&(face, mark)| model.face_marks[face as usize] = mark);
        let has_marked = |&triangle: &u32| {
            let (sides, own) = (model.sides[triangle as usize], model.faces[triangle as usize]);
            edges.iter().any(|(edge, _)| sides.contains(edge)) || faces.iter().any(|(face, _)| *face == own)
        };
        (0..model.triangles.len() as u32).filter(has_marked).collect()
    }
}

fn delta() -> impl Strategy<Value = Delta> {
    let vertex = 0..(QUADS + 1) * (QUADS + 1);
    let small = -0.2_f32..0.2;
    // Some go behind the eye, far away, or nowhere.
    let large = prop_oneof![-3.0_f32..3.0, Just(1e9), Just(f32::NAN)];
    let way = prop_oneof![
        6 => prop::array::uniform4(small),
        1 => prop::array::uniform4(large),
    ];
    let color = prop::array::uniform4(0.0_f32..1.0).prop_map(Vec4::from_array);
    let moved = prop::collection::vec((vertex.clone(), way), 0..5);
    let painted = prop::collection::vec((vertex, color), 0..4);
    let turned = prop::collection::vec(0..2 * QUADS * QUADS, 0..3);
    let marked = [2 * (QUADS + 1) * (QUADS + 1), QUADS * QUADS]
        .map(|elements| prop::collection::vec((0..elements, 0..4_u8), 0..3));
    let resized = prop::collection::vec(0..4_u32, 0..3);
    (0..2_usize, moved, painted, turned, marked, resized).prop_map(
        |(model, moved, painted, turned, marked, resized)| Delta {
            model,
            moved,
            painted,
            turned,
            marked,
            resized,
        },
    )
}

/// How the images are drawn.
#[derive(Clone, Debug)]
struct View {
    size: [u32; 2],
    samples: [u32; 2],
    outputs: Vec<Output>,
    edges: Option<f32>,
    has_marks: bool,
    /// Lines share a chunk with opaque triangles, which then is set up again as a whole.
    has_lines: bool,
    has_points: bool,
    background: usize,
    settings: ExecuteSettings,
}

fn view() -> impl Strategy<Value = View> {
    use Output::{Depth, Face, Linear, Object, Srgb8, Triangle, Unorm8};
    let samples = prop::sample::select(vec![[1, 1], [1, 1], [1, 4], [1, 8], [2, 1], [3, 2]]);
    let outputs = prop_oneof![
        Just(vec![Srgb8]),
        Just(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle]),
        prop::sample::subsequence(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle], 1..7),
    ];
    let tile_size = prop::sample::select(vec![
        TileSize::Automatic,
        TileSize::Pixels8,
        TileSize::Pixels16,
        TileSize::Pixels32,
    ]);
    let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.token().is_some()).collect();
    let settings =
        (1..4_usize, tile_size, prop::sample::select(levels)).prop_map(|(threads, tile_size, level)| {
            let (threads, simd) = (NonZeroUsize::new(threads), Some(level));
            ExecuteSettings { threads, simd, tile_size, ..ExecuteSettings::default() }
        });
    let edges = prop_oneof![Just(None), (0.5_f32..5.0).prop_map(Some)];
    let has = [any::<bool>(), any::<bool>(), any::<bool>()];
    ([1_u32..130, 1_u32..100], samples, outputs, edges, has, 0..3_usize, settings).prop_map(
        |(size, samples, outputs, edges, [has_marks, has_lines, has_points], background, settings)| View {
            size,
            samples,
            outputs,
            edges,
            has_marks,
            has_lines,
            has_points,
            background,
            settings,
        },
    )
}

/// Three marks with colours of their own; the others cannot be seen.
fn mark_colors() -> MarkColors {
    let mut colors = MarkColors::NONE;
    for (mark, color) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
        colors.edges[mark + 1] = color.extend(0.9);
        colors.faces[mark + 1] = color.extend(0.4);
    }
    colors
}

fn row(y: u32) -> Vec4 {
    Vec3::new(0.1, (y % 50) as f32 / 50.0, 0.4).extend(1.0)
}

impl View {
    fn target(&self) -> Target<'static> {
        let target = Target::new(self.size[0], self.size[1], &self.outputs).expect("a size");
        let target = target.with_samples_per_axis(self.samples[0]).expect("a number of samples");
        target.with_samples(self.samples[1]).expect("a number of samples")
    }

    fn pass<'a>(&self, models: &'a [Model]) -> Pass<'a> {
        let mut pass = Pass::new();
        pass.background(match self.background {
            0 => Background::Color(Vec4::new(0.2, 0.3, 0.4, 1.0)),
            1 => Background::PerRow(&row),
            _ => Background::PerPixel(&|pixel| row(pixel.y + pixel.x)),
        });
        for (object, model) in (0..).zip(models) {
            model.record(object, &mut pass);
        }
        // Between others: its ordinals begin and end where theirs do.
        pass.triangles(Draw::new(&models[2], &[]));
        let segments: &[[u32; 2]] = if self.has_lines { &[[0, 11], [11, 30], [34, 35]] } else { &[] };
        let lines = Lines::new(&models[0], segments);
        pass.lines(Lines { object: 9, width: 3.0, ..lines });
        let points: &[u32] = if self.has_points { &[0, 12, 34, 60] } else { &[] };
        let (smoothing, blend_mode) = match self.background {
            0 => (Smoothing::AntiAliased, BlendMode::Opaque),
            _ => (Smoothing::Sharp, BlendMode::Overlay),
        };
        let marked = Some(MarkedPoints { set: &models[0].large, size: 7.0 });
        if self.background == 2 && self.has_points {
            let points = Points::new(&models[0].vertices, &ALL_POINTS, 4.0);
            pass.points(Points { object: 10, blend_mode, marked, ..points });
        } else {
            let points = Points { smoothing, blend_mode, marked, ..Points::new(&models[0], points, 4.0) };
            pass.points(Points { object: 10, ..points });
        }
        if let Some(width) = self.edges {
            pass.edges(FaceEdges { width, color: Vec3::X, opacity: 0.7 });
        }
        if self.has_marks {
            pass.marks(mark_colors());
        }
        pass
    }

    fn fresh(&self, models: &[Model]) -> Target<'static> {
        let mut target = self.target();
        let one = ExecuteSettings { threads: NonZeroUsize::new(1), ..ExecuteSettings::default() };
        Rasterizer::new(one).expect("the best level").draw(&self.pass(models), &mut target);
        target
    }

    /// What a whole image counts up to its tiles.
    fn counts(&self, models: &[Model]) -> [u64; 8] {
        let mut rasterizer = Rasterizer::new(self.settings).expect("a level that there is");
        up_to_tiles(&rasterizer.draw(&self.pass(models), &mut self.target()))
    }
}

fn up_to_tiles(stats: &Stats) -> [u64; 8] {
    let Stats { primitives, vertices, invalid, outside, clipped, culled, set_up, binned, .. } = *stats;
    [primitives, vertices, invalid, outside, clipped, culled, set_up, binned]
}

fn models(surfaces: [BlendMode; 2]) -> Vec<Model> {
    let [front, back] =
        [(surfaces[0], 0.0), (surfaces[1], 0.5)].map(|(blend_mode, shift)| Model::sheet(blend_mode, shift));
    // No part of it is ever changed.
    let still = Model::sheet(BlendMode::Opaque, 0.2);
    vec![front, back, Model { triangles: still.triangles[..7].to_vec(), ..still }]
}

/// One change of a model: which of the deltas, and how many of its vertices move.
type Step = (prop::sample::Index, Option<prop::sample::Index>);

/// Steps of which most are repeated a few times, as in a drag, so that what is kept for that is used.
fn steps() -> impl Strategy<Value = Vec<Step>> {
    let part = prop_oneof![3 => Just(None), 1 => any::<prop::sample::Index>().prop_map(Some)];
    let repeated = (any::<prop::sample::Index>(), prop::collection::vec(part, 1..6));
    prop::collection::vec(repeated, 1..4).prop_map(|steps| {
        let several = |(delta, parts): (_, Vec<Option<_>>)| parts.into_iter().map(move |part| (delta, part));
        steps.into_iter().flat_map(several).collect()
    })
}

/// Redraws after each change of the models. Both kinds of draws come in the pass's order, and
/// the lines last.
fn check(
    view: &View,
    mut models: Vec<Model>,
    (deltas, steps): (&[Delta], &[Step]),
) -> Result<(), TestCaseError> {
    let mut rasterizer = Rasterizer::new(view.settings).expect("a level that there is");
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    for (delta, part) in steps {
        let delta = delta.get(deltas);
        let count = part.map_or(delta.moved.len(), |part| part.index(delta.moved.len() + 1));
        let Told { vertices, reshaped, recolored, resized } =
            delta.apply_part(&mut models[delta.model], count);
        let (vertices, mut changes) = (vertices.as_slice(), [DrawChange::default(); 6]);
        changes[delta.model] = DrawChange { vertices, reshaped: &reshaped, recolored: &recolored };
        if delta.model == 0 {
            // The lines and the points have its vertices.
            changes[4..].fill(DrawChange { vertices, ..DrawChange::default() });
            if view.has_points {
                changes[5].reshaped = &resized;
            }
        }
        let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
        let counts = view.counts(&models);
        prop_assert!(up_to_tiles(&redraw.stats) == counts, "the counts of a whole image after {delta:?}");
        let fresh = view.fresh(&models);
        prop_assert!(target.srgb8() == fresh.srgb8(), "bytes after {delta:?}");
        prop_assert!(target.unorm8() == fresh.unorm8(), "linear bytes after {delta:?}");
        prop_assert!(target.linear() == fresh.linear(), "light after {delta:?}");
        prop_assert!(target.depth() == fresh.depth(), "depth after {delta:?}");
        prop_assert!(target.objects() == fresh.objects(), "objects after {delta:?}");
        prop_assert!(target.faces() == fresh.faces(), "faces after {delta:?}");
        prop_assert!(target.triangles() == fresh.triangles(), "triangles after {delta:?}");
    }
    Ok(())
}

fn blend_mode() -> impl Strategy<Value = BlendMode> {
    prop::sample::select(vec![
        BlendMode::Opaque,
        BlendMode::Masked,
        BlendMode::MaskedPerSample,
        BlendMode::Overlay,
        BlendMode::Translucent,
    ])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn an_image_that_follows_is_a_fresh_one(
        view in view(),
        surfaces in [blend_mode(), blend_mode()],
        deltas in prop::collection::vec(delta(), 1..4),
        steps in steps(),
    ) {
        check(&view, models(surfaces), (&deltas, &steps))?;
    }

    /// Opaque surfaces with points, one sample to a pixel: this is what can be kept while vertices are dragged.
    #[test]
    fn an_image_of_a_drag_is_a_fresh_one(
        size in [1_u32..300, 1_u32..200],
        edges in prop_oneof![Just(None), (0.5_f32..5.0).prop_map(Some)],
        background in 1..3_usize,
        has_points: bool,
        has_marks: bool,
        has_depth: bool,
        settings in view().prop_map(|view| view.settings),
        deltas in prop::collection::vec(delta(), 1..3),
        steps in steps(),
        has_overlay: bool,
    ) {
        let outputs = match has_depth {
            true => vec![Output::Srgb8, Output::Depth, Output::Object, Output::Face, Output::Triangle],
            false => vec![Output::Unorm8],
        };
        let view = View {
            size, samples: [1, 1], outputs, edges, has_marks, has_lines: false, has_points, background, settings,
        };
        let calm = |delta: Delta| Delta { marked: [Vec::new(), Vec::new()], ..delta };
        let deltas: Vec<Delta> = deltas.into_iter().map(calm).collect();
        let second = if has_overlay { BlendMode::Overlay } else { BlendMode::Opaque };
        check(&view, models([BlendMode::Opaque, second]), (&deltas, &steps))?;
    }
}

fn plain(outputs: &[Output]) -> View {
    View {
        size: [600, 500],
        samples: [1, 1],
        outputs: outputs.to_vec(),
        edges: Some(1.0),
        has_marks: false,
        has_lines: true,
        has_points: true,
        background: 1,
        settings: ExecuteSettings::default(),
    }
}

fn one_vertex() -> Delta {
    Delta {
        model: 0,
        moved: vec![(34, [0.05, 0.0, 0.0, 0.0])],
        painted: Vec::new(),
        turned: Vec::new(),
        marked: [Vec::new(), Vec::new()],
        resized: Vec::new(),
    }
}

/// The share of the target that was drawn again.
fn share(view: &View, parts: &[crate::Rect]) -> f64 {
    let area =
        |part: &crate::Rect| f64::from(part.max[0] - part.min[0]) * f64::from(part.max[1] - part.min[1]);
    parts.iter().map(area).sum::<f64>() / f64::from(view.size[0] * view.size[1])
}

#[test]
fn only_tiles_around_what_moved_are_drawn() {
    let (view, mut models) = (plain(&[Output::Srgb8]), models([BlendMode::Opaque; 2]));
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    let first = rasterizer.redraw(&view.pass(&models), &mut target, None);
    assert_eq!(share(&view, &first.parts), 1.0, "nothing was there");
    let unchanged = [DrawChange::default(); 6];
    let same = rasterizer.redraw(&view.pass(&models), &mut target, Some(&unchanged));
    assert!(same.parts.is_empty(), "nothing differs");
    let Told { vertices, .. } = one_vertex().apply(&mut models[0]);
    let mut changes = unchanged;
    for draw in [0, 4, 5] {
        changes[draw].vertices = &vertices;
    }
    let moved = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
    let drawn = share(&view, &moved.parts);
    assert!(drawn > 0.0 && drawn < 0.3, "four quads of {}: {drawn}", QUADS * QUADS);
    assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
}

/// From the second time on, the still triangles of a tile are kept; from the third time on, only pixels that may look
/// different are shaded.
#[test]
fn only_pixels_around_what_moves_again_are_shaded() {
    let view = View { has_lines: false, background: 2, ..plain(&[Output::Srgb8]) };
    let mut models = models([BlendMode::Opaque; 2]);
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    let shaded: Vec<u64> = (0..5)
        .map(|_| {
            let Told { vertices, .. } = one_vertex().apply(&mut models[0]);
            let mut changes = [DrawChange::default(); 6];
            for draw in [0, 4, 5] {
                changes[draw].vertices = &vertices;
            }
            let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
            assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
            redraw.stats.pixels_shaded
        })
        .collect();
    assert!(shaded[2..].iter().all(|&again| 3 * again < 2 * shaded[0]), "pixels shaded: {shaded:?}");
}

#[test]
fn only_tiles_around_other_marks_are_drawn() {
    let view = View { has_marks: true, ..plain(&[Output::Srgb8]) };
    let mut models = models([BlendMode::Opaque; 2]);
    let mut rasterizer = Rasterizer::default();
    let mut target = view.target();
    rasterizer.redraw(&view.pass(&models), &mut target, None);
    let before = target.srgb8().map(<[_]>::to_vec);
    let marked = [vec![(44, 3)], vec![(40, 3)]];
    let Told { recolored, .. } = Delta { moved: Vec::new(), marked, ..one_vertex() }.apply(&mut models[0]);
    let mut changes = [DrawChange::default(); 6];
    changes[0].recolored = &recolored;
    let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&changes));
    let drawn = share(&view, &redraw.parts);
    assert!(drawn > 0.0 && drawn < 0.3, "three quads of {}: {drawn}", QUADS * QUADS);
    assert!(target.srgb8() != before.as_deref(), "other marks look different");
    assert!(target.srgb8() == view.fresh(&models).srgb8(), "the bytes of a fresh image");
}

/// Ordinals of a draw without triangles begin where those of the next draw do: a redraw took
/// the changed vertices of the one for those of the other, and asked an empty range for its
/// last triangle.
#[test]
fn draws_without_triangles_broke_the_redraws_look_up_of_draws() {
    let view = plain(&[Output::Srgb8]);
    let mut after = Model::sheet(BlendMode::Opaque, 0.0);
    let (before, behind) = (after.clone(), Model::sheet(BlendMode::Opaque, 0.5));
    let Told { vertices, .. } = one_vertex().apply(&mut after);
    // The changed sheet lies before the third one, which stays as it is.
    for [empty, changed] in [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]] {
        let record = |sheet| {
            let mut pass = Pass::new();
            pass.edges(FaceEdges { width: 1.0, color: Vec3::X, opacity: 0.7 });
            for draw in 0..3 {
                if draw == empty {
                    pass.triangles(Draw::new(&behind, &[]));
                } else {
                    Model::record(if draw == changed { sheet } else { &behind }, draw, &mut pass);
                }
            }
            pass
        };
        let mut changes = [DrawChange::default(); 3];
        changes[changed as usize].vertices = &vertices;
        let (mut rasterizer, mut target, mut fresh) = (Rasterizer::default(), view.target(), view.target());
        rasterizer.redraw(&record(&before), &mut target, None);
        let redraw = rasterizer.redraw(&record(&after), &mut target, Some(&changes));
        Rasterizer::default().draw(&record(&after), &mut fresh);
        assert!(share(&view, &redraw.parts) < 0.3, "draw {empty} is empty, and {changed} follows");
        assert!(target.srgb8() == fresh.srgb8(), "draw {empty} is empty, and {changed} moves");
    }
}

/// Whatever else the rasterizer has done in between: it tells nothing of the changes.
#[test]
fn after_anything_else_everything_is_drawn() {
    let (view, models) = (plain(&[Output::Srgb8]), models([BlendMode::Opaque; 2]));
    let unchanged = [DrawChange::default(); 6];
    let spoil: [fn(&mut Rasterizer, &View, &[Model]); 4] = [
        |rasterizer, view, models| {
            let _: Stats = rasterizer.draw(&view.pass(models), &mut view.target());
        },
        |rasterizer, view, models| {
            rasterizer.explain_pixel(&view.pass(models), &view.target(), 0, 0);
        },
        |rasterizer, view, models| {
            let cancel = Cancel::default();
            cancel.cancel();
            rasterizer.set_cancel(Some(cancel));
            rasterizer.redraw(&view.pass(models), &mut view.target(), None);
            rasterizer.set_cancel(None);
        },
        |rasterizer, view, models| {
            let other = View { outputs: vec![Output::Srgb8, Output::Depth], ..view.clone() };
            rasterizer.redraw(&view.pass(models), &mut other.target(), None);
        },
    ];
    for (number, spoil) in spoil.into_iter().enumerate() {
        let (mut rasterizer, mut target) = (Rasterizer::default(), view.target());
        rasterizer.redraw(&view.pass(&models), &mut target, None);
        spoil(&mut rasterizer, &view, &models);
        let redraw = rasterizer.redraw(&view.pass(&models), &mut target, Some(&unchanged));
        assert_eq!(share(&view, &redraw.parts), 1.0, "number {number}");
    }
}

/// A triangle that is cut by the near plane and faces away is counted as cut and as culled, but leaves nothing
/// else: its chunk looks like one without it.
#[test]
fn triangles_that_were_cut_and_culled_still_count_after_a_change() {
    let sheet = |shift: f32| {
        let mut sheet = Model::sheet(BlendMode::Opaque, 0.0);
        sheet.vertices[34].0.x += shift;
        // Three corners of its own: one of them behind the eye.
        let corners = [[-0.5, 0.5, 1.0], [0.5, 0.5, 1.0], [0.0, -0.5, -1.0]];
        let first = sheet.vertices.len() as u32;
        sheet.vertices.extend(corners.map(|[x, y, w]| (Vec4::new(x, y, 0.3, w), Vec4::ONE)));
        sheet.triangles.push([first, first + 1, first + 2]);
        sheet
    };
    let view = plain(&[Output::Srgb8]);
    let (before, after) = (sheet(0.0), sheet(0.05));
    fn record(sheet: &Model, culling: Culling) -> Pass<'_> {
        let mut pass = Pass::new();
        pass.triangles(Draw { culling, ..Draw::new(sheet, &sheet.triangles) });
        pass
    }
    let mut clipped = [0, 0];
    for (culling, clipped) in [Culling::Back, Culling::Front].into_iter().zip(&mut clipped) {
        let (mut rasterizer, mut target, mut fresh) = (Rasterizer::default(), view.target(), view.target());
        rasterizer.redraw(&record(&before, culling), &mut target, None);
        let change = DrawChange { vertices: &[34], ..DrawChange::default() };
        let redraw = rasterizer.redraw(&record(&after, culling), &mut target, Some(&[change]));
        let stats = Rasterizer::default().draw(&record(&after, culling), &mut fresh);
        assert_eq!(up_to_tiles(&redraw.stats), up_to_tiles(&stats), "{culling:?}");
        assert!(target.srgb8() == fresh.srgb8(), "{culling:?}");
        *clipped = stats.clipped;
    }
    assert_eq!(clipped, [1, 1], "it is cut, whichever side is drawn");
}
