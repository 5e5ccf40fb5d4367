//! What edges of faces cost, and how near they come to the area that lines cover:
//!
//! `cargo run --release -p trigon-study --example edges -- --threads 1,2 --png edges`
//!
//! For the memory that they take, the peak of two processes (`time -v`), with `--only surface`
//! and with `--only edges`, each with `--no-comparison`.

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use clap::Parser;
use image::ExtendedColorType;
use std::error::Error;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;
use trigon_math::color::linear_to_srgba8;
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::{Mesh, MeshBuilder, primitives};
use trigon_raster::simd::SimdLevel;
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    Background, Frame, Material, Outputs, RenderSettings, Renderer, Scene, Shading, Style, ToneMapping,
};
use trigon_study::oracle::face_edges::{View, coverage};

/// Time a torus of a million triangles with and without edges, and compare small images
/// with the exact area of the lines.
#[derive(Parser)]
struct Arguments {
    /// Numbers of threads to draw with, one after the other
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1,2")]
    threads: Vec<NonZeroUsize>,
    /// Draw with these instructions; the best, unless given
    #[arg(long, value_name = "LEVEL")]
    simd: Option<SimdLevel>,
    /// How many frames to time of each kind, in turns
    #[arg(long, value_name = "N", default_value = "12")]
    repetitions: usize,
    /// Draw only such frames: for counting instructions
    #[arg(long, value_name = "STYLE", value_parser = ["surface", "edges"])]
    only: Option<String>,
    /// Leave the comparison out
    #[arg(long)]
    no_comparison: bool,
    /// Save the images in this folder
    #[arg(long, value_name = "FOLDER")]
    png: Option<PathBuf>,
}

const STYLES: [(Style, &str); 2] = [(Style::Surface, "surface"), (Style::SurfaceWithEdges, "edges")];

/// The torus of the workload W2, from where that is seen. Of quads, or of triangles.
fn torus(is_cut: bool) -> (Scene, Camera) {
    let mut mesh = primitives::torus(1.0, 0.4, 1000, 500);
    if is_cut {
        mesh = cut(&mesh);
    }
    let mut scene = Scene::new();
    scene.add_object("torus", mesh, Material::default());
    let projection = Projection::perspective(45_f64.to_radians(), 0.5, Some(10.0)).expect("in range");
    (scene, Camera::look_at(DVec3::new(0.0, 2.1, 3.0), DVec3::ZERO, DVec3::Y).with_projection(projection))
}

/// A face for each triangle.
fn cut(mesh: &Mesh) -> Mesh {
    let mut builder = MeshBuilder::new();
    for &position in mesh.positions() {
        builder.push_vertex(position);
    }
    for triangle in mesh.triangulation().triangles {
        let vertices = triangle.map(|corner| mesh.corner_vertices()[corner as usize]);
        builder.push_face(&vertices).expect("vertices of the mesh");
    }
    builder.build()
}

fn measure(arguments: &Arguments, is_cut: bool, threads: NonZeroUsize) -> Result<(), Box<dyn Error>> {
    let (scene, camera) = torus(is_cut);
    let base = RenderSettings {
        samples_per_axis: 1,
        threads: Some(threads),
        simd: arguments.simd,
        ..RenderSettings::new(1920, 1080)
    };
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|only| only == name);
    let styles: Vec<_> = STYLES.into_iter().filter(|(_, name)| wanted(name)).collect();
    let mut renderers: Vec<_> = styles
        .iter()
        .map(|&(style, _)| (Renderer::new(RenderSettings { style, ..base.clone() }), Vec::new()))
        .collect();
    let mut frame = Frame::default();
    for round in 0..arguments.repetitions + 2 {
        for (renderer, times) in &mut renderers {
            let start = Instant::now();
            renderer.render_into(&scene, &camera, &mut frame)?;
            // The first ones fill caches and memory.
            if round >= 2 {
                times.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }
    let faces = if is_cut { "triangles" } else { "quads" };
    for ((_, times), (_, name)) in renderers.iter_mut().zip(&styles) {
        times.sort_by(f64::total_cmp);
        let Some(shortest) = times.first() else { continue };
        let median = times[times.len() / 2];
        println!("{faces}, {threads} threads, {name}: shortest {shortest:.2} ms, median {median:.2} ms");
    }
    if let Some(folder) = &arguments.png {
        save(&folder.join(format!("million-{faces}.png")), [1920, 1080], &frame.color)?;
    }
    Ok(())
}

fn save(path: &Path, [width, height]: [u32; 2], pixels: &[u8]) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    Ok(image::save_buffer(path, pixels, width, height, ExtendedColorType::Rgba8)?)
}

/// A mesh and the eye that sees it.
struct Case {
    name: &'static str,
    mesh: Mesh,
    eye: DVec3,
}

/// A star whose triangles are slivers.
fn concave() -> Mesh {
    let mut builder = MeshBuilder::new();
    let outline = [
        [-1.0, -0.6],
        [-0.2, -0.55],
        [0.0, -0.6],
        [0.2, -0.55],
        [1.0, -0.6],
        [0.3, 0.0],
        [0.9, 0.7],
        [0.05, 0.15],
        [0.0, 0.8],
        [-0.05, 0.15],
        [-0.9, 0.7],
        [-0.3, 0.0],
    ];
    let corners = outline.map(|[x, y]| builder.push_vertex(Vec3::new(x, y, 0.0)));
    builder.push_face(&corners).expect("a polygon");
    builder.build()
}

fn cases() -> Vec<Case> {
    let case = |name, mesh, [x, y, z]: [f64; 3]| Case { name, mesh, eye: DVec3::new(x, y, z) };
    vec![
        case("cube", primitives::cube(1.0), [1.3, 0.9, 1.7]),
        case("cylinder", primitives::cylinder(0.6, 1.2, 24), [0.8, 1.6, 1.6]),
        case("concave", concave(), [0.3, 0.4, 2.2]),
        case("torus near", primitives::torus(0.7, 0.3, 24, 12), [0.4, 1.4, 1.8]),
        case("torus silhouette", primitives::torus(0.7, 0.3, 24, 12), [0.0, 0.3, 2.0]),
        case("torus far", primitives::torus(0.7, 0.3, 48, 24), [2.0, 6.0, 9.0]),
        case("triangles", cut(&primitives::torus(0.7, 0.3, 48, 24)), [1.0, 1.0, 2.0]),
    ]
}

/// The image of black edges on white faces before white, and how dark it is.
fn drawn(case: &Case, width: f32, samples: [u32; 2]) -> Result<(Frame, Vec<f64>), Box<dyn Error>> {
    let mut scene = Scene::new();
    let white = Material {
        base_color: Vec4::ONE,
        shading: Shading::Unlit,
        double_sided: true,
        ..Material::default()
    };
    scene.add_object("it", case.mesh.clone(), white);
    let projection = Projection::perspective(45_f64.to_radians(), 0.1, None)?;
    let camera = Camera::look_at(case.eye, DVec3::ZERO, DVec3::Y).with_projection(projection);
    let mut settings = RenderSettings {
        samples_per_axis: samples[0],
        samples: samples[1],
        background: Background::Color(Vec3::ONE),
        style: Style::SurfaceWithEdges,
        line_width: width,
        edge_color: Vec3::ZERO,
        outputs: Outputs { radiance: true, ..Outputs::default() },
        ..RenderSettings::new(SIZE[0] as u32, SIZE[1] as u32)
    };
    settings.effects.tone_mapping = ToneMapping::None;
    let frame = Renderer::new(settings).render(&scene, &camera)?;
    let darkness = frame.radiance.iter().flatten().map(|color| 1.0 - f64::from(color.x)).collect();
    Ok((frame, darkness))
}

/// Of the images that are compared.
const SIZE: [usize; 2] = [192, 144];

/// The share of each pixel that lines cover.
fn exact(case: &Case, width: f32) -> Vec<f64> {
    let half_height = std::f64::consts::SQRT_2 - 1.0;
    let view = View { eye: case.eye, target: DVec3::ZERO, half_height, size: SIZE };
    let positions: Vec<DVec3> = case.mesh.positions().iter().map(|position| position.as_dvec3()).collect();
    let corners = case.mesh.corner_vertices();
    let faces = (0..case.mesh.face_count()).map(|face| corners[case.mesh.face_corners(face)].to_vec());
    coverage(&view, &positions, &faces.collect::<Vec<_>>(), f64::from(width))
}

/// One image beside the exact area: the root of the mean square of the difference, over all
/// pixels.
fn compare(arguments: &Arguments, case: &Case, width: f32) -> Result<(), Box<dyn Error>> {
    let exact = exact(case, width);
    let path = |end: &str| {
        let folder = arguments.png.as_ref()?;
        Some(folder.join(format!("{}-{width}-{end}.png", case.name.replace(' ', "-"))))
    };
    let size = SIZE.map(|side| side as u32);
    let count = exact.len() as f64;
    print!("{}, width {width}, {:.3} is covered: RMSE", case.name, exact.iter().sum::<f64>() / count);
    for (samples, name) in [([1, 1], "1 sample"), ([3, 1], "3×3"), ([1, 4], "4")] {
        let (frame, found) = drawn(case, width, samples)?;
        let squares: f64 = found.iter().zip(&exact).map(|(a, b)| (a - b) * (a - b)).sum();
        print!(" {:.4} with {name},", (squares / count).sqrt());
        if let Some(path) = path(name) {
            save(&path, size, &frame.color)?;
        }
    }
    println!();
    if let Some(path) = path("exact") {
        let grey = |&share: &f64| linear_to_srgba8(Vec4::splat(1.0 - share as f32).with_w(1.0));
        save(&path, size, &exact.iter().flat_map(grey).collect::<Vec<u8>>())?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    for &threads in &arguments.threads {
        for is_cut in [false, true] {
            measure(&arguments, is_cut, threads)?;
        }
    }
    if arguments.no_comparison {
        return Ok(());
    }
    for case in cases() {
        for width in [0.5, 1.0, 2.0, 5.0] {
            compare(&arguments, &case, width)?;
        }
    }
    Ok(())
}
