//! The parts of an object that may lie in a small area. All other parts are skipped box by box: a box is skipped if it
//! lies outside the area or in front of the near plane.

use trigon_math::{DMat4, DVec2, DVec4};

use super::object::{DrawnTriangles, PickObject};
use super::region::{Area, Sides};
use super::screen::Screen;
use crate::geometry::{BlockBox, Blocks};

/// The elements of an object that may lie in an area, each list increasing.
#[derive(Default)]
pub(super) struct SmallRegion {
    pub(super) vertices: Vec<u32>,
    pub(super) edges: Vec<u32>,
    pub(super) triangles: Vec<u32>,
}

impl SmallRegion {
    pub(super) fn new(object: &PickObject<'_>, screen: &Screen, area: &Area<'_>) -> Self {
        let mesh = object.mesh();
        let (mut triangles, mut faces) = (Vec::new(), Vec::new());
        if let Some(drawn) = object.drawn() {
            let blocks = drawn.blocks(mesh);
            triangles = near_triangles(drawn, blocks, screen, area);
            faces.extend(triangles.iter().map(|&triangle| drawn.face(triangle as usize)));
            faces.extend(&blocks.scant_faces);
        }
        let faces = each_once(faces);
        let corners = || faces.iter().flat_map(|&face| mesh.face_corners(face as usize));
        let loose_vertices = mesh.loose_edges().as_flattened().iter().chain(mesh.loose_points()).copied();
        let loose_edges = mesh.face_edge_count() as u32..mesh.edge_count() as u32;
        let vertices = corners().map(|corner| mesh.corner_vertices()[corner]).chain(loose_vertices);
        let edges = corners().filter_map(|corner| mesh.corner_edge(corner)).chain(loose_edges);
        Self { vertices: each_once(vertices.collect()), edges: each_once(edges.collect()), triangles }
    }
}

/// The triangles that may lie in an area.
fn near_triangles(drawn: &DrawnTriangles, blocks: &Blocks, screen: &Screen, area: &Area<'_>) -> Vec<u32> {
    let culling = BoxCulling::new(drawn.map(), screen.half_size(), area);
    let corner = drawn.corners(screen);
    let is_near = |triangle: &usize| {
        !Sides::is_beside(&drawn.triangle(*triangle).map(|at| Sides::of(&corner(at), area)))
    };
    let near = drawn.within(blocks, |block| culling.may_hold(block));
    near.flatten().filter(is_near).map(|triangle| triangle as u32).collect()
}

fn each_once(mut numbers: Vec<u32>) -> Vec<u32> {
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// By how much the area is enlarged, in pixels: points between others are rounded, too.
const MARGIN: f64 = 1.0;

/// Of the sum of the absolute terms of a form, more than what its value and the place of a
/// point on the screen are rounded by.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// The four sides of an area and the near plane: linear forms of an object's points, negative
/// beyond each. A form is that of `x / w` against a border, times `w`, so that it holds on
/// both sides of the near plane.
pub(super) struct BoxCulling([BorderForm; 5]);

struct BorderForm {
    factors: DVec4,
    /// The greatest that rounding may make of each.
    absolute: DVec4,
}

impl BoxCulling {
    /// `map` takes the object's points to clip space.
    pub(super) fn new(map: &DMat4, half_size: DVec2, area: &Area<'_>) -> Self {
        let [x, y, z, w] = [0, 1, 2, 3].map(|row| map.row(row));
        let [left, right] = [area.columns.start, area.columns.end].map(f64::from);
        let [above, below] = [area.rows.start, area.rows.end].map(f64::from);
        // Clip space has its origin in the middle, and y points up.
        let across = |pixel: f64| pixel / half_size.x - 1.0;
        let up = |pixel: f64| 1.0 - pixel / half_size.y;
        Self([
            BorderForm::new(x, w, -across(left - MARGIN)),
            BorderForm::new(-x, w, across(right + MARGIN)),
            BorderForm::new(-y, w, up(above - MARGIN)),
            BorderForm::new(y, w, -up(below + MARGIN)),
            BorderForm::new(-z, w, 1.0),
        ])
    }

    /// Whether something in a box may lie in the area; `false` is a proof that nothing does.
    pub(super) fn may_hold(&self, block: &BlockBox) -> bool {
        !self.0.iter().any(|form| form.is_beyond(block))
    }
}

impl BorderForm {
    /// `one + share * w`
    fn new(one: DVec4, w: DVec4, share: f64) -> Self {
        Self { factors: one + w * share, absolute: one.abs() + w.abs() * share.abs() }
    }

    /// Whether all of a box is; where something is no number that is not known.
    fn is_beyond(&self, block: &BlockBox) -> bool {
        let (factors, absolute) = (self.factors.to_array(), self.absolute.to_array());
        let (mut most, mut terms) = (factors[3], absolute[3]);
        for axis in 0..3 {
            let [min, max] = [block.min, block.max].map(|end| f64::from(end[axis]));
            let [low, high] = [min, max].map(|end| factors[axis] * end);
            // Not `max`, which would pass over no number.
            most += if low > high { low } else { high };
            terms += absolute[axis] * if min.abs() > max.abs() { min.abs() } else { max.abs() };
        }
        most < -ROUNDED * terms
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_camera::{Camera, Projection, Viewport};
    use trigon_math::{DAffine3, DVec3, Vec3};

    use super::*;
    use crate::pick::region::Region;
    use crate::pick::screen::Screen;

    fn point() -> impl Strategy<Value = [f32; 3]> {
        prop::array::uniform3(prop_oneof![-9.0..9.0_f32, -1e6..1e6_f32])
    }

    proptest! {
        /// Whatever lies in a box and in the area is held, seen by the picker's own map.
        #[test]
        fn boxes_with_points_in_an_area_are_held(
            corners in prop::array::uniform2(point()),
            shares in prop::collection::vec(prop::array::uniform3(0.0..=1.0_f32), 20),
            place in prop_oneof![Just(0.0), -1e7..1e7_f64],
            is_parallel in any::<bool>(),
            center in (0.0..200.0_f64, 0.0..100.0_f64),
            radius in 0.0..60.0_f64,
        ) {
            let [a, b] = corners.map(Vec3::from_array);
            let (min, max) = (a.min(b), a.max(b));
            let eye = DVec3::new(place, 0.5, 20.0);
            let projection = if is_parallel { Projection::orthographic(12.0, 0.1, 1e7).expect("a view") } else { Projection::default() };
            let camera = Camera { projection, ..Camera::look_at(eye, DVec3::new(place, 0.0, 0.0), DVec3::Y) };
            let viewport = Viewport { width: 200, height: 100 };
            let screen = Screen::new(&camera, viewport);
            let map = screen.map(&DAffine3::from_translation(DVec3::new(place, 0.0, 0.0)));
            let region = Region::Circle { center: DVec2::new(center.0, center.1), radius };
            let area = Area::new(&region, viewport);
            let block = BlockBox { min: min.to_array(), max: max.to_array() };
            let is_held = BoxCulling::new(&map, viewport.size() * 0.5, &area).may_hold(&block);
            for share in shares {
                let within = min + (max - min) * Vec3::from_array(share);
                let spot = screen.spot(&map, within.clamp(min, max).as_dvec3());
                prop_assert!(is_held || !area.contains(spot.at), "{within} is at {:?}", spot.at);
            }
        }
    }
}
