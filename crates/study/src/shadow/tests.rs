//! What the report claims of shadows.

use super::*;
use trigon_scene::Shadows;

fn rmse(shadow: Shadow) -> f64 {
    error(&draw(256, &*shadow.ready()), &exact(256)).rmse()
}

#[test]
fn larger_maps_and_filters_bring_edges_nearer() {
    let sizes = [64, 256, 1024];
    let nearest = sizes.map(|side| rmse(Shadow::Map(side, MapFilter::Nearest)));
    let filtered = sizes.map(|side| rmse(Shadow::Map(side, MapFilter::Linear)));
    assert!(nearest.is_sorted_by(|more, less| less < more), "{nearest:?}");
    assert!(filtered.is_sorted_by(|more, less| less < more), "{filtered:?}");
    assert!(filtered[0] < nearest[0], "coarse maps gain by filtering: {nearest:?}, {filtered:?}");
}

#[test]
fn rays_are_right_up_to_rounding() {
    let (drawn, right) = (draw(256, &*Shadow::Rays.ready()), exact(256));
    let wrong = right.pixels().filter(|(pixel, light)| drawn[*pixel] != **light).count();
    // Corners round to f32, by 1e-7 of a metre: a pixel is 0.016 metres wide, and the edge some
    // 850 pixels long.
    assert!(wrong <= 1, "{wrong} pixels");
}

/// The closed form: a ball's shadow is an ellipse.
#[test]
fn the_shadow_is_nearly_an_ellipse() {
    let shaded = exact(512).values().iter().filter(|&&light| light == 0.0).count() as f64;
    // A disc of one metre's radius, spread by 1 / cos of the light's angle; 128 pixels to
    // the metre. The outline of the triangles is inside by up to 1 - cos of half an edge's angle,
    // 0.07 of a radian: 0.06 % of the radius.
    let expected = std::f64::consts::PI * 7.0 / 6.0 * 128.0 * 128.0;
    assert!((0.997..1.001).contains(&(shaded / expected)), "{shaded} of {expected} pixels");
}

#[test]
fn the_engines_rays_are_those_of_the_study() {
    let light = |shadows: Shadows| {
        let mut drawer = ShadowDrawer::new(shadows, 256);
        drawer.draw();
        drawer.light()
    };
    let right = exact(256);
    assert!(light(Shadows::Off).values().iter().all(|&light| light == 1.0), "without shadows all is lit");
    let rays = light(Shadows::Rays);
    let wrong = right.pixels().filter(|(pixel, light)| rays[*pixel] != **light).count();
    // As above; and pixels lie where the camera's matrix puts them, rounded to f32.
    assert!(wrong <= 3, "{wrong} pixels");
    let [coarse, fine] =
        [64, 1024].map(|resolution| error(&light(Shadows::Maps { resolution }), &right).rmse());
    assert!(fine < coarse && fine > 0.0, "maps of 1024 and 64 texels: {fine}, {coarse}");
}
