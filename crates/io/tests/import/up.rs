//! Which way is up in a file: what its format says, unless somebody knows better.

use trigon_io::{
    ExportOptions, Format, LoadOptions, NativeDocument, UpAxis, export, load_from_slice, readers, writers,
};
use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Mesh, MeshBuilder};
use trigon_scene::{Material, Node, Scene};

/// Alike from no side, with corners that no rounding leaves as they are.
fn wedge() -> Mesh {
    let mut builder = MeshBuilder::new();
    let corners =
        [Vec3::new(0.1, 0.2, 0.3), Vec3::new(1.7, 0.2, 0.3), Vec3::new(0.1, 2.9, 0.3), Vec3::Z / 3.0];
    let [a, b, c, d] = corners.map(|corner| builder.push_vertex(corner));
    for face in [[a, c, b], [a, b, d], [b, c, d], [c, a, d]] {
        builder.push_face(&face).expect("a triangle");
    }
    builder.build()
}

fn scene(up: UpAxis) -> Scene {
    let mut scene = Scene::new();
    scene.up = up;
    scene.add_object("wedge", wedge(), Material::default());
    scene
}

fn axes() -> impl Iterator<Item = UpAxis> {
    let axes = DVec3::AXES.into_iter();
    axes.flat_map(|axis| [axis, -axis]).map(UpAxis::new)
}

/// Where the corners of all faces are in the world.
fn corners(scene: &Scene) -> Vec<DVec3> {
    let mut corners = Vec::new();
    for (id, node) in scene.nodes().iter() {
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let (mesh, world) = (asset.mesh(), scene.world_transform(id));
        let position = |&vertex: &u32| world.transform_point3(mesh.positions()[vertex as usize].as_dvec3());
        corners.extend(mesh.corner_vertices().iter().map(position));
    }
    corners
}

fn written(scene: &Scene, format: Format, options: &ExportOptions<'_>) -> Vec<u8> {
    export(scene, "wedge", format, options).expect("it is small").files.pop().expect("the model").bytes
}

fn read(format: Format, bytes: &[u8], up: Option<UpAxis>) -> Scene {
    let options = LoadOptions { format: Some(format), up, ..LoadOptions::default() };
    load_from_slice("wedge", bytes, &options).expect("as written").scene
}

#[test]
fn formats_of_printers_have_z_up_and_all_others_have_y() {
    for reader in readers() {
        let is_printed = matches!(reader.format, Format::Stl | Format::ThreeMf);
        let expected = if is_printed { UpAxis::Z } else { UpAxis::Y };
        assert_eq!(reader.up, expected, "{}", reader.name);
    }
    for writer in writers() {
        let bytes = written(&scene(UpAxis::Y), writer.format, &ExportOptions::default());
        let found = read(writer.format, &bytes, None);
        assert_eq!(found.up, writer.format.up(), "{}", writer.name);
        let told = read(writer.format, &bytes, Some(UpAxis::new(DVec3::NEG_X)));
        assert_eq!(told.up, UpAxis::new(DVec3::NEG_X), "{}: who knows better is believed", writer.name);
        assert_eq!(corners(&told), corners(&found), "{}: no coordinate depends on it", writer.name);
    }
}

/// The corner above all others is above them in each file, to the bit.
#[test]
fn files_of_every_format_are_turned_exactly() {
    for (writer, up) in writers().flat_map(|writer| axes().map(move |up| (writer, up))) {
        let bytes = written(&scene(up), writer.format, &ExportOptions::default());
        let mut again = read(writer.format, &bytes, None);
        again.turn_to(up);
        assert_eq!(corners(&again), corners(&scene(up)), "{} from {up} up", writer.name);
    }
    let options = ExportOptions { up: Some(UpAxis::new(DVec3::NEG_Z)), scale: 1000.0, ..Default::default() };
    let again = read(Format::Stl, &written(&scene(UpAxis::Y), Format::Stl, &options), options.up);
    // -Z is up and +Y in front.
    let found = corners(&again)[0];
    assert_eq!(found, DVec3::new(100.0, 300.0, -200.0), "in millimetres, as f32 has them");
}

/// A document has +Y up: an STL is turned when it is opened and turned back when it is exported.
#[test]
fn documents_turn_what_they_open_and_what_they_export() {
    let bytes = written(&scene(UpAxis::Z), Format::Stl, &ExportOptions::default());
    let (document, _) =
        NativeDocument::load_from_slice("wedge.stl", &bytes, &LoadOptions::default()).expect("as written");
    assert_eq!(document.scene.up, UpAxis::Y);
    let expected: Vec<DVec3> =
        corners(&scene(UpAxis::Z)).into_iter().map(|DVec3 { x, y, z }| DVec3::new(x, z, -y)).collect();
    assert_eq!(corners(&document.scene), expected, "z goes up, and y to the back");
    let again = document.export("again.stl", Format::Stl, &ExportOptions::default()).expect("it is small");
    assert!(again.files[0].bytes == bytes, "the same bytes");
}

/// An animated root keeps its own channels: the rotation is in a node above it.
#[test]
fn a_gltf_is_turned_by_a_node_above_its_roots() {
    let mut scene = scene(UpAxis::Y);
    scene.add(Node::default().with_name("lamp").at(DVec3::X));
    let bytes = written(&scene, Format::Glb, &ExportOptions::default());
    let options = LoadOptions { up: Some(UpAxis::Z), ..LoadOptions::default() };
    let (document, _) = NativeDocument::load_from_slice("a.glb", &bytes, &options).expect("as written");
    let roots: Vec<_> = document.scene.roots().collect();
    let name = document.scene.node(roots[0]).map(|node| node.name.clone());
    assert_eq!((roots.len(), name.as_deref()), (1, Some("+Z up")));
    let saved = document.encode().expect("it is small").to_bytes();
    let again = read(Format::Glb, &saved, None);
    assert_eq!(corners(&again), corners(&document.scene), "saved as it is shown");
}
