//! Triangles that tile the whole image, so that each pixel belongs to exactly one.

use super::Triangle;
use trigon_math::{DVec2, SplitMix64, Vec2, elementary};

/// A tiling of the image. Its corners are multiples of 1/16384 pixel (of the fan's
/// rim, of 1/512), which `f32` holds exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tiling {
    /// A grid of squares of about 16 pixels, its corners moved about, each square cut in
    /// two.
    Tiles,
    /// The same with corners on multiples of half a pixel: many pixels' centres lie
    /// exactly on an edge.
    Lattice,
    /// Needles from a point in the image to a rim 12,000 pixels away.
    Fan,
}

impl Tiling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Tiles, Self::Lattice, Self::Fan];

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tiles => "tiles of 16 pixels",
            Self::Lattice => "tiles with corners on half pixels",
            Self::Fan => "a fan of 200 needles",
        }
    }

    /// The triangles on a square image of `side` pixels, other ones for each seed.
    #[must_use]
    pub fn triangles(self, side: usize, seed: u64) -> Vec<Triangle> {
        match self {
            Self::Tiles => tiles(side, 16.0, 1.0 / 16384.0, seed),
            Self::Lattice => tiles(side, 16.0, 0.5, seed),
            Self::Fan => fan(side, seed),
        }
    }
}

/// A grid of squares over the image and beyond, its corners moved about by up to a
/// quarter of a square and put on multiples of `unit`.
#[must_use]
pub fn tiles(side: usize, square: f64, unit: f64, seed: u64) -> Vec<Triangle> {
    let mut random = SplitMix64::new(seed);
    let count = (side as f64 / square).ceil() as usize + 3;
    let mut corner = |index: usize| {
        let position = DVec2::new((index % count) as f64, (index / count) as f64) - 1.0;
        let moved = DVec2::new(random.between(-0.25, 0.25), random.between(-0.25, 0.25));
        on_grid((position + moved) * square, unit)
    };
    let corners: Vec<Vec2> = (0..count * count).map(&mut corner).collect();
    let squares = (0..count - 1).flat_map(|y| (0..count - 1).map(move |x| y * count + x));
    let [right, below] = [1, count];
    let cut = |a: usize| [[a, a + right, a + right + below], [a, a + right + below, a + below]];
    squares.flat_map(cut).map(|triangle| triangle.map(|index| corners[index])).collect()
}

fn fan(side: usize, seed: u64) -> Vec<Triangle> {
    const NEEDLES: usize = 200;
    const RADIUS: f64 = 12_000.0;
    let mut random = SplitMix64::new(seed);
    let mut within = || random.between(0.3, 0.7) * side as f64;
    let center = on_grid(DVec2::new(within(), within()), 1.0 / 16384.0);
    let turn = std::f64::consts::TAU / NEEDLES as f64;
    let rim: Vec<Vec2> = (0..NEEDLES)
        .map(|i| {
            let (sine, cosine) = elementary::sin_cos((i as f64 + random.between(-0.4, 0.4)) * turn);
            on_grid(DVec2::new(cosine, sine) * RADIUS, 1.0 / 512.0)
        })
        .collect();
    (0..NEEDLES).map(|i| [center, rim[i], rim[(i + 1) % NEEDLES]]).collect()
}

fn on_grid(point: DVec2, unit: f64) -> Vec2 {
    ((point / unit).round() * unit).as_vec2()
}
