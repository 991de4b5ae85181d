// Measured materials: a lobe from tables that a gonioreflectometer filled.
//
// With `u_m` the normal's place on the unit square, `x = sqrt(2 theta_m / pi)` and `y = (phi_m + pi) / (2 pi)`, and
// the warp `W` that takes uniform points to densities of visible normals:
//
//     f cos(theta_i) = rgb(W^-1(u_m)) D(u_m) / (4 sigma(wo))
//     p(wi) = p_luminance(W^-1(u_m)) p_vndf(u_m) / (|d wm / d u_m| 4 <wo, wm>)
//     |d wm / d u_m| = 2 pi^2 x sin(theta_m)
//
// Source: Dupuy and Jakob 2018, sections 4 and 5. The papers' i is our `wo`.
// Twin of specula-bsdf/src/measured/mod.rs. Departures: angles are fractions of turns where sines are taken; the
// sine of a half vector's polar angle is the length of its x and y.

import package::bsdf::bsdf_sample::{BsdfSample, bsdf_sample_none, bsdf_sample_of_reflection};
import package::math::arctangent::{arctangent};
import package::math::quarter::{quarter_sine};
import package::math::turns::{turns_sin_cos};
import package::measured::measured_grid::{MeasuredGridTable, measured_grid_between, measured_grid_cell, measured_grid_eval};
import package::measured::measured_slices::{MeasuredSlices, MeasuredSlicesAngles, measured_slices_about};
import package::measured::measured_table::{measured_table};
import package::measured::measured_warp::{MeasuredWarp, measured_warp_invert, measured_warp_pdf, measured_warp_sample};

/// Numbers before the tables.
const MEASURED_HEAD: u32 = 16u;
/// Where in the head the sizes of the grids begin.
const MEASURED_SIZES: u32 = 5u;
/// Where in the head the albedo is.
const MEASURED_ALBEDO: u32 = 13u;
/// `1 / (2 pi)`.
const MEASURED_TURNS: f32 = 0.15915494;

/// A measured reflection: where its tables are. Black where `wo` or `wi` are below the horizon.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured.
struct MeasuredLobe {
    /// Azimuths of the views.
    azimuths: MeasuredSlicesAngles,
    /// Polar angles of the views.
    polar: MeasuredSlicesAngles,
    /// Whether the lobe turns with the view.
    turns: bool,
    /// How many times the azimuths cover a turn: 1, 2 or 4.
    symmetry: u32,
    /// Whether colours are multiplied by `ndf / (4 sigma)`.
    jacobian: bool,
    /// Density of normals.
    ndf: MeasuredGridTable,
    /// Projected area of the microsurface, over the views.
    sigma: MeasuredGridTable,
    /// Density of visible normals.
    vndf: MeasuredWarp,
    /// Density by luminance over the coordinates in which visible normals are uniform.
    luminance: MeasuredWarp,
    /// Colours, over the same coordinates.
    rgb: MeasuredGridTable,
    /// Albedo, as a feature for denoisers.
    albedo: vec3f,
}

/// A view, mirrored to where the tables know it.
///
/// Twin: specula-bsdf/src/measured/mod.rs, View.
struct MeasuredView {
    /// The view, mirrored.
    wo: vec3f,
    /// Signs that x and y were multiplied by.
    signs: vec2f,
    /// Its azimuth in turns, in [-1/2, 1/2].
    azimuth: f32,
    /// The measured views about it.
    at: MeasuredSlices,
    /// `D / (4 sigma)` without D; 0 where nothing is seen.
    scale: f32,
}

/// A count of the head.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_count(index: u32) -> u32 {
    return u32(measured_table(index));
}

/// The sizes of a grid of the head: ndf, sigma, vndf, luminance.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_size(at: u32, which: u32) -> vec2u {
    let first = at + MEASURED_SIZES + 2u * which;
    return vec2u(measured_count(first), measured_count(first + 1u));
}

/// A warp whose tables begin at `start`.
///
/// * `slices`: how many.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_lobe_warp(size: vec2u, slices: u32, start: u32) -> MeasuredWarp {
    let numbers = slices * size.x * size.y;
    return MeasuredWarp(size, start, start + numbers, start + 2u * numbers);
}

/// The lobe whose numbers begin at `at`.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_of(at: u32) -> MeasuredLobe {
    var lobe: MeasuredLobe;
    let azimuths = measured_count(at);
    let polar = measured_count(at + 1u);
    let slices = azimuths * polar;
    lobe.turns = measured_table(at + 2u) > 0.0;
    lobe.symmetry = measured_count(at + 3u);
    lobe.jacobian = measured_table(at + 4u) > 0.0;
    let albedo = at + MEASURED_ALBEDO;
    lobe.albedo = vec3f(
        measured_table(albedo), measured_table(albedo + 1u), measured_table(albedo + 2u));
    var place = at + MEASURED_HEAD;
    lobe.azimuths = MeasuredSlicesAngles(azimuths, place);
    place += azimuths;
    lobe.polar = MeasuredSlicesAngles(polar, place);
    place += polar;
    lobe.ndf = MeasuredGridTable(measured_size(at, 0u), place);
    place += lobe.ndf.size.x * lobe.ndf.size.y;
    lobe.sigma = MeasuredGridTable(measured_size(at, 1u), place);
    place += lobe.sigma.size.x * lobe.sigma.size.y;
    lobe.vndf = measured_lobe_warp(measured_size(at, 2u), slices, place);
    place = lobe.vndf.marginal + slices * lobe.vndf.size.y;
    lobe.luminance = measured_lobe_warp(measured_size(at, 3u), slices, place);
    place = lobe.luminance.marginal + slices * lobe.luminance.size.y;
    lobe.rgb = MeasuredGridTable(lobe.luminance.size, place);
    return lobe;
}

/// The coordinate of a polar angle in radians.
///
/// Twin: specula-bsdf/src/measured/mod.rs, polar.
fn measured_polar(theta: f32) -> f32 {
    return sqrt(max(theta * (4.0 * MEASURED_TURNS), 0.0));
}

/// -1 for positive numbers, where the tables of symmetric surfaces begin, else 1.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::view.
fn measured_towards_minus(x: f32) -> f32 {
    return select(1.0, -1.0, x > 0.0);
}

/// `w` with x and y of other signs.
///
/// Twin: specula-bsdf/src/measured/mod.rs, mirrored.
fn measured_mirrored(w: vec3f, signs: vec2f) -> vec3f {
    return vec3f(w.xy * signs, w.z);
}

/// A view above the horizon.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::view.
fn measured_view(lobe: MeasuredLobe, wo: vec3f) -> MeasuredView {
    var view: MeasuredView;
    view.signs = vec2f(1.0);
    if lobe.symmetry > 1u {
        view.signs = vec2f(measured_towards_minus(wo.y));
        if lobe.symmetry == 4u {
            view.signs.x = measured_towards_minus(wo.x);
        }
    }
    view.wo = measured_mirrored(wo, view.signs);
    let theta = arctangent(length(view.wo.xy), view.wo.z);
    let phi = arctangent(view.wo.y, view.wo.x);
    view.azimuth = phi * MEASURED_TURNS;
    view.at = measured_slices_about(lobe.azimuths, lobe.polar, phi, theta);
    view.scale = 1.0;
    if lobe.jacobian {
        let place = vec2f(measured_polar(theta), view.azimuth + 0.5);
        let sigma = measured_grid_eval(lobe.sigma, place);
        view.scale = 0.0;
        if sigma > 0.0 {
            view.scale = 0.25 / sigma;
        }
    }
    return view;
}

/// Solid angle of reflections per area of the square of normals: `2 pi^2 x sin(theta_m) 4 <wo, wm>`.
///
/// Twin: specula-bsdf/src/measured/mod.rs, jacobian.
fn measured_jacobian(x: f32, sine: f32, cosine: f32) -> f32 {
    return max(19.739209 * x * sine, 1e-9) * max(4.0 * cosine, 1.0842022e-19);
}

/// `f cos` where the warp of visible normals takes `u` to `u_m`.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::value.
fn measured_value(lobe: MeasuredLobe, view: MeasuredView, u: vec2f, u_m: vec2f) -> vec3f {
    let cell = measured_grid_cell(lobe.rgb.size, u);
    var value = vec3f(0.0);
    for (var channel = 0u; channel < 3u; channel++) {
        let next = max(measured_grid_between(lobe.rgb, view.at, cell, 3u, channel), 0.0);
        value = vec3f(value.yz, next);
    }
    if lobe.jacobian {
        value *= max(measured_grid_eval(lobe.ndf, u_m), 0.0) * view.scale;
    }
    return value;
}

/// `f |cos|` and its density.
///
/// * `wo`, `wi`: unit, local frame.
/// * Returns: (red, green, blue, density in 1/sr).
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::eval_pdf.
fn measured_eval_pdf(lobe: MeasuredLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec4f {
    if wo.z <= 0.0 || wi.z <= 0.0 {
        return vec4f(0.0);
    }
    let view = measured_view(lobe, wo);
    let wm = normalize(view.wo + measured_mirrored(wi, view.signs));
    let sine = length(wm.xy);
    var azimuth = arctangent(wm.y, wm.x) * MEASURED_TURNS + 0.5;
    if lobe.turns {
        azimuth -= view.azimuth;
    }
    let u_m = vec2f(measured_polar(arctangent(sine, wm.z)), azimuth - floor(azimuth));
    let inverse = measured_warp_invert(lobe.vndf, view.at, u_m);
    let by_luminance = measured_warp_pdf(lobe.luminance, view.at, inverse.xy);
    let pdf = inverse.z * by_luminance / measured_jacobian(u_m.x, sine, dot(view.wo, wm));
    return vec4f(measured_value(lobe, view, inverse.xy, u_m), pdf);
}

/// `f |cos|`, in 1/sr.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::eval.
fn measured_eval(lobe: MeasuredLobe, wo: vec3f, wi: vec3f, transport: u32) -> vec3f {
    return measured_eval_pdf(lobe, wo, wi, transport).rgb;
}

/// Density of `measured_sample`, in 1/sr.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::pdf.
fn measured_pdf(lobe: MeasuredLobe, wo: vec3f, wi: vec3f) -> f32 {
    return measured_eval_pdf(lobe, wo, wi, 0u).a;
}

/// Samples `wi` by luminance and visible normals.
///
/// * `u`: uniform in [0, 1)^3; `u.x` is not used.
///
/// Twin: specula-bsdf/src/measured/mod.rs, Measured::sample.
fn measured_sample(lobe: MeasuredLobe, wo: vec3f, u: vec3f, transport: u32) -> BsdfSample {
    if wo.z <= 0.0 {
        return bsdf_sample_none();
    }
    let view = measured_view(lobe, wo);
    let coordinates = measured_warp_sample(lobe.luminance, view.at, u.yz);
    let normal = measured_warp_sample(lobe.vndf, view.at, coordinates.xy);
    let polar = normal.x * normal.x;
    let sine = quarter_sine(polar);
    var azimuth = normal.y + 0.5;
    if lobe.turns {
        azimuth += view.azimuth;
    }
    let along = turns_sin_cos(azimuth - floor(azimuth)).yx;
    let wm = vec3f(sine * along, quarter_sine(1.0 - polar));
    let cosine = dot(view.wo, wm);
    if cosine <= 0.0 {
        return bsdf_sample_none();
    }
    let pdf = coordinates.z * normal.z / measured_jacobian(normal.x, sine, cosine);
    let value = measured_value(lobe, view, coordinates.xy, normal.xy);
    let wi = wm * (2.0 * cosine) - view.wo;
    return bsdf_sample_of_reflection(measured_mirrored(wi, view.signs), vec4f(value, pdf));
}
