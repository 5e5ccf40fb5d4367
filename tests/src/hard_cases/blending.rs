//! Many layers over each other: clear, solid and between, in any order.

use crate::coverage_support::{Samples, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{
    Background, BlendMode, Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, TileSize,
    VertexOutput,
};

const SIZE: [u32; 2] = [24, 16];

/// A layer over all of the image.
#[derive(Clone, Copy, Debug)]
struct Layer {
    depth: f32,
    /// Premultiplied.
    color: Vec4,
}

impl Pipeline for Layer {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        let [x, y] = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]][index];
        VertexOutput { position: Vec4::new(x, y, self.depth, 1.0), varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        self.color
    }
}

fn layer() -> impl Strategy<Value = Layer> {
    let alpha = prop_oneof![1 => Just(0.0_f32), 1 => Just(1.0), 4 => 0.0_f32..1.0];
    // Few depths, so that many are equal.
    (1..40_u8, alpha, [0.0_f32..1.0, 0.0..1.0, 0.0..1.0]).prop_map(|(depth, alpha, [r, g, b])| Layer {
        depth: f32::from(depth) / 50.0,
        color: Vec4::new(r * alpha, g * alpha, b * alpha, alpha),
    })
}

const BEHIND: Vec4 = Vec4::new(0.3, 0.1, 0.6, 1.0);

/// One pixel of the layers, drawn in an order; all pixels are the same.
fn blended(layers: &[Layer], order: impl Iterator<Item = usize>, tile_size: TileSize) -> Vec4 {
    let mut pass = Pass::new();
    pass.background(Background::Color(BEHIND));
    for index in order {
        let (surface, culling, object) = (BlendMode::Translucent, Culling::None, index as u32);
        pass.triangles(Draw {
            blend_mode: surface,
            culling,
            object,
            ..Draw::new(&layers[index], &[[0, 1, 2]])
        });
    }
    let mut target = Samples::ONE.target(SIZE, &[Output::Linear]);
    rasterizer(&ExecuteSettings { tile_size, ..Default::default() }).draw(&pass, &mut target);
    let linear = target.linear().expect("asked for");
    assert!(linear.iter().all(|color| *color == linear[0]), "the same all over");
    linear[0]
}

/// From back to front in f64, the smaller object in front of equally deep ones.
fn reference(layers: &[Layer]) -> [f64; 4] {
    let mut order: Vec<_> = (0..layers.len()).collect();
    order.sort_by(|&a, &b| layers[a].depth.total_cmp(&layers[b].depth).then(b.cmp(&a)));
    order.into_iter().fold(BEHIND.to_array().map(f64::from), |below, index| {
        let source = layers[index].color.to_array().map(f64::from);
        std::array::from_fn(|i| source[i] + below[i] * (1.0 - source[3]))
    })
}

/// For each layer `1 - a`, its product and the sum are rounded, each by 2^-24 of at
/// most 1, and what is below comes through no larger than it is.
fn is_close(found: Vec4, layers: &[Layer]) {
    let bound = 3.0 * layers.len() as f64 / f64::from(1 << 24);
    for (channel, exact) in reference(layers).into_iter().enumerate() {
        let error = (f64::from(found[channel]) - exact).abs();
        assert!(error <= bound, "channel {channel} is {error:e} off");
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn sixty_four_layers_blend_as_in_f64_in_any_order(
        layers in proptest::collection::vec(layer(), 64),
        step in prop::sample::select(&[3_usize, 7, 31, 33][..]),
        tile_size in prop::sample::select(&[TileSize::Pixels8, TileSize::Pixels64][..]),
    ) {
        let forward = blended(&layers, 0..64, tile_size);
        prop_assert_eq!(blended(&layers, (0..64).rev(), tile_size), forward, "reversed");
        prop_assert_eq!(blended(&layers, (0..64).map(|i| i * step % 64), tile_size), forward, "shuffled");
        is_close(forward, &layers);
    }

    /// What is clear changes no bit, and what is solid hides all behind it to the bit.
    #[test]
    fn clear_layers_change_nothing_and_solid_ones_hide(layers in proptest::collection::vec(layer(), 64)) {
        let all = blended(&layers, 0..64, TileSize::Pixels64);
        is_close(all, &layers);
        let visible = |index: &usize| layers[*index].color.w > 0.0;
        prop_assert_eq!(blended(&layers, (0..64).filter(visible), TileSize::Pixels64), all, "without the clear ones");
        let nearer = |a: usize, b: usize| layers[a].depth.total_cmp(&layers[b].depth).then(b.cmp(&a)).is_ge();
        let solid = (0..64).filter(|&index| layers[index].color.w == 1.0).reduce(|a, b| if nearer(a, b) { a } else { b });
        if let Some(solid) = solid {
            let before = (0..64).filter(|&index| nearer(index, solid));
            prop_assert_eq!(blended(&layers, before, TileSize::Pixels64), all, "without what it hides");
        }
    }
}

/// More of them than a tile of 64 by 64 pixels has room for; each lets so much
/// through that all of them count.
#[test]
fn a_thousand_layers_are_all_laid() {
    let layer = |i: u16| {
        let (shade, alpha) = (f32::from(i * 37 % 101) / 101.0, 1.0 / 512.0);
        let color = Vec4::new(shade * alpha, (1.0 - shade) * alpha, alpha, alpha);
        Layer { depth: f32::from(i * 7 % 1000) / 1001.0, color }
    };
    let layers: Vec<_> = (0..1000).map(layer).collect();
    for tile_size in [TileSize::Pixels8, TileSize::Pixels64] {
        is_close(blended(&layers, 0..layers.len(), tile_size), &layers);
    }
}
