//! What equal depths cost: many triangles that coincide, as long as the same ones at
//! different depths.
//!
//! `cargo bench -p trigon-study --bench ties -- --samples 1,4 large small`

#![expect(clippy::print_stdout, reason = "a table is what this is for")]

use clap::{Parser, ValueEnum};
use std::error::Error;
use std::num::NonZeroUsize;
use trigon_math::Vec3;
use trigon_mesh::{Attributes, MeshBuilder};
use trigon_raster::simd::{F32, InlineMap, Simd, SimdLevel, prelude::*};
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, FragmentLanes, LanePipeline, Output, Pass, Rasterizer, Target,
    VertexLanes,
};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::math::DVec3;
use trigon_scene::{
    EffectSettings, Frame, Material, Node, RenderSettings, Renderer, Scene, Shading, ShadingModel, Shadows,
};
use trigon_study::workloads::Timings;

/// Draw coincident triangles, and the same ones at different depths, and print how long
/// frames take.
#[derive(Parser)]
struct Arguments {
    /// How many triangles lie over each other
    #[arg(long, value_name = "N", default_value = "4000")]
    triangles: u32,
    /// Width and height of the image in pixels
    #[arg(long, value_name = "N,N", value_delimiter = ',', default_value = "640,400")]
    size: Vec<u32>,
    /// Numbers of samples in a pixel
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1")]
    samples: Vec<u32>,
    /// Numbers of threads
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1")]
    threads: Vec<NonZeroUsize>,
    /// Draw with these instructions: scalar, sse2, avx2, avx512 or neon; the best, unless given
    #[arg(long, value_name = "LEVEL")]
    simd: Option<SimdLevel>,
    /// How many frames to time
    #[arg(long, value_name = "N", default_value = "5")]
    repetitions: usize,
    /// Orders of keys; all, unless given
    #[arg(long, value_name = "ORDER,…", value_delimiter = ',')]
    keys: Vec<Keys>,
    /// How they meet what lies behind them; all, unless given
    #[arg(long, value_name = "SURFACE,…", value_delimiter = ',')]
    surfaces: Vec<Kind>,
    /// Only this arrangement of depths, as many frames as are repeated, none to warm up:
    /// for counting instructions
    #[arg(long, value_name = "DEPTHS")]
    only: Option<Depths>,
    /// What cargo tells benches
    #[arg(long, hide = true)]
    bench: bool,
    /// Shapes of triangles; all, unless given
    #[arg(value_name = "SHAPE")]
    shapes: Vec<Shape>,
}

/// Which part of the image each triangle covers.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Shape {
    /// All of it.
    Large,
    /// 12 pixels across, all of them at one place.
    Small,
    /// 3 pixels across, all of them at one place.
    Micro,
    /// 12 pixels across, side by side over the image, 20 for each triangle of the others.
    Spread,
    /// All of it, as faces of one mesh that a scene draws.
    Scene,
}

/// Which of the triangles is seen where they are equally deep.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Keys {
    /// Faces of one object go round 50 materials, each of which is a draw.
    Materials,
    /// The same, the last face drawn first.
    Reversed,
    /// The same, faces in no order.
    Shuffled,
    /// 50 objects.
    Objects,
    /// Each triangle is an object.
    Single,
}

/// How deep they lie, in the order in which they compete.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Depths {
    Equal,
    BackToFront,
    FrontToBack,
}

/// Opaque, masked or translucent.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Kind {
    Opaque,
    Masked,
    Translucent,
}

impl Kind {
    fn surface(self) -> BlendMode {
        match self {
            Self::Opaque => BlendMode::Opaque,
            Self::Masked => BlendMode::Masked,
            Self::Translucent => BlendMode::Translucent,
        }
    }
}

const MATERIALS: u32 = 50;

/// What is drawn, and how.
#[derive(Clone, Copy)]
struct Case {
    shape: Shape,
    keys: Keys,
    kind: Kind,
    triangles: u32,
    size: [u32; 2],
    samples: u32,
    settings: ExecuteSettings,
    repetitions: usize,
}

/// The triangles of one draw, in one colour.
struct Part {
    object: u32,
    positions: [Vec<f32>; 3],
    triangles: Vec<[u32; 3]>,
    faces: Vec<u32>,
}

impl LanePipeline for Part {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z] = self.positions.each_ref().each(
            #[inline(always)]
            |column| vertices.load(simd, column),
        );
        [x, y, z, F32::splat(simd, 1.0)]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let shade = (self.triangles.len() % 7) as f32 / 7.0;
        [0.25, 0.5, shade, 0.5].each(
            #[inline(always)]
            |channel| F32::splat(simd, channel),
        )
    }
}

impl Case {
    /// How many triangles there are in all.
    fn count(&self) -> u32 {
        if self.shape == Shape::Spread { 20 * self.triangles } else { self.triangles }
    }

    /// The corners of a triangle in clip space.
    fn corners(&self, triangle: u32) -> [[f32; 2]; 3] {
        let pixels = match self.shape {
            Shape::Large | Shape::Scene => return [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]],
            Shape::Small | Shape::Spread => 12.0,
            Shape::Micro => 3.0,
        };
        let [width, height] = self.size.map(|side| side as f32);
        let columns = (width / pixels) as u32;
        let cell = if self.shape == Shape::Spread {
            let cells = columns * (height / pixels) as u32;
            [triangle % cells % columns, triangle % cells / columns]
        } else {
            [columns / 2; 2]
        };
        let place = |[x, y]: [f32; 2]| {
            let [x, y] = [(cell[0] as f32 + x) * pixels, (cell[1] as f32 + y) * pixels];
            [2.0 * x / width - 1.0, 2.0 * y / height - 1.0]
        };
        [place([0.0, 0.0]), place([1.0, 0.0]), place([0.0, 1.0])]
    }

    /// The draws in the order in which the frame takes them.
    fn parts(&self, depths: Depths) -> Vec<Part> {
        let draws = if self.keys == Keys::Single { self.count() } else { MATERIALS };
        let mut drawn = 0;
        let part = |draw: u32| {
            let faces: Vec<_> = (draw..self.count()).step_by(draws as usize).collect();
            let mut positions = [const { Vec::new() }; 3];
            for &face in &faces {
                drawn += 1;
                let share = drawn as f32 / (self.count() + 1) as f32;
                let depth = match depths {
                    Depths::Equal => 0.5,
                    Depths::BackToFront => share,
                    Depths::FrontToBack => 1.0 - share,
                };
                for [x, y] in self.corners(face) {
                    for (column, value) in positions.iter_mut().zip([x, y, depth]) {
                        column.push(value);
                    }
                }
            }
            let triangles = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            let object = if matches!(self.keys, Keys::Objects | Keys::Single) { draw } else { 0 };
            Part { object, positions, triangles, faces: faces.iter().map(|&face| self.named(face)).collect() }
        };
        (0..draws).map(part).collect()
    }

    /// The face id of a triangle.
    fn named(&self, face: u32) -> u32 {
        /// A prime, so that no two ids are the same.
        const LEAP: u64 = 7_368_787;
        match self.keys {
            Keys::Reversed => self.count() - 1 - face,
            Keys::Shuffled => (u64::from(face) * LEAP % u64::from(self.count())) as u32,
            Keys::Materials | Keys::Objects | Keys::Single => face,
        }
    }

    fn milliseconds(&self, depths: Depths, counting: bool) -> Result<f64, Box<dyn Error>> {
        if self.shape == Shape::Scene {
            self.by_scene(depths, counting)
        } else {
            self.by_pass(depths, counting)
        }
    }

    fn by_pass(&self, depths: Depths, counting: bool) -> Result<f64, Box<dyn Error>> {
        let parts = self.parts(depths);
        let mut pass = Pass::new();
        for part in &parts {
            pass.triangles(Draw {
                object: part.object,
                faces: Some(&part.faces),
                blend_mode: self.kind.surface(),
                culling: Culling::None,
                ..Draw::new(part, &part.triangles)
            });
        }
        let [width, height] = self.size;
        let mut target = Target::new(width, height, &[Output::Srgb8])?.with_samples(self.samples)?;
        let mut rasterizer = Rasterizer::new(self.settings)?;
        Ok(self.shortest(counting, || {
            rasterizer.draw(&pass, &mut target);
        }))
    }

    /// Through a mesh whose faces are copies of each other, of many materials.
    fn by_scene(&self, depths: Depths, counting: bool) -> Result<f64, Box<dyn Error>> {
        let mut mesh = MeshBuilder::new();
        let mut materials = Vec::new();
        for face in 0..self.count() {
            // A material's faces are drawn one after the other.
            let place = face % MATERIALS * (self.count() / MATERIALS) + face / MATERIALS;
            let share = (place + 1) as f32 / (self.count() + 1) as f32;
            let near = match depths {
                Depths::Equal => 0.5,
                Depths::BackToFront => share,
                Depths::FrontToBack => 1.0 - share,
            };
            let corners = [[-9.0, -9.0], [18.0, -9.0], [-9.0, 18.0]];
            let corners = corners.map(|[x, y]| mesh.push_vertex(Vec3::new(x, y, near)));
            mesh.push_face(&corners)?;
            materials.push(face % MATERIALS);
        }
        let mut mesh = mesh.build();
        mesh.set_attributes(Attributes { face_materials: Some(materials), ..Attributes::default() })?;
        let mut scene = Scene::new();
        let look = |i: u32| {
            let base_color = Vec3::splat(i as f32 / MATERIALS as f32).extend(1.0);
            Material { base_color, shading: Shading::Unlit, ..Material::default() }
        };
        let materials = (0..MATERIALS).map(|i| scene.add_material(look(i))).collect();
        let mesh = Some(scene.add_mesh("faces", mesh));
        let mut node = Node::default();
        (node.mesh, node.materials) = (mesh, materials);
        scene.add(node);
        let projection = Projection::perspective(0.8, 1.0, Some(20.0))?;
        let camera = Camera::look_at(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO, DVec3::Y);
        let camera = Camera { projection, ..camera };
        let settings = RenderSettings {
            samples_per_axis: 1,
            samples: self.samples,
            shading: ShadingModel::Flat,
            effects: EffectSettings { shadows: Shadows::Off, ..EffectSettings::default() },
            threads: self.settings.threads,
            simd: self.settings.simd,
            ..RenderSettings::new(self.size[0], self.size[1])
        };
        let (mut renderer, mut frame) = (Renderer::new(settings), Frame::default());
        renderer.render_into(&scene, &camera, &mut frame)?;
        Ok(self.shortest(counting, || {
            renderer.render_into(&scene, &camera, &mut frame).expect("drawn before");
        }))
    }

    fn shortest(&self, counting: bool, mut frame: impl FnMut()) -> f64 {
        if counting {
            (0..self.repetitions).for_each(|_| frame());
            return 0.0;
        }
        Timings::of_frames(self.repetitions, frame).min()
    }
}

/// The values of an option, all of them if none is given.
fn or_all<T: ValueEnum + Clone>(chosen: &[T]) -> Vec<T> {
    if chosen.is_empty() { T::value_variants().to_vec() } else { chosen.to_vec() }
}

impl Arguments {
    fn cases(&self) -> Result<Vec<Case>, Box<dyn Error>> {
        let &[width, height] = self.size.as_slice() else { return Err("write a width and a height".into()) };
        let mut cases = Vec::new();
        for shape in or_all(&self.shapes) {
            for (keys, kind) in or_all(&self.keys)
                .into_iter()
                .flat_map(|keys| or_all(&self.surfaces).into_iter().map(move |kind| (keys, kind)))
            {
                // A scene has one of them.
                if shape == Shape::Scene && (keys, kind) != (Keys::Materials, Kind::Opaque) {
                    continue;
                }
                for &samples in &self.samples {
                    cases.extend(self.threads.iter().map(|&threads| {
                        let settings = ExecuteSettings {
                            threads: Some(threads),
                            simd: self.simd,
                            ..ExecuteSettings::default()
                        };
                        let (triangles, size, repetitions) =
                            (self.triangles, [width, height], self.repetitions);
                        Case { shape, keys, kind, triangles, size, samples, settings, repetitions }
                    }));
                }
            }
        }
        Ok(cases)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.only.is_none() {
        println!(
            "shape,keys,surface,samples,threads,ms_equal,ms_back_to_front,ms_front_to_back,equal_to_back_to_front"
        );
    }
    for case in arguments.cases()? {
        if let Some(depths) = arguments.only {
            case.milliseconds(depths, true)?;
            continue;
        }
        let time = |depths| case.milliseconds(depths, false);
        let [equal, back, front] =
            [time(Depths::Equal)?, time(Depths::BackToFront)?, time(Depths::FrontToBack)?];
        let Case { shape, keys, kind, samples, .. } = case;
        let threads = case.settings.threads.map_or(0, NonZeroUsize::get);
        let ratio = equal / back;
        println!(
            "{shape:?},{keys:?},{kind:?},{samples},{threads},{equal:.2},{back:.2},{front:.2},{ratio:.2}"
        );
    }
    Ok(())
}
