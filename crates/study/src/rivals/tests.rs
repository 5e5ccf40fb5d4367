//! The exact image is exact, and trigon's images are as near to it as they should be.

use super::*;
use crate::workloads::{Canvas, Grid, Scene, Shading, Workload};
use trigon_math::DVec3;
use trigon_raster::Rasterizer;

/// A 64th of the workload's pixels.
fn small(workload: Workload) -> Scene {
    let mut scene = workload.scene();
    scene.size /= 8;
    scene
}

fn drawn(scene: &Scene) -> Vec<[u8; 4]> {
    let mut canvas = Canvas::with_own_pixels(Rasterizer::default(), scene).unwrap();
    canvas.draw(scene);
    canvas.pixels().to_vec()
}

fn in_bytes(color: DVec3) -> [u8; 4] {
    let [r, g, b] = (color * 255.0).round().to_array().map(|channel| channel as u8);
    [r, g, b, 255]
}

/// Errors of the exact image itself are those of rounding: between a half either way every error is as likely.
#[test]
fn the_exact_image_is_off_by_its_rounding() {
    let exact = Exact::new(&small(Workload::KnotPhong));
    let centres: Vec<[u8; 4]> = exact.pixels.iter().map(|pixel| in_bytes(pixel.color)).collect();
    let errors = Errors::new(&exact, &centres, true, false).centres.unwrap();
    assert_eq!(errors.wrong_at_outlines, 0.0, "nothing is on the wrong side");
    assert!(errors.worst_within <= 0.5, "{errors:?}");
    assert!((errors.within - (1.0_f64 / 12.0).sqrt()).abs() < 0.01, "{errors:?}");
    let means: Vec<[u8; 4]> = exact.pixels.iter().map(|pixel| in_bytes(pixel.mean)).collect();
    assert!(Errors::new(&exact, &means, false, false).image < 0.3, "what is best");
}

/// What the workloads show, by trigon, with one sample a pixel: 8 of 1000 pixels at outlines are more than the grid of 1/256 pixel can
/// take there, and light comes within what f32 and a byte round.
#[test]
fn trigon_is_near() {
    let mut torus = Scene::torus(Grid { along: 100, around: 50 });
    torus.size /= 8;
    for (name, scene, within) in [
        ("a torus", torus, 0.295),
        ("a knot", small(Workload::KnotPhong), 0.295),
        ("a textured knot", small(Workload::KnotTextured), 0.6),
        ("cubes", small(Workload::Cubes), 1e-9),
    ] {
        let is_flat = matches!(scene.shading, Shading::Flat);
        let errors = Errors::new(&Exact::new(&scene), &drawn(&scene), true, is_flat);
        let centres = errors.centres.unwrap();
        assert!(centres.wrong_at_outlines < 8.0, "{name}: {centres:?}");
        assert!(centres.within < within, "{name}: {centres:?}");
        assert_eq!(centres.wrong_within, 0.0, "{name}: no hole, and no depth is wrong");
    }
}

/// An image that is moved by a pixel is wrong at its outlines, and more of it than that.
#[test]
fn an_image_that_is_moved_is_far() {
    let scene = small(Workload::Cubes);
    let (exact, mut image) = (Exact::new(&scene), drawn(&scene));
    let before = Errors::new(&exact, &image, true, true);
    image.rotate_right(1);
    let after = Errors::new(&exact, &image, true, true);
    assert!(after.image > 1.2 * before.image, "{before:?}, {after:?}");
    let wrong = [before, after].map(|errors| errors.centres.unwrap().wrong_at_outlines);
    assert!(wrong[1] > 20.0 * wrong[0].max(1.0), "{wrong:?}");
}

#[test]
fn more_samples_come_nearer() {
    use trigon_scene::quality::Preset;
    let scene = small(Workload::KnotPhong);
    let exact = Exact::new(&scene);
    let error = |preset: Preset| {
        let image = drawn(&scene.clone().at_quality(preset.quality()));
        Errors::new(&exact, &image, false, false).image
    };
    let errors = Preset::ALL.map(error);
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
}

/// The published errors are complete, and trigon's times where there are any.
#[test]
fn every_renderer_has_its_rows() {
    let measured = measured();
    let of = |renderer: &str| measured.iter().filter(|one| one.renderer == renderer).count();
    for renderer in ["llvmpipe-debian", "llvmpipe-new", "lavapipe-new", "swiftshader", "exact-means"] {
        assert_eq!(of(renderer), 5, "{renderer}: W2 to W6");
    }
    for renderer in ["euc-0.5.3", "retrofire-0.4.0", "trigon-draft", "trigon-reference", "exact-centres"] {
        assert_eq!(of(renderer), 4, "{renderer}: no multisampling");
    }
    for one in timed() {
        // At every level trigon draws the same bytes.
        let renderer = one.renderer.trim_end_matches("-avx2");
        let has_errors = measured
            .iter()
            .any(|other| (other.renderer.as_str(), &other.workload) == (renderer, &one.workload));
        assert!(has_errors && one.quarters.is_sorted(), "{one:?}");
    }
    for line in measured.iter().map(Measured::line) {
        assert!(include_str!("../../rivals/errors.csv").contains(&line), "written as it is read: {line}");
    }
}
