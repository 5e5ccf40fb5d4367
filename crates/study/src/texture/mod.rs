//! How many texels does a pixel need? The engine's filters on a floor that extends to the horizon, compared
//! with the mean over each pixel.

use trigon_classic::Field;
use trigon_math::{DVec2, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};
use trigon_raster::{
    Culling, Draw, Filter, FragmentLanes, LanePipeline, MipFilter, Output, Pass, Sampler, Target, Texture,
    TextureFormat, VertexLanes,
};

use super::engine::{Engine, clip_position, field, positions, target};
use super::metric::Difference;

/// A way to look a texture up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TextureFilter {
    /// The texel in the middle.
    Nearest,
    /// Four texels of the base level.
    Bilinear,
    /// Four texels of each of two levels.
    Trilinear,
    /// So many such look-ups along the longer side of a pixel's footprint.
    Anisotropic(u8),
}

impl TextureFilter {
    /// All methods that are compared.
    pub const ALL: [Self; 6] = [
        Self::Nearest,
        Self::Bilinear,
        Self::Trilinear,
        Self::Anisotropic(2),
        Self::Anisotropic(4),
        Self::Anisotropic(16),
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Nearest => "nearest".to_owned(),
            Self::Bilinear => "bilinear".to_owned(),
            Self::Trilinear => "trilinear".to_owned(),
            Self::Anisotropic(probes) => format!("anisotropic {probes}"),
        }
    }

    fn sampler(self) -> Sampler {
        let (filter, mip) = match self {
            Self::Nearest => (Filter::Nearest, MipFilter::None),
            Self::Bilinear => (Filter::Linear, MipFilter::None),
            Self::Trilinear => (Filter::Linear, MipFilter::Linear),
            Self::Anisotropic(probes) => (Filter::Linear, MipFilter::Anisotropic(probes)),
        };
        Sampler { magnification: filter, minification: filter, mip, ..Sampler::default() }
    }

    /// The light of each pixel.
    #[must_use]
    pub fn draw(self, ground: &Ground) -> Field<f64> {
        let mut drawer = FloorDrawer::new(ground);
        drawer.draw(self);
        drawer.light()
    }

    /// How far that is from the mean of what each pixel sees.
    #[must_use]
    pub fn error(self, ground: &Ground, right: &Field<f64>) -> Difference {
        let drawn = self.draw(ground);
        Difference::of(right.pixels().map(|(pixel, &light)| [drawn[pixel], light]))
    }
}

/// The mean light of 16 by 16 points in each pixel, no filter at any.
#[must_use]
pub fn exact(ground: &Ground) -> Field<f64> {
    const POINTS: usize = 16;
    Field::from_fn(ground.size(), |[x, y]| {
        let pixel = |i: usize| (i as f64 + 0.5) / POINTS as f64;
        let points =
            (0..POINTS).flat_map(|j| (0..POINTS).map(move |i| [x as f64 + pixel(i), y as f64 + pixel(j)]));
        points.map(|point| ground.light(point)).sum::<f64>() / (POINTS * POINTS) as f64
    })
}

/// The corners of the floor on the image, with their texture coordinates.
struct Floor {
    positions: Vec<Vec4>,
    coordinates: [[f32; 8]; 2],
}

impl Floor {
    fn new(ground: &Ground) -> Self {
        let size = ground.size();
        let [width, height] = size.map(|side| side as f64);
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let position = |corner: [f64; 2]| {
            clip_position(DVec2::from(corner), 0.01, size) * ground.distance(corner) as f32
        };
        let mut coordinates = [[0.0; 8]; 2];
        for (lane, corner) in corners.into_iter().enumerate() {
            let [u, v] = ground.coordinates(corner);
            [coordinates[0][lane], coordinates[1][lane]] = [u as f32, v as f32];
        }
        Self { positions: corners.map(position).to_vec(), coordinates }
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        // Four vertices are one vector.
        for (axis, coordinates) in self.coordinates.into_iter().enumerate() {
            vertices.set(axis, F32::simd_from(simd, coordinates));
        }
        positions(simd, vertices, &self.positions)
    }
}

/// The floor with its texture.
struct FloorPipeline<'a> {
    floor: &'a Floor,
    texture: &'a Texture,
    sampler: Sampler,
}

impl LanePipeline for FloorPipeline<'_> {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.floor.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.floor.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [[ux, uy], [vx, vy]] = [fragments.gradient(0), fragments.gradient(1)];
        self.texture.sample_lanes(simd, fragments.varyings(0), [ux, vx], [uy, vy], &self.sampler)
    }
}

/// The floor with its coordinates as colours: all but the look-up.
struct Plain<'a>(&'a Floor);

impl LanePipeline for Plain<'_> {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.0.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.vertices(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v] = fragments.varyings(0);
        [u, v, F32::splat(simd, 0.0), F32::splat(simd, 1.0)]
    }
}

/// A floor and what it takes to draw it again and again.
pub struct FloorDrawer<'a> {
    ground: &'a Ground,
    floor: Floor,
    engine: Engine,
    target: Target<'static>,
}

impl<'a> FloorDrawer<'a> {
    /// Nothing is drawn yet.
    #[must_use]
    pub fn new(ground: &'a Ground) -> Self {
        let target = target(ground.size(), &[Output::Linear]);
        Self { ground, floor: Floor::new(ground), engine: Engine::default(), target }
    }

    /// Draws the floor through a filter.
    pub fn draw(&mut self, filter: TextureFilter) {
        let Self { ground, floor, engine, target } = self;
        let textured = FloorPipeline { floor, texture: ground.texture(), sampler: filter.sampler() };
        draw(&textured, engine, target);
    }

    /// Draws the floor without its texture.
    pub fn draw_plain(&mut self) {
        let Self { floor, engine, target, .. } = self;
        draw(&Plain(floor), engine, target);
    }

    /// The light of each pixel as it was drawn last.
    #[must_use]
    pub fn light(&self) -> Field<f64> {
        field(self.ground.size(), self.target.linear()).map(|color| color.x.into())
    }
}

fn draw(pipeline: &impl LanePipeline, engine: &mut Engine, target: &mut Target<'_>) {
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(pipeline, &[[0, 1, 2], [0, 2, 3]]) });
    engine.rasterizer.draw(&pass, target);
}

/// Squares of 8 texels, 64 texels to the metre, one metre below the eye.
pub struct Ground {
    width: usize,
    texture: Texture,
}

const SIDE: u32 = 64;
const SQUARE: u32 = 8;

/// Light and dark as bytes of linear light.
const TINTS: [u8; 2] = [230, 20];

impl Ground {
    /// In an image of `width` pixels, all of it below the horizon.
    #[must_use]
    pub fn new(width: usize) -> Self {
        let texel = |x: u32, y: u32| {
            let tint = TINTS[((x / SQUARE + y / SQUARE) % 2) as usize];
            [tint, tint, tint, 255]
        };
        let texels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| texel(x, y))).collect();
        let texture = Texture::new(SIDE, SIDE, texels, TextureFormat::Linear).expect("the size is in range");
        Self { width, texture }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.width / 2]
    }

    fn texture(&self) -> &Texture {
        &self.texture
    }

    /// How far ahead a point of the image lies on the floor, in metres.
    fn distance(&self, [_, y]: [f64; 2]) -> f64 {
        let scale = self.width as f64 / 2.0;
        // The horizon lies a twentieth of the height above the image.
        scale / (y + self.width as f64 / 40.0)
    }

    /// Texture coordinates at a point of the image, turned by 0.6 against it.
    fn coordinates(&self, point: [f64; 2]) -> [f64; 2] {
        const TURN: [f64; 2] = [0.8, 0.6];
        let (scale, ahead) = (self.width as f64 / 2.0, self.distance(point));
        let right = (point[0] - scale) / scale * ahead;
        [TURN[0] * right - TURN[1] * ahead, TURN[1] * right + TURN[0] * ahead]
    }

    /// The light at a point of the image: that of the texel it lies in.
    fn light(&self, point: [f64; 2]) -> f64 {
        let squares = self.coordinates(point).map(|part| (part * f64::from(SIDE / SQUARE)).floor() as i64);
        f64::from(TINTS[(squares[0] + squares[1]).rem_euclid(2) as usize]) / 255.0
    }
}

#[cfg(test)]
mod tests;
