//! The workloads are the ones that are documented.

use super::*;
use trigon_raster::Rasterizer;

/// Vertices, triangles and visible pixels. Pixels are those of Mesa's llvmpipe.
const EXPECTED: [(Workload, usize, usize, usize); 8] = [
    (Workload::Clear, 1, 1, 0),
    (Workload::FillPass, 256, 128, 1920 * 1080),
    (Workload::FillReject, 256, 128, 1920 * 1080),
    (Workload::Torus, 500_000, 1_000_000, 583_212),
    (Workload::KnotPhong, 35_751, 70_000, 586_330),
    (Workload::KnotTextured, 35_751, 70_000, 586_330),
    (Workload::Cubes, 240_000, 120_000, 501_484),
    (Workload::KnotMultisampled, 35_751, 70_000, 588_489),
];

#[test]
fn meshes_have_the_documented_sizes() {
    for (workload, vertices, triangles, _) in EXPECTED {
        let Mesh { triangles: indices, positions, .. } = workload.scene().mesh;
        let name = workload.name();
        assert_eq!((positions[0].len(), indices.len()), (vertices, triangles), "{name}: vertices, triangles");
        let last = indices.iter().flatten().max().copied();
        assert_eq!(
            last,
            Some(vertices as u32 - 1),
            "{name}: every index is in range, and the last vertex used"
        );
    }
}

#[test]
fn as_many_pixels_are_covered_as_by_another_renderer() {
    for (workload, .., expected) in EXPECTED {
        let scene = workload.scene();
        let mut pixels = vec![[0; 4]; scene.pixel_count()];
        Canvas::new(Rasterizer::default(), &scene, &mut pixels).unwrap().draw(&scene);
        let covered = pixels.iter().filter(|&&pixel| pixel != Scene::BACKGROUND).count();
        // The outlines: another order of operations in the vertex stage moves a
        // vertex to the next point of the sub-pixel grid now and then, and the
        // samples of a pixel need not lie where the other's do.
        let tolerance = expected / 1000;
        assert!(
            covered.abs_diff(expected) <= tolerance,
            "{}: {covered} pixels, not {expected}",
            workload.name()
        );
    }
}

#[test]
fn triangles_wind_counter_clockwise_seen_from_outside() {
    for scene in [Workload::Torus.scene(), Workload::KnotPhong.scene()] {
        let Mesh { positions, normals, triangles, .. } = &scene.mesh;
        let vector = |columns: &[Vec<f32>; 3], index: u32| {
            Vec3::from([0, 1, 2].map(|axis| columns[axis][index as usize]))
        };
        let outwards = |&&[a, b, c]: &&[u32; 3]| {
            let [p, q, r] = [a, b, c].map(|index| vector(positions, index));
            (q - p).cross(r - p).dot(vector(normals, a)) > 0.0
        };
        assert_eq!(
            triangles.iter().filter(outwards).count(),
            triangles.len(),
            "triangles that face outwards"
        );
    }
}

#[test]
fn layers_differ_in_their_order_only() {
    let [pass, reject] = [Workload::FillPass, Workload::FillReject].map(|workload| workload.scene().mesh);
    let mut depths = reject.positions[2].clone();
    assert!(depths.is_sorted_by(|a, b| a >= b), "the nearest layer comes first");
    depths.reverse();
    assert_eq!(pass.positions[2], depths, "and last where every layer passes");
}

#[test]
fn work_is_counted_in_pixels_or_triangles() {
    let work = Workload::ALL.map(|workload| workload.work(&workload.scene()));
    let layers = 64.0 * 1920.0 * 1080.0;
    assert_eq!(work, [1920.0 * 1080.0, layers, layers, 1e6, 7e4, 7e4, 1.2e5, 7e4], "of one frame");
}
