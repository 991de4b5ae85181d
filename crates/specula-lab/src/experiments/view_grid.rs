//! Grids of alphas and views that maps are made on.

use specula_bsdf::{Alpha, Vec3};

pub(super) use crate::direction::direction as view;
use crate::plot::{Axis, Content, Map, Panel};

/// Point `i` of the two-dimensional R2 sequence.
pub(super) fn r2(i: u32) -> [f64; 2] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.754_877_666_246_693), at(0.569_840_290_998_053)]
}

/// `count` views spread over the hemisphere by solid angle.
pub(super) fn hemisphere(count: u32) -> Vec<Vec3<f64>> {
    (0..count)
        .map(|i| {
            let [height, turn] = r2(i);
            view(height.acos().to_degrees(), 360.0 * turn)
        })
        .collect()
}

/// Middles of `count` equal parts of `[0, end]`.
pub(super) fn middles(count: u32, end: f64) -> Vec<f64> {
    (0..count)
        .map(|i| end * (f64::from(i) + 0.5) / f64::from(count))
        .collect()
}

/// Equal alphas over polar angles: values of a map, rows by angle, each over alphas up to 1.
pub(super) fn over_angles<T>(side: u32, value: impl Fn(Alpha<f64>, f64) -> T) -> Vec<Vec<T>> {
    middles(side, 90.0)
        .into_iter()
        .map(|theta| {
            let row = middles(side, 1.0).into_iter();
            row.map(|a| value(Alpha::isotropic(a), theta)).collect()
        })
        .collect()
}

/// Pairs of alphas up to 1: values of a map, rows by `alpha_y`, each over `alpha_x`.
pub(super) fn over_alphas<T>(side: u32, value: impl Fn(Alpha<f64>) -> T) -> Vec<Vec<T>> {
    middles(side, 1.0)
        .into_iter()
        .map(|y| {
            let row = middles(side, 1.0).into_iter();
            row.map(|x| value(Alpha::clamped(x, y))).collect()
        })
        .collect()
}

/// The axes of a map.
#[derive(Clone, Copy, Debug)]
pub(super) enum Axes {
    /// [`over_angles`].
    Angles,
    /// [`over_alphas`].
    Alphas,
}

/// A panel that shows one value of each cell.
pub(super) fn panel<T>(
    title: &str,
    axes: Axes,
    (label, range): (&str, [f64; 2]),
    cells: &[Vec<T>],
    pick: impl Fn(&T) -> f64,
) -> Panel {
    let (x, y, end) = match axes {
        Axes::Angles => ("alpha", "theta_o [deg]", 90.0),
        Axes::Alphas => ("alpha_x", "alpha_y", 1.0),
    };
    Panel {
        title: title.to_owned(),
        x: Axis::linear(x).from_to(0.0, 1.0),
        y: Axis::linear(y).from_to(0.0, end),
        content: Content::Map(Map {
            rows: cells
                .iter()
                .map(|row| row.iter().map(&pick).collect())
                .collect(),
            x: [0.0, 1.0],
            y: [0.0, end],
            label: label.to_owned(),
            range: Some(range),
        }),
    }
}
