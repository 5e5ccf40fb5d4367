//! Cameras for a part of another camera's image.

use crate::{Camera, CameraError, Projection, Viewport};

impl Camera {
    /// The camera whose image of `size` pixels is the part of this one's that begins `corner`
    /// pixels from its upper left: pixel by pixel, up to rounding.
    ///
    /// # Errors
    /// The part is so small or so far outside that its sides coincide in `f64`, or it has no size.
    ///
    /// ```
    /// use trigon_camera::{Camera, Viewport};
    ///
    /// let whole = Viewport { width: 640, height: 480 };
    /// let under_the_pointer = Camera::default().part(whole, [320, 100], [1, 1])?;
    /// # Ok::<(), trigon_camera::CameraError>(())
    /// ```
    pub fn part(&self, whole: Viewport, corner: [u32; 2], size: [u32; 2]) -> Result<Self, CameraError> {
        let sides = whole.size().to_array();
        // From −1 at the left and the lower edge to 1.
        let at = |axis: usize, pixel: f64| pixel / sides[axis] * 2.0 - 1.0;
        let [[left, top], [width, height]] = [corner, size].map(|pair| pair.map(f64::from));
        let x = [at(0, left), at(0, left + width)];
        let y = [-at(1, top + height), -at(1, top)];
        if let Projection::Orthographic { height: whole_height, near, far, .. } = self.projection {
            let half = [whole_height * 0.5 * whole.aspect(), whole_height * 0.5];
            let middle = [(x[0] + x[1]) * 0.5 * half[0], (y[0] + y[1]) * 0.5 * half[1]];
            let position = self.position + self.right() * middle[0] + self.up() * middle[1];
            let projection = Projection::orthographic(whole_height * height / sides[1], near, far)?;
            return Ok(Self { position, projection, ..*self });
        }
        let matrix = self.projection.matrix(whole.aspect());
        let (near, far) = (self.projection.near(), self.projection.far());
        // The point on the near plane with these clip coordinates.
        let across = x.map(|x| near * (x + matrix.z_axis.x) / matrix.x_axis.x);
        let along = y.map(|y| near * (y + matrix.z_axis.y) / matrix.y_axis.y);
        let projection = Projection::frustum(across[0], across[1], along[0], along[1], near, far)?;
        Ok(Self { projection, ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Projector;
    use trigon_math::DVec3;

    #[test]
    fn a_part_shows_points_where_the_whole_does() {
        let whole = Viewport { width: 640, height: 300 };
        let perspective = Camera::look_at(DVec3::new(3.0, 2.0, 5.0), DVec3::ZERO, DVec3::Y);
        let orthographic = perspective.projection.to_orthographic(6.0).expect("in range");
        let oblique = Projection::frustum(-0.1, 0.3, -0.05, 0.1, 0.2, None).expect("a frustum");
        for projection in [perspective.projection, orthographic, oblique] {
            let camera = perspective.with_projection(projection);
            for (corner, size) in [([0, 0], [640, 300]), ([320, 10], [1, 1]), ([600, 250], [40, 50])] {
                let part = camera.part(whole, corner, size).expect("in range");
                let window = Viewport { width: size[0], height: size[1] };
                for point in [DVec3::ZERO, DVec3::new(1.0, -0.5, 0.25), DVec3::new(-2.0, 1.0, 1.0)] {
                    let expected = Projector::new(&camera, whole).to_screen(point).expect("before the eye");
                    let shown = Projector::new(&part, window).to_screen(point).expect("before the eye");
                    let back = shown + trigon_math::DVec2::from(corner.map(f64::from));
                    // A dozen roundings, of coordinates that are magnified up to 640 times.
                    assert!(back.distance(expected) < 1e-9, "{projection:?}, {corner:?}: {back} {expected}");
                }
            }
        }
    }

    #[test]
    fn a_part_without_size_is_refused() {
        let whole = Viewport { width: 64, height: 64 };
        assert!(Camera::default().part(whole, [3, 4], [0, 1]).is_err(), "no width");
        let parallel = Projection::orthographic(2.0, 0.1, 10.0).expect("in range");
        let camera = Camera::default().with_projection(parallel);
        assert!(camera.part(whole, [3, 4], [1, 0]).is_err(), "no height");
    }
}
