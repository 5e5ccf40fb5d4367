//! Which axis is up: that of the format, of a configuration file, or of the command line.

use std::fs;

use super::{Folder, image};

/// How a point of a world with +Y up is written where another axis is up.
type Turn = fn([f64; 3]) -> [f64; 3];

/// The axes, each with its turn: right stays right and front stays in front. The sides are those of F3D.
const AXES: [(&str, Turn); 6] = [
    ("+X", |[x, y, z]| [y, x, -z]),
    ("-X", |[x, y, z]| [-y, x, z]),
    ("+Y", |[x, y, z]| [x, y, z]),
    ("-Y", |[x, y, z]| [x, -y, -z]),
    ("+Z", |[x, y, z]| [x, -z, y]),
    ("-Z", |[x, y, z]| [x, z, -y]),
];

/// A wedge on a slab, alike from no two sides: triangles with +Y up.
fn triangles() -> Vec<[[f64; 3]; 3]> {
    let [a, b, c, d] = [[0.0, 0.25, 0.0], [2.0, 0.25, 0.0], [0.0, 0.25, 1.0], [0.5, 2.0, 0.25]];
    let [e, f, g, h] = [[-1.0, 0.0, -1.0], [3.0, 0.0, -1.0], [3.0, 0.0, 2.0], [-1.0, 0.0, 2.0]];
    vec![[a, c, b], [a, b, d], [b, c, d], [c, a, d], [e, h, g], [g, f, e], [g, h, e], [e, f, g]]
}

fn solid(place: fn([f64; 3]) -> [f64; 3]) -> String {
    let corner = |corner: [f64; 3]| {
        let [x, y, z] = place(corner);
        format!("vertex {x} {y} {z}\n")
    };
    let facet = |corners: [[f64; 3]; 3]| {
        let corners = corners.map(corner).concat();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    format!("solid part\n{}endsolid part\n", triangles().into_iter().map(facet).collect::<String>())
}

/// A folder with the part for each axis, a room and the same part as OBJ with +Y up.
fn folder() -> Folder {
    let folder = Folder::new();
    for (name, place) in AXES {
        folder.write(&format!("part{name}.stl"), &solid(place));
    }
    let mut obj = String::new();
    for [x, y, z] in triangles().into_iter().flatten() {
        obj += &format!("v {x} {y} {z}\n");
    }
    for face in 0..triangles().len() {
        obj += &format!("f {} {} {}\n", 3 * face + 1, 3 * face + 2, 3 * face + 3);
    }
    folder.write("part.obj", &obj);
    // Every direction has another colour, and above it is brightest.
    let mut room = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    room.extend((0..128_u8).flat_map(|index| [index % 16 * 16, 255 - index / 16 * 32, index, 128]));
    fs::write(folder.path("room.hdr"), room).expect("the folder is writable");
    folder
}

fn drawn(folder: &Folder, flags: &str) -> Vec<u8> {
    folder.said(&format!("{flags} --resolution 90x60 --no-config --output o.png"), 0);
    image(&folder.path("o.png")).rgba
}

/// The picture of a turned part with its axis up has the bytes of the upright one: camera, studio in metals, grid,
/// environment, what is behind the model, and rays.
#[test]
fn a_part_looks_the_same_whichever_axis_is_up() {
    let folder = folder();
    for look in [
        "--metallic=1 --roughness=0.2 --grid",
        "--metallic=1 --roughness=0.3 --hdri-file=room.hdr --hdri-skybox --grid --axis=false",
        "--hdri-file=room.hdr --shadows=rays --view=right",
        "--metallic=1 --roughness=0 --bounces=2 --view=top",
        "--turntable=3 --metallic=1",
    ] {
        let drawn = |up: &str, file: &str| {
            let output = if look.contains("turntable") { "o{frame}.png" } else { "o2.png" };
            folder.said(
                &format!("{file} --up={up} {look} --resolution 90x60 --no-config --output {output}"),
                0,
            );
            image(&folder.path(&output.replace("{frame}", "2"))).rgba
        };
        let expected = drawn("+Y", "part+Y.stl");
        for (up, _) in AXES {
            assert!(drawn(up, &format!("part{up}.stl")) == expected, "{up} up, {look}");
        }
        assert!(drawn("+Y", "part+Z.stl") != expected, "lying on its side it looks otherwise: {look}");
    }
}

#[test]
fn stl_is_seen_from_the_front_right_above_with_z_up() {
    let folder = folder();
    let upright = drawn(&folder, "part+Y.stl --up=+Y");
    assert!(drawn(&folder, "part+Z.stl") == upright, "without a flag");
    let seen = drawn(&folder, "part+Z.stl --camera-direction=-1,1,-0.5");
    assert!(seen == upright, "the front is -Y, the eye right of it and above");
    assert!(drawn(&folder, "part+Y.stl") != upright, "numbers with +Y up lie on their side");
    assert!(drawn(&folder, "part.obj") == drawn(&folder, "part.obj --up=+Y"), "an OBJ has +Y up");
}

#[test]
fn a_configuration_key_changes_the_axis_and_the_command_line_has_the_last_word() {
    let folder = folder();
    let config = r#"[{"match": ".*\\.stl", "options": {"up": "+Y"}}]"#;
    folder.write("y.json", config);
    folder.write("f3d.json", &config.replace("\"up\"", "\"scene.up.direction\""));
    let drawn = |flags: &str| {
        folder.said(&format!("{flags} --resolution 90x60 --output o.png"), 0);
        image(&folder.path("o.png")).rgba
    };
    let [upright, lying] = ["+Y", "+Z"].map(|up| drawn(&format!("part+Y.stl --no-config --up={up}")));
    assert!(upright != lying, "they can be told apart");
    for config in ["y.json", "f3d.json"] {
        assert!(drawn(&format!("part+Y.stl --config={config}")) == upright, "{config}");
        assert!(drawn(&format!("part+Y.stl --config={config} --up=+Z")) == lying, "{config} and a flag");
    }
}

#[test]
fn files_of_several_conventions_stand_side_by_side() {
    let folder = folder();
    let together = "--multi-file-mode=all --no-config --resolution 60x40 --output o.png --json";
    let size = |flags: &str| {
        let output = folder.run(flags);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        let facts: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a line of JSON");
        (facts["size"].clone(), said)
    };
    // The second is turned onto the first, which keeps its coordinates.
    let (found, said) = size(&format!("part+Z.stl part.obj {together}"));
    assert_eq!(found, serde_json::json!([4.0, 3.0, 2.0]), "z is up");
    assert!(said.contains("part.obj was turned: +Y is up") && said.contains("--up=+Z"), "{said}");
    let (found, said) = size(&format!("part.obj part+Z.stl {together}"));
    assert_eq!(found, serde_json::json!([4.0, 2.0, 3.0]), "y is up");
    assert!(said.contains("part+Z.stl was turned: +Z is up"), "{said}");
    let (found, said) = size(&format!("part+Z.stl part.obj {together} --up=+Z"));
    assert_eq!(found, serde_json::json!([4.0, 4.0, 3.0]), "as their numbers are: {said}");
    assert!(!said.contains("turned"), "{said}");
    let said =
        folder.said("part+Z.stl --compare corner.obj --no-config --resolution 60x40 --output o.png", 3);
    assert!(said.contains("corner.obj was turned: +Z is up in part+Z.stl"), "{said}");
}

/// Positions are those of the file, whatever is up.
#[test]
fn outputs_are_in_the_frame_of_the_file() {
    let folder = folder();
    for up in ["", "--up=+Y", "--up=-X"] {
        let flags = format!("part+Z.stl {up} --view=top --no-config --resolution 30x20 --outputs positions");
        folder.said(&format!("{flags} --output o.png"), 0);
        let bytes = super::array(&folder.path("o.positions.npy"));
        let numbers: Vec<f32> =
            bytes.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four"))).collect();
        let inside = |point: &[f32]| {
            (-1.001..=3.001).contains(&point[0])
                && (-2.001..=1.001).contains(&point[1])
                && (-0.001..=2.001).contains(&point[2])
        };
        let seen: Vec<&[f32]> = numbers.chunks_exact(3).filter(|point| *point != [0.0; 3]).collect();
        assert!(seen.len() > 50, "{up}: {} points", seen.len());
        assert!(seen.iter().all(|point| inside(point)), "{up}: {seen:?}");
    }
}

#[test]
fn a_capture_keeps_the_up_axis() {
    let folder = folder();
    let flags = "part+Z.stl --metallic=1 --roughness=0.2 --no-config --resolution 60x40 --output o.png";
    folder.said(&format!("{flags} --capture part.trigon"), 0);
    let said = folder.said("--replay part.trigon", 0);
    assert!(said.contains("the same image"), "{said}");
}
