//! The floor: a grid in the plane y = 0, and the axes x and z on it. A side that is looked at in parallel
//! projection has the grid of its own plane.
//!
//! The distance of its lines is a power of ten metres, chosen by the size of a metre on the screen below the
//! middle of the image. Lines in between fade in as the camera approaches. A piece of a line that lies behind the
//! image's surfaces is not drawn: one depth look-up decides for each piece.

use trigon_document::scene::math::{DVec2, DVec3, elementary};
use trigon_window::egui::{Color32, Painter, Pos2, Stroke};

use super::AXIS_COLORS;
use super::view::OverlayView;
use crate::up::Up;

/// Lines to each side of the middle.
const LINES: i64 = 30;
/// Lines that are nearer to each other are left out, in logical pixels.
const LEAST_GAP: f64 = 8.0;
/// The length of the pieces whose depth is tested, in logical pixels.
const PIECE: f32 = 12.0;
/// What a line has to lie behind the image to be hidden, as a share of its distance: faces on the floor do not
/// flicker.
const BEHIND: f64 = 1.0 + 1e-3;

/// The distances along the line of sight of what the image shows at points in physical pixels; `None`
/// for background.
pub(crate) type Depths<'a> = &'a dyn Fn(&[DVec2]) -> Vec<Option<f64>>;

/// Draws the grid and its two axes.
pub(crate) fn draw_grid(painter: &Painter, view: &OverlayView, depths: Depths<'_>) {
    let Some(grid) = Grid::of(view) else { return };
    let floor = FloorDepth::of(view, grid.plane);
    for (line, color, width) in grid.lines(view.up()) {
        for piece in visible(view, line, &floor, depths) {
            painter.line_segment(piece, Stroke::new(width, color));
        }
    }
}

/// A plane of two axes through the origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Plane {
    /// The axis that it has not.
    normal: usize,
    axes: [usize; 2],
}

impl Plane {
    const FLOOR: Self = Self { normal: 1, axes: [0, 2] };

    /// The plane that is seen from straight ahead in parallel projection, or the floor.
    fn of(view: &OverlayView) -> Self {
        /// The sine of an angle by which no line of the image is a pixel off.
        const STRAIGHT: f64 = 1e-6;
        let forward = view.camera().forward().to_array();
        let faces = |normal: &Self| normal.axes.iter().all(|&axis| forward[axis].abs() < STRAIGHT);
        let walls = [Self { normal: 2, axes: [0, 1] }, Self { normal: 0, axes: [2, 1] }];
        let wall = walls.into_iter().find(faces).filter(|_| view.camera().projection.is_orthographic());
        wall.unwrap_or(Self::FLOOR)
    }

    fn point(self, at: [f64; 2]) -> DVec3 {
        let mut point = [0.0; 3];
        (point[self.axes[0]], point[self.axes[1]]) = (at[0], at[1]);
        point.into()
    }
}

/// Where lines are.
#[derive(Debug, PartialEq)]
struct Grid {
    plane: Plane,
    /// Between lines, in metres.
    gap: f64,
    /// The line in the middle, by number.
    middle: [i64; 2],
    /// The opacity of the lines between every tenth: 0 to 1.
    share: f64,
}

impl Grid {
    /// `None` where the floor is seen edge-on, or is too far away.
    fn of(view: &OverlayView) -> Option<Self> {
        let (camera, plane) = (view.camera(), Plane::of(view));
        let (eye, forward) = (camera.position, camera.forward());
        let height = eye[plane.normal];
        // Where the line of sight meets the plane; below the eye where it never does.
        let ahead = -height / forward[plane.normal];
        let reach = 4.0 * height.abs().max(1e-6);
        let point =
            if ahead.is_finite() && ahead > 0.0 && (eye + forward * ahead).distance(eye) < 10.0 * reach {
                eye + forward * ahead
            } else {
                let on_plane = |from: DVec3| plane.point(plane.axes.map(|axis| from[axis]));
                on_plane(eye) + on_plane(forward).normalize_or_zero() * reach
            };
        let wanted = view.pixel_size(point) * LEAST_GAP;
        if !(wanted > 1e-9 && wanted < 1e9) {
            return None;
        }
        let power = elementary::log10(wanted).ceil();
        let gap = elementary::pow(10.0, power);
        let middle = plane.axes.map(|axis| (point[axis] / gap).round());
        middle.iter().all(|at| at.abs() < 1e12).then(|| Self {
            plane,
            gap,
            middle: middle.map(|at| at as i64),
            share: (power - elementary::log10(wanted)).clamp(0.0, 1.0),
        })
    }

    /// All lines, the axes last: they lie over the others. Every tenth goes ten times as far.
    fn lines(&self, up: Up) -> Vec<([DVec3; 2], Color32, f32)> {
        let mut lines = Vec::new();
        let mut axes = Vec::new();
        for along in [0, 1] {
            self.add_lines(along, 1, &mut lines);
            self.add_lines(along, 10, &mut lines);
            let axis = self.line(along, 0, 10);
            let is_near = (self.middle[1 - along] / 10).abs() <= LINES;
            let color = AXIS_COLORS[up.shown_axis(self.plane.axes[along])].gamma_multiply(0.8);
            axes.extend(is_near.then_some((axis, color, 1.5)));
        }
        lines.extend(axes);
        lines
    }

    /// Those in steps of so many gaps, but those that larger steps have.
    fn add_lines(&self, along: usize, step: i64, lines: &mut Vec<([DVec3; 2], Color32, f32)>) {
        let middle = self.middle[1 - along] / step;
        let share = if step == 1 { self.share } else { 1.0 };
        let color = Color32::from_gray(128).gamma_multiply(0.5 * share as f32);
        for number in (middle - LINES..=middle + LINES).map(|number| number * step) {
            let is_larger = step == 1 && number % 10 == 0;
            if !is_larger && number != 0 {
                lines.push((self.line(along, number, step), color, 1.0));
            }
        }
    }

    /// The line of a number, as long as so many gaps allow.
    fn line(&self, along: usize, number: i64, step: i64) -> [DVec3; 2] {
        [-1, 1].map(|end| {
            let mut point = [0.0; 2];
            point[1 - along] = number as f64 * self.gap;
            point[along] = (self.middle[along] + end * LINES * step) as f64 * self.gap;
            self.plane.point(point)
        })
    }
}

/// The pieces of a line on the floor that nothing hides.
fn visible(view: &OverlayView, line: [DVec3; 2], floor: &FloorDepth, depths: Depths<'_>) -> Vec<[Pos2; 2]> {
    let Some([from, to]) = view.line(line[0], line[1]) else { return Vec::new() };
    let count = (from.distance(to) / PIECE).ceil().clamp(1.0, 1000.0) as usize;
    let at = |index: usize| from.lerp(to, index as f32 / count as f32);
    let middle = |index: usize| view.physical(at(index).lerp(at(index + 1), 0.5));
    let middles: Vec<DVec2> = (0..count).map(middle).collect();
    let visible = middles.iter().zip(depths(&middles)).map(|(&pixel, depth)| !floor.is_hidden(pixel, depth));
    let mut pieces: Vec<[Pos2; 2]> = Vec::new();
    let mut was_visible = false;
    for (index, visible) in visible.enumerate() {
        match pieces.last_mut() {
            Some([_, end]) if visible && was_visible => *end = at(index + 1),
            _ if visible => pieces.push([at(index), at(index + 1)]),
            _ => {}
        }
        was_visible = visible;
    }
    pieces
}

/// How far away the floor is at each pixel, along the line of sight.
///
/// In a perspective the reciprocal of that distance is linear across the image, in a parallel
/// projection the distance itself: three pixels tell all.
#[derive(Debug)]
struct FloorDepth {
    /// At the corner of the image, and how much it grows with each pixel to the right and down.
    corner: f64,
    growth: DVec2,
    is_parallel: bool,
}

impl FloorDepth {
    fn of(view: &OverlayView, plane: Plane) -> Self {
        let normal = plane.normal;
        let is_parallel = view.camera().projection.is_orthographic();
        let (eye, forward) = (view.camera().position, view.camera().forward());
        let at = |pixel: DVec2| {
            let Some(ray) = view.ray(pixel) else { return f64::NAN };
            if is_parallel {
                let along = -ray.origin[normal] / ray.direction[normal];
                view.distance(ray.origin + ray.direction * along)
            } else {
                -ray.direction[normal] / (eye[normal] * ray.direction.dot(forward))
            }
        };
        // Far apart, so that their difference is precise.
        const APART: f64 = 1024.0;
        let corner = at(DVec2::ZERO);
        let growth = DVec2::new(at(DVec2::X * APART) - corner, at(DVec2::Y * APART) - corner) / APART;
        Self { corner, growth, is_parallel }
    }

    /// Whether the image shows something in front of the floor at a pixel, given its depth there. Where the floor's
    /// depth is NaN, as seen edge-on, nothing hides it.
    fn is_hidden(&self, pixel: DVec2, depth: Option<f64>) -> bool {
        let floor = self.corner + self.growth.dot(pixel);
        depth.is_some_and(|visible| {
            let hides = visible * BEHIND;
            if self.is_parallel { floor > hides } else { floor > 0.0 && floor * hides < 1.0 }
        })
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::camera::{Camera, Projection, Viewport};

    use super::*;

    fn from(eye: DVec3) -> OverlayView {
        let camera = Camera::look_at(eye, DVec3::ZERO, DVec3::Y);
        OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 1.0)
    }

    #[test]
    fn lines_are_a_power_of_ten_apart_and_never_too_dense() {
        for distance in [0.01, 0.3, 1.0, 7.0, 80.0, 12_345.0] {
            let view = from(DVec3::new(1.0, 1.0, 1.0) * distance);
            let grid = Grid::of(&view).expect("the floor is seen");
            let power = elementary::log10(grid.gap);
            assert!((power - power.round()).abs() < 1e-9, "{} m", grid.gap);
            let pixels = grid.gap / view.pixel_size(DVec3::ZERO);
            assert!(
                (LEAST_GAP - 1e-6..=10.0 * LEAST_GAP).contains(&pixels),
                "{pixels} pixels at {distance} m"
            );
            assert_eq!(grid.middle, [0, 0], "around the target");
        }
    }

    /// Ten million metres from the origin: lines are whole numbers of gaps, which are decimal fractions or whole metres,
    /// and are drawn where a projection of differences of whole numbers has them.
    #[test]
    fn lines_far_away_are_where_whole_numbers_have_them() {
        for far in [1_000_000_i64, 10_000_000] {
            let target = DVec3::new(far as f64, 0.0, -far as f64);
            let eye = target + DVec3::new(0.0, 3.0, 4.0);
            let camera = Camera::look_at(eye, target, DVec3::Y);
            let view = OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 1.0);
            let grid = Grid::of(&view).expect("the floor is seen");
            assert!((grid.gap - 0.1).abs() < 1e-12, "{} m", grid.gap);
            assert_eq!(grid.middle, [10 * far, -10 * far], "around the target");
            let per_metre = 300.0 / elementary::tan(15f64.to_radians());
            // Where a pixel's ray meets the floor, and what a thousandth of a pixel is there.
            let on_floor = |at: Pos2| {
                let [a, b] =
                    (view.physical(at) - DVec2::new(400.0, 300.0)).to_array().map(|at| at / per_metre);
                let reach = 3.0 / (0.6 + 0.8 * b);
                let point = [a * reach, 4.0 - reach * (0.8 - 0.6 * b)];
                (point, 1e-3 / per_metre * (reach + 0.3 * (a.abs() + 1.0) * reach * reach))
            };
            let mut checked = [0; 2];
            for (line, ..) in grid.lines(Up::Y) {
                let across = if line[0].x == line[1].x { 0 } else { 2 };
                let number = ((line[0][across] - target[across]) * 10.0).round() / 10.0;
                for end in view.line(line[0], line[1]).into_iter().flatten() {
                    let (point, pixel) = on_floor(end);
                    let off = (point[across / 2] - number).abs();
                    assert!(off < pixel, "the line at {number} is drawn {off} m off, {pixel} are allowed");
                    checked[1] += 1;
                }
                for end in line {
                    // Tenths of metres from the target, and the distance along the line of sight (0, −3, −4) / 5.
                    let [x, z] = [end.x - target.x, end.z - target.z].map(|at| (at * 10.0).round() / 10.0);
                    let distance = (3.0 * 3.0 + 4.0 * (4.0 - z)) / 5.0;
                    let up = (-3.0 * 4.0 + 3.0 * (4.0 - z)) / 5.0;
                    let Some(at) = view.point(end).filter(|_| distance > 1.0) else { continue };
                    let expected =
                        DVec2::new(400.0 + x * per_metre / distance, 300.0 - up * per_metre / distance);
                    let off = view.physical(at).distance(expected);
                    // f64 at 10⁷ m is 2⁻²⁹ m apart, and f32 at 10³ pixels 2⁻¹⁴ pixels.
                    assert!(off < 1e-3 * (1.0 + expected.length() / 1e3), "{end} is {off} pixels off");
                    checked[0] += 1;
                }
            }
            assert!(
                checked.iter().all(|&ends| ends > 100),
                "{checked:?} ends in front of the eye, and drawn"
            );
        }
    }

    /// Each side in parallel projection, and what is not straight ahead or not parallel.
    #[test]
    fn a_side_has_the_grid_of_its_plane() {
        let parallel = Projection::orthographic(12.0, 0.1, 1e3).expect("valid");
        for (eye, up, normal) in [
            (DVec3::Z * 9.0, DVec3::Y, 2),
            (DVec3::NEG_Z * 9.0, DVec3::Y, 2),
            (DVec3::X * 9.0, DVec3::Y, 0),
            (DVec3::Y * 9.0, DVec3::Z, 1),
        ] {
            let camera = Camera::look_at(eye, DVec3::ZERO, up);
            let viewport = Viewport { width: 800, height: 600 };
            let view = OverlayView::new(&camera.with_projection(parallel), viewport, 1.0);
            let grid = Grid::of(&view).expect("it is seen");
            assert_eq!(grid.plane.normal, normal, "from {eye}");
            let on_plane = |line: &[DVec3; 2]| line.iter().all(|end| end[normal] == 0.0);
            assert!(grid.lines(Up::Y).iter().all(|(line, ..)| on_plane(line)), "all lines lie on it");
            let perspective = OverlayView::new(&camera, viewport, 1.0);
            assert_eq!(Plane::of(&perspective), Plane::FLOOR, "the floor in perspective");
        }
        let aslant = Camera::look_at(DVec3::new(1e-3, 0.0, 9.0), DVec3::ZERO, DVec3::Y);
        let view = OverlayView::new(&aslant.with_projection(parallel), Viewport { width: 8, height: 6 }, 1.0);
        assert_eq!(Plane::of(&view), Plane::FLOOR, "not straight ahead");
    }

    #[test]
    fn the_axes_are_there_and_in_their_colours() {
        let grid = Grid { plane: Plane::FLOOR, gap: 1.0, middle: [3, 0], share: 0.5 };
        let lines = grid.lines(Up::Y);
        let has = |x: f64| lines.iter().any(|(line, ..)| line.iter().all(|end| end.x == x));
        assert!(
            has(4.0) && has(-20.0) && has(290.0) && !has(34.5) && !has(41.0),
            "near ones, and every tenth"
        );
        let [(x, x_color, _), (z, z_color, _)] = lines[lines.len() - 2..] else { panic!("two axes") };
        assert!(x.iter().all(|end| end.z == 0.0 && end.y == 0.0), "{x:?}");
        assert!(z.iter().all(|end| end.x == 0.0 && end.y == 0.0), "{z:?}");
        assert!(x_color.r() > x_color.b() && z_color.b() > z_color.r(), "red and blue");
    }

    #[test]
    fn the_floor_is_as_far_away_as_its_points_are() {
        let eye = DVec3::new(3.0, 4.0, 10.0);
        let perspective = Camera::look_at(eye, DVec3::new(0.0, 0.5, 0.0), DVec3::Y);
        let parallel = Projection::orthographic(12.0, 0.1, 1e3).expect("valid");
        for camera in [perspective, perspective.with_projection(parallel)] {
            let view = OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 1.0);
            let floor = FloorDepth::of(&view, Plane::FLOOR);
            for point in [DVec3::ZERO, DVec3::new(2.0, 0.0, 4.0), DVec3::new(-30.0, 0.0, -50.0)] {
                let pixel = view.physical(view.point(point).expect("before the eye"));
                let distance = view.distance(point);
                assert!(floor.is_hidden(pixel, Some(distance * 0.998)), "{point} by what is before it");
                assert!(!floor.is_hidden(pixel, Some(distance)), "{point} by what is as far away");
            }
        }
        let level = OverlayView::new(
            &Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y),
            Viewport { width: 800, height: 600 },
            1.0,
        );
        assert!(
            !FloorDepth::of(&level, Plane::FLOOR).is_hidden(DVec2::ZERO, Some(1.0)),
            "the floor from its edge"
        );
    }

    #[test]
    fn what_the_image_shows_before_the_floor_hides_it() {
        let view = from(DVec3::new(0.0, 3.0, 10.0));
        let line = [DVec3::new(-5.0, 0.0, 0.0), DVec3::new(5.0, 0.0, 0.0)];
        let floor = FloorDepth::of(&view, Plane::FLOOR);
        let visible = |depth: &dyn Fn(DVec2) -> Option<f64>| {
            visible(&view, line, &floor, &|points: &[DVec2]| points.iter().map(|&at| depth(at)).collect())
        };
        let whole = visible(&|_| None);
        assert_eq!(whole.len(), 1, "one piece: {whole:?}");
        // A wall 2 m before the eye in the middle of the image.
        let wall = |at: DVec2| ((at.x - 400.0).abs() < 50.0).then_some(2.0);
        let parts = visible(&wall);
        assert_eq!(parts.len(), 2, "left and right of the wall: {parts:?}");
        assert!(parts[0][1].x < 365.0 && parts[1][0].x > 435.0, "{parts:?}");
        assert!(visible(&|_| Some(100.0)).len() == 1, "what lies behind hides nothing");
    }
}
