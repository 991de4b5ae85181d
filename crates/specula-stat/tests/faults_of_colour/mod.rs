//! Faults of colour, index and side. Each is the textbook's own lobe or walk with one thing wrong, so that what is
//! compared differs in that alone; `tests/colours.rs` makes the same comparisons of the library's lobes.

use std::f64::consts::PI;

use specula_bsdf::bsdf::{Gltf, GltfParameters, Principled, PrincipledParameters};
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::math::{Stream, rgb};
use specula_bsdf::{Bsdf, Rgb, Transport, Vec3};
use specula_stat::Check;

use crate::common::at;
use crate::textbook::fresnel::{GOLD, average, conductor, dielectric, of_metal};
use crate::textbook::{
    EXACT, Facets, INTERFACE_TABLES, Shape, TABLES, Tolerance, Value, compare, energy, fresnel,
    glass, half, metal, walks,
};

const ROUGH: Facets = Facets {
    shape: Shape::Ggx,
    alpha: (0.5, 0.5),
};
const ROUGHEST: Facets = Facets {
    shape: Shape::Ggx,
    alpha: (1.0, 1.0),
};
const ETA: f64 = 1.5;

fn colour() -> Rgb<f64> {
    rgb(0.8, 0.4, 0.1)
}

fn views() -> Vec<Vec3<f64>> {
    vec![at(10.0, 20.0), at(60.0, 70.0)]
}

fn gold(cos: f64) -> Rgb<f64> {
    of_metal(GOLD)(cos)
}

fn right_metal(wo: Vec3<f64>, wi: Vec3<f64>) -> Rgb<f64> {
    metal(ROUGH, gold, wo, wi)
}

/// That values with a fault are told from those without, which are not told from themselves.
fn is_caught(name: &str, lowest: f64, wrong: Value<'_>, right: Value<'_>, tolerance: Tolerance) {
    let check = |value| compare(name, &views(), lowest, (value, right), tolerance);
    assert_told(&check(wrong), &check(right));
}

/// The same of walks.
fn walk_is_caught(name: &str, wrong: walks::Sample<'_>, right: walks::Sample<'_>) {
    let truth = walks::light(2, right);
    let told = |sample| walks::compare(name, &walks::light(1, sample), &truth);
    assert_told(&told(wrong), &told(right));
}

fn assert_told(wrong: &Check, right: &Check) {
    assert!(!wrong.is_pass, "not caught: {wrong}");
    assert!(right.is_pass, "{right}");
}

#[test]
fn fresnel_at_the_facets_tilt() {
    let wrong = |wo: Vec3<f64>, wi: Vec3<f64>| {
        gold(half(wo, wi).z) * ROUGH.white(wo, wi) * f64::from(u8::from(wi.z > 0.0))
    };
    is_caught("tilt", 0.0, &wrong, &right_metal, EXACT);
}

#[test]
fn fresnel_at_the_view() {
    let wrong = |wo: Vec3<f64>, wi| metal(ROUGH, |_| gold(wo.z), wo, wi);
    is_caught("view", 0.0, &wrong, &right_metal, EXACT);
}

#[test]
fn a_metal_without_its_absorption() {
    let fresnel = |cos| {
        let [r, g, b] = GOLD.map(|[eta, _]| conductor(cos, eta, 0.0));
        rgb(r, g, b)
    };
    let wrong = |wo, wi| metal(ROUGH, fresnel, wo, wi);
    is_caught("absorption", 0.0, &wrong, &right_metal, EXACT);
}

#[test]
fn red_and_blue_exchanged() {
    let wrong = |wo, wi| {
        let f = right_metal(wo, wi);
        rgb(f.b, f.g, f.r)
    };
    is_caught("channels", 0.0, &wrong, &right_metal, EXACT);
}

#[test]
fn a_metal_as_grey_as_its_luminance() {
    let wrong = |wo, wi| Rgb::splat(right_metal(wo, wi).luminance());
    is_caught("grey", 0.0, &wrong, &right_metal, EXACT);
}

#[test]
fn a_tint_that_is_squared() {
    let right = |wo, wi| right_metal(wo, wi) * colour();
    let wrong = |wo, wi| right(wo, wi) * colour();
    is_caught("tint", 0.0, &wrong, &right, EXACT);
}

fn right_glass(wo: Vec3<f64>, wi: Vec3<f64>) -> Rgb<f64> {
    Rgb::splat(glass(ROUGH, ETA, (wo, wi), Transport::Radiance))
}

#[test]
fn the_index_upside_down() {
    let wrong = |wo, wi| Rgb::splat(glass(ROUGH, 1.0 / ETA, (wo, wi), Transport::Radiance));
    is_caught("index", -1.0, &wrong, &right_glass, EXACT);
}

#[test]
fn radiance_that_is_not_scaled() {
    let wrong = |wo, wi| Rgb::splat(glass(ROUGH, ETA, (wo, wi), Transport::Importance));
    is_caught("radiance", -1.0, &wrong, &right_glass, EXACT);
}

#[test]
fn radiance_scaled_the_wrong_way() {
    let wrong = |wo: Vec3<f64>, wi: Vec3<f64>| {
        let scale = if wo.z * wi.z < 0.0 { ETA.powi(4) } else { 1.0 };
        right_glass(wo, wi) * scale
    };
    is_caught("radiance", -1.0, &wrong, &right_glass, EXACT);
}

#[test]
fn tints_of_the_two_sides_exchanged() {
    let (reflection, transmission) = (colour(), rgb(0.3, 0.9, 0.6));
    let tinted = |near, far| {
        move |wo: Vec3<f64>, wi: Vec3<f64>| {
            right_glass(wo, wi) * if wo.z * wi.z > 0.0 { near } else { far }
        }
    };
    let right = tinted(reflection, transmission);
    is_caught(
        "sides",
        -1.0,
        &tinted(transmission, reflection),
        &right,
        EXACT,
    );
}

#[test]
fn refraction_with_the_fresnel_term_of_reflection() {
    let wrong = |wo: Vec3<f64>, wi: Vec3<f64>| {
        let f = right_glass(wo, wi);
        if wo.z * wi.z > 0.0 {
            return f;
        }
        let sum = wo + wi * ETA;
        let cos = (wo.dot(sum) / sum.length()).abs();
        let share = dielectric(cos, ETA);
        f * (share / (1.0 - share).max(1e-9))
    };
    is_caught("share", -1.0, &wrong, &right_glass, EXACT);
}

#[test]
fn turquins_factor_by_a_reflectance_of_grazing_angles() {
    let turquin = |f0| {
        let model = EnergyModel::Turquin(FmsVariant::NormalIncidence);
        energy::compensated_metal(ROUGHEST, model, [f0, Rgb::BLACK])
    };
    let (wrong, right) = (turquin(gold(0.3)), turquin(gold(1.0)));
    is_caught("Turquin", 0.0, &wrong, &right, TABLES);
}

/// Kulla and Conty's metal with this average reflectance.
fn kulla_conty(average: Rgb<f64>) -> impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> {
    energy::compensated_metal(ROUGHEST, EnergyModel::KullaConty, [gold(1.0), average])
}

#[test]
fn kulla_contys_average_five_per_cent_high() {
    let right = average(gold);
    let (wrong, right) = (kulla_conty(right * 1.05), kulla_conty(right));
    is_caught("Kulla-Conty", 0.0, &wrong, &right, TABLES);
}

#[test]
fn kulla_conty_with_one_factor_of_the_average_too_few() {
    let right = average(gold);
    let book = kulla_conty(right);
    let wrong = |wo, wi| {
        let single = metal(ROUGHEST, gold, wo, wi);
        single + (book(wo, wi) - single) * right.map(|f| 1.0 / f)
    };
    is_caught("Kulla-Conty", 0.0, &wrong, &book, TABLES);
}

#[test]
fn compensated_glass_that_transmits_four_fifths() {
    let glass = |of_share| energy::compensated_glass(ROUGHEST, ETA, of_share);
    let (wrong, right) = (glass(0.8), glass(1.0));
    is_caught("compensated glass", -1.0, &wrong, &right, INTERFACE_TABLES);
}

/// Walks off gold with this reflectance.
fn walk(
    fresnel: impl Fn(usize, f64, Vec3<f64>) -> Rgb<f64> + Sync,
) -> impl Fn(&mut Stream) -> Option<(Vec3<f64>, Rgb<f64>)> + Sync {
    move |stream| walks::metal(ROUGHEST, &fresnel, at(30.0, 20.0), stream)
}

fn right_walk() -> impl Fn(&mut Stream) -> Option<(Vec3<f64>, Rgb<f64>)> + Sync {
    walk(|_, cos, _| gold(cos))
}

#[test]
fn walks_with_the_root_of_the_cosine() {
    let wrong = walk(|_, cos, _| gold(cos.max(0.0).sqrt()));
    walk_is_caught("root", &wrong, &right_walk());
}

#[test]
fn walks_whose_further_bounces_are_at_normal_incidence() {
    let wrong = walk(|bounce, cos, _| gold(if bounce == 0 { cos } else { 1.0 }));
    walk_is_caught("normal incidence", &wrong, &right_walk());
}

#[test]
fn walks_with_fresnel_at_the_facets_tilt() {
    let wrong = walk(|_, _, m| gold(m.z));
    walk_is_caught("tilt", &wrong, &right_walk());
}

#[test]
fn walks_that_lose_their_colour_after_the_first_bounce() {
    let wrong = walk(|bounce, cos, _| match bounce {
        0 => gold(cos),
        _ => Rgb::splat(gold(cos).luminance()),
    });
    walk_is_caught("colourless", &wrong, &right_walk());
}

#[test]
fn walks_in_glass_that_keep_the_index_of_the_outside() {
    let walk = |reflectance: fn(f64, f64) -> f64| {
        move |s: &mut Stream| walks::glass(ROUGHEST, ETA, reflectance, at(130.0, 20.0), s)
    };
    let wrong = walk(|cos, _| dielectric(cos, ETA));
    walk_is_caught("index", &wrong, &walk(dielectric));
}

#[test]
fn a_coat_over_metal_that_stays_in_air() {
    // Smooth on smooth, as `coats_are_the_textbooks` has it.
    let leaves = |wo: Vec3<f64>, indices| {
        let r = dielectric(wo.z, ETA);
        let below = (1.0 - (1.0 - wo.z * wo.z) / (ETA * ETA)).sqrt();
        of_metal(indices)(below).map(|f| r + (1.0 - r) * (1.0 - r) * f / (1.0 - f * r))
    };
    for wo in views() {
        let right = leaves(wo, GOLD.map(|[n, k]| [n / ETA, k / ETA]));
        let off = (leaves(wo, GOLD) - right).map(f64::abs).max_channel();
        assert!(off > 1e-2, "{off}, where 1e-3 is told apart");
    }
}

#[test]
fn a_coat_with_fresnel_of_another_facet() {
    let right = |wo: Vec3<f64>, wi| Rgb::splat(glass(ROUGH, ETA, (wo, wi), Transport::Radiance));
    let wrong = |wo: Vec3<f64>, wi| {
        let cos = wo.dot(half(wo, wi));
        right(wo, wi) * (dielectric(wo.z, ETA) / dielectric(cos, ETA))
    };
    is_caught("coat", 0.0, &wrong, &right, EXACT);
}

fn schlick(cos: f64) -> Rgb<f64> {
    fresnel::schlick(colour(), cos)
}

/// Values of a lobe whose colour is Schlick's of the half vector, with that of the view instead.
fn schlick_at_the_view<B: Bsdf<f64>>(lobe: &B) -> impl Fn(Vec3<f64>, Vec3<f64>) -> Rgb<f64> + '_ {
    |wo, wi| {
        let right = schlick(wo.dot(half(wo, wi)));
        let wrong = schlick(wo.z);
        let value = lobe.eval(wo, wi, Transport::Radiance);
        rgb(
            value.r * wrong.r / right.r,
            value.g * wrong.g / right.g,
            value.b * wrong.b / right.b,
        )
    }
}

#[test]
fn principled_metal_with_fresnel_at_the_view() {
    let lobe = Principled::new(PrincipledParameters {
        base_colour: colour(),
        roughness: 0.5_f64.sqrt(),
        metallic: 1.0,
        ..PrincipledParameters::default()
    });
    let right = |wo: Vec3<f64>, wi: Vec3<f64>| {
        let masked = ROUGH.g1_g1(wo, wi) / ROUGH.g2(wo, wi);
        metal(ROUGH, schlick, wo, wi) * masked
    };
    is_caught(
        "principled",
        0.0,
        &schlick_at_the_view(&lobe),
        &right,
        EXACT,
    );
}

#[test]
fn gltf_metal_with_fresnel_at_the_view() {
    let lobe = Gltf::new(GltfParameters {
        base_colour: colour(),
        roughness: 0.5_f64.sqrt(),
        ..GltfParameters::default()
    });
    let right = |wo, wi| metal(ROUGH, schlick, wo, wi);
    is_caught("glTF", 0.0, &schlick_at_the_view(&lobe), &right, EXACT);
}

#[test]
fn a_base_that_takes_the_coats_colour() {
    let (specular, base) = (rgb(0.5, 0.9, 0.7), colour());
    let plastic = |base: Rgb<f64>| {
        move |wo: Vec3<f64>, wi: Vec3<f64>| {
            let fresnel = dielectric(wo.dot(half(wo, wi)), ETA);
            specular * (fresnel * ROUGH.white(wo, wi)) + base * (wi.z / PI)
        }
    };
    is_caught(
        "plastic",
        0.0,
        &plastic(base * specular),
        &plastic(base),
        TABLES,
    );
}
