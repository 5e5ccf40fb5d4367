//! Elements in colours of their own, seen in parallel rays and held against their
//! projections in f64.

use std::sync::Arc;

use trigon_math::DVec2;

use super::*;
use crate::{ElementSet, FixedBitSet, Frame, Mark, Marks, MeshAsset, NodeId, Renderer, VertexPoints};

const HEIGHT: f64 = 3.0;

const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;
const BLUE: Vec3 = Vec3::Z;

/// A white unlit mesh and a camera that looks at it from aside.
struct View {
    scene: Scene,
    node: NodeId,
    camera: Camera,
    settings: RenderSettings,
}

impl View {
    fn new(mesh: Mesh) -> Self {
        let mut scene = Scene::new();
        let white = Material { base_color: Vec4::ONE, shading: Shading::Unlit, ..Material::default() };
        let node = scene.add_object("it", mesh, white);
        let projection = Projection::orthographic(HEIGHT, 0.1, 100.0).expect("in range");
        let camera = Camera::look_at(DVec3::new(3.1, 6.2, 4.3), DVec3::ZERO, DVec3::Y);
        let settings = RenderSettings {
            samples_per_axis: 1,
            background: Background::Color(Vec3::ONE),
            style: Style::SurfaceWithEdges,
            line_width: 2.0,
            edge_color: Vec3::ZERO,
            outputs: Outputs { radiance: true, ids: true, ..Outputs::default() },
            ..RenderSettings::new(SIDE, SIDE)
        };
        Self { scene, node, camera: camera.with_projection(projection), settings }
    }

    fn asset(&self) -> &MeshAsset {
        let mesh = self.scene.node(self.node).expect("it is there").mesh.expect("it has one");
        self.scene.meshes().get(mesh).expect("it is there")
    }

    /// Where a vertex is, in pixels.
    fn place(&self, vertex: u32) -> DVec2 {
        let way = self.asset().mesh().positions()[vertex as usize].as_dvec3() - self.camera.position;
        let [right, up] = [DVec3::X, DVec3::Y].map(|axis| (self.camera.orientation * axis).dot(way));
        (DVec2::new(right, -up) / HEIGHT + 0.5) * f64::from(SIDE)
    }

    fn mark(&self, elements: impl IntoIterator<Item = usize>, color: Vec3) -> Mark {
        let mut bits = FixedBitSet::new();
        for element in elements {
            bits.grow_and_insert(element);
        }
        let mut set = ElementSet::default();
        set.add(self.node, bits);
        Mark { elements: Arc::new(set), color, opacity: 1.0, outlined: false }
    }

    fn frame(&self, settings: &RenderSettings) -> Frame {
        render(&self.scene, &self.camera, settings).expect("in range")
    }

    fn light(&self, settings: &RenderSettings) -> Vec<Vec3> {
        self.frame(settings).radiance.expect("asked for").iter().map(|color| color.truncate()).collect()
    }
}

fn pixel(place: DVec2) -> usize {
    place.y as usize * SIDE as usize + place.x as usize
}

fn distance(point: DVec2, [from, to]: [DVec2; 2]) -> f64 {
    let way = to - from;
    let share = ((point - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    (point - from - way * share).length()
}

/// Selected, sharp, seam and no mark: an editor's, in the order of their priority. Some
/// edges are in several sets.
fn of_edges(view: &View) -> Vec<Mark> {
    let count = view.asset().mesh().edge_count();
    let every = |step: usize, color| view.mark((0..count).step_by(step), color);
    vec![every(7, RED), every(3, GREEN), every(4, BLUE)]
}

fn color_of(edge: usize) -> Vec3 {
    if edge.is_multiple_of(7) {
        RED
    } else if edge.is_multiple_of(3) {
        GREEN
    } else if edge.is_multiple_of(4) {
        BLUE
    } else {
        Vec3::ZERO
    }
}

/// The edges of a face by their distance from a point, with the colours of their marks.
fn edges_around(view: &View, face: u32, point: DVec2) -> Vec<(f64, Vec3)> {
    let mesh = view.asset().mesh();
    let edges = mesh.face_corners(face as usize).map(|corner| {
        let edge = mesh.corner_edge(corner).expect("no corner is doubled");
        let ends = mesh.edges()[edge as usize].map(|vertex| view.place(vertex));
        (distance(point, ends), color_of(edge as usize))
    });
    let mut edges: Vec<_> = edges.collect();
    edges.sort_by(|a, b| a.0.total_cmp(&b.0));
    edges
}

/// Twice the area of a face over its perimeter, in pixels.
fn radius(view: &View, face: u32) -> f64 {
    let places: Vec<_> =
        view.asset().mesh().face_vertices(face as usize).iter().map(|&vertex| view.place(vertex)).collect();
    let sides = (0..places.len()).map(|side| [places[side], places[(side + 1) % places.len()]]);
    let (area, perimeter) =
        sides.fold((0.0, 0.0), |(area, length), [a, b]| (area + a.perp_dot(b), length + (b - a).length()));
    area.abs() / perimeter
}

/// Pixels are left out where lines of other faces may lie over the face, where faces are so
/// small that they show no single edges, and where two edges cover equally much.
#[test]
fn the_nearest_edge_gives_a_pixel_the_colour_of_its_mark() {
    let mut view = View::new(primitives::torus(1.0, 0.4, 14, 8));
    view.settings.marks.edges = of_edges(&view);
    for style in [Style::SurfaceWithEdges, Style::HiddenLine] {
        let settings = RenderSettings { style, ..view.settings.clone() };
        let frame = view.frame(&settings);
        let (faces, light) = (frame.face_ids.expect("asked for"), frame.radiance.expect("asked for"));
        let at = |x: usize, y: usize| y * SIDE as usize + x;
        let mut decided = [0; 4];
        let inner = 3..SIDE as usize - 3;
        for (y, x) in inner.clone().flat_map(|y| inner.clone().map(move |x| (y, x))) {
            let (own, middle) = (faces[at(x, y)], DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
            let light = light[at(x, y)].truncate();
            if own == u32::MAX || light == Vec3::ONE || radius(&view, own) < 3.0 {
                continue;
            }
            let edges = edges_around(&view, own, middle);
            let ((nearest, color), (second, other)) = (edges[0], edges[1]);
            // Up to half a pixel from both both cover all of it.
            let is_tie = color != other && (second < 0.51 || second - nearest < 0.01);
            let around = (y - 3..=y + 3).flat_map(|y| (x - 3..=x + 3).map(move |x| (x, y)));
            let may_be_covered = around.map(|(x, y)| faces[at(x, y)]).any(|face| {
                face != own
                    && face != u32::MAX
                    && edges_around(&view, face, middle)
                        .iter()
                        .any(|edge| edge.1 != color && (edge.0 < nearest + 0.01 || edge.0 < 0.51))
            });
            if is_tie || may_be_covered {
                continue;
            }
            let share = (Vec3::ONE - light).max_element();
            let difference = Vec3::ONE - light - (Vec3::ONE - color) * share;
            assert!(difference.abs().max_element() < 1e-5, "{light} at ({x}, {y}), {edges:?}");
            decided[[Vec3::ZERO, RED, GREEN, BLUE].iter().position(|&known| known == color).unwrap()] += 1;
        }
        assert!(decided.iter().all(|&count| count > 30), "{decided:?} pixels, {style:?}");
    }
}

#[test]
fn marked_faces_are_tinted_and_all_others_stay() {
    let mut view = View::new(primitives::torus(1.0, 0.4, 14, 8));
    let count = view.asset().mesh().face_count();
    for style in [Style::Surface, Style::SurfaceWithEdges] {
        let plain = RenderSettings { style, edge_opacity: 0.0, ..view.settings.clone() };
        let tint = Mark { opacity: 0.25, ..view.mark((0..count).step_by(2), Vec3::new(1.0, 0.5, 0.0)) };
        let marks = Marks { faces: vec![tint.clone()], ..Marks::default() };
        let tinted = RenderSettings { marks, ..plain.clone() };
        let (before, after) = (view.frame(&plain), view.frame(&tinted));
        assert_eq!(before.face_ids, after.face_ids, "ids stay");
        let faces = before.face_ids.expect("asked for");
        let lights = [before.radiance, after.radiance].map(|light| light.expect("asked for"));
        let mut seen = [0; 2];
        for (pixel, &face) in faces.iter().enumerate() {
            let [before, after] = [0, 1].map(|frame: usize| lights[frame][pixel].truncate());
            let is_marked = face != u32::MAX && face % 2 == 0;
            let expected = if is_marked { before * 0.75 + tint.color * 0.25 } else { before };
            assert!((after - expected).abs().max_element() < 1e-6, "{after} of face {face}");
            seen[usize::from(is_marked)] += 1;
        }
        assert!(seen.iter().all(|&count| count > 1000), "{seen:?}");
        view.settings.samples_per_axis = 1;
    }
}

#[test]
fn lines_of_wireframes_have_the_colours_of_their_marks() {
    let mut view = View::new(primitives::cube(1.0));
    view.settings.style = Style::Wireframe;
    view.settings.marks.edges = of_edges(&view);
    let light = view.light(&view.settings);
    let mesh = view.asset().mesh();
    for (edge, ends) in mesh.edges().iter().enumerate() {
        let [from, to] = ends.map(|vertex| view.place(vertex));
        // Away from crossings of others.
        let found = (1..20).map(|step| light[pixel(from.lerp(to, f64::from(step) / 20.0))]);
        let own = found.filter(|light| *light == color_of(edge)).count();
        assert!(own > 14, "{own} points of edge {edge} have its colour");
    }
}

#[test]
fn vertices_with_a_mark_of_no_opacity_are_not_shown() {
    let mut view = View::new(primitives::cube(1.4));
    view.settings.style = Style::Surface;
    let plain = view.frame(&view.settings);
    view.settings.vertices = Some(VertexPoints::default());
    view.settings.marks.vertices = vec![Mark { opacity: 0.0, ..view.mark(0..8, RED) }];
    assert!(view.frame(&view.settings).color == plain.color, "as without points");
}

#[test]
fn vertices_are_points_where_no_face_hides_them() {
    let mut view = View::new(primitives::cube(1.4));
    view.settings.style = Style::Surface;
    let plain = view.frame(&view.settings);
    let points = VertexPoints { size: 3.0, marked_size: 7.0, color: BLUE };
    let hidden = (0..8).min_by(|&a, &b| {
        let near = |vertex: usize| {
            let way = view.asset().mesh().positions()[vertex].as_dvec3() - view.camera.position;
            (view.camera.orientation * DVec3::Z).dot(way)
        };
        near(a).total_cmp(&near(b))
    });
    view.settings.marks.vertices = vec![view.mark([1, 3, 5], RED)];
    let settings = RenderSettings { vertices: Some(points), ..view.settings.clone() };
    let frame = view.frame(&settings);
    assert_eq!(frame.object_ids, plain.object_ids, "what can be picked stays");
    let light = frame.radiance.expect("asked for");
    for vertex in 0..8 {
        let at = |x: f64| light[pixel(view.place(vertex as u32) + DVec2::new(x, 0.0))].truncate();
        let color = if [1, 3, 5].contains(&vertex) { RED } else { BLUE };
        if Some(vertex) == hidden {
            assert_eq!(at(0.0), Vec3::ONE, "vertex {vertex} is hidden");
        } else {
            assert_eq!(at(0.0), color, "vertex {vertex}");
            assert_eq!(at(2.4) == color, color == RED, "marked ones are larger: vertex {vertex}");
        }
    }
}

#[test]
fn an_x_ray_shows_the_wireframe_through_faces() {
    let mut view = View::new(primitives::cube(1.4));
    view.settings.marks.edges = of_edges(&view);
    for style in [Style::SurfaceWithEdges, Style::HiddenLine] {
        let solid = RenderSettings { style, edge_opacity: 1.0, ..view.settings.clone() };
        let wires = RenderSettings { style: Style::Wireframe, ..solid.clone() };
        let x_ray = RenderSettings { x_ray: 0.25, ..solid.clone() };
        let frame = view.frame(&x_ray);
        assert_eq!(frame.face_ids, view.frame(&solid).face_ids, "what can be picked stays");
        let [solid, wires] = [solid, wires].map(|settings| view.light(&settings));
        let mut shown = 0;
        for (pixel, light) in frame.radiance.expect("asked for").iter().enumerate() {
            let expected = solid[pixel] * 0.75 + wires[pixel] * 0.25;
            assert!((light.truncate() - expected).abs().max_element() < 1e-6, "{light} at {pixel}");
            shown += usize::from(solid[pixel] == Vec3::ONE && wires[pixel] != Vec3::ONE);
        }
        assert!(shown > 50, "{shown} pixels of hidden edges, {style:?}");
        let outputs = Outputs::default();
        let bytes = view.frame(&RenderSettings { outputs, ..x_ray.clone() }).color;
        assert_eq!(bytes, frame.color, "asking for light changes no byte");
    }
}

/// And the images of a renderer that saw others before are those of a new one.
#[test]
fn other_marks_make_no_geometry_anew() {
    let mut view = View::new(primitives::torus(1.0, 0.4, 14, 8));
    let mut renderer = Renderer::new(view.settings.clone());
    let addresses = |view: &View| {
        let geometry = view.asset().geometry();
        (geometry.columns.positions[0].as_ptr(), geometry.side_edges(view.asset().mesh()).as_ptr())
    };
    let before = addresses(&view);
    for first in 0..3 {
        let edges = view.mark((first..100).step_by(3), RED);
        let faces = view.mark((first..100).step_by(5), GREEN);
        view.settings.marks = Marks { edges: vec![edges], faces: vec![faces], ..Marks::default() };
        *renderer.settings_mut() = view.settings.clone();
        let kept = renderer.render(&view.scene, &view.camera).expect("in range");
        assert!(kept == view.frame(&view.settings), "as drawn for the first time");
        assert_eq!(addresses(&view), before, "the same lists");
    }
}
