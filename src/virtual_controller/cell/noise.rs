//! Numbers that look random and follow from a seed and a place alone (SplitMix64): the same on every machine and in every
//! order of asking.

/// 64 bits for this seed and place.
pub(super) const fn bits(seed: u64, place: u64) -> u64 {
    let mut z = seed.wrapping_add(place.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A number from 0 (included) to 1 (not included).
pub(super) fn unit(seed: u64, place: u64) -> f64 {
    (bits(seed, place) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A number from −1 to 1.
pub(super) fn signed(seed: u64, place: u64) -> f64 {
    unit(seed, place) * 2.0 - 1.0
}

/// Another seed, for another use.
pub(super) const fn branch(seed: u64, use_: u64) -> u64 {
    bits(seed ^ 0x6A09_E667_F3BC_C909, use_)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_spread_over_their_range() {
        let mean = (0..10_000).map(|place| unit(7, place)).sum::<f64>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.02, "{mean}");
        assert!((0..10_000).all(|place| (-1.0..1.0).contains(&signed(7, place))));
        assert_ne!(unit(7, 1), unit(branch(7, 0), 1));
    }
}
