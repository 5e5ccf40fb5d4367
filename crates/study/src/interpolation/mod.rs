//! What does a division in each pixel buy? Texture coordinates on a wall in perspective: linear on the
//! screen, linear between divisions, divided in each pixel.

use std::ops::Range;

use trigon_classic::{Edges, Field};
use trigon_math::{DVec2, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, Simd};
use trigon_raster::{Culling, Draw, FragmentLanes, LanePipeline, Output, Pass, Target, VertexLanes};

use super::engine::{Engine, clip_position, field, target};
use super::oracle::{coverage, depth};

/// A method of interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Linear on the screen.
    Affine,
    /// Divided at every 16th pixel of a row, and linear between.
    Every16,
    /// Divided in each pixel.
    Perspective,
    /// The renderer.
    Engine,
}

impl Interpolation {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Affine, Self::Every16, Self::Perspective, Self::Engine];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::Every16 => "perspective every 16 pixels",
            Self::Perspective => "perspective",
            Self::Engine => "engine",
        }
    }

    /// The texel at the centre of each pixel of a wall; none outside of it.
    #[must_use]
    pub fn draw(self, wall: &Wall) -> Field<Option<Texel>> {
        if self == Self::Engine {
            let mut drawer = WallDrawer::new(wall);
            drawer.draw();
            return drawer.image();
        }
        let mut image = Field::new(wall.size, None);
        self.draw_into(wall, &mut image);
        image
    }

    /// Returns a closure that draws a wall repeatedly and keeps everything that can be kept.
    #[must_use]
    pub fn repeated(self, wall: &Wall) -> Box<dyn FnMut() + '_> {
        if self == Self::Engine {
            let mut drawer = WallDrawer::new(wall);
            return Box::new(move || drawer.draw());
        }
        let mut image = Field::new(wall.size, None);
        Box::new(move || {
            image.clear(None);
            self.draw_into(wall, &mut image);
        })
    }

    /// By one of the classical ways.
    fn draw_into(self, wall: &Wall, image: &mut Field<Option<Texel>>) {
        match self {
            Self::Affine => wall.draw_into(image, affine_row),
            Self::Every16 => wall.draw_into(image, row_of_spans),
            Self::Perspective => wall.draw_into(image, perspective_row),
            Self::Engine => {}
        }
    }

    /// The errors of the texels.
    pub fn errors(self, wall: &Wall) -> TexelErrors {
        let drawn = self.draw(wall);
        let distance = |(position, texel): ([usize; 2], &Option<Texel>)| {
            let [[u, v], [right_u, right_v]] = [texel.as_ref()?.map(f64::from), wall.texel(position)?];
            Some((u - right_u) * (u - right_u) + (v - right_v) * (v - right_v))
        };
        let squares: Vec<f64> = drawn.pixels().filter_map(distance).collect();
        TexelErrors {
            rms: (squares.iter().sum::<f64>() / squares.len() as f64).sqrt(),
            worst: squares.iter().copied().fold(0.0, f64::max).sqrt(),
        }
    }
}

/// Distances from the correct texel, in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelErrors {
    /// The root of the mean square.
    pub rms: f64,
    /// The greatest.
    pub worst: f64,
}

/// A division in each pixel (J. F. Blinn, "Hyperbolic interpolation", IEEE CG&A, 1992; source row D10 does
/// the same for depth).
#[inline]
fn perspective_row(row: &WallRow, pixels: &mut [Option<Texel>]) {
    for (x, pixel) in pixels.iter_mut().enumerate() {
        *pixel = Some(row.perspective(x));
    }
}

/// Linear on the screen (source row B4): correct for surfaces that face the camera, wrong for surfaces that
/// recede.
#[inline]
fn affine_row(row: &WallRow, pixels: &mut [Option<Texel>]) {
    for (x, pixel) in pixels.iter_mut().enumerate() {
        *pixel = Some(row.texel.map(|part| part.at(x)));
    }
}

const STEP: usize = 16;

/// A division at every 16th pixel of a row and at its end, and linear steps in between (M. Abrash, "Graphics
/// Programming Black Book", 1997, chapter 70, on Quake).
#[inline]
fn row_of_spans(row: &WallRow, pixels: &mut [Option<Texel>]) {
    let last = pixels.len() - 1;
    let mut here = row.perspective(0);
    for (start, span) in (0..).step_by(STEP).zip(pixels.chunks_mut(STEP)) {
        // To the first pixel of the next span, or to the last one of the row.
        let stop = (start + STEP).min(last);
        let there = row.perspective(stop);
        // A power of two but in the last span.
        let share = 1.0 / (stop - start).max(1) as f32;
        let steps = [0, 1].map(|axis| (there[axis] - here[axis]) * share);
        let mut texel = here;
        for pixel in span {
            *pixel = Some(texel);
            texel = [texel[0] + steps[0], texel[1] + steps[1]];
        }
        here = there;
    }
}

/// Texture coordinates in texels.
pub type Texel = [f32; 2];

/// The texel in each pixel; none outside the wall.
type WallImage = Field<Option<Texel>>;

/// A textured wall, one metre to the side of the eye.
pub struct Wall {
    size: [usize; 2],
    corners: [WallCorner; 4],
    triangles: [WallFacet; 2],
}

/// A corner on the image.
#[derive(Clone, Copy, Debug)]
struct WallCorner {
    /// In 1/256 pixel.
    position: [i32; 2],
    /// The distance from the eye.
    distance: f64,
    /// In texels.
    texel: [f64; 2],
}

/// The corners of the two triangles.
const TRIANGLES: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// A function that is linear on the screen: its value at the first pixel's centre, and its steps
/// from column to column and from row to row.
#[derive(Clone, Copy, Debug)]
struct WallPlane([f64; 3]);

impl WallPlane {
    fn new(edges: &Edges, values: [f64; 3]) -> Self {
        let shares = edges.shares(values);
        let [start, right, below] = [[0, 0], [1, 0], [0, 1]].map(|pixel| edges.interpolated(&shares, pixel));
        Self([start, right - start, below - start])
    }

    /// From a pixel on to the right.
    fn along(self, [x, y]: [usize; 2]) -> RowFunction {
        let Self([start, across, down]) = self;
        RowFunction { start: (start + across * x as f64 + down * y as f64) as f32, step: across as f32 }
    }
}

/// A linear function along a row, in `f32`.
#[derive(Clone, Copy, Debug)]
struct RowFunction {
    start: f32,
    step: f32,
}

impl RowFunction {
    /// So many pixels from its start.
    #[inline]
    fn at(self, pixels: usize) -> f32 {
        self.start + self.step * pixels as f32
    }
}

/// The values of a triangle at the first pixel of a row, and their steps.
#[derive(Clone, Copy, Debug)]
struct WallRow {
    texel: [RowFunction; 2],
    texel_over_distance: [RowFunction; 2],
    inverse_distance: RowFunction,
}

impl WallRow {
    /// The texel on the wall so many pixels from the first one: a division.
    #[inline]
    fn perspective(&self, pixels: usize) -> Texel {
        let distance = 1.0 / self.inverse_distance.at(pixels);
        self.texel_over_distance.map(|part| part.at(pixels) * distance)
    }
}

/// A triangle with its functions that are linear on the screen.
struct WallFacet {
    /// The columns that each row covers: one range, as a triangle has no holes.
    spans: Vec<Range<usize>>,
    texel: [WallPlane; 2],
    texel_over_distance: [WallPlane; 2],
    inverse_distance: WallPlane,
}

impl WallFacet {
    fn new(corners: [WallCorner; 3], size: [usize; 2]) -> Self {
        let positions = corners.map(|corner| corner.position.map(i64::from));
        let edges = Edges::new(positions, 256).expect("the wall has an area");
        let mut spans = vec![0..0; size[1]];
        edges.each_covered(&edges.bounding_box(size.map(|side| side as i32)), |[x, y], _| {
            let span = &mut spans[y as usize];
            *span = if span.end == 0 { x as usize..x as usize + 1 } else { span.start..x as usize + 1 };
        });
        let plane = |value: &dyn Fn(WallCorner) -> f64| WallPlane::new(&edges, corners.map(value));
        Self {
            spans,
            texel: [0, 1].map(|axis| plane(&|corner| corner.texel[axis])),
            texel_over_distance: [0, 1].map(|axis| plane(&|corner| corner.texel[axis] / corner.distance)),
            inverse_distance: plane(&|corner| 1.0 / corner.distance),
        }
    }

    fn row(&self, pixel: [usize; 2]) -> WallRow {
        WallRow {
            texel: self.texel.map(|plane| plane.along(pixel)),
            texel_over_distance: self.texel_over_distance.map(|plane| plane.along(pixel)),
            inverse_distance: self.inverse_distance.along(pixel),
        }
    }
}

impl Wall {
    /// From 1.5 to 6 metres away, 1.8 metres high, 256 texels to the metre, in an image
    /// of `width` pixels and three quarters of that in height.
    #[must_use]
    pub fn new(width: usize) -> Self {
        const TEXELS: f64 = 256.0;
        let scale = width as f64 / 2.0;
        let corner = |[up, distance]: [f64; 2]| {
            let position =
                [width as f64 * 0.95 - scale / distance, width as f64 * 0.375 - scale * up / distance];
            WallCorner {
                position: position.map(|part| (part * 256.0).round() as i32),
                distance,
                texel: [distance * TEXELS, up * TEXELS],
            }
        };
        let size = [width, width * 3 / 4];
        let corners = [[-0.9, 1.5], [-0.9, 6.0], [0.9, 6.0], [0.9, 1.5]].map(corner);
        let triangles = TRIANGLES.map(|triangle| WallFacet::new(triangle.map(|index| corners[index]), size));
        Self { size, corners, triangles }
    }

    /// Draws each row of each triangle by a function of the row and its pixels.
    #[inline]
    fn draw_into(&self, image: &mut WallImage, row: impl Fn(&WallRow, &mut [Option<Texel>])) {
        for triangle in &self.triangles {
            for (y, span) in triangle.spans.iter().enumerate().filter(|(_, span)| span.end > 0) {
                row(&triangle.row([span.start, y]), &mut image.row_mut(y)[span.clone()]);
            }
        }
    }

    /// The correct texel at the centre of a pixel, by [`depth::at`].
    fn texel(&self, position: [usize; 2]) -> Option<[f64; 2]> {
        let point = coverage::pixel_center(position.map(|part| part as i32));
        let triangles = TRIANGLES.map(|triangle| triangle.map(|index| self.corners[index]));
        let corners =
            triangles.into_iter().find(|corners| coverage::covers(corners.map(|c| c.position), point))?;
        let distances = corners.map(|corner| corner.distance);
        let [u, v] = [0, 1].map(|axis| {
            depth::at(corners.map(|c| c.position), distances, corners.map(|c| c.texel[axis]), point)
        });
        Some([u?, v?])
    }
}

/// Corners in clip space with their texels: texels are the colours.
struct Vertices {
    positions: [Vec4; 4],
    texels: [[f32; 2]; 4],
}

impl LanePipeline for Vertices {
    const VARYINGS: usize = 2;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let mut columns = [[0.0; 8]; 6];
        let lanes = vertices.first()..vertices.first() + vertices.count();
        for (lane, vertex) in lanes.enumerate() {
            let [x, y, z, w] = self.positions[vertex].to_array();
            let [u, v] = self.texels[vertex];
            for (column, value) in columns.iter_mut().zip([x, y, z, w, u, v]) {
                column[lane] = value;
            }
        }
        let [x, y, z, w, u, v] = columns.map(|column| F32::simd_from(simd, column));
        vertices.set(0, u);
        vertices.set(1, v);
        [x, y, z, w]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v] = fragments.varyings(0);
        [u, v, F32::splat(simd, 0.0), F32::splat(simd, 1.0)]
    }
}

/// A wall and what it takes to draw it again and again.
struct WallDrawer {
    vertices: Vertices,
    engine: Engine,
    target: Target<'static>,
}

impl WallDrawer {
    fn new(wall: &Wall) -> Self {
        let position = |corner: WallCorner| {
            let [x, y] = corner.position.map(|part| f64::from(part) / 256.0);
            clip_position(DVec2::new(x, y), 0.1, wall.size) * corner.distance as f32
        };
        let vertices = Vertices {
            positions: wall.corners.map(position),
            texels: wall.corners.map(|corner| corner.texel.map(|part| part as f32)),
        };
        Self { vertices, engine: Engine::default(), target: target(wall.size, &[Output::Linear]) }
    }

    fn draw(&mut self) {
        let triangles = TRIANGLES.map(|triangle| triangle.map(|index| index as u32));
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&self.vertices, &triangles) });
        self.engine.rasterizer.draw(&pass, &mut self.target);
    }

    fn image(&self) -> WallImage {
        let size = [self.target.width(), self.target.height()].map(|side| side as usize);
        field(size, self.target.linear()).map(|color| (color.w > 0.0).then_some([color.x, color.y]))
    }
}

#[cfg(test)]
mod tests;
