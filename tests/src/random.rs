//! Numbers that look random, for tests.

/// D. Knuth's generator for 64 bits (The Art of Computer Programming, 3.3.4). It is not `trigon_math::SplitMix64`, because these
/// tests judge the engine and use nothing of it but what they judge; the manifest's hashes follow from its numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number from `-reach` to `reach`.
    pub(crate) fn within(&mut self, reach: i32) -> i32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let span = 2 * reach as u64 + 1;
        ((self.0 >> 33) % span) as i32 - reach
    }
}
