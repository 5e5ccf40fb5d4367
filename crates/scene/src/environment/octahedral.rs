//! All directions in a square: the octahedron of unit absolute sums, unfolded (T. Engelhardt and C.
//! Dachsbacher, "Octahedron Environment Maps", 2008). Looking up a direction needs no trigonometry.

use trigon_math::{Vec2, Vec3};

use super::equirectangular;

/// Light from all directions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Octahedral {
    /// Texels on a side, without the border.
    size: usize,
    /// Rows with a border of one texel, which continues across the fold.
    texels: Vec<Vec3>,
}

impl Octahedral {
    /// From the light of each direction (unit vectors).
    pub(super) fn from_function(size: usize, light: impl Fn(Vec3) -> Vec3) -> Self {
        Self::bordered(size, |x, y| light(direction(size, x, y)))
    }

    /// From texels, row by row.
    pub(super) fn from_texels(size: usize, texels: &[Vec3]) -> Self {
        Self::bordered(size, |x, y| texels[y * size + x])
    }

    /// Every pixel of the image adds to the texel that it falls in, weighted by its solid angle: a
    /// small bright sun keeps its light.
    pub(super) fn from_equirectangular(
        size: usize,
        width: usize,
        height: usize,
        pixels: &[[f32; 3]],
    ) -> Self {
        let mut sums = vec![(Vec3::ZERO, 0.0_f32); size * size];
        for (y, row) in pixels.chunks_exact(width).enumerate() {
            for (x, &pixel) in row.iter().enumerate() {
                let (u, v) = ((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
                let towards = equirectangular(u, v);
                let area = (1.0 - towards.y * towards.y).sqrt();
                let position = unfolded(towards) * size as f32;
                let texel = held(position.y as usize, size) * size + held(position.x as usize, size);
                sums[texel].0 += clean(pixel) * area;
                sums[texel].1 += area;
            }
        }
        let nearest = |towards: Vec3| {
            let around = trigon_math::elementary::atan2_f32(towards.x, -towards.z);
            let u = around / std::f32::consts::TAU + 0.5;
            let v = trigon_math::elementary::acos_f32(towards.y.clamp(-1.0, 1.0)) / std::f32::consts::PI;
            let (x, y) =
                (held((u * width as f32) as usize, width), held((v * height as f32) as usize, height));
            clean(pixels[y * width + x])
        };
        Self::bordered(size, |x, y| match sums[y * size + x] {
            (_, 0.0) => nearest(direction(size, x, y)),
            (sum, area) => sum / area,
        })
    }

    fn bordered(size: usize, texel: impl Fn(usize, usize) -> Vec3) -> Self {
        let side = size + 2;
        let mut texels = vec![Vec3::ZERO; side * side];
        for (y, x) in (0..size).flat_map(|y| (0..size).map(move |x| (y, x))) {
            texels[(y + 1) * side + x + 1] = texel(x, y);
        }
        for i in 0..size {
            // Beyond an edge of the square lies the same edge, reversed.
            let mirrored = size - i;
            texels[i + 1] = texels[side + mirrored];
            texels[(size + 1) * side + i + 1] = texels[size * side + mirrored];
            texels[(i + 1) * side] = texels[mirrored * side + 1];
            texels[(i + 1) * side + size + 1] = texels[mirrored * side + size];
        }
        for (corner, opposite) in [
            (0, size * side + size),
            (size + 1, size * side + 1),
            ((size + 1) * side, side + size),
            (side * side - 1, side + 1),
        ] {
            texels[corner] = texels[opposite];
        }
        Self { size, texels }
    }

    /// The light from a direction of any length, bilinear; from no direction that
    /// of the middle.
    pub(super) fn at(&self, direction: Vec3) -> Vec3 {
        let position = unfolded(direction) * self.size as f32 + 0.5;
        let (x, y) = (held(position.x as usize, self.size + 1), held(position.y as usize, self.size + 1));
        let share = position - Vec2::new(x as f32, y as f32);
        let side = self.size + 2;
        let [a, b, c, d] = [0, 1, side, side + 1].map(|step| self.texels[y * side + x + step]);
        a.lerp(b, share.x).lerp(c.lerp(d, share.x), share.y)
    }

    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// All texels: their directions, their solid angles, and their light.
    pub(super) fn iter(&self) -> impl Iterator<Item = (Vec3, f32, Vec3)> + '_ {
        let (size, side) = (self.size, self.size + 2);
        (0..size * size).map(move |i| {
            let (x, y) = (i % size, i / size);
            let position = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / size as f32;
            let folded = folded(position);
            let length = folded.length();
            // The octahedron's faces are tilted, which changes the solid angle of texels.
            let step = 2.0 / size as f32;
            let area = step * step / (length * length * length);
            (folded / length, area, self.texels[(y + 1) * side + x + 1])
        })
    }

    /// The mean of two by two texels each.
    pub(super) fn halved(&self) -> Self {
        let side = self.size + 2;
        Self::bordered(self.size / 2, |x, y| {
            let first = (2 * y + 1) * side + 2 * x + 1;
            [0, 1, side, side + 1].into_iter().map(|step| self.texels[first + step]).sum::<Vec3>() * 0.25
        })
    }

    pub(super) fn byte_count(&self) -> usize {
        size_of_val(self.texels.as_slice())
    }
}

/// The light, or 0 if a number is not valid light.
pub(super) fn clean(pixel: [f32; 3]) -> Vec3 {
    Vec3::from(pixel.map(|channel| if channel > 0.0 && channel.is_finite() { channel } else { 0.0 }))
}

fn held(index: usize, size: usize) -> usize {
    if index < size { index } else { size - 1 }
}

/// The unit vector at the centre of a texel.
pub(super) fn direction(size: usize, x: usize, y: usize) -> Vec3 {
    folded(Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / size as f32).normalize()
}

/// The position of a direction in the unit square. Up is the middle, down the corners.
fn unfolded(direction: Vec3) -> Vec2 {
    let Vec3 { x, y, z } = direction / (direction.x.abs() + direction.y.abs() + direction.z.abs());
    let flat = if y >= 0.0 { Vec2::new(x, z) } else { over_the_edge(x, z) };
    let position = flat * 0.5 + 0.5;
    if position.is_finite() { position } else { Vec2::splat(0.5) }
}

/// The point of the octahedron at a position in the unit square.
fn folded(position: Vec2) -> Vec3 {
    let flat = position * 2.0 - 1.0;
    let y = 1.0 - flat.x.abs() - flat.y.abs();
    let flat = if y >= 0.0 { flat } else { over_the_edge(flat.x, flat.y) };
    Vec3::new(flat.x, y, flat.y)
}

fn over_the_edge(x: f32, z: f32) -> Vec2 {
    let signed = |value: f32, by: f32| if by >= 0.0 { value } else { -value };
    Vec2::new(signed(1.0 - z.abs(), x), signed(1.0 - x.abs(), z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_cover_the_sphere_once() {
        let map = Octahedral::from_function(32, |_| Vec3::ONE);
        let area: f32 = map.iter().map(|(_, area, _)| area).sum();
        let sphere = 4.0 * std::f32::consts::PI;
        assert!((area / sphere - 1.0).abs() < 2e-3, "{area}, not {sphere}");
    }

    #[test]
    fn light_is_found_where_it_was_put_and_without_seams() {
        let map = Octahedral::from_function(64, |direction| direction);
        for i in 0..500_u16 {
            // Directions all around, seams and corners of the square among them.
            let t = f32::from(i) * 0.37;
            let towards = Vec3::new(
                trigon_math::elementary::sin_f32(t * 1.7),
                trigon_math::elementary::sin_f32(t * 0.9) - 0.3,
                trigon_math::elementary::cos_f32(t * 2.3),
            )
            .normalize();
            let error = (map.at(towards) - towards).length();
            assert!(error < 0.02, "{} from {towards}", map.at(towards));
        }
        assert!((map.at(Vec3::NEG_Y) - Vec3::NEG_Y).length() < 0.03, "the corners are one point");
    }

    /// Beyond an edge of the square lies the same edge, reversed, and beyond a corner the opposite one.
    #[test]
    fn the_border_continues_across_the_fold() {
        for size in [2, 4, 5] {
            let texel = |x: usize, y: usize| Vec3::new(x as f32, y as f32, 1.0);
            let texels: Vec<Vec3> = (0..size * size).map(|i| texel(i % size, i / size)).collect();
            let map = Octahedral::from_texels(size, &texels);
            assert_eq!((map.size(), map.texels.len()), (size, (size + 2) * (size + 2)));
            let last = size - 1;
            // Columns and rows are counted from the border.
            let at = |column: usize, row: usize| map.texels[row * (size + 2) + column];
            for i in 0..size {
                assert_eq!(at(i + 1, 0), texel(last - i, 0), "above column {i} of {size}");
                assert_eq!(at(i + 1, size + 1), texel(last - i, last), "below column {i} of {size}");
                assert_eq!(at(0, i + 1), texel(0, last - i), "left of row {i} of {size}");
                assert_eq!(at(size + 1, i + 1), texel(last, last - i), "right of row {i} of {size}");
                (0..size).for_each(|x| assert_eq!(at(x + 1, i + 1), texel(x, i), "within"));
            }
            let corners = [at(0, 0), at(size + 1, 0), at(0, size + 1), at(size + 1, size + 1)];
            assert_eq!(corners, [texel(last, last), texel(0, last), texel(last, 0), texel(0, 0)]);
        }
    }

    #[test]
    fn a_smaller_map_has_the_means_of_four_texels() {
        let texels: Vec<Vec3> =
            (0..36).map(|i| Vec3::new((i * i) as f32, (7 * i % 11) as f32, 1.0)).collect();
        let halved = Octahedral::from_texels(6, &texels).halved();
        assert_eq!(halved.size(), 3);
        for (i, (_, _, found)) in halved.iter().enumerate() {
            let first = i / 3 * 12 + i % 3 * 2;
            let mean = (texels[first] + texels[first + 1] + texels[first + 6] + texels[first + 7]) / 4.0;
            assert_eq!(found, mean, "texel {i}");
        }
    }

    #[test]
    fn a_small_sun_keeps_its_light() {
        let (width, height) = (64, 32);
        let mut pixels = vec![[0.0; 3]; width * height];
        pixels[9 * width + 40] = [900.0, 600.0, f32::NAN];
        let map = Octahedral::from_equirectangular(16, width, height, &pixels);
        let light = map.iter().map(|(_, area, light)| light * area).sum::<Vec3>();
        // A pixel's rows are parts of half a turn, and its columns of a whole one.
        let polar = (9.5 / height as f32) * std::f32::consts::PI;
        let step = std::f32::consts::PI / height as f32;
        let area = step * step * trigon_math::elementary::sin_f32(polar);
        let expected = Vec3::new(900.0, 600.0, 0.0) * area;
        // Texels are no parts of pixels: a third of a texel more or less.
        assert!((light / expected).truncate().distance(Vec2::ONE) < 0.7, "{light}, not {expected}");
        assert_eq!(light.z, 0.0, "what is no light gives none");
    }

    /// The middles of its two pixels lie on the edge of the square, or a rounding error beside it.
    #[test]
    fn an_image_of_two_pixels_lights_each_half_in_its_color() {
        let (left, right) = (Vec3::new(3.0, 0.0, 1.0), Vec3::new(0.0, 2.0, 1.0));
        for size in [2, 4, 5, 8] {
            let map = Octahedral::from_equirectangular(size, 2, 1, &[left.to_array(), right.to_array()]);
            let mut counts = [0, 0];
            for (towards, _, light) in map.iter() {
                // Where both meet it is either.
                if towards.x.abs() > 1e-6 {
                    assert_eq!(light, if towards.x < 0.0 { left } else { right }, "{towards} of {size}");
                    counts[usize::from(towards.x > 0.0)] += 1;
                }
            }
            assert!(counts[0] == counts[1] && counts[0] >= size * (size - 1) / 2, "{counts:?} of {size}");
        }
    }
}
