//! Images of 1,600 objects, 25 million triangles, from an eye that moves on: 960×540 pixels, one sample.
//!
//! ```sh
//! cargo bench -p trigon-scene --bench crowds -- [ROUNDS] [THREADS]
//! ```
//!
//! `street`: houses in a square, seen from the street between two rows, so that most are hidden as a whole. `rings`: rings in
//! the same places, one behind the other, which hide little. The scenes take turns. Prints the median time and the longest one
//! but that of the first frame, and the triangles of the last frame.

#![expect(clippy::print_stdout, reason = "numbers are what this is for")]

use std::error::Error;
use std::num::NonZeroUsize;
use std::time::Instant;

use trigon_scene::camera::Camera;
use trigon_scene::math::DVec3;
use trigon_scene::mesh::{Mesh, primitives};
use trigon_scene::{Material, Node, RenderSettings, Renderer, Scene, Transform};

/// Objects along each side of the square.
const SIDE: u32 = 40;

/// From one object to the next.
const DISTANCE: f64 = 1.5;

/// A scene, and the way of the eye through it.
struct Crowd {
    name: &'static str,
    scene: Scene,
    renderer: Renderer,
    eye: DVec3,
    target: DVec3,
    times: Vec<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Vec<usize> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let rounds = numbers.first().copied().unwrap_or(33).max(2);
    let settings = RenderSettings {
        samples_per_axis: 1,
        threads: NonZeroUsize::new(numbers.get(1).copied().unwrap_or(2)),
        ..RenderSettings::new(960, 540)
    };
    let end = f64::from(SIDE) * DISTANCE;
    let middle = DVec3::new(0.5, 0.0, 0.5) * end;
    let mut crowds = [
        Crowd {
            name: "street",
            scene: square(house()),
            renderer: Renderer::new(settings.clone()),
            eye: DVec3::new(middle.x - 0.5 * DISTANCE, 0.1, -2.0),
            target: DVec3::new(middle.x - 0.5 * DISTANCE, 0.1, end),
            times: Vec::new(),
        },
        Crowd {
            name: "rings",
            scene: square(primitives::torus(0.4, 0.02, 500, 16)),
            renderer: Renderer::new(settings),
            eye: DVec3::new(middle.x - 0.5 * DISTANCE, 2.0, -2.0),
            target: middle,
            times: Vec::new(),
        },
    ];
    for round in 0..rounds {
        for crowd in &mut crowds {
            crowd.draw(round)?;
        }
    }
    for Crowd { name, renderer, times, .. } in &mut crowds {
        let times = &mut times[1..];
        times.sort_by(f64::total_cmp);
        let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
        let triangles = renderer.stats().primitives;
        println!("{name}: {median:.1} ms, at most {longest:.1}; {triangles} triangles");
    }
    Ok(())
}

impl Crowd {
    fn draw(&mut self, round: usize) -> Result<(), Box<dyn Error>> {
        let on = DVec3::new(0.0, 0.0, 0.01 * round as f64);
        let camera = Camera::look_at(self.eye + on, self.target + on, DVec3::Y);
        let start = Instant::now();
        self.renderer.render(&self.scene, &camera)?;
        self.times.push(start.elapsed().as_secs_f64() * 1e3);
        Ok(())
    }
}

/// Copies of a mesh, row by row.
fn square(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    let mesh = scene.add_mesh("object", mesh);
    let material = scene.add_material(Material::default());
    for number in 0..SIDE * SIDE {
        let place = DVec3::new(f64::from(number % SIDE), 0.0, f64::from(number / SIDE)) * DISTANCE;
        let mut node = Node::from_mesh(mesh, material);
        node.transform = Transform::from_translation(place);
        scene.add(node);
    }
    scene
}

/// A cube of 16,000 triangles: each vertex of a sphere moved away from the middle, onto the cube.
fn house() -> Mesh {
    let mut house = primitives::uv_sphere(0.6, 128, 63);
    for position in house.positions_mut() {
        *position *= 0.6 / position.abs().max_element();
    }
    house
}
