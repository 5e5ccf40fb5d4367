//! Flags about the image, presets and budgets: what they change.

use std::collections::BTreeSet;

use crate::{Folder, NARROW, image};

#[test]
fn every_flag_about_the_image_changes_it() {
    let folder = Folder::new();
    let stream = |flags: &str| {
        let output = folder.run(&format!("corner.obj --output - --resolution 60,40 {flags}"));
        assert!(output.status.success(), "`{flags}`: {}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    let plain = stream("");
    for flags in [
        "--up=+Z",
        "--edges",
        "--style=wireframe",
        "--style=hidden-line",
        "--anti-aliasing=none",
        "--samples=4",
        "--anti-aliasing=msaa",
        "--view=front",
        "--camera-direction=1,0,0",
        "--camera-position=3,4,5",
        "--camera-focal-point=1,1,1",
        "--camera-view-up=1,1,0",
        "--camera-view-angle=60",
        "--camera-zoom-factor=2",
        "--camera-azimuth-angle=30",
        "--camera-elevation-angle=30",
        "--camera-orthographic",
        "--opacity=50%",
        "--metallic=1",
        "--roughness=0.2",
        "--point-sprites",
        "--shadows",
        "--ambient-occlusion",
        "--light-intensity=0.5",
    ] {
        assert!(stream(flags) != plain, "`{flags}` changes nothing");
    }
    let pixels = |flags: &str| {
        folder.said(&format!("corner.obj --output o.png --resolution 60,40 --verbose=error {flags}"), 0);
        image(&folder.path("o.png")).rgba
    };
    let count =
        |flags: &str, color: [u8; 4]| pixels(flags).chunks(4).filter(|pixel| **pixel == color).count();
    let (all, model) = (60 * 40, 60 * 40 - count("--no-background", [0; 4]));
    assert!((200..2000).contains(&model), "the model takes a part of the image: {model} pixels");
    // Edges of the model are mixed with what is behind them.
    assert_eq!(count("--background-color=navy", [0, 0, 128, 255]), all - model, "navy where no model is");
    let inner = model - 120;
    assert!((inner..=model).contains(&count("--color=green --unlit", [0, 128, 0, 255])), "a green model");
    folder.write(
        "tile.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n",
    );
    let colors_of_tile = |flags: &str| {
        let flags = format!("--view=front --unlit --no-background --anti-aliasing=none {flags}");
        folder.said(&format!("tile.obj --output t.png --resolution 60,40 {flags}"), 0);
        image(&folder.path("t.png")).rgba.chunks(4).map(<[u8]>::to_vec).collect::<BTreeSet<_>>().len()
    };
    let colors = [colors_of_tile(""), colors_of_tile("--checkerboard")];
    assert_eq!(colors, [2, 3], "the background, and one or two colors");
    // The camera sees the outside of the corner from one side, and its inside from the other.
    let hidden = ["1,1,1", "-1,-1,-1"].map(|direction| {
        count(&format!("--no-background --backface-type=hidden --camera-direction={direction}"), [0; 4])
    });
    assert!(hidden.contains(&all) && hidden.iter().any(|count| *count < all), "{hidden:?}");
    for flags in
        ["--threads=1", NARROW, "--edges=false", "--samples=3", "--style=surface", "--camera-index=-1"]
    {
        assert!(stream(flags) == plain, "`{flags}` is the default");
    }
    assert!(stream("--edges --line-width=5") != stream("--edges"), "width of edges");
    let soft = [
        "",
        " --light-radius=0.5",
        " --light-radius=0.5 --shadow-rays=3",
        " --light-radius=0.5 --shadow-sampling=shared",
    ];
    let soft = soft.map(|flags| stream(&format!("--shadows=rays{flags}")));
    assert!(soft.iter().enumerate().all(|(at, one)| !soft[..at].contains(one)), "soft shadows");
}

#[test]
fn a_preset_is_some_settings_at_once() {
    let folder = Folder::new();
    let drawn = |flags: &str| {
        folder.said(&format!("corner.obj --output o.png --resolution 60,40 {flags}"), 0);
        image(&folder.path("o.png"))
    };
    assert!(drawn("--preset=draft") == drawn("--anti-aliasing=none"), "one sample");
    assert!(drawn("--preset=standard") == drawn("--samples=2"), "2×2");
    assert!(drawn("--preset=standard --samples=3") == drawn(""), "what is said for itself wins");
    assert!(drawn("--preset=reference") != drawn("--samples=4"), "sixteen times as many");
}

#[test]
fn a_time_budget_says_what_it_chose_and_what_that_gives_up() {
    let folder = Folder::new();
    // The longest and the shortest that there is: on any machine an image of this size
    // fits into the one, and none into the other.
    for (time, quality, gave_up) in
        [("3600s", "4×4 samples of 16,", "gave up nothing"), ("0.001ms", "1 sample,", "; gave up ")]
    {
        let flags = format!("--output o.png --capture o.trigon --resolution 60,40 --time-budget={time}");
        let said = folder.said(&format!("corner.obj {flags}"), 0);
        let choice = said.lines().next().expect("a line");
        assert!(choice.contains(quality) && choice.contains(gave_up), "{choice}");
        assert!(choice.contains("; took ") && choice.contains("RMSE"), "time and error: {choice}");
        folder.said("--replay o.trigon", 0);
    }
    let said = folder.said("--output o.png --time-budget=16", 2);
    assert!(said.contains("16ms"), "a unit is missing: {said}");
}
