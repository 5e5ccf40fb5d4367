//! What the report claims of texture filters.

use super::*;

#[test]
fn better_filters_are_nearer_to_what_a_pixel_sees() {
    let ground = Ground::new(192);
    let right = exact(&ground);
    let errors = TextureFilter::ALL.map(|filter| filter.error(&ground, &right).rmse());
    let [nearest, bilinear, trilinear, _, four, sixteen] = errors;
    assert!(nearest > bilinear && bilinear > trilinear, "{errors:?}");
    assert!(trilinear > four && four >= sixteen, "{errors:?}");
}

/// Where a pixel sees many squares, filters with mip levels see their mean.
#[test]
fn at_the_horizon_the_floor_is_grey() {
    let ground = Ground::new(192);
    let (found, right) = (TextureFilter::Trilinear.draw(&ground)[[96, 0]], exact(&ground)[[96, 0]]);
    // The mean of 230 and 20 is 125 of 255. A pixel sees three squares at least there.
    assert!(
        (found - 125.0 / 255.0).abs() < 0.02 && (right - 125.0 / 255.0).abs() < 0.2,
        "{found} and {right}"
    );
}

/// Near the eye a square is many pixels wide: the nearest texel is the right one but at borders.
#[test]
fn the_engine_looks_up_where_the_closed_form_does() {
    let ground = Ground::new(192);
    let (drawn, right) = (TextureFilter::Nearest.draw(&ground), exact(&ground));
    let inside =
        right.pixels().filter(|([_, y], light)| *y > 48 && [20.0, 230.0].contains(&(*light * 255.0).round()));
    let (mut count, mut wrong) = (0, 0);
    for (pixel, light) in inside {
        count += 1;
        wrong += usize::from((drawn[pixel] - light).abs() > 1e-3);
    }
    assert!(count > 1000 && wrong == 0, "{wrong} of {count} pixels inside of squares");
}

/// Without the texture the floor is its coordinates: the engine interpolates them as the closed form does.
#[test]
fn the_plain_floor_has_its_coordinates_as_colours() {
    let ground = Ground::new(96);
    let mut drawer = FloorDrawer::new(&ground);
    drawer.draw_plain();
    for ([x, y], found) in drawer.light().pixels() {
        let [right, _] = ground.coordinates([x as f64 + 0.5, y as f64 + 0.5]);
        assert!((found - right).abs() < 1e-3 * right.abs().max(1.0), "{x}, {y}: {found}, not {right}");
    }
}
