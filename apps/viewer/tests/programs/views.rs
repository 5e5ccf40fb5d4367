//! Many views of one model that is loaded once: cameras of files, turntables and animations, each with its outputs.

use serde_json::{Value, json};

use super::*;

/// The one line of JSON on standard output.
fn facts(folder: &Folder, flags: &str, code: i32) -> Value {
    let output = folder.run(&format!("{flags} --json"));
    assert_eq!(output.status.code(), Some(code), "{flags}: {output:?}");
    serde_json::from_slice(&output.stdout).expect("one line of JSON")
}

/// A camera 6 m before the corner, as computer vision has it: world to camera, Z forward, Y down.
const COLMAP_IMAGES: &str = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
1 0 1 0 0 -0.5 0.5 6 1 left/first.jpg
100 100 -1
2 0 1 0 0 -0.8 0.5 6 2 second.jpg

";
const COLMAP_CAMERAS: &str = "1 PINHOLE 60 40 80 80 30 20\n2 SIMPLE_PINHOLE 40 40 90 20 20\n";

#[test]
fn a_camera_of_json_draws_the_same_bytes() {
    let folder = Folder::new();
    for flags in [
        "",
        "--view=top",
        "--camera-position=3,2,7 --camera-view-angle=33.3",
        "--camera-orthographic --camera-azimuth-angle=20",
        "--camera-exact=0.3,0.4,5/0,0,0,1/5/frustum,-0.1,0.2,-0.1,0.1,0.5,inf",
        "--camera-exact=0.3,0.4,5/0,0,0,1/5/pinhole,70,71,31.25,19.5,60,40,0.5,100",
    ] {
        let single = facts(&folder, &format!("corner.obj --resolution 60,40 --output one.png {flags}"), 0);
        folder.write("one.json", &single.to_string());
        let many = facts(&folder, "corner.obj --cameras=one.json --output view_{frame:2}.png", 0);
        assert_eq!(many["views"][0]["camera"], single["camera"], "{flags}: the camera");
        assert!(image(&folder.path("view_00.png")) == image(&folder.path("one.png")), "{flags}: the image");
        // And what a series writes is a camera file.
        folder.write("many.json", &many.to_string());
        let again = facts(&folder, "corner.obj --cameras=many.json --output again_{frame}.png", 0);
        assert_eq!(again["views"][0]["camera"], single["camera"], "{flags}: again");
    }
}

/// Each view has its own size, name and outputs, and is what it is alone.
#[test]
fn views_of_a_data_set_have_sizes_names_and_outputs_of_their_own() {
    let folder = Folder::new();
    fs::create_dir(folder.path("sparse")).expect("a folder");
    folder.write("sparse/cameras.txt", COLMAP_CAMERAS);
    folder.write("sparse/images.txt", COLMAP_IMAGES);
    let outputs = "--outputs=depth,object-ids,positions --no-background";
    let listed = facts(&folder, &format!("corner.obj --cameras=sparse --output {{camera}}.png {outputs}"), 0);
    let views = listed["views"].as_array().expect("a list");
    assert_eq!(views.len(), 2, "{listed}");
    for (view, name, size) in [(&views[0], "first", (60, 40)), (&views[1], "second", (40, 40))] {
        assert_eq!((&view["width"], &view["height"]), (&size.0.into(), &size.1.into()), "{view}");
        assert_eq!(
            png_size(&fs::read(folder.path(&format!("{name}.png"))).expect("written")),
            size,
            "{name}"
        );
        let written: Vec<&str> =
            view["written"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
        let expected = ["png", "depth.npy", "object-ids.npy", "positions.npy", "positions-origin.npy"];
        assert_eq!(written, expected.map(|ending| format!("{name}.{ending}")), "{view}");
        // Alone it is the same.
        folder.write("alone.json", &json!({"cameras": [view]}).to_string());
        folder.said(&format!("corner.obj --cameras=alone.json --output alone_{{frame}}.png {outputs}"), 0);
        for (ending, other) in
            [("png", "png"), ("depth.npy", "depth.npy"), ("positions.npy", "positions.npy")]
        {
            let [one, two] = [format!("{name}.{ending}"), format!("alone_0.{other}")]
                .map(|name| fs::read(folder.path(&name)).expect("written"));
            assert!(one == two, "{name}.{ending} is not what it is alone");
        }
    }
    // The corner's face at z = 1 is 5 m ahead, and (0.5, 0.5) is in the middle of the first image.
    let depth = fs::read(folder.path("first.depth.npy")).expect("written");
    let data = &depth[depth.len() - 4 * 60 * 40..];
    let at = |x: usize, y: usize| {
        let start = 4 * (y * 60 + x);
        f32::from_le_bytes(data[start..start + 4].try_into().expect("four bytes"))
    };
    assert!((at(31, 17) - 6.0).abs() < 1e-5, "the wall at z = 0 is 6 m ahead, not {}", at(31, 17));

    let resized = facts(&folder, "corner.obj --cameras=sparse --resolution 30,20 --output r_{frame}.png", 0);
    assert_eq!(resized["views"][1]["width"], 30, "--resolution is for all views");
    let said = folder.said("corner.obj --cameras=sparse --output all.gif", 2);
    assert!(said.contains("different sizes"), "{said}");
    folder.said("corner.obj --cameras=sparse --output all.gif --resolution 30,20", 0);
}

#[test]
fn an_output_that_fails_does_not_stop_the_others() {
    let folder = Folder::new();
    // The second camera is 100 m away, which is too far for depth in 16 bits of millimetres.
    let camera = |z: f64| json!({"position": [0.5, 0.5, z], "rotation": [0, 0, 0, 1], "vertical_fov": 1});
    folder.write("c.json", &json!({"cameras": [camera(6.0), camera(100.0), camera(5.0)]}).to_string());
    let outputs = "--outputs=depth.png,normals,object-ids --resolution 40,30";
    let listed = facts(&folder, &format!("corner.obj --cameras=c.json --output v{{frame}}.png {outputs}"), 1);
    for frame in 0..3 {
        let view = &listed["views"][frame];
        assert_eq!(view["failure"].is_null(), frame != 1, "{view}");
        for ending in ["png", "normals.npy", "object-ids.npy"] {
            assert!(folder.path(&format!("v{frame}.{ending}")).is_file(), "v{frame}.{ending} is missing");
        }
        assert_eq!(folder.path(&format!("v{frame}.depth.png")).is_file(), frame != 1, "{view}");
    }
    let said = folder.said(
        &format!("corner.obj --camera-position=0.5,0.5,100 --camera-view-angle=1 --output o.png {outputs}"),
        1,
    );
    assert!(said.contains("65.535") && folder.path("o.object-ids.npy").is_file(), "{said}");
}

#[test]
fn turntables_and_animations_have_outputs_and_cameras() {
    let folder = Folder::new();
    let turn = facts(
        &folder,
        "corner.obj --turntable=3 --resolution 40,30 --outputs=depth --output t{frame}.png",
        0,
    );
    assert_eq!(turn["views"].as_array().map(Vec::len), Some(3), "{turn}");
    assert!(folder.path("t2.depth.npy").is_file(), "with its depth");
    assert_ne!(turn["views"][0]["camera"], turn["views"][1]["camera"], "from another side");
    folder.write("slide.gltf", moments::SLIDE);
    let play = facts(
        &folder,
        "slide.gltf --frame-rate=2 --resolution 40,30 --outputs=positions --output a{frame}.png",
        0,
    );
    assert_eq!(play["views"].as_array().map(Vec::len), Some(3), "{play}");
    let [first, last] =
        ["a0", "a2"].map(|name| fs::read(folder.path(&format!("{name}.positions.npy"))).expect("written"));
    assert!(first != last, "it has moved");
}

#[test]
fn what_is_wrong_with_cameras_is_said() {
    let folder = Folder::new();
    folder.write(
        "c.json",
        r#"{"cameras": [{"position": [0, 0, 5], "rotation": [0, 0, 0, 1], "vertical_fov": 20}]}"#,
    );
    for (flags, code, word) in [
        ("--cameras=c.json --output o.png", 2, "{frame} or {camera}"),
        ("--cameras=c.json", 2, "--output"),
        ("--cameras=c.json --turntable=3 --output o{frame}.png", 2, "--turntable"),
        ("--cameras=c.json --view=top --output o{frame}.png", 2, "--view"),
        ("--cameras=gone.json --output o{frame}.png", 1, "gone.json"),
        ("--cameras=corner.mtl --output o{frame}.png", 1, "corner.mtl"),
        ("--cameras=c.json --output o.gif --outputs=depth", 2, "{frame}"),
    ] {
        let said = folder.said(&format!("corner.obj {flags}"), code);
        assert!(said.contains(word), "{flags}: {said}");
    }
    // A camera that looks the other way, by the wrong convention.
    folder.write("away.json", r#"{"cameras": [{"position": [0, 0, 5], "rotation": [0, 0, 0, 1], "vertical_fov": 20, "convention": "opencv"}]}"#);
    let said = folder.said("corner.obj --cameras=away.json --output o{frame}.png --resolution 9,9", 0);
    assert!(said.contains("not in view in 1 of 1") && said.contains("convention"), "{said}");
}

/// A lens of 200°, twice: as COLMAP writes it, and as `--json` gives it back.
#[test]
fn fisheye_cameras_are_drawn_and_given_back() {
    let folder = Folder::new();
    fs::create_dir(folder.path("sparse")).expect("a folder");
    folder.write("sparse/cameras.txt", "1 OPENCV_FISHEYE 60 40 16 16 30 20 0.01 -0.002 0 0\n");
    folder.write("sparse/images.txt", "1 0 1 0 0 -0.5 0.5 2 1 first.jpg\n\n");
    let outputs = "--outputs=depth,object-ids";
    let first = facts(&folder, &format!("corner.obj --cameras=sparse --output f_{{frame}}.png {outputs}"), 0);
    let camera = &first["views"][0]["camera"];
    assert_eq!(camera["fisheye"], json!([0.01, -0.002, 0.0, 0.0]), "{camera}");
    folder.write("again.json", &first.to_string());
    let again =
        facts(&folder, &format!("corner.obj --cameras=again.json --output g_{{frame}}.png {outputs}"), 0);
    assert_eq!(again["views"][0]["camera"], *camera, "the camera");
    for ending in ["png", "depth.npy", "object-ids.npy"] {
        let [one, two] =
            ["f", "g"].map(|name| fs::read(folder.path(&format!("{name}_0.{ending}"))).expect("written"));
        assert!(one == two, "{ending}");
    }
    let depth = fs::read(folder.path("f_0.depth.npy")).expect("written");
    let at = depth.len() - 4 * 60 * 40 + 4 * (20 * 60 + 30);
    let middle = f32::from_le_bytes(depth[at..at + 4].try_into().expect("four bytes"));
    // Half a pixel beside the axis.
    assert!((middle - 2.0).abs() < 0.01, "the wall at z = 0 is 2 m ahead, not {middle}");
    let said = folder.said("corner.obj --cameras=sparse --output t_{frame}.png --time-budget=100ms", 2);
    assert!(said.contains("fisheye"), "{said}");
    let said = folder.said("corner.obj --cameras=sparse --output e_{frame}.png --edges", 0);
    assert!(said.contains("edges of faces are not drawn"), "{said}");
}
