//! Plots in one style, drawn by the crate `kuva`, as
//! pixels by `resvg` with a font of its own: axes with units, legends, lines that differ in dash as
//! well as in colour, so that they can be told apart in greyscale.

mod raster;

use std::path::Path;
use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::line::LineStyle;
use kuva::plot::{BarPlot, LinePlot};
use kuva::prelude::{ColorMap, Heatmap, Layout, Plot};
use kuva::render::figure::Figure as Grid;

use crate::output::record::WrittenPlot;
use crate::{LabError, Result};

/// Panels in a grid, filled row by row.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Panels.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel in pixels of the PNG.
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
    /// What is drawn.
    pub content: Content,
}

/// What is drawn.
#[derive(Clone, Debug)]
pub enum Content {
    /// Lines over each other.
    Lines(Vec<Series>),
    /// A value per cell as brightness.
    Map(Map),
    /// A map with lines over it.
    MapAndLines(Map, Vec<Series>),
    /// Bars side by side, a group for each thing.
    Bars(Bars),
}

/// Groups of bars.
#[derive(Clone, Debug)]
pub struct Bars {
    /// What stands under each group.
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
    /// What brightness means, with its unit; shown behind the panel's title.
    pub label: String,
    /// Values of the darkest and the brightest colour; `None`: as the data are. What lies beyond is
    /// shown as the end.
    pub range: Option<[f64; 2]>,
}

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

    fn plot(&self, panel: &Panel) -> LinePlot {
        let (colour, dash) = STYLES[self.style % STYLES.len()];
        // Where an axis is logarithmic, nothing is at 0.
        let is_shown = |p: &&[f64; 2]| {
            p.iter().all(|v| v.is_finite())
                && (!panel.x.logarithmic || p[0] > 0.0)
                && (!panel.y.logarithmic || p[1] > 0.0)
        };
        let shown = self.points.iter().filter(is_shown).map(|p| (p[0], p[1]));
        let mut line = LinePlot::new()
            .with_data(shown)
            .with_color(colour)
            .with_stroke_width(1.8);
        if !dash.is_empty() {
            line = line.with_line_style(LineStyle::Custom(dash.to_owned()));
        }
        if !self.label.is_empty() {
            line = line.with_legend(self.label.clone());
        }
        if let Some(band) = &self.band {
            line = line.with_band(band.iter().map(|b| b[0]), band.iter().map(|b| b[1]));
        }
        line
    }
}

impl Map {
    fn plot(&self) -> Heatmap {
        let clamped = |v: &f64| match self.range {
            Some([low, high]) => v.clamp(low, high),
            None => *v,
        };
        let rows: Vec<Vec<f64>> = self
            .rows
            .iter()
            .map(|row| row.iter().map(clamped).collect())
            .collect();
        let colours = self.colours(&rows);
        Heatmap::new()
            .with_data(rows)
            .with_color_map(colours)
            .with_x_range(self.x[0], self.x[1])
            .with_y_range(self.y[0], self.y[1])
    }

    /// The same colour for the same value in all maps of a range: the library spreads colours over the
    /// values that are there.
    fn colours(&self, rows: &[Vec<f64>]) -> ColorMap {
        let Some([low, high]) = self.range else {
            return ColorMap::Viridis;
        };
        let values = || rows.iter().flatten().copied();
        let least = values().fold(f64::INFINITY, f64::min);
        let greatest = values().fold(f64::NEG_INFINITY, f64::max);
        ColorMap::Custom(Arc::new(move |share| {
            let value = least + share * (greatest - least);
            ColorMap::Viridis.map(((value - low) / (high - low)).clamp(0.0, 1.0))
        }))
    }
}

impl Bars {
    fn plot(&self) -> BarPlot {
        let mut plot = BarPlot::new();
        for (i, group) in self.groups.iter().enumerate() {
            let bar = |(_, style, heights): &(String, usize, Vec<f64>)| {
                let height = heights.get(i).copied().unwrap_or(0.0);
                (height, STYLES[style % STYLES.len()].0)
            };
            plot = plot.with_group(group.clone(), self.bars.iter().map(bar));
        }
        plot.with_legend(self.bars.iter().map(|b| b.0.as_str()).collect())
    }
}

impl Panel {
    fn plots(&self) -> Vec<Plot> {
        let lines = |series: &[Series]| -> Vec<Plot> {
            series.iter().map(|s| s.plot(self).into()).collect()
        };
        match &self.content {
            Content::Lines(series) => lines(series),
            Content::Map(map) => vec![map.plot().into()],
            Content::MapAndLines(map, series) => {
                let mut all: Vec<Plot> = vec![map.plot().into()];
                all.extend(lines(series));
                all
            }
            Content::Bars(bars) => vec![bars.plot().into()],
        }
    }

    /// The title, of maps with what brightness means.
    fn full_title(&self) -> String {
        match &self.content {
            Content::Map(map) | Content::MapAndLines(map, _) if !map.label.is_empty() => {
                format!("{}: {}", self.title, map.label)
            }
            _ => self.title.clone(),
        }
    }

    fn layout(&self, plots: &[Plot]) -> Layout {
        let mut layout = Layout::auto_from_plots(plots)
            .with_title(self.full_title())
            .with_x_label(self.x.label.clone())
            .with_y_label(self.y.label.clone())
            .with_font_family("DejaVu Sans, sans-serif")
            .with_title_size(14)
            .with_label_size(12)
            .with_tick_size(11)
            .with_body_size(11);
        if self.x.logarithmic {
            layout = layout.with_log_x();
        }
        if self.y.logarithmic {
            layout = layout.with_log_y();
        }
        if let Some([low, high]) = self.x.range {
            layout = layout.with_x_axis_min(low).with_x_axis_max(high);
        }
        if let Some([low, high]) = self.y.range {
            layout = layout.with_y_axis_min(low).with_y_axis_max(high);
        }
        layout
    }
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
            panel: [440.0, 340.0],
        }
    }

    /// Writes SVG and PNG.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str, caption: &str) -> Result<WrittenPlot> {
        let rows = self.panels.len().div_ceil(self.columns);
        let plots: Vec<Vec<Plot>> = self.panels.iter().map(Panel::plots).collect();
        let layouts = (self.panels.iter().zip(&plots))
            .map(|(panel, plots)| panel.layout(plots))
            .collect();
        let scene = Grid::new(rows, self.columns)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_cell_size(self.panel[0], self.panel[1])
            .with_shared_legend()
            .render();
        let text = SvgBackend::new().render_scene(&scene);
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
}
