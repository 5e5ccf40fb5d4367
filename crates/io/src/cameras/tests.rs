//! Views against the formulas that their formats define, in f64.

use std::fs;

use proptest::prelude::*;
use trigon_camera::Projector;
use trigon_math::{DMat3, DQuat, DVec2, DVec3};

use super::*;

const USUAL: Viewport = Viewport { width: 400, height: 300 };

fn read_json(text: &str) -> Result<CameraFile, LoadError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cameras.json");
    fs::write(&path, text).expect("written");
    load_cameras(&path, USUAL, &Limits::default())
}

fn read_colmap(cameras: &str, images: &str) -> Result<CameraFile, LoadError> {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cameras.txt"), cameras).expect("written");
    fs::write(folder.path().join("images.txt"), images).expect("written");
    load_cameras(folder.path(), USUAL, &Limits::default())
}

/// A camera as computer vision has it, and points before it.
#[derive(Clone, Debug)]
struct Calibrated {
    /// From the world to the camera, whose Z is forward and whose Y is down.
    rotation: DMat3,
    translation: DVec3,
    focal: DVec2,
    center: DVec2,
    points: Vec<DVec3>,
}

impl Calibrated {
    /// Where `projectPoints` of OpenCV puts a point.
    fn pixel(&self, point: DVec3) -> DVec2 {
        let at = self.rotation * point + self.translation;
        self.focal * at.truncate() / at.z + self.center
    }

    fn k(&self) -> String {
        let (f, c) = (self.focal, self.center);
        format!("[[{}, 0, {}], [0, {}, {}], [0, 0, 1]]", f.x, c.x, f.y, c.y)
    }

    /// By rows. `signs` are those of the axes of another convention.
    fn to_camera(&self, signs: DVec3) -> String {
        let (r, t) = (self.rotation.transpose(), self.translation * signs);
        let row = |column: DVec3, sign: f64, t: f64| {
            format!("[{}, {}, {}, {t}]", column.x * sign, column.y * sign, column.z * sign)
        };
        let [x, y, z] = [(r.x_axis, signs.x, t.x), (r.y_axis, signs.y, t.y), (r.z_axis, signs.z, t.z)]
            .map(|(axis, sign, t)| row(axis, sign, t));
        format!("[{x}, {y}, {z}, [0, 0, 0, 1]]")
    }

    fn to_world(&self, signs: DVec3) -> String {
        let (r, eye) = (self.rotation, -(self.rotation.transpose() * self.translation));
        // Row i of the transpose is column i.
        let row = |axis: DVec3, eye: f64| {
            let axis = axis * signs;
            format!("[{}, {}, {}, {eye}]", axis.x, axis.y, axis.z)
        };
        format!(
            "[{}, {}, {}, [0, 0, 0, 1]]",
            row(r.x_axis, eye.x),
            row(r.y_axis, eye.y),
            row(r.z_axis, eye.z)
        )
    }
}

/// Axes of OpenGL's convention seen from OpenCV's.
const OPENGL: DVec3 = DVec3::new(1.0, -1.0, -1.0);

fn calibrated() -> impl Strategy<Value = Calibrated> {
    let unit = || prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from_array);
    let turn = prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("a rotation", |q| DQuat::from_array(*q).length() > 0.1);
    let points = prop::collection::vec((unit(), 0.5..20.0_f64), 1..8);
    let lens = (prop::array::uniform2(100.0..2000.0_f64), prop::array::uniform2(-50.0..600.0_f64));
    (turn, unit(), lens, points).prop_map(|(turn, away, (focal, center), points)| {
        let rotation = DMat3::from_quat(DQuat::from_array(turn).normalize());
        let translation = away * 100.0;
        // Before the camera, then where in the world that is.
        let at = |(aside, depth): (DVec3, f64)| DVec3::new(aside.x * depth, aside.y * depth, depth);
        let points =
            points.into_iter().map(|point| rotation.transpose() * (at(point) - translation)).collect();
        let (focal, center) = (DVec2::from_array(focal), DVec2::from_array(center));
        Calibrated { rotation, translation, focal, center, points }
    })
}

/// Each point lands on its pixel; `offset` is from the file's pixels to ours, whose first has its centre at 0.5.
fn check(view: &CameraView, case: &Calibrated, offset: f64) -> Result<(), TestCaseError> {
    let projector = Projector::new(&view.camera, view.image);
    for &point in &case.points {
        let screen = projector.to_screen(point).expect("before the eye") - DVec2::splat(offset);
        let error = screen.distance(case.pixel(point));
        // Coordinates of 100 m over 0.5 m, times 2000 pixels, with some roundings of 2⁻⁵³.
        prop_assert!(error < 1e-8, "{} instead of {}", screen, case.pixel(point));
    }
    Ok(())
}

proptest! {
    #[test]
    fn points_land_where_opencv_projects_them(case in calibrated()) {
        let k = case.k();
        for (members, offset) in [
            (format!(r#""convention": "opencv", "world_to_camera": {}"#, case.to_camera(DVec3::ONE)), 0.5),
            (format!(r#""convention": "opencv", "pose": {}"#, case.to_world(DVec3::ONE)), 0.5),
            (format!(r#""convention": "opencv", "pixel_centers": "halves", "pose": {}"#, case.to_world(DVec3::ONE)), 0.0),
            (format!(r#""world_to_camera": {}"#, case.to_camera(OPENGL)), 0.0),
            (format!(r#""convention": "opengl", "pixel_centers": "integers", "pose": {}"#, case.to_world(OPENGL)), 0.5),
        ] {
            let text = format!(r#"{{"cameras": [{{"name": "a", "width": 640, "height": 480, "K": {k}, {members}}}]}}"#);
            let file = read_json(&text).map_err(|error| TestCaseError::fail(error.to_string()))?;
            prop_assert_eq!(file.warnings, []);
            let view = &file.views[0];
            prop_assert_eq!(view.image, Viewport { width: 640, height: 480 });
            prop_assert!(view.has_own_size && !view.has_clip_planes && view.name == "a", "{:?}", view);
            check(view, &case, offset)?;
        }
    }

    #[test]
    fn frames_of_nerf_are_what_their_photographs_show(case in calibrated()) {
        let (f, c, pose) = (case.focal, case.center, case.to_world(OPENGL));
        let text = format!(
            r#"{{"fl_x": {}, "fl_y": {}, "cx": {}, "cy": {}, "w": 640.0, "h": 480, "k1": 0.0,
            "frames": [{{"file_path": "images/1.png", "transform_matrix": {pose}}}]}}"#, f.x, f.y, c.x, c.y);
        let file = read_json(&text).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(file.warnings, []);
        check(&file.views[0], &case, 0.0)?;
    }

    #[test]
    fn images_of_colmap_are_what_their_photographs_show(case in calibrated()) {
        let (f, c, t) = (case.focal, case.center, case.translation);
        let q = DQuat::from_mat3(&case.rotation);
        let cameras = format!("# Camera list\n\n7 PINHOLE 640 480 {} {} {} {}\n", f.x, f.y, c.x, c.y);
        let image = |id: u32| format!("{id} {} {} {} {} {} {} {} 7 a b.png", q.w, q.x, q.y, q.z, t.x, t.y, t.z);
        let images = format!("# Image list\n{}\n1 2 -1 3 4 5\n{}\n\n# more\n{}\n", image(1), image(2), image(3));
        let file = read_colmap(&cameras, &images).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(file.views.len(), 3, "one has points, one has none, one has no line for them");
        prop_assert_eq!(&file.views[2].name, "a b.png");
        check(&file.views[2], &case, 0.0)?;
    }

    /// Whatever a file contains, it is a camera file or an error of one line.
    #[test]
    fn damaged_files_are_refused_or_read(cut in 0..600_usize, with in "[-0-9\\[\\]{},:\"e. ]{0,6}", is_colmap in any::<bool>()) {
        const JSON: &str = r#"{"convention": "opencv", "K": [[500, 0, 320], [0, 500, 240], [0, 0, 1]], "width": 640, "height": 480,
            "cameras": [{"world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]},
            {"position": [0, 0, 5], "rotation": [0, 0, 0, 1], "vertical_fov": 40, "near": 0.1, "far": 20}]}"#;
        const COLMAP: &str = "1 OPENCV 640 480 500 500 320 240 0.1 0 0 0\n";
        let damaged = |text: &str| {
            let at = cut.min(text.len());
            format!("{}{with}{}", &text[..at], &text[(at + 1).min(text.len())..])
        };
        let read = if is_colmap {
            read_colmap(&damaged(COLMAP), &damaged("1 1 0 0 0 0 0 5 1 a.png\n\n"))
        } else {
            read_json(&damaged(JSON))
        };
        match read {
            Ok(file) => prop_assert!(file.views.iter().all(|view| view.camera.position.is_finite()), "{:?}", file),
            Err(error) => prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error),
        }
    }
}

const IDENTITY: &str = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]";

#[test]
fn lenses_without_a_matrix_have_angles_heights_and_frustums() {
    let text = format!(
        r#"{{"pose": {IDENTITY}, "cameras": [{{"vertical_fov": 90}}, {{"view_height": 2, "near": 1, "far": 9}},
        {{"frustum": [-1, 1, -0.5, 0.5], "near": 1}}]}}"#
    );
    let views = read_json(&text).expect("three cameras").views;
    let at = |view: usize, point: DVec3| {
        let CameraView { camera, image, .. } = views[view];
        Projector::new(&camera, image).to_screen(point).expect("before the eye")
    };
    // 90 degrees show as much above the middle as the point is away.
    let top = DVec2::new(200.0, 0.0);
    assert!(at(0, DVec3::new(0.0, 5.0, 0.0)).distance(top) < 1e-9, "90 degrees");
    assert!(at(1, DVec3::new(0.0, 1.0, 0.0)).distance(top) < 1e-9, "2 m high");
    assert!(at(2, DVec3::new(0.0, 0.5, 4.0)).distance(top) < 1e-9, "half a metre above at one metre");
    assert_eq!(
        views.iter().map(|view| view.has_clip_planes).collect::<Vec<_>>(),
        [false, true, true],
        "planes"
    );
    assert!(views.iter().all(|view| view.image == USUAL && !view.has_own_size), "the size is the caller's");
}

/// A lens that all cameras share won over a camera's own.
#[test]
fn what_a_camera_says_itself_counts_before_what_is_said_for_all() {
    let lens = r#""K": [[100, 0, 200], [0, 100, 150], [0, 0, 1]]"#;
    let own = r#""position": [0, 0, 9], "rotation": [0, 0, 0, 1]"#;
    let text = format!(
        r#"{{"vertical_fov": 90, "pose": {IDENTITY}, "cameras": [{{}}, {{{lens}}}, {{{own}}}, {{"pose": null}}]}}"#
    );
    let views = read_json(&text).expect("four cameras").views;
    let focal = |view: &CameraView| {
        let k = view.camera.projection.intrinsics(USUAL, trigon_camera::PixelCenters::AtHalves);
        k.expect("a perspective").focal.y
    };
    for (view, expected, z) in [(0, 150.0, 5.0), (1, 100.0, 5.0), (2, 150.0, 9.0), (3, 150.0, 5.0)] {
        let (found, position) = (focal(&views[view]), views[view].camera.position);
        assert!((found - expected).abs() < 1e-9, "camera {view}: a focal length of {found}");
        assert_eq!(position, DVec3::new(0.0, 0.0, z), "camera {view}");
    }
}

#[test]
fn an_angle_across_is_for_the_size_that_the_image_gets() {
    let text = format!(
        r#"{{"camera_angle_x": 1.5707963267948966, "frames": [{{"file_path": "./train/r_0", "transform_matrix": {IDENTITY}}}]}}"#
    );
    let file = read_json(&text).expect("a frame");
    let screen = Projector::new(&file.views[0].camera, USUAL).to_screen(DVec3::new(5.0, 0.0, 0.0));
    let error = screen.expect("before the eye").distance(DVec2::new(400.0, 150.0));
    assert!(error < 1e-9, "90 degrees across: off by {error}");
    assert_eq!(file.views[0].name, "./train/r_0", "the name of the photograph");
}

#[test]
fn distortion_and_unknown_members_are_told_of() {
    let text = format!(r#"{{"cameras": [{{"pose": {IDENTITY}, "vertical_fov": 40, "fovy": 3}}]}}"#);
    let warnings = read_json(&text).expect("a camera").warnings;
    assert!(warnings.len() == 1 && warnings[0].to_string().contains("`fovy`"), "{warnings:?}");
    let text = format!(r#"{{"fl_x": 500, "k1": 0.1, "frames": [{{"transform_matrix": {IDENTITY}}}]}}"#);
    let warnings = read_json(&text).expect("a frame").warnings;
    assert!(warnings.len() == 1 && warnings[0].what.contains("distortion"), "{warnings:?}");
    let file = read_colmap("1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n", "1 1 0 0 0 0 0 5 1 a.png\n")
        .expect("an image");
    assert!(file.warnings.len() == 1 && file.warnings[0].what.contains("distortion"), "{:?}", file.warnings);
}

#[test]
fn what_is_no_camera_is_refused_with_its_number() {
    let mirrored = IDENTITY.replacen('1', "-1", 1);
    let scaled = IDENTITY.replacen('1', "2", 1);
    let transposed = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 5, 1]]";
    for (camera, word) in [
        (format!(r#"{{"pose": {IDENTITY}}}"#), "vertical_fov"),
        (r#"{"vertical_fov": 40}"#.to_owned(), "world_to_camera"),
        (format!(r#"{{"pose": {mirrored}, "vertical_fov": 40}}"#), "mirror"),
        (format!(r#"{{"pose": {scaled}, "vertical_fov": 40}}"#), "lengths"),
        (format!(r#"{{"pose": {transposed}, "vertical_fov": 40}}"#), "transpose"),
        (format!(r#"{{"pose": {IDENTITY}, "vertical_fov": 200}}"#), "field of view"),
        (format!(r#"{{"pose": {IDENTITY}, "vertical_fov": 40, "width": 10}}"#), "not both"),
        (format!(r#"{{"pose": {IDENTITY}, "vertical_fov": 40, "convention": "cv"}}"#), "opencv"),
        (format!(r#"{{"pose": {IDENTITY}, "K": [[5, 1, 2], [0, 5, 2], [0, 0, 1]]}}"#), "skew"),
        (format!(r#"{{"pose": {IDENTITY}, "K": [[-5, 0, 2], [0, 5, 2], [0, 0, 1]]}}"#), "fx"),
        (r#"{"position": [0, 0, 0], "rotation": [0, 0, 0, 2], "vertical_fov": 40}"#.to_owned(), "length 2"),
        ("3".to_owned(), "object"),
    ] {
        let good = format!(r#"{{"pose": {IDENTITY}, "vertical_fov": 40}}"#);
        let error =
            read_json(&format!(r#"{{"cameras": [{good}, {camera}]}}"#)).expect_err("refused").to_string();
        assert!(error.contains("cameras.json, camera 1: ") && error.contains(word), "{camera}: {error}");
    }
    for (text, word) in [
        ("", "JSON"),
        ("[]", "COLMAP"),
        (r#"{"cameras": []}"#, "no camera"),
        (r#"{"frames": [{}]}"#, "transform_matrix"),
    ] {
        let error = read_json(text).expect_err("refused").to_string();
        assert!(error.contains(word), "{text}: {error}");
    }
    for (cameras, images, word) in [
        ("1 THIN_PRISM_FISHEYE 640 480 5 5 3 2 0 0 0 0 0 0 0 0\n", "", "THIN_PRISM_FISHEYE"),
        ("1 OPENCV_FISHEYE 640 480 5 5 3 2 0 0\n", "", "8 parameters"),
        ("1 PINHOLE 640 480 5 5 3\n", "", "parameters"),
        (
            "1 PINHOLE 640 480 5 5 3 2\n",
            "1 1 0 0 0 0 0 5 2 a.png\n",
            "images.txt, line 1: there is no camera \"2\"",
        ),
        ("1 PINHOLE 640 480 5 5 3 2\n", "# a\n1 1 0 0\n", "images.txt, line 2"),
        ("1 PINHOLE 640 480 5 5 3 2\n", "", "no camera"),
    ] {
        let error = read_colmap(cameras, images).expect_err("refused").to_string();
        assert!(error.contains(word), "{cameras}{images}: {error}");
    }
}

#[test]
fn a_binary_model_says_how_to_convert_it() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cameras.bin"), [1, 2, 3]).expect("written");
    let error = load_cameras(folder.path(), USUAL, &Limits::default()).expect_err("binary").to_string();
    assert!(error.contains("model_converter"), "{error}");
}

/// `cv2.fisheye` (OpenCV's documentation, "Fisheye camera model"), with the centre of the first pixel at (0, 0).
#[expect(clippy::disallowed_methods, reason = "the platform's functions are the oracle here")]
fn fisheye_pixel(point: DVec3, [k1, k2, k3, k4]: [f64; 4]) -> DVec2 {
    let r = point.truncate().length() / point.z;
    let theta = r.atan();
    let theta_d =
        theta * (1.0 + k1 * theta.powi(2) + k2 * theta.powi(4) + k3 * theta.powi(6) + k4 * theta.powi(8));
    let side = point.truncate().normalize();
    DVec2::new(210.0 * theta_d * side.x + 200.0, 220.0 * theta_d * side.y + 150.0)
}

#[test]
fn fisheye_lenses_are_read_from_every_format() {
    let nerf = |model: &str, lens: &str| {
        let flip = "[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]";
        let text = format!(
            r#"{{"camera_model": "{model}", "w": 400, "h": 300, "fl_x": 210, "fl_y": 220, "cx": 200.5, "cy": 150.5, {lens},
                "frames": [{{"transform_matrix": {flip}}}]}}"#
        );
        read_json(&text).expect("a camera")
    };
    let json = |members: &str| {
        let pose = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
        let text = format!(
            r#"{{"cameras": [{{"convention": "opencv", "width": 400, "height": 300, "pose": {pose},
                "K": [[210, 0, 200], [0, 220, 150], [0, 0, 1]], {members}}}]}}"#
        );
        read_json(&text).expect("a camera")
    };
    let colmap =
        |lens: &str| read_colmap(&format!("1 {lens}\n"), "1 1 0 0 0 0 0 0 1 a.png\n\n").expect("a camera");
    let all = [0.02, -0.01, 0.003, -0.0004];
    let [some, one, none] = [[0.02, -0.01, 0.0, 0.0], [0.02, 0.0, 0.0, 0.0], [0.0; 4]];
    for (read, distortion, focal) in [
        (nerf("OPENCV_FISHEYE", r#""k1": 0.02, "k2": -0.01, "k3": 0.003, "k4": -0.0004"#), all, 220.0),
        (nerf("OPENCV_FISHEYE", r#""k1": 0.02"#), one, 220.0),
        (json(r#""fisheye": [0.02, -0.01, 0.003, -0.0004]"#), all, 220.0),
        (json(r#""fisheye": [0, 0, 0, 0], "fov": 185"#), none, 220.0),
        (colmap("OPENCV_FISHEYE 400 300 210 220 200.5 150.5 0.02 -0.01 0.003 -0.0004"), all, 220.0),
        (colmap("RADIAL_FISHEYE 400 300 210 200.5 150.5 0.02 -0.01"), some, 210.0),
        (colmap("SIMPLE_RADIAL_FISHEYE 400 300 210 200.5 150.5 0.02"), one, 210.0),
    ] {
        assert_eq!(read.warnings, [], "its distortion is drawn");
        let camera = read.views[0].fisheye().expect("a fisheye lens");
        for point in [DVec3::new(0.3, -0.2, 1.0), DVec3::new(-2.0, 1.0, 0.5), DVec3::new(0.01, 0.02, 4.0)] {
            let mut expected = fisheye_pixel(point, distortion) + 0.5;
            expected.y = 150.5 + (expected.y - 150.5) * focal / 220.0;
            let pixel = camera.project(point, read.views[0].image).expect("within the lens");
            assert!(pixel.distance(expected) < 1e-9, "{distortion:?}: {pixel}, not {expected}");
        }
    }
    let ended = json(r#""fisheye": [0, 0, 0, 0], "fov": 185"#).views[0].fisheye().expect("a fisheye lens");
    assert!((ended.lens.greatest_angle() - 92.5_f64.to_radians()).abs() < 1e-15, "half of it");
    let text =
        r#"{"camera_model": "OPENCV_FISHEYE", "camera_angle_x": 2, "frames": [{"transform_matrix": []}]}"#;
    assert!(read_json(text).is_err(), "an angle does not tell the focal length of a fisheye lens");
}
