//! Pixels that are explained, models that are compared, and what faces show.

use super::*;

/// Two squares, one behind the other.
const BEHIND: &str = "o front\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 2 3 4\n\
    o back\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 5 6 7 8\n";

#[test]
fn a_pixel_is_explained() {
    let folder = Folder::new();
    folder.write("two.obj", BEHIND);
    let flags = "two.obj --view=front --resolution=60,40 --samples=1 --explain-pixel";
    let text = String::from_utf8(folder.run(&format!("{flags} 31,20")).stdout).expect("text");
    for part in
        ["pixel 31, 20", "front", "visible, because it is the nearest", "back", "hidden", "edge values"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let json = folder.run(&format!("{flags} 31,20 --json")).stdout;
    let json: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let fragments = json["samples"][0]["fragments"].as_array().expect("a list");
    assert_eq!((&fragments[0]["node"], &fragments[0]["visible"]), (&"front".into(), &true.into()), "{json}");
    let hidden = fragments.iter().find(|fragment| fragment["node"] == "back" && fragment["covered"] == true);
    let hidden = hidden.expect("it is there, too");
    assert!(hidden["margin"].as_i64().is_some_and(|margin| margin < 0), "behind: {hidden}");
    assert!(hidden["edges"][0]["value"].as_i64().is_some_and(|value| value >= 0), "inside: {hidden}");
    let sky = String::from_utf8(folder.run(&format!("{flags} 0,0")).stdout).expect("text");
    assert!(sky.contains("the background"), "nothing there: {sky}");
    assert!(folder.said(&format!("{flags} 60,0"), 2).contains("60x40"), "outside, with the size");
    folder.said(&format!("{flags} 1,1 --output o.png"), 2);
    assert!(folder.said("two.obj --explain-pixel=7", 2).contains("320,200"), "an example");
}

#[test]
fn two_models_are_compared() {
    let folder = Folder::new();
    folder.write("two.obj", BEHIND);
    folder.write("one.obj", BEHIND.split("o back").next().expect("the first part"));
    let flags = "--camera-position=3,2,9 --resolution=60,40 --output o.png";
    let said = folder.said(&format!("two.obj --compare one.obj {flags}"), 3);
    assert!(said.contains("pixels differ"), "how much: {said}");
    let pair = image(&folder.path("o.png"));
    assert_eq!((pair.width, pair.height), (180, 40), "both and where they differ");
    let said = folder.said(&format!("two.obj --compare two.obj {flags}"), 0);
    assert!(said.contains("no pixel differs"), "{said}");
    let same = image(&folder.path("o.png"));
    let row = |image: &trigon_io::RgbaImage, part: usize| {
        let start = 4 * (20 * 180 + part * 60);
        image.rgba[start..start + 4 * 60].to_vec()
    };
    assert_eq!(row(&same, 0), row(&same, 1), "the same twice");
    assert_eq!(row(&pair, 0), row(&same, 0), "seen by the first one's camera");
    assert!(row(&same, 2).chunks(4).all(|pixel| pixel == [0, 0, 0, 255]), "and no difference");
    let json = folder.run(&format!("two.obj --compare one.obj {flags} --json")).stdout;
    let json: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    assert!(json["different_pixels"].as_u64().is_some_and(|pixels| pixels > 0), "{json}");
    assert!(folder.failed(&format!("two.obj --compare gone.obj {flags}")).contains("gone.obj"), "which one");
    folder.said(&format!("two.obj one.obj --compare one.obj {flags}"), 2);
}

#[test]
fn what_faces_show_is_chosen_by_flags() {
    let folder = Folder::new();
    let shown = |flags: &str| {
        folder.said(&format!("corner.obj --resolution=60,40 --output o.png {flags}"), 0);
        image(&folder.path("o.png")).rgba
    };
    let plain = shown("");
    let before_wall = "--camera-position=0.5,0.5,-6 --camera-focal-point=0.5,0.5,0";
    for (display, middle) in [
        ("matcap", None),
        ("base-color", Some([255, 0, 0])),
        // The wall looks to -Z.
        ("normal", Some([127, 127, 0])),
        ("geometric-normal", Some([127, 127, 0])),
        ("roughness", None),
        ("alpha", Some([255; 3])),
        ("depth", None),
    ] {
        let flag = format!("--display={display}");
        assert_ne!(shown(&flag), plain, "{display}");
        let rgba = shown(&format!("{flag} {before_wall}"));
        let pixel = &rgba[4 * (60 * 20 + 30)..][..3];
        assert!(middle.is_none_or(|middle| pixel == middle), "{display}: {pixel:?}");
    }
    assert_eq!(shown("--display=depth"), shown("--display-depth"), "two names");
    assert!(folder.said("corner.obj --display=heat --output o.png", 2).contains("base-color"), "a list");
    let hidden = shown("--hide-nodes=0 --no-background");
    assert!(hidden.chunks(4).all(|pixel| pixel == [0; 4]), "hidden by number");
    assert!(shown("--no-background").chunks(4).any(|pixel| pixel[3] == 255), "and else it is there");
    let said = folder.failed("corner.obj --hide-nodes=gone --output o.png");
    assert!(said.contains("gone") && said.contains("--scene-hierarchy"), "{said}");
}
