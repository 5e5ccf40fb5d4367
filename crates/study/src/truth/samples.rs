//! Where the rays of a pixel lie: the first two dimensions of Sobol's sequence (I. Sobol', 1967), which put one point into each of
//! 2ⁿ equal rectangles of every shape, for each power of two. The digits are turned at random from pixel to pixel (T. Kollig
//! and A. Keller, "Efficient Multidimensional Sampling", 2002), which keeps that property and lets no pattern arise.

use trigon_math::DVec2;

/// The rays of one pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Samples {
    /// The digits that are turned: of the position in the pixel, and of a direction.
    turned: [u32; 4],
}

impl Samples {
    /// Those of a pixel; another seed gives other rays.
    pub(super) fn new(pixel: u64, seed: u64) -> Self {
        let mut state = pixel.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ seed.wrapping_mul(0xd1b5_4a32_d192_ed03);
        Self { turned: [(); 4].map(|()| (mixed(&mut state) >> 32) as u32) }
    }

    /// The position of a ray in its pixel, from 0 to 1.
    pub(super) fn position(&self, sample: u32) -> DVec2 {
        let [x, y] = [sample.reverse_bits(), second(sample)];
        DVec2::new(unit(x ^ self.turned[0]), unit(y ^ self.turned[1]))
    }

    /// Two numbers from 0 to 1 for a direction.
    pub(super) fn direction(&self, number: u32) -> [f64; 2] {
        [unit(number.reverse_bits() ^ self.turned[2]), unit(second(number) ^ self.turned[3])]
    }
}

/// The next of a sequence of random numbers (G. Steele, D. Lea and C. Flood, "Fast Splittable Pseudorandom Number Generators",
/// 2014).
pub(super) fn mixed(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// The second dimension: its matrix is Pascal's triangle modulo 2.
fn second(sample: u32) -> u32 {
    let (mut column, mut left, mut sum) = (1_u32 << 31, sample, 0);
    while left != 0 {
        if left & 1 != 0 {
            sum ^= column;
        }
        (left, column) = (left >> 1, column ^ (column >> 1));
    }
    sum
}

/// In the middle of a step of 2⁻³².
fn unit(digits: u32) -> f64 {
    (f64::from(digits) + 0.5) / 4_294_967_296.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rectangle_of_a_power_of_two_has_one_ray() {
        let samples = Samples::new(7, 3);
        for bits in 0..=8_u32 {
            for across in 0..=bits {
                let sides = [1_u32 << across, 1_u32 << (bits - across)];
                let mut met = vec![false; 1 << bits];
                for sample in 0..1_u32 << bits {
                    let at = samples.position(sample);
                    let [x, y] = [at.x * f64::from(sides[0]), at.y * f64::from(sides[1])];
                    met[(y as u32 * sides[0] + x as u32) as usize] = true;
                }
                assert!(met.iter().all(|&met| met), "{sides:?}");
            }
        }
    }

    #[test]
    fn pixels_have_rays_of_their_own() {
        let [one, next] = [1, 2].map(|pixel| Samples::new(pixel, 0).position(0));
        assert!((one - next).length() > 0.01, "{one} and {next}");
        let directions = (0..256).map(|sample| Samples::new(1, 0).direction(sample));
        let mean = directions.fold([0.0; 2], |sum, [x, y]| [sum[0] + x / 256.0, sum[1] + y / 256.0]);
        assert!(mean.iter().all(|mean| (mean - 0.5).abs() < 0.05), "evenly: {mean:?}");
    }
}
