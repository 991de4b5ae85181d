//! Pairs of alphas: exchanging the axes changes nothing but the direction in which azimuths count,
//! so that half the pairs are stored.

/// Row of a pair of indices, the lower first; and whether the pair was exchanged.
#[inline(always)]
pub fn pair(i: usize, j: usize) -> (usize, bool) {
    if i <= j {
        (j * (j + 1) / 2 + i, false)
    } else {
        (i * (i + 1) / 2 + j, true)
    }
}

/// Row of a pair and one of `count` azimuths, for tables by both.
#[inline(always)]
pub fn row(i: usize, j: usize, azimuth: usize, count: usize) -> usize {
    let (pair, exchanged) = pair(i, j);
    let azimuth = if exchanged {
        count - 1 - azimuth
    } else {
        azimuth
    };
    pair * count + azimuth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_has_a_row_of_its_own() {
        let mut seen = [0; 15];
        for i in 0..5 {
            for j in 0..5 {
                let (row, exchanged) = pair(i, j);
                assert_eq!((row, i > j), (pair(j, i).0, exchanged));
                seen[row] += 1;
            }
        }
        assert!(
            seen.iter().all(|&count| count == 1 || count == 2),
            "{seen:?}"
        );
        assert_eq!(row(1, 3, 2, 8), row(3, 1, 5, 8));
    }
}
