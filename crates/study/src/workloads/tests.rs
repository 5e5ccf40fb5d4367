//! The workloads are the ones that are documented.

use super::*;
use trigon_math::elementary;
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

fn vector(columns: &[Vec<f32>; 3], index: usize) -> Vec3 {
    Vec3::from([0, 1, 2].map(|axis| columns[axis][index]))
}

/// Each cube has twelve triangles that face away from its middle, two of a colour to a side.
#[test]
fn cubes_are_closed_and_lie_apart() {
    let Mesh { positions, colors, triangles, .. } = &Workload::Cubes.scene().mesh;
    let mut cells = Vec::new();
    for (number, cube) in triangles.chunks(12).enumerate() {
        let corners = cube.iter().flatten().map(|&index| vector(positions, index as usize));
        let middle = corners.clone().sum::<Vec3>() / 36.0;
        for corner in corners {
            assert!(((corner - middle).abs() - Vec3::splat(0.3)).abs().max_element() < 1e-4, "{number}");
        }
        for (side, pair) in cube.chunks(2).enumerate() {
            let outwards = pair.iter().map(|indices| {
                let [a, b, c] = indices.map(|index| vector(positions, index as usize));
                // Twice the area is that of half a side of 0.6.
                let normal = (b - a).cross(c - a) / 0.36;
                assert!((normal.length() - 1.0).abs() < 1e-3 && normal.dot(a - middle) > 0.0, "{number}");
                normal
            });
            let outwards: Vec<Vec3> = outwards.collect();
            assert!(outwards[0].distance(outwards[1]) < 1e-3, "{number}: one side");
            let [first, second] = [colors[12 * number + 2 * side], colors[12 * number + 2 * side + 1]];
            assert_eq!((first, first[3]), (second, 255), "{number}: one colour");
        }
        let cell = middle + Vec3::new(12.0, 9.5, 9.5);
        assert!((cell - cell.round()).abs().max_element() < 1e-4, "{number} lies at {middle}");
        cells.push(cell.round().as_ivec3().to_array());
    }
    assert!(cells.windows(2).all(|pair| pair[0] != pair[1]), "they leap about");
    cells.sort_unstable();
    let expected = (0..25).flat_map(|x| (0..20).flat_map(move |y| (0..20).map(move |z| [x, y, z])));
    assert!(cells.into_iter().eq(expected), "each place once");
}

#[test]
fn a_torus_is_a_tube_around_a_circle() {
    let Mesh { positions, normals, .. } = Scene::torus(Grid { along: 30, around: 20 }).mesh;
    for index in 0..positions[0].len() {
        let (at, normal) = (vector(&positions, index), vector(&normals, index));
        let ring = Vec3::new(at.x, 0.0, at.z).normalize();
        assert!((at - ring).length() - 0.4 < 1e-5, "{at}");
        assert!((at - ring - 0.4 * normal).length() < 1e-5, "{normal} at {at}");
        // Step by step, backwards about the axis, upwards about the tube.
        let [along, around] = [index / 20, index % 20].map(|step| step as f64 * std::f64::consts::TAU);
        let (s, c) = elementary::sin_cos(-along / 30.0);
        let (up, out) = elementary::sin_cos(around / 20.0);
        let expected = Vec3::new((c * out) as f32, up as f32, (s * out) as f32);
        assert!(normal.distance(expected) < 1e-5, "{normal}, not {expected}");
    }
}

/// A (2, 3) torus knot: the centre of the tube turns twice about the axis and three times about a ring.
#[test]
fn a_knot_is_a_tube_around_its_line() {
    let Mesh { positions, normals, coordinates, .. } = &Workload::KnotPhong.scene().mesh;
    for index in (0..positions[0].len()).step_by(7) {
        let [along, around] = [index / 51, index % 51];
        let (at, normal) = (vector(positions, index), vector(normals, index));
        let t = along as f64 / 700.0 * std::f64::consts::TAU;
        let ((s2, c2), (s3, c3)) = (elementary::sin_cos(2.0 * t), elementary::sin_cos(3.0 * t));
        let radius = 1.0 + 0.5 * c3;
        let center = Vec3::new((radius * c2) as f32, (radius * s2) as f32, (0.5 * s3) as f32);
        assert!((at - 0.28 * normal).distance(center) < 1e-5, "vertex {index} at {at}");
        assert!((normal.length() - 1.0).abs() < 1e-5, "vertex {index}");
        let expected = [12.0 * along as f32 / 700.0, around as f32 / 50.0];
        assert!(
            (0..2).all(|axis| (coordinates[axis][index] - expected[axis]).abs() < 1e-5),
            "vertex {index}"
        );
    }
    // Around the tube normals turn by the same angle, and lie across the line.
    for ring in (0..700).step_by(35) {
        let normal = |around: usize| vector(normals, ring * 51 + around);
        let ahead = vector(positions, (ring + 1) * 51) - vector(positions, ring * 51);
        let cosine = elementary::cos_f32(std::f32::consts::TAU / 50.0);
        for around in 0..50 {
            assert!((normal(around).dot(normal(around + 1)) - cosine).abs() < 1e-4, "ring {ring}");
        }
        assert!(normal(0).dot(ahead.normalize()).abs() < 0.15, "ring {ring}");
    }
}

#[test]
fn layers_fill_the_screen_at_depths_of_their_own() {
    let Mesh { positions, colors, triangles, .. } = &Workload::FillPass.scene().mesh;
    let depths: Vec<f32> = positions[2].chunks(4).map(|quad| quad[0]).collect();
    for (position, quad) in positions[2].chunks(4).enumerate() {
        assert!(quad.iter().all(|depth| *depth == quad[0] && (0.0..1.0).contains(depth)), "layer {position}");
        let corners: Vec<[f32; 2]> =
            (4 * position..4 * position + 4).map(|i| [positions[0][i], positions[1][i]]).collect();
        assert_eq!(corners, [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]], "layer {position}");
        let first = 4 * position as u32;
        assert_eq!(
            triangles[2 * position..][..2],
            [[first, first + 1, first + 2], [first, first + 2, first + 3]]
        );
        assert_eq!(colors[2 * position], colors[2 * position + 1]);
        assert!(
            position == 0 || colors[2 * position] != colors[2 * position - 1],
            "layer {position} has its own colour"
        );
    }
    let step = depths[1] - depths[0];
    assert!(depths.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-6), "all alike: {step}");
    assert!((depths[0] - step).abs() < 1e-6 && (1.0 - depths[63] - step).abs() < 1e-6, "up to both ends");
}

#[test]
fn what_is_cleared_shows_nothing() {
    let Mesh { positions, triangles, .. } = &Workload::Clear.scene().mesh;
    assert_eq!(triangles, &[[0; 3]], "no area");
    assert!(positions[0][0] > 1.0 && positions[1][0] > 1.0, "beyond the edge of the screen");
}
