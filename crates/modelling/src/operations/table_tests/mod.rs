//! Every operation on every input, with fixed seeds: what holds for each of them is checked by code that knows
//! nothing of how the operations work.

mod inputs;
mod operations;
mod oracles;

use trigon_math::{Vec3, area_vector};
use trigon_mesh::triangulate_polygon;

use super::*;
use crate::tests::{add_affine_group, check_operation};
use crate::{CornerId, EdgeId, EditMesh, FaceId, Refusal, VertexId};
use inputs::Input;
use operations::OPERATIONS;
use oracles::Facts;

/// What some bits choose of a mesh.
struct Chosen {
    vertices: Vec<VertexId>,
    edges: Vec<EdgeId>,
    faces: Vec<FaceId>,
    all_faces: Vec<FaceId>,
    number: u64,
}

impl Chosen {
    fn of(mesh: &EditMesh, number: u64) -> Self {
        // A different pattern for each kind (D. Knuth's multiplier; any would do).
        let bits =
            |kind: u64| (number + 1).wrapping_mul(6_364_136_223_846_793_005).rotate_left(7 * kind as u32);
        let has = |kind: u64, index: u32| match number {
            0 => true,
            // One, few, or half of them.
            1 => index == 0,
            number if number < 6 => u64::from(index) % 5 == number - 1,
            _ => bits(kind) >> (index % 64) & 1 != 0,
        };
        Self {
            vertices: mesh.vertices().filter(|vertex| has(0, vertex.0)).collect(),
            edges: mesh.edges().filter(|edge| has(1, edge.0)).collect(),
            faces: mesh.faces().filter(|face| has(2, face.0)).collect(),
            all_faces: mesh.faces().collect(),
            number,
        }
    }

    fn corner(&self, mesh: &EditMesh) -> Option<CornerId> {
        mesh.face_corners(*self.faces.first()?).next()
    }
}

/// What an operation promises where the input has it.
#[derive(Clone, Copy, PartialEq)]
enum Promise {
    /// Nothing of the kind.
    Nothing,
    /// A closed mesh stays closed.
    Closed,
    /// It also keeps Euler's number: vertices − edges + faces.
    Euler,
    /// It also keeps the area of what is flat, and the volume of what has flat faces.
    Shape,
}

type Run = fn(&mut EditMesh, &Chosen) -> Result<(), Refusal>;

/// A row of the table.
struct Operation {
    name: &'static str,
    promise: Promise,
    run: Run,
}

const fn operation(name: &'static str, promise: Promise, run: Run) -> Operation {
    Operation { name, promise, run }
}

/// Runs one operation on one input with one choice.
fn check(input: &Input, operation: &Operation, number: u64) -> Result<(), String> {
    let Operation { promise, run, .. } = operation;
    let (mut before, _) = EditMesh::from_mesh(&input.mesh);
    if number % 2 == 1 {
        add_affine_group(&mut before, "affine");
    }
    let on = Chosen::of(&before, number);
    let Some((after, ())) = check_operation(&before, |mesh| run(mesh, &on))? else { return Ok(()) };
    let [was, is] = [&before, &after].map(Facts::of);
    is.check_faces()?;
    // What divides or copies doubled faces has doubled parts.
    if was.doubled_faces == 0 && is.doubled_faces > 0 {
        return Err(format!(
            "{} faces lie on others: {:?} became {:?}",
            is.doubled_faces, was.outlines, is.outlines
        ));
    }
    if *promise == Promise::Nothing || !input.is_closed && !input.is_flat {
        return Ok(());
    }
    if input.is_closed && !is.is_closed {
        return Err("it is open".into());
    }
    // What is cut across doubled faces shares its new edges.
    let has_number = was.doubled_faces == 0 && [Promise::Euler, Promise::Shape].contains(promise);
    if has_number && was.euler != is.euler {
        return Err(format!("Euler's number was {} and is {}", was.euler, is.euler));
    }
    let is_near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * (1.0 + a.abs());
    if *promise == Promise::Shape && !(is_near(was.area, is.area) && is_near(was.volume, is.volume)) {
        return Err(format!(
            "area {} became {}, volume {} became {}",
            was.area, is.area, was.volume, is.volume
        ));
    }
    Ok(())
}

#[test]
fn every_operation_leaves_every_input_in_order() {
    let mut wrong = Vec::new();
    for input in inputs::all() {
        for operation in &OPERATIONS {
            for number in 0..24 {
                if let Err(reason) = check(&input, operation, number) {
                    wrong.push(format!("{} on {} ({number}): {reason}", operation.name, input.name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of all:\n{}", wrong.len(), wrong.join("\n"));
}

/// An operation that refuses everything would pass the table.
#[test]
fn every_operation_works_on_some_input() {
    for Operation { name, run, .. } in &OPERATIONS {
        let works = inputs::all().iter().any(|input| {
            (0..24).any(|number| {
                let (mut mesh, _) = EditMesh::from_mesh(&input.mesh);
                let on = Chosen::of(&mesh, number);
                run(&mut mesh, &on).is_ok()
            })
        });
        assert!(works, "{name} refuses everything");
    }
}

/// The area of a flat face that touches itself is that of its outline: holes run the other way.
#[test]
fn the_viewer_and_the_editor_draw_the_same_triangles_with_the_whole_area() {
    for Input { name, mesh, .. } in inputs::touching() {
        let expected: f64 = (0..mesh.face_count()).map(|face| mesh.face_area_vector(face).length()).sum();
        let is_near = |area: f64| (area - expected).abs() < 1e-5;
        assert!(is_near(mesh.surface_area()), "{name} in the viewer: {}", mesh.surface_area());
        let (mut edited, _) = EditMesh::from_mesh(&mesh);
        let shown = edited.to_mesh().0;
        assert!(is_near(shown.surface_area()), "{name} in the editor: {}", shown.surface_area());
        let faces: Vec<FaceId> = edited.faces().collect();
        edited.triangulate_faces(&faces).expect("faces");
        let triangles = edited.to_mesh().0;
        assert!(is_near(triangles.surface_area()), "{name} in triangles: {}", triangles.surface_area());
        assert_eq!(drawn(&shown), drawn(&triangles), "{name}: what is shown is what triangulating makes");
    }
}

/// The triangles of a mesh with an area, as vertices from the smallest on, sorted.
fn drawn(mesh: &trigon_mesh::Mesh) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for face in 0..mesh.face_count() {
        let vertices: Vec<u32> =
            mesh.face_corners(face).map(|corner| mesh.corner_vertices()[corner]).collect();
        let place = |&vertex: &u32| mesh.positions()[vertex as usize];
        let corners: Vec<Vec3> = vertices.iter().map(place).collect();
        for triangle in triangulate_polygon(&corners) {
            let mut triangle = triangle.map(|index| vertices[index as usize]);
            let area = area_vector(triangle.map(|vertex| place(&vertex).as_dvec3())).length();
            let first = (0..3).min_by_key(|&i| triangle[i]).expect("three");
            triangle.rotate_left(first);
            if area > 0.0 {
                triangles.push(triangle);
            }
        }
    }
    triangles.sort_unstable();
    triangles
}

/// Blender 5.0.1 makes 24 faces of it: four sides, 16 around the hole, and two each at the top and at the bottom.
#[test]
fn a_drilled_plate_becomes_few_faces() {
    let plate = inputs::drilled_plate();
    assert_eq!(plate.face_count(), 128, "as it comes");
    let (mut mesh, _) = EditMesh::from_mesh(&plate);
    let faces: Vec<FaceId> = mesh.faces().collect();
    mesh.dissolve_limited(&faces, LimitedDissolve { angle: 1f64.to_radians() }).expect("faces");
    assert_eq!(mesh.face_count(), 24);
    assert!((mesh.to_mesh().0.volume() - plate.volume()).abs() < 1e-5, "the same solid");
    assert!(Facts::of(&mesh).is_closed);
}

/// Two opposite corners of a side of a cube, merged, leave it without area. Blender 5.0.1: seven vertices, five faces.
#[test]
fn a_side_of_a_cube_whose_diagonal_collapses_goes() {
    let (mut cube, _) = EditMesh::from_mesh(&trigon_mesh::primitives::cube(2.0));
    let side: Vec<VertexId> = cube.face_vertices(FaceId(0)).collect();
    let merged = cube.merge_at_center(&[side[0], side[2]]).expect("two vertices");
    assert_eq!((cube.vertex_count(), cube.edge_count(), cube.face_count()), (7, 10, 5));
    assert_eq!((merged.removed, merged.removed_edges, merged.removed_faces), (1, 2, 1), "all is told");
    assert!(Facts::of(&cube).is_closed);
}

/// Blender 5.0.1: an 11-gon and a quad; a 5-gon.
#[test]
fn dissolving_leaves_no_face_that_runs_along_an_edge_and_back() {
    let (mut mesh, _) = EditMesh::from_mesh(&trigon_mesh::primitives::grid(2.0, 2.0, 3, 3));
    mesh.dissolve_vertices(&[1, 6, 9].map(VertexId)).expect("inner ones and one on the border");
    let mut sizes: Vec<usize> = mesh.faces().map(|face| mesh.face_size(face)).collect();
    sizes.sort_unstable();
    assert_eq!(sizes, [4, 11]);
    let (mut mesh, _) = EditMesh::from_mesh(&trigon_mesh::primitives::grid(2.0, 2.0, 2, 2));
    let inner: Vec<EdgeId> = mesh.edges().filter(|&edge| !mesh.is_boundary(edge)).collect();
    mesh.dissolve_edges(&inner[..3]).expect("three of four");
    let sizes: Vec<usize> = mesh.faces().map(|face| mesh.face_size(face)).collect();
    assert_eq!((sizes, mesh.vertex_count()), (vec![5], 5));
    let (mut mesh, _) = EditMesh::from_mesh(&trigon_mesh::primitives::cylinder(1.0, 2.0, 7));
    mesh.dissolve_edges(&[19, 1, 2].map(EdgeId)).ok();
    assert!(Facts::of(&mesh).check_faces().is_ok() && Facts::of(&mesh).is_closed);
}

#[test]
fn a_face_that_is_there_is_not_filled_with_a_grid() {
    let (mut cube, _) = EditMesh::from_mesh(&trigon_mesh::primitives::cube(2.0));
    let before = cube.clone();
    let edges: Vec<EdgeId> = cube.face_edges(FaceId(0)).collect();
    let refusal = cube.grid_fill(&edges, GridSides::default()).expect_err("it is there");
    assert!(refusal.to_string().contains("there is a face"), "{refusal}");
    assert!(cube == before, "nothing changed");
}
