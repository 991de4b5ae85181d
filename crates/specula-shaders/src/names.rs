//! Names that are spelt nearly like another one, for messages.

/// Those of `names` that are spelt nearly like `wanted`, nearest first, three at most.
pub(crate) fn nearest<'a>(wanted: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let farthest = (wanted.chars().count() / 3).max(1);
    let mut near: Vec<(usize, &str)> = names
        .into_iter()
        .filter_map(|name| {
            let begins = wanted.len() > 2 && name.starts_with(wanted);
            let distance = if begins { 0 } else { distance(wanted, name) };
            (distance <= farthest).then_some((distance, name))
        })
        .collect();
    near.sort_unstable();
    near.truncate(3);
    near.into_iter().map(|(_, name)| name).collect()
}

/// Fewest characters to insert, remove or replace to make `a` of `b` (Levenshtein 1966).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        for (a, b, expected) in [
            ("", "", 0),
            ("", "abc", 3),
            ("ggx", "gxg", 2),
            ("kitten", "sitting", 3),
        ] {
            assert_eq!(distance(a, b), expected, "{a} {b}");
            assert_eq!(distance(b, a), expected, "{b} {a}");
        }
    }

    #[test]
    fn the_nearest_come_first() {
        let names = ["bounded", "bsdf", "beckmann", "rounded", "ggx"];
        assert_eq!(nearest("boundet", names), ["bounded", "rounded"]);
        assert_eq!(nearest("beck", names), ["beckmann"]);
        assert_eq!(nearest("GGX", names), [""; 0]);
    }
}
