//! The legend: below the panels, so that it covers nothing.

use super::canvas::{Anchor, Canvas, width};
use super::style::{SWATCH, fill, marker, stroke};
use super::{Content, LABEL_SIZE, Panel};
use crate::typeset::spans;

/// Height of a row.
const ROW: f64 = 22.0;
/// Between swatch and name, and between entries.
const GAPS: [f64; 2] = [8.0, 26.0];

/// Names of lines and bars, once each, in rows that fit below the panels.
pub(super) struct Legend {
    rows: Vec<Vec<Entry>>,
    width: f64,
}

#[derive(Clone, PartialEq)]
struct Entry {
    label: String,
    style: usize,
    is_bar: bool,
}

impl Entry {
    fn width(&self) -> f64 {
        let swatch = if self.is_bar { 0.5 * SWATCH } else { SWATCH };
        swatch + GAPS[0] + width(&spans(&self.label), LABEL_SIZE)
    }
}

impl Legend {
    pub(super) fn new(panels: &[Panel], width: f64) -> Self {
        let mut entries: Vec<Entry> = Vec::new();
        for panel in panels {
            let own: Vec<Entry> = match &panel.content {
                Content::Lines(series) => series
                    .iter()
                    .map(|s| Entry {
                        label: s.label.clone(),
                        style: s.style,
                        is_bar: false,
                    })
                    .collect(),
                Content::Bars(bars) => bars
                    .bars
                    .iter()
                    .map(|(label, style, _)| Entry {
                        label: label.clone(),
                        style: *style,
                        is_bar: true,
                    })
                    .collect(),
                Content::Map(_) | Content::Intervals(_) => Vec::new(),
            };
            for entry in own {
                if !entry.label.is_empty() && !entries.contains(&entry) {
                    entries.push(entry);
                }
            }
        }
        let mut rows: Vec<Vec<Entry>> = Vec::new();
        for entry in entries {
            match rows.last_mut() {
                Some(row) if row_width(row) + GAPS[1] + entry.width() <= width - 20.0 => {
                    row.push(entry);
                }
                _ => rows.push(vec![entry]),
            }
        }
        Self { rows, width }
    }

    pub(super) fn height(&self) -> f64 {
        if self.rows.is_empty() {
            4.0
        } else {
            ROW * self.rows.len() as f64 + 10.0
        }
    }

    /// * `top`: where the panels end.
    pub(super) fn draw(&self, canvas: &mut Canvas, top: f64) {
        canvas.raw("<g id=\"legend\">");
        for (i, row) in self.rows.iter().enumerate() {
            let mut x = 0.5 * (self.width - row_width(row)).max(0.0);
            let y = top + ROW * (i as f64 + 0.5);
            for entry in row {
                let end = x + entry.width();
                if entry.is_bar {
                    canvas.rectangle([x, y - 7.0], [0.5 * SWATCH, 12.0], &fill(entry.style));
                } else {
                    canvas.line([x, y], [x + SWATCH, y], &stroke(entry.style));
                    marker(canvas, entry.style, [x + 0.5 * SWATCH, y]);
                }
                let text = [end - width(&spans(&entry.label), LABEL_SIZE), y + 4.0];
                canvas.text(&entry.label, text, LABEL_SIZE, Anchor::Start);
                x = end + GAPS[1];
            }
        }
        canvas.raw("</g>");
    }
}

fn row_width(row: &[Entry]) -> f64 {
    let gaps = GAPS[1] * row.len().saturating_sub(1) as f64;
    gaps + row.iter().map(Entry::width).sum::<f64>()
}
