//! The area of each pixel that the painted edges of faces cover.
//!
//! Many points in each pixel are tested. An edge covers a point if a visible part of the edge lies within half its
//! width. Projection, visibility and distances are computed in f64 and share nothing with the rasterizer, not even
//! a triangulation. Faces are polygons, and a point lies inside one if a ray from it crosses the outline an odd
//! number of times.
//!
//! An edge is as wide as the rule of `trigon_raster::FaceEdges` says. It covers a point of another face if
//! the nearest point of the edge is visible, and the other face does not lie in front of it.

use std::ops::Range;
use trigon_math::{DVec2, DVec3};

/// The number of test points along each side of a pixel.
pub const POINTS: usize = 16;

/// The fraction of its distance by which something has to be nearer to hide an edge. Positions rounded to f32
/// lie off the planes of their faces by a few units of 2⁻²⁴ or less, so that edges do not hide themselves.
const NEARER: f64 = 1e-5;

/// The viewpoint and the size of the image.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The eye.
    pub eye: DVec3,
    /// The point at the centre of the image.
    pub target: DVec3,
    /// Half the height of the image at a distance of 1.
    pub half_height: f64,
    /// Columns and rows of pixels.
    pub size: [usize; 2],
}

/// A corner on the image.
#[derive(Clone, Copy, Debug)]
struct FaceCorner {
    /// In pixels, x to the right, y down.
    index: DVec2,
    /// One over the distance along the line of sight.
    nearness: f64,
    vertex: u32,
}

/// A face on the image.
struct Face {
    corners: Vec<FaceCorner>,
    /// Nearness at the origin, and its steps to the right and down.
    plane: DVec3,
    half_width: f64,
}

impl View {
    fn corner(&self, position: DVec3, vertex: u32) -> FaceCorner {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let up = right.cross(forward);
        let way = position - self.eye;
        let nearness = 1.0 / way.dot(forward);
        let scale = self.size[1] as f64 / (2.0 * self.half_height);
        let middle = DVec2::new(self.size[0] as f64, self.size[1] as f64) * 0.5;
        let index = middle + DVec2::new(way.dot(right), -way.dot(up)) * (nearness * scale);
        FaceCorner { index, nearness, vertex }
    }
}

impl Face {
    /// `None` for a face that is seen edge-on.
    fn new(corners: Vec<FaceCorner>, width: f64) -> Option<Self> {
        let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
        let doubled: f64 = sides().map(|(a, b)| a.index.perp_dot(b.index)).sum();
        let perimeter: f64 = sides().map(|(a, b)| a.index.distance(b.index)).sum();
        let radius = doubled.abs() / perimeter;
        let half_width = (width * 0.5).min(radius / 3.0).min(radius * radius / 4.5);
        // Nearness is linear on the image. The area vector of its graph is its normal.
        let lifted = |corner: &FaceCorner| corner.index.extend(corner.nearness);
        let normal: DVec3 = sides().map(|(a, b)| lifted(a).cross(lifted(b))).sum();
        if normal.z == 0.0 {
            return None;
        }
        let steps = DVec2::new(-normal.x, -normal.y) / normal.z;
        let first = corners[0];
        let origin = first.nearness - steps.dot(first.index);
        Some(Self { corners, plane: DVec3::new(origin, steps.x, steps.y), half_width })
    }

    fn nearness(&self, at: DVec2) -> f64 {
        self.plane.dot(DVec3::new(1.0, at.x, at.y))
    }

    fn sides(&self) -> impl Iterator<Item = (&FaceCorner, &FaceCorner)> {
        self.corners.iter().zip(self.corners.iter().cycle().skip(1))
    }

    fn contains(&self, at: DVec2) -> bool {
        let crosses = |a: DVec2, b: DVec2| {
            (a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.sides().filter(|(a, b)| crosses(a.index, b.index)).count() % 2 == 1
    }

    fn shares_a_corner(&self, other: &Self) -> bool {
        self.corners.iter().any(|a| other.corners.iter().any(|b| a.vertex == b.vertex))
    }

    /// Whether it hides a point on the image.
    fn hides(&self, at: DVec2, nearness: f64) -> bool {
        self.nearness(at) > nearness * (1.0 + NEARER) && self.contains(at)
    }

    /// The pixels within this distance of it.
    fn pixels(&self, size: [usize; 2], beyond: f64) -> [Range<usize>; 2] {
        [0, 1].map(|axis| {
            let along = || self.corners.iter().map(|corner| corner.index[axis]);
            let low = along().fold(f64::INFINITY, f64::min) - beyond;
            let high = along().fold(f64::NEG_INFINITY, f64::max) + beyond;
            let within = |at: f64| at.max(0.0).min(size[axis] as f64) as usize;
            within(low.floor())..within(high.ceil())
        })
    }
}

/// The fraction of each pixel that edges of a width in pixels cover, row by row: 0 to 1. Faces are lists of
/// vertices; faces that are turned away are visible, too. Everything lies in front of the eye.
#[must_use]
pub fn coverage(view: &View, positions: &[DVec3], faces: &[Vec<u32>], width: f64) -> Vec<f64> {
    let project = |face: &Vec<u32>| {
        let corner = |&vertex: &u32| view.corner(positions[vertex as usize], vertex);
        Face::new(face.iter().map(corner).collect(), width)
    };
    let faces: Vec<Face> = faces.iter().filter_map(project).collect();
    let [columns, rows] = view.size;
    let mut around = vec![Vec::new(); columns * rows];
    for (number, face) in faces.iter().enumerate() {
        let [x, y] = face.pixels(view.size, face.half_width);
        for (y, x) in y.flat_map(|y| x.clone().map(move |x| (y, x))) {
            around[y * columns + x].push(number);
        }
    }
    let pixels = around.iter().enumerate().map(|(pixel, around)| {
        let around: Vec<&Face> = around.iter().map(|&number| &faces[number]).collect();
        let corner = DVec2::new((pixel % columns) as f64, (pixel / columns) as f64);
        let points = (0..POINTS * POINTS)
            .map(|i| corner + (DVec2::new((i % POINTS) as f64, (i / POINTS) as f64) + 0.5) / POINTS as f64);
        points.filter(|&at| is_inked(&around, at)).count() as f64 / (POINTS * POINTS) as f64
    });
    pixels.collect()
}

/// Whether an edge covers a point.
fn is_inked(faces: &[&Face], at: DVec2) -> bool {
    let visible = faces.iter().filter(|face| face.contains(at));
    let ground = visible.max_by(|a, b| a.nearness(at).total_cmp(&b.nearness(at)));
    faces.iter().any(|face| {
        let is_own = ground.is_some_and(|ground| std::ptr::eq(*ground, *face));
        let is_joined = ground.is_some_and(|ground| ground.shares_a_corner(face));
        let half_width = match ground {
            Some(ground) if is_joined => face.half_width.min(ground.half_width),
            _ => face.half_width,
        };
        face.sides().any(|(a, b)| {
            let way = b.index - a.index;
            let share = ((at - a.index).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            let point = a.index + way * share;
            let nearness = a.nearness + (b.nearness - a.nearness) * share;
            if at.distance(point) > half_width {
                return false;
            }
            let lies_before = |ground: &&&Face| ground.nearness(point) > nearness;
            (is_own || is_joined || ground.filter(lies_before).is_none())
                && !faces.iter().any(|other| other.hides(point, nearness))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A square of 8 by 8 pixels in the middle of 16 by 16.
    #[test]
    fn a_square_has_an_outline_of_the_width_asked_for() {
        let view = View { eye: DVec3::Z, target: DVec3::ZERO, half_height: 1.0, size: [16, 16] };
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let positions = corners.map(|[x, y]| DVec3::new(x, y, 0.0));
        let found = coverage(&view, &positions, &[vec![0, 1, 2, 3]], 2.0);
        let row: Vec<f64> = (0..16).map(|x| found[8 * 16 + x]).collect();
        let expected = [0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        assert_eq!(row, expected, "a pixel on either side");
    }

    /// Half the image's height is one at the eye's distance: eight pixels.
    #[test]
    fn what_lies_above_and_to_the_right_is_shown_there() {
        let view = View { eye: DVec3::Z, target: DVec3::ZERO, half_height: 1.0, size: [16, 16] };
        let corners = [[0.25, 0.5], [0.5, 0.5], [0.5, 0.75], [0.25, 0.75]];
        let positions = corners.map(|[x, y]| DVec3::new(x, y, 0.0));
        let found = coverage(&view, &positions, &[vec![0, 1, 2, 3]], 1.0);
        let inked: Vec<_> =
            (0..16 * 16).filter(|&pixel| found[pixel] > 0.0).map(|pixel| (pixel % 16, pixel / 16)).collect();
        // Its outline lies on the borders of four pixels, between the second and the fourth row from the top.
        let expected: Vec<_> = (1..5).flat_map(|y| (9..13).map(move |x| (x, y))).collect();
        assert_eq!(inked, expected, "columns and rows");
    }

    proptest! {
        /// Exactly the points that lie on the same side of all three lines.
        #[test]
        fn a_triangle_contains_what_lies_between_its_sides(
            slots in prop::array::uniform3(prop::array::uniform2(-9.0..9.0_f64)),
            at in prop::array::uniform2(-9.0..9.0_f64),
        ) {
            let (slots, at) = (slots.map(DVec2::from_array), DVec2::from_array(at));
            let corners = slots.map(|index| FaceCorner { index, nearness: 1.0, vertex: 0 }).to_vec();
            let face = Face { corners, plane: DVec3::X, half_width: 0.0 };
            let sides = [0, 1, 2].map(|i| (slots[(i + 1) % 3] - slots[i]).perp_dot(at - slots[i]));
            prop_assume!(sides.iter().all(|side| side.abs() > 1e-6));
            let is_inside = sides.iter().all(|side| *side > 0.0) || sides.iter().all(|side| *side < 0.0);
            prop_assert_eq!(face.contains(at), is_inside, "{} in {:?}", at, slots);
        }
    }
}
