//! Plots in one style, fit for print, as SVG and as pixels by `resvg` with a font of its own: symbols set as
//! symbols, even ticks, legends below the panels where they cover nothing, and lines that differ in dash and
//! marker as well as in colour, so that they can be told apart in greyscale.

mod bars;
mod canvas;
mod legend;
mod lines;
mod map;
mod panel;
mod raster;
mod style;
mod ticks;

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::{LabError, Result};

use canvas::Canvas;
use legend::Legend;
use panel::{Frame, Prepared};
pub use style::STYLES;

/// Sizes of text, in pixels of a screen.
const TITLE_SIZE: f64 = 13.0;
const LABEL_SIZE: f64 = 12.0;
const TICK_SIZE: f64 = 11.0;

/// Panels in a grid, filled row by row.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Panels.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel with its axes, in pixels of a screen; the PNG has twice as many.
    pub panel: [f64; 2],
}

/// One pair of axes.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Above it.
    pub title: String,
    /// Horizontal.
    pub x: Axis,
    /// Vertical.
    pub y: Axis,
    /// What is plotted.
    pub content: Content,
}

/// What is plotted.
#[derive(Clone, Debug)]
pub enum Content {
    /// Lines over each other.
    Lines(Vec<Series>),
    /// A value per cell as brightness.
    Map(Map),
    /// Bars side by side, a group for each thing.
    Bars(Bars),
    /// Points with intervals, below each other. The vertical axis has their names.
    Intervals(Intervals),
}

/// Points with intervals.
#[derive(Clone, Debug)]
pub struct Intervals {
    /// From the top: the name, which of the [`STYLES`], the point and from where to where it may be; bounds
    /// that are not finite end with the axis.
    pub rows: Vec<(String, usize, [f64; 3])>,
    /// The value that all are compared with: a line from top to bottom.
    pub mark: f64,
}

/// Groups of bars.
#[derive(Clone, Debug)]
pub struct Bars {
    /// The name under each group.
    pub groups: Vec<String>,
    /// Of each bar of a group, from left to right: its name in the legend, which of the [`STYLES`]
    /// colours it, and its height in each group.
    pub bars: Vec<(String, usize, Vec<f64>)>,
}

/// An axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Quantity and unit, such as `theta_o [deg]`.
    pub label: String,
    /// Whether it is logarithmic.
    pub logarithmic: bool,
    /// From where to where; `None`: as the data are.
    pub range: Option<[f64; 2]>,
}

/// A line.
#[derive(Clone, Debug)]
pub struct Series {
    /// In the legend; empty: not there.
    pub label: String,
    /// Which of the [`STYLES`] (modulo their number): the same method has the same in all plots.
    pub style: usize,
    /// From left to right.
    pub points: Vec<[f64; 2]>,
    /// Lowest and highest of each point, shown as a band.
    pub band: Option<Vec<[f64; 2]>>,
}

/// Cells of equal size.
#[derive(Clone, Debug)]
pub struct Map {
    /// Rows from the bottom, each from the left.
    pub rows: Vec<Vec<f64>>,
    /// Extent along x.
    pub x: [f64; 2],
    /// Extent along y.
    pub y: [f64; 2],
    /// The quantity and unit; shown beside the bar of colours.
    pub label: String,
    /// Values of the darkest and the brightest colour; `None`: as the data are. What lies beyond is
    /// shown as the end.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis.
    #[must_use]
    pub fn linear(label: &str) -> Self {
        Self {
            label: label.to_owned(),
            logarithmic: false,
            range: None,
        }
    }

    /// A logarithmic axis.
    #[must_use]
    pub fn logarithmic(label: &str) -> Self {
        Self {
            logarithmic: true,
            ..Self::linear(label)
        }
    }

    /// From `low` to `high`.
    #[must_use]
    pub fn from_to(self, low: f64, high: f64) -> Self {
        Self {
            range: Some([low, high]),
            ..self
        }
    }
}

impl Series {
    /// A line without a band.
    #[must_use]
    pub fn new(label: &str, style: usize, points: Vec<[f64; 2]>) -> Self {
        Self {
            label: label.to_owned(),
            style,
            points,
            band: None,
        }
    }
}

/// The files of a plot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct WrittenPlot {
    /// Name of the files, without their ends.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// The SVG file.
    pub svg: String,
    /// The PNG file.
    pub png: String,
}

impl Figure {
    /// One panel.
    #[must_use]
    pub fn single(panel: Panel) -> Self {
        Self::grid(1, vec![panel])
    }

    /// Panels, so many in a row.
    #[must_use]
    pub fn grid(columns: usize, panels: Vec<Panel>) -> Self {
        Self {
            panels,
            columns,
            panel: [360.0, 290.0],
        }
    }

    /// Writes SVG and PNG.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str, caption: &str) -> Result<WrittenPlot> {
        let text = self.svg();
        let svg = format!("{name}.svg");
        let path = folder.join(&svg);
        std::fs::write(&path, &text).map_err(LabError::io(&path))?;
        let png = format!("{name}.png");
        let path = folder.join(&png);
        let pixels = raster::png(&text)
            .map_err(|message| LabError::Output(format!("{}: {message}", path.display())))?;
        std::fs::write(&path, pixels).map_err(LabError::io(&path))?;
        Ok(WrittenPlot {
            name: name.to_owned(),
            caption: caption.to_owned(),
            svg,
            png,
        })
    }

    /// The drawing.
    #[must_use]
    pub fn svg(&self) -> String {
        let columns = self.columns.clamp(1, self.panels.len().max(1));
        let rows = self.panels.len().div_ceil(columns);
        let prepared: Vec<Prepared<'_>> = self.panels.iter().map(Prepared::new).collect();
        let margins = panel::margins(&prepared, self.panel);
        let [width, height] = self.panel;
        let legend = Legend::new(&self.panels, width * columns as f64);
        let mut canvas = Canvas::default();
        if self
            .panels
            .iter()
            .any(|p| matches!(p.content, Content::Bars(_)))
        {
            canvas.raw("<defs>");
            style::hatches(&mut canvas);
            canvas.raw("</defs>");
        }
        for (number, prepared) in prepared.iter().enumerate() {
            let (row, column) = (number / columns, number % columns);
            let corner = [width * column as f64, height * row as f64];
            let frame = Frame::within(corner, self.panel, margins);
            prepared.draw(&mut canvas, &frame, number);
        }
        let bottom = height * rows as f64;
        legend.draw(&mut canvas, bottom);
        canvas.svg([width * columns as f64, bottom + legend.height()])
    }
}

#[cfg(test)]
mod tests;
