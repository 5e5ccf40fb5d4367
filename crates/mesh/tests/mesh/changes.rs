//! Other values for some elements of a mesh, and what a render mesh makes of them.

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{
    Attributes, ChangeError, ChangedElements, Mesh, MeshBuilder, MeshChange, RenderMesh, primitives,
};

fn moved(positions: Vec<(u32, Vec3)>) -> MeshChange {
    MeshChange { positions, ..MeshChange::default() }
}

#[test]
fn what_a_mesh_has_not_cannot_be_changed() {
    let cube = primitives::cube(1.0);
    assert_eq!((cube.vertex_count(), cube.corner_count()), (8, 24), "of these");
    let refused = |change: MeshChange| {
        let mut changed = cube.clone();
        let error = changed.change(&change).expect_err("refused");
        assert_eq!(changed, cube, "and nothing was changed");
        error
    };
    let beyond = refused(moved(vec![(0, Vec3::ONE), (8, Vec3::ONE)]));
    let expected = ChangeError::OutOfRange { attribute: "positions", element: "vertex", index: 8, count: 8 };
    assert_eq!(beyond, expected, "a vertex");
    let normals = |corner| MeshChange { corner_normals: vec![(corner, Vec3::X)], ..MeshChange::default() };
    assert_eq!(refused(normals(3)), ChangeError::NoSuchAttribute { attribute: "corner_normals" }, "normals");
    let expected =
        ChangeError::OutOfRange { attribute: "corner_normals", element: "corner", index: 24, count: 24 };
    assert_eq!(refused(normals(24)), expected, "a corner");
    let colors = MeshChange { corner_colors: vec![(0, Vec4::ONE)], ..MeshChange::default() };
    assert_eq!(refused(colors), ChangeError::NoSuchAttribute { attribute: "corner_colors" }, "colours");
    let uvs = |set: usize| {
        let mut uv_sets = vec![Vec::new(); set];
        uv_sets.push(vec![(24, Vec2::ZERO)]);
        MeshChange { uv_sets, ..MeshChange::default() }
    };
    assert_eq!(refused(uvs(1)), ChangeError::NoSuchUvSet { set: 1, count: 1 }, "a second set");
    let expected = ChangeError::OutOfRange { attribute: "uv_sets", element: "corner", index: 24, count: 24 };
    assert_eq!(refused(uvs(0)), expected, "a corner of the first");
    let empty = MeshChange { uv_sets: vec![Vec::new(); 9], ..MeshChange::default() };
    assert_eq!((empty.is_empty(), cube.clone().change(&empty)), (true, Ok(())), "nothing is no error");
}

#[test]
fn the_last_value_counts() {
    let mut cube = primitives::cube(1.0);
    cube.change(&moved(vec![(2, Vec3::X), (5, Vec3::Y), (2, Vec3::Z)])).expect("vertices of a cube");
    assert_eq!([cube.positions()[2], cube.positions()[5]], [Vec3::Z, Vec3::Y], "of two");
    let uv_sets = vec![vec![(7, Vec2::ONE)]];
    cube.change(&MeshChange { uv_sets, ..MeshChange::default() }).expect("a corner of a cube");
    assert_eq!(cube.attributes().uv_sets[0][7], Vec2::ONE, "of a corner");
}

/// Every triangle with the positions and normals of its corners, as bits.
fn shown(mesh: &RenderMesh) -> Vec<[[u32; 6]; 3]> {
    let corner = |vertex: u32| {
        let [position, normal] =
            [&mesh.positions, &mesh.normals].map(|list| list[vertex as usize].to_array());
        let both: Vec<u32> = position.iter().chain(&normal).map(|value| value.to_bits()).collect();
        both.try_into().expect("six numbers")
    };
    mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect()
}

/// Follows a change, and holds the result against a render mesh of the changed mesh.
/// Returns how many vertices there are.
fn follow(mesh: &mut Mesh, changes: &[MeshChange]) -> usize {
    let (mut render_mesh, links) = RenderMesh::with_links(mesh);
    let mut links = links.expect("no pose bends it");
    for change in changes {
        let mut changed = ChangedElements::default();
        mesh.change(change).expect("the mesh has it all");
        changed.add(change);
        let update = links.follow(mesh, &changed);
        for of in &update.vertices {
            let index = of.vertex as usize;
            let position = mesh.positions()[mesh.corner_vertices()[of.corner as usize] as usize];
            if index == render_mesh.positions.len() {
                render_mesh.positions.push(position);
                render_mesh.normals.push(of.normal);
            }
            (render_mesh.positions[index], render_mesh.normals[index]) = (position, of.normal);
        }
        let triangulation = mesh.triangulation_of(update.faces.iter().copied());
        let cut = triangulation.triangles.iter().zip(&triangulation.triangle_faces);
        let mut place = 0;
        for (triangle, &face) in cut {
            place = match render_mesh.triangle_faces.get(place) {
                Some(&here) if here == face => place,
                _ => render_mesh.triangle_faces.partition_point(|&other| other < face),
            };
            render_mesh.triangles[place] = triangle.map(|corner| links.vertex_of_corner()[corner as usize]);
            place += 1;
        }
        assert_eq!(shown(&render_mesh), shown(&RenderMesh::from_mesh(mesh)), "after {change:?}");
    }
    render_mesh.positions.len()
}

#[test]
fn a_flat_grid_is_cut_where_it_is_bent_and_stays_so() {
    let mut grid = primitives::grid(4.0, 4.0, 4, 4);
    grid.set_attributes(Attributes::default()).expect("none");
    let places = grid.positions().to_vec();
    let changes = [moved(vec![(12, Vec3::Y)]), moved(vec![(12, places[12])]), moved(vec![(12, Vec3::Y)])];
    assert_eq!(follow(&mut grid, &changes[..0]), 25, "one normal, one vertex for all that meet");
    let bent = follow(&mut grid, &changes[..1]);
    assert!(bent > 25, "{bent} vertices");
    grid.change(&changes[1]).expect("back");
    assert_eq!(follow(&mut grid, &changes), bent, "no more when it is bent again");
}

/// Corners are compared one with another only where they are few.
#[test]
fn a_tip_of_100_000_flat_faces_moves() {
    let count = 100_000u32;
    let mut builder = MeshBuilder::new();
    let tip = builder.push_vertex(Vec3::Y);
    for i in 0..=count {
        builder.push_vertex(Vec3::new(i as f32, 0.0, (i % 7) as f32));
    }
    for i in 1..=count {
        builder.push_face(&[tip, i, i + 1]).expect("a triangle");
    }
    let mut fan = builder.build();
    let changes = [moved(vec![(tip, Vec3::new(3.0, 2.0, 0.5))]), moved(vec![(tip, Vec3::Y)])];
    assert!(follow(&mut fan, &changes) > count as usize, "most of its faces have a normal of their own");
    let smooth = Some(vec![true; count as usize]);
    fan.set_attributes(Attributes { face_smooth: smooth, ..Attributes::default() }).expect("one each");
    assert_eq!(follow(&mut fan, &changes), count as usize + 2, "one normal at each vertex");
}

/// By turns, so that what is kept while the same vertices move is left and found again; beside flat faces, some vertices
/// have several normals.
#[test]
fn vertices_move_again_and_again_in_turn_with_others() {
    let mut sphere = primitives::uv_sphere(1.0, 24, 16);
    let parts: [Vec<u32>; 2] = [vec![0, 30, 55, 130, 131, 250], vec![31, 32, 131, 200, 301]];
    let places = sphere.positions().to_vec();
    let turn = |(step, &part): (usize, &usize)| {
        let to = |&vertex: &u32| (vertex, places[vertex as usize] * (1.0 + 0.01 * (step as f32 + 1.0)));
        moved(parts[part].iter().map(to).collect())
    };
    let changes: Vec<_> = [0, 0, 0, 1, 0, 1, 1, 1, 0, 0].iter().enumerate().map(turn).collect();
    for flat in [usize::MAX, 7, 2, 1] {
        let face_smooth = Some((0..sphere.face_count()).map(|face| (face + 1) % flat != 0).collect());
        sphere.set_attributes(Attributes { face_smooth, ..Attributes::default() }).expect("one each");
        follow(&mut sphere.clone(), &changes);
    }
}
