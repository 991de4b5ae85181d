//! Typesetting of texts of plots and pages: Greek letters for their names, subscripts, exponents, minus and
//! multiplication signs.
//!
//! Sources and records say `theta_o [deg]`, `1.2e-5` and `+-`, which every terminal shows and every search
//! finds.

/// A run of text on one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) text: String,
    pub(crate) place: Place,
}

/// Where a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    Line,
    Below,
    Above,
}

/// Words for symbols.
const SYMBOLS: [(&str, char); 8] = [
    ("alpha", '\u{3b1}'),
    ("theta", '\u{3b8}'),
    ("phi", '\u{3c6}'),
    ("eta", '\u{3b7}'),
    ("sigma", '\u{3c3}'),
    ("rho", '\u{3c1}'),
    ("mu", '\u{3bc}'),
    ("pi", '\u{3c0}'),
];
pub(crate) const MINUS: char = '\u{2212}';
const TIMES: char = '\u{d7}';
/// Digits and minus above the line.
const ABOVE: [(char, char); 11] = [
    ('0', '\u{2070}'),
    ('1', '\u{b9}'),
    ('2', '\u{b2}'),
    ('3', '\u{b3}'),
    ('4', '\u{2074}'),
    ('5', '\u{2075}'),
    ('6', '\u{2076}'),
    ('7', '\u{2077}'),
    ('8', '\u{2078}'),
    ('9', '\u{2079}'),
    (MINUS, '\u{207b}'),
];
/// Letters below the line; there are no others that we need.
const BELOW: [(char, char); 2] = [('o', '\u{2092}'), ('i', '\u{1d62}')];

/// The text in runs, for what can set them above and below the line.
pub(crate) fn spans(text: &str) -> Vec<Span> {
    let mut setter = Setter::new(text);
    while setter.step() {}
    setter.spans
}

/// The text in one run, with characters that stand above and below the line where there are such.
pub(crate) fn prose(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for Span { text, place } in spans(text) {
        let (table, mark): (&[(char, char)], char) = match place {
            Place::Line => (&[], ' '),
            Place::Below => (&BELOW, '_'),
            Place::Above => (&ABOVE, '^'),
        };
        let of = |c: char| table.iter().find(|t| t.0 == c).map(|t| t.1);
        match text.chars().map(of).collect::<Option<String>>() {
            Some(small) if place != Place::Line => line += &small,
            _ => {
                if place != Place::Line {
                    line.push(mark);
                }
                line += &text;
            }
        }
    }
    line
}

/// Walks over a text.
struct Setter<'a> {
    text: &'a str,
    at: usize,
    spans: Vec<Span>,
}

impl<'a> Setter<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            text,
            at: 0,
            spans: Vec::new(),
        }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn before(&self) -> Option<char> {
        self.text[..self.at].chars().next_back()
    }

    fn push(&mut self, text: &str, place: Place) {
        match self.spans.last_mut() {
            Some(last) if last.place == place => last.text += text,
            _ => self.spans.push(Span {
                text: text.to_owned(),
                place,
            }),
        }
    }

    /// Takes so many bytes, and puts `text` there.
    fn take(&mut self, bytes: usize, text: &str) {
        self.at += bytes;
        self.push(text, Place::Line);
    }

    /// Goes on by a word, a number or a character; whether there was one.
    fn step(&mut self) -> bool {
        let rest = self.rest();
        let Some(first) = rest.chars().next() else {
            return false;
        };
        let begins = !self
            .before()
            .is_some_and(|c| c.is_alphanumeric() || c == '_');
        if first == '`' {
            // Code is as it is.
            let end = rest[1..].find('`').map_or(rest.len(), |n| n + 2);
            self.take(end, &rest[..end]);
        } else if first.is_ascii_alphabetic() && begins {
            self.word();
        } else if first.is_ascii_digit() && begins {
            self.number();
        } else if let Some((bytes, sign)) = sign(rest, self.before()) {
            self.take(bytes, &sign.to_string());
        } else if first == '^' && power(&rest[1..]).is_some() {
            let digits = power(&rest[1..]).unwrap_or_default();
            self.at += 1 + digits.len();
            self.push(&digits.replace('-', &MINUS.to_string()), Place::Above);
        } else {
            self.take(first.len_utf8(), &rest[..first.len_utf8()]);
        }
        true
    }

    fn word(&mut self) {
        let rest = self.rest();
        let end = length(rest, |c| c.is_ascii_alphabetic());
        let (word, after) = rest.split_at(end);
        let stands_alone = !after.starts_with(|c: char| c.is_ascii_digit());
        let symbol = SYMBOLS
            .iter()
            .find(|s| s.0 == word)
            .filter(|_| stands_alone);
        let digit_space = self.text[..self.at]
            .strip_suffix(' ')
            .is_some_and(|t| t.ends_with(|c: char| c.is_ascii_digit()));
        if let Some((_, letter)) = symbol {
            self.take(end, &letter.to_string());
            self.index();
        } else if word == "deg" && digit_space && !after.starts_with('_') {
            if let Some(last) = self.spans.last_mut() {
                last.text.pop();
            }
            self.take(end, "\u{b0}");
        } else if word == "deg" && self.before() == Some('[') {
            self.take(end, "\u{b0}");
        } else if word == "us" && self.before() == Some('[') {
            self.take(end, "\u{b5}s");
        } else if word == "x" && self.is_product(after) {
            self.take(end, &TIMES.to_string());
        } else {
            self.take(end, word);
            if end == 1 {
                self.index();
            }
        }
    }

    /// Whether an `x` that stands alone multiplies.
    fn is_product(&self, after: &str) -> bool {
        let before = &self.text[..self.at];
        let Some(next) = after.strip_prefix(' ') else {
            return false;
        };
        let number = |c: char| c.is_ascii_digit() || c == ')' || c == '%';
        let behind_number = before
            .strip_suffix(' ')
            .is_some_and(|b| b.ends_with(number));
        behind_number
            || next.starts_with("time")
            || next.starts_with(|c: char| c.is_ascii_digit() || c == '(')
    }

    /// `_o` behind a symbol.
    fn index(&mut self) {
        let Some(after) = self.rest().strip_prefix('_') else {
            return;
        };
        let end = length(after, |c| c.is_ascii_alphanumeric());
        if end > 0 {
            self.at += 1 + end;
            self.push(&after[..end], Place::Below);
        }
    }

    /// A number, with its power of ten where it has one.
    fn number(&mut self) {
        let rest = self.rest();
        let whole = length(rest, |c| c.is_ascii_digit());
        let fraction = rest[whole..]
            .strip_prefix('.')
            .map_or(0, |f| length(f, |c| c.is_ascii_digit()));
        let end = whole + if fraction > 0 { fraction + 1 } else { 0 };
        let (mantissa, after) = rest.split_at(end);
        match after.strip_prefix('e').and_then(power) {
            Some(exponent) => {
                let ten = if mantissa == "1" {
                    "10".to_owned()
                } else {
                    format!("{mantissa} {TIMES} 10")
                };
                self.take(end + 1 + exponent.len(), &ten);
                self.push(&exponent.replace('-', &MINUS.to_string()), Place::Above);
            }
            None => self.take(end, mantissa),
        }
    }
}

/// How many bytes of a text are of such characters.
fn length(text: &str, is_part: impl Fn(char) -> bool) -> usize {
    text.find(|c| !is_part(c)).unwrap_or(text.len())
}

/// A whole number that nothing but punctuation follows.
fn power(text: &str) -> Option<&str> {
    let sign = usize::from(text.starts_with('-'));
    let end = sign + length(&text[sign..], |c| c.is_ascii_digit());
    let after = &text[end..];
    let is_whole = !after.starts_with(|c: char| c.is_alphanumeric() || c == '_')
        && !after
            .strip_prefix('.')
            .is_some_and(|a| a.starts_with(|c: char| c.is_ascii_digit()));
    (end > sign && is_whole).then(|| &text[..end])
}

/// A sign that begins a text, and its bytes there.
fn sign(text: &str, before: Option<char>) -> Option<(usize, char)> {
    let mut signs = [("+-", '\u{b1}'), ("<=", '\u{2264}'), (">=", '\u{2265}')].into_iter();
    if let Some((from, to)) = signs.find(|s| text.starts_with(s.0)) {
        return Some((from.len(), to));
    }
    let number = text.strip_prefix('-')?;
    let is_number = number.starts_with(|c: char| c.is_ascii_digit());
    let is_apart = before.is_none_or(|c| " ([,=".contains(c));
    (is_number && is_apart).then_some((1, MINUS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_has_signs_and_symbols() {
        for (from, to) in [
            ("theta_o [deg]", "θₒ [°]"),
            (
                "alpha = (0.5, 1), theta_i = 60 deg",
                "α = (0.5, 1), θᵢ = 60°",
            ),
            ("alpha_y = 0.1", "α_y = 0.1"),
            ("variance x time [ns/sr^2]", "variance × time [ns/sr²]"),
            ("at most 1.2e-5, 1e-12", "at most 1.2 × 10⁻⁵, 10⁻¹²"),
            ("from -3 to [-0.5, 2] +- 0.1", "from −3 to [−0.5, 2] ± 0.1"),
            ("x 0.93 of 16 x 16", "× 0.93 of 16 × 16"),
            ("along x and y, x axis", "along x and y, x axis"),
            (
                "bounces^1.09, 1-2, two-sided",
                "bounces^1.09, 1-2, two-sided",
            ),
            (
                "by alphabet, beta_alpha, alpha2",
                "by alphabet, beta_alpha, alpha2",
            ),
            ("`alpha 1e-3` is alpha 1e-3", "`alpha 1e-3` is α 10⁻³"),
            (
                "tokuyoshi24-fig5, 0x1e5, v1e",
                "tokuyoshi24-fig5, 0x1e5, v1e",
            ),
            ("time [us], 5 degrees", "time [µs], 5 degrees"),
            ("p <= 0.05", "p ≤ 0.05"),
            ("10^-3 and 10^4", "10⁻³ and 10⁴"),
        ] {
            assert_eq!(prose(from), to);
        }
    }

    #[test]
    fn runs_stand_above_and_below() {
        let found = spans("alpha_x^2 5e-3");
        let rows: Vec<(&str, Place)> = found.iter().map(|s| (s.text.as_str(), s.place)).collect();
        assert_eq!(
            rows,
            [
                ("α", Place::Line),
                ("x", Place::Below),
                ("2", Place::Above),
                (" 5 × 10", Place::Line),
                ("−3", Place::Above),
            ]
        );
    }
}
