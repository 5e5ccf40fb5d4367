//! Frames that go through every part of the rasterizer.

use crate::programs::{Flat, Lanes, Scalar, ScalarFlat, ScalarTextured, Textured, Vertices};
use std::ops::Range;
use trigon_math::{SplitMix64, Vec4};
use trigon_raster::{
    BlendMode, Culling, Draw, LanePipeline, Lines, MipFilter, Pass, PointShape, Points, Sampler, Smoothing,
    Texture, TextureFormat,
};

/// How many vertices there are: more than a worker takes at a time.
const COUNT: u32 = 3000;

/// A name and what it stands for.
pub(crate) type Kind = (&'static str, Pass<'static>);

pub(crate) fn kinds() -> Vec<Kind> {
    let seen = forever(vertices(0.5..3.0));
    surfaces(seen).into_iter().chain(programs(seen)).chain(lines_and_points(seen)).collect()
}

/// Passes borrow; a test may keep what they need for good.
fn forever<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

/// Small triangles and large ones all over the view, with `w` in a range.
fn vertices(w: Range<f32>) -> Vertices {
    let mut random = SplitMix64::new(1);
    let mut unit = || random.unit() as f32;
    let (mut vertices, mut middle) = (Vertices::default(), [0.0; 2]);
    for index in 0..COUNT {
        if index % 3 == 0 {
            middle = [unit(), unit()].map(|v| 2.4 * v - 1.2);
        }
        let reach = if index % 90 < 3 { 1.0 } else { 0.05 };
        let [x, y] = middle.map(|v| v + reach * (unit() - 0.5));
        let w = w.start + (w.end - w.start) * unit();
        let color = Vec4::new(unit(), unit(), unit(), 0.2 + 0.8 * unit());
        vertices.push(Vec4::new(x * w, y * w, (w - 0.2).min(0.1 + 0.8 * unit()), w), color);
    }
    vertices
}

fn triangles() -> &'static [[u32; 3]] {
    forever((0..COUNT / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect::<Vec<_>>())
}

fn pass(
    pipeline: impl LanePipeline + 'static,
    triangles: &'static [[u32; 3]],
    surface: BlendMode,
) -> Pass<'static> {
    let mut pass = Pass::new();
    let draw =
        Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(forever(pipeline), triangles) };
    pass.triangles(draw);
    pass
}

fn surfaces(seen: &'static Vertices) -> [Kind; 6] {
    let cut = forever(vertices(-1.0..3.0));
    let few: Vec<_> = (0..20).map(|i| [i * 7, i * 90 + 31, i * 140 + 2]).collect();
    let of = |surface| pass(Lanes(seen), triangles(), surface);
    [
        ("opaque", of(BlendMode::Opaque)),
        ("masked", of(BlendMode::Masked)),
        ("masked per sample", of(BlendMode::MaskedPerSample)),
        ("translucent", of(BlendMode::Translucent)),
        ("cut", pass(Lanes(cut), triangles(), BlendMode::Opaque)),
        ("few of many vertices", pass(Lanes(seen), forever(few), BlendMode::Opaque)),
    ]
}

fn programs(seen: &'static Vertices) -> [Kind; 5] {
    let texels = (0..64 * 64_u32).map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()).collect();
    let texture =
        forever(Texture::new(64, 64, texels, TextureFormat::Srgb).expect("as many texels as it has"));
    let sampler = Sampler { mip: MipFilter::Anisotropic(8), ..Sampler::default() };
    let textured = Textured { vertices: seen, texture, sampler };
    let flat = forever(seen.clone().in_front());
    let opaque = BlendMode::Opaque;
    [
        ("flat", pass(Flat(flat), triangles(), opaque)),
        ("flat, one by one", pass(ScalarFlat(flat), triangles(), opaque)),
        ("one by one", pass(Scalar(seen), triangles(), opaque)),
        ("textured", pass(Textured { ..textured }, triangles(), opaque)),
        ("textured, one by one", pass(ScalarTextured(textured), triangles(), opaque)),
    ]
}

fn lines_and_points(seen: &'static Vertices) -> [Kind; 2] {
    let pipeline = forever(Lanes(seen));
    let segments = forever((0..COUNT - 1).map(|i| [i, i + 1]).collect::<Vec<_>>());
    let points = forever((0..COUNT).collect::<Vec<_>>());
    let both = |smoothing, shape| {
        let mut pass = Pass::new();
        pass.lines(Lines { smoothing, width: 2.5, ..Lines::new(pipeline, segments) });
        pass.points(Points { smoothing, shape, object: 1, ..Points::new(pipeline, points, 7.0) });
        pass
    };
    [
        ("sharp lines and points", both(Smoothing::Sharp, PointShape::Round)),
        ("anti-aliased lines and points", both(Smoothing::AntiAliased, PointShape::Square)),
    ]
}
