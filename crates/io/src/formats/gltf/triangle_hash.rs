//! The hash of a mesh's triangles in a file: all accessors of all primitives, in a form that does not change
//! if a program only renumbers or moves them. It is XXH64 (Yann Collet, "xxHash fast digest algorithm",
//! specification 0.1.1).

use gltf::json::accessor::{ComponentType, Type};

/// The hash of an accessor: its format, and the hash of its elements' bytes.
pub(super) fn accessor_hash(
    component: ComponentType,
    kind: Type,
    normalized: bool,
    count: usize,
    elements: u64,
) -> u64 {
    let format = [component.as_gl_enum(), kind.multiplicity() as u32, u32::from(normalized)];
    let mut bytes: Vec<u8> = format.iter().flat_map(|word| word.to_le_bytes()).collect();
    bytes.extend((count as u64).to_le_bytes());
    bytes.extend(elements.to_le_bytes());
    xxh64(&bytes)
}

/// Collects the primitives of a mesh.
#[derive(Default)]
pub(super) struct TriangleHash {
    bytes: Vec<u8>,
}

impl TriangleHash {
    /// Begins the next primitive, with its OpenGL mode.
    pub(super) fn primitive(&mut self, mode: u32) {
        self.accessor("mode", u64::from(mode));
    }

    /// The next accessor of the primitive. Attributes come sorted by their names, then indices,
    /// then morph targets.
    pub(super) fn accessor(&mut self, name: &str, hash: u64) {
        self.bytes.extend((name.len() as u32).to_le_bytes());
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(hash.to_le_bytes());
    }

    /// The hash as stored in files.
    pub(super) fn finish(&self) -> String {
        format!("{:016x}", xxh64(&self.bytes))
    }
}

const PRIMES: [u64; 5] = [
    0x9e37_79b1_85eb_ca87,
    0xc2b2_ae3d_27d4_eb4f,
    0x1656_67b1_9e37_79f9,
    0x85eb_ca77_c2b2_ae63,
    0x27d4_eb2f_1656_67c5,
];

/// The hash of some bytes, with seed 0.
pub(super) fn xxh64(bytes: &[u8]) -> u64 {
    let (stripes, rest) = bytes.as_chunks::<32>();
    let mut hash = if stripes.is_empty() { PRIMES[4] } else { hash_stripes(stripes) };
    hash = hash.wrapping_add(bytes.len() as u64);
    let (words, rest) = rest.as_chunks::<8>();
    for word in words {
        hash ^= round(0, u64::from_le_bytes(*word));
        hash = hash.rotate_left(27).wrapping_mul(PRIMES[0]).wrapping_add(PRIMES[3]);
    }
    let (halves, rest) = rest.as_chunks::<4>();
    for half in halves {
        hash ^= u64::from(u32::from_le_bytes(*half)).wrapping_mul(PRIMES[0]);
        hash = hash.rotate_left(23).wrapping_mul(PRIMES[1]).wrapping_add(PRIMES[2]);
    }
    for &byte in rest {
        hash ^= u64::from(byte).wrapping_mul(PRIMES[4]);
        hash = hash.rotate_left(11).wrapping_mul(PRIMES[0]);
    }
    hash = (hash ^ hash >> 33).wrapping_mul(PRIMES[1]);
    hash = (hash ^ hash >> 29).wrapping_mul(PRIMES[2]);
    hash ^ hash >> 32
}

/// Four sums side by side, so that a processor need not wait for each product.
fn hash_stripes(stripes: &[[u8; 32]]) -> u64 {
    let mut sums = [PRIMES[0].wrapping_add(PRIMES[1]), PRIMES[1], 0, 0u64.wrapping_sub(PRIMES[0])];
    for stripe in stripes {
        let (words, _) = stripe.as_chunks::<8>();
        for (sum, word) in sums.iter_mut().zip(words) {
            *sum = round(*sum, u64::from_le_bytes(*word));
        }
    }
    let turned = [1, 7, 12, 18].iter().zip(sums).map(|(&bits, sum)| sum.rotate_left(bits));
    let hash = turned.fold(0u64, u64::wrapping_add);
    sums.iter()
        .fold(hash, |hash, &sum| (hash ^ round(0, sum)).wrapping_mul(PRIMES[0]).wrapping_add(PRIMES[3]))
}

fn round(sum: u64, word: u64) -> u64 {
    sum.wrapping_add(word.wrapping_mul(PRIMES[1])).rotate_left(31).wrapping_mul(PRIMES[0])
}

#[cfg(test)]
mod tests {
    use super::xxh64;

    /// From the reference implementation.
    #[test]
    fn known_hashes() {
        assert_eq!(xxh64(b""), 0xef46_db37_51d8_e999, "nothing");
        assert_eq!(xxh64(b"a"), 0xd24e_c4f1_a98c_6e5b, "a byte");
        assert_eq!(xxh64(b"abc"), 0x44bc_2cf5_ad77_0999, "three bytes");
        let pangram = b"Nobody inspects the spammish repetition";
        assert_eq!(xxh64(pangram), 0xfbce_a83c_8a37_8bf1, "more than a stripe");
    }

    #[test]
    fn every_byte_counts() {
        let bytes: Vec<u8> = (0..100).collect();
        let hash = xxh64(&bytes);
        for index in 0..bytes.len() {
            let mut other = bytes.clone();
            other[index] ^= 1;
            assert_ne!(xxh64(&other), hash, "byte {index}");
        }
    }
}
