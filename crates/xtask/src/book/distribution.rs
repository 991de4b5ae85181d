//! Figures of the guide's pages about samplers: reflections of one view, seen from the side.

use std::fmt::Write;

use specula_bsdf::Alpha;
use specula_bsdf::math::{Vec3, vec3};
use specula_bsdf::vndf::{self, Reflections, Sampler};

/// Names of the figures, without `.svg`.
pub(super) const NAMES: [&str; 5] = [
    "distribution_heitz",
    "distribution_cap",
    "distribution_bounded",
    "distribution_exact",
    "distribution_beckmann",
];

/// Panels: polar angle of the view in degrees, alpha.
const PANELS: [(f64, [f64; 2]); 3] = [(30.0, [0.3, 0.3]), (60.0, [1.0, 1.0]), (75.0, [1.0, 0.2])];
/// Points that are shown, and that are counted.
const SHOWN: u32 = 500;
const COUNTED: u32 = 1 << 16;

const RADIUS: f64 = 110.0;
const STEP: f64 = 290.0;
const HORIZON: f64 = 140.0;
const BLUE: &str = "#1f5fa8";
const RED: &str = "#d2402e";

/// Every figure with its name.
pub(super) fn all() -> Vec<(&'static str, String)> {
    let samplers = [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ];
    let mut figures = Vec::new();
    for (name, sampler) in NAMES.into_iter().zip(samplers) {
        figures.push((
            name,
            figure(&|alpha, wo, u| Reflections::new(alpha, wo, sampler).sample_direction(u)),
        ));
    }
    let beckmann =
        figure(&|alpha, wo, u| vndf::reflect(wo, vndf::beckmann::sample_wm(alpha, wo, u)));
    figures.push((NAMES[4], beckmann));
    figures
}

type Sample<'a> = &'a dyn Fn(Alpha<f64>, Vec3<f64>, [f64; 2]) -> Vec3<f64>;

fn figure(sample: Sample) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} 300\" \
         font-family=\"sans-serif\" font-size=\"14\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        3.0 * STEP
    );
    for (centre, (angle, alpha)) in (0..).map(|i: u32| STEP * (f64::from(i) + 0.5)).zip(PANELS) {
        panel(&mut svg, centre, angle, alpha, sample);
    }
    svg.push_str("</svg>\n");
    svg
}

fn panel(svg: &mut String, centre: f64, angle: f64, [alpha_x, alpha_y]: [f64; 2], sample: Sample) {
    let (sine, cosine) = angle.to_radians().sin_cos();
    let wo = vec3(-sine, 0.0, cosine);
    let alpha = Alpha::clamped(alpha_x, alpha_y);
    let mut line = |text: String| {
        svg.push_str(&text);
        svg.push('\n');
    };
    line(format!(
        "<circle cx=\"{centre}\" cy=\"{HORIZON}\" r=\"{RADIUS}\" fill=\"#f6f6f6\" stroke=\"#bbb\"/>"
    ));
    for colour in [BLUE, RED] {
        let mut path = String::new();
        for i in 0..SHOWN {
            let wi = sample(alpha, wo, point(i));
            if (wi.z > 0.0) == (colour == BLUE) {
                let (x, y) = (centre + RADIUS * wi.x, HORIZON - RADIUS * wi.z);
                let _ = write!(path, "M{x:.1} {y:.1}h0");
            }
        }
        line(format!(
            "<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"2.6\" stroke-linecap=\"round\" opacity=\"0.7\"/>"
        ));
    }
    let (left, right) = (centre - RADIUS - 10.0, centre + RADIUS + 10.0);
    line(format!(
        "<path d=\"M{left} {HORIZON}H{right}\" stroke=\"#444\"/>"
    ));
    let (x, y) = (centre + RADIUS * wo.x, HORIZON - RADIUS * wo.z);
    line(format!(
        "<path d=\"M{centre} {HORIZON}L{x:.1} {y:.1}\" stroke=\"#e08a00\" stroke-width=\"3\"/>"
    ));
    let below = (0..COUNTED)
        .filter(|&i| sample(alpha, wo, point(i)).z <= 0.0)
        .count();
    let share = 100.0 * below as f64 / f64::from(COUNTED);
    let alphas = if alpha_x == alpha_y {
        format!("alpha {alpha_x}")
    } else {
        format!("alpha ({alpha_x}, {alpha_y})")
    };
    for (y, text) in [
        (270, format!("{alphas}, view at {angle}°")),
        (290, format!("{share:.1} % below the horizon")),
    ] {
        line(format!(
            "<text x=\"{centre}\" y=\"{y}\" text-anchor=\"middle\">{text}</text>"
        ));
    }
}

/// Point `i` of the two-dimensional R2 sequence.
fn point(i: u32) -> [f64; 2] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.754_877_666_246_693), at(0.569_840_290_998_053)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exact_sampler_rejects_nothing_and_caps_as_much_as_heitz() {
        let shares = |figure: &str| -> Vec<f64> {
            let texts = figure
                .split(" % below")
                .filter_map(|part| part.rsplit('>').next());
            texts.filter_map(|text| text.parse().ok()).collect()
        };
        let figures = all();
        assert_eq!(figures.len(), NAMES.len());
        let [heitz, cap, bounded, exact] = [0, 1, 2, 3].map(|i| shares(&figures[i].1));
        assert_eq!(exact, [0.0; 3]);
        for i in 0..3 {
            assert!((heitz[i] - cap[i]).abs() < 0.5, "{heitz:?} {cap:?}");
            assert!(bounded[i] <= cap[i], "{bounded:?} {cap:?}");
        }
        assert!(heitz[1] > 10.0, "{heitz:?}");
    }
}
