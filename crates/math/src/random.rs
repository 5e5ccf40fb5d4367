//! Pseudorandom numbers that are the same on every machine.

/// SplitMix64: a 64-bit state that grows by a constant, and a mixing function.
///
/// G. L. Steele, D. Lea and C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014, with the
/// constants of S. Vigna's `splitmix64.c`. Every seed gives another sequence. Not for cryptography.
///
/// ```
/// let mut random = trigon_math::SplitMix64::new(7);
/// let die = 1 + random.below(6);
/// assert!((1..=6).contains(&die));
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64 {
    state: u64,
}

impl SplitMix64 {
    /// What the state grows by: 2⁶⁴ divided by the golden ratio, made odd.
    pub const INCREMENT: u64 = 0x9e37_79b9_7f4a_7c15;

    /// The sequence of a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub const fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(Self::INCREMENT);
        Self::mix(self.state)
    }

    /// The next number from 0 to below 1, a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        (self.next_u64() >> 11) as f64 * STEP
    }

    /// The next number from `low` to below `high`. Rounding may give `high` itself.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// The next integer from 0 to below `count`; 0 if `count` is 0. Smaller integers are more likely by at most
    /// `count` / 2⁶⁴.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next_u64() % count.max(1) as u64) as usize
    }

    /// A hash of 64 bits, by which each of them depends on all others: the generator's mixing function, a bijection that
    /// maps 0 to 0.
    #[must_use]
    pub const fn mix(word: u64) -> u64 {
        let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        word ^ (word >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_the_published_generator() {
        let mut random = SplitMix64::new(1_234_567);
        let numbers = [(); 3].map(|()| random.next_u64());
        let published = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(numbers, published, "the output of splitmix64.c for this seed");
    }

    #[test]
    fn fractions_are_the_upper_bits_of_the_numbers() {
        let (mut random, mut numbers) = (SplitMix64::new(1_234_567), SplitMix64::new(1_234_567));
        for _ in 0..1000 {
            let fraction = (numbers.next_u64() >> 11) as f64 / 9_007_199_254_740_992.0;
            let mut other = random.clone();
            assert_eq!(random.unit(), fraction, "of 53 bits");
            assert_eq!(other.between(-3.0, 5.0), -3.0 + 8.0 * fraction, "so far from the lower end");
        }
        let first = SplitMix64::new(1_234_567).below(1000);
        assert_eq!(first, 317, "the remainder of the first published number");
    }

    #[test]
    fn numbers_lie_in_their_ranges() {
        let mut random = SplitMix64::new(25);
        for _ in 0..1000 {
            assert!((0.0..1.0).contains(&random.unit()), "a unit");
            assert!((-3.0..5.0).contains(&random.between(-3.0, 5.0)), "between");
            assert!(random.below(7) < 7, "below");
        }
        assert_eq!([random.below(0), random.below(1)], [0, 0], "nothing to choose from");
    }
}
