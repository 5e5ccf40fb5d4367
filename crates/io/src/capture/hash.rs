//! The hash of captures: FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits. It detects accidents,
//! not forgeries.

pub(super) fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::fnv1a;

    #[test]
    fn the_authors_test_vectors_hold() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325, "the offset basis");
        assert_eq!(fnv1a(b"foobar"), 0x8594_4171_f739_67e8, "from their page");
    }
}
