//! Surfaces, how they are drawn, and how they change.

use crate::simd::SimdLevel;
use crate::{
    Background, BlendMode, Culling, Draw, EdgeFlags, ExecuteSettings, FaceEdges, Fragment, Lines, MarkColors,
    MarkedPoints, Marks, Output, Pass, Pipeline, Points, Rasterizer, Smoothing, Stats, Target, TileSize,
    VertexOutput,
};
use fixedbitset::FixedBitSet;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Vec3, Vec4};

/// A surface of quads and a line beside it, whose vertices have colours.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub(super) vertices: Vec<(Vec4, Vec4)>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) faces: Vec<u32>,
    pub(super) flags: Vec<EdgeFlags>,
    /// The numbers of the edges that the triangles' sides are.
    pub(super) sides: Vec<[u32; 3]>,
    pub(super) edge_marks: Vec<u8>,
    pub(super) face_marks: Vec<u8>,
    /// Its points that are larger.
    pub(super) large: FixedBitSet,
    pub(super) blend_mode: BlendMode,
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

pub(super) const QUADS: u32 = 9;

/// One for each vertex of a sheet.
pub(super) const ALL_POINTS: [u32; ((QUADS + 1) * (QUADS + 1)) as usize] = {
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
    pub(super) fn sheet(blend_mode: BlendMode, shift: f32) -> Self {
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

    pub(super) fn record<'a>(&'a self, object: u32, pass: &mut Pass<'a>) {
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
pub(super) struct Delta {
    pub(super) model: usize,
    /// Vertices with how far they move in clip space.
    pub(super) moved: Vec<(u32, [f32; 4])>,
    /// Vertices with other colours.
    pub(super) painted: Vec<(u32, Vec4)>,
    /// Triangles whose corners are turned on, and whose flags are others.
    pub(super) turned: Vec<u32>,
    /// Edges and faces with other marks.
    pub(super) marked: [Vec<(u32, u8)>; 2],
    /// Points with another size.
    pub(super) resized: Vec<u32>,
}

/// The changes of a model that are passed to `redraw`.
pub(super) struct Told {
    pub(super) vertices: Vec<u32>,
    pub(super) reshaped: Vec<u32>,
    pub(super) recolored: Vec<u32>,
    pub(super) resized: Vec<u32>,
}

impl Delta {
    /// Changes the model; returns what is passed to `redraw`.
    pub(super) fn apply(&self, model: &mut Model) -> Told {
        self.apply_part(model, self.moved.len())
    }

    /// The same, of which only the first vertices move, `count` of them.
    pub(super) fn apply_part(&self, model: &mut Model, count: usize) -> Told {
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
    pub(super) fn mark(&self, model: &mut Model) -> Vec<u32> {
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

pub(super) fn delta() -> impl Strategy<Value = Delta> {
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
pub(super) struct View {
    pub(super) size: [u32; 2],
    pub(super) samples: [u32; 2],
    pub(super) outputs: Vec<Output>,
    pub(super) edges: Option<f32>,
    pub(super) has_marks: bool,
    /// Lines share a chunk with opaque triangles, which then is set up again as a whole.
    pub(super) has_lines: bool,
    pub(super) has_points: bool,
    pub(super) background: usize,
    pub(super) settings: ExecuteSettings,
}

pub(super) fn view() -> impl Strategy<Value = View> {
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
pub(super) fn mark_colors() -> MarkColors {
    let mut colors = MarkColors::NONE;
    for (mark, color) in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().enumerate() {
        colors.edges[mark + 1] = color.extend(0.9);
        colors.faces[mark + 1] = color.extend(0.4);
    }
    colors
}

pub(super) fn row(y: u32) -> Vec4 {
    Vec3::new(0.1, (y % 50) as f32 / 50.0, 0.4).extend(1.0)
}

impl View {
    pub(super) fn target(&self) -> Target<'static> {
        let target = Target::new(self.size[0], self.size[1], &self.outputs).expect("a size");
        let target = target.with_samples_per_axis(self.samples[0]).expect("a number of samples");
        target.with_samples(self.samples[1]).expect("a number of samples")
    }

    pub(super) fn pass<'a>(&self, models: &'a [Model]) -> Pass<'a> {
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

    pub(super) fn fresh(&self, models: &[Model]) -> Target<'static> {
        let mut target = self.target();
        let one = ExecuteSettings { threads: NonZeroUsize::new(1), ..ExecuteSettings::default() };
        Rasterizer::new(one).expect("the best level").draw(&self.pass(models), &mut target);
        target
    }

    /// What a whole image counts up to its tiles.
    pub(super) fn counts(&self, models: &[Model]) -> [u64; 8] {
        let mut rasterizer = Rasterizer::new(self.settings).expect("a level that there is");
        up_to_tiles(&rasterizer.draw(&self.pass(models), &mut self.target()))
    }
}

pub(super) fn up_to_tiles(stats: &Stats) -> [u64; 8] {
    let Stats { primitives, vertices, invalid, outside, clipped, culled, set_up, binned, .. } = *stats;
    [primitives, vertices, invalid, outside, clipped, culled, set_up, binned]
}
