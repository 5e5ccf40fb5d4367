//! What the report claims of shadows.

use super::*;

fn rmse(shadow: Shadow) -> f64 {
    error(&draw(256, &*shadow.ready())).rmse()
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
fn rays_are_wrong_only_by_the_triangles_of_the_ball() {
    assert!(rmse(Shadow::Rays) < rmse(Shadow::Map(256, MapFilter::Nearest)), "{}", rmse(Shadow::Rays));
}

#[test]
fn the_shadow_is_an_ellipse() {
    let shaded = draw(512, &exact).values().iter().filter(|&&light| light == 0.0).count() as f64;
    // A disc of one metre's radius, spread by 1 / cos of the light's angle; 128 pixels to
    // the metre.
    let expected = std::f64::consts::PI * 7.0 / 6.0 * 128.0 * 128.0;
    assert!((shaded / expected - 1.0).abs() < 0.002, "{shaded} of {expected} pixels");
}
