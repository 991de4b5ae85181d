//! Cost per ray over the number of triangles, as SVG.

use std::fmt::Write as _;
use std::path::Path;

use super::Row;
use crate::Result;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 480.0;
/// Of the area inside the axes: left, right, top, bottom.
const AREA: [f64; 4] = [70.0, 846.0, 14.0, 424.0];
const COLOURS: [&str; 4] = ["#1f5fa8", "#c0392b", "#e08a00", "#468c3c"];
/// Between two lines of the legend.
const LINE: f64 = 20.0;

/// The axes: triangles by their logarithm, and nanoseconds.
struct Axes {
    least: f64,
    most: f64,
    highest: f64,
}

impl Axes {
    fn of(rows: &[Row]) -> Self {
        let sizes = || rows.iter().map(|row| row.triangles as f64);
        let costs = rows.iter().flat_map(|row| &row.cells);
        let highest = costs.map(|c| c.specula.max(c.in_packets().unwrap_or(0.0)));
        Self {
            least: sizes().fold(f64::INFINITY, f64::min) / 1.5,
            most: sizes().fold(0.0, f64::max) * 1.5,
            highest: highest.fold(0.0, f64::max) * 1.1,
        }
    }

    fn x(&self, triangles: f64) -> f64 {
        let share = (triangles / self.least).ln() / (self.most / self.least).ln();
        AREA[0] + share * (AREA[1] - AREA[0])
    }

    fn y(&self, nanoseconds: f64) -> f64 {
        AREA[3] - nanoseconds / self.highest * (AREA[3] - AREA[2])
    }
}

/// Writes the figure. Lines: Specula's. Crosses: the peer's packets.
pub(super) fn draw(path: &Path, rows: &[Row]) -> Result<()> {
    Ok(std::fs::write(path, svg(rows))?)
}

fn svg(rows: &[Row]) -> String {
    let axes = Axes::of(rows);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n"
    );
    frame(&mut svg, &axes);
    let has_peer = rows.iter().any(|row| row.peer_build.is_some());
    let kinds = rows.first().map_or(0, |row| row.cells.len());
    for (kind, colour) in (0..kinds).zip(COLOURS.into_iter().cycle()) {
        let points = rows.iter().map(|row| {
            let (x, y) = (row.triangles as f64, row.cells[kind].specula);
            format!("{:.1},{:.1}", axes.x(x), axes.y(y))
        });
        let points = points.collect::<Vec<_>>().join(" ");
        let _ = writeln!(
            svg,
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        for row in rows {
            if let Some(time) = row.cells[kind].in_packets() {
                let (x, y) = (axes.x(row.triangles as f64), axes.y(time));
                cross(&mut svg, [x, y], colour);
            }
        }
        let y = AREA[2] + LINE * (kind as f64 + 1.0);
        let [x0, x1] = [AREA[0] + 12.0, AREA[0] + 32.0];
        let _ = writeln!(
            svg,
            "<line x1=\"{x0}\" y1=\"{y}\" x2=\"{x1}\" y2=\"{y}\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        );
        text(
            &mut svg,
            [x1 + 8.0, y + 4.0],
            "start",
            rows[0].cells[kind].what,
        );
    }
    if has_peer {
        let y = AREA[2] + LINE * (kinds as f64 + 1.0);
        cross(&mut svg, [AREA[0] + 22.0, y], "black");
        text(
            &mut svg,
            [AREA[0] + 40.0, y + 4.0],
            "start",
            "the same, Embree, sixteen a call",
        );
    }
    svg + "</svg>\n"
}

/// The axes, a tick for each power of ten and for about five costs, and what they are.
fn frame(svg: &mut String, axes: &Axes) {
    let [left, right, top, bottom] = AREA;
    let _ = writeln!(
        svg,
        "<path d=\"M{left},{top} V{bottom} H{right}\" fill=\"none\" stroke=\"black\"/>"
    );
    for power in 0..12 {
        let triangles = 10_f64.powi(power);
        if (axes.least..axes.most).contains(&triangles) {
            let x = axes.x(triangles);
            let _ = writeln!(
                svg,
                "<line x1=\"{x:.1}\" y1=\"{bottom}\" x2=\"{x:.1}\" y2=\"{:.1}\" stroke=\"black\"/>",
                bottom + 5.0
            );
            text(svg, [x, bottom + 20.0], "middle", &format!("10^{power}"));
        }
    }
    let step = step(axes.highest);
    let mut cost = 0.0;
    while cost <= axes.highest {
        let y = axes.y(cost);
        let _ = writeln!(
            svg,
            "<line x1=\"{left}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\" stroke=\"#dddddd\"/>"
        );
        text(svg, [left - 8.0, y + 4.0], "end", &format!("{cost:.0}"));
        cost += step;
    }
    text(
        svg,
        [0.5 * (left + right), HEIGHT - 12.0],
        "middle",
        "triangles",
    );
    let middle = 0.5 * (top + bottom);
    let _ = writeln!(
        svg,
        "<text x=\"20\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {middle})\">\
         nanoseconds per ray, one thread</text>"
    );
}

/// 1, 2 or 5 times a power of ten, so that there are four to ten steps.
fn step(highest: f64) -> f64 {
    let power = 10_f64.powf((highest / 4.0).log10().floor());
    let factor = [5.0, 2.0].into_iter().find(|f| f * power <= highest / 4.0);
    (factor.unwrap_or(1.0) * power).max(1.0)
}

fn cross(svg: &mut String, [x, y]: [f64; 2], colour: &str) {
    let _ = writeln!(
        svg,
        "<path d=\"M{:.1},{:.1} l10,10 m0,-10 l-10,10\" stroke=\"{colour}\" stroke-width=\"2\"/>",
        x - 5.0,
        y - 5.0
    );
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
    );
}

#[cfg(test)]
mod tests {
    use super::super::Cell;
    use super::*;

    fn row(triangles: usize, specula: f64, peer: Option<[f64; 3]>) -> Row {
        Row {
            triangles,
            bytes: 0.0,
            build: [0.0; 2],
            peer_build: peer.map(|_| [1.0; 2]),
            peer_bytes: None,
            cells: vec![Cell {
                what: "camera",
                specula,
                peer,
            }],
        }
    }

    #[test]
    fn every_row_is_a_point_and_every_peer_a_cross() {
        let rows = [
            row(100, 50.0, Some([90.0, 80.0, 70.0])),
            row(10_000, 100.0, None),
        ];
        let text = svg(&rows);
        let line = text.lines().find(|l| l.starts_with("<polyline")).unwrap();
        assert_eq!(line.matches(',').count(), 2, "{line}");
        // One of the peer, and the legend's.
        assert_eq!(text.matches("l10,10").count(), 2);
        assert!(text.contains(">10^3<") && text.contains("Embree"), "{text}");
        let axes = Axes::of(&rows);
        assert!(axes.y(100.0) < axes.y(50.0) && axes.x(10_000.0) > axes.x(100.0));
        assert!(!svg(&rows[1..]).contains("Embree"));
    }

    #[test]
    fn steps_are_few_and_even() {
        for (highest, expected) in [(110.0, 20.0), (480.0, 100.0), (1000.0, 200.0), (5.0, 1.0)] {
            assert_eq!(step(highest), expected, "{highest}");
        }
    }
}
