//! Roberts' algorithm (L. G. Roberts, "Machine perception of three-dimensional solids", MIT Lincoln
//! Laboratory TR 315, 1963) as in source D (row D5). A body is a matrix of planes with its inside on their
//! positive side. Planes that face away are hidden by the body itself. The remaining faces are compared with
//! every other body: a point is hidden if the ray from it to the eye passes through one.
//!
//! The work grows with the square of the number of bodies: no boxes and no depth order reduce the
//! comparisons.

mod body;
mod lines;

pub use lines::{Line, Lines, visible_lines};

use super::scene::STEPS_PER_PIXEL;
use super::{Drawing, NotConvex, Scene, Surface};
use body::convex_bodies;

/// The faces that are seen: the points of faces that no other body hides.
pub(super) fn draw(scene: &Scene) -> Result<Drawing, NotConvex> {
    let bodies = convex_bodies(scene)?;
    let mut drawing = Drawing::empty(scene.size());
    let faces_toward_eye = bodies.iter().flat_map(|body| body.planes.iter().map(|plane| plane.faces_eye()));
    for ((number, face), _) in scene.faces().zip(faces_toward_eye).filter(|(_, faces_eye)| *faces_eye) {
        let Some(surface) = Surface::new(face) else { continue };
        surface.each_pixel(scene.limits(), |pixel, depth| {
            let [x, y] = pixel.map(|part| f64::from(part * STEPS_PER_PIXEL + STEPS_PER_PIXEL / 2));
            let point = [x, y, depth];
            let others = bodies.iter().enumerate().filter(|(other, _)| *other != face.body);
            let mut hiding = others.filter(|(_, body)| body.hides(point, &mut drawing.tests));
            if hiding.next().is_none() {
                drawing.faces[pixel.map(|part| part as usize)] = number;
            }
        });
    }
    Ok(drawing)
}
