//! Points, lines and faces, and their indices.

use trigon_io::Loaded;
use trigon_math::{Vec2, Vec4};
use trigon_mesh::Mesh;

use super::row::Case::{File, Lines};
use super::row::{Row, left, read, refused};
use crate::meshes;

pub(super) fn rows() -> Vec<Row> {
    let mut rows = faces();
    rows.extend(indices());
    rows.extend(wires());
    rows
}

fn mesh(loaded: &Loaded) -> &Mesh {
    meshes(loaded)[0]
}

/// The names of the materials of the first object's slots.
fn slot_names(loaded: &Loaded) -> Vec<&str> {
    let (_, node) = loaded.scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("an object");
    let name = |&id| loaded.scene.materials.get(id).expect("its material").name.as_str();
    node.materials.iter().map(name).collect()
}

fn has_face(loaded: &Loaded, vertices: &[u32]) -> bool {
    mesh(loaded).face_vertices(0) == vertices
}

fn faces() -> Vec<Row> {
    vec![
        read("f v1 v2 v3 …", File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n> f 2 3 4 1\nf 1 2 3 4"), "a polygon, which stays one", |loaded| {
            mesh(loaded).face_count() == 2 && mesh(loaded).corner_count() == 8
        }),
        read("f v1/vt1 …", Lines("f 1/1 2/1 3/1"), "a face with texture coordinates", |loaded| {
            mesh(loaded).attributes().uv_sets[0][0] == Vec2::new(0.0, 1.0)
        }),
        read("f v1//vn1 …", Lines("f 1//1 2//1 3//1"), "a face with normals", |loaded| {
            mesh(loaded).attributes().corner_normals.is_some()
        }),
        read("f v1/vt1/vn1 …", Lines("f 1/1/1 2/1/1 3/1/1"), "a face with both", |loaded| {
            let attributes = mesh(loaded).attributes();
            attributes.corner_normals.is_some() && attributes.uv_sets.len() == 1
        }),
        read("fo v1 v2 v3 …", File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n> fo 1 2 3\nf 1 2 3 4"), "a face: the outline of version 2.11", |loaded| {
            mesh(loaded).face_count() == 2
        }),
        left("f with fewer than 3 vertices", File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n> f 1 2\nf 1 2 3 4"), "it has no area").says(
            "a.obj, line 5: a face has fewer than 3 vertices and is left out; remove it, or write edges with `l` and points with `p`",
        ),
        left("f with fewer than 3 different vertices", File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n> f 1 2 1\nf 1 2 3 4"), "it has no area").says(
            "a.obj, line 5: a face has fewer than 3 different vertices and is left out; clean the model up",
        ),
        read(
            "f with texture coordinates at some corners",
            Lines("f 1/1 2/1 3"),
            "0 at the others",
            |loaded| mesh(loaded).attributes().uv_sets[0][2] == Vec2::ZERO,
        )
        .says(
            "a.obj, line 8: a face has texture coordinates at some corners only, and 0 is taken at the others; write v/vt at all corners of a face or at none",
        ),
        read(
            "f with normals at some corners",
            Lines("f 1//1 2//1 3"),
            "computed at the others",
            |loaded| mesh(loaded).attributes().corner_normals.is_some(),
        )
        .says(
            "a.obj, line 8: a face has normals at some corners only, and they are computed at the others; write v//vn at all corners of a face or at none",
        ),
        left(
            "f without texture coordinates, in a material with a texture",
            File("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl image\n> vt 0 0\nf 1 2 3"),
            "there is no place in the image for it",
        )
        .says(
            "a.obj, line 5: a material with textures is on faces without texture coordinates, which cannot show them; export the texture coordinates (vt), too",
        ),
    ]
}

fn indices() -> Vec<Row> {
    const ZERO: &str = "a.obj, line 8: face corner \"0\" has index 0, and indices count from 1; export the model again, or fix the line";
    const FAR: &str = "a.obj, line 8: face index \"9\" does not exist; the file has 4 vertices; export the model again, or fix the line";
    const BEHIND: &str = "a.obj, line 8: face index \"-5\" does not exist; the file has 4 vertices; export the model again, or fix the line";
    const WRAPPED: &str = "a.obj, line 8: face index \"4294967297\" does not exist; the file has 4 vertices; export the model again, or fix the line";
    const DROPPED: &str = "a.obj, line 8: a texture coordinate or normal index does not exist and is ignored; export the model again";
    vec![
        read(
            "f -1 …",
            File("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n> f -4 -3 -2\nf 1 2 3 4"),
            "indices that count back from the last vertex",
            |loaded| has_face(loaded, &[0, 1, 2]),
        ),
        read(
            "f before its vertices",
            File("> f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3"),
            "indices may point ahead",
            |loaded| mesh(loaded).face_count() == 2,
        ),
        refused("f 0 …", Lines("f 0 1 2"), ZERO),
        refused("f with an index above the last vertex", Lines("f 1 2 9"), FAR),
        refused("f with an index before the first vertex", Lines("f 1 2 -5"), BEHIND),
        refused("f with an index beyond 32 bits", Lines("f 1 2 4294967297"), WRAPPED),
        refused(
            "f with a word",
            Lines("f 1 2 x"),
            "a.obj, line 8: face corner \"x\" is not an index; export the model again, or fix the line",
        ),
        refused(
            "f with four indices at a corner",
            Lines("f 1/1/1/1 2 3"),
            "a.obj, line 8: face corner \"1/1/1/1\" has more than three indices; export the model again, or fix the line",
        ),
        refused(
            "f with texture coordinate 0",
            Lines("f 1/0 2/1 3/1"),
            "a.obj, line 8: face corner \"1/0\" has index 0, and indices count from 1; export the model again, or fix the line",
        ),
        read(
            "f with a texture coordinate or normal out of range",
            Lines("f 1/9 2/1 3/1"),
            "0 there",
            |loaded| mesh(loaded).attributes().uv_sets[0][0] == Vec2::ZERO,
        )
        .says(DROPPED),
    ]
}

fn wires() -> Vec<Row> {
    const SHORT: &str = "a.obj, line 8: a line has fewer than 2 vertices, or a point statement none, and is left out; remove it, or write points with `p`";
    vec![
        read("p v1 v2 …", Lines("p 1 2"), "points as wide as 3 lines, which tobj leaves out", |loaded| {
            mesh(loaded).loose_points().len() == 2
        }),
        left("p without vertices", Lines("p"), "there is nothing to draw").says(SHORT),
        read("l v1 v2 v3 …", Lines("v 2 2 0\nl 1 3 5"), "edges, which tobj takes for a polygon", |loaded| {
            mesh(loaded).loose_edges().len() == 2
        }),
        read("l v1/vt1 v2/vt2", Lines("l 1/1 3/1"), "an edge in the material's colour", |loaded| {
            mesh(loaded).loose_edges().len() == 1
        })
        .says(
            "a.obj, line 8: a line or a point has texture coordinates, which are ignored: it shows no texture; give it a material of one colour",
        ),
        read("p v1/vt1", Lines("p 1/1"), "a point in the material's colour", |loaded| {
            mesh(loaded).loose_points().len() == 1
        })
        .says(
            "a.obj, line 8: a line or a point has texture coordinates, which are ignored: it shows no texture; give it a material of one colour",
        ),
        read(
            "p or l, with vertices that have colours",
            File("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nf 1 2 3\nv 2 2 0 1 0 0\n> p 1 2\n> l 2 4"),
            "in these colours",
            |loaded| {
                let colors = mesh(loaded).attributes().vertex_colors.as_deref().unwrap_or_default();
                mesh(loaded).loose_edges().len() == 1 && colors == [Vec4::new(1.0, 0.0, 0.0, 1.0); 4]
            },
        ),
        left("p or l, with a vertex that is not finite", Lines("v nan 0 0\np 5\nl 1 5"), "nobody knows where it is").says(
            "a.obj, line 8: a face, a line or a point has a vertex that is not finite and is left out … and 1 more; export the model again",
        ),
        read("l on the edge of a face", Lines("l 1 2\nl 3 2"), "the edge of that face, which shows no line", |loaded| {
            mesh(loaded).loose_edges().is_empty()
        })
        .says(
            "a.obj, line 8: a line on the edge of a face of its group is not drawn … and 1 more; start a group for the lines, with g",
        ),
        read("l on the edge of a face of another group", Lines("g lines\nl 1 2\ng faces"), "an edge", |loaded| {
            mesh(loaded).loose_edges().len() == 1
        }),
        left("l with fewer than 2 vertices", Lines("l 1"), "there is nothing to draw").says(SHORT),
        read("l v1 v1", Lines("l 1 1"), "a point", |loaded| mesh(loaded).loose_points().len() == 1),
        read(
            "l in another material than the faces before",
            File("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl blue\nf 1 2 3\nusemtl red\nv 2 2 0\nv 3 3 0\n> l 1 4\n> l 4 2\n> l 4 5"),
            "an edge in its material",
            |loaded| mesh(loaded).loose_edges().len() == 3 && slot_names(loaded) == ["red", "blue"],
        ),
        read(
            "l in another material than the lines before",
            File("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nusemtl blue\nl 1 2\nusemtl red\nv 2 2 0\nv 3 3 0\n> l 1 3\n> l 3 2\n> l 3 4"),
            "an edge in the material of the first line of its group",
            |loaded| mesh(loaded).loose_edges().len() == 4,
        )
        .says(
            "a.obj, line 6: a line or a point has another material than the first of its group, whose colour it gets … and 2 more; start a group for each material, with g",
        ),
    ]
}
