//! What the report claims of interpolation.

use super::*;

#[test]
fn every_division_brings_texels_nearer() {
    let floor = Floor::new(320);
    let [affine, every16, perspective, engine] = Interpolation::ALL.map(|way| way.errors(&floor));
    assert!(affine.worst > 100.0, "affine is metres away: {affine:?}");
    assert!(every16.worst < affine.worst / 10.0, "{every16:?}");
    // Coordinates of up to 3072 texels in f32, three roundings: 3 · 2^-24 · 3072, on two
    // axes.
    assert!(perspective.worst < 1e-3, "{perspective:?}");
    // The engine's weights round likewise, and sum three terms.
    assert!(engine.worst < 4e-3, "{engine:?}");
}

#[test]
fn all_cover_the_same_pixels() {
    let floor = Floor::new(160);
    let covered = Interpolation::ALL.map(|way| way.draw(&floor).map(Option::is_some));
    for (way, picture) in Interpolation::ALL.iter().zip(&covered) {
        assert!(*picture == covered[0], "{way:?} covers what the others do");
    }
}

#[test]
fn the_middle_of_the_floor_is_where_it_should_be() {
    let floor = Floor::new(320);
    // Straight ahead, two metres away: 64 + 160 / 2 pixels down.
    let [u, v] = floor.texel([160, 143]).unwrap();
    let expected = [0.5 / 160.0 * 2.0 * 256.0, 160.0 / 79.5 * 256.0];
    // Corners are on the grid of 1/256 pixel: at 12 metres that is 0.9 metres / 256, and
    // less here.
    assert!(
        (u - expected[0]).abs() < 1.0 && (v - expected[1]).abs() < 1.0,
        "{u}, {v} instead of {expected:?}"
    );
}
