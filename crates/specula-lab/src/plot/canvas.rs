//! The elements of SVG that plots are made of.

use std::fmt::Write as _;

use crate::typeset::{Place, Span, spans};

/// Of axes, ticks and text.
pub(super) const INK: &str = "#222222";
/// Of grids.
pub(super) const PALE: &str = "#dddddd";
/// Size of text that stands above or below the line, over that on it.
const SMALL: f64 = 0.72;
/// Advances of DejaVu Sans from the space to the tilde, in thousandths of the size.
const ADVANCES: [u16; 95] = [
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838,
];

/// Where a text stands about its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// The body of a drawing.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    body: String,
}

impl Canvas {
    /// The drawing as a file.
    pub(super) fn svg(&self, [width, height]: [f64; 2]) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.body
        )
    }

    /// An element or a tag, with its attributes.
    pub(super) fn raw(&mut self, element: &str) {
        self.body += element;
        self.body.push('\n');
    }

    pub(super) fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], style: &str) {
        let _ = writeln!(
            self.body,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>"
        );
    }

    pub(super) fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], style: &str) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" {style}/>"
        );
    }

    /// Lines from point to point.
    pub(super) fn path(&mut self, points: &[[f64; 2]], style: &str) {
        let mut d = String::with_capacity(12 * points.len());
        for (i, [x, y]) in points.iter().enumerate() {
            let letter = if i == 0 { 'M' } else { 'L' };
            let _ = write!(d, "{letter}{x:.1} {y:.1}");
        }
        let _ = writeln!(self.body, "<path d=\"{d}\" {style}/>");
    }

    /// A text, typeset.
    pub(super) fn text(&mut self, text: &str, at: [f64; 2], size: f64, anchor: Anchor) {
        self.label(&spans(text), at, size, anchor, "");
    }

    /// A text that is read from below.
    pub(super) fn upright(&mut self, text: &str, [x, y]: [f64; 2], size: f64) {
        let turned = format!(" transform=\"rotate(-90 {x:.1} {y:.1})\"");
        self.label(&spans(text), [x, y], size, Anchor::Middle, &turned);
    }

    /// Runs of text.
    pub(super) fn label(
        &mut self,
        spans: &[Span],
        [x, y]: [f64; 2],
        size: f64,
        anchor: Anchor,
        more: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = write!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{INK}\"{more}>"
        );
        let mut height = 0.0;
        for span in spans {
            let (wanted, own) = match span.place {
                Place::Line => (0.0, size),
                Place::Below => (0.25 * size, SMALL * size),
                Place::Above => (-0.38 * size, SMALL * size),
            };
            let text = escaped(&span.text);
            let down: f64 = wanted - height;
            if down == 0.0 && span.place == Place::Line {
                self.body += &text;
            } else {
                let _ = write!(
                    self.body,
                    "<tspan dy=\"{down:.1}\" font-size=\"{own:.1}\">{text}</tspan>"
                );
            }
            height = wanted;
        }
        self.body += "</text>\n";
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// About how wide runs of text are.
pub(super) fn width(spans: &[Span], size: f64) -> f64 {
    let of = |c: char| {
        let place = (u32::from(c)).checked_sub(32).map(|i| i as usize);
        f64::from(place.and_then(|i| ADVANCES.get(i)).copied().unwrap_or(640))
    };
    let run = |s: &Span| {
        let scale = if s.place == Place::Line { 1.0 } else { SMALL };
        scale * s.text.chars().map(of).sum::<f64>()
    };
    1e-3 * size * spans.iter().map(run).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_typeset_and_escaped() {
        let mut canvas = Canvas::default();
        canvas.text("theta_o < 1 & \"x\"", [1.0, 2.0], 10.0, Anchor::Middle);
        let svg = canvas.svg([10.0, 20.0]);
        assert!(
            svg.contains(
                "\u{3b8}<tspan dy=\"2.5\" font-size=\"7.2\">o</tspan>\
                 <tspan dy=\"-2.5\" font-size=\"10.0\"> &lt; 1 &amp; &quot;x&quot;</tspan></text>"
            ),
            "{svg}"
        );
    }

    #[test]
    fn advances_are_the_fonts() {
        let found = width(&spans("Wi_0"), 100.0);
        assert!((found - 98.9 - 27.8 - 50.0 - 63.6).abs() < 0.1, "{found}");
        assert!(width(&spans("theta_o"), 10.0) < width(&spans("theory"), 10.0));
    }
}
