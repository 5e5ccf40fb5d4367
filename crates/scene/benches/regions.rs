//! A torus of a million quads at 1920 by 1080: what the elements of regions take, given
//! the image's ids, and what the ids take of an image.
//!
//! `cargo bench -p trigon-scene --bench regions -- [FILTER]`

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use trigon_scene::camera::Camera;
use trigon_scene::math::{DVec2, DVec3};
use trigon_scene::mesh::primitives;
use trigon_scene::{Frame, Material, Outputs, Picker, Reach, Region, RenderSettings, Renderer, Scene};

const SIZE: [u32; 2] = [1920, 1080];

/// 1250 by 800 quads: a million faces and vertices, two million triangles and edges.
fn scene() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("torus", primitives::torus(1.0, 0.45, 1250, 800), Material::default());
    scene
}

fn camera() -> Camera {
    Camera::look_at(DVec3::new(0.0, 2.6, 4.6), DVec3::ZERO, DVec3::Y)
}

fn draw(scene: &Scene, outputs: Outputs) -> Frame {
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(SIZE[0], SIZE[1]) };
    Renderer::new(settings).render(scene, &camera()).expect("drawn")
}

/// A box over the left half, a circle in the middle, and a wavy loop of 200 corners.
fn regions() -> [(&'static str, Region); 3] {
    let [width, height] = SIZE.map(f64::from);
    let middle = DVec2::new(width, height) * 0.5;
    let loops = (0..200).map(|number| {
        let turn = f64::from(number) / 200.0;
        // A square with teeth: no angle needs a sine.
        let along = (turn * 4.0).fract() * 2.0 - 1.0;
        let side = [[along, -1.0], [1.0, along], [-along, 1.0], [-1.0, -along]][(turn * 4.0) as usize];
        middle + DVec2::from(side) * height * if number % 2 == 0 { 0.42 } else { 0.3 }
    });
    [
        ("box", Region::Rectangle { min: DVec2::ZERO, max: DVec2::new(width * 0.5, height) }),
        ("circle", Region::Circle { center: middle, radius: height * 0.4 }),
        ("lasso", Region::Lasso(loops.collect())),
    ]
}

fn elements(criterion: &mut Criterion) {
    let (scene, camera) = (scene(), camera());
    let frame = draw(&scene, Outputs { ids: true, ..Outputs::NONE });
    let picker = Picker::new(&scene, &camera, &frame);
    for (name, region) in regions() {
        for (depth, reach) in [("visible", Reach::Visible), ("through", Reach::Through)] {
            let mut group = criterion.benchmark_group(format!("{name} {depth}"));
            group.sample_size(10);
            group.bench_function("faces", |bench| bench.iter(|| black_box(picker.faces(&region, reach))));
            group.bench_function("vertices", |bench| {
                bench.iter(|| black_box(picker.vertices(&region, reach)));
            });
            group.bench_function("edges", |bench| bench.iter(|| black_box(picker.edges(&region, reach))));
        }
    }
    let mut group = criterion.benchmark_group("a new picker");
    group.sample_size(10);
    let (_, half) = &regions()[0];
    group.bench_function("faces", |bench| {
        bench.iter(|| black_box(Picker::new(&scene, &camera, &frame).faces(half, Reach::Visible)));
    });
    group.bench_function("vertices", |bench| {
        bench.iter(|| black_box(Picker::new(&scene, &camera, &frame).vertices(half, Reach::Visible)));
    });
    group.bench_function("nearest", |bench| {
        let middle = DVec2::new(960.0, 700.0);
        bench.iter(|| black_box(Picker::new(&scene, &camera, &frame).nearest(middle, 10.0, Reach::Visible)));
    });
}

/// Images as windows draw them at rest and while something moves.
fn frames(criterion: &mut Criterion) {
    let (scene, camera) = (scene(), camera());
    for (name, samples_per_axis) in [("a draft", 1), ("an image", 3)] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for (what, with) in [("colours", false), ("colours, ids and depth", true)] {
            let outputs = Outputs { ids: with, depth: with, ..Outputs::default() };
            let settings =
                RenderSettings { outputs, samples_per_axis, ..RenderSettings::new(SIZE[0], SIZE[1]) };
            let mut renderer = Renderer::new(settings);
            let mut frame = Frame::default();
            group.bench_function(what, |bench| {
                bench.iter(|| renderer.render_into(&scene, &camera, &mut frame).expect("drawn"));
            });
        }
    }
}

criterion_group!(benches, elements, frames);
criterion_main!(benches);
