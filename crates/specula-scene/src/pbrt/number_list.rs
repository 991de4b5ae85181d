//! Lists of numbers, which are most of the text of large scenes: read without tokens, long ones in parallel.

use rayon::prelude::*;

use crate::num::plain;

/// Bytes of text that are read at a time.
const BLOCK: usize = 1 << 16;

/// The numbers before the next `]`, and where that is. `None` where anything else is among them: reading word by
/// word tells what.
///
/// * `text`: what follows `[`.
/// * `integers`: whether numbers must be integers of 32 bits.
pub(super) fn read(text: &str, integers: bool) -> Option<(Vec<f64>, usize)> {
    let end = end(text.as_bytes())?;
    let list = &text[..end];
    if list.len() <= BLOCK {
        return numbers(list, integers).map(|numbers| (numbers, end));
    }
    let blocks: Option<Vec<Vec<f64>>> = blocks(list)
        .into_par_iter()
        .map(|block| numbers(block, integers))
        .collect();
    blocks.map(|blocks| (blocks.concat(), end))
}

/// The place of the first `]`; `None` where there is none, or what is in no list of numbers comes before it.
fn end(text: &[u8]) -> Option<usize> {
    let is_special = |b: u8| (b == b']') | (b == b'[') | (b == b'"') | (b == b'#');
    let has_special = |part: &&[u8]| part.iter().fold(false, |any, b| any | is_special(*b));
    // By parts, which the compiler turns into vectors.
    const PART: usize = 64;
    let part = text.chunks(PART).position(|part| has_special(&part))?;
    let within = text[PART * part..].iter().position(|b| is_special(*b))?;
    let end = PART * part + within;
    (text[end] == b']').then_some(end)
}

/// A list in parts of about [`BLOCK`] bytes, none of which ends within a number.
fn blocks(mut list: &str) -> Vec<&str> {
    let mut blocks = Vec::with_capacity(list.len() / BLOCK + 1);
    while list.len() > BLOCK {
        let rest = &list.as_bytes()[BLOCK..];
        let at = rest.iter().position(|b| is_space(*b));
        let (block, others) = list.split_at(at.map_or(list.len(), |at| BLOCK + at));
        blocks.push(block);
        list = others;
    }
    blocks.push(list);
    blocks
}

fn is_space(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\r' | b'\n')
}

fn numbers(text: &str, integers: bool) -> Option<Vec<f64>> {
    let bytes = text.as_bytes();
    // Few numbers of a mesh are shorter with their spaces.
    let mut numbers = Vec::with_capacity(text.len() / if integers { 4 } else { 8 } + 1);
    let mut at = 0;
    loop {
        while at < bytes.len() && is_space(bytes[at]) {
            at += 1;
        }
        if at == bytes.len() {
            return Some(numbers);
        }
        let whole = |length: &usize| bytes.get(at + length).is_none_or(|b| is_space(*b));
        let (x, end) = match plain(&bytes[at..]).filter(|(_, length)| whole(length)) {
            Some((x, length)) => (x, at + length),
            None => {
                let length = bytes[at..].iter().position(|b| is_space(*b));
                let end = length.map_or(bytes.len(), |length| at + length);
                (text[at..end].parse().ok()?, end)
            }
        };
        let is_valid = match integers {
            true => x.abs() <= f64::from(i32::MAX) && x.fract() == 0.0,
            false => x.abs() <= f64::from(f32::MAX),
        };
        if !is_valid {
            return None;
        }
        numbers.push(x);
        at = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::tests::random_numbers;

    /// Words of all sorts, as the standard library reads them, bit for bit.
    #[test]
    fn numbers_are_those_of_the_standard_library() {
        let mut words: Vec<String> = [
            "0",
            "-0",
            "0.0",
            "-.5",
            "5.",
            "007",
            "1e-3",
            "+4",
            "-2.5E+7",
            "9007199254740993",
            "9007199254740992",
            "0.30000000000000004",
            "123456789012345678",
            "1234567890123456789",
            "0.000000000000000001",
            "0.0000000000000000001",
            "3.4028234e38",
            "1e-400",
            "1e-45",
        ]
        .map(str::to_owned)
        .to_vec();
        words.extend(random_numbers());
        let text = words.join(" \n");
        assert!(text.len() > 3 * BLOCK);
        let (read, end) = read(&format!("{text}] 7"), false).unwrap();
        assert_eq!(end, text.len());
        assert_eq!(read.len(), words.len());
        for (x, word) in read.iter().zip(&words) {
            let expected: f64 = word.parse().unwrap();
            assert_eq!(x.to_bits(), expected.to_bits(), "{word}");
        }
    }

    #[test]
    fn what_is_no_list_of_numbers_is_left_to_others() {
        let long = "1 ".repeat(BLOCK);
        for bad in [
            "1 2", "1 x]", "1 [2]", "1 # 2\n]", "\"a\"]", ".]", "-]", "1e39]", "nan]", "inf]",
            "1_0]", "1\u{b}2]", "1.2.3]", "--1]",
        ] {
            assert_eq!(read(bad, false), None, "{bad}");
            let far = format!("{long}{bad}");
            assert_eq!(read(&far, false), None, "{bad} at the end of many");
        }
        for bad in ["1.5]", "2147483648]", "1e10]"] {
            assert_eq!(read(bad, true), None, "{bad}");
        }
        let good = "2147483647 -2147483647 3.0 1e3 -0]";
        let (integers, _) = read(good, true).unwrap();
        assert_eq!(integers, [2147483647.0, -2147483647.0, 3.0, 1000.0, 0.0]);
        assert_eq!(read(" \t\r\n]", true), Some((Vec::new(), 4)));
    }
}
