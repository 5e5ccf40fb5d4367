//! A ball of 5,120 triangles, one metre in radius, above a floor of four by four metres.

use trigon_classic::Field;
use trigon_math::DVec3;
use trigon_mesh::{Mesh, primitives};

/// Towards the light; of length 1.
pub(super) const LIGHT: DVec3 = DVec3::new(2.0 / 7.0, 6.0 / 7.0, 3.0 / 7.0);

/// The middle of the ball.
pub(super) const BALL: DVec3 = DVec3::new(0.4, 1.2, 0.6);

/// How wide and deep the floor is.
pub(super) const FLOOR: f64 = 4.0;

/// The ball about its own middle.
pub(super) fn ball() -> Mesh {
    primitives::icosphere(1.0, 4)
}

/// The triangles of the ball where it stands: what maps and rays get alike.
pub(super) fn triangles() -> Vec<[DVec3; 3]> {
    let mesh = ball();
    let corner = |&vertex: &u32| mesh.positions()[vertex as usize].as_dvec3() + BALL;
    let triangle = |face: usize| {
        let corners = mesh.face_vertices(face);
        [corner(&corners[0]), corner(&corners[1]), corner(&corners[2])]
    };
    (0..mesh.face_count()).map(triangle).collect()
}

/// Two directions across the light.
pub(super) fn across() -> [DVec3; 2] {
    let one = LIGHT.cross(DVec3::X).normalize();
    [one, LIGHT.cross(one)]
}

/// The place on the floor, in metres from its middle, of a pixel's centre.
pub(super) fn point(place: [usize; 2], side: usize) -> [f64; 2] {
    place.map(|part| ((part as f64 + 0.5) / side as f64 - 0.5) * FLOOR)
}

/// In space.
pub(super) fn on_floor([x, z]: [f64; 2]) -> DVec3 {
    DVec3::new(x, 0.0, z)
}

/// The light in each pixel of the floor, 0 or 1: the triangles are moved along the light onto the
/// floor, and what one of them covers there is dark. In `f64`, by nothing that draws elsewhere.
pub(super) fn exact(side: usize) -> Field<f64> {
    let mut light = Field::new([side; 2], 1.0);
    for triangle in triangles() {
        // In pixels, whole numbers at their centres.
        let [a, b, c] = triangle.map(|corner| {
            let fallen = corner - LIGHT * (corner.y / LIGHT.y);
            [fallen.x, fallen.z].map(|part| (part / FLOOR + 0.5) * side as f64 - 0.5)
        });
        let [columns, rows] = [0, 1].map(|axis| {
            let [low, high] = crate::fill::range([a[axis], b[axis], c[axis]]);
            // Within the image: the whole shadow falls on the floor, and numbers below zero become zero.
            low.ceil() as usize..=high.floor() as usize
        });
        for [x, y] in rows.flat_map(|y| columns.clone().map(move |x| [x, y])) {
            let turn = |p: [f64; 2], q: [f64; 2]| {
                (q[0] - p[0]) * (y as f64 - p[1]) - (q[1] - p[1]) * (x as f64 - p[0])
            };
            let turns = [turn(a, b), turn(b, c), turn(c, a)];
            if turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0) {
                light[[x, y]] = 0.0;
            }
        }
    }
    light
}
