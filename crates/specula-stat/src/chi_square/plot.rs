//! The plot of a chi-square test: observed and expected counts and their difference, as SVG.

use std::f64::consts::PI;
use std::fmt::Write as _;

use super::ChiSquareCell;

/// Size of one panel in pixels: azimuth across, polar angle down.
const PANEL: [f64; 2] = [480.0, 240.0];
const GAP: f64 = 30.0;

/// The three panels, one above the other.
pub(super) fn svg(title: &str, cells: &[ChiSquareCell]) -> String {
    let brightest = cells
        .iter()
        .map(|c| density(c.expected.max(c.observed), c))
        .fold(0.0, f64::max);
    let logarithm = |count: f64, cell: &ChiSquareCell| {
        // Five decades of density, black to white.
        let relative = density(count, cell) / brightest.max(f64::MIN_POSITIVE);
        (1.0 + relative.max(1e-9).log10() / 5.0).clamp(0.0, 1.0)
    };
    let height = 3.0 * (PANEL[1] + GAP) + GAP;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" \
         fill=\"white\"/>\n<text x=\"8\" y=\"16\">{}</text>\n",
        PANEL[0] + 16.0,
        escape(title)
    );
    let grey = |v: f64| {
        let level = (255.0 * v).round();
        format!("rgb({level},{level},{level})")
    };
    panel(&mut out, 0, "observed (log density)", cells, |c| {
        grey(logarithm(c.observed, c))
    });
    panel(&mut out, 1, "expected (log density)", cells, |c| {
        grey(logarithm(c.expected, c))
    });
    let caption = "difference / sqrt(expected), red: too many, blue: too few, full at 5";
    panel(&mut out, 2, caption, cells, |c| {
        let v = (c.residual() / 5.0).clamp(-1.0, 1.0);
        let pale = (255.0 * (1.0 - v.abs())).round();
        if v > 0.0 {
            format!("rgb(255,{pale},{pale})")
        } else {
            format!("rgb({pale},{pale},255)")
        }
    });
    out.push_str("</svg>\n");
    out
}

fn density(count: f64, cell: &ChiSquareCell) -> f64 {
    count / cell.patch.solid_angle()
}

fn panel(
    out: &mut String,
    index: u8,
    caption: &str,
    cells: &[ChiSquareCell],
    fill: impl Fn(&ChiSquareCell) -> String,
) {
    let top = GAP + f64::from(index) * (PANEL[1] + GAP) + 12.0;
    let _infallible = writeln!(
        out,
        "<text x=\"8\" y=\"{}\">{}, phi 0 to 360 across, theta 0 to 180 down</text>",
        top - 4.0,
        escape(caption)
    );
    for cell in cells {
        let x = 8.0 + cell.patch.phi[0] / (2.0 * PI) * PANEL[0];
        let y = top + cell.patch.theta[0] / PI * PANEL[1];
        let width = (cell.patch.phi[1] - cell.patch.phi[0]) / (2.0 * PI) * PANEL[0];
        let height = (cell.patch.theta[1] - cell.patch.theta[0]) / PI * PANEL[1];
        let _infallible = writeln!(
            out,
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
             fill=\"{}\"/>",
            fill(cell)
        );
    }
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
