//! Maps: a colour for each cell, and the bar that says what the colours mean.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::canvas::{Anchor, Canvas, INK, width};
use super::ticks::Scale;
use super::{Axis, Frame, Map, TICK_SIZE};

/// Width of the bar of colours, and its distance from the map.
const BAR: f64 = 12.0;
const GAP: f64 = 10.0;
/// Colours that are told apart.
const SHADES: u16 = 128;

impl Map {
    /// The values of the darkest and the brightest colour.
    pub(super) fn scale(&self) -> Scale {
        let axis = Axis {
            range: self.range,
            ..Axis::linear("")
        };
        Scale::new(&axis, self.rows.iter().flatten().copied(), true)
    }

    /// Room that the bar with its numbers takes beside the map.
    pub(super) fn room(&self) -> f64 {
        let ticks = self.scale().ticks;
        let widest = ticks
            .iter()
            .map(|t| width(&t.1, TICK_SIZE))
            .fold(0.0, f64::max);
        let label = if self.label.is_empty() { 0.0 } else { 18.0 };
        GAP + BAR + 6.0 + widest + label
    }
}

/// Draws the cells where the axes have them, and the bar.
pub(super) fn draw(canvas: &mut Canvas, frame: &Frame, [x, y]: [&Scale; 2], map: &Map) {
    let scale = map.scale();
    let mut shades: BTreeMap<u16, String> = BTreeMap::new();
    let rows = map.rows.len().max(1) as f64;
    for (row, values) in map.rows.iter().enumerate() {
        let columns = values.len().max(1) as f64;
        let edge = |range: [f64; 2], scale: &Scale, i: usize, n: f64| {
            scale.place(range[0] + (range[1] - range[0]) * i as f64 / n)
        };
        // Cells of one shade side by side are one rectangle.
        let mut begin = 0;
        while begin < values.len() {
            let shade = shade(scale.place(values[begin]));
            let same = values[begin..]
                .iter()
                .take_while(|v| self::shade(scale.place(**v)) == shade);
            let end = begin + same.count();
            if let Some(shade) = shade {
                let [left, bottom] =
                    frame.point([edge(map.x, x, begin, columns), edge(map.y, y, row, rows)]);
                let [right, top] =
                    frame.point([edge(map.x, x, end, columns), edge(map.y, y, row + 1, rows)]);
                let _ = write!(
                    shades.entry(shade).or_default(),
                    "M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z"
                );
            }
            begin = end;
        }
    }
    for (shade, d) in shades {
        let colour = colour(f64::from(shade) / f64::from(SHADES - 1));
        canvas.raw(&format!(
            "<path d=\"{d}\" fill=\"{colour}\" shape-rendering=\"crispEdges\"/>"
        ));
    }
    bar(canvas, frame, map, &scale);
}

/// Which of the shades; what lies beyond has the last. `None` where there is no value.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped before"
)]
fn shade(place: f64) -> Option<u16> {
    let last = f64::from(SHADES - 1);
    place
        .is_finite()
        .then(|| (place.clamp(0.0, 1.0) * last).round() as u16)
}

fn bar(canvas: &mut Canvas, frame: &Frame, map: &Map, scale: &Scale) {
    let left = frame.right() + GAP;
    let height = frame.size[1] / f64::from(SHADES);
    for shade in 0..SHADES {
        let share = f64::from(shade) / f64::from(SHADES - 1);
        let top = frame.bottom() - height * f64::from(shade + 1);
        let style = format!("fill=\"{}\"", colour(share));
        // A little more than its height, so that no gap shows.
        canvas.rectangle([left, top], [BAR, height + 0.4], &style);
    }
    canvas.rectangle(
        [left, frame.at[1]],
        [BAR, frame.size[1]],
        &format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"0.8\""),
    );
    for (value, label) in &scale.ticks {
        let [_, height] = frame.point([0.0, scale.place(*value)]);
        let style = format!("stroke=\"{INK}\"");
        canvas.line([left + BAR, height], [left + BAR + 4.0, height], &style);
        let at = [left + BAR + 6.0, height + 0.35 * TICK_SIZE];
        canvas.label(label, at, TICK_SIZE, Anchor::Start, "");
    }
    if !map.label.is_empty() {
        let at = [
            frame.right() + map.room() - 4.0,
            frame.at[1] + 0.5 * frame.size[1],
        ];
        canvas.upright(&map.label, at, super::LABEL_SIZE);
    }
}

/// Viridis (Smith and van der Walt 2015) at a share of its length, by a polynomial that is within 1 % of it.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped before"
)]
fn colour(share: f64) -> String {
    const POWERS: [[f64; 3]; 7] = [
        [
            0.277_727_327_223_417_6,
            0.005_407_344_544_966_578,
            0.334_099_805_335_306_1,
        ],
        [
            0.105_093_043_108_577_4,
            1.404_613_529_898_575,
            1.384_590_162_594_685,
        ],
        [
            -0.330_861_828_725_556_3,
            0.214_847_559_468_213,
            0.095_095_163_028_236_59,
        ],
        [
            -4.634_230_498_983_486,
            -5.799_100_973_351_585,
            -19.332_440_956_279_87,
        ],
        [
            6.228_269_936_347_081,
            14.179_933_366_805_09,
            56.690_552_600_681_05,
        ],
        [
            4.776_384_997_670_288,
            -13.745_145_377_746_01,
            -65.353_032_633_373_34,
        ],
        [
            -5.435_455_855_934_631,
            4.645_852_612_178_535,
            26.312_435_252_498_32,
        ],
    ];
    let channel = |i: usize| {
        let value = POWERS.iter().rev().fold(0.0, |sum, p| sum * share + p[i]);
        (255.0 * value.clamp(0.0, 1.0)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", channel(0), channel(1), channel(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_viridis() {
        let parse = |text: &str| {
            [1, 3, 5].map(|i| f64::from(u8::from_str_radix(&text[i..i + 2], 16).unwrap()))
        };
        for (share, expected) in [(0.0, "#440154"), (0.5, "#21918c"), (1.0, "#fde725")] {
            let found = colour(share);
            let pairs = parse(&found).into_iter().zip(parse(expected));
            for (a, b) in pairs {
                assert!((a - b).abs() < 8.0, "{found} for {expected}");
            }
        }
    }

    #[test]
    fn brightness_grows_with_the_value() {
        let light = |share: f64| {
            let text = colour(share);
            let of = |i: usize| f64::from(u8::from_str_radix(&text[i..i + 2], 16).unwrap());
            0.2126 * of(1) + 0.7152 * of(3) + 0.0722 * of(5)
        };
        let all: Vec<f64> = (0..=20).map(|i| light(f64::from(i) / 20.0)).collect();
        assert!(all.windows(2).all(|w| w[1] > w[0]), "{all:?}");
    }
}
