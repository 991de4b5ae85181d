//! A panel: its frame, grid, ticks, labels and what is in it.

use super::canvas::{Anchor, Canvas, INK, PALE, width};
use super::ticks::Scale;
use super::{Axis, Content, LABEL_SIZE, Panel, TICK_SIZE, TITLE_SIZE, bars, lines, map};
use crate::typeset::spans;

/// Where the axes are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Upper left corner.
    pub(super) at: [f64; 2],
    /// Width and height.
    pub(super) size: [f64; 2],
}

impl Frame {
    /// * `margins`: left, top, right, bottom.
    pub(super) fn within(corner: [f64; 2], panel: [f64; 2], margins: [f64; 4]) -> Self {
        let [left, top, right, bottom] = margins;
        Self {
            at: [corner[0] + left, corner[1] + top],
            size: [
                (panel[0] - left - right).max(40.0),
                (panel[1] - top - bottom).max(40.0),
            ],
        }
    }

    pub(super) fn right(&self) -> f64 {
        self.at[0] + self.size[0]
    }

    pub(super) fn bottom(&self) -> f64 {
        self.at[1] + self.size[1]
    }

    /// Where shares of the axes are.
    pub(super) fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.at[0] + x * self.size[0],
            self.bottom() - y * self.size[1],
        ]
    }

    pub(super) fn contains(&self, [x, y]: [f64; 2]) -> bool {
        let within = |v: f64, from: f64, to: f64| v > from - 0.5 && v < to + 0.5;
        within(x, self.at[0], self.right()) && within(y, self.at[1], self.bottom())
    }
}

/// A panel with its axes.
pub(super) struct Prepared<'a> {
    panel: &'a Panel,
    x: Scale,
    y: Scale,
}

/// Room for axes, titles and bars of colours, the same for all panels of a figure: left, top, right, bottom.
pub(super) fn margins(all: &[Prepared<'_>], panel: [f64; 2]) -> [f64; 4] {
    let most = |room: &dyn Fn(&Prepared<'_>) -> f64| all.iter().map(room).fold(0.0, f64::max);
    let left = most(&|p| {
        let label = if p.panel.y.label.is_empty() {
            0.0
        } else {
            18.0
        };
        p.widest_tick() + 14.0 + label
    });
    let right = most(&|p| match &p.panel.content {
        Content::Map(map) => map.room() + 8.0,
        // Half of the last tick's label.
        _ => 16.0,
    });
    let top = most(&|p| if p.panel.title.is_empty() { 12.0 } else { 30.0 });
    let bottom = most(&|p| {
        let lines = match &p.panel.content {
            Content::Bars(all) => bars::lines(all, panel[0] - left - right),
            _ => 1,
        };
        let label = if p.panel.x.label.is_empty() {
            8.0
        } else {
            30.0
        };
        6.0 + bars::LINE * lines as f64 + label
    });
    [left, top, right, bottom]
}

impl<'a> Prepared<'a> {
    pub(super) fn new(panel: &'a Panel) -> Self {
        let scale =
            |axis: &Axis, data: Vec<f64>, is_tight| Scale::new(axis, data.into_iter(), is_tight);
        let (x, y) = match &panel.content {
            Content::Lines(series) => {
                let points = || series.iter().flat_map(|s| &s.points);
                let bands = series
                    .iter()
                    .flat_map(|s| s.band.iter().flatten().flatten());
                let heights = points().map(|p| p[1]).chain(bands.copied());
                let x = scale(&panel.x, points().map(|p| p[0]).collect(), true);
                (x, scale(&panel.y, heights.collect(), false))
            }
            Content::Map(map) => (
                scale(&panel.x, map.x.to_vec(), true),
                scale(&panel.y, map.y.to_vec(), true),
            ),
            Content::Bars(bars) => {
                let heights = bars.bars.iter().flat_map(|b| &b.2).copied();
                let from_zero = heights.chain((!panel.y.logarithmic).then_some(0.0));
                let y = scale(&panel.y, from_zero.collect(), false);
                (scale(&Axis::linear(""), vec![0.0, 1.0], true), y)
            }
            Content::Intervals(all) => {
                let ends = all.rows.iter().flat_map(|r| r.2);
                let ends = ends.chain([all.mark]).filter(|v| v.is_finite());
                let x = scale(&panel.x, ends.collect(), false);
                (x, scale(&Axis::linear(""), vec![0.0, 1.0], true))
            }
        };
        Self { panel, x, y }
    }

    fn widest_tick(&self) -> f64 {
        let advances: Vec<f64> = match &self.panel.content {
            Content::Intervals(all) => all
                .rows
                .iter()
                .map(|r| width(&spans(&r.0), TICK_SIZE))
                .collect(),
            _ => self
                .y
                .ticks
                .iter()
                .map(|t| width(&t.1, TICK_SIZE))
                .collect(),
        };
        advances.into_iter().fold(0.0, f64::max)
    }

    /// * `number`: of the panel in its figure.
    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Frame, number: usize) {
        canvas.raw(&format!("<clipPath id=\"panel{number}\">"));
        canvas.rectangle(frame.at, frame.size, "");
        canvas.raw("</clipPath>");
        if !matches!(self.panel.content, Content::Map(_)) {
            self.grid(canvas, frame);
        }
        let clipped = matches!(self.panel.content, Content::Lines(_));
        if clipped {
            canvas.raw(&format!("<g clip-path=\"url(#panel{number})\">"));
        }
        match &self.panel.content {
            Content::Lines(series) => {
                for (i, one) in series.iter().enumerate() {
                    lines::draw(canvas, frame, [&self.x, &self.y], one, [i, series.len()]);
                }
            }
            Content::Map(map) => map::draw(canvas, frame, [&self.x, &self.y], map),
            Content::Bars(all) => bars::draw(canvas, frame, &self.y, all),
            Content::Intervals(all) => bars::intervals(canvas, frame, &self.x, all),
        }
        if clipped {
            canvas.raw("</g>");
        }
        self.axes(canvas, frame);
        self.texts(canvas, frame);
    }

    fn has_ticks(&self) -> [bool; 2] {
        [
            !matches!(self.panel.content, Content::Bars(_)),
            !matches!(self.panel.content, Content::Intervals(_)),
        ]
    }

    fn grid(&self, canvas: &mut Canvas, frame: &Frame) {
        let style = format!("stroke=\"{PALE}\" stroke-width=\"0.8\"");
        let [along_x, along_y] = self.has_ticks();
        for (value, _) in self.x.ticks.iter().filter(|_| along_x) {
            let [x, _] = frame.point([self.x.place(*value), 0.0]);
            canvas.line([x, frame.at[1]], [x, frame.bottom()], &style);
        }
        for (value, _) in self.y.ticks.iter().filter(|_| along_y) {
            let [_, y] = frame.point([0.0, self.y.place(*value)]);
            canvas.line([frame.at[0], y], [frame.right(), y], &style);
        }
    }

    /// The frame, ticks and their labels.
    fn axes(&self, canvas: &mut Canvas, frame: &Frame) {
        let ink = format!("stroke=\"{INK}\" stroke-width=\"1\"");
        let [left, bottom] = [frame.at[0], frame.bottom()];
        canvas.line([left, frame.at[1]], [left, bottom], &ink);
        canvas.line([left, bottom], [frame.right(), bottom], &ink);
        let [along_x, along_y] = self.has_ticks();
        if along_x {
            for (value, label) in &self.x.ticks {
                let [x, _] = frame.point([self.x.place(*value), 0.0]);
                canvas.line([x, bottom], [x, bottom + 5.0], &ink);
                canvas.label(label, [x, bottom + 17.0], TICK_SIZE, Anchor::Middle, "");
            }
            for value in &self.x.small {
                let [x, _] = frame.point([self.x.place(*value), 0.0]);
                canvas.line([x, bottom], [x, bottom + 3.0], &ink);
            }
        }
        if along_y {
            for (value, label) in &self.y.ticks {
                let [_, y] = frame.point([0.0, self.y.place(*value)]);
                canvas.line([left - 5.0, y], [left, y], &ink);
                let at = [left - 8.0, y + 0.36 * TICK_SIZE];
                canvas.label(label, at, TICK_SIZE, Anchor::End, "");
            }
            for value in &self.y.small {
                let [_, y] = frame.point([0.0, self.y.place(*value)]);
                canvas.line([left - 3.0, y], [left, y], &ink);
            }
        }
        if let Content::Intervals(all) = &self.panel.content {
            for (i, (name, ..)) in all.rows.iter().enumerate() {
                let place = 1.0 - (i as f64 + 0.5) / all.rows.len() as f64;
                let [_, y] = frame.point([0.0, place]);
                let at = [left - 8.0, y + 0.36 * TICK_SIZE];
                canvas.text(name, at, TICK_SIZE, Anchor::End);
            }
        }
    }

    fn texts(&self, canvas: &mut Canvas, frame: &Frame) {
        let middle = frame.at[0] + 0.5 * frame.size[0];
        let lines = match &self.panel.content {
            Content::Bars(all) => bars::lines(all, frame.size[0]),
            _ => 1,
        };
        let title = [middle, frame.at[1] - 10.0];
        canvas.text(&self.panel.title, title, TITLE_SIZE, Anchor::Middle);
        let below = frame.bottom() + 22.0 + bars::LINE * lines as f64;
        canvas.text(
            &self.panel.x.label,
            [middle, below],
            LABEL_SIZE,
            Anchor::Middle,
        );
        let beside = frame.at[0] - self.widest_tick() - 16.0;
        let height = frame.at[1] + 0.5 * frame.size[1];
        canvas.upright(&self.panel.y.label, [beside, height], LABEL_SIZE);
    }
}
