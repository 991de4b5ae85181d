//! Colours, dashes and markers of lines, hatches of bars: each tells what is shown without the others, in
//! greyscale and to eyes that do not tell red from green.

use std::fmt::Write as _;

use super::canvas::Canvas;

/// Colours (Okabe and Ito 2008, ordered by brightness) and dashes.
pub const STYLES: [(&str, &str); 8] = [
    ("#000000", ""),
    ("#0072B2", "9 4"),
    ("#D55E00", "3 3"),
    ("#009E73", "9 3 2 3"),
    ("#CC79A7", "14 4"),
    ("#E69F00", "2 2 6 2"),
    ("#56B4E9", "5 5"),
    ("#777777", "1 4"),
];
/// Half the size of a marker.
const MARKER: f64 = 3.4;
/// Length of a line in a legend: more than two periods of every dash.
pub(super) const SWATCH: f64 = 44.0;

/// Attributes of a line.
pub(super) fn stroke(style: usize) -> String {
    let (colour, dash) = STYLES[style % STYLES.len()];
    let dash = if dash.is_empty() {
        String::new()
    } else {
        format!(" stroke-dasharray=\"{dash}\"")
    };
    format!(
        "fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.7\" stroke-linejoin=\"round\"{dash}"
    )
}

/// A marker at a point: another one for each style.
pub(super) fn marker(canvas: &mut Canvas, style: usize, [x, y]: [f64; 2]) {
    let colour = STYLES[style % STYLES.len()].0;
    let r = MARKER;
    let outline = |points: &[[f64; 2]]| {
        let mut d = String::new();
        for (i, [a, b]) in points.iter().enumerate() {
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(d, "{letter}{:.1} {:.1}", x + r * a, y + r * b);
        }
        format!("<path d=\"{d}Z\"")
    };
    let circle = format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\"");
    let shape = match style % STYLES.len() {
        0 | 6 => circle,
        1 | 7 => outline(&[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]),
        2 => outline(&[[0.0, -1.2], [1.1, 0.8], [-1.1, 0.8]]),
        3 => outline(&[[0.0, -1.3], [1.3, 0.0], [0.0, 1.3], [-1.3, 0.0]]),
        4 => outline(&[[0.0, 1.2], [1.1, -0.8], [-1.1, -0.8]]),
        _ => outline(&[
            [-1.2, -0.4],
            [-0.4, -0.4],
            [-0.4, -1.2],
            [0.4, -1.2],
            [0.4, -0.4],
            [1.2, -0.4],
            [1.2, 0.4],
            [0.4, 0.4],
            [0.4, 1.2],
            [-0.4, 1.2],
            [-0.4, 0.4],
            [-1.2, 0.4],
        ]),
    };
    // The second of a shape is hollow.
    let fill = if style % STYLES.len() > 5 {
        "#ffffff"
    } else {
        colour
    };
    canvas.raw(&format!("{shape} fill=\"{fill}\" stroke=\"{colour}\"/>"));
}

/// The hatches of bars, to be referred to by [`fill`].
pub(super) fn hatches(canvas: &mut Canvas) {
    for (style, (colour, _)) in STYLES.iter().enumerate() {
        let marks = match style % 4 {
            0 => "",
            1 => "M0 6L6 0",
            2 => "M0 3L6 3",
            _ => "M0 0L6 6",
        };
        canvas.raw(&format!(
            "<pattern id=\"hatch{style}\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">\
             <rect width=\"6\" height=\"6\" fill=\"{colour}\"/>\
             <path d=\"{marks}\" stroke=\"#ffffff\" stroke-width=\"1.2\"/></pattern>"
        ));
    }
}

/// Attributes of a bar.
pub(super) fn fill(style: usize) -> String {
    let style = style % STYLES.len();
    let colour = STYLES[style].0;
    format!("fill=\"url(#hatch{style})\" stroke=\"{colour}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn swatches_show_two_periods_of_every_dash() {
        for (_, dash) in STYLES {
            let period: f64 = dash
                .split_whitespace()
                .map(|d| d.parse::<f64>().unwrap())
                .sum();
            assert!(2.0 * period <= SWATCH, "{dash}");
        }
    }

    /// Whatever the colours: no two styles have the same dash and marker.
    #[test]
    fn styles_differ_without_colour() {
        let looks = |style: usize| {
            let mut canvas = Canvas::default();
            marker(&mut canvas, style, [0.0, 0.0]);
            let (colour, dash) = STYLES[style];
            canvas.svg([1.0, 1.0]).replace(colour, "ink") + dash
        };
        for (a, (_, dash)) in STYLES.iter().enumerate() {
            for (b, (_, other)) in STYLES.iter().enumerate().take(a) {
                assert_ne!(looks(a), looks(b), "{a} {b}");
                assert_ne!(dash, other, "{a} {b}");
            }
        }
    }
}
