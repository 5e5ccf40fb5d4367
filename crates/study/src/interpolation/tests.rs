//! What the report claims of interpolation.

use super::*;

#[test]
fn every_division_brings_texels_nearer() {
    let wall = Wall::new(320);
    let [affine, every16, perspective, engine] = Interpolation::ALL.map(|way| way.errors(&wall));
    assert!(affine.worst > 100.0, "affine is metres away: {affine:?}");
    assert!(every16.worst < affine.worst / 4.0 && every16.worst > 1.0, "{every16:?}");
    // Coordinates of up to 1536 texels in f32, three roundings: 3 · 2^-24 · 1536, on two
    // axes.
    assert!(perspective.worst < 1e-3, "{perspective:?}");
    // The engine's weights round likewise, and sum three terms.
    assert!(engine.worst < 4e-3, "{engine:?}");
}

#[test]
fn all_cover_the_same_pixels() {
    let wall = Wall::new(160);
    let covered = Interpolation::ALL.map(|way| way.draw(&wall).map(Option::is_some));
    for (way, image) in Interpolation::ALL.iter().zip(&covered) {
        assert!(*image == covered[0], "{way:?} covers what the others do");
    }
}

#[test]
fn the_middle_of_the_wall_is_where_it_should_be() {
    let wall = Wall::new(320);
    // At the height of the eye, two metres away: 304 - 160 / 2 pixels from the left. The
    // centre of a pixel is half of one further right and down.
    let [u, v] = wall.texel([224, 120]).unwrap();
    let distance = 160.0 / 79.5;
    let expected = [distance * 256.0, -0.5 / 160.0 * distance * 256.0];
    // Corners are moved by up to 1/512 pixel: 0.11 texels at 6 metres, 0.013 here.
    assert!(
        (u - expected[0]).abs() < 0.1 && (v - expected[1]).abs() < 0.1,
        "{u}, {v} instead of {expected:?}"
    );
}
