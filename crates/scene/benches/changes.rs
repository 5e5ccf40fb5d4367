//! From a change of a mesh to the image that shows it: 10,000 vertices of a torus of a
//! million triangles, in one place or all over it, 1920×1080 pixels, one sample.
//!
//! ```sh
//! cargo bench -p trigon-scene --bench changes -- [derived|given|sheet] [edges] [stages] [KIND …] [ROUNDS] [THREADS]
//! ```
//!
//! The torus takes its normals from its faces (`derived`, if nothing else is said), so that
//! they change with the vertices, or has normals of its own (`given`). Instead of the torus, `sheet` draws a flat grid of as
//! many polygons, in which the patch is visible. In each round the
//! cases take turns: an image without a change, one after each kind of change, and one
//! after the same change by a new mesh; or only those that are named: `none`, `compact`,
//! `scattered`, `replaced`. The last image of each is held against one of a new scene, byte
//! for byte. `stages` also prints the median time of each stage of the rasterizer; measuring them takes some time, too.

#![expect(clippy::print_stdout, reason = "numbers are what this is for")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::{Duration, Instant};

use trigon_scene::camera::Camera;
use trigon_scene::math::Vec3;
use trigon_scene::mesh::{Attributes, Mesh, MeshChange, primitives};
use trigon_scene::{Frame, Material, MeshId, RenderSettings, Renderer, Scene, StageTimes, Style, render};

/// Quads round the ring and round the tube: a million triangles.
const QUADS: [u32; 2] = [1000, 500];
const MOVED: u32 = 10_000;
const KINDS: [Kind; 4] = [Kind::None, Kind::Compact, Kind::Scattered, Kind::Replaced];

/// What happens before an image.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Nothing.
    None,
    /// Vertices of a patch are moved.
    Compact,
    /// As many are moved all over the mesh.
    Scattered,
    /// The same in a new mesh.
    Replaced,
}

/// One scene for each kind, and what it is drawn with.
struct Case {
    kind: Kind,
    scene: Scene,
    mesh: MeshId,
    renderer: Renderer,
    /// The last image. It is released before the next one is drawn, whose memory it becomes.
    frame: Arc<Frame>,
    times: Vec<f64>,
    stages: Vec<StageTimes>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let says = |word: &str| words.iter().any(|said| said == word);
    let numbers: Vec<usize> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let rounds = numbers.first().copied().unwrap_or(21);
    let settings = RenderSettings {
        samples_per_axis: 1,
        style: if says("edges") { Style::SurfaceWithEdges } else { Style::Surface },
        threads: NonZeroUsize::new(numbers.get(1).copied().unwrap_or(2)),
        ..RenderSettings::new(1920, 1080)
    };
    let torus = if says("sheet") { sheet() } else { torus(says("given")) };
    let is_named = |kind: &&Kind| says(&format!("{kind:?}").to_lowercase());
    let named: Vec<&Kind> = KINDS.iter().filter(is_named).collect();
    let kinds = if named.is_empty() { KINDS.iter().collect() } else { named };
    let mut cases: Vec<Case> =
        kinds.into_iter().map(|&kind| Case::new(kind, torus.clone(), settings.clone())).collect();
    let camera = cases[0].scene.overview(settings.aspect());
    for case in &mut cases {
        if says("stages") {
            case.renderer.time_stages();
        }
        let first = case.first(&camera)?;
        println!("{:?}: {first:.1} ms for the first change", case.kind);
    }
    for round in 0..rounds {
        for case in &mut cases {
            let time = case.round(round as u32, &camera)?;
            case.times.push(time);
            case.stages.push(case.renderer.stats().times);
        }
    }
    for case in &mut cases {
        case.times.sort_by(f64::total_cmp);
        let (shortest, median) = (case.times[0], case.times[case.times.len() / 2]);
        println!("{:?}: {shortest:.2} ms at best, {median:.2} ms in the middle of {rounds}", case.kind);
        if says("stages") {
            println!("{}", medians(&case.stages));
        }
        let mut fresh = Scene::new();
        let mesh = case.scene.meshes().get(case.mesh).expect("it is there").mesh().clone();
        fresh.add_object("torus", mesh, Material::default());
        assert!(render(&fresh, &camera, &settings)? == *case.frame, "the bytes of a new scene");
    }
    Ok(())
}

/// The median time of each stage: elapsed before the tiles, and the sum over all threads in them.
fn medians(stages: &[StageTimes]) -> String {
    type Stage = (&'static str, fn(&StageTimes) -> Duration);
    let all: [Stage; 5] = [
        ("vertices", |times| times.vertices),
        ("set-up", |times| times.set_up),
        ("visibility", |times| times.visibility),
        ("shading", |times| times.shading),
        ("resolve", |times| times.resolve),
    ];
    let median = |(name, stage): Stage| {
        let mut times: Vec<Duration> = stages.iter().map(stage).collect();
        times.sort();
        format!("    {name} {:.2} ms", times[times.len() / 2].as_secs_f64() * 1e3)
    };
    all.map(median).join("")
}

fn torus(has_normals: bool) -> Mesh {
    let mut torus = primitives::torus(1.0, 0.4, QUADS[0], QUADS[1]);
    if !has_normals {
        let attributes = Attributes { corner_normals: None, ..torus.attributes().clone() };
        torus.set_attributes(attributes).expect("one less");
    }
    torus
}

/// Flat polygons.
fn sheet() -> Mesh {
    let mut sheet = primitives::grid(10.0, 5.0, QUADS[0], QUADS[1]);
    sheet.set_attributes(Attributes::default()).expect("none");
    sheet
}

impl Case {
    fn new(kind: Kind, mesh: Mesh, settings: RenderSettings) -> Self {
        let mut scene = Scene::new();
        scene.add_object("torus", mesh, Material::default());
        let (mesh, _) = scene.meshes().iter().next().expect("it was added");
        Self {
            kind,
            scene,
            mesh,
            renderer: Renderer::new(settings),
            frame: Arc::default(),
            times: Vec::new(),
            stages: Vec::new(),
        }
    }

    /// Draws what was loaded; the milliseconds of the first change and its image.
    fn first(&mut self, camera: &Camera) -> Result<f64, Box<dyn Error>> {
        self.frame = self.renderer.render_shared(&self.scene, camera, None)?;
        self.round(0, camera)
    }

    /// The milliseconds from a change to the image.
    fn round(&mut self, round: u32, camera: &Camera) -> Result<f64, Box<dyn Error>> {
        let change = self.change(round);
        self.frame = Arc::default();
        let start = Instant::now();
        match self.kind {
            Kind::None => {}
            Kind::Compact | Kind::Scattered => self.scene.change_mesh(self.mesh, &change)?,
            Kind::Replaced => {
                let mut mesh = self.mesh().clone();
                mesh.change(&change)?;
                self.scene.replace_mesh(self.mesh, mesh).expect("it is there");
            }
        }
        self.frame = self.renderer.render_shared(&self.scene, camera, None)?;
        Ok(start.elapsed().as_secs_f64() * 1e3)
    }

    fn mesh(&self) -> &Mesh {
        self.scene.meshes().get(self.mesh).expect("it is there").mesh()
    }

    /// Pulls vertices from the middle of the ring or pushes them to it, by turns.
    fn change(&self, round: u32) -> MeshChange {
        let positions = self.mesh().positions();
        let count = positions.len() as u32;
        // A fifth of a quad's width, so that none folds.
        let factor = if round.is_multiple_of(2) { 1.001 } else { 1.0 / 1.001 };
        let vertex = |number: u32| match self.kind {
            // A patch of 100 by 100, on the upper side.
            Kind::Compact => (count / 4 / QUADS[0] + number / 100) * QUADS[0] + number % 100 + 200,
            // One of each fifty, in no order: hardly any two share a face.
            _ => {
                let place = number * 7919 % MOVED;
                place * 50 + place * 31 % 50
            }
        };
        let moved = (0..MOVED).map(vertex).map(|vertex| {
            let place = positions[vertex as usize];
            (vertex, place * Vec3::new(factor, 1.0, factor))
        });
        MeshChange { positions: moved.collect(), ..MeshChange::default() }
    }
}
