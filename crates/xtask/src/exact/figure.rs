//! The figure of `docs/exact-reflection-sampling.md`, as SVG.

use std::fmt::Write;

use specula_bsdf::math::{Vec3, vec3};
use specula_bsdf::{Alpha, vndf};

use super::mirror::Cone;
use super::{r2, view};

const RADIUS: f64 = 135.0;
const HEIGHT: f64 = 350.0;
const WIDTH: f64 = 960.0;
const STEPS: u32 = 180;
const RED: &str = "#c0392b";
const BLUE: &str = "#1f5fa8";
const ORANGE: &str = "#e08a00";

/// Two axes of a projection of the sphere, right and up.
struct Axes(Vec3<f64>, Vec3<f64>);

impl Axes {
    /// Seen along `towards`, with `right` to the right.
    fn new(towards: Vec3<f64>, right: Vec3<f64>) -> Self {
        let right = right.normalize();
        Self(right, towards.normalize().cross(right))
    }

    fn place(&self, centre: f64, m: Vec3<f64>) -> String {
        let (x, y) = (m.dot(self.0), m.dot(self.1));
        format!("{:.1},{:.1}", centre + RADIUS * x, 160.0 - RADIUS * y)
    }
}

/// Three pictures of one view of alphas (0.5, 1.5).
pub(super) fn draw() -> String {
    let alpha = Alpha::clamped(0.5, 1.5);
    let wo = view(60.0, 40.0);
    let cone = Cone::new(alpha, wo);
    let (h, k) = (cone.h, cone.h.cross(cone.v));
    let along_view = Axes::new(h, vec3(-h.y, h.x, 0.0));
    let along_axis = Axes::new(cone.v, -k);
    let across = Axes::new(h, -k);

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n"
    );
    rejected(&mut svg, 160.0, &along_view, alpha, wo, &cone);
    let section: Vec<_> = rim(&cone);
    for (centre, axes) in [(480.0, &along_axis), (800.0, &across)] {
        disk(&mut svg, centre);
        polygon(&mut svg, &section, axes, centre, "#e4edf7", BLUE);
        chords(&mut svg, centre, axes, &cone);
    }
    uniform_along_the_axis(&mut svg, 480.0, &along_axis, &cone);
    plotted(&mut svg, 800.0, &across, alpha, wo, k);
    let captions = [
        [
            "Seen along the view: visible normals (grey),",
            "bounded cap (dashed), valid cone (blue).",
        ],
        [
            "Seen along the cone's axis: an ellipse,",
            "its chords across k of equal density.",
        ],
        [
            "Seen along the view: the same chords. Orange:",
            "points that walked on along the opposite one.",
        ],
    ];
    for (i, lines) in (0..).zip(captions) {
        for (j, line) in (0..).zip(lines) {
            let (x, y) = (160 + 320 * i, 318 + 18 * j);
            text(
                &mut svg,
                &format!("<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{line}</text>"),
            );
        }
    }
    text(&mut svg, "</svg>");
    svg
}

fn text(svg: &mut String, line: &str) {
    svg.push_str(line);
    svg.push('\n');
}

fn turns() -> impl Iterator<Item = (f64, f64)> {
    (0..STEPS).map(|i| (std::f64::consts::TAU * f64::from(i) / f64::from(STEPS)).sin_cos())
}

/// The edge of the cone on the sphere.
fn rim(cone: &Cone) -> Vec<Vec3<f64>> {
    turns().map(|(s, c)| cone.above(c, s)).collect()
}

fn disk(svg: &mut String, centre: f64) {
    text(
        svg,
        &format!(
            "<circle cx=\"{centre}\" cy=\"160\" r=\"{RADIUS}\" fill=\"none\" stroke=\"#999\"/>"
        ),
    );
}

fn polygon(
    svg: &mut String,
    points: &[Vec3<f64>],
    axes: &Axes,
    centre: f64,
    fill: &str,
    line: &str,
) {
    let places: Vec<_> = points.iter().map(|&m| axes.place(centre, m)).collect();
    let places = places.join(" ");
    text(
        svg,
        &format!("<polygon points=\"{places}\" fill=\"{fill}\" stroke=\"{line}\"/>"),
    );
}

fn dot(svg: &mut String, place: &str, colour: &str) {
    let (x, y) = place.split_once(',').unwrap_or((place, "0"));
    text(
        svg,
        &format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"1.7\" fill=\"{colour}\"/>"),
    );
}

/// Caps: which visible normals reflect above the surface.
fn rejected(
    svg: &mut String,
    centre: f64,
    axes: &Axes,
    alpha: Alpha<f64>,
    wo: Vec3<f64>,
    cone: &Cone,
) {
    let i = cone.h.normalize();
    let half = |o: Vec3<f64>| (o + i).normalize();
    let circle = |z: f64| -> Vec<Vec3<f64>> {
        let sine = (1.0 - z * z).sqrt();
        turns()
            .map(|(s, c)| half(vec3(sine * c, sine * s, z)))
            .collect()
    };
    disk(svg, centre);
    // All visible normals: half the disk, and half the ellipse of the plane z = 0.
    let flat = vec3(i.x, i.y, 0.0).normalize();
    let all: Vec<_> = turns()
        .map(|(s, c)| axes.0 * c + if s < 0.0 { flat * -s } else { axes.1 * s })
        .collect();
    polygon(svg, &all, axes, centre, "#eeeeee", "#999");
    polygon(svg, &rim(cone), axes, centre, "#dbe8f6", BLUE);
    let k = 2.0 * vndf::bounded::norm(alpha, wo) / cone.h.length() - 1.0;
    let bound: Vec<_> = circle(-k);
    let places: Vec<_> = bound.iter().map(|&m| axes.place(centre, m)).collect();
    let places = places.join(" ");
    text(
        svg,
        &format!(
            "<polygon points=\"{places}\" fill=\"none\" stroke=\"#333\" stroke-dasharray=\"5 4\"/>"
        ),
    );
    for n in 0..400 {
        let wm = vndf::cap::sample_wm(alpha, wo, r2(n));
        let colour = if vndf::reflect(wo, wm).z > 0.0 {
            BLUE
        } else {
            RED
        };
        let m = vec3(wm.x / alpha.x, wm.y / alpha.y, wm.z).normalize();
        dot(svg, &axes.place(centre, m), colour);
    }
}

/// Chords of the cone in the planes across `k`, at equal steps of the disk.
fn chords(svg: &mut String, centre: f64, axes: &Axes, cone: &Cone) {
    let k = cone.h.cross(cone.v);
    // The direction of the disk along which `k . m` grows.
    let (dx, dy) = (k.dot(cone.above(1.0, 0.0)), k.dot(cone.above(0.0, 1.0)));
    let scale = 1.0 / dx.hypot(dy);
    let (dx, dy) = (dx * scale, dy * scale);
    for i in -4..=4 {
        let y = 0.2 * f64::from(i);
        let c = (1.0 - y * y).sqrt();
        let ends =
            [c, -c].map(|c| axes.place(centre, cone.above(y * dx - c * dy, y * dy + c * dx)));
        let mut path = String::new();
        let _ = write!(path, "<polyline points=\"{} {}\"", ends[0], ends[1]);
        text(svg, &format!("{path} stroke=\"#9db8d6\" fill=\"none\"/>"));
    }
}

fn uniform_along_the_axis(svg: &mut String, centre: f64, axes: &Axes, cone: &Cone) {
    for n in 0..400 {
        let [u, turn] = r2(n);
        let (s, c) = (std::f64::consts::TAU * turn).sin_cos();
        dot(
            svg,
            &axes.place(centre, cone.above(u.sqrt() * c, u.sqrt() * s)),
            BLUE,
        );
    }
}

/// The exact sampler's normals, those that changed their chord in orange.
fn plotted(
    svg: &mut String,
    centre: f64,
    axes: &Axes,
    alpha: Alpha<f64>,
    wo: Vec3<f64>,
    k: Vec3<f64>,
) {
    for n in 0..400 {
        let u = r2(n);
        let wm = wo + vndf::exact::sample_direction(alpha, wo, u);
        let m = vec3(wm.x / alpha.x, wm.y / alpha.y, wm.z).normalize();
        let changed = (u[1] > 0.5) != (m.dot(k) > 0.0);
        dot(
            svg,
            &axes.place(centre, m),
            if changed { ORANGE } else { BLUE },
        );
    }
}
