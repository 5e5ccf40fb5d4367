//! Hard case 16: every combination of half-spaces that a triangle can cross.

use std::collections::BTreeSet;

use trigon_math::{Outcode, Vec4};

use super::check;
use super::input::Planes;

/// One coordinate for each side of a pair of planes that face each other: `low`
/// is outside the first, `high` outside the second.
fn positions(w: f32) -> impl Iterator<Item = Vec4> {
    // Off the centre by different amounts, so that few cuts coincide.
    let sides = [-2.5, 0.25, 3.0_f32];
    let depths = [-1.5, 0.5, 2.0_f32];
    let steps = move |z: f32| sides.map(|x| sides.map(|y| Vec4::new(x, y * 1.125, z, w)));
    depths.into_iter().flat_map(move |z| steps(z).into_iter().flatten())
}

/// The six bits of near, far, left, right, bottom and top.
fn six(code: Outcode) -> u8 {
    code.bits() >> 1
}

/// All triangles with corners in the 27 cells before the eye and behind it: the
/// corners' codes unite to each of the 2⁶ sets of planes.
#[test]
fn all_64_combinations_of_planes_are_visited() {
    let planes = Planes::VIEW;
    let volume = planes.volume();
    let corners: Vec<Vec4> = positions(1.0).chain(positions(-1.25)).collect();
    let codes: Vec<Outcode> = corners.iter().map(|&corner| volume.outcode(corner)).collect();
    let (mut united, mut crossed) = (BTreeSet::new(), BTreeSet::new());
    let (mut not_empty, mut most) = (0, 0);
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate() {
            for (k, c) in corners.iter().enumerate() {
                let polygon = check::clip([*a, *b, *c], &planes);
                let any = codes[i] | codes[j] | codes[k];
                let all = codes[i] & codes[j] & codes[k];
                united.insert(six(any));
                if !polygon.is_empty() {
                    assert_eq!(all, Outcode::INSIDE, "all corners are outside of one plane");
                    crossed.insert(six(any));
                    not_empty += 1;
                    most = most.max(polygon.vertices().len());
                }
            }
        }
    }
    assert_eq!(united.len(), 64, "each set of planes");
    assert_eq!(crossed.len(), 64, "each leaves something of some triangle");
    assert!(not_empty > 10_000, "only {not_empty} triangles are left");
    assert!((7..=9).contains(&most), "six planes leave up to 9 vertices, not {most}");
}
