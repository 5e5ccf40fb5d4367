//! Pipelines in lanes, flat ones and scalar ones: the same program gives the same
//! image, however it is written.

use crate::coverage_support::{SIDE, Samples, rasterizer};
use crate::effort::cases;
use crate::programs::{Flat, Lanes, Scalar, ScalarFlat, ScalarTextured, Textured, Vertices};
use proptest::prelude::*;
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use trigon_math::Vec4;
use trigon_raster::simd::{F32, Simd};
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, FragmentLanes, LanePipeline, MipFilter, Output, Pass, Sampler,
    TargetImages, Texture, TextureFormat, VertexLanes,
};

fn vertices() -> impl Strategy<Value = Vertices> {
    let position = (-1.5_f32..1.5, -1.5_f32..1.5, 0.0_f32..1.0, -0.2_f32..3.0)
        .prop_map(|(x, y, z, w)| Vec4::new(x * w, y * w, z * w, w));
    let color = (0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0, 0.2_f32..1.0).prop_map(Vec4::from);
    proptest::collection::vec((position, color), 3..40).prop_map(|list| {
        let mut vertices = Vertices::default();
        for (position, color) in list {
            vertices.push(position, color);
        }
        vertices
    })
}

fn triangles(vertices: &Vertices) -> Vec<[u32; 3]> {
    let count = vertices.len() as u32;
    (0..count).map(|i| [i, (i + 1) % count, (i + 5) % count]).collect()
}

fn surface() -> impl Strategy<Value = BlendMode> {
    prop_oneof![Just(BlendMode::Opaque), Just(BlendMode::Masked), Just(BlendMode::Translucent)]
}

fn draw<P: LanePipeline>(
    pipeline: &P,
    triangles: &[[u32; 3]],
    surface: BlendMode,
    samples: Samples,
) -> TargetImages {
    let mut pass = Pass::new();
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(pipeline, triangles) });
    let outputs = [Output::Linear, Output::Depth, Output::Triangle];
    let mut target = samples.target([SIDE as u32; 2], &outputs);
    rasterizer(&ExecuteSettings::default()).draw(&pass, &mut target);
    target.into_images()
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn lanes_draw_what_the_scalar_form_draws(
        vertices in vertices(),
        surface in surface(),
        samples in Samples::any(),
    ) {
        let triangles = triangles(&vertices);
        let scalar = draw(&Scalar(&vertices), &triangles, surface, samples);
        prop_assert!(draw(&Lanes(&vertices), &triangles, surface, samples) == scalar);
    }

    #[test]
    fn flat_pipelines_draw_what_the_scalar_form_draws(
        vertices in vertices(),
        surface in surface(),
        samples in Samples::any(),
    ) {
        let triangles = triangles(&vertices);
        let scalar = draw(&ScalarFlat(&vertices), &triangles, surface, samples);
        prop_assert!(draw(&Flat(&vertices), &triangles, surface, samples) == scalar);
    }

    #[test]
    fn textures_in_lanes_are_textures_one_by_one(
        vertices in vertices(),
        samples in Samples::any(),
        probes in 1..=16_u8,
        srgb in any::<bool>(),
    ) {
        let triangles = triangles(&vertices);
        let texels = (0..20 * 12_u32).map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()).collect();
        let format = if srgb { TextureFormat::Srgb } else { TextureFormat::Linear };
        let texture = Texture::new(20, 12, texels, format).expect("as many texels as it has");
        let sampler = Sampler { mip: MipFilter::Anisotropic(probes), ..Sampler::default() };
        let textured = || Textured { vertices: &vertices, texture: &texture, sampler };
        let scalar = draw(&ScalarTextured(textured()), &triangles, BlendMode::Opaque, samples);
        prop_assert!(draw(&textured(), &triangles, BlendMode::Opaque, samples) == scalar);
    }

    /// In one tile, and with no triangle cut: as many as triangles that are seen.
    #[test]
    fn flat_pipelines_are_asked_once_for_each_triangle(vertices in vertices()) {
        let vertices = vertices.in_front();
        let triangles = triangles(&vertices);
        let pipeline = Counting { flat: Flat(&vertices), asked: AtomicUsize::new(0) };
        let images = draw(&pipeline, &triangles, BlendMode::Opaque, Samples::ONE);
        let seen: HashSet<u32> = images.triangles.into_iter().flatten().filter(|&id| id != u32::MAX).collect();
        prop_assert_eq!(pipeline.asked.into_inner(), seen.len());
    }
}

/// A flat pipeline that counts how many triangles it is asked about.
struct Counting<'a> {
    flat: Flat<'a>,
    asked: AtomicUsize,
}

impl LanePipeline for Counting<'_> {
    const VARYINGS: usize = Flat::VARYINGS;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.flat.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.flat.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        self.asked.fetch_add(fragments.active().count_ones() as usize, Ordering::Relaxed);
        self.flat.fragments(simd, fragments)
    }
}
