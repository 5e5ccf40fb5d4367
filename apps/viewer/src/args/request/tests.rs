//! What command lines ask for, and what they are refused for.

use clap::Parser;
use trigon_camera::UpAxis;
use trigon_math::DVec3;
use trigon_scene::mesh::primitives;
use trigon_scene::quality::{Preset, Quality};
use trigon_scene::{Material, MetalReflection, Outputs, Scene, ShadingModel, Shadows, render};

use super::*;

/// The request of a command line, or the message about it.
fn request(flags: &str) -> Result<Request, String> {
    let words = std::iter::once("trigon-viewer").chain(flags.split_whitespace());
    let raw = RawArgs::try_parse_from(words).map_err(|error| error.to_string())?;
    Request::new(raw)
}

fn refusal(flags: &str) -> String {
    request(flags).expect_err("refused")
}

#[test]
fn the_flags_are_consistent() {
    RawArgs::command().debug_assert();
}

#[test]
fn without_flags_there_is_a_window_with_the_built_in_scene() {
    let request = request("").expect("fine");
    assert_eq!(request.mode, Mode::Window, "a window");
    assert!(request.files.is_empty(), "no file");
    assert_eq!((request.settings.width, request.settings.height), (1000, 600), "F3D's size");
    assert_eq!(request.settings.samples_per_axis, 3, "smooth outlines");
    assert_eq!(request.framing.eye, Eye::Default, "the default view");
    assert_eq!(request.look, Look::default(), "as the file has it");
}

#[test]
fn values_that_begin_with_a_sign_need_no_equals_sign() {
    let request =
        request("a.obj --up -Z --camera-direction -1,0,0.5 --camera-azimuth-angle -30").expect("fine");
    assert_eq!(request.up, Some(UpAxis::new(DVec3::NEG_Z)), "an axis");
    assert_eq!(request.framing.eye, Eye::Direction(DVec3::new(-1.0, 0.0, 0.5)), "numbers");
    assert!((request.framing.azimuth.to_degrees() + 30.0).abs() < 1e-12, "an angle");
}

#[test]
fn switches_can_be_on_and_off_and_the_last_one_wins() {
    for (flags, expected) in [
        ("-e", Style::SurfaceWithEdges),
        ("--edges=on", Style::SurfaceWithEdges),
        ("--edges --edges=0", Style::Surface),
        ("--style=wireframe", Style::Wireframe),
        ("--style=hidden-line", Style::HiddenLine),
    ] {
        assert_eq!(request(flags).expect("fine").settings.style, expected, "{flags}");
    }
    // A switch does not swallow the file behind it.
    assert_eq!(request("-e model.obj").expect("fine").files, [PathBuf::from("model.obj")], "the file");
    assert_eq!(
        request("-a --verbose model.obj").expect("fine").files,
        [PathBuf::from("model.obj")],
        "the file"
    );
}

#[test]
fn many_frames_need_many_names_or_a_file_for_all() {
    assert!(refusal("--turntable=8 --output a.png").contains("{frame}"), "says how");
    assert!(refusal("--turntable=8").contains("--output"), "a window does not turn by itself");
    for output in ["a.gif", "a.apng", "a_{frame:3}.png"] {
        request(&format!("--turntable=8 --output {output}")).expect("a place for each");
    }
    assert!(refusal("--output a.gif --capture a.trigon").contains("--capture"), "one image");
}

#[test]
fn several_files_need_several_names_or_one_scene() {
    assert!(refusal("a.obj b.obj --output o.png").contains("{model}"), "says how");
    assert!(refusal("a.obj b.obj --output -").contains("--multi-file-mode=all"), "says how");
    request("a.obj b.obj --output {model}.png").expect("a name each");
    request("a.obj b.obj --output {n:3}.png").expect("a number each");
    request("a.obj b.obj --output o.png --multi-file-mode=all").expect("one scene");
    request("a.obj b.obj").expect("a window");
}

#[test]
fn a_camera_that_looks_nowhere_is_refused() {
    assert!(
        refusal("--camera-position 1,2,3 --camera-focal-point 1,2,3").contains("same point"),
        "explained"
    );
    assert!(refusal("--camera-position nan,0,0").contains("three numbers"), "explained");
    assert!(refusal("--camera-direction 0,0,0").contains("all zeros"), "explained");
    assert!(refusal("--camera-view-angle 180").contains("179"), "explained");
    assert!(refusal("--camera-index 0 --view=top").contains("cannot be used with"), "explained");
}

#[test]
fn standard_input_is_read_once() {
    request("- --output o.png").expect("an image of what comes");
    assert!(refusal("-").contains("--output"), "no window");
    assert!(refusal("- - --output {n}.png").contains("once"), "not twice");
}

#[test]
fn anti_aliasing_and_samples_agree() {
    for (flags, samples) in [
        ("-a", (3, 1)),
        ("--anti-aliasing=none", (1, 1)),
        ("--samples 4", (4, 1)),
        ("-a=none --samples=1", (1, 1)),
        ("-a=msaa", (1, 4)),
        ("-a=msaa --samples=16", (1, 16)),
    ] {
        let settings = request(flags).expect("fine").settings;
        assert_eq!((settings.samples_per_axis, settings.samples), samples, "{flags}");
    }
    assert!(refusal("--anti-aliasing=none --samples=2").contains("one sample"), "explained");
    assert!(refusal("--samples=5").contains("--anti-aliasing=msaa"), "explained");
    assert!(refusal("--anti-aliasing=msaa --samples=3").contains("1, 2, 4, 8 or 16"), "explained");
    assert!(refusal("--samples=17").contains("from 1 to 16"), "explained");
}

#[test]
fn a_preset_says_what_no_other_flag_says() {
    let quality = |flags: &str| Quality::of(&request(flags).expect("fine").settings);
    let high = quality("--preset=high --shadows -q");
    assert_eq!(high, Preset::High.quality(), "all of it");
    assert_eq!(quality("--preset high").shadows, Shadows::Off, "nothing that was not asked for");
    let changed = quality("--preset high --samples=2 --shadows=maps --shading=flat");
    assert_eq!((changed.samples_per_axis, changed.samples), (2, 1), "--samples wins");
    assert_eq!(changed.shadows, Shadows::Maps { resolution: 2048 }, "--shadows=maps wins");
    assert_eq!(changed.shading, ShadingModel::Flat, "--shading wins");
    let small = quality("--preset high --shadows --shadow-resolution=64").shadows;
    assert_eq!(small, Shadows::Maps { resolution: 64 }, "whoever names texels wants maps");
    let rays = quality("--preset=draft -q --ambient-occlusion-rays=5 --anti-aliasing=msaa");
    assert_eq!((rays.occlusion_rays, rays.samples), (5, 4), "rays and samples win");
    assert_eq!(quality("--shadows").shadows, Shadows::Maps { resolution: 2048 }, "without a preset");
    assert!(refusal("--preset=best").contains("draft, standard, default, high or reference"), "explained");
}

#[test]
fn metals_mirror_the_studio_unless_told_otherwise() {
    let asked = |flags: &str| request(flags).expect("fine").settings.effects.metal_reflection;
    assert_eq!(asked(""), MetalReflection::Studio, "usually");
    assert_eq!(asked("--metal-reflection=ambient"), MetalReflection::Ambient, "as asked");
    assert!(refusal("--metal-reflection=room").contains("studio, ambient"), "explained");
}

#[test]
fn a_time_budget_is_for_images() {
    let limit = request("--output o.png --time-budget 16ms --samples=2").expect("fine").limit;
    let choice = limit.expect("asked for").budget().choose(&RenderSettings::new(64, 64));
    assert_eq!(choice.limit.as_millis(), 16, "as typed");
    assert_eq!(choice.chosen.quality.shaded_samples(), 4, "--samples is not changed");
    assert!(refusal("--time-budget 16ms").contains("--output"), "explained");
    assert!(refusal("--output o.png --time-budget 16").contains("16ms"), "explained");
    assert!(refusal("--output o.png --time-budget=9ms --preset=high").contains("cannot be used"), "one");
}

/// Dark edges on `--background-color=black` made an empty image.
#[test]
fn edges_can_be_seen_on_a_dark_background() {
    let edges = |flags: &str| request(flags).expect("fine").settings.edge_color;
    let usual = edges("--style=wireframe");
    assert!(usual.max_element() < 0.1, "dark on the grey gradient");
    for color in ["black", "navy", "#222"] {
        let color = edges(&format!("--style=hidden-line --background-color={color}"));
        assert!(color.min_element() > 0.5, "light, not {color}");
    }
    assert_eq!(edges("--edges --background-color=white"), usual, "dark on white");
    assert_eq!(edges("--edges --background-color=black --no-background"), usual, "no background");
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    for color in ["black", "navy", "white"] {
        let settings = request(&format!("--style=hidden-line --background-color={color} --resolution=60,40"));
        let settings = settings.expect("fine").settings;
        let frame = render(&scene, &scene.overview(settings.aspect()), &settings).expect("drawn");
        // The first pixel is background, which is what faces show, too; half of a line changes it by 67 levels or more.
        let edges = frame.color.chunks(4).filter(|pixel| pixel[1].abs_diff(frame.color[1]) > 60).count();
        // Nine edges of a dozen pixels or more.
        assert!((60..1200).contains(&edges), "{edges} pixels of edges on {color}");
    }
}

/// "unexpected argument '-1'" told nobody what was wrong.
#[test]
fn a_negative_number_is_named_as_the_mistake() {
    for flag in [
        "--light-intensity",
        "--opacity",
        "--line-width",
        "--camera-zoom-factor",
        "--camera-view-angle",
        "--samples",
        "--threads",
        "--roughness",
    ] {
        let message = refusal(&format!("{flag} -1"));
        assert!(message.contains("invalid value '-1'"), "{flag}: {message}");
    }
}

#[test]
fn flags_of_a_gpu_do_nothing_and_say_so() {
    let request = request("--rendering-backend egl --raytracing --raytracing-samples 4 --volume=true a.obj")
        .expect("fine");
    for (warning, flag) in request.ignored.iter().zip([
        "--rendering-backend",
        "--raytracing is",
        "--raytracing-samples",
        "--volume",
    ]) {
        assert!(warning.starts_with(flag) && warning.contains("is ignored: "), "{warning}");
    }
    assert_eq!(request.ignored.len(), 4, "one each");
    assert_eq!(request.files, [PathBuf::from("a.obj")], "the file");
}

#[test]
fn outputs_are_asked_for_and_have_a_place() {
    let outputs = |flags: &str| request(flags).expect("fine").settings.outputs;
    let asked = outputs("--output o.png --outputs depth,face-ids.png");
    assert_eq!(asked, Outputs { depth: true, ids: true, ..Outputs::default() }, "both, and colours");
    let light = Outputs { radiance: true, ..Outputs::default() };
    assert_eq!(outputs("--output o.exr"), light, "colours beyond white");
    assert!(refusal("--outputs depth").contains("--output"), "needs a name");
    assert!(refusal("--output - --outputs depth").contains("standard output"), "needs a name");
    for other in ["--no-render", "--explain", "--list-readers"] {
        let message = refusal(&format!("--output o.png --outputs depth {other}"));
        assert!(message.contains("none is drawn"), "{other}: {message}");
    }
    assert!(refusal("--output o.EXR --outputs depth.png").contains("--outputs=depth"), "explained");
    assert!(refusal("--output o.png --outputs dept").contains("triangle-ids"), "all names");
}

#[test]
fn a_typing_error_gets_a_proposal() {
    assert!(refusal("--resolutoin 10,10").contains("--resolution"), "did you mean");
    assert!(refusal("--output image.tiff").contains(".png"), "the remedy");
}
