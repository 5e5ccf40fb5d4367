//! Which images the manifest holds.

use super::layouts::Layout;
use crate::programs::{Flat, Lanes, Scalar, Textured, Vertices};
use crate::samples::Samples;
use trigon_math::{UVec2, Vec4};
use trigon_raster::{
    Background, BlendMode, Culling, Draw, Filter, LanePipeline, Lines, MipFilter, Output, Pass, PointShape,
    Points, Rasterizer, Sampler, Smoothing, TargetImages, Texture, TextureFormat,
};

const SIZE: [u32; 2] = [96, 64];

/// Triangles without area that come with each image: a frame of so many is
/// shared among threads.
const IDLE: usize = 7000;

/// How vertices become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Program {
    Scalar,
    Lanes,
    Flat,
    Textured(TextureFormat, Filter, MipFilter),
}

/// What is made of the vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Triangles,
    Lines(Smoothing),
    Points(PointShape, Smoothing),
}

const EVERYTHING: &[Output] = &[
    Output::Srgb8,
    Output::Unorm8,
    Output::Linear,
    Output::Depth,
    Output::Object,
    Output::Face,
    Output::Triangle,
];

/// One image of the manifest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    shape: Shape,
    layout: Layout,
    program: Program,
    surface: BlendMode,
    samples: Samples,
    outputs: &'static [Output],
}

/// A ring in lanes, opaque, one sample, all outputs.
const USUAL: Case = Case {
    shape: Shape::Triangles,
    layout: Layout::Ring,
    program: Program::Lanes,
    surface: BlendMode::Opaque,
    samples: Samples::ONE,
    outputs: EVERYTHING,
};

const SURFACES: [BlendMode; 3] = [BlendMode::Opaque, BlendMode::Masked, BlendMode::Translucent];

fn multisampled(per_pixel: u32) -> Samples {
    Samples { per_axis: 1, per_pixel }
}

/// All images, each of another name.
pub(super) fn all() -> Vec<Case> {
    [samples(), shapes(), programs(), layouts(), outputs()].concat()
}

fn samples() -> Vec<Case> {
    let supersampled = [2, 3].map(|per_axis| Samples { per_axis, per_pixel: 1 });
    let patterns = [1, 2, 4, 8, 16].map(multisampled).into_iter().chain(supersampled);
    let images = patterns.flat_map(|samples| SURFACES.map(|surface| Case { surface, samples, ..USUAL }));
    let per_sample = [4, 8].map(|samples| Case {
        surface: BlendMode::MaskedPerSample,
        samples: multisampled(samples),
        ..USUAL
    });
    images.chain(per_sample).collect()
}

fn shapes() -> Vec<Case> {
    let shapes = [Shape::Lines(Smoothing::Sharp), Shape::Points(PointShape::Round, Smoothing::Sharp)];
    let cases = shapes.into_iter().flat_map(|shape| SURFACES.map(|surface| (shape, surface)));
    let cases = cases.flat_map(|case| [1, 4].map(|samples| (case, multisampled(samples))));
    let cases = cases.map(|((shape, surface), samples)| Case { shape, surface, samples, ..USUAL });
    let square = Case { shape: Shape::Points(PointShape::Square, Smoothing::Sharp), ..USUAL };
    cases.chain([square]).chain(smooth_shapes()).collect()
}

fn smooth_shapes() -> impl Iterator<Item = Case> {
    let points =
        [PointShape::Round, PointShape::Square].map(|shape| Shape::Points(shape, Smoothing::AntiAliased));
    let shapes = points.into_iter().chain([Shape::Lines(Smoothing::AntiAliased)]);
    shapes.flat_map(|shape| [1, 4].map(|samples| Case { shape, samples: multisampled(samples), ..USUAL }))
}

fn programs() -> Vec<Case> {
    let plain = [Program::Scalar, Program::Flat].into_iter();
    let plain = plain.flat_map(|program| {
        [(1, Layout::Scattered), (4, Layout::Ring)].map(|(samples, layout)| Case {
            program,
            layout,
            samples: multisampled(samples),
            ..USUAL
        })
    });
    let (linear, srgb) = (TextureFormat::Linear, TextureFormat::Srgb);
    let textured = [
        (linear, Filter::Nearest, MipFilter::None),
        (linear, Filter::Linear, MipFilter::None),
        (linear, Filter::Nearest, MipFilter::Nearest),
        (linear, Filter::Linear, MipFilter::Linear),
        (linear, Filter::Linear, MipFilter::Anisotropic(8)),
        (srgb, Filter::Linear, MipFilter::Linear),
        (srgb, Filter::Linear, MipFilter::Anisotropic(16)),
    ];
    let textured = textured.map(|(format, filter, mip)| Case {
        layout: Layout::Ground,
        program: Program::Textured(format, filter, mip),
        ..USUAL
    });
    plain.chain(textured).collect()
}

fn layouts() -> Vec<Case> {
    let layouts = [Layout::Ground, Layout::Scattered, Layout::Huge, Layout::Needles];
    let cases = layouts.into_iter().flat_map(|layout| [1, 8].map(|samples| (layout, samples)));
    cases.map(|(layout, samples)| Case { layout, samples: multisampled(samples), ..USUAL }).collect()
}

fn outputs() -> Vec<Case> {
    let outputs: [&[Output]; 5] = [
        &[Output::Srgb8],
        &[Output::Unorm8],
        &[Output::Linear],
        &[Output::Depth],
        &[Output::Object, Output::Face, Output::Triangle],
    ];
    outputs.into_iter().map(|outputs| Case { outputs, ..USUAL }).collect()
}

impl Case {
    /// What it shows, in words that no other image has.
    pub(super) fn name(&self) -> String {
        let Self { shape, layout, program, surface, samples, outputs } = self;
        let outputs = if *outputs == EVERYTHING { "[Everything]".to_owned() } else { format!("{outputs:?}") };
        let Samples { per_axis, per_pixel } = samples;
        format!("{shape:?} {layout:?} {program:?} {surface:?} {per_axis}x{per_axis}x{per_pixel} {outputs}")
    }

    /// Whether it is drawn by a scalar pipeline, which draws what lanes draw.
    pub(super) fn is_scalar(&self) -> bool {
        self.program == Program::Scalar
    }

    /// Draws it.
    pub(super) fn draw(&self, rasterizer: &mut Rasterizer) -> TargetImages {
        let (vertices, triangles) = self.layout.build();
        match self.program {
            Program::Scalar => self.run(rasterizer, &Scalar(&vertices), &triangles),
            Program::Lanes => self.run(rasterizer, &Lanes(&vertices), &triangles),
            Program::Flat => self.run(rasterizer, &Flat(&vertices), &triangles),
            Program::Textured(format, filter, mip) => {
                self.run_textured(rasterizer, (format, filter, mip), &vertices, &triangles)
            }
        }
    }

    fn run_textured(
        &self,
        rasterizer: &mut Rasterizer,
        (format, filter, mip): (TextureFormat, Filter, MipFilter),
        vertices: &Vertices,
        triangles: &[[u32; 3]],
    ) -> TargetImages {
        let texels = (0..48 * 32_u32).map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()).collect();
        let texture = Texture::new(48, 32, texels, format).expect("as many texels as it has");
        let sampler = Sampler { magnification: filter, minification: filter, mip, ..Sampler::default() };
        self.run(rasterizer, &Textured { vertices, texture: &texture, sampler }, triangles)
    }

    fn run<P: LanePipeline>(
        &self,
        rasterizer: &mut Rasterizer,
        pipeline: &P,
        triangles: &[[u32; 3]],
    ) -> TargetImages {
        let surface = self.surface;
        let segments: Vec<[u32; 2]> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]).collect();
        let points: Vec<u32> = (0..pipeline.vertex_count() as u32).collect();
        let background = |UVec2 { x, y }: UVec2| Vec4::new(x as f32 / 96.0, y as f32 / 64.0, 0.2, 1.0);
        let mut pass = Pass::new();
        pass.background(Background::PerPixel(&background));
        pass.triangles(Draw::new(pipeline, &[[0; 3]; IDLE]));
        match self.shape {
            Shape::Triangles => {
                let culling = Culling::None;
                pass.triangles(Draw {
                    object: 7,
                    blend_mode: surface,
                    culling,
                    ..Draw::new(pipeline, triangles)
                })
            }
            Shape::Lines(smoothing) => {
                let (object, width) = (8, 2.5);
                pass.lines(Lines {
                    object,
                    blend_mode: surface,
                    width,
                    smoothing,
                    ..Lines::new(pipeline, &segments)
                })
            }
            Shape::Points(shape, smoothing) => {
                let object = 9;
                pass.points(Points {
                    object,
                    blend_mode: surface,
                    shape,
                    smoothing,
                    ..Points::new(pipeline, &points, 7.0)
                })
            }
        };
        let mut target = self.samples.target(SIZE, self.outputs);
        rasterizer.draw(&pass, &mut target);
        target.into_images()
    }

    /// Whether a good part of it is not background.
    pub(super) fn is_worth_drawing(&self, rasterizer: &mut Rasterizer) -> bool {
        // What is laid over others leaves no ids.
        let surface = if self.surface == BlendMode::Translucent { BlendMode::Opaque } else { self.surface };
        let shape = match self.shape {
            Shape::Triangles => Shape::Triangles,
            Shape::Lines(_) => Shape::Lines(Smoothing::Sharp),
            Shape::Points(shape, _) => Shape::Points(shape, Smoothing::Sharp),
        };
        let seen = Self { outputs: &[Output::Object], surface, shape, ..*self }.draw(rasterizer);
        let objects = seen.objects.expect("asked for");
        objects.iter().filter(|&&object| object != u32::MAX).count() > objects.len() / 20
    }
}
