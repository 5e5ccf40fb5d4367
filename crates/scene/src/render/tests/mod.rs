//! Edges on surfaces: black on white, unlit, before white.

mod hidden;
mod marks;
mod wires;

use trigon_camera::{Camera, Projection};
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::{Mesh, MeshBuilder, primitives};

use super::render;
use crate::{Background, Material, Outputs, RenderSettings, Scene, Shading, Style};

/// The side of all images in pixels.
const SIDE: u32 = 96;

/// How dark each pixel is, of a mesh seen from straight above in parallel rays; the image
/// is `height` high.
fn darkness(mesh: Mesh, height: f64, style: Style, line_width: f32) -> Vec<f32> {
    let mut scene = Scene::new();
    let white = Material { base_color: Vec4::ONE, shading: Shading::Unlit, ..Material::default() };
    scene.add_object("it", mesh, white);
    let projection = Projection::orthographic(height, 0.1, 100.0).expect("in range");
    let camera = Camera::look_at(DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, DVec3::Z);
    let settings = RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(Vec3::ONE),
        style,
        line_width,
        edge_color: Vec3::ZERO,
        outputs: Outputs { radiance: true, ..Outputs::default() },
        ..RenderSettings::new(SIDE, SIDE)
    };
    let frame = render(&scene, &camera.with_projection(projection), &settings).expect("in range");
    frame.radiance.expect("asked for").iter().map(|color| 1.0 - color.x).collect()
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

/// Each face is a seventh of a pixel wide where it is widest.
#[test]
fn a_dense_mesh_far_away_keeps_the_colour_of_its_surface() {
    let sphere = primitives::uv_sphere(1.0, 1000, 500);
    for style in [Style::SurfaceWithEdges, Style::HiddenLine] {
        let found = darkness(sphere.clone(), 4.0, style, 1.0);
        let darkest = found.iter().copied().fold(0.0, f32::max);
        // Its radius of 1/14 of a pixel leaves lines less than 4 % of a face.
        assert!(darkest < 0.05, "{darkest} of a pixel is covered, {style:?}");
    }
}

#[test]
fn edges_grow_with_the_size_of_their_faces_and_never_hide_them() {
    let mut last = 0.0;
    for segments in [400, 200, 100, 50] {
        let grid = primitives::grid(2.0, 2.0, segments, segments);
        let covered = mean(&darkness(grid, 2.0, Style::SurfaceWithEdges, 4.0));
        // A third of the radius is 5/9 of the area; distances are sampled.
        assert!(covered < 0.6, "{covered} of the image with {segments} faces in a row");
        assert!(covered > last, "{covered} after {last}");
        last = covered;
    }
}

/// A polygon whose triangles are slivers: an arrow head with many corners on its sides.
fn sliver_polygon() -> Mesh {
    let mut builder = MeshBuilder::new();
    let side = |from: [f32; 2], to: [f32; 2]| {
        (0..20).map(move |i| [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * i as f32 / 20.0))
    };
    let outline = [[-0.8, -0.8], [0.8, -0.8], [0.8, 0.8], [-0.8, 0.8]];
    let sides = (0..4).flat_map(|i| side(outline[i], outline[(i + 1) % 4]));
    // Counter-clockwise seen from above, where +Z is up and so +X is on the left.
    let corners: Vec<u32> = sides.map(|[x, z]| builder.push_vertex(Vec3::new(-x, 0.0, z))).collect();
    builder.push_face(&corners).expect("a polygon");
    builder.build()
}

#[test]
fn polygons_of_slivers_show_their_outline_in_full_width_and_no_diagonal() {
    // 48 pixels are 1 unit: the sides lie 9.6 pixels from the image's.
    let found = darkness(sliver_polygon(), 2.0, Style::SurfaceWithEdges, 3.0);
    let at = |x: u32, y: u32| found[(y * SIDE + x) as usize];
    for y in 20..76 {
        for (x, expected) in [(7, 0.0), (8, 0.9), (9, 1.0), (10, 1.0), (11, 0.1), (12, 0.0)] {
            // Half a step of the grid of 1/256 pixel, and roundings.
            assert!((at(x, y) - expected).abs() < 0.003, "{} for {expected} at ({x}, {y})", at(x, y));
        }
        assert!((14..82).all(|x| at(x, y) == 0.0), "no diagonal crosses row {y}");
    }
}

#[test]
fn the_cap_of_a_cylinder_shows_its_rim_alone() {
    let found = darkness(primitives::cylinder(1.0, 1.0, 40), 2.5, Style::SurfaceWithEdges, 2.0);
    let radius = f64::from(SIDE) / 2.5;
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        let middle = f64::from(SIDE) / 2.0;
        let [dx, dy] = [x, y].map(|v| f64::from(v) + 0.5 - middle);
        let distance = ((dx * dx + dy * dy).sqrt() - radius).abs();
        let found = found[(y * SIDE + x) as usize];
        // The sides of the polygon lie up to 0.12 pixels within the circle.
        assert!(distance < 1.6 || found == 0.0, "{found} at ({x}, {y}), {distance} from the rim");
        assert!(distance > 0.3 || found > 0.95, "{found} at ({x}, {y}), {distance} from the rim");
    }
}
