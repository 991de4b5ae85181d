// Pairs of alphas: exchanging the axes changes nothing but the direction in which azimuths count, so
// that half the pairs are stored.

/// Row of a pair of indices, in any order.
///
/// Twin: specula-bsdf/src/energy/pairs.rs, pair.
fn pairs_pair(i: u32, j: u32) -> u32 {
    let low = min(i, j);
    let high = max(i, j);
    return high * (high + 1u) / 2u + low;
}

/// Row of a pair and one of `count` azimuths, for tables by both.
///
/// Twin: specula-bsdf/src/energy/pairs.rs, row.
fn pairs_row(i: u32, j: u32, azimuth: u32, count: u32) -> u32 {
    return pairs_pair(i, j) * count + select(azimuth, count - 1u - azimuth, i > j);
}
