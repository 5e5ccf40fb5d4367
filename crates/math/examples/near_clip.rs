//! Cuts triangles at the near plane and draws what is left, as text.
//!
//! Run with `cargo run -p trigon-math --example near_clip`. A row of the image
//! is a height, a column a distance from the eye, which is at the left edge.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use trigon_math::{ClipVolume, Fixed, FixedPoint, HalfSpace, Vec4, clip_triangle, orientation_fixed};

const COLUMNS: usize = 60;
const ROWS: usize = 13;

/// A point seen from the side: `ahead` of the eye and above it. Clip space of a
/// perspective with the near plane at 1 and the far plane at infinity.
fn seen_from_the_side(ahead: f32, height: f32) -> Vec4 {
    Vec4::new(0.0, height, 1.0, ahead)
}

/// Ten columns and three rows to a unit; the eye is 20 columns from the left.
fn on_paper(position: Vec4) -> FixedPoint {
    let fixed = |value| Fixed::from_f32(value).expect("the image is small");
    FixedPoint::new(fixed(20.0 + 10.0 * position.w), fixed(6.5 - 3.0 * position.y))
}

/// Whether a point is inside a convex polygon, by exact orientation.
fn covers(polygon: &[FixedPoint], point: FixedPoint) -> bool {
    let turns = |index: usize| {
        let next = polygon[(index + 1) % polygon.len()];
        orientation_fixed(polygon[index], next, point)
    };
    let indices = 0..polygon.len();
    indices.clone().all(|i| turns(i) >= 0) || indices.clone().all(|i| turns(i) <= 0)
}

fn draw(triangle: &[FixedPoint], clipped: &[FixedPoint]) {
    for row in 0..ROWS {
        let cell = |column: usize| {
            let center = FixedPoint::new(
                Fixed::from_raw(256 * column as i32 + 128),
                Fixed::from_raw(256 * row as i32 + 128),
            );
            match (covers(triangle, center), column) {
                (true, _) if !clipped.is_empty() && covers(clipped, center) => '#',
                (_, 30) => '|',
                (true, _) => '.',
                _ => ' ',
            }
        };
        let line: String = (0..COLUMNS).map(cell).collect();
        println!("{}", line.trim_end());
    }
}

fn main() {
    let volume = ClipVolume::before_the_eye(1e-6).expect("a positive number").with(HalfSpace::NEAR);
    let cases = [
        ("One corner cut off leaves a quadrilateral:", [(3.5, -1.5), (3.0, 2.0), (-1.5, 0.0)]),
        ("Two cut off leave a triangle:", [(3.5, 0.0), (-1.0, 2.0), (-1.5, -2.0)]),
    ];
    println!("The eye is in column 20, the near plane | in column 30; # is kept, . is cut off.");
    for (title, corners) in cases {
        let triangle = corners.map(|(ahead, height)| seen_from_the_side(ahead, height));
        let clipped = clip_triangle(triangle, &volume);
        let vertices: Vec<FixedPoint> = clipped.vertices().iter().map(|v| on_paper(v.position)).collect();
        println!("\n{title}");
        draw(&triangle.map(on_paper), &vertices);
        for vertex in clipped.vertices() {
            let [a, b, c] = vertex.weights;
            let Vec4 { y, w, .. } = vertex.position;
            println!("  {w:.3} ahead, height {y:+.3}: {a:.3} of a, {b:.3} of b, {c:.3} of c");
        }
    }
}
