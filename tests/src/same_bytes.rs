//! The same image, to the byte, with any number of threads, any size of tiles,
//! any SIMD level, either way to test depth and any order of draws; and hostile
//! vertices harm nobody else. Hard cases 6,
//! 12, 17, 20, 43.

use crate::coverage_support::{Samples, draw_sized, levels, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{UVec2, Vec3, Vec4};
use trigon_raster::{
    Background, BlendMode, Culling, DepthTest, Draw, ExecuteSettings, Fragment, Lines, Output, Pass,
    Pipeline, PointShape, Points, Rasterizer, Smoothing, Target, TargetImages, TileSize, VertexOutput,
};

/// Coloured vertices; a fragment shows the colour, by its alpha, with dark
/// edges, and the mask has holes.
#[derive(Clone, Debug)]
struct Coloured {
    vertices: Vec<(Vec4, Vec4)>,
}

impl Pipeline for Coloured {
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        let (position, varyings) = self.vertices[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let straight = fragment.varyings;
        let shade = if fragment.nearest_edge() < 1.0 { 0.2 } else { 1.0 };
        (straight.truncate() * (straight.w * shade)).extend(straight.w)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        let cell = fragment.varyings.truncate() * 8.0;
        (cell.x as i32 + cell.y as i32) % 2 == 0
    }
}

/// A pipeline with its triangles, lines and points, and the face of each.
#[derive(Clone, Debug)]
struct Soup {
    object: u32,
    surface: BlendMode,
    smoothing: Smoothing,
    pipeline: Coloured,
    triangles: Vec<[u32; 3]>,
    segments: Vec<[u32; 2]>,
    points: Vec<u32>,
    faces: Vec<u32>,
}

fn vertex() -> impl Strategy<Value = (Vec4, Vec4)> {
    let position = (-1.5_f32..1.5, -1.5_f32..1.5, 0.0_f32..1.2, -0.3_f32..3.0)
        .prop_map(|(x, y, z, w)| Vec4::new(x * w, y * w, z, w));
    let color = (0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0, 0.2_f32..1.0).prop_map(Vec4::from);
    (position, color)
}

fn soup() -> impl Strategy<Value = Soup> {
    let surface = prop_oneof![
        Just(BlendMode::Opaque),
        Just(BlendMode::Masked),
        Just(BlendMode::MaskedPerSample),
        Just(BlendMode::Translucent)
    ];
    let smoothing = prop_oneof![Just(Smoothing::Sharp), Just(Smoothing::AntiAliased)];
    let vertices = proptest::collection::vec(vertex(), 3..30);
    (vertices, surface, smoothing).prop_map(|(vertices, surface, smoothing)| {
        let count = vertices.len() as u32;
        let triangles: Vec<_> = (0..count).map(|i| [i, (i + 1) % count, (i + 7) % count]).collect();
        Soup {
            object: 0,
            surface,
            smoothing,
            pipeline: Coloured { vertices },
            faces: (0..count).collect(),
            triangles,
            segments: (1..count).map(|i| [i - 1, i]).collect(),
            points: (0..count).collect(),
        }
    })
}

fn soups() -> impl Strategy<Value = Vec<Soup>> {
    proptest::collection::vec(soup(), 1..4).prop_map(|mut soups| {
        for (object, soup) in soups.iter_mut().enumerate() {
            soup.object = 10 * object as u32;
        }
        soups
    })
}

fn record<'a>(pass: &mut Pass<'a>, soup: &'a Soup) {
    let Soup { object, surface, pipeline, faces, .. } = soup;
    let (object, surface, smoothing) = (*object, *surface, soup.smoothing);
    pass.triangles(Draw {
        object,
        blend_mode: surface,
        faces: Some(faces),
        culling: Culling::None,
        ..Draw::new(pipeline, &soup.triangles)
    });
    let lines = Lines::new(pipeline, &soup.segments);
    pass.lines(Lines { object: object + 1, blend_mode: surface, width: 2.5, smoothing, ..lines });
    let shape = if object == 0 { PointShape::Round } else { PointShape::Square };
    let points = Points::new(pipeline, &soup.points, 9.0);
    pass.points(Points { object: object + 2, blend_mode: surface, shape, smoothing, ..points });
}

fn image(
    soups: &[Soup],
    [width, height]: [u32; 2],
    samples: Samples,
    settings: &ExecuteSettings,
) -> TargetImages {
    let outputs =
        [Output::Srgb8, Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
    let mut target = samples.target([width, height], &outputs);
    let background = |pixel: UVec2| {
        Vec3::new(pixel.x as f32 / width as f32, pixel.y as f32 / height as f32, 0.5).extend(1.0)
    };
    let mut pass = Pass::new();
    pass.background(Background::PerPixel(&background));
    for soup in soups {
        record(&mut pass, soup);
    }
    rasterizer(settings).draw(&pass, &mut target);
    target.into_images()
}

/// Numbers of threads and sizes of tiles.
fn executions() -> impl Strategy<Value = ExecuteSettings> {
    let tile_sizes = [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64];
    (1..9_usize, prop::sample::select(tile_sizes.to_vec())).prop_map(|(threads, tile_size)| ExecuteSettings {
        threads: NonZeroUsize::new(threads),
        tile_size,
        ..Default::default()
    })
}

/// Levels of vector instructions, and ways to test depth.
fn arithmetics() -> impl Strategy<Value = ExecuteSettings> {
    let levels: Vec<_> = levels().collect();
    let depth_tests = [DepthTest::Hierarchical, DepthTest::Late];
    (prop::sample::select(levels), prop::sample::select(depth_tests.to_vec())).prop_map(
        |(level, depth_test)| ExecuteSettings { simd: Some(level), depth_test, ..Default::default() },
    )
}

proptest! {
    #![proptest_config(cases(32))]

    #[test]
    fn threads_and_tiles_change_nothing(
        soups in soups(),
        samples in Samples::any(),
        others in [executions(), executions()],
    ) {
        // Large enough to be shared among threads.
        let draw = |settings: &ExecuteSettings| image(&soups, [300, 200], samples, settings);
        let reference = draw(&ExecuteSettings::default());
        for settings in &others {
            prop_assert!(draw(settings) == reference, "{settings:?}");
        }
    }

    #[test]
    fn levels_and_depth_tests_change_nothing(
        soups in soups(),
        samples in Samples::any(),
        others in [arithmetics(), arithmetics()],
    ) {
        let draw = |settings: &ExecuteSettings| image(&soups, [150, 100], samples, settings);
        let reference = draw(&ExecuteSettings::default());
        for settings in &others {
            prop_assert!(draw(settings) == reference, "{settings:?}");
        }
    }
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn the_order_of_draws_and_triangles_changes_nothing(soups in soups(), samples in Samples::any()) {
        let settings = ExecuteSettings::default();
        let mut reference = image(&soups, [100, 80], samples, &settings);
        let mut turned = soups;
        turned.reverse();
        for soup in &mut turned {
            soup.triangles.reverse();
            soup.faces.reverse();
        }
        let mut other = image(&turned, [100, 80], samples, &settings);
        // The index of a triangle in its draw is what has changed.
        reference.triangles = None;
        other.triangles = None;
        prop_assert!(reference == other);
    }

    /// Hard cases 17 and 20.
    #[test]
    fn hostile_vertices_harm_nobody_else(soups in soups(), hostile in proptest::collection::vec(hostile(), 3..12)) {
        let settings = ExecuteSettings::default();
        let reference = image(&soups, [160, 120], Samples::ONE, &settings);
        let count = hostile.len() as u32;
        let hostile = Soup {
            object: 500,
            surface: BlendMode::Translucent,
            smoothing: Smoothing::Sharp,
            pipeline: Coloured { vertices: hostile },
            triangles: (0..count).map(|i| [i, (i + 1) % count, (i + 2) % count]).chain([[0, 1, 4_000_000_000]]).collect(),
            segments: (0..count).map(|i| [i, (i + 1) % count]).chain([[0, u32::MAX]]).collect(),
            points: (0..count).chain([count]).collect(),
            faces: Vec::new(),
        };
        let all: Vec<_> = soups.iter().cloned().chain([hostile]).collect();
        let images = image(&all, [160, 120], Samples::ONE, &settings);
        prop_assert!(images.linear.iter().flatten().all(|color| color.is_finite()), "a colour is not finite");
        prop_assert!(images.depth.iter().flatten().all(|depth| (0.0..=1.0).contains(depth)), "a depth is not one");
        // Translucent, so it changes no id and no depth.
        prop_assert!(images.objects == reference.objects && images.depth == reference.depth);
    }
}

/// Anything that four floats can hold, and what is worst.
fn hostile() -> impl Strategy<Value = (Vec4, Vec4)> {
    let coordinate = prop_oneof![
        any::<f32>(),
        -2.0_f32..2.0,
        Just(0.0),
        Just(-0.0),
        Just(f32::NAN),
        Just(f32::INFINITY),
        Just(1e38),
        Just(-1e38),
        Just(1e-38),
        Just(f32::from_bits(1)),
        Just(1e29),
    ];
    [coordinate.clone(), coordinate.clone(), coordinate.clone(), coordinate]
        .prop_map(|position| (Vec4::from_array(position), Vec4::splat(0.5)))
}

/// Hard case 43.
#[test]
fn layers_blend_in_depth_order_whatever_the_order_of_draws() {
    let layer = |depth: f32, color: Vec4| Coloured {
        vertices: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| (Vec4::new(x, y, depth, 1.0), color))
            .to_vec(),
    };
    let triangles = [[0, 1, 2], [0, 2, 3]];
    let layers: Vec<_> =
        (0..40).map(|i| layer(0.1 + 0.02 * i as f32, Vec4::new(i as f32 / 40.0, 0.5, 0.25, 0.1))).collect();
    let draw = |order: &mut dyn Iterator<Item = usize>| {
        let mut pass = Pass::new();
        for i in order {
            let surface = BlendMode::Translucent;
            pass.triangles(Draw {
                blend_mode: surface,
                object: i as u32,
                ..Draw::new(&layers[i], &triangles)
            });
        }
        draw_sized(&pass, [16, 16], &ExecuteSettings::default())
    };
    let forward = draw(&mut (0..40));
    assert!(forward == draw(&mut (0..40).rev()), "the reverse order");
    assert!(forward == draw(&mut (0..40).map(|i| i * 7 % 40)), "a shuffled order");
    let mut expected = Vec4::ZERO;
    for i in 0..40 {
        let color = Vec4::new(i as f32 / 40.0, 0.5, 0.25, 0.1);
        expected = (color.truncate() * 0.1).extend(0.1) + expected * 0.9;
    }
    let middle = forward.linear.expect("asked for")[8 * 16 + 4];
    // Three roundings a layer, as in `blending`, here and in the expectation.
    let bound = 2.0 * 3.0 * 40.0 * f32::EPSILON / 2.0;
    assert!((middle - expected).abs().max_element() <= bound, "{middle} instead of {expected}");
}

/// At equal depth the smaller (object, face) lies on top, as it would be seen if
/// both were opaque.
#[test]
fn equally_deep_layers_blend_by_their_ids() {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let layer = |color: Vec4| Coloured {
        vertices: corners.map(|[x, y]| (Vec4::new(x, y, 0.5, 1.0), color)).to_vec(),
    };
    let (first, second) = (layer(Vec4::new(1.0, 0.0, 0.0, 0.5)), layer(Vec4::new(0.0, 1.0, 0.0, 0.5)));
    let triangles = [[0, 1, 2], [0, 2, 3]];
    for swapped in [false, true] {
        let mut pass = Pass::new();
        let mut draws = [(1, &first), (2, &second)];
        if swapped {
            draws.reverse();
        }
        for (object, layer) in draws {
            pass.triangles(Draw {
                blend_mode: BlendMode::Translucent,
                object,
                ..Draw::new(layer, &triangles)
            });
        }
        let linear = draw_sized(&pass, [16, 16], &ExecuteSettings::default()).linear.expect("asked for");
        assert_eq!(linear[8 * 16 + 4], Vec4::new(0.5, 0.25, 0.0, 0.75), "object 1 over object 2");
    }
}

/// Finite colours can overflow when they are blended or averaged; and what is
/// infinite is no number as soon as something opaque lies on it.
#[test]
fn colours_that_overflow_stay_finite() {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let glow = |depth: f32, alpha: f32| Glow {
        vertices: corners.map(|[x, y]| Vec4::new(x, y, depth, 1.0)),
        color: Vec4::new(3e38, -3e38, 3e38, alpha),
    };
    let layers = [glow(0.1, 0.0), glow(0.2, 0.0), glow(0.3, 1.0), glow(0.4, -1e38), glow(0.5, 1.0)];
    let triangles = [[0, 1, 2], [0, 2, 3]];
    for (surface, samples) in
        [(BlendMode::Opaque, 4), (BlendMode::Translucent, 1), (BlendMode::Translucent, 3)]
    {
        for layers in [&layers[..2], &layers[..3], &layers[..4], &layers[..]] {
            let mut pass = Pass::new();
            for (object, layer) in layers.iter().enumerate() {
                // Half of the image, so that samples of a pixel differ.
                let triangles = if surface == BlendMode::Opaque { &triangles[..1] } else { &triangles[..] };
                pass.triangles(Draw {
                    blend_mode: surface,
                    object: object as u32,
                    ..Draw::new(layer, triangles)
                });
            }
            let target = Target::new(13, 11, &[Output::Linear, Output::Srgb8]).expect("a size in range");
            let mut target = target.with_samples_per_axis(samples).expect("a number in range");
            Rasterizer::default().draw(&pass, &mut target);
            let colors = target.linear().expect("asked for");
            assert!(colors.iter().all(|color| color.is_finite()), "{surface:?} {samples}: {:?}", colors[40]);
        }
    }
}

/// A quad of one colour, which may be anything.
struct Glow {
    vertices: [Vec4; 4],
    color: Vec4,
}

impl Pipeline for Glow {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        4
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.vertices[index], varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        self.color
    }
}

/// More layers than a worker holds at a time: the tile is done in parts, and
/// nothing shows where it was cut.
#[test]
fn thousands_of_layers_are_blended_in_parts() {
    let count = 5_000_u32;
    let corners = [[-0.9, -0.8], [0.9, -0.7], [0.7, 0.9], [-0.6, 0.8]];
    let vertices = (0..count).flat_map(|i| {
        let shade = (i % 97) as f32 / 97.0;
        let depth = (i * 7 % count) as f32 / count as f32;
        corners.map(|[x, y]| (Vec4::new(x, y, depth, 1.0), Vec4::new(shade, 1.0 - shade, 0.5, 0.01)))
    });
    let pipeline = Coloured { vertices: vertices.collect() };
    let triangles: Vec<_> =
        (0..count).flat_map(|i| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]]).collect();
    let few: Vec<_> = triangles[..20].to_vec();
    let draw = |triangles: &[[u32; 3]], tile_size: TileSize| {
        let mut pass = Pass::new();
        pass.triangles(Draw {
            blend_mode: BlendMode::Translucent,
            culling: Culling::None,
            ..Draw::new(&pipeline, triangles)
        });
        draw_sized(&pass, [20, 17], &ExecuteSettings { tile_size, ..Default::default() })
            .linear
            .expect("asked for")
    };
    let many = draw(&triangles, TileSize::Pixels64);
    assert!(many == draw(&triangles, TileSize::Pixels8), "another cut");
    for (many, few) in many.iter().zip(draw(&few, TileSize::Pixels64)) {
        assert_eq!(many.w > 0.0, few.w > 0.0, "the same pixels as with few layers");
        // 0.99 to the power of 5000 is 10⁻²²; near 1 each layer rounds by half a unit of f32,
        // and what is missing shrinks by a hundredth with each: it stays within 100 of those.
        let missing = 1.0 - many.w;
        assert!(many.w == 0.0 || missing <= 50.0 * f32::EPSILON, "light shines through: {many}");
    }
}

/// Draws that use few of many vertices run only those that they use.
#[test]
fn unused_vertices_between_used_ones_are_not_run() {
    let count = 1_000_000;
    let mut vertices = vec![(Vec4::NAN, Vec4::NAN); count];
    let used = [3, count / 2, count - 1];
    for (slot, [x, y]) in used.into_iter().zip([[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]]) {
        vertices[slot] = (Vec4::new(x, y, 0.5, 1.0), Vec4::new(x * x, y * y, 0.5, 1.0));
    }
    let pipeline = Coloured { vertices };
    let triangles = [used.map(|index| index as u32), [3, 4, u32::MAX]];
    let dense = Coloured { vertices: used.map(|index| pipeline.vertices[index]).to_vec() };
    let execute = |pipeline: &Coloured, triangles: &[[u32; 3]]| {
        let mut target = Target::new(20, 20, &[Output::Linear, Output::Depth]).expect("a size in range");
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(pipeline, triangles) });
        let stats = Rasterizer::default().draw(&pass, &mut target);
        (target.into_images(), stats)
    };
    let (sparse, stats) = execute(&pipeline, &triangles);
    assert!(sparse == execute(&dense, &[[0, 1, 2]]).0, "the same image as with these vertices alone");
    assert!(stats.vertices <= 4, "{} vertices were run", stats.vertices);
    assert_eq!(stats.invalid, 1, "an index out of range");
}
