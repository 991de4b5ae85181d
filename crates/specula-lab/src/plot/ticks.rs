//! Ticks of axes: round numbers at even steps; on logarithmic axes decades, or 1, 2, 5 within few of them.

use super::Axis;
use crate::typeset::{MINUS, Place, Span};

/// Labelled ticks that an axis should have about.
const WANTED: f64 = 4.0;
/// Steps of angles, in degrees.
const ANGLES: [f64; 7] = [5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0];

/// An axis, ready to place numbers on it.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    /// From where to where.
    pub(super) range: [f64; 2],
    pub(super) logarithmic: bool,
    /// Values with their labels.
    pub(super) ticks: Vec<(f64, Vec<Span>)>,
    /// Values with a small tick and no label.
    pub(super) small: Vec<f64>,
}

impl Scale {
    /// * `data`: all that is to be seen; what is not above 0 is passed over on logarithmic axes.
    /// * `is_tight`: whether the axis ends with the data, not with a tick.
    pub(super) fn new(axis: &Axis, data: impl Iterator<Item = f64>, is_tight: bool) -> Self {
        let is_shown = |v: &f64| v.is_finite() && (!axis.logarithmic || *v > 0.0);
        let (mut low, mut high) = data
            .filter(is_shown)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            });
        if low > high {
            (low, high) = (1.0, 2.0);
        }
        if low == high {
            (low, high) = if axis.logarithmic {
                (0.5 * low, 2.0 * high)
            } else {
                (low - 0.5, high + 0.5)
            };
        }
        let fixed = axis.range.is_some() || is_tight;
        if let Some([a, b]) = axis.range {
            (low, high) = (a, b);
        }
        if axis.logarithmic {
            Self::logarithmic([low, high], fixed)
        } else {
            Self::linear([low, high], fixed, axis.label.contains("[deg]"))
        }
    }

    fn linear([mut low, mut high]: [f64; 2], fixed: bool, is_angle: bool) -> Self {
        let step = step(high - low, is_angle);
        if !fixed {
            low = step * (low / step + 1e-9).floor();
            high = step * (high / step - 1e-9).ceil();
        }
        let places = places(step);
        let first = (low / step - 1e-6).ceil();
        let count = ((high / step + 1e-6).floor() - first).max(0.0);
        let ticks = counted(count).map(|i| {
            let value = step * (first + i);
            let is_plain = (places < 4 && value.abs() < 1e5) || first + i == 0.0;
            let label = if is_plain {
                vec![number(value, places)]
            } else {
                scientific(value)
            };
            (value, label)
        });
        Self {
            range: [low, high],
            logarithmic: false,
            ticks: ticks.collect(),
            small: Vec::new(),
        }
    }

    fn logarithmic([mut low, mut high]: [f64; 2], fixed: bool) -> Self {
        if !fixed {
            low = below(low * (1.0 + 1e-9));
            high = above(high * (1.0 - 1e-9));
        }
        let decades = high.log10() - low.log10();
        let (mut values, mut small): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
        let every = (decades / 7.0).ceil().max(1.0);
        for (exponent, digit, value) in grid([low, high]) {
            let is_labelled = if decades > 2.2 {
                digit == 1.0 && exponent.rem_euclid(every) == 0.0
            } else {
                [1.0, 2.0, 5.0].contains(&digit)
            };
            if is_labelled {
                values.push(value);
            } else if every == 1.0 {
                small.push(value);
            }
        }
        // Within less than an octave there may be one such number, or none.
        if values.len() < 2 {
            let mut scale = Self::linear([low, high], true, false);
            scale.logarithmic = true;
            return scale;
        }
        let is_plain = values.iter().all(|v| (0.009..1001.0).contains(v));
        let ticks = values.iter().map(|&v| {
            let label = if is_plain {
                vec![plain(v)]
            } else {
                scientific(v)
            };
            (v, label)
        });
        Self {
            range: [low, high],
            logarithmic: true,
            ticks: ticks.collect(),
            small,
        }
    }

    /// Where a value is, 0 at the axis's beginning and 1 at its end.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        if self.logarithmic {
            (value / low).ln() / (high / low).ln()
        } else {
            (value - low) / (high - low)
        }
    }
}

/// 0, 1, ... up to `last`.
fn counted(last: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(0.0), |i| Some(i + 1.0)).take_while(move |i| *i <= last)
}

/// Digits 1 to 9 of all decades that are within a range: exponent, digit, value.
fn grid([low, high]: [f64; 2]) -> impl Iterator<Item = (f64, f64, f64)> {
    let (first, last) = (low.log10().floor(), high.log10().ceil());
    let all = counted(last - first).flat_map(move |i| {
        counted(8.0).map(move |d| (first + i, d + 1.0, (d + 1.0) * 10_f64.powf(first + i)))
    });
    all.filter(move |(.., v)| *v >= low * (1.0 - 1e-9) && *v <= high * (1.0 + 1e-9))
}

/// The largest of 1, 2, 5 times a power of ten that is at most `value`.
fn below(value: f64) -> f64 {
    let ten = 10_f64.powf(value.log10().floor());
    let mut digits = [5.0, 2.0, 1.0].into_iter();
    ten * digits.find(|d| d * ten <= value).unwrap_or(1.0)
}

/// The smallest such number that is at least `value`.
fn above(value: f64) -> f64 {
    let ten = 10_f64.powf(value.log10().floor());
    let mut digits = [1.0, 2.0, 5.0].into_iter();
    ten * digits.find(|d| d * ten >= value).unwrap_or(10.0)
}

/// A step of 1, 2 or 5 times a power of ten, of angles one of [`ANGLES`].
fn step(extent: f64, is_angle: bool) -> f64 {
    let rough = extent / WANTED;
    if is_angle && rough > 4.0 {
        let near = |a: &f64| (a / rough).ln().abs();
        let nearest = ANGLES
            .into_iter()
            .min_by(|a, b| near(a).total_cmp(&near(b)));
        return nearest.unwrap_or(90.0);
    }
    let ten = 10_f64.powf(rough.log10().floor());
    let digit = [1.0, 2.0, 5.0, 10.0].into_iter().min_by(|a, b| {
        (a * ten / rough)
            .ln()
            .abs()
            .total_cmp(&(b * ten / rough).ln().abs())
    });
    ten * digit.unwrap_or(1.0)
}

/// Decimals that multiples of a step need.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small and not below 0"
)]
fn places(step: f64) -> usize {
    (-(step * 1.000_001).log10().floor()).max(0.0) as usize
}

fn number(value: f64, places: usize) -> Span {
    let text = format!("{value:.places$}");
    let is_zero = value.abs() < 0.5 * 10_f64.powi(-i32::try_from(places).unwrap_or(0));
    Span {
        text: if is_zero {
            "0".to_owned()
        } else {
            text.replace('-', &MINUS.to_string())
        },
        place: Place::Line,
    }
}

/// One digit of any size.
fn plain(value: f64) -> Span {
    number(value, places(value))
}

/// `10^3`, `2 x 10^3`.
fn scientific(value: f64) -> Vec<Span> {
    let exponent = (value.abs() * 1.000_001).log10().floor();
    let digit = value / 10_f64.powf(exponent);
    let ten = if (digit - 1.0).abs() < 1e-6 {
        "10".to_owned()
    } else {
        let places = usize::from((digit - digit.round()).abs() > 1e-6);
        number(digit, places).text + "\u{b7}10"
    };
    vec![
        Span {
            text: ten,
            place: Place::Line,
        },
        Span {
            text: number(exponent, 0).text,
            place: Place::Above,
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, data: [f64; 2]) -> Vec<String> {
        let scale = Scale::new(axis, data.into_iter(), false);
        let label = |spans: &Vec<Span>| -> String {
            let text = |s: &Span| match s.place {
                Place::Above => format!("^{}", s.text),
                _ => s.text.clone(),
            };
            spans.iter().map(text).collect()
        };
        scale.ticks.iter().map(|t| label(&t.1)).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_even() {
        let axis = Axis::linear("x");
        for (data, expected) in [
            ([0.0, 1.0], &["0", "0.2", "0.4", "0.6", "0.8", "1.0"][..]),
            ([0.02, 0.36], &["0", "0.1", "0.2", "0.3", "0.4"]),
            ([-2.0, 3.0], &["\u{2212}2", "\u{2212}1", "0", "1", "2", "3"]),
            ([1.0, 16.0], &["0", "5", "10", "15", "20"]),
            (
                [0.0, 4e-5],
                &[
                    "0",
                    "10^\u{2212}5",
                    "2\u{b7}10^\u{2212}5",
                    "3\u{b7}10^\u{2212}5",
                    "4\u{b7}10^\u{2212}5",
                ],
            ),
        ] {
            assert_eq!(labels(&axis, data), expected, "{data:?}");
        }
        let angle = Axis::linear("theta_o [deg]").from_to(0.0, 90.0);
        assert_eq!(labels(&angle, [0.0, 1.0]), ["0", "30", "60", "90"]);
        let turn = Axis::linear("azimuth [deg]").from_to(0.0, 360.0);
        assert_eq!(labels(&turn, [0.0, 1.0]), ["0", "90", "180", "270", "360"]);
    }

    #[test]
    fn logarithmic_ticks_are_decades_or_1_2_5() {
        let axis = Axis::logarithmic("x");
        for (data, expected) in [
            ([0.01, 100.0], &["0.01", "0.1", "1", "10", "100"][..]),
            (
                [1e-7, 1e-3],
                &[
                    "10^\u{2212}7",
                    "10^\u{2212}6",
                    "10^\u{2212}5",
                    "10^\u{2212}4",
                    "10^\u{2212}3",
                ],
            ),
            ([0.08, 0.9], &["0.05", "0.1", "0.2", "0.5", "1"]),
            (
                [2e-5, 9e-4],
                &[
                    "2\u{b7}10^\u{2212}5",
                    "5\u{b7}10^\u{2212}5",
                    "10^\u{2212}4",
                    "2\u{b7}10^\u{2212}4",
                    "5\u{b7}10^\u{2212}4",
                    "10^\u{2212}3",
                ],
            ),
            ([1.0, 1024.0], &["1", "10", "100", "1000"]),
        ] {
            assert_eq!(labels(&axis, data), expected, "{data:?}");
        }
        // Many decades: every second or third.
        let many = labels(&axis, [1e-20, 1.0]);
        assert!((5..=8).contains(&many.len()), "{many:?}");
        // Less than an octave.
        let few = labels(&axis.clone().from_to(0.105, 0.14), [0.1, 0.2]);
        assert!(few.len() >= 3, "{few:?}");
    }

    /// Whatever the range: labels at even steps, neither crowded nor missing.
    #[test]
    fn ticks_are_even_and_not_crowded() {
        for (i, logarithmic) in (0..400).zip([false, true].into_iter().cycle()) {
            let low = 10_f64.powf(f64::from(i % 23) - 11.0) * (1.0 + f64::from(i % 7));
            let high = low * (1.05 + f64::from(i % 19).powi(2));
            let axis = Axis {
                logarithmic,
                ..Axis::linear("x")
            };
            let scale = Scale::new(&axis, [low, high].into_iter(), false);
            let places: Vec<f64> = scale.ticks.iter().map(|t| scale.place(t.0)).collect();
            assert!((2..=12).contains(&places.len()), "{low} {high}: {places:?}");
            let gaps = places.windows(2).map(|w| w[1] - w[0]);
            let (least, most) =
                gaps.fold((f64::INFINITY, 0.0_f64), |(l, m), g| (l.min(g), m.max(g)));
            // From 2 to 5 it is 1.32 as far as from 1 to 2.
            let bound = if logarithmic { 1.7 } else { 1.01 };
            assert!(most < bound * least, "{low} {high}: {places:?}");
            let is_within = |v: f64| (-1e-6..=1.0 + 1e-6).contains(&v);
            assert!(places.iter().all(|p| is_within(*p)) && is_within(scale.place(low)));
        }
    }

    #[test]
    fn what_cannot_be_shown_is_passed_over() {
        let axis = Axis::logarithmic("x");
        let scale = Scale::new(&axis, [0.0, -1.0, f64::NAN, 3.0].into_iter(), false);
        assert!(
            scale.range[0] > 0.0 && scale.range[1].is_finite(),
            "{scale:?}"
        );
        let nothing = Scale::new(&Axis::linear("x"), std::iter::empty(), false);
        assert!(nothing.ticks.len() > 1, "{nothing:?}");
    }
}
