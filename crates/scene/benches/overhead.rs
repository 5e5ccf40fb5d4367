//! What the scene renderer costs above a pipeline written by hand for the same image: a torus knot of 70,000
//! triangles, unlit in one colour, or with a texture and light at the vertices.
//!
//! Times, or instructions of one warm frame (the difference of two counts):
//!
//! ```sh
//! cargo bench -p trigon-scene --bench overhead -- scene plain 50
//! program=$(ls -t target/release/deps/overhead-* | grep -v '\.d$' | head -n 1)
//! for frames in 1 11; do valgrind --tool=callgrind "$program" hand plain $frames; done
//! ```
//!
//! The first word is `scene` or `hand`, the second `plain` or `textured`; by the scene
//! also `mapped`: with a normal map, lighting per pixel, and the shadow map (1024²)
//! of the one lamp, which is drawn in the first frame.

#![expect(clippy::print_stdout, reason = "a number is what this is for")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Instant;

use trigon_raster::simd::{F32, InlineMap, Simd, greater, prelude::*};
use trigon_raster::{
    Background as Behind, Culling, Draw, ExecuteSettings, FragmentLanes, LanePipeline, Pass, Rasterizer,
    Sampler, Target, Texture, TextureFormat, VertexLanes,
};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::math::{DVec3, Mat4, Vec3, Vec4};
use trigon_scene::mesh::primitives::{TorusKnot, torus_knot};
use trigon_scene::mesh::{Mesh, RenderMesh};
use trigon_scene::{
    Background, EffectSettings, Frame, Light, Lighting, Material, Node, NormalMap, RenderSettings, Renderer,
    Scene, Shading, ShadingModel, Shadows, TextureBinding,
};

const SIZE: [u32; 2] = [1920, 1080];
const AMBIENT: f32 = 0.1;
const LIGHT: f32 = 0.9;
const COLOR: Vec3 = Vec3::new(0.85, 0.65, 0.4);
const BEHIND: Vec3 = Vec3::new(0.1, 0.1, 0.15);

const USAGE: &str = "write: scene plain|textured|mapped FRAMES, or: hand plain|textured FRAMES";

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let [by, look, frames] = words.as_slice() else {
        return Err(USAGE.into());
    };
    let frames: u32 = frames.parse()?;
    let look = match look.as_str() {
        "plain" => Look::Plain,
        "textured" => Look::Textured,
        "mapped" => Look::Mapped,
        _ => return Err(USAGE.into()),
    };
    let (mesh, camera) = (knot(), camera());
    let times = match (by.as_str(), look) {
        ("scene", _) => by_scene(mesh, &camera, look, frames)?,
        ("hand", Look::Plain | Look::Textured) => by_hand(&mesh, &camera, look, frames)?,
        _ => return Err(USAGE.into()),
    };
    println!("{by} {look:?}: {times:.3} ms (the shortest of {frames})");
    Ok(())
}

/// What is drawn on the knot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    Plain,
    Textured,
    Mapped,
}

fn knot() -> Mesh {
    torus_knot(&TorusKnot {
        major_radius: 1.0,
        minor_radius: 0.5,
        tube_radius: 0.28,
        segments: 700,
        sides: 50,
        ..TorusKnot::default()
    })
}

fn camera() -> Camera {
    let projection = Projection::perspective(45_f64.to_radians(), 1.0, Some(20.0));
    let camera = Camera::look_at(DVec3::new(0.3, 0.4, 4.6), DVec3::ZERO, DVec3::Y);
    Camera { projection: projection.expect("the numbers are in range"), ..camera }
}

/// A checker with a finer pattern in its squares.
fn texture() -> Texture {
    let texel = |x: u32, y: u32| {
        let shade = (x ^ y) % 64 * 2 / 3;
        let tint = if (x / 64 + y / 64) % 2 == 1 { [230, 120, 60] } else { [60, 130, 220] };
        let [r, g, b] = tint.map(|channel: u32| (channel - shade) as u8);
        [r, g, b, 255]
    };
    let texels = (0..1024).flat_map(|y| (0..1024).map(move |x| texel(x, y))).collect();
    Texture::new(1024, 1024, texels, TextureFormat::Srgb).expect("the size is in range")
}

/// Normals that tilt to and fro.
fn bumps() -> Texture {
    let tilt = |i: u32| (128 + (i % 32).abs_diff(16) * 4 - 32) as u8;
    let texels = (0..1024).flat_map(|y| (0..1024).map(move |x| [tilt(x), tilt(y), 230, 255])).collect();
    Texture::new(1024, 1024, texels, TextureFormat::Linear).expect("the size is in range")
}

/// The shortest time of a frame in milliseconds.
fn shortest(frames: u32, mut frame: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        frame();
        start.elapsed().as_secs_f64() * 1e3
    };
    (0..frames).map(time).fold(f64::INFINITY, f64::min)
}

fn by_scene(mesh: Mesh, camera: &Camera, look: Look, frames: u32) -> Result<f64, Box<dyn Error>> {
    let mut scene = Scene::new();
    let material = Material { base_color: COLOR.extend(1.0), double_sided: false, ..Material::default() };
    let material = if look == Look::Plain {
        Material { shading: Shading::Unlit, ..material }
    } else {
        let base_color_texture = Some(TextureBinding::new(scene.add_texture("checker", texture())));
        let bumps = (look == Look::Mapped).then(|| scene.add_texture("bumps", bumps()));
        let normal_map = bumps.map(|bumps| NormalMap { binding: TextureBinding::new(bumps), scale: 1.0 });
        let shading = Shading::Lambert;
        Material { base_color: Vec4::ONE, base_color_texture, normal_map, shading, ..material }
    };
    scene.add_object("knot", mesh, material);
    scene.add(Node::from_light(Light::ambient(AMBIENT)));
    scene.add(Node::from_light(Light::directional(LIGHT)));
    let settings = RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(BEHIND),
        lighting: Lighting::Scene,
        shading: if look == Look::Mapped { ShadingModel::Phong } else { ShadingModel::Gouraud },
        effects: EffectSettings {
            shadows: if look == Look::Mapped { Shadows::Maps { resolution: 1024 } } else { Shadows::Off },
            ..EffectSettings::default()
        },
        threads: NonZeroUsize::new(1),
        ..RenderSettings::new(SIZE[0], SIZE[1])
    };
    let (mut renderer, mut frame) = (Renderer::new(settings), Frame::default());
    renderer.render_into(&scene, camera, &mut frame)?;
    Ok(shortest(frames, || {
        renderer.render_into(&scene, camera, &mut frame).expect("drawn before");
    }))
}

fn by_hand(mesh: &Mesh, camera: &Camera, look: Look, frames: u32) -> Result<f64, Box<dyn Error>> {
    let mesh = RenderMesh::from_mesh(mesh);
    let columns = Columns {
        positions: [0, 1, 2].map(|axis| mesh.positions.iter().map(|at| at[axis]).collect()),
        normals: [0, 1, 2].map(|axis| mesh.normals.iter().map(|at| at[axis]).collect()),
        uv: [0, 1].map(|axis| mesh.uv_sets[0].iter().map(|uv| uv[axis]).collect()),
        to_clip: camera.view_projection(f64::from(SIZE[0]) / f64::from(SIZE[1])).as_mat4(),
    };
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), ..ExecuteSettings::default() };
    let mut rasterizer = Rasterizer::new(settings)?;
    let mut pixels = vec![[0; 4]; SIZE[0] as usize * SIZE[1] as usize];
    let mut target = Target::new(SIZE[0], SIZE[1], &[])?.with_srgb8(&mut pixels)?;
    let texture = texture();
    let (plain, lit) = (Plain(&columns), Textured { columns: &columns, texture: &texture });
    let mut draw = || {
        let mut pass = Pass::new();
        pass.background(Behind::Color(BEHIND.extend(1.0)));
        if look == Look::Textured {
            pass.triangles(Draw { culling: Culling::Back, ..Draw::new(&lit, &mesh.triangles) });
        } else {
            pass.triangles(Draw { culling: Culling::Back, ..Draw::new(&plain, &mesh.triangles) });
        }
        rasterizer.draw(&pass, &mut target);
    };
    draw();
    Ok(shortest(frames, draw))
}

struct Columns {
    positions: [Vec<f32>; 3],
    normals: [Vec<f32>; 3],
    uv: [Vec<f32>; 2],
    to_clip: Mat4,
}

impl Columns {
    #[inline(always)]
    fn place<S: Simd>(&self, simd: S, vertices: &VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z] = &self.positions;
        let [x, y, z] = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        self.to_clip.transpose().to_cols_array_2d().each(
            #[inline(always)]
            |[a, b, c, d]| x * a + y * b + z * c + d,
        )
    }
}

/// One colour.
struct Plain<'a>(&'a Columns);

impl LanePipeline for Plain<'_> {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.place(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        COLOR.extend(1.0).to_array().each(
            #[inline(always)]
            |channel| F32::splat(simd, channel),
        )
    }
}

/// A texture times light at the vertices, which comes from the camera's axis.
struct Textured<'a> {
    columns: &'a Columns,
    texture: &'a Texture,
}

impl LanePipeline for Textured<'_> {
    const VARYINGS: usize = 3;

    fn vertex_count(&self) -> usize {
        self.columns.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        for (axis, coordinates) in self.columns.uv.iter().enumerate() {
            vertices.set(axis, vertices.load(simd, coordinates));
        }
        let facing = vertices.load(simd, &self.columns.normals[2]);
        vertices.set(2, greater(facing, F32::splat(simd, 0.0)) * LIGHT + AMBIENT);
        self.columns.place(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v, light] = fragments.varyings::<3>(0);
        let [[ux, uy], [vx, vy]] = [fragments.gradient(0), fragments.gradient(1)];
        let sampler = Sampler::default();
        let [r, g, b, _] = self.texture.sample_lanes(simd, [u, v], [ux, vx], [uy, vy], &sampler);
        [r * light, g * light, b * light, F32::splat(simd, 1.0)]
    }
}
