//! The exact image of a workload, computed from its definition by rays in `f64`. The workloads' lighting,
//! colours, texture and its filtering are implemented here from their definition.
//!
//! The ray through the image at (X, Y) hits a triangle where (X, Y, 1) is a weighted sum of its corners' (x,
//! y, w); the weights are linear in X and Y, and their sum is 1/w (M. Olano and T. Greer, *Triangle scan
//! conversion using 2D homogeneous coordinates*, Graphics Hardware 1997). Corners are not projected or
//! snapped. Nothing needs clipping, because all corners lie in front of the eye.

use std::ops::Range;

use trigon_math::{DVec2, DVec3, elementary};
use trigon_raster::Culling;

use crate::workloads::{Mesh, Scene, Shading};

/// Rows of pixels that are looked at together.
const BAND: usize = 8;

/// What is right for one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// At the centre: red, green and blue, white being 1.
    pub color: DVec3,
    /// What is seen there: 0 for the background, else a number for each surface. In flat colours each face of a cube is one.
    pub surface: u32,
    /// One over the distance of what is seen there; 0 for the background.
    pub nearness: f64,
    /// The mean of the colours of 256 rays, 16 by 16.
    pub mean: DVec3,
    /// Whether any of these rays meets a surface.
    pub is_touched: bool,
}

/// The exact image of a workload.
pub struct Exact {
    /// Row by row from the top.
    pub pixels: Vec<Pixel>,
    /// Pixels in a row.
    pub width: usize,
}

impl Exact {
    /// Of a scene that is seen from an eye and lies before it as a whole.
    pub fn new(scene: &Scene) -> Self {
        let rays = Rays::new(scene);
        let [width, height] = scene.size.to_array().map(|side| side as usize);
        let bands: Vec<_> = (0..height).step_by(BAND).map(|top| top..(top + BAND).min(height)).collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let rays = &rays;
        let pixels = std::thread::scope(|scope| {
            let draw = |part: &[Range<usize>]| -> Vec<Pixel> {
                part.iter().flat_map(|rows| rays.pixels(rows.clone())).collect()
            };
            let parts = bands.chunks(bands.len().div_ceil(threads).max(1));
            let running: Vec<_> = parts.map(|part| scope.spawn(move || draw(part))).collect();
            running.into_iter().flat_map(|part| part.join().expect("rays do not panic")).collect()
        });
        Self { pixels, width }
    }
}

/// A triangle for rays.
struct WorkloadTriangle {
    number: u32,
    /// The corners' shares in the ray through (X, Y) are these times (X, Y, 1).
    shares: [DVec3; 3],
    /// The pixels that it may lie in.
    columns: Range<usize>,
    rows: Range<usize>,
}

/// What a ray meets first.
#[derive(Clone, Copy, Default)]
struct Hit {
    nearness: f64,
    /// The place of the triangle in the list of [`Rays`].
    triangle: Option<u32>,
}

struct Rays<'a> {
    scene: &'a Scene,
    triangles: Vec<WorkloadTriangle>,
    /// The places in `triangles` of those that lie in each band of rows.
    bands: Vec<Vec<u32>>,
    texture: Option<Texture>,
}

impl<'a> Rays<'a> {
    fn new(scene: &'a Scene) -> Self {
        let corners = visible(scene);
        let triangles: Vec<WorkloadTriangle> = (0..)
            .zip(&scene.mesh.triangles)
            .filter_map(|(number, indices)| {
                triangle(scene, number, indices.map(|index| corners[index as usize]))
            })
            .collect();
        let mut bands = vec![Vec::new(); (scene.size.y as usize).div_ceil(BAND)];
        for (spot, triangle) in (0..).zip(&triangles) {
            let Range { start, end } = triangle.rows.clone();
            bands[start / BAND..end.div_ceil(BAND)].iter_mut().for_each(|band| band.push(spot));
        }
        let texture = matches!(scene.shading, Shading::Textured(_)).then(Texture::new);
        Self { scene, triangles, bands, texture }
    }

    /// The pixels of a band.
    fn pixels(&self, rows: Range<usize>) -> Vec<Pixel> {
        const FINE: usize = 16;
        let width = self.scene.size.x as usize;
        let [centres, fine] =
            [1, FINE].map(|parts| CellGrid { parts, top: rows.start, size: [width, rows.len()] });
        let mut pixels: Vec<Pixel> = self
            .hits(centres)
            .iter()
            .enumerate()
            .map(|(index, hit)| {
                let color = self.color(*hit, self.spot(centres, index), true);
                Pixel { color, surface: self.surface(*hit), nearness: hit.nearness, ..Pixel::default() }
            })
            .collect();
        for (index, hit) in self.hits(fine).iter().enumerate() {
            let [column, row] = [index % (width * FINE), index / (width * FINE)].map(|spot| spot / FINE);
            let pixel = &mut pixels[row * width + column];
            pixel.is_touched |= hit.triangle.is_some();
            pixel.mean += self.color(*hit, self.spot(fine, index), false) / (FINE * FINE) as f64;
        }
        pixels
    }

    /// What the rays of a band meet, row by row.
    fn hits(&self, grid: CellGrid) -> Vec<Hit> {
        let [width, height] = grid.size.map(|side| side * grid.parts);
        let mut hits = vec![Hit::default(); width * height];
        let across: Vec<f64> = (0..width).map(|column| self.spot(grid, column).x).collect();
        for &spot in &self.bands[grid.top / BAND] {
            let triangle = &self.triangles[spot as usize];
            let columns = triangle.columns.start * grid.parts..triangle.columns.end * grid.parts;
            let first = triangle.rows.start.max(grid.top) - grid.top;
            let last = triangle.rows.end.min(grid.top + grid.size[1]) - grid.top;
            for row in first * grid.parts..last * grid.parts {
                let line = &mut hits[row * width..][columns.clone()];
                let y = self.spot(grid, row * width).y;
                for (hit, x) in line.iter_mut().zip(&across[columns.clone()]) {
                    meet(spot, triangle, DVec2::new(*x, y), hit);
                }
            }
        }
        hits
    }

    /// Where the ray of this number in a band goes, from -1 to 1, up.
    fn spot(&self, grid: CellGrid, index: usize) -> DVec2 {
        let width = grid.size[0] * grid.parts;
        let [column, row] =
            [index % width, index / width].map(|spot| (spot as f64 + 0.5) / grid.parts as f64);
        let size = self.scene.size.as_dvec2();
        DVec2::new(2.0 * column / size.x - 1.0, 1.0 - 2.0 * (grid.top as f64 + row) / size.y)
    }

    fn surface(&self, hit: Hit) -> u32 {
        let is_flat = matches!(self.scene.shading, Shading::Flat);
        // The two triangles of a cube's side follow each other.
        let surface = |spot: u32| if is_flat { 1 + self.triangles[spot as usize].number / 2 } else { 1 };
        hit.triangle.map_or(0, surface)
    }

    /// The colour where a ray goes. A texture is read as the workload defines it for a pixel, or as the surface itself has it.
    fn color(&self, hit: Hit, spot: DVec2, is_pixel: bool) -> DVec3 {
        let Some(triangle) = hit.triangle else { return bytes(Scene::BACKGROUND) };
        let triangle = &self.triangles[triangle as usize];
        let mesh = &self.scene.mesh;
        let corners = mesh.triangles[triangle.number as usize];
        let weights = triangle.at(spot) / hit.nearness;
        let mixed = |value: &dyn Fn(u32) -> DVec3| {
            (0..3).map(|corner| value(corners[corner]) * weights[corner]).sum::<DVec3>()
        };
        let light = || mixed(&|vertex| DVec3::splat(lambert(column(&mesh.normals, vertex)))).x;
        let color = match (&self.scene.shading, &self.texture) {
            (Shading::Flat, _) => bytes(mesh.colors[triangle.number as usize]),
            (Shading::BlinnPhong, _) => {
                let [position, normal] =
                    [&mesh.positions, &mesh.normals].map(|list| mixed(&|vertex| column(list, vertex)));
                blinn_phong(position, normal, self.scene.eye.as_dvec3())
            }
            (_, Some(texture)) => {
                let uv = |vertex: u32| coordinates(mesh, vertex);
                let at = mixed(&|vertex| uv(vertex).extend(0.0)).truncate();
                let texels =
                    if is_pixel { self.texels(triangle, corners.map(uv), at, hit.nearness) } else { 0.0 };
                texture.trilinear(at.to_array(), texels) * light()
            }
            _ => lit(light()),
        };
        color.min(DVec3::ONE)
    }

    /// How many texels a pixel is long, in the direction in which it is longer: u and v are quotients of functions that are
    /// linear on the image, so their derivatives are exact.
    fn texels(&self, triangle: &WorkloadTriangle, uv: [DVec2; 3], at: DVec2, nearness: f64) -> f64 {
        let along = |axis: usize| {
            let slope = triangle.shares.map(|share| share[axis]);
            let above = (0..3).map(|corner| uv[corner] * slope[corner]).sum::<DVec2>();
            (above - at * slope.iter().sum::<f64>()) / nearness * 2.0 / self.scene.size.as_dvec2()[axis]
                * Texture::SIDE
        };
        along(0).length().max(along(1).length())
    }
}

/// Rays through a band: so many along each side of a pixel.
#[derive(Clone, Copy)]
struct CellGrid {
    parts: usize,
    top: usize,
    size: [usize; 2],
}

impl WorkloadTriangle {
    /// The corners' shares in a ray; their sum is one over the distance.
    fn at(&self, spot: DVec2) -> DVec3 {
        DVec3::from(self.shares.map(|share| share.dot(spot.extend(1.0))))
    }
}

fn meet(spot: u32, triangle: &WorkloadTriangle, at: DVec2, hit: &mut Hit) {
    let shares = triangle.at(at);
    let nearness = shares.element_sum();
    if shares.min_element() >= 0.0 && nearness > hit.nearness {
        *hit = Hit { nearness, triangle: Some(spot) };
    }
}

/// Each vertex as (x, y, w) of clip space: 45 degrees high, towards the origin, up along y.
fn visible(scene: &Scene) -> Vec<DVec3> {
    let eye = scene.eye.as_dvec3();
    let ahead = (-eye).normalize();
    let right = ahead.cross(DVec3::Y).normalize();
    let up = right.cross(ahead);
    // The cotangent of 22.5 degrees.
    let zoom = 2.0_f64.sqrt() + 1.0;
    let aspect = f64::from(scene.size.x) / f64::from(scene.size.y);
    let vertex = |index: usize| {
        let away = column(&scene.mesh.positions, index as u32) - eye;
        DVec3::new(right.dot(away) * zoom / aspect, up.dot(away) * zoom, ahead.dot(away))
    };
    (0..scene.mesh.vertex_count()).map(vertex).collect()
}

/// None if it is turned away and so dropped, or is seen edge on.
fn triangle(scene: &Scene, number: u32, [a, b, c]: [DVec3; 3]) -> Option<WorkloadTriangle> {
    let volume = a.dot(b.cross(c));
    if volume == 0.0 || (scene.culling == Culling::Back && volume < 0.0) {
        return None;
    }
    let shares = [b.cross(c), c.cross(a), a.cross(b)].map(|share| share / volume);
    let half = scene.size.as_dvec2() / 2.0;
    let [lefts, tops] = [0, 1].map(|axis| {
        let way = [1.0, -1.0][axis];
        [a, b, c].map(|corner| half[axis] * (1.0 + way * corner[axis] / corner.z))
    });
    let range = |slots: [f64; 3], end: u32| {
        let [low, high] =
            [slots.into_iter().fold(f64::MAX, f64::min), slots.into_iter().fold(f64::MIN, f64::max)];
        let within = |spot: f64| spot.clamp(0.0, f64::from(end)) as usize;
        within(low.floor() - 1.0)..within(high.ceil() + 1.0)
    };
    Some(WorkloadTriangle {
        number,
        shares,
        columns: range(lefts, scene.size.x),
        rows: range(tops, scene.size.y),
    })
}

fn column(list: &[Vec<f32>; 3], vertex: u32) -> DVec3 {
    DVec3::from([0, 1, 2].map(|axis| f64::from(list[axis][vertex as usize])))
}

fn coordinates(mesh: &Mesh, vertex: u32) -> DVec2 {
    DVec2::from([0, 1].map(|axis| f64::from(mesh.coordinates[axis][vertex as usize])))
}

fn bytes([r, g, b, _]: [u8; 4]) -> DVec3 {
    DVec3::new(f64::from(r), f64::from(g), f64::from(b)) / 255.0
}

/// Red, green and blue of lit surfaces.
const BASE: DVec3 = DVec3::new(0.85, 0.65, 0.40);

/// Lambert's law with a tenth of the light from everywhere.
pub(super) fn lambert(normal: DVec3) -> f64 {
    0.1 + 0.9 * normal.dot(to_light()).max(0.0)
}

/// A colour in so much light.
pub(super) fn lit(light: f64) -> DVec3 {
    BASE * light
}

/// Blinn's highlight with an exponent of 32 over Lambert's law.
pub(super) fn blinn_phong(position: DVec3, normal: DVec3, eye: DVec3) -> DVec3 {
    let normal = normal.normalize();
    let half = (to_light() + (eye - position).normalize()).normalize();
    lit(lambert(normal)) + DVec3::splat(0.4 * elementary::pow(normal.dot(half).max(0.0), 32.0))
}

fn to_light() -> DVec3 {
    DVec3::new(0.4, 0.7, 0.6).normalize()
}

const SIDE: usize = 1024;

/// The texture with its smaller levels, each texel the mean of four, rounded to a byte.
pub(super) struct Texture(Vec<Vec<[u8; 3]>>);

impl Texture {
    pub(super) fn new() -> Self {
        let mut levels = vec![(0..SIDE * SIDE).map(|index| texel([index % SIDE, index / SIDE])).collect()];
        for level in 1..=SIDE.ilog2() {
            let finer: &Vec<[u8; 3]> = &levels[level as usize - 1];
            let side = SIDE >> level;
            let mean = |index: usize| {
                let corner = index / side * 4 * side + index % side * 2;
                let four = [corner, corner + 1, corner + 2 * side, corner + 2 * side + 1];
                [0, 1, 2].map(|channel| {
                    let sum: u32 = four.iter().map(|&position| u32::from(finer[position][channel])).sum();
                    ((sum + 2) / 4) as u8
                })
            };
            levels.push((0..side * side).map(mean).collect());
        }
        Self(levels)
    }

    /// At a place, where a pixel is so many texels long: the mean of four texels on each of the two levels next to that.
    pub(super) fn trilinear(&self, position: [f64; 2], texels: f64) -> DVec3 {
        let level = elementary::log2(texels).clamp(0.0, (self.0.len() - 1) as f64);
        let (finer, part) = (level.floor(), level.fract());
        let coarser = (finer as usize + 1).min(self.0.len() - 1);
        self.bilinear(position, finer as usize).lerp(self.bilinear(position, coarser), part)
    }

    /// The mean of the four texels around a place, repeated for ever.
    pub(super) fn bilinear(&self, position: [f64; 2], level: usize) -> DVec3 {
        let side = SIDE >> level;
        let [x, y] = position.map(|coordinate| coordinate * side as f64 - 0.5);
        let wrapped = |value: f64| (value as i64).rem_euclid(side as i64) as usize;
        let [columns, rows] = [x, y].map(|value| [wrapped(value.floor()), wrapped(value.floor() + 1.0)]);
        let at = |row: usize, column: usize| {
            let [r, g, b] = self.0[level][rows[row] * side + columns[column]].map(f64::from);
            DVec3::new(r, g, b) / 255.0
        };
        let across = |row: usize| at(row, 0).lerp(at(row, 1), x - x.floor());
        across(0).lerp(across(1), y - y.floor())
    }

    /// How many texels there are along a side.
    pub(super) const SIDE: f64 = SIDE as f64;
}

/// A checker of two tints in squares of 64 texels, each with the exclusive or of the coordinates.
fn texel([x, y]: [usize; 2]) -> [u8; 3] {
    let shade = ((x ^ y) & 63) * 2 / 3;
    let tint: [usize; 3] = if (x / 64 + y / 64) % 2 == 1 { [230, 120, 60] } else { [60, 130, 220] };
    tint.map(|channel| (channel - shade) as u8)
}
