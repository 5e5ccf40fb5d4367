//! One whole frame: a torus knot of 70,000 triangles, Blinn-Phong per sample,
//! 1920 by 1080 pixels; and the same frame with nothing in it.

use criterion::{Criterion, criterion_group, criterion_main};
use std::f64::consts::TAU;
use std::num::NonZeroUsize;
use trigon_math::glam::camera::rh::{proj::directx, view};
use trigon_math::{DVec3, Mat4, Vec3, Vec4, elementary};
use trigon_raster::{
    Background, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, Rasterizer, Target, VertexOutput,
};

const ALONG: u32 = 700;
const AROUND: u32 = 50;

struct Knot {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    to_clip_space: Mat4,
    eye: Vec3,
}

impl Pipeline for Knot {
    type Varyings = (Vec3, Vec3);

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Self::Varyings> {
        let position = self.positions[index];
        VertexOutput {
            position: self.to_clip_space * position.extend(1.0),
            varyings: (position, self.normals[index]),
        }
    }

    fn fragment(&self, fragment: &Fragment<Self::Varyings>) -> Vec4 {
        let (position, normal) = fragment.varyings;
        let light = Vec3::new(0.398, 0.697, 0.597);
        let normal = normal.normalize_or_zero();
        let half = (light + (self.eye - position).normalize_or_zero()).normalize_or_zero();
        let positive = |v: f32| if v > 0.0 { v } else { 0.0 };
        let diffuse = 0.1 + 0.9 * positive(normal.dot(light));
        let mut gloss = positive(normal.dot(half));
        for _ in 0..5 {
            gloss *= gloss;
        }
        (Vec3::new(0.85, 0.65, 0.40) * diffuse + 0.4 * gloss).extend(1.0)
    }
}

/// A point of the (2, 3) torus knot.
fn centre(t: f64) -> DVec3 {
    let ((s2, c2), (s3, c3)) = (elementary::sin_cos(2.0 * t), elementary::sin_cos(3.0 * t));
    DVec3::new((1.0 + 0.5 * c3) * c2, (1.0 + 0.5 * c3) * s2, 0.5 * s3)
}

fn knot() -> (Knot, Vec<[u32; 3]>) {
    let (mut positions, mut normals) = (Vec::new(), Vec::new());
    for i in 0..=ALONG {
        let t = TAU * f64::from(i) / f64::from(ALONG);
        let (here, ahead) = (centre(t), centre(t + 1e-4));
        let tangent = (ahead - here).normalize();
        let side = tangent.cross(here).normalize();
        let up = side.cross(tangent);
        for j in 0..=AROUND {
            let (sine, cosine) = elementary::sin_cos(TAU * f64::from(j) / f64::from(AROUND));
            let normal = side * cosine + up * sine;
            positions.push((here + normal * 0.22).as_vec3());
            normals.push(normal.as_vec3());
        }
    }
    let corner = |i: u32, j: u32| i * (AROUND + 1) + j;
    let quads = (0..ALONG).flat_map(|i| (0..AROUND).map(move |j| (i, j)));
    let triangles = quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let eye = Vec3::new(0.3, 0.4, 4.6);
    let projection = directx::perspective_infinite_reverse(TAU as f32 / 8.0, 16.0 / 9.0, 1.0);
    let to_clip_space = projection * view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
    (Knot { positions, normals, to_clip_space, eye }, triangles)
}

fn frames(criterion: &mut Criterion) {
    let (knot, triangles) = knot();
    let mut target = Target::new(1920, 1080, &[Output::Srgb8]).expect("the size is in range");
    let background = Background::Color(Vec4::new(0.01, 0.01, 0.02, 1.0));
    for threads in [1, 2] {
        let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..Default::default() };
        let mut rasterizer = Rasterizer::new(settings).expect("the best level is supported");
        criterion.bench_function(&format!("knot, {threads} threads"), |bencher| {
            let mut pass = Pass::new();
            pass.background(background).triangles(Draw::new(&knot, &triangles));
            bencher.iter(|| rasterizer.draw(&pass, &mut target));
        });
        criterion.bench_function(&format!("nothing, {threads} threads"), |bencher| {
            let mut pass = Pass::new();
            pass.background(background);
            bencher.iter(|| rasterizer.draw(&pass, &mut target));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_secs(1));
    targets = frames
}
criterion_main!(benches);
