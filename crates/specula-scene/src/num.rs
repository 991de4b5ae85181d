//! Numbers: from text, and narrowed.

/// The nearest `f32`. The readers accept no number beyond `f32::MAX`, so that no infinity arises.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to f32 is what this function is for"
)]
pub(crate) fn f32_of(x: f64) -> f32 {
    x as f32
}

/// Powers of ten that `f64` holds exactly, as far as needed.
const POWERS: [f64; 19] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18,
];

/// The number that a text begins with and its length, where it has few digits; an exponent may follow. `None` for
/// others.
///
/// Its digits and the power of ten are exact in `f64`, so that one division rounds correctly (Clinger 1990).
pub(crate) fn plain(text: &[u8]) -> Option<(f64, usize)> {
    const MOST_DIGITS: usize = POWERS.len() - 1;
    const MOST: u64 = 1 << 53;
    let sign = usize::from(text.first() == Some(&b'-'));
    let (mut value, mut at) = (0_u64, sign);
    let digits = |value: &mut u64, at: &mut usize| {
        let first = *at;
        while let Some(digit) = text.get(*at).map(|b| b.wrapping_sub(b'0'))
            && digit < 10
        {
            *value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
            *at += 1;
        }
        *at - first
    };
    let whole = digits(&mut value, &mut at);
    let mut decimals = 0;
    if text.get(at) == Some(&b'.') {
        at += 1;
        decimals = digits(&mut value, &mut at);
    }
    // So many digits do not wrap around.
    let is_exact = (1..=MOST_DIGITS).contains(&(whole + decimals)) && value <= MOST;
    if !is_exact {
        return None;
    }
    let x = value as f64 / POWERS[decimals];
    Some((if sign == 1 { -x } else { x }, at))
}

/// A word as the nearest number, which [`str::parse`] gives too, but later.
pub(crate) fn parsed(word: &[u8]) -> Option<f64> {
    match plain(word) {
        Some((x, length)) if length == word.len() => Some(x),
        _ => std::str::from_utf8(word).ok()?.parse().ok(),
    }
}

/// A word as the nearest `f32`.
pub(crate) fn parsed_f32(word: &[u8]) -> Option<f32> {
    /// The bits of `f64` that `f32` lacks, and those of a number in the middle between two.
    const LOST: u64 = (1 << 29) - 1;
    const HALF: u64 = 1 << 28;
    match plain(word) {
        // Rounding twice is rounding once, unless the first result is such a middle.
        Some((x, length)) if length == word.len() && x.to_bits() & LOST != HALF => Some(f32_of(x)),
        _ => std::str::from_utf8(word).ok()?.parse().ok(),
    }
}

/// The beginning of a word that is no number, with everything odd in it escaped, for messages.
pub(crate) fn shortened(word: &[u8]) -> String {
    String::from_utf8_lossy(&word[..word.len().min(40)])
        .escape_debug()
        .to_string()
}

/// At most 40 characters of a text, none of them a control character, for messages.
pub(crate) fn shorten(text: &str) -> String {
    let mut short: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Numbers as text with up to 17 decimals, and in scientific notation.
    pub(crate) fn random_numbers() -> impl Iterator<Item = String> {
        let mut state = 1_u64;
        (0..20_000).flat_map(move |i| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(99);
            let x = (state >> 32) as f64 / 1e6 - 2e3;
            [format!("{x:.*}", i % 18), format!("{:e}", x * 1e-9)]
        })
    }

    #[test]
    fn words_are_read_as_the_standard_library_does() {
        let mut words: Vec<String> = [
            "0",
            "-0",
            "-.5",
            "5.",
            "007",
            "1e-3",
            "+4",
            "9007199254740993",
            "16777217",
            "16777219",
            "1.00000005960464477",
            "1.000000059604644775",
            "0.50000002980232239",
            "3.4028235e38",
            "3.4028236e38",
            "1e-45",
            "",
            "-",
            ".",
            "1.2.3",
            "1_0",
            "nan",
            "inf",
            "12x",
            "1e",
        ]
        .map(str::to_owned)
        .to_vec();
        words.extend(random_numbers());
        for word in &words {
            let bits = |x: Option<f64>| x.map(f64::to_bits);
            let expected = bits(word.parse().ok());
            assert_eq!(bits(parsed(word.as_bytes())), expected, "{word}");
            let bits = |x: Option<f32>| x.map(f32::to_bits);
            let expected = bits(word.parse().ok());
            assert_eq!(bits(parsed_f32(word.as_bytes())), expected, "{word}");
        }
    }
}
