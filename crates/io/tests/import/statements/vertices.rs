//! Lines of text, and vertex data.

use trigon_io::Loaded;
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::Mesh;

use super::row::Case::{File, Lines};
use super::row::{Row, left, read, refused};
use crate::meshes;

pub(super) fn rows() -> Vec<Row> {
    let mut rows = text();
    rows.extend(positions());
    rows.extend(colors());
    rows.extend(attributes());
    rows
}

/// The vertices of the first node where they are in the world.
fn has_vertex(loaded: &Loaded, position: [f64; 3]) -> bool {
    let (_, node) = loaded.scene.nodes().iter().next().expect("a node");
    let offset = node.transform.translation();
    let mut positions = meshes(loaded)[0].positions().iter();
    positions.any(|&found| offset + found.as_dvec3() == DVec3::from(position))
}

fn mesh(loaded: &Loaded) -> &Mesh {
    meshes(loaded)[0]
}

fn colors_of(loaded: &Loaded) -> Vec<Vec4> {
    mesh(loaded).attributes().corner_colors.clone().unwrap_or_default()
}

fn has_coordinate(loaded: &Loaded, coordinate: Vec2) -> bool {
    mesh(loaded).attributes().uv_sets.first().is_some_and(|set| set.contains(&coordinate))
}

/// A normal of no length stands for the face's own.
fn has_normal(loaded: &Loaded, normal: Vec3) -> bool {
    mesh(loaded).attributes().corner_normals.as_ref().is_some_and(|normals| normals.contains(&normal))
}

fn text() -> Vec<Row> {
    vec![
        left("# comment", Lines("# v 9 9 9"), "a comment"),
        left("statement # comment", Lines("mg 1 2 # v 9 9 9"), "the rest of a line is a comment, too"),
        read("statement \\ on two lines", Lines("f 1/1/1 \\\n 2/1/1 3/1/1"), "one statement", |loaded| {
            mesh(loaded).face_count() == 2
        }),
        read(
            "# comment that ends in \\",
            Lines("# C:\\models\\\nf 1/1/1 2/1/1 3/1/1"),
            "a comment of one line: a path takes no statement with it",
            |loaded| mesh(loaded).face_count() == 2,
        ),
        left("an empty line", Lines("  "), "it says nothing"),
        left("a statement in upper case", Lines("F 1 2 3"), "the format is in lower case")
            .says("a.obj, line 8: the statement \"F\" is unknown and is ignored; write it in lower case"),
        left("a statement of no version of the format", Lines("crease 1 2 0.5"), "nobody knows what it means")
            .says("a.obj, line 8: the statement \"crease\" is unknown and is ignored; check its spelling, or remove it"),
        refused(
            "a file with nothing but unknown statements",
            File("> V 0 0 0\n> F 1 1 1"),
            "a.obj: there is nothing to draw, and the statement \"V\" is unknown and is ignored; write it in lower case",
        ),
        refused(
            "an empty file",
            File(""),
            "a.obj: there is nothing to draw: the file is empty or has no vertices; export the model with faces",
        ),
    ]
}

fn positions() -> Vec<Row> {
    vec![
        read("v x y z", Lines("v 2 2 0\nf 1/1/1 2/1/1 5/1/1"), "a vertex, in f64", |loaded| {
            has_vertex(loaded, [2.0, 2.0, 0.0])
        }),
        read(
            "v x y z w",
            Lines("v 4 6 0 2\nf 1/1/1 2/1/1 5/1/1"),
            "a vertex in homogeneous coordinates: x, y and z are divided by the weight",
            |loaded| has_vertex(loaded, [2.0, 3.0, 0.0]),
        ),
        read("v x y z 1", Lines("v 2 2 0 1\nf 1/1/1 2/1/1 5/1/1"), "the same as without a weight", |loaded| {
            has_vertex(loaded, [2.0, 2.0, 0.0])
        }),
        refused(
            "v x y z 0",
            Lines("v 1 1 0 0"),
            "a.obj, line 8: a vertex has the weight 0; export the model again",
        ),
        read("v x y z and 2 more", Lines("v 2 2 0 1 1\nf 1/1/1 2/1/1 5/1/1"), "a vertex; the others are ignored", |loaded| {
            has_vertex(loaded, [2.0, 2.0, 0.0])
        })
        .says("a.obj, line 8: a vertex has more numbers than trigon reads; remove the numbers after x, y, z and the colour"),
        refused(
            "v with too few numbers",
            Lines("v 1 2"),
            "a.obj, line 8: a vertex has 2 numbers and needs 3; export the model again",
        ),
        refused(
            "v with a word",
            Lines("v 1 2 x"),
            "a.obj, line 8: \"x\" is not a number; write plain decimal numbers",
        ),
        refused(
            "v with decimal commas",
            Lines("v 1,5 2,5 3,5"),
            "a.obj, line 8: \"1,5\" is not a number; write plain decimal numbers",
        ),
        left("v that is not finite, in a face", Lines("v nan 0 0\nf 1/1/1 2/1/1 5/1/1"), "nobody knows where it is")
            .says("a.obj, line 8: a face, a line or a point has a vertex that is not finite and is left out; export the model again"),
        left("v that is not finite, in no face", Lines("v 1.#INF 0 0"), "it is not drawn"),
        left("v in no face, line or point", Lines("v 9 9 9"), "it is not drawn"),
        left("vp u v w", Lines("vp 0.5 0.5 1"), "a point of curves on surfaces, which are not drawn"),
    ]
}

fn colors() -> Vec<Row> {
    vec![
        read(
            "v x y z red green blue",
            File("> v 0 0 0 1 0 0\n> v 1 0 0 1 0 0\n> v 1 1 0 1 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nf -4 -5 -6"),
            "a vertex with a colour in sRGB",
            |loaded| colors_of(loaded).contains(&Vec4::new(1.0, 0.0, 0.0, 1.0)),
        )
        .says("a.obj, line 4: a vertex has no colour while others have; it is white … and 2 more; export colours for all vertices or for none"),
        read(
            "v x y z 255 0 0",
            File("> v 0 0 0 255 0 0\n> v 1 0 0 0 0 0\n> v 1 1 0 0 0 0\nf 1 2 3\nv 9 9 9 0 0 0\nv 9 9 9 0 0 0\nv 9 9 9 0 0 0\nf 4 5 6\nf 1 2 3"),
            "the colour is held to 0 to 1",
            |loaded| colors_of(loaded).contains(&Vec4::new(1.0, 0.0, 0.0, 1.0)),
        )
        .says("a.obj, line 1: a vertex has a colour outside of 0 to 1, which is clamped; write colours from 0 to 1, not from 0 to 255"),
        read(
            "v x y z with a colour that is not finite",
            File("> v 0 0 0 nan 0 0\nv 1 0 0 0 0 0\nv 1 1 0 0 0 0\nv 0 0 0 0 0 0\nf -1 -2 -3\nf 1 2 3"),
            "white",
            |loaded| colors_of(loaded).iter().any(|color| color.x == 1.0),
        )
        .says("a.obj: a vertex has a colour that is not finite; it is white there; export the model again"),
    ]
}

fn attributes() -> Vec<Row> {
    vec![
        read("vt u v", Lines("vt 0.25 0.25\nf 1/2/1 2/2/1 3/2/1"), "a texture coordinate", |loaded| {
            has_coordinate(loaded, Vec2::new(0.25, 0.75))
        }),
        read("vt u", Lines("vt 0.25\nf 1/2/1 2/2/1 3/2/1"), "v is 0", |loaded| {
            has_coordinate(loaded, Vec2::new(0.25, 1.0))
        }),
        read(
            "vt u v w",
            Lines("vt 0.25 0.25 0.5\nf 1/2/1 2/2/1 3/2/1"),
            "u and v; w is for images of three dimensions, of which there are none",
            |loaded| has_coordinate(loaded, Vec2::new(0.25, 0.75)),
        ),
        read("vt u v w and more", Lines("vt 0.25 0.25 0 1\nf 1/2/1 2/2/1 3/2/1"), "u and v", |loaded| {
            has_coordinate(loaded, Vec2::new(0.25, 0.75))
        })
        .says("a.obj, line 8: a texture coordinate or normal has more than 3 numbers, and the first 3 count; remove the others"),
        refused(
            "vt without numbers",
            Lines("vt"),
            "a.obj, line 8: a vt line has 0 numbers and needs 2; export the model again",
        ),
        read("vt that is not finite", Lines("vt nan 0.5\nf 1/2/1 2/2/1 3/2/1"), "0", |loaded| {
            has_coordinate(loaded, Vec2::ZERO)
        })
        .says("a.obj, line 8: a texture coordinate is not finite and is taken as 0; export the model again"),
        read("vn x y z", Lines("vn 0 1 0\nf 1/1/2 2/1/2 3/1/2"), "a normal", |loaded| {
            has_normal(loaded, Vec3::Y)
        }),
        read("vn of no length", Lines("vn 0 0 0\nf 1/1/2 2/1/2 3/1/2"), "the face's own normal", |loaded| {
            has_normal(loaded, Vec3::ZERO)
        })
        .says("a.obj, line 8: a normal has no direction and is computed from the faces instead; export the model again, or remove the normal"),
        read("vn that is not finite", Lines("vn 0 nan 0\nf 1/1/2 2/1/2 3/1/2"), "the face's own normal", |loaded| {
            has_normal(loaded, Vec3::ZERO)
        })
        .says("a.obj, line 8: a normal has no direction and is computed from the faces instead; export the model again, or remove the normal"),
        refused(
            "vn with too few numbers",
            Lines("vn 0 1"),
            "a.obj, line 8: a vn line has 2 numbers and needs 3; export the model again",
        ),
    ]
}
