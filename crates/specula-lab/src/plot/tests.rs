//! Tests of plots by their SVG.

use super::style::SWATCH;
use super::*;

fn figure() -> Figure {
    let points = |power: i32| (0..40).map(move |i| [f64::from(i), 1e-3 * f64::from(i).powi(power)]);
    let lines = Panel {
        title: "alpha_x = 0.5, theta_i = 60 deg".to_owned(),
        x: Axis::linear("theta_o [deg]"),
        y: Axis::logarithmic("variance x time [ns/sr^2]"),
        content: Content::Lines(vec![
            Series::new("phi = 0", 1, points(2).collect()),
            Series::new("eta", 2, points(1).collect()),
        ]),
    };
    let bars = Panel {
        title: "bars".to_owned(),
        x: Axis::linear(""),
        y: Axis::linear("share [%]"),
        content: Content::Bars(Bars {
            groups: vec!["a".to_owned(), "b".to_owned()],
            bars: vec![
                ("first".to_owned(), 1, vec![1.0, -2.0]),
                ("second".to_owned(), 2, vec![2.0]),
            ],
        }),
    };
    let map = Panel {
        title: "map".to_owned(),
        x: Axis::linear("x"),
        y: Axis::linear("y"),
        content: Content::Map(Map {
            rows: vec![vec![0.0, 1.0], vec![f64::NAN, 2.0]],
            x: [0.0, 1.0],
            y: [0.0, 1.0],
            label: "RMSE".to_owned(),
            range: Some([0.0, 1.0]),
        }),
    };
    let intervals = Panel {
        title: String::new(),
        x: Axis::linear("efficiency"),
        y: Axis::linear(""),
        content: Content::Intervals(Intervals {
            rows: vec![
                ("cap".to_owned(), 3, [0.86, 0.8, 0.9]),
                ("heitz".to_owned(), 6, [0.5, 0.0, f64::INFINITY]),
            ],
            mark: 1.0,
        }),
    };
    Figure::grid(2, vec![lines, bars, map, intervals])
}

/// All values of an attribute of the elements that begin so.
fn attributes(svg: &str, element: &str, name: &str) -> Vec<f64> {
    let key = format!(" {name}=\"");
    svg.lines()
        .filter(|l| l.trim_start().starts_with(element))
        .filter_map(|l| l.split_once(&key)?.1.split_once('"'))
        .map(|(value, _)| value.parse().unwrap())
        .collect()
}

#[test]
fn symbols_are_symbols() {
    let svg = figure().svg();
    for word in ["alpha", "theta", "phi", "eta", "deg", " x ", "^2", ">-"] {
        assert!(!svg.contains(word), "{word}");
    }
    for part in [
        "\u{3b1}<tspan",
        "\u{3b8}<tspan",
        "\u{3c6} = 0",
        "\u{b0}",
        "variance \u{d7} time",
    ] {
        assert!(svg.contains(part), "{part}");
    }
}

#[test]
fn legends_have_long_swatches_below_all_panels() {
    let figure = figure();
    let svg = figure.svg();
    let legend = &svg[svg.find("<g id=\"legend\">").unwrap()..];
    let ends: Vec<[f64; 2]> = attributes(legend, "<line", "x1")
        .into_iter()
        .zip(attributes(legend, "<line", "x2"))
        .map(|(a, b)| [a, b])
        .collect();
    assert_eq!(ends.len(), 2);
    assert!(ends.iter().all(|[a, b]| b - a >= SWATCH), "{ends:?}");
    let heights = attributes(legend, "<line", "y1");
    assert!(
        heights.iter().all(|y| *y > 2.0 * figure.panel[1]),
        "{heights:?}"
    );
    let [width] = attributes(&svg, "<svg", "width")[..] else {
        panic!("{svg}")
    };
    assert!(ends.iter().all(|[a, b]| *a > 0.0 && *b < width));
}

#[test]
fn ticks_on_the_paper_are_even() {
    let figure = figure();
    let svg = figure.svg();
    // The grid lines across the first panel, which is logarithmic: 1, 2, 5 or decades.
    let pale = format!("stroke=\"{}\"", canvas::PALE);
    let across = svg
        .lines()
        .filter(|l| l.starts_with("<line") && l.contains(&pale));
    let heights: Vec<f64> = across
        .filter_map(|l| {
            let of = |name: &str| attributes(l, "<line", name)[0];
            let is_own = of("x1") < figure.panel[0] && of("y1") < figure.panel[1];
            (of("y1") == of("y2") && is_own).then(|| of("y1"))
        })
        .collect();
    let gaps: Vec<f64> = heights.windows(2).map(|w| w[0] - w[1]).collect();
    let (least, most) = gaps
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(l, m), g| (l.min(*g), m.max(*g)));
    assert!(
        gaps.len() > 1 && most < 1.7 * least && least > 20.0,
        "{heights:?}"
    );
}

#[test]
fn plots_are_files_and_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let written = figure().write(folder.path(), "all", "All kinds.").unwrap();
    let png = std::fs::read(folder.path().join(written.png)).unwrap();
    let pixels = resvg::tiny_skia::Pixmap::decode_png(&png).unwrap();
    // Twice the size of the screen's.
    assert_eq!(pixels.width(), 1440);
    let dark = pixels.pixels().iter().filter(|p| p.red() < 100).count();
    assert!(dark > 5000, "{dark}");
    let text = std::fs::read_to_string(folder.path().join(written.svg)).unwrap();
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}
