//! Cost per ray over the number of triangles, as SVG.

use std::path::Path;

use plotters::prelude::*;

use super::Row;
use crate::Result;

const COLOURS: [RGBColor; 4] = [
    RGBColor(31, 95, 168),
    RGBColor(192, 57, 43),
    RGBColor(224, 138, 0),
    RGBColor(70, 140, 60),
];

/// Lines: Specula's. Crosses: the peer without its layer.
pub(super) fn draw(path: &Path, rows: &[Row]) -> Result<()> {
    let sizes = || rows.iter().map(|row| row.triangles as f64);
    let least = sizes().fold(f64::INFINITY, f64::min) / 1.5;
    let most = sizes().fold(0.0, f64::max) * 1.5;
    let costs = rows.iter().flat_map(|row| &row.cells);
    let highest = costs.map(|c| c.specula.max(c.peer.map_or(0.0, |[p, l]| p - l)));
    let highest = highest.fold(0.0, f64::max) * 1.1;
    let root = SVGBackend::new(path, (860, 480)).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .margin(14)
        .x_label_area_size(46)
        .y_label_area_size(62)
        .build_cartesian_2d((least..most).log_scale(), 0.0..highest)?;
    chart
        .configure_mesh()
        .x_desc("triangles")
        .y_desc("nanoseconds per ray, one thread")
        .x_label_formatter(&|x| format!("10^{:.0}", x.log10()))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .light_line_style(WHITE)
        .draw()?;
    let kinds = rows.first().map_or(0, |row| row.cells.len());
    for (kind, colour) in (0..kinds).zip(COLOURS.into_iter().cycle()) {
        let specula = rows
            .iter()
            .map(|r| (r.triangles as f64, r.cells[kind].specula));
        let line = LineSeries::new(specula, colour.stroke_width(2)).point_size(3);
        chart
            .draw_series(line)?
            .label(rows[0].cells[kind].what)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour.stroke_width(2)));
        let peer = rows.iter().filter_map(|r| {
            let [measured, layer] = r.cells[kind].peer?;
            Some(Cross::new(
                (r.triangles as f64, measured - layer),
                5,
                colour.stroke_width(2),
            ))
        });
        chart.draw_series(peer)?;
    }
    if rows.iter().any(|row| row.peer_build.is_some()) {
        let crosses = std::iter::empty::<Cross<(f64, f64), i32>>();
        chart
            .draw_series(crosses)?
            .label("the same, Embree")
            .legend(|(x, y)| Cross::new((x + 10, y), 5, BLACK.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE)
        .border_style(RGBColor(200, 200, 200))
        .draw()?;
    root.present()?;
    Ok(())
}
