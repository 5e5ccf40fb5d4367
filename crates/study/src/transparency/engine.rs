//! The engine's translucent surfaces, which it sorts in each sample.

use super::{SHOWS, Way, lights};
use crate::engine::{Engine, field, target};
use crate::visibility::clip_corners;
use trigon_classic::{Field, Scene};
use trigon_math::Vec4;
use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};
use trigon_raster::{
    BlendMode, Culling, Draw, FragmentLanes, LanePipeline, Output, Pass, Target, VertexLanes,
};

/// Faces with corners of their own.
struct Faces {
    corners: Vec<Vec4>,
    /// Of each face, with the share of it that covers what is behind.
    lights: Vec<f32>,
}

impl LanePipeline for Faces {
    const VARYINGS: usize = 0;

    fn vertex_count(&self) -> usize {
        self.corners.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        crate::engine::positions(simd, vertices, &self.corners)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let lights = fragments.primitives().each(
            #[inline(always)]
            |face| self.lights[face as usize],
        );
        let light = F32::simd_from(simd, lights);
        [light, light, light, F32::splat(simd, (1.0 - SHOWS) as f32)]
    }
}

/// A scene and what it takes to draw it again and again.
pub(super) struct Drawer {
    faces: Faces,
    triangles: Vec<[u32; 3]>,
    engine: Engine,
    target: Target<'static>,
}

impl Drawer {
    pub(super) fn new(scene: &Scene) -> Self {
        Self {
            faces: Faces {
                corners: clip_corners(scene),
                lights: lights(scene).into_iter().map(|light| (light * (1.0 - SHOWS)) as f32).collect(),
            },
            triangles: (0..scene.face_count() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            engine: Engine::default(),
            target: target(scene.size(), &[Output::Linear]),
        }
    }
}

impl Way for Drawer {
    fn draw(&mut self, _: &Scene) {
        let mut pass = Pass::new();
        let surface = BlendMode::Translucent;
        let draw = Draw::new(&self.faces, &self.triangles);
        pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..draw });
        self.engine.rasterizer.draw(&pass, &mut self.target);
    }

    fn image(&self) -> Field<f64> {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.linear()).map(|color| color.x.into())
    }
}
