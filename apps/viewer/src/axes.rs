//! The axis directions in a corner of an image: arrows that rotate with the camera.

use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DQuat, DVec3, Vec3};
use trigon_mesh::primitives;
use trigon_scene::{Background, Frame, Lighting, Material, RenderSettings, Scene, render};

use crate::failure::Failure;

/// The arrows' share of the image's smaller side.
const SHARE: u32 = 6;

/// Draws arrows of these colours (linear RGB) into the lower left corner.
pub(crate) fn draw(
    frame: &mut Frame,
    camera: &Camera,
    colors: [Vec3; 3],
    settings: &RenderSettings,
) -> Result<(), Failure> {
    let side = side(frame.width, frame.height);
    let arrows = arrows(side, camera.orientation, colors, settings)?;
    let top = frame.height - side;
    for y in 0..side {
        for x in 0..side {
            let from = 4 * (y * side + x) as usize;
            let to = 4 * ((top + y) * frame.width + x) as usize;
            let over = <[u8; 4]>::try_from(&arrows.color[from..from + 4]).expect("four bytes");
            let below = <[u8; 4]>::try_from(&frame.color[to..to + 4]).expect("four bytes");
            frame.color[to..to + 4].copy_from_slice(&blended(over, below));
        }
    }
    Ok(())
}

/// The width and height of the arrows over an image of a size, all in pixels.
pub(crate) fn side(width: u32, height: u32) -> u32 {
    (width.min(height) / SHARE).max(1)
}

/// Arrows of these colours (linear RGB) on nothing, as a camera of this orientation sees them.
pub(crate) fn arrows(
    side: u32,
    orientation: DQuat,
    colors: [Vec3; 3],
    settings: &RenderSettings,
) -> Result<Frame, Failure> {
    let settings = RenderSettings {
        background: Background::Transparent,
        lighting: Lighting::Studio,
        threads: settings.threads,
        simd: settings.simd,
        ..RenderSettings::new(side, side)
    };
    render(&scene(colors), &looking_at_arrows(orientation), &settings).map_err(Failure::work)
}

/// Turned as the image's camera, and at rest in the middle of the arrows.
fn looking_at_arrows(orientation: DQuat) -> Camera {
    /// Arrows have a length of 1.
    const HEIGHT: f64 = 2.3;
    let projection = Projection::orthographic(HEIGHT, 0.1, 10.0).expect("the planes are in order");
    Camera { position: orientation * DVec3::Z * 4.0, orientation, projection }
}

fn scene(colors: [Vec3; 3]) -> Scene {
    let mut scene = Scene::new();
    // Cylinders and cones stand along +Y.
    let turns = [
        DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2),
        DQuat::IDENTITY,
        DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
    ];
    for ((name, turn), color) in ["X", "Y", "Z"].into_iter().zip(turns).zip(colors) {
        let shaft = primitives::cylinder(0.06, 0.7, 16);
        let head = primitives::cone(0.15, 0.3, 16);
        for (part, middle) in [(shaft, 0.35), (head, 0.85)] {
            let transform = DAffine3::from_quat(turn) * DAffine3::from_translation(DVec3::Y * middle);
            scene.add_object(name, part.transformed(&transform), Material::from_color(color));
        }
    }
    scene
}

/// One pixel of straight alpha over another, in sRGB as programs that show images do it.
fn blended(over: [u8; 4], below: [u8; 4]) -> [u8; 4] {
    let [front, back] = [over[3], below[3]].map(u32::from);
    // Out of 255².
    let alpha = front * 255 + back * (255 - front);
    if alpha == 0 {
        return below;
    }
    let channel = |index: usize| {
        let sum = u32::from(over[index]) * front * 255 + u32::from(below[index]) * back * (255 - front);
        ((sum + alpha / 2) / alpha) as u8
    };
    [channel(0), channel(1), channel(2), ((alpha + 127) / 255) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blending_keeps_what_is_opaque_and_what_is_empty() {
        assert_eq!(blended([9, 8, 7, 255], [1, 2, 3, 255]), [9, 8, 7, 255], "opaque");
        assert_eq!(blended([9, 8, 7, 0], [1, 2, 3, 40]), [1, 2, 3, 40], "nothing over it");
        assert_eq!(blended([9, 8, 7, 40], [0; 4]), [9, 8, 7, 40], "over nothing");
        assert_eq!(blended([200, 0, 0, 128], [0, 0, 100, 255]), [100, 0, 50, 255], "half of each");
    }

    /// From the front X leads to the right and Y up.
    #[test]
    fn arrows_turn_with_the_camera() {
        let colors = [Vec3::X, Vec3::Y, Vec3::Z];
        let mut frame = Frame { width: 120, height: 120, color: vec![0; 4 * 120 * 120], ..Frame::default() };
        let camera = Camera::look_at(DVec3::Z, DVec3::ZERO, DVec3::Y);
        draw(&mut frame, &camera, colors, &RenderSettings::new(120, 120)).expect("drawn");
        let pixel =
            |x: usize, y: usize| <[u8; 4]>::try_from(&frame.color[4 * (120 * y + x)..][..4]).expect("four");
        let [right, up, outside] = [pixel(16, 110), pixel(10, 104), pixel(60, 60)];
        assert!(right[0] > 2 * right[1], "red to the right: {right:?}");
        assert!(up[1] > 2 * up[0], "green up: {up:?}");
        assert_eq!(outside, [0; 4], "nothing elsewhere");
    }
}
