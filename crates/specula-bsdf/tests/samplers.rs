//! Facts about the visible-normal samplers: bounds, rejections, numerical stability.

use specula_bsdf::math::{Real, Vec3, vec3};
use specula_bsdf::ndf::{Beckmann, Ggx, Ndf};
use specula_bsdf::{Alpha, vndf};

type Direction = fn(Alpha<f64>, Vec3<f64>, [f64; 2]) -> Option<Vec3<f64>>;

/// Point `i` of the two-dimensional R2 sequence.
fn r2(i: u32) -> [f64; 2] {
    let at = |step: f64| (0.5 + f64::from(i) * step).fract();
    [at(0.754_877_666_246_693), at(0.569_840_290_998_053)]
}

fn view(theta_deg: f64, phi: f64) -> Vec3<f64> {
    let (s, c) = theta_deg.to_radians().sin_cos();
    vec3(s * phi.cos(), s * phi.sin(), c)
}

fn rejected(sample: Direction, alpha: Alpha<f64>, wo: Vec3<f64>) -> f64 {
    let n = 40_000;
    let lost = (0..n)
        .filter(|&i| sample(alpha, wo, r2(i)).is_none())
        .count();
    #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
    let share = lost as f64 / f64::from(n);
    share
}

#[test]
fn rejections_are_the_published_ones() {
    let one = Alpha::isotropic(1.0);
    assert!((rejected(vndf::cap::sample_reflection, one, Vec3::Z) - 0.5).abs() < 1e-3);
    assert!((rejected(vndf::heitz::sample_reflection, one, Vec3::Z) - 0.5).abs() < 1e-3);
    assert!(rejected(vndf::bounded::sample_reflection, one, Vec3::Z) < 1e-6);
    let rough = Alpha::isotropic(0.6);
    let wo = view(45.0, 0.0);
    assert!((rejected(vndf::cap::sample_reflection, rough, wo) - 0.234).abs() < 2e-3);
    assert!((rejected(vndf::bounded::sample_reflection, rough, wo) - 0.062).abs() < 2e-3);
}

#[test]
fn the_bound_unclamped_saves_rejections_above_one() {
    let wide = Alpha::isotropic(1.5);
    let cap = rejected(vndf::cap::sample_reflection, wide, Vec3::Z);
    let bounded = rejected(vndf::bounded::sample_reflection, wide, Vec3::Z);
    // With the clamp of eq. 7 the cap would be the hemisphere: its share of the whole cap.
    let clamped = 1.0 - (1.0 - cap) * 2.0;
    assert!(bounded < 1e-6, "{bounded}");
    assert!(clamped > 0.37, "{clamped}");
}

#[test]
fn the_bounded_cap_holds_every_reflection_above_the_surface() {
    // Conservative: whatever the whole cap draws above the horizon has the bounded density, and
    // the share it keeps is N_bounded / N_cap at the most.
    for &(ax, ay) in &[
        (0.05, 0.05),
        (0.6, 0.6),
        (0.2, 0.8),
        (0.9, 1.4),
        (1.5, 1.5),
        (1.2, 3.0),
    ] {
        let alpha = Alpha::clamped(ax, ay);
        for i in 0..40 {
            let wo = view(89.9 * r2(i)[0], 6.0 * r2(i)[1]);
            let kept = 1.0 - rejected(vndf::cap::sample_reflection, alpha, wo);
            let kept_bounded = 1.0 - rejected(vndf::bounded::sample_reflection, alpha, wo);
            let ratio = vndf::bounded::norm(alpha, wo) / Ggx::new(alpha).projected_area(wo);
            assert!(
                (kept - kept_bounded * ratio).abs() < 3e-3,
                "{ax} {ay} {wo:?}: {kept} {kept_bounded} {ratio}"
            );
        }
    }
}

#[test]
fn views_from_below_are_stable_in_f32() {
    for &degrees in &[91.0, 135.0, 170.0, 179.0, 179.9, 180.0] {
        for &a in &[1e-4_f32, 0.1, 1.0, 8.0] {
            let alpha = Alpha::isotropic(a);
            let wide = Alpha::isotropic(f64::from(a));
            let wo = view(degrees, 0.7);
            let narrow: Vec3<f32> = wo.cast();
            for i in 0..200 {
                let u = r2(i);
                #[allow(
                    clippy::cast_possible_truncation,
                    reason = "the f32 twin is under test"
                )]
                let u32 = [u[0] as f32, u[1] as f32];
                let exact = [
                    vndf::cap::sample_wm(wide, wo, u),
                    vndf::heitz::sample_wm(wide, wo, u),
                ];
                let got = [
                    vndf::cap::sample_wm(alpha, narrow, u32),
                    vndf::heitz::sample_wm(alpha, narrow, u32),
                ];
                for (e, g) in exact.iter().zip(got) {
                    let g: Vec3<f64> = g.cast();
                    assert!(g.is_finite() && (g.length() - 1.0).abs() < 1e-5);
                    assert!(g.z >= 0.0, "{degrees} {a}: {g:?}");
                    if degrees < 179.95 {
                        assert!((*e - g).length() < 2e-3, "{degrees} {a} {u:?}: {e:?} {g:?}");
                    }
                }
                let bounded = vndf::bounded::sample_direction(alpha, narrow, u32);
                assert!(bounded.is_finite());
                let pdf = vndf::bounded::reflection_pdf(alpha, narrow, bounded);
                assert!(pdf.is_finite() && pdf >= 0.0);
            }
        }
    }
}

#[test]
fn heitz_and_cap_draw_only_visible_normals() {
    for &degrees in &[0.0, 40.0, 85.0, 100.0, 150.0] {
        let wo = view(degrees, 2.0);
        let alpha = Alpha::clamped(0.2, 0.8);
        for i in 0..2000 {
            for wm in [
                vndf::cap::sample_wm(alpha, wo, r2(i)),
                vndf::heitz::sample_wm(alpha, wo, r2(i)),
                vndf::beckmann::sample_wm(alpha, wo, r2(i)),
            ] {
                assert!(wo.dot(wm) > -1e-9 && wm.z >= 0.0, "{degrees}: {wm:?}");
            }
        }
    }
}

fn masking_is_consistent<N: Ndf<f64>>(ndf: N) {
    for i in 0..500 {
        let (a, b) = (r2(i), r2(i + 1000));
        let wo = view(89.0 * a[0], 6.2 * a[1]);
        let wi = view(89.0 * b[0], 6.2 * b[1]);
        let (g1o, g1i) = (ndf.g1(wo), ndf.g1(wi));
        let correlated = ndf.g2_correlated(wo, wi);
        let separable = ndf.g2_separable(wo, wi);
        assert!(separable <= correlated + 1e-15 && correlated <= Real::min(g1o, g1i) + 1e-15);
        let expected = 1.0 / (1.0 + ndf.lambda(wo) + ndf.lambda(wi));
        assert!((correlated - expected).abs() < 1e-12);
        assert!((ndf.projected_area(wo) - wo.z * (1.0 + ndf.lambda(wo))).abs() < 1e-12);
        // Heitz 2014: what faces away is what faces towards, less the plane's own area.
        let away = ndf.projected_area(-wo);
        assert!(
            (ndf.projected_area(wo) - away - wo.z).abs() < 1e-12,
            "{wo:?}"
        );
    }
}

#[test]
fn masking_obeys_its_identities() {
    for &(ax, ay) in &[(0.1, 0.1), (0.3, 1.2), (1.0, 1.0), (2.0, 0.4)] {
        masking_is_consistent(Ggx::new(Alpha::clamped(ax, ay)));
        masking_is_consistent(Beckmann::new(Alpha::clamped(ax, ay)));
    }
}

#[test]
fn names_of_samplers_round_trip() {
    for name in ["heitz", "cap", "bounded"] {
        assert_eq!(name.parse::<vndf::Sampler>().unwrap().to_string(), name);
    }
    assert!("ggx".parse::<vndf::Sampler>().is_err());
}
