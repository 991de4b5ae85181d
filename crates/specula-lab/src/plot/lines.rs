//! Lines, their bands and markers.

use super::canvas::Canvas;
use super::style::{STYLES, marker, stroke};
use super::ticks::Scale;
use super::{Frame, Series};

/// Up to so many points each has a marker; of more, so many are spread over the line.
const MARKED: usize = 13;
const SPREAD: usize = 5;

/// Draws a line, the `number`th of `count`.
pub(super) fn draw(
    canvas: &mut Canvas,
    frame: &Frame,
    [x, y]: [&Scale; 2],
    series: &Series,
    [number, count]: [usize; 2],
) {
    let place = |p: [f64; 2]| frame.point([x.place(p[0]), y.place(p[1])]);
    if let Some(band) = &series.band {
        let ends = series.points.iter().zip(band);
        let low = ends.clone().map(|(p, b)| place([p[0], b[0]]));
        let high = ends.rev().map(|(p, b)| place([p[0], b[1]]));
        let colour = STYLES[series.style % STYLES.len()].0;
        let outline: Vec<[f64; 2]> = low.chain(high).collect();
        let style = format!("fill=\"{colour}\" fill-opacity=\"0.15\"");
        canvas.path(&outline, &style);
    }
    let mut shown = Vec::new();
    for part in parts(series, [x, y]) {
        let points: Vec<[f64; 2]> = part.into_iter().map(place).collect();
        if points.len() > 1 {
            canvas.path(&points, &stroke(series.style));
        }
        shown.extend(points);
    }
    for point in marked(&shown, [number, count]) {
        if frame.contains(point) {
            marker(canvas, series.style, point);
        }
    }
}

/// Runs of points that can be shown: where an axis is logarithmic, nothing is at 0.
fn parts(series: &Series, [x, y]: [&Scale; 2]) -> Vec<Vec<[f64; 2]>> {
    let is_shown = |p: &[f64; 2]| {
        p.iter().all(|v| v.is_finite())
            && (!x.logarithmic || p[0] > 0.0)
            && (!y.logarithmic || p[1] > 0.0)
    };
    let all = series.points.split(|p| !is_shown(p));
    all.filter(|part| !part.is_empty())
        .map(<[_]>::to_vec)
        .collect()
}

/// Where markers go: on each of few points; else evenly along the line, beside those of the other lines.
fn marked(points: &[[f64; 2]], [number, count]: [usize; 2]) -> Vec<[f64; 2]> {
    if points.len() <= MARKED {
        return points.to_vec();
    }
    let far = |w: &[[f64; 2]]| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
    let all: f64 = points.windows(2).map(far).sum();
    let offset = (number as f64 + 0.5) / count.max(1) as f64;
    let mut wanted = (0..SPREAD).map(|i| all * (i as f64 + offset) / SPREAD as f64);
    let (mut found, mut gone, mut next) = (Vec::new(), 0.0, wanted.next());
    for pair in points.windows(2) {
        gone += far(pair);
        while let Some(at) = next.filter(|at| *at <= gone) {
            found.push(pair[1]);
            next = wanted.next();
            if next.is_none_or(|n| n <= at) {
                break;
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_points_are_marked_and_many_lines_apart() {
        let points: Vec<[f64; 2]> = (0..101).map(|i| [f64::from(i), 0.0]).collect();
        assert_eq!(marked(&points[..5], [0, 2]), points[..5]);
        let [first, second] = [0, 1].map(|i| marked(&points, [i, 2]));
        assert_eq!(
            first,
            [
                [5.0, 0.0],
                [25.0, 0.0],
                [45.0, 0.0],
                [65.0, 0.0],
                [85.0, 0.0]
            ]
        );
        assert_eq!(second[0], [15.0, 0.0]);
        assert_eq!(second.len(), 5);
    }

    #[test]
    fn lines_end_where_nothing_can_be_shown() {
        let axis = crate::plot::Axis::logarithmic("x");
        let scale = Scale::new(&axis, [0.1, 10.0].into_iter(), false);
        let points = vec![
            [0.1, 1.0],
            [1.0, 1.0],
            [2.0, 0.0],
            [3.0, f64::NAN],
            [4.0, 1.0],
        ];
        let found = parts(&Series::new("", 0, points), [&scale, &scale]);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1]);
    }
}
