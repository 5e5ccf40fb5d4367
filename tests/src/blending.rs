//! Translucent layers: against a plain f64 reference, in any order of draws, and
//! the same bytes however many layers are held at a time.

use crate::coverage_support::{SIDE, Samples, clip_position, draw, levels, pixel, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::Vec4;
use trigon_raster::{
    Background, BlendMode, Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, TileSize,
    VertexOutput,
};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, sample_points};

/// A triangle of one depth and one premultiplied colour.
#[derive(Clone, Debug)]
struct Layer {
    corners: [GridPoint; 3],
    depth: f32,
    color: Vec4,
    object: u32,
}

impl Pipeline for Layer {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: clip_position(self.corners[index], self.depth), varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        self.color
    }
}

/// Layers of few depths, so that many are equal; each an object of its own.
fn layers(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Layer>> {
    let point = || [-2000..SIDE * 256 + 2000, -2000..SIDE * 256 + 2000];
    let color = [0.0_f32..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0];
    let layer = ([point(), point(), point()], 0..7_u8, color).prop_map(|(corners, depth, [r, g, b, a])| {
        let color = Vec4::new(r * a, g * a, b * a, a);
        Layer { corners, depth: 0.1 + 0.1 * f32::from(depth), color, object: 0 }
    });
    proptest::collection::vec(layer, count).prop_map(|mut layers| {
        for (object, layer) in (0..).zip(&mut layers) {
            layer.object = object;
        }
        layers
    })
}

const BEHIND: Vec4 = Vec4::new(0.2, 0.4, 0.1, 0.5);

fn record(layers: &[Layer], order: impl Iterator<Item = usize>) -> Pass<'_> {
    let mut pass = Pass::new();
    pass.background(Background::Color(BEHIND));
    for layer in order.map(|index| &layers[index]) {
        let (surface, culling) = (BlendMode::Translucent, Culling::None);
        pass.triangles(Draw {
            blend_mode: surface,
            culling,
            object: layer.object,
            ..Draw::new(layer, &[[0, 1, 2]])
        });
    }
    pass
}

/// The layers over each other at a point, in f64: from back to front, the smaller
/// object in front of equally deep ones. Also how many they are.
fn reference(layers: &[Layer], point: GridPoint) -> ([f64; 4], u32) {
    let mut here: Vec<_> = layers.iter().filter(|layer| covers(layer.corners, point)).collect();
    here.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(b.object.cmp(&a.object)));
    let mut color = BEHIND.to_array().map(f64::from);
    for layer in &here {
        let source = layer.color.to_array().map(f64::from);
        color = std::array::from_fn(|i| source[i] + color[i] * (1.0 - source[3]));
    }
    (color, here.len() as u32)
}

/// How far f32 may be off after so many layers, each with a coverage of 1. With u
/// = 2^-24, `1 - a` and its product with a value of at most 1 are each off by a
/// share of u, and the sum, at most 1, by u: 3 u for a layer. What a layer receives
/// with an error it passes on times `1 - a`, so at most as it is. The mean of up to
/// 16 samples rounds 16 times more.
fn bound(layers: u32) -> f64 {
    f64::from(3 * layers + 16) / f64::from(1 << 24)
}

/// Holds every pixel against the mean of its samples in f64.
fn check(layers: &[Layer], samples: u32, linear: &[Vec4]) {
    for (index, color) in linear.iter().enumerate() {
        let (mut sum, mut deepest) = ([0.0; 4], 0);
        for point in sample_points(samples, pixel(index)) {
            let (color, count) = reference(layers, point);
            sum = std::array::from_fn(|i| sum[i] + color[i] / f64::from(samples));
            deepest = deepest.max(count);
        }
        for channel in 0..4 {
            let error = (f64::from(color[channel]) - sum[channel]).abs();
            assert!(error <= bound(deepest), "{error:e} off with {deepest} layers at {:?}", pixel(index));
        }
    }
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn layers_blend_as_in_f64(layers in layers(1..60), samples in prop_oneof![Just(1_u32), Just(4), Just(16)]) {
        let mut target = Samples { per_axis: 1, per_pixel: samples }.target([SIDE as u32; 2], &[Output::Linear]);
        rasterizer(&ExecuteSettings::default()).draw(&record(&layers, 0..layers.len()), &mut target);
        check(&layers, samples, target.linear().expect("asked for"));
    }
}

proptest! {
    #![proptest_config(cases(10))]

    /// A tile of 8 by 8 pixels has room for all layers at once, and one of 64 by 64
    /// for eight at a time.
    #[test]
    fn neither_the_order_nor_the_room_changes_a_byte(
        layers in layers(1..90),
        samples in Samples::any(),
        step in prop_oneof![Just(1_usize), Just(7), Just(31)],
    ) {
        let image = |order: &mut dyn Iterator<Item = usize>, settings: &ExecuteSettings| {
            let mut target = samples.target([SIDE as u32; 2], &[Output::Linear]);
            rasterizer(settings).draw(&record(&layers, order), &mut target);
            target.into_images()
        };
        let count = layers.len();
        let reference = image(&mut (0..count), &ExecuteSettings::default());
        if samples.per_axis == 1 {
            check(&layers, samples.per_pixel, reference.linear.as_ref().expect("asked for"));
        }
        prop_assert!(image(&mut (0..count).rev(), &ExecuteSettings::default()) == reference, "reversed");
        if count % step != 0 || step == 1 {
            let shuffled = &mut (0..count).map(|index| index * step % count);
            prop_assert!(image(shuffled, &ExecuteSettings::default()) == reference, "shuffled");
        }
        for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64] {
            let settings = ExecuteSettings { tile_size, ..Default::default() };
            prop_assert!(image(&mut (0..count), &settings) == reference, "{tile_size:?}");
        }
        for (level, threads) in levels().zip([1, 2, 3].into_iter().cycle()) {
            let settings =
                ExecuteSettings { simd: Some(level), threads: NonZeroUsize::new(threads), ..Default::default() };
            prop_assert!(image(&mut (0..count), &settings) == reference, "{settings:?}");
        }
    }
}

/// Layers behind an opaque wall are not laid, those in its plane are if their
/// object is the smaller one.
#[test]
fn what_an_opaque_wall_hides_is_not_laid() {
    let corners = [[-100, -100], [-100, 4 * SIDE * 256], [4 * SIDE * 256, -100]];
    let wall = Layer { corners, depth: 0.5, color: Vec4::new(0.0, 0.0, 1.0, 1.0), object: 5 };
    for (depth, object, is_seen) in
        [(0.4, 1, false), (0.5, 4, true), (0.5, 6, false), (0.6, 9, true), (0.0, 0, false)]
    {
        let layer = Layer { corners, depth, color: Vec4::new(0.5, 0.0, 0.0, 0.5), object };
        let mut pass = Pass::new();
        pass.triangles(Draw { object: 5, culling: Culling::None, ..Draw::new(&wall, &[[0, 1, 2]]) });
        let (surface, culling) = (BlendMode::Translucent, Culling::None);
        pass.triangles(Draw { blend_mode: surface, culling, object, ..Draw::new(&layer, &[[0, 1, 2]]) });
        let linear = draw(&pass).linear.expect("asked for");
        let expected = if is_seen { Vec4::new(0.5, 0.0, 0.5, 1.0) } else { wall.color };
        assert!(linear.iter().all(|&color| color == expected), "depth {depth}, object {object}");
    }
}
