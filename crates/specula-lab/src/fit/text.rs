//! A fitted lobe as text to paste: for this program, pbrt-v4 and Mitsuba 3.

use super::candidates::{Bounces, Distribution, FresnelModel, four_digits};
use super::solve::Fit;
use crate::output::Table;

/// The texts of a fit.
pub(super) fn table(fit: &Fit) -> Table {
    let mut table = Table::new(
        "text",
        "The chosen lobe to paste. pbrt-v4 and Mitsuba 3 scatter once at each hit.",
        &["for", "text"],
    );
    for (place, text) in texts(fit) {
        table.push([place.into(), text.into()]);
    }
    table
}

/// Where a text goes, and the text.
fn texts(fit: &Fit) -> Vec<(&'static str, String)> {
    let mut all = vec![(
        "the library (Rust, C, Python) and the studio",
        fit.lobe.to_string(),
    )];
    let candidate = &fit.candidate;
    if candidate.fresnel == FresnelModel::F82 {
        return all;
    }
    let colours: Vec<String> = fit.parameters[candidate.alphas()..]
        .iter()
        .map(|v| short(*v))
        .collect();
    let triple = |i: usize| colours[i..i + 3].join(" ");
    let (eta, k) = (triple(0), triple(3));
    let [x, y] = fit.alpha.map(short);
    let is_beckmann = candidate.distribution == Distribution::Beckmann;
    let distribution = if is_beckmann {
        " distribution beckmann"
    } else {
        ""
    };
    let energy = match candidate.bounces {
        Bounces::Single => "none",
        Bounces::Compensated => "kulla-conty",
        Bounces::All => "multibounce",
    };
    all.push((
        "specula render",
        format!(
            "--energy {energy} --material \"conductor conductor_eta {eta} conductor_k {k} alpha {x} {y}{distribution}\""
        ),
    ));
    if !is_beckmann {
        all.push((
            "pbrt-v4",
            format!(
                "Material \"conductor\" \"rgb eta\" [{eta}] \"rgb k\" [{k}] \"float uroughness\" [{x}] \
                 \"float vroughness\" [{y}] \"bool remaproughness\" [false]"
            ),
        ));
    }
    let name = if is_beckmann { "beckmann" } else { "ggx" };
    all.push((
        "Mitsuba 3",
        format!(
            "<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"{name}\"/><float name=\"alpha_u\" \
             value=\"{x}\"/><float name=\"alpha_v\" value=\"{y}\"/><rgb name=\"eta\" value=\"{eta}\"/><rgb name=\"k\" \
             value=\"{k}\"/></bsdf>"
        ),
    ));
    all
}

fn short(v: f64) -> String {
    four_digits(v).to_string()
}
