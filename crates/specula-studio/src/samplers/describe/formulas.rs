//! The formulas, with numbers put in.

use std::f64::consts::PI;

use serde_json::{Value, json};
use specula_bsdf::ndf::{Ggx, Ndf};
use specula_bsdf::vndf::Sampler;

use crate::samplers::Surface;

const CAPS: &str = "Dupuy and Benyoub 2023";
const BOUNDED: &str = "Tokuyoshi and Eto 2024";
const OWN: &str = "Specula, docs/exact-reflection-sampling.md";

fn formula(id: &str, name: &str, tex: &str, numbers: String, value: f64, source: &str) -> Value {
    json!({"id": id, "name": name, "tex": tex, "numbers": numbers, "value": value, "source": source})
}

/// A number for TeX, with four digits; negative ones in parentheses.
fn n(x: f64) -> String {
    let plain = if x == 0.0 || (1e-3..1e4).contains(&x.abs()) {
        format!("{x:.4}")
    } else {
        let text = format!("{x:.3e}");
        match text.split_once('e') {
            Some((digits, power)) => format!(r"{digits} \cdot 10^{{{power}}}"),
            None => text,
        }
    };
    if x < 0.0 { format!("({plain})") } else { plain }
}

pub(super) fn stretching(surface: &Surface) -> Vec<Value> {
    let (a, i, hat) = (surface.alpha, surface.wo, surface.stretched());
    let length = surface.length();
    vec![
        formula(
            "t",
            "length of the stretched view",
            r"t = \sqrt{\alpha_x^2 i_x^2 + \alpha_y^2 i_y^2 + i_z^2}",
            format!(
                r"t = \sqrt{{{}^2 \cdot {}^2 + {}^2 \cdot {}^2 + {}^2}} = {}",
                n(a.x),
                n(i.x),
                n(a.y),
                n(i.y),
                n(i.z),
                n(length)
            ),
            length,
            "Tokuyoshi and Eto 2024, listing 2",
        ),
        formula(
            "stretched",
            "stretched view",
            r"\hat{\mathbf{i}} = \frac{1}{t} \left[\alpha_x i_x,\; \alpha_y i_y,\; i_z\right]",
            format!(
                r"\hat{{\mathbf{{i}}}} = \left[{},\; {},\; {}\right]",
                n(hat.x),
                n(hat.y),
                n(hat.z)
            ),
            hat.z,
            "Heitz 2018, section 3; Tokuyoshi and Eto 2024, step 1 of section 3.1",
        ),
    ]
}

pub(super) fn hemisphere(surface: &Surface) -> Value {
    let z = surface.stretched().z;
    let share = 0.5 * (1.0 + z);
    formula(
        "sigma_std",
        "area of the hemisphere seen from the view, over pi",
        r"\sigma_{\mathrm{std}} = \frac{1 + \hat{i}_z}{2}",
        format!(
            r"\sigma_{{\mathrm{{std}}}} = \frac{{1 + {}}}{{2}} = {}",
            n(z),
            n(share)
        ),
        share,
        "Dupuy and Benyoub 2023, eq. 4; sampled as by Heitz 2018",
    )
}

pub(super) fn cap(surface: &Surface) -> Value {
    let z = surface.stretched().z;
    formula(
        "bound",
        "lower bound of the cap",
        r"\hat{o}_z > -\hat{i}_z",
        format!(r"\hat{{o}}_z > {}", n(-z)),
        -z,
        &format!("{CAPS}, section 3.3"),
    )
}

/// Projected area of the visible normals.
pub(super) fn area(surface: &Surface) -> Value {
    let sigma = Ggx::new(surface.alpha).projected_area(surface.wo);
    formula(
        "sigma",
        "projected area of the visible normals",
        r"\sigma(\mathbf{i}) = \frac{i_z + t}{2}",
        format!(
            r"\sigma = \frac{{{} + {}}}{{2}} = {}",
            n(surface.wo.z),
            n(surface.length()),
            n(sigma)
        ),
        sigma,
        "Heitz 2014, eq. 72; Tokuyoshi and Eto 2024, eq. 8",
    )
}

pub(super) fn bounded(surface: &Surface) -> Vec<Value> {
    let ((a, s, k), i) = (surface.bound(), surface.wo);
    let (z, t) = (surface.stretched().z, surface.length());
    let norm = 0.5 * (k * i.z + t);
    let sign = if a > 1.0 { "-" } else { "+" };
    vec![
        formula(
            "alpha",
            "conservative alpha",
            r"\alpha = \min(\alpha_x, \alpha_y)",
            format!(
                r"\alpha = \min({}, {}) = {}",
                n(surface.alpha.x),
                n(surface.alpha.y),
                n(a)
            ),
            a,
            &format!("{BOUNDED}, eq. 7, without its clamp at 1 (the bound stays conservative)"),
        ),
        formula(
            "s",
            "longest sum of a horizontal direction and the view",
            r"s = 1 + \operatorname{sgn}(1 - \alpha) \sqrt{i_x^2 + i_y^2}",
            format!(
                r"s = 1 {sign} \sqrt{{{}^2 + {}^2}} = {}",
                n(i.x),
                n(i.y),
                n(s)
            ),
            s,
            &format!("{BOUNDED}, below eq. 5"),
        ),
        formula(
            "k",
            "bound of the cap over that of all visible normals",
            r"k = \frac{(1 - \alpha^2) s^2}{s^2 + \alpha^2 i_z^2}",
            format!(
                r"k = \frac{{(1 - {a}^2) \cdot {s}^2}}{{{s}^2 + {a}^2 \cdot {}^2}} = {}",
                n(i.z),
                n(k),
                a = n(a),
                s = n(s)
            ),
            k,
            &format!("{BOUNDED}, eq. 6"),
        ),
        formula(
            "bound",
            "lower bound of the cap",
            r"\hat{o}_z > -k \hat{i}_z",
            format!(r"\hat{{o}}_z > -{} \cdot {} = {}", n(k), n(z), n(-k * z)),
            -k * z,
            &format!("{BOUNDED}, eq. 6"),
        ),
        formula(
            "N",
            "normalisation",
            r"N = \frac{k i_z + t}{2}",
            format!(
                r"N = \frac{{{} \cdot {} + {}}}{{2}} = {}",
                n(k),
                n(i.z),
                n(t),
                n(norm)
            ),
            norm,
            &format!("{BOUNDED}, eq. 10"),
        ),
    ]
}

pub(super) fn exact(surface: &Surface) -> Vec<Value> {
    let Some(cone) = surface.cone() else {
        return Vec::new();
    };
    let (h, [dx, dy], v) = (surface.alpha.stretch(surface.wo), cone.d, cone.axis);
    let (lambda, norm) = (cone.lambda, cone.norm());
    vec![
        formula(
            "lambda",
            "eigenvalue of the cone of valid half vectors",
            concat!(
                r"\lambda = i_z + \frac{h_x^2}{D_x} + \frac{h_y^2}{D_y}, \quad ",
                r"D_j = \lambda + i_z \alpha_j^2, \quad \mathbf{h} = t \hat{\mathbf{i}}",
            ),
            format!(
                r"{} = {} + \frac{{{}^2}}{{{}}} + \frac{{{}^2}}{{{}}}",
                n(lambda),
                n(surface.wo.z),
                n(h.x),
                n(dx),
                n(h.y),
                n(dy)
            ),
            lambda,
            OWN,
        ),
        formula(
            "axis",
            "axis of the cone",
            r"\mathbf{v} = \left[\frac{h_x}{D_x},\; \frac{h_y}{D_y},\; 1\right]",
            format!(
                r"\mathbf{{v}} = \left[{},\; {},\; 1\right], \quad |\mathbf{{v}}|^2 = {}",
                n(v.x),
                n(v.y),
                n(v.length_squared())
            ),
            v.length_squared(),
            OWN,
        ),
        formula(
            "cone",
            "valid half vectors, moved along v onto the unit sphere",
            r"D_x x^2 + D_y y^2 < \lambda",
            format!(r"{} x^2 + {} y^2 < {}", n(dx), n(dy), n(lambda)),
            lambda,
            OWN,
        ),
        formula(
            "N",
            "normalisation",
            r"N = \frac{\lambda^2}{|\mathbf{v}|^2 \sqrt{D_x D_y}}",
            format!(
                r"N = \frac{{{}^2}}{{{} \sqrt{{{} \cdot {}}}}} = {}",
                n(lambda),
                n(v.length_squared()),
                n(dx),
                n(dy),
                n(norm)
            ),
            norm,
            OWN,
        ),
    ]
}

/// `D / (4 N)` at the mirror direction, whose normal is the surface's: `D = 1 / (pi ax ay)`.
pub(super) fn density(surface: &Surface, sampler: Sampler) -> Value {
    let reflections = surface.reflections(sampler);
    let d = 1.0 / (PI * surface.alpha.x * surface.alpha.y);
    let norm = reflections.norm();
    let (letter, source) = match sampler {
        Sampler::Heitz | Sampler::Cap => (
            r"\sigma(\mathbf{i})",
            "Tokuyoshi and Eto 2024, eq. 8 times the Jacobian 1 / (4 |i . m|)",
        ),
        Sampler::Bounded => (
            "N",
            "Tokuyoshi and Eto 2024, eq. 10 times the Jacobian 1 / (4 |i . m|)",
        ),
        Sampler::Exact => ("N", OWN),
    };
    let pdf = if surface.wo.z > 0.0 {
        d / (4.0 * norm)
    } else {
        0.0
    };
    formula(
        "pdf",
        "density of reflections; the number: at the mirror direction",
        &format!(r"p(\mathbf{{o}}) = \frac{{D(\mathbf{{m}})}}{{4 {letter}}} \quad (o_z > 0)"),
        format!(r"p = \frac{{{}}}{{4 \cdot {}}} = {}", n(d), n(norm), n(pdf)),
        pdf,
        source,
    )
}
