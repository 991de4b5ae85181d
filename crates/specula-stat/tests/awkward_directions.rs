//! Plastics, principled and glTF materials stay finite for every direction and parameter, in both
//! precisions: poles, horizons, smooth and rough, black and white.

use specula_bsdf::bsdf::{
    Black, Gltf, GltfParameters, Lobe, Plastic, Principled, PrincipledParameters,
};
use specula_bsdf::math::{Rgb, Vec3, rgb, vec3, warp};
use specula_bsdf::ndf::{Beckmann, Ggx, Masking};
use specula_bsdf::{Alpha, Bsdf, Real, Transport};

fn r3(i: u32) -> [f64; 3] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.819_172_513), at(0.671_043_607), at(0.549_700_478)]
}

/// Values in `[0, 1]`, half of them at an end.
fn share<T: Real>(i: u32, k: u32) -> T {
    let x = r3(7 * i + 31 * k)[(k % 3) as usize];
    T::of((2.0 * x - 0.5).clamp(0.0, 1.0))
}

fn plastics<T: Real>() -> Vec<Lobe<T>> {
    let colour = rgb(T::of(0.9), T::of(0.5), T::ZERO);
    let mut lobes = vec![Black.into()];
    for eta in [0.5, 1.0, 1.5, 3.0].map(T::of) {
        lobes.push(Plastic::smooth(eta, Rgb::WHITE, Rgb::WHITE, true).into());
        lobes.push(Plastic::smooth(eta, colour, Rgb::BLACK, false).into());
        for (x, y) in [(1e-4, 1e-4), (0.05, 0.5), (1.0, 1.0), (10.0, 0.3)] {
            let alpha = Alpha::clamped(T::of(x), T::of(y));
            for masking in [Masking::Separable, Masking::HeightCorrelated] {
                let ggx = Ggx::new(alpha);
                lobes.push(Plastic::rough(ggx, masking, eta, colour, Rgb::WHITE, false).into());
                let ndf = Beckmann::new(alpha);
                lobes.push(Plastic::rough(ndf, masking, eta, Rgb::BLACK, colour, true).into());
            }
        }
    }
    lobes
}

fn principled<T: Real>(i: u32) -> Lobe<T> {
    let s = |k| share::<T>(i, k);
    Principled::new(PrincipledParameters {
        base_colour: rgb(s(0), s(1), s(2)),
        roughness: s(3),
        anisotropic: s(4),
        metallic: s(5),
        spec_trans: s(6),
        eta: T::of([1.0, 1.3, 1.5, 0.7][(i % 4) as usize]),
        spec_tint: s(7),
        sheen: s(8),
        sheen_tint: s(9),
        clearcoat: s(10),
        clearcoat_gloss: s(11),
        flatness: s(12),
        diff_trans: s(13) + s(14),
        thin: i.is_multiple_of(3),
        outside: !i.is_multiple_of(5),
    })
    .into()
}

fn gltf<T: Real>(i: u32) -> Lobe<T> {
    let s = |k| share::<T>(i, k);
    Gltf::new(GltfParameters {
        base_colour: rgb(s(0), s(1), s(2)),
        metallic: s(3),
        roughness: s(4),
        anisotropy: s(5),
        ior: T::of([0.0, 1.0, 1.5, 2.4][(i % 4) as usize]),
        specular: s(6),
        specular_colour: rgb(s(7), s(8), T::TWO),
        transmission: s(9),
        volume: i.is_multiple_of(3),
        outside: !i.is_multiple_of(5),
        clearcoat: s(10),
        clearcoat_roughness: s(11),
        sheen_colour: rgb(s(12), s(13), s(14)),
        sheen_roughness: s(15),
        compensated: i.is_multiple_of(2),
    })
    .into()
}

fn directions<T: Real>() -> Vec<Vec3<T>> {
    let awkward = [
        vec3(0.0, 0.0, 1.0),
        vec3(0.0, 0.0, -1.0),
        vec3(1.0, 0.0, 0.0),
        vec3(0.0, -1.0, 1e-30),
        vec3(0.8, 0.6, -1e-12),
        vec3(1e-20, 0.0, 1.0),
        vec3(0.6, 0.0, 0.8),
        vec3(-0.6, 0.0, 0.8),
        vec3(-0.6, 0.0, -0.8),
    ];
    let spread = (0..16).map(|i| {
        let [_, a, b] = r3(i);
        warp::uniform_sphere([a, b])
    });
    awkward.into_iter().chain(spread).map(Vec3::cast).collect()
}

fn nothing_breaks<T: Real>() {
    let mut lobes = plastics::<T>();
    lobes.extend((0..60).map(principled));
    lobes.extend((0..60).map(gltf));
    let directions = directions::<T>();
    let good = |c: Rgb<T>| c.is_finite() && c.r >= T::ZERO && c.g >= T::ZERO && c.b >= T::ZERO;
    let mut sampled = 0;
    for lobe in &lobes {
        for &wo in &directions {
            for &wi in &directions {
                for transport in [Transport::Radiance, Transport::Importance] {
                    let (f, pdf) = lobe.eval_pdf(wo, wi, transport);
                    assert!(good(f), "{lobe:?} {wo:?} {wi:?}: {f:?}");
                    assert!(
                        pdf.is_finite() && pdf >= T::ZERO,
                        "{lobe:?} {wo:?} {wi:?}: {pdf:?}"
                    );
                }
            }
            let ends = [[0.0; 3], [1.0, 0.0, 0.5], [0.3, 1.0, 1.0]];
            for u in ends.into_iter().chain((0..10).map(r3)) {
                let u = u.map(|x| T::of(x).at_most(T::ONE - T::EPSILON));
                let Some(s) = lobe.sample(wo, u, Transport::Radiance) else {
                    continue;
                };
                sampled += 1;
                let unit = (s.wi.length() - T::ONE).abs() < T::of(1e-3);
                assert!(s.wi.is_finite() && unit, "{lobe:?} {wo:?} {u:?}: {s:?}");
                assert!(good(s.weight), "{lobe:?} {wo:?} {u:?}: {s:?}");
                let pdf = s.pdf.is_finite() && s.pdf > T::ZERO;
                assert!(pdf, "{lobe:?} {wo:?} {u:?}: {s:?}");
            }
        }
    }
    assert!(sampled > 20_000, "{sampled}");
}

#[test]
fn nothing_breaks_in_f32() {
    nothing_breaks::<f32>();
}

#[test]
fn nothing_breaks_in_f64() {
    nothing_breaks::<f64>();
}
