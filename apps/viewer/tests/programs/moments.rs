//! Scenes and moments of a file, and light from an image.

use super::*;

/// A triangle that goes 3 m to the right within a second, in a scene called "near",
/// and the same at rest in a scene called "far"; "near" is what is shown.
pub(crate) const SLIDE: &str = r#"{"asset": {"version": "2.0"}, "scene": 0,
"scenes": [{"name": "near", "nodes": [0]}, {"name": "far", "nodes": [1]}],
"nodes": [{"mesh": 0}, {"mesh": 0, "translation": [2, 2, 0]}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAEBAAAAAAAAAAAA="}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
{"buffer": 0, "byteOffset": 44, "byteLength": 24}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
{"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
{"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
"animations": [{"name": "slide", "samplers": [{"input": 1, "output": 2}],
"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]}"#;

/// Where the model is in an image without background: the mean column and row.
fn middle(image: &trigon_io::RgbaImage) -> (f64, f64) {
    let (mut sum, mut count) = ((0.0, 0.0), 0.0);
    for (index, _) in image.rgba.chunks(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
        sum = (sum.0 + f64::from(index as u32 % image.width), sum.1 + f64::from(index as u32 / image.width));
        count += 1.0;
    }
    (sum.0 / count, sum.1 / count)
}

#[test]
fn scenes_and_moments_of_animations_are_chosen() {
    let folder = Folder::new();
    folder.write("slide.gltf", SLIDE);
    let seen = |flags: &str| {
        let fixed = "--camera-position 2,1,12 --camera-focal-point 2,1,0 --no-background --resolution 120x80";
        folder.said(&format!("slide.gltf {fixed} --output o.png {flags}"), 0);
        middle(&image(&folder.path("o.png")))
    };
    let rest = seen("");
    let moved = |flags: &str| {
        let (x, y) = seen(flags);
        // 80 rows show 12 · 2 · tan 15° metres.
        let metres = 24.0 * trigon_math::elementary::tan(15f64.to_radians()) / 80.0;
        (((x - rest.0) * metres * 10.0).round() / 10.0, ((rest.1 - y) * metres * 10.0).round() / 10.0)
    };
    for (flags, expected) in [
        ("--animation-index 0", (0.0, 0.0)),
        ("--animation-time 0.5", (1.5, 0.0)),
        ("--animation-time=1 --animation-index=-1", (3.0, 0.0)),
        ("--animation-time 7 --animation-indices 0", (3.0, 0.0)),
        ("--scene far", (2.0, 2.0)),
        ("--scene 0", (0.0, 0.0)),
    ] {
        assert_eq!(moved(flags), expected, "{flags}");
    }
    assert!(folder.failed("slide.gltf --animation-index 1 --output o.png").contains("0 slide"), "lists them");
    assert!(folder.failed("corner.obj --animation-time 1 --output o.png").contains("no animation"), "none");
    assert!(folder.failed("slide.gltf --scene middle --output o.png").contains("middle"), "no such scene");
    let listed = folder.run("slide.gltf --no-render").stdout;
    let listed = String::from_utf8(listed).expect("text");
    for line in ["scene 0   \"near\"", "scene 1   \"far\"", "animation 0 \"slide\", 1 s"] {
        assert!(listed.contains(line), "{line} in {listed}");
    }
}

#[test]
fn a_radiance_image_lights_the_model() {
    let folder = Folder::new();
    // Blue from above, red from below: without compression, 128 with the exponent 129 is 1.
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    let pixel = |index: usize| if index < 64 { [0, 0, 128, 129] } else { [128, 0, 0, 129] };
    bytes.extend((0..128).flat_map(pixel));
    fs::write(folder.path("room.hdr"), bytes).expect("the folder is writable");
    folder.write("floor.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n");
    for (side, brightest) in [("top", 2), ("bottom", 0)] {
        folder.said(
            &format!("floor.obj --hdri-file room.hdr --view={side} --resolution 60x40 --output o.png"),
            0,
        );
        let rgba = image(&folder.path("o.png")).rgba;
        let pixel = &rgba[4 * (60 * 20 + 30)..][..3];
        let others = (0..3).filter(|&channel| channel != brightest).map(|channel| pixel[channel]);
        assert!(
            others.clone().all(|other| u32::from(pixel[brightest]) > 2 * u32::from(other)),
            "{side}: {pixel:?}"
        );
    }
    assert!(folder.failed("floor.obj --hdri-file gone.hdr --output o.png").contains("gone.hdr"), "no file");
    folder.write("text.hdr", "no image");
    assert!(folder.failed("floor.obj --hdri-file text.hdr --output o.png").contains("Radiance"), "no image");
    folder.said("floor.obj --hdri-file room.hdr --sky --output o.png", 2);
    folder.said("floor.obj --hdri-file room.hdr --hdri-skybox --hdri-ambient=false --output o.png", 2);
    folder
        .said("floor.obj --hdri-file room.hdr --hdri-skybox --view=top --resolution 60x40 --output o.png", 0);
    let corner = &image(&folder.path("o.png")).rgba[..4];
    assert!(corner[0] > 2 * corner[2] && corner[3] == 255, "beside the floor is the room's: {corner:?}");
}
