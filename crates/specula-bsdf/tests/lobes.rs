//! Facts about lobes that need no statistics: limits, energy in closed form, robustness.

use specula_bsdf::bsdf::{
    Base, CoatLayer, CoatScattering, CoatedDiffuse, DiffuseTransmission, Eon, Lambert, Layered,
    Lobe, RoughConductor, RoughDielectric, SmoothConductor, SmoothDielectric, ThinDielectric,
};
use specula_bsdf::fresnel::{Conductor, Reflectance, dielectric};
use specula_bsdf::math::{Rgb, Vec3, rgb, vec3};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::Sampler;
use specula_bsdf::{Alpha, Bsdf, Real, Transport};

const WHITE: Reflectance<f64> = Reflectance::Constant(Rgb {
    r: 1.0,
    g: 1.0,
    b: 1.0,
});

fn r3(i: u32) -> [f64; 3] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.819_172_513), at(0.671_043_607), at(0.549_700_478)]
}

fn direction(u: [f64; 3]) -> Vec3<f64> {
    specula_bsdf::math::warp::uniform_sphere([u[1], u[2]])
}

/// Mean weight over a low-discrepancy sequence: the directional albedo.
fn albedo(lobe: &impl Bsdf<f64>, wo: Vec3<f64>, transport: Transport) -> f64 {
    let n = 60_000;
    (0..n)
        .filter_map(|i| lobe.sample(wo, r3(i), transport))
        .map(|s| s.weight.g)
        .sum::<f64>()
        / f64::from(n)
}

#[test]
fn the_single_scatter_albedo_at_alpha_one_is_one_minus_ln_two() {
    let lobe = RoughConductor::new(Ggx::new(Alpha::isotropic(1.0)), WHITE);
    let expected = 1.0 - 2.0_f64.ln();
    for sampler in [
        Sampler::Heitz,
        Sampler::Cap,
        Sampler::Bounded,
        Sampler::Exact,
    ] {
        let got = albedo(&lobe.with_sampler(sampler), Vec3::Z, Transport::Radiance);
        assert!((got - expected).abs() < 2e-4, "{sampler}: {got}");
    }
}

#[test]
fn smooth_coats_over_white_return_all_light() {
    let lobe = CoatedDiffuse::new(None, 1.5, Rgb::WHITE);
    for &z in &[1.0_f64, 0.5, 0.1] {
        let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
        let got = albedo(&lobe, wo, Transport::Radiance);
        assert!((got - 1.0).abs() < 3e-3, "{z}: {got}");
    }
}

#[test]
fn rough_coats_over_white_lose_only_what_the_coat_scatters_twice() {
    for &a in &[0.1, 0.4] {
        let ggx = Ggx::new(Alpha::isotropic(a));
        let lobe = CoatedDiffuse::new(Some(ggx), 1.5, Rgb::WHITE);
        for &z in &[1.0_f64, 0.5, 0.2] {
            let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
            let got = albedo(&lobe, wo, Transport::Radiance);
            assert!(got < 1.003 && got > 0.94, "{a} {z}: {got}");
        }
    }
}

#[test]
fn a_smooth_coat_over_a_smooth_metal_is_the_plates_series() {
    let metal = Conductor {
        eta: rgb(0.2, 0.9, 1.1),
        k: rgb(3.9, 2.4, 2.1),
    };
    let base = Base::metal(None, Reflectance::Conductor(metal));
    let lobe = Layered::new(None, 1.5, base);
    let wo = vec3(0.6, 0.0, 0.8);
    let s = lobe.sample(wo, [0.5; 3], Transport::Radiance).unwrap();
    let outer = dielectric(0.8, 1.5);
    let inner = metal.under(1.5).eval(outer.cos_t).r;
    let (r, t) = (outer.reflectance, 1.0 - outer.reflectance);
    assert!((s.weight.r - (r + t * t * inner / (1.0 - inner * r))).abs() < 1e-12);
    assert!(s.specular && s.pdf == 1.0);
}

#[test]
fn eon_preserves_energy_and_is_lambert_at_zero() {
    for &roughness in &[0.0, 0.3, 1.0] {
        let lobe = Eon::new(Rgb::WHITE, roughness);
        for &z in &[1.0_f64, 0.6, 0.2, 0.02] {
            let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
            let got = albedo(&lobe, wo, Transport::Radiance);
            assert!((got - 1.0).abs() < 2e-3, "{roughness} {z}: {got}");
        }
    }
    let (eon, lambert) = (
        Eon::new(Rgb::splat(0.4), 0.0),
        Lambert::new(Rgb::splat(0.4)),
    );
    let (wo, wi) = (vec3(0.6, 0.0, 0.8), vec3(0.0, 0.28, 0.96));
    let t = Transport::Radiance;
    assert!((eon.eval(wo, wi, t).r - lambert.eval(wo, wi, t).r).abs() < 1e-12);
}

#[test]
fn weights_of_single_scattering_never_exceed_one() {
    for &(ax, ay) in &[(0.05, 0.5), (1.0, 1.0), (0.2, 3.0)] {
        for sampler in [
            Sampler::Heitz,
            Sampler::Cap,
            Sampler::Bounded,
            Sampler::Exact,
        ] {
            let ggx = Ggx::new(Alpha::clamped(ax, ay));
            let lobe = RoughConductor::new(ggx, WHITE).with_sampler(sampler);
            for i in 0..4000 {
                let wo = direction(r3(i + 77));
                if let Some(s) = lobe.sample(wo, r3(i), Transport::Radiance) {
                    assert!(s.weight.r <= 1.0 + 1e-9, "{wo:?}: {}", s.weight.r);
                }
            }
        }
    }
}

#[test]
fn backfacing_views_continue_the_lobe_without_a_jump() {
    let lobe = RoughConductor::new(Ggx::new(Alpha::clamped(0.3, 0.6)), WHITE);
    let wi = vec3(-0.5, 0.1, 0.8).normalize();
    let at = |z: f64| {
        let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
        lobe.eval_pdf(wo, wi, Transport::Radiance)
    };
    let (above, below) = (at(1e-9), at(-1e-9));
    assert!(above.0.r > 0.01 && (above.0.r - below.0.r).abs() < 1e-6);
    assert!((above.1 - below.1).abs() < 1e-6);
    assert!(at(-0.2).0.r > 0.0);
}

#[test]
fn near_smooth_interfaces_approach_the_smooth_ones() {
    let wo = vec3(0.6_f64, 0.0, 0.8);
    let rough = RoughDielectric::new(Ggx::new(Alpha::isotropic(1e-4)), 1.5);
    let smooth = SmoothDielectric::new(1.5);
    for side in [1.0, -1.0] {
        let wo = vec3(wo.x, wo.y, side * wo.z);
        for u0 in [0.01, 0.9] {
            let a = rough
                .sample(wo, [u0, 0.3, 0.6], Transport::Radiance)
                .unwrap();
            let b = smooth
                .sample(wo, [u0, 0.3, 0.6], Transport::Radiance)
                .unwrap();
            assert_eq!(a.event, b.event);
            assert!((a.wi - b.wi).length() < 2e-3);
            assert!((a.weight.r - b.weight.r).abs() < 1e-3);
        }
    }
}

#[test]
fn a_smooth_interface_and_a_pane_keep_all_light() {
    for &z in &[1.0_f64, 0.4, -0.4, -0.9] {
        let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
        let glass = SmoothDielectric::new(1.5);
        assert!((albedo(&glass, wo, Transport::Importance) - 1.0).abs() < 1e-9);
        let pane = ThinDielectric::new(1.5);
        assert!((albedo(&pane, wo, Transport::Radiance) - 1.0).abs() < 1e-9);
    }
}

fn every_lobe<T: Real>() -> Vec<Lobe<T>> {
    let ggx = |x: f64, y: f64| Ggx::new(Alpha::clamped(T::of(x), T::of(y)));
    let colour = rgb(T::of(0.9), T::of(0.5), T::ZERO);
    let metal = Reflectance::Conductor(Conductor {
        eta: rgb(T::of(0.2), T::of(0.9), T::ONE),
        k: rgb(T::of(3.9), T::of(2.4), T::ZERO),
    });
    let mut lobes: Vec<Lobe<T>> = vec![
        Lambert::new(colour).into(),
        Eon::new(colour, T::of(0.7)).into(),
        DiffuseTransmission::new(colour, colour * T::HALF).into(),
        SmoothConductor::new(metal).into(),
        SmoothDielectric::new(T::of(1.5)).into(),
        SmoothDielectric::facing(T::of(0.6)).into(),
        ThinDielectric::new(T::of(1.5)).into(),
        CoatedDiffuse::new(None, T::of(1.5), colour).into(),
        Layered::new(None, T::of(1.5), Base::metal(None, metal)).into(),
    ];
    for &(x, y) in &[(1e-4, 1e-4), (0.05, 0.5), (1.0, 1.0), (10.0, 0.3)] {
        let d = ggx(x, y);
        for sampler in [
            Sampler::Heitz,
            Sampler::Cap,
            Sampler::Bounded,
            Sampler::Exact,
        ] {
            lobes.push(RoughConductor::new(d, metal).with_sampler(sampler).into());
            lobes.push(
                RoughDielectric::new(d, T::of(1.5))
                    .with_sampler(sampler)
                    .into(),
            );
        }
        lobes.push(RoughDielectric::new(d, T::ONE).into());
        lobes.push(RoughDielectric::facing(d, T::of(0.6)).into());
        lobes.push(CoatedDiffuse::new(Some(d), T::of(1.5), colour).into());
        for thickness in [0.01, 1e30] {
            let layer = CoatLayer {
                thickness: T::of(thickness),
                max_depth: Some(10),
                scattering: CoatScattering::Single,
            };
            lobes.push(CoatedDiffuse::over_layer(Some(d), T::ONE, colour, layer).into());
            lobes.push(CoatedDiffuse::over_layer(None, T::of(1.5), colour, layer).into());
        }
        let base = Base::metal(Some(d), metal);
        lobes.push(Layered::new(None, T::of(1.5), base).into());
        lobes.push(Layered::new(Some(d), T::of(1.5), base).into());
    }
    lobes
}

/// Every value of every lobe is finite and none is negative, for awkward directions too.
fn nothing_breaks<T: Real>() {
    let awkward = [
        vec3(0.0, 0.0, 1.0),
        vec3(0.0, 0.0, -1.0),
        vec3(1.0, 0.0, 0.0),
        vec3(0.0, -1.0, 1e-30),
        vec3(0.8, 0.6, -1e-12),
        vec3(1e-20, 0.0, 1.0),
        vec3(0.6, 0.0, 0.8),
        vec3(-0.6, 0.0, -0.8),
    ];
    let directions: Vec<Vec3<T>> = awkward
        .iter()
        .copied()
        .chain((0..40).map(|i| direction(r3(i))))
        .map(|w: Vec3<f64>| w.cast())
        .collect();
    let good = |c: Rgb<T>| c.is_finite() && c.r >= T::ZERO && c.g >= T::ZERO && c.b >= T::ZERO;
    for (n, lobe) in every_lobe::<T>().iter().enumerate() {
        for &wo in &directions {
            for &wi in &directions {
                for transport in [Transport::Radiance, Transport::Importance] {
                    let (f, pdf) = lobe.eval_pdf(wo, wi, transport);
                    assert!(good(f), "lobe {n} {lobe:?} {wo:?} {wi:?}: {f:?}");
                    assert!(
                        pdf.is_finite() && pdf >= T::ZERO,
                        "lobe {n} {wo:?} {wi:?}: {pdf:?}"
                    );
                }
            }
            for u in [
                [0.0; 3],
                [0.999_999_9, 0.0, 0.5],
                [0.3, 0.999_999_9, 0.999_999_9],
            ]
            .into_iter()
            .chain((0..20).map(r3))
            {
                let below_one = T::ONE - T::EPSILON;
                let u = u.map(|x| T::of(x).at_most(below_one));
                if let Some(s) = lobe.sample(wo, u, Transport::Radiance) {
                    let unit = (s.wi.length() - T::ONE).abs() < T::of(1e-3);
                    assert!(
                        s.wi.is_finite() && unit,
                        "lobe {n} {wo:?} {u:?}: {:?}",
                        s.wi
                    );
                    assert!(
                        good(s.weight),
                        "lobe {n} {lobe:?} {wo:?} {u:?}: {:?}",
                        s.weight
                    );
                    assert!(
                        s.pdf.is_finite() && s.pdf > T::ZERO,
                        "lobe {n} {wo:?}: {:?}",
                        s.pdf
                    );
                }
            }
        }
    }
}

#[test]
fn nothing_breaks_in_f32() {
    nothing_breaks::<f32>();
}

#[test]
fn nothing_breaks_in_f64() {
    nothing_breaks::<f64>();
}

/// Variance of the estimate of reflected light under a sky that grows towards the zenith.
fn variance(lobe: &impl Bsdf<f64>, wo: Vec3<f64>) -> f64 {
    let n = 60_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for i in 0..n {
        let value = lobe
            .sample(wo, r3(i), Transport::Importance)
            .map_or(0.0, |s| s.weight.g * (1.0 + s.wi.z));
        sum += value;
        squares += value * value;
    }
    let mean = sum / f64::from(n);
    squares / f64::from(n) - mean * mean
}

/// Why caps are the default of rough dielectrics: with the branch sampled before the normal the
/// bounded cap rejects less, but the weights vary with the Fresnel term.
#[test]
fn drawing_the_branch_before_the_normal_costs_variance() {
    let mut log_ratio = 0.0;
    let mut cases = 0.0;
    for &a in &[0.1, 0.3, 0.6, 1.0] {
        let after = RoughDielectric::new(Ggx::new(Alpha::isotropic(a)), 1.5);
        let before = after.with_sampler(Sampler::Bounded);
        for &z in &[0.95_f64, 0.6, 0.25, -0.9, -0.5] {
            let wo = vec3((1.0 - z * z).sqrt(), 0.0, z);
            let (v_after, v_before) = (variance(&after, wo), variance(&before, wo));
            log_ratio += (v_before / v_after).ln();
            cases += 1.0;
        }
    }
    let ratio = (log_ratio / cases).exp();
    assert!(ratio > 1.03, "geometric mean of the ratios {ratio}");
    println!("variance, branch first over normal first: {ratio:.2}");
}

/// Within a thousandth of the index around it glass is not there; beyond, it is.
#[test]
fn glass_of_nearly_the_same_index_lets_light_pass_straight_on() {
    let ndf = Ggx::new(Alpha::isotropic(0.4));
    let wo = vec3(0.6, 0.0, 0.8);
    for eta in [1.0 - 9e-4, 1.0, 1.0 + 9e-4] {
        let lobe = RoughDielectric::new(ndf, eta);
        assert!(lobe.is_specular(), "{eta}");
        for view in [wo, -wo] {
            let s = lobe.sample(view, r3(1), Transport::Radiance).unwrap();
            assert!(
                s.specular && s.wi == -view && s.pdf == 1.0 && s.eta == 1.0,
                "{s:?}"
            );
            assert_eq!(s.weight, Rgb::WHITE);
            let away = lobe.eval_pdf(view, -view, Transport::Radiance);
            assert_eq!(away, (Rgb::BLACK, 0.0));
        }
    }
    for eta in [1.0 - 2e-3, 1.0 + 2e-3] {
        let lobe = RoughDielectric::new(ndf, eta);
        assert!(!lobe.is_specular(), "{eta}");
        assert!(lobe.eval_pdf(wo, -wo, Transport::Radiance).1 > 0.0, "{eta}");
    }
}
