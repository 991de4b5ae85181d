// A coat with a medium over a base: its parameters, and what two smooth surfaces do in closed form.

import package::bsdf::layered::layered_base::{LAYERED_BASE_DIFFUSE, LAYERED_BASE_METAL, LayeredBase, layered_base_is_mirror, layered_base_reflectance};
import package::bsdf::layered::layered_coat::{LayeredCoat, layered_coat_below};
import package::bsdf::layered::layered_medium::{LayeredMedium, layered_medium_scatters, layered_medium_transmittance};
import package::bsdf::microfacets::{MicrofacetsModel};
import package::fresnel::dielectric::{dielectric};

/// Events below the coat after which a walk ends whatever it carries.
const LAYERED_LOBE_MOST_EVENTS: u32 = 1000u;
/// Least factor of a series.
const LAYERED_LOBE_TINY: f32 = 1.1754944e-38;
/// Largest factor of a series.
const LAYERED_LOBE_LARGEST: f32 = 0.99999988;

/// A dielectric coat, a medium and a base.
///
/// Smooth on smooth, without scattering, it is a mirror in closed form, `k` counting bounces off the
/// base:
///
///     R + T^2 sum_(k = 1)^(n / 2) F^k R^(k - 1) exp(-2 k t / |cos'|),   n = max_depth
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered.
struct LayeredLobe {
    /// On top.
    coat: LayeredCoat,
    /// Below.
    base: LayeredBase,
    /// Between them.
    medium: LayeredMedium,
    /// The base's normals as the density sees them, sampled by the sampler of choice.
    blurred: MicrofacetsModel,
    /// 1 where they are a lobe.
    has_lobe: u32,
    /// Walks end after so many events below the coat's surface: bounces off coat and base, collisions in
    /// the medium, and leaving. 1000 at most.
    max_depth: u32,
    /// Values are means of so many walks, 1 to 1024.
    walks: u32,
    /// One of `SAMPLER_HEITZ`, `SAMPLER_CAP`, `SAMPLER_BOUNDED` and `SAMPLER_EXACT`: by which the coat's
    /// reflections are weighed.
    strategy: u32,
}

/// Whether all that leaves is mirrored.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::is_mirror.
fn layered_lobe_is_mirror(lobe: LayeredLobe) -> bool {
    let is_clear = lobe.coat.rough == 0u && !layered_medium_scatters(lobe.medium);
    return layered_base_is_mirror(lobe.base) && is_clear;
}

/// Whether the base's lobe is less than half as wide as a rough coat's: then first bounces are sampled
/// from the light, too.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::is_base_narrow.
fn layered_lobe_is_base_narrow(lobe: LayeredLobe) -> bool {
    if lobe.base.kind == LAYERED_BASE_DIFFUSE {
        return false;
    }
    let coat = lobe.coat.facets.alpha * f32(lobe.coat.rough);
    let metal_alpha = lobe.base.facets.alpha * select(0.0, 1.0, lobe.base.kind == LAYERED_BASE_METAL);
    return 2.0 * max(metal_alpha.x, metal_alpha.y) < max(coat.x, coat.y);
}

/// What leaves along `v` between two smooth surfaces, of light that starts upwards and of light that
/// starts downwards, `F` not yet taken.
///
///     (up + F down) (1 + x + x^2 + ..),   x = F R exp(-2 t / |cos|)
///
/// * `events`: how many are allowed, leaving included.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::echoes.
fn layered_lobe_echoes(lobe: LayeredLobe, v: vec3f, up: f32, down: f32, events: u32) -> vec3f {
    let back = dielectric(v.z, 1.0 / lobe.coat.eta).reflectance;
    let through = layered_medium_transmittance(lobe.medium.thickness, v);
    let fresnel = layered_base_reflectance(lobe.base, v.z);
    let x = fresnel * (back * through * through);
    let raised = up * layered_lobe_series(x, (events + 1u) / 2u);
    return raised + fresnel * down * layered_lobe_series(x, events / 2u);
}

/// Reflectance of smooth on smooth.
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, Layered::mirrored.
fn layered_lobe_mirrored(lobe: LayeredLobe, wo: vec3f) -> vec3f {
    let coat = dielectric(abs(wo.z), lobe.coat.eta);
    let below = layered_coat_below(lobe.coat, wo);
    let through = layered_medium_transmittance(lobe.medium.thickness, below);
    let once = layered_base_reflectance(lobe.base, below.z) * (through * through);
    let echoes = layered_lobe_series(once * coat.reflectance, lobe.max_depth / 2u);
    let passed = coat.transmittance * coat.transmittance;
    return vec3f(coat.reflectance) + passed * once * echoes;
}

/// `1 + x + x^2 + ..`, of a number of terms.
///
/// * `x`: in [0, 1].
///
/// Twin: specula-bsdf/src/bsdf/layered/mod.rs, series.
fn layered_lobe_series(x: vec3f, terms: u32) -> vec3f {
    let share = clamp(x, vec3f(LAYERED_LOBE_TINY), vec3f(LAYERED_LOBE_LARGEST));
    let cut = vec3f(1.0) - exp(f32(terms) * layered_lobe_log(share));
    return cut / (vec3f(1.0) - share);
}

/// `ln x` for `0 < x < 1`, precise near 1 too, where a GPU's own may not be.
///
/// Twin: f64::ln.
fn layered_lobe_log(x: vec3f) -> vec3f {
    // 2 artanh((x - 1) / (x + 1)).
    let t = (x - vec3f(1.0)) / (x + vec3f(1.0));
    let s = t * t;
    let near_one = 2.0 * t * (1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * (1.0 / 9.0)))));
    return select(near_one, log(x), x < vec3f(0.7));
}
