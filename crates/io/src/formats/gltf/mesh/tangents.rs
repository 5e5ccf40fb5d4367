//! Tangents for normal maps of meshes without their own.

use std::collections::BTreeMap;
use std::ops::Range;

use trigon_math::Vec4;
use trigon_mesh::Mesh;

/// Generates the tangents that materials need and the file does not have, each for the UV set of
/// its primitive's normal map: `lacking`, by parts. `corners` are those of each part; others are unchanged.
pub(super) fn complete(mesh: &mut Mesh, lacking: &[Option<u32>], corners: &[Range<usize>]) {
    let mut missing: BTreeMap<u32, Vec<Range<usize>>> = BTreeMap::new();
    for (set, corners) in lacking.iter().zip(corners) {
        if let Some(set) = *set {
            missing.entry(set).or_default().push(corners.clone());
        }
    }
    if missing.is_empty() {
        return;
    }
    let known = mesh.attributes().corner_tangents.clone();
    let mut tangents = known.unwrap_or_else(|| vec![Vec4::ZERO; mesh.corner_count()]);
    for (set, ranges) in missing {
        let Some(generated) = mesh.generate_tangents(set as usize) else { continue };
        for corners in ranges {
            tangents[corners.clone()].copy_from_slice(&generated[corners]);
        }
    }
    mesh.set_corner_tangents(tangents).expect("there is one a corner");
}
