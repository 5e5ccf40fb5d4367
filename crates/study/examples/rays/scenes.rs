//! Four scenes as lists of triangles.

use std::f32::consts::{PI, TAU};
use trigon_math::elementary::{cos_f32, exp_f32, pow_f32, sin_f32};
use trigon_math::{SplitMix64, Vec3};
use trigon_mesh::{Mesh, primitives};

/// Triangles, and from where they are seen and lit.
pub(crate) struct Setting {
    pub(crate) name: &'static str,
    pub(crate) triangles: Vec<[Vec3; 3]>,
    pub(crate) eye: Vec3,
    pub(crate) target: Vec3,
    /// Towards the sun; any length.
    pub(crate) sun: Vec3,
    /// How far rays of ambient occlusion go.
    pub(crate) reach: f32,
}

pub(crate) fn all() -> [Setting; 4] {
    [hall(), car(), foliage(), stadium()]
}

#[derive(Default)]
struct Soup(Vec<[Vec3; 3]>);

impl Soup {
    /// A surface over the unit square, without the triangles that have a corner which is not finite.
    fn surface(&mut self, [columns, rows]: [u32; 2], point: impl Fn(f32, f32) -> Vec3) {
        let at = |column: u32, row: u32| point(column as f32 / columns as f32, row as f32 / rows as f32);
        for row in 0..rows {
            for column in 0..columns {
                let [a, b] = [at(column, row), at(column + 1, row)];
                let [c, d] = [at(column + 1, row + 1), at(column, row + 1)];
                let halves = [[a, b, c], [a, c, d]];
                self.0.extend(halves.into_iter().filter(|half| half.iter().all(|corner| corner.is_finite())));
            }
        }
    }

    fn rectangle(&mut self, corner: Vec3, along: Vec3, across: Vec3) {
        self.surface([1, 1], |u, v| corner + along * u + across * v);
    }

    fn mesh(&mut self, mesh: &Mesh, placed: impl Fn(Vec3) -> Vec3) {
        let corner = |corner: u32| placed(mesh.positions()[mesh.corner_vertices()[corner as usize] as usize]);
        self.0.extend(mesh.triangulation().triangles.iter().map(|triangle| triangle.map(corner)));
    }
}

/// A courtyard of 60 × 20 × 14 m between two storeys of fluted columns with arches, with curtains behind them.
fn hall() -> Setting {
    let mut soup = Soup::default();
    for storey in [0.0_f32, 6.5] {
        for side in [-5.0_f32, 5.0] {
            soup.rectangle(Vec3::new(-30.0, storey, side), Vec3::X * 60.0, Vec3::Z * side);
            soup.rectangle(Vec3::new(-30.0, storey, 2.0 * side), Vec3::X * 60.0, Vec3::Y * 6.5);
            for column in 0..14 {
                let foot = Vec3::new(column as f32 * 4.0 - 26.0, storey, side);
                soup.surface([64, 24], |u, v| foot + fluted(u, v));
                let next = foot + Vec3::new(2.0, 4.0, 0.0);
                soup.surface([24, 12], |u, v| next + bent_tube(u, v));
            }
            for curtain in 0..3 {
                let corner = Vec3::new(curtain as f32 * 18.0 - 24.0, storey + 0.5, side * 1.3);
                soup.surface([96, 20], |u, v| {
                    corner + Vec3::new(4.0 * u, 4.5 * v, 0.2 * sin_f32(u * 60.0) * (1.2 - v))
                });
            }
        }
    }
    soup.rectangle(Vec3::new(-30.0, 0.0, -5.0), Vec3::X * 60.0, Vec3::Z * 10.0);
    for end in [-30.0, 30.0] {
        soup.rectangle(Vec3::new(end, 0.0, -10.0), Vec3::Z * 20.0, Vec3::Y * 13.0);
    }
    for side in [-5.0_f32, 5.0] {
        soup.rectangle(Vec3::new(-30.0, 13.0, side), Vec3::X * 60.0, Vec3::Z * side);
    }
    let (eye, target) = (Vec3::new(-24.0, 2.0, 1.0), Vec3::new(10.0, 4.5, -2.0));
    Setting { name: "hall", triangles: soup.0, eye, target, sun: Vec3::new(0.2, 1.0, 0.35), reach: 2.0 }
}

/// A column of 4 m with a wider base and capital.
fn fluted(u: f32, v: f32) -> Vec3 {
    let ends = exp_f32(-30.0 * v) + exp_f32(-30.0 * (1.0 - v));
    let radius = 0.38 - 0.06 * v + 0.02 * cos_f32(16.0 * TAU * u) + 0.25 * ends;
    Vec3::new(radius * cos_f32(TAU * u), 4.0 * v, radius * sin_f32(TAU * u))
}

/// Half a torus from one column to the next.
fn bent_tube(u: f32, v: f32) -> Vec3 {
    let radius = 2.0 + 0.3 * cos_f32(TAU * v);
    Vec3::new(radius * cos_f32(PI * u), radius * sin_f32(PI * u), 0.3 * sin_f32(TAU * v))
}

/// A body with windows and an inner lining, seats, wheels, on a floor of two triangles.
fn car() -> Setting {
    let mut soup = Soup::default();
    for lining in [1.0, 0.95] {
        let middle = Vec3::Y * 0.7;
        soup.surface([260, 130], |u, v| middle + (body(u, v) - middle) * lining);
    }
    let seat = |size: Vec3| move |u: f32, v: f32| rounded(u, v, 0.4) * size;
    for [x, z] in [[-0.7, -0.4], [-0.7, 0.4], [0.3, -0.4], [0.3, 0.4]] {
        let cushion = seat(Vec3::new(0.28, 0.1, 0.26));
        soup.surface([48, 32], |u, v| Vec3::new(x, 0.55, z) + cushion(u, v));
        let back = seat(Vec3::new(0.1, 0.35, 0.25));
        soup.surface([48, 32], |u, v| Vec3::new(x - 0.3, 0.85, z) + back(u, v));
    }
    let tyre = primitives::torus(0.28, 0.09, 96, 32);
    let spoke = primitives::cylinder(0.02, 0.5, 24);
    for [x, z] in [[-1.3, -0.85], [-1.3, 0.85], [1.3, -0.85], [1.3, 0.85]] {
        let hub = Vec3::new(x, 0.37, z);
        soup.mesh(&tyre, |point| hub + Vec3::new(point.x, point.z, point.y));
        for turn in 0..5 {
            let (sine, cosine) = (sin_f32(turn as f32 * PI / 5.0), cos_f32(turn as f32 * PI / 5.0));
            soup.mesh(&spoke, |point| {
                hub + Vec3::new(point.x * cosine - point.y * sine, point.x * sine + point.y * cosine, point.z)
            });
        }
    }
    soup.mesh(&primitives::torus(0.17, 0.015, 96, 24), |point| {
        Vec3::new(0.75 + point.y, 0.9 + point.x, 0.4 + point.z)
    });
    soup.rectangle(Vec3::new(-20.0, 0.0, -20.0), Vec3::X * 40.0, Vec3::Z * 40.0);
    let (eye, target) = (Vec3::new(2.6, 1.5, 2.4), Vec3::new(0.1, 0.75, 0.0));
    Setting { name: "car", triangles: soup.0, eye, target, sun: Vec3::new(0.5, 1.0, 0.7), reach: 0.5 }
}

/// A point of the superellipsoid in the cube from −1 to 1: a sphere for 1, the cube for 0.
fn rounded(u: f32, v: f32, exponent: f32) -> Vec3 {
    let power = |value: f32| pow_f32(value.abs(), exponent).copysign(value);
    let (longitude, latitude) = (TAU * u, PI * (v - 0.5));
    let width = power(cos_f32(latitude));
    Vec3::new(width * power(cos_f32(longitude)), power(sin_f32(latitude)), width * power(sin_f32(longitude)))
}

/// NaN in the windows.
fn body(u: f32, v: f32) -> Vec3 {
    let point = rounded(u, v, 0.6) * Vec3::new(2.1, 0.5, 0.85);
    let roof = if point.y > 0.0 { 0.5 + 0.9 * exp_f32(-point.x * point.x) } else { 1.0 };
    let point = Vec3::new(point.x, 0.7 + point.y * roof, point.z);
    if (0.95..1.25).contains(&point.y) && (point.x - 0.1).abs() > 0.06 { Vec3::NAN } else { point }
}

/// Half a million leaves of two triangles in twelve crowns over a lawn of two.
fn foliage() -> Setting {
    let mut random = SplitMix64::new(1);
    let mut soup = Soup::default();
    let trunk = primitives::cylinder(0.2, 5.0, 32);
    let crowns: Vec<Vec3> =
        (0..12).map(|tree| Vec3::new((tree % 4) as f32 * 5.0 - 7.5, 0.0, (tree / 4) as f32 * -6.0)).collect();
    for &foot in &crowns {
        soup.mesh(&trunk, |point| foot + Vec3::Y * 2.5 + point);
    }
    for leaf in 0..500_000 {
        let shell = 2.4 * pow_f32(random.unit() as f32, 0.2);
        let middle = crowns[leaf % crowns.len()]
            + Vec3::Y * 5.0
            + direction(&mut random) * Vec3::new(shell, 1.3 * shell, shell);
        let along = direction(&mut random) * random.between(0.03, 0.09) as f32;
        let across = along.cross(direction(&mut random)) * 0.7;
        soup.rectangle(middle, along, across);
    }
    soup.rectangle(Vec3::new(-60.0, 0.0, -60.0), Vec3::X * 120.0, Vec3::Z * 120.0);
    let (eye, target) = (Vec3::new(1.0, 1.7, 13.0), Vec3::new(0.0, 4.0, 0.0));
    Setting { name: "foliage", triangles: soup.0, eye, target, sun: Vec3::new(0.4, 1.0, 0.3), reach: 0.5 }
}

/// The teapot, 0.3 m high, on the ground of a stadium of 260 m: long rows of seats, and beams of its roof.
fn stadium() -> Setting {
    let mut soup = Soup::default();
    soup.mesh(&primitives::teapot(32), |point| point * 0.1);
    soup.surface([48, 120], |u, v| {
        let step = (v * 120.0).round() as u32;
        let (out, up) = (step.div_ceil(2) as f32 * 0.8, (step / 2) as f32 * 0.5 + 0.5);
        Vec3::new((80.0 + out) * cos_f32(TAU * u), up, (60.0 + out) * sin_f32(TAU * u))
    });
    let beam = primitives::cylinder(0.15, 30.0, 12);
    for number in 0..48 {
        let (sine, cosine) = (sin_f32(number as f32 * TAU / 48.0), cos_f32(number as f32 * TAU / 48.0));
        let middle = Vec3::new(112.0 * cosine, 40.0, 92.0 * sine);
        soup.mesh(&beam, |point| {
            middle + Vec3::new(point.y * cosine - point.z * sine, point.x, point.y * sine + point.z * cosine)
        });
    }
    soup.rectangle(Vec3::new(-130.0, 0.0, -110.0), Vec3::X * 260.0, Vec3::Z * 220.0);
    let (eye, target) = (Vec3::new(0.4, 0.3, 0.8), Vec3::new(0.0, 0.15, 0.0));
    Setting { name: "stadium", triangles: soup.0, eye, target, sun: Vec3::new(0.5, 1.0, 0.3), reach: 0.5 }
}

/// A unit vector, equally likely in all directions.
pub(crate) fn direction(random: &mut SplitMix64) -> Vec3 {
    let (height, angle) = (random.between(-1.0, 1.0) as f32, random.between(0.0, f64::from(TAU)) as f32);
    let width = (1.0 - height * height).max(0.0).sqrt();
    Vec3::new(width * cos_f32(angle), height, width * sin_f32(angle))
}
