//! Values of a row by selection: what keeps a loop over elements free of addresses that differ from element to element,
//! and so of loads that its stores might change.

use crate::math::Real;

/// `M` neighbouring values of a row, from `first` on, below 32.
///
/// One bit of `first` after the other halves what is left of the row.
#[inline(always)]
pub(super) fn neighbours<T: Real, const N: usize, const M: usize>(
    row: &[T; N],
    first: usize,
) -> [T; M] {
    const { assert!(N <= 32 && M <= N, "a longer row") };
    let mut values = *row;
    halve::<T, N, M, 16>(&mut values, first);
    halve::<T, N, M, 8>(&mut values, first);
    halve::<T, N, M, 4>(&mut values, first);
    halve::<T, N, M, 2>(&mut values, first);
    halve::<T, N, M, 1>(&mut values, first);
    let mut found = [T::ZERO; M];
    let mut i = 0;
    while i < M {
        found[i] = values[i];
        i += 1;
    }
    found
}

/// Moves the values by `STEP` where `first` has that bit. A plain loop of constant length, which is unrolled: a call or a
/// loop within a batch's loop would keep it from vectorising.
#[inline(always)]
fn halve<T: Real, const N: usize, const M: usize, const STEP: usize>(
    values: &mut [T; N],
    first: usize,
) {
    let is_beyond = first & STEP != 0;
    let mut i = 0;
    while i < STEP + M - 1 && i + STEP < N {
        values[i] = T::select(is_beyond, values[i + STEP], values[i]);
        i += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_of_a_row_is_met() {
        let row: [f32; 25] = core::array::from_fn(|i| i as f32);
        for first in 0..=21 {
            assert_eq!(
                neighbours::<_, 25, 4>(&row, first),
                [0, 1, 2, 3].map(|i| row[first + i])
            );
        }
        for first in 0..=23 {
            assert_eq!(
                neighbours::<_, 25, 2>(&row, first),
                [row[first], row[first + 1]]
            );
        }
        let short: [f32; 13] = core::array::from_fn(|i| row[i]);
        for first in 0..=11 {
            assert_eq!(
                neighbours::<_, 13, 2>(&short, first),
                [row[first], row[first + 1]]
            );
        }
    }
}
