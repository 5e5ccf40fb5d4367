//! Prints where the corners of a cube land in an image of 80 by 40, and draws them.
#![expect(clippy::print_stdout, reason = "an example that prints")]

use trigon_camera::{AxisView, DEFAULT_MARGIN, Orbit, Projector, Viewport};
use trigon_math::{Bounds3, DVec3};

fn main() {
    let viewport = Viewport { width: 80, height: 40 };
    let bounds = Bounds3 { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };
    let mut orbit = Orbit::new(DVec3::Y);
    orbit.set_view(AxisView::Isometric);
    orbit.fit(&bounds, viewport.aspect(), DEFAULT_MARGIN);
    orbit.orbit(0.3, -0.2);

    let projector = Projector::new(&orbit.camera(&bounds), viewport);
    let mut image = vec![vec![b' '; 80]; 40];
    for (name, corner) in (b'a'..).zip(0..8) {
        let side = |bit: i32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let point = DVec3::new(side(0), side(1), side(2));
        let Some((screen, depth)) = projector.to_screen_and_depth(point) else { continue };
        println!("{}: {point} at {:6.2} {:6.2}, depth {depth:.4}", name as char, screen.x, screen.y);
        image[screen.y as usize % 40][screen.x as usize % 80] = name;
    }
    for row in image {
        println!("{}", String::from_utf8_lossy(&row));
    }
}
