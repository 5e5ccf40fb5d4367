//! Captures that lie, and that are damaged: an error that says so, never a panic.

use std::io::Read;

use flate2::read::ZlibDecoder;
use proptest::prelude::*;
use trigon_camera::UpAxis;
use trigon_mesh::primitives;
use trigon_scene::math::{DVec3, Vec3};
use trigon_scene::{
    AmbientOcclusion, Animation, Channel, Curve, EffectSettings, Interpolation, Light, Material, Node,
    Outline, Property, Shadows, SightRays, Skin, SoftShadows, Texture, TextureFormat, render,
};

use super::{fnv1a, *};

/// A small capture with parts of most kinds. Its image is not what it would show.
fn capture() -> Capture {
    let mut scene = Scene::new();
    let texture = Texture::new(2, 1, vec![[1, 2, 3, 4], [5, 6, 7, 8]], TextureFormat::Srgb);
    let texture = scene.add_texture("two texels", texture.expect("two texels"));
    let parent = scene.add_object("cube", primitives::cube(1.0), Material::from_texture(texture));
    let child = scene.add_child(parent, Node::from_light(Light::spot(1.0))).expect("just added");
    let stand = scene.add(Node::default().at(DVec3::X));
    scene.node_mut(stand).expect("just added").camera = Some(Box::new(Camera::default().projection));
    let skin = scene.skins.insert(Skin { joints: vec![child], ..Skin::default() });
    scene.node_mut(parent).expect("just added").skin = Some(skin);
    let curve = Curve::new(Interpolation::Linear, 3, vec![0.0, 1.0], vec![0.5; 6]).expect("two keyframes");
    let channel = Channel { node: child, property: Property::Translation, curve };
    scene.animations = vec![Animation { name: "up".to_owned(), channels: vec![channel] }];
    let effects = EffectSettings {
        shadows: Shadows::Maps { resolution: 16 },
        ambient_occlusion: Some(AmbientOcclusion::new(1, 1.0)),
        sight: SightRays::all(1),
        outline: Some(Outline { nodes: vec![child], color: Vec3::X, width: 1 }),
        ..EffectSettings::default()
    };
    let settings = RenderSettings { effects, ..RenderSettings::new(2, 2) };
    let (camera, color) = (scene.overview(1.0), vec![7; 16]);
    Capture { scene, camera, settings, color, program: "0.0.1".to_owned() }
}

fn read(bytes: &[u8]) -> Result<Capture, LoadError> {
    Capture::from_bytes("a.trigon", bytes, &Limits::default())
}

fn message(bytes: &[u8]) -> String {
    read(bytes).expect_err("it must not be read").to_string()
}

/// The uncompressed parts of a file.
fn parts(file: &[u8]) -> Vec<u8> {
    let Opened { compressed, .. } = opened(Path::new("a"), file).expect("a good file");
    let mut parts = Vec::new();
    ZlibDecoder::new(compressed).read_to_end(&mut parts).expect("good parts");
    parts
}

#[test]
fn what_is_read_is_written_again_bit_by_bit() {
    let file = capture().to_bytes();
    let again = read(&file).expect("a capture");
    assert_eq!(again.program, "0.0.1", "the program that wrote it");
    assert_eq!(again.image_hash(), fnv1a(&[7; 16]), "the image");
    assert!(again.to_bytes() == file, "every part");
}

#[test]
fn another_version_is_named_beside_ours() {
    let message = message(&sealed(9, "7.8.9", b"whatever"));
    let ours = [
        format!("reads versions {OLDEST} to {VERSION}"),
        concat!("trigon ", env!("CARGO_PKG_VERSION")).to_owned(),
    ];
    for word in ["version 9", "trigon 7.8.9;"].map(str::to_owned).into_iter().chain(ours) {
        assert!(message.contains(&word), "{word:?} in {message:?}");
    }
}

/// Version 7 knew neither radii of lights nor soft shadows.
#[test]
fn a_capture_of_version_7_has_lamps_without_an_extent() {
    let [lamp, usual] = [1234.5_f32, 5432.1];
    let mut capture = capture();
    let lights = |scene: &Scene| -> Vec<Light> {
        scene.nodes().iter().filter_map(|(_, node)| node.light.as_deref().copied()).collect()
    };
    let (_, node) =
        capture.scene.nodes_mut().find(|(_, node)| node.light.is_some()).expect("there is a spot");
    node.light = node.light.as_ref().map(|light| Box::new(light.with_radius(lamp)));
    capture.settings.effects.soft_shadows.radius = usual;
    let mut parts = parts(&capture.to_bytes());
    // The radius of lamps without one is followed by the number of rays and where they start.
    for (radius, length) in [(lamp, 4), (usual, 9)] {
        let bytes = radius.to_le_bytes();
        let at = parts.windows(4).position(|window| window == bytes).expect("it is written");
        parts.drain(at..at + length);
    }
    let old = read(&sealed(7, "0", &parts)).expect("an older capture");
    assert_eq!(old.settings.effects.soft_shadows, SoftShadows::default());
    assert_eq!(lights(&old.scene), [Light::spot(1.0)], "sharp");
}

#[test]
fn what_is_no_whole_capture_is_told_from_a_damaged_one() {
    let file = capture().to_bytes();
    for length in 0..file.len() {
        let message = message(&file[..length]);
        // Magic, version, and the program's version with its length.
        let expected =
            if length < 8 + 4 + 1 + 5 { "it is not a capture" } else { "not those that were written" };
        assert!(message.contains(expected), "{length} bytes: {message}");
    }
    for at in 18..file.len() {
        let mut file = file.clone();
        file[at] ^= 1 << (at % 8);
        assert!(message(&file).contains("not those that were written"), "a bit of byte {at}");
    }
}

#[test]
fn parts_that_contradict_each_other_are_named() {
    let whole = parts(&capture().to_bytes());
    let message_of = |parts: &[u8]| message(&sealed(VERSION, "0", parts));
    assert!(message_of(&whole[..whole.len() - 1]).contains("ends too early"), "a byte less");
    assert!(message_of(&[&whole[..], &[0]].concat()).contains("more follows"), "a byte more");
    let claim = u64::MAX.to_le_bytes();
    assert!(message_of(&claim).contains("are more than the 4294967296 bytes allowed"), "an absurd claim");
    let mut wide = whole.clone();
    let at = wide.len() - 16 - 8 - 1;
    wide.truncate(at);
    assert!(message_of(&wide).contains("ends too early"), "without an image");
    let mut other = capture();
    other.color.push(0);
    assert!(message(&other.to_bytes()).contains("another size"), "an image that is too long");
    other = capture();
    other.camera.position.x = f64::NAN;
    assert!(message(&other.to_bytes()).contains("no valid position"), "a camera that is nowhere");
}

#[test]
fn the_up_axis_comes_back_bit_by_bit() {
    for up in [UpAxis::Y, UpAxis::Z, UpAxis::new(DVec3::new(0.1, -0.2, 0.7))] {
        let mut capture = capture();
        capture.scene.up = up;
        let again = read(&capture.to_bytes()).expect("a capture");
        assert_eq!(again.scene.up, up, "with all sides");
    }
}

/// A megabyte of zeros is a kilobyte of file.
#[test]
fn what_comes_out_of_compression_is_limited() {
    let mut capture = capture();
    capture.settings = RenderSettings::new(512, 512);
    capture.color = vec![0; 4 * 512 * 512];
    let file = capture.to_bytes();
    let limits = Limits { total_bytes: 1 << 20, ..Limits::default() };
    let error = Capture::from_bytes("a.trigon", &file, &limits).expect_err("over the limit");
    assert_eq!(error.kind, LoadErrorKind::Limit, "{error}");
    read(&file).expect("within the usual limits");
}

#[test]
fn nodes_in_a_ring_are_refused() {
    let mut capture = capture();
    let ids: Vec<_> = capture.scene.nodes().iter().map(|(id, _)| id).collect();
    capture.scene.set_parent(ids[2], Some(ids[1])).expect("a chain");
    let mut whole = parts(&capture.to_bytes());
    // The children of the three nodes: #1, #2, none. The last one is given #0.
    let list = |child: u32| [&1_u64.to_le_bytes()[..], &child.to_le_bytes()].concat();
    let chain = [list(1), list(2), 0_u64.to_le_bytes().to_vec()].concat();
    let at = whole.windows(chain.len()).position(|window| window == chain).expect("they are there");
    for (last, word) in [(0, "cycle"), (1, "two parents"), (9, "no item 9")] {
        let mut whole = whole.clone();
        whole.splice(at + 24..at + 32, list(last));
        assert!(message(&sealed(VERSION, "0", &whole)).contains(word), "{last}");
    }
    whole.splice(at + 24..at + 32, 0_u64.to_le_bytes());
    read(&sealed(VERSION, "0", &whole)).expect("as it was");
}

proptest! {
    /// Bytes are changed before they are sealed, so that no hash catches it.
    #[test]
    fn no_parts_make_the_reader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let mut parts = parts(&capture().to_bytes());
        for (at, byte) in changes {
            let at = at.index(parts.len());
            parts[at] = byte;
        }
        if let Some(cut) = cut {
            parts.truncate(cut.index(parts.len()));
        }
        let file = sealed(VERSION, "0", &parts);
        if let Ok(capture) = read(&file) {
            // What is accepted is whole: it can be written, read again, and drawn, unless
            // its settings ask for what there is not.
            let again = read(&capture.to_bytes());
            prop_assert!(again.is_ok(), "{:?}", again.map(|_| ()));
            if let Ok(frame) = render(&capture.scene, &capture.camera, &capture.settings) {
                prop_assert_eq!(frame.color.len(), 16, "four pixels");
            }
        }
    }

    #[test]
    fn no_bytes_make_the_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(read(&sealed(VERSION, "0", &bytes)).is_err(), "too short for a capture");
    }
}

#[test]
fn the_authors_test_vectors_hold() {
    assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325, "the offset basis");
    assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8, "from their page");
}
