//! In which order are translucent faces blended? In submission order, sorted by body, sorted by face, and
//! sorted by fragment in each pixel.

use std::cmp::Reverse;

use trigon_classic::{Field, Scene, Surface};
use trigon_math::{SplitMix64, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, Simd};
use trigon_raster::{
    BlendMode, Culling, Draw, FragmentLanes, LanePipeline, Output, Pass, Target, VertexLanes,
};

use super::engine::{Engine, field, target};
use super::metric::Difference;
use super::oracle::depth;
use super::oracle::depth::Nearness;
use super::visibility::clip_corners;

/// A way to order what is translucent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transparency {
    /// As faces come.
    Unsorted,
    /// Bodies by the depth of their middle.
    ByBody,
    /// Faces by the depth of their middle.
    ByFace,
    /// Fragments, in each pixel.
    ByFragment,
    /// The renderer.
    Engine,
}

impl Transparency {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Unsorted, Self::ByBody, Self::ByFace, Self::ByFragment, Self::Engine];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unsorted => "unsorted",
            Self::ByBody => "sorted by body",
            Self::ByFace => "sorted by face",
            Self::ByFragment => "sorted in each pixel",
            Self::Engine => "engine",
        }
    }

    /// The light of each pixel before black, every face letting half of it through.
    #[must_use]
    pub fn draw(self, scene: &Scene) -> Field<f64> {
        let mut way = self.way(scene);
        way.draw(scene);
        way.image()
    }

    /// What draws a scene again and again, with all memory kept.
    #[must_use]
    pub fn repeated(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        let mut way = self.way(scene);
        Box::new(move || way.draw(scene))
    }

    fn way(self, scene: &Scene) -> Box<dyn Way> {
        match self {
            Self::Unsorted => Box::new(Faces::new(scene, |_, _| 0)),
            Self::ByBody => Box::new(Faces::new(scene, depth_of_body)),
            Self::ByFace => Box::new(Faces::new(scene, depth_of_face)),
            Self::ByFragment => Box::new(Fragments::new(scene)),
            Self::Engine => Box::new(TranslucentDrawer::new(scene)),
        }
    }

    /// How far that is from [`exact`].
    #[must_use]
    pub fn error(self, scene: &Scene, exact: &Field<f64>) -> Difference {
        let drawn = self.draw(scene);
        let pairs = exact.pixels().filter(|(_, light)| **light > 0.0);
        Difference::of(pairs.map(|(position, &light)| [drawn[position], light]))
    }
}

/// A way to order faces, with the memory that it draws in.
trait Way {
    fn draw(&mut self, scene: &Scene);

    /// What was drawn last.
    fn image(&self) -> Field<f64>;
}

/// The light of each pixel with all faces in the order of their [`Nearness`], of equal ones the
/// later first.
#[must_use]
pub fn exact(scene: &Scene) -> Field<f64> {
    let mut layers: Field<Vec<(Nearness, Reverse<u32>)>> = Field::new(scene.size(), Vec::new());
    for (number, face) in scene.faces() {
        for pixel in depth::pixels(face.corners, scene.size()) {
            let nearness = Nearness::of(face.corners, pixel);
            layers[pixel.map(|part| part as usize)]
                .extend(nearness.map(|nearness| (nearness, Reverse(number))));
        }
    }
    layers.values_mut().iter_mut().for_each(|layers| layers.sort());
    layers.map(|layers| layers.iter().fold(0.0, |below, (_, Reverse(face))| (below + light(*face)) / 2.0))
}

/// How much of what is behind a face shows.
const SHOWS: f64 = 0.5;

/// The light of a face, a number of its own for each.
fn light(face: u32) -> f64 {
    SplitMix64::new(face.into()).between(0.1, 1.0)
}

/// The lights of all faces of a scene.
fn lights(scene: &Scene) -> Vec<f64> {
    scene.faces().map(|(number, _)| light(number)).collect()
}

/// Faces with corners of their own.
struct FacePipeline {
    corners: Vec<Vec4>,
    /// Of each face, with the share of it that covers what is behind.
    lights: Vec<f32>,
}

impl LanePipeline for FacePipeline {
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
struct TranslucentDrawer {
    faces: FacePipeline,
    triangles: Vec<[u32; 3]>,
    engine: Engine,
    target: Target<'static>,
}

impl TranslucentDrawer {
    fn new(scene: &Scene) -> Self {
        Self {
            faces: FacePipeline {
                corners: clip_corners(scene),
                lights: lights(scene).into_iter().map(|light| (light * (1.0 - SHOWS)) as f32).collect(),
            },
            triangles: (0..scene.face_count() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            engine: Engine::default(),
            target: target(scene.size(), &[Output::Linear]),
        }
    }
}

impl Way for TranslucentDrawer {
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

/// What faces are sorted by, in ascending order.
type Key = fn(&Scene, u32) -> i64;

/// Whole faces blended one after the other, the farthest first (T. Porter and T. Duff, "Compositing digital
/// images", SIGGRAPH 1984).
///
/// Faces in the order of a key; equal ones as they come.
struct Faces {
    key: Key,
    order: Vec<u32>,
    lights: Vec<f64>,
    image: Field<f64>,
}

impl Faces {
    fn new(scene: &Scene, key: Key) -> Self {
        Self { key, order: Vec::new(), lights: lights(scene), image: Field::new(scene.size(), 0.0) }
    }
}

impl Way for Faces {
    fn draw(&mut self, scene: &Scene) {
        let Self { key, order, lights, image } = self;
        order.clear();
        order.extend(scene.faces().map(|(number, _)| number));
        order.sort_by_key(|&number| key(scene, number));
        image.clear(0.0);
        for &number in &*order {
            let Some(surface) = Surface::new(scene.face(number)) else { continue };
            let light = lights[number as usize] * (1.0 - SHOWS);
            surface.each_pixel(scene.limits(), |pixel, _| {
                let below = &mut image[pixel.map(|part| part as usize)];
                *below = *below * SHOWS + light;
            });
        }
    }

    fn image(&self) -> Field<f64> {
        self.image.clone()
    }
}

/// Three times the depth of a face's middle.
fn depth_of_face(scene: &Scene, number: u32) -> i64 {
    scene.face(number).corners.iter().map(|corner| i64::from(corner[2])).sum()
}

/// The depth of the middle of a face's body.
fn depth_of_body(scene: &Scene, number: u32) -> i64 {
    let corners = &scene.bodies()[scene.face(number).body].corners;
    corners.iter().map(|corner| i64::from(corner[2])).sum::<i64>() / corners.len() as i64
}

/// Fragments are stored and sorted in each pixel (L. Carpenter, "The A-buffer, an antialiased hidden surface
/// method", SIGGRAPH 1984, without its masks).
///
/// The fragments of all pixels, in lists that keep their memory.
struct Fragments {
    /// The depth and the face of each.
    lists: Field<Vec<(f64, u32)>>,
    lights: Vec<f64>,
    image: Field<f64>,
}

impl Fragments {
    fn new(scene: &Scene) -> Self {
        Self {
            lists: Field::new(scene.size(), Vec::new()),
            lights: lights(scene),
            image: Field::new(scene.size(), 0.0),
        }
    }
}

impl Way for Fragments {
    fn draw(&mut self, scene: &Scene) {
        self.lists.values_mut().iter_mut().for_each(Vec::clear);
        for (number, face) in scene.faces() {
            let Some(surface) = Surface::new(face) else { continue };
            surface.each_pixel(scene.limits(), |pixel, depth| {
                self.lists[pixel.map(|part| part as usize)].push((depth, number));
            });
        }
        let lists = self.lists.values_mut().iter_mut();
        for (list, pixel) in lists.zip(self.image.values_mut()) {
            list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            *pixel = list.iter().fold(0.0, |below, &(_, number)| {
                below * SHOWS + self.lights[number as usize] * (1.0 - SHOWS)
            });
        }
    }

    fn image(&self) -> Field<f64> {
        self.image.clone()
    }
}

#[cfg(test)]
mod tests;
