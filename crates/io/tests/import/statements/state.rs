//! Names, materials, smoothing, and what else holds for the elements that follow.

use trigon_io::Loaded;
use trigon_math::Vec4;

use super::row::Case::{File, Lines};
use super::row::{Row, left, read};
use crate::meshes;

pub(super) fn rows() -> Vec<Row> {
    let mut rows = names();
    rows.extend(materials());
    rows.extend(smoothing());
    rows.extend(display());
    rows.extend(other_files());
    rows
}

fn node_name(loaded: &Loaded) -> &str {
    loaded.scene.nodes().iter().next().expect("a node").1.name.as_str()
}

fn base_color(loaded: &Loaded) -> Vec4 {
    loaded.scene.materials.iter().next().expect("a material").1.base_color
}

fn is_red(loaded: &Loaded) -> bool {
    base_color(loaded) == Vec4::new(1.0, 0.0, 0.0, 1.0)
}

fn smooth(loaded: &Loaded) -> Option<Vec<bool>> {
    meshes(loaded)[0].attributes().face_smooth.clone()
}

fn names() -> Vec<Row> {
    vec![
        read("o name", Lines("o box"), "a node of that name", |loaded| node_name(loaded) == "box"),
        read("g name", Lines("g lid"), "a node of that name", |loaded| node_name(loaded) == "lid"),
        read("g name1 name2 …", Lines("g lid top"), "one node, with all the names as its name", |loaded| {
            node_name(loaded) == "lid top"
        }),
        read("g name in an object", Lines("o box\ng lid"), "a node of both names", |loaded| {
            node_name(loaded) == "box/lid"
        }),
        left("o without a name", Lines("o"), "the node is called like the file, as without it"),
        left("g without a name", Lines("g"), "the node is called like the file, as without it"),
    ]
}

fn materials() -> Vec<Row> {
    vec![
        read("usemtl name", Lines("usemtl red"), "a slot of the node with that material", is_red),
        left("usemtl without a name", Lines("usemtl"), "the default material, as without it"),
        left("usemtl of an unknown material", Lines("usemtl green"), "the default material").says(
            "a.obj, line 8: material \"green\" is in no library; the default material is used; add it to the MTL file",
        ),
        left("usemtl of another case", Lines("usemtl Red"), "names of materials are told apart by case").says(
            "a.obj, line 8: material \"Red\" is in no library; the default material is used; add it to the MTL file",
        ),
        left("usemtl name # comment", Lines("usemtl red # wood"), "names may have spaces and #").says(
            "a.obj, line 8: material \"red # wood\" is in no library; the default material is used; add it to the MTL file",
        ),
        left("usemtl without any library", File("v 0 0 0\nv 1 0 0\nv 1 1 0\n> usemtl red\nf 1 2 3"), "the default material")
            .says("a.obj, line 4: material \"red\" is in no library; the default material is used; name its library with mtllib"),
        read(
            "mtllib file",
            File("> mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3"),
            "a library of materials",
            is_red,
        ),
        read(
            "mtllib file1 file2 …",
            File("> mtllib gone.mtl m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3"),
            "libraries, of which the first counts that has a material; one whose name has spaces is found, too",
            is_red,
        )
        .says("a.obj, line 1: material library \"gone.mtl\" is not read (there is no such file), the default material is used; put the file there, or export the model again with it"),
        left(
            "mtllib of another library with the same material",
            File("mtllib m.mtl\n> mtllib more.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3"),
            "the first library that has it counts",
        )
        .says("more.mtl, line 1: a material is defined in an earlier library, too, and that definition counts; remove one, or give it another name"),
        left("mtllib of a missing file", Lines("mtllib gone.mtl"), "there is none").says(
            "a.obj, line 8: material library \"gone.mtl\" is not read (there is no such file), the default material is used; put the file there, or export the model again with it",
        ),
        left("mtllib of a file outside the model's folder", Lines("mtllib ../gone.mtl"), "a model opens nothing there").says(
            "a.obj, line 8: material library \"../gone.mtl\" is not read (it leads out of the model's folder), the default material is used; put the file beside the model and name it by its relative path",
        ),
        left("mtllib without a name", Lines("mtllib"), "it names nothing").says(
            "a.obj, line 8: material library \"\" is not read (it is not a valid file name), the default material is used; put the file beside the model and name it by its relative path",
        ),
        read(
            "mtllib after usemtl",
            File("v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\n> mtllib m.mtl"),
            "a library for the whole file",
            is_red,
        ),
    ]
}

fn smoothing() -> Vec<Row> {
    const ODD: &str = "a.obj, line 8: s is followed by neither a number nor on or off, and the faces are flat; write the number of a smoothing group, or `s off`";
    vec![
        read("s number", Lines("s 1"), "smooth normals within the group, a crease to others", |loaded| {
            smooth(loaded) == Some(vec![true])
        }),
        read("s on", Lines("s on"), "group 1", |loaded| smooth(loaded) == Some(vec![true])),
        left("s off, s 0", Lines("s off"), "flat faces, as without it"),
        left("s and something else", Lines("s smooth"), "flat faces").says(ODD),
        left("s alone", Lines("s"), "flat faces").says(ODD),
        left("mg group resolution", Lines("mg 1 0.5"), "it joins surfaces, which are not drawn"),
    ]
}

fn display() -> Vec<Row> {
    vec![
        left("bevel on", Lines("bevel on"), "edges are drawn sharp").says(
            "a.obj, line 8: bevel asks for edges that look rounded, and they are drawn sharp; bevel the edges of the model",
        ),
        left("bevel off", Lines("bevel off"), "that is how edges are drawn"),
        left("c_interp on", Lines("c_interp on"), "each face has one material").says(
            "a.obj, line 8: c_interp asks for colours blended between materials, which are not drawn; write colours at the vertices: v x y z red green blue",
        ),
        left("c_interp off", Lines("c_interp off"), "that is how faces are drawn"),
        left("d_interp on", Lines("d_interp on"), "each face has one material").says(
            "a.obj, line 8: d_interp asks for opacity blended between materials, which is not drawn; give the material an opacity texture with map_d",
        ),
        left("d_interp off", Lines("d_interp off"), "that is how faces are drawn"),
        left("lod level", Lines("lod 5"), "no level is chosen").says(
            "a.obj, line 8: lod marks a level of detail, and all levels are drawn; keep one level in the file",
        ),
        left("lod 0", Lines("lod 0"), "it asks for all levels, which are drawn"),
        left("usemap name", Lines("usemap wood"), "texture maps beside materials are not drawn").says(
            "a.obj, line 8: usemap names a texture map, which is not drawn; name the image with map_Kd in a material",
        ),
        left("usemap off", Lines("usemap off"), "that is how faces are drawn"),
        left("maplib file1 …", Lines("maplib maps.map"), "only usemap shows what is in it, which says so"),
    ]
}

fn other_files() -> Vec<Row> {
    vec![
        left("shadow_obj file", Lines("shadow_obj low.obj"), "the model casts its own shadow").says(
            "a.obj, line 8: shadow_obj names a model to cast the shadow, which is not read; this one casts its own; remove the line, or load the other model",
        ),
        left("trace_obj file", Lines("trace_obj low.obj"), "mirrors show the model").says(
            "a.obj, line 8: trace_obj names a model to show in mirrors, which is not read; they show this one; remove the line, or load the other model",
        ),
        left("call file arguments …", Lines("call part.obj 1"), "one model is one file").says(
            "a.obj, line 8: call names another file, which is not read; copy its statements to this place",
        ),
        left("csh command", Lines("csh -rm part.obj"), "no file makes trigon run a command").says(
            "a.obj, line 8: csh asks to run a command, and trigon runs none; run it yourself, and load what it writes",
        ),
    ]
}
