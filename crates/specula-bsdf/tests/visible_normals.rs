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
    assert_eq!(rejected(vndf::exact::sample_reflection, rough, wo), 0.0);
    assert_eq!(
        rejected(vndf::exact::sample_reflection, Alpha::clamped(0.2, 0.8), wo),
        0.0
    );
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
    // Conservative: whatever the whole cap samples above the horizon has the bounded density, and
    // the share that it accepts is N_bounded / N_cap at the most.
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
            let accepted = 1.0 - rejected(vndf::cap::sample_reflection, alpha, wo);
            let accepted_bounded = 1.0 - rejected(vndf::bounded::sample_reflection, alpha, wo);
            let ratio = vndf::bounded::norm(alpha, wo) / Ggx::new(alpha).projected_area(wo);
            assert!(
                (accepted - accepted_bounded * ratio).abs() < 3e-3,
                "{ax} {ay} {wo:?}: {accepted} {accepted_bounded} {ratio}"
            );
        }
    }
}

/// Hashed random in `[0, 1)` of 24 bits.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        <f32 as Real>::unit_from_bits(z ^ (z >> 31))
    }

    /// Log-uniform in `[low, high)`.
    fn log_uniform(&mut self, low: f32, high: f32) -> f32 {
        (low.ln() + self.next() * (high / low).ln()).exp()
    }

    /// Uniform over the hemisphere, within a tiny angle of grazing, or of the normal.
    fn view(&mut self) -> Vec3<f32> {
        let tiny = self.log_uniform(1e-7, 1.0);
        let z = match (3.0 * self.next()).floor() {
            0.0 => self.next().max(1e-30),
            1.0 => tiny,
            _ => (1.0 - tiny * tiny).sqrt(),
        };
        let (s, c) = self.next().sin_cos_turns();
        let sine = ((1.0 - z) * (1.0 + z)).sqrt();
        vec3(sine * c, sine * s, z)
    }
}

/// Ten million samples in f32 with alphas in [1e-3, 8]; the chore `exact --fuzz` makes 10^9.
#[test]
fn exact_reflections_are_above_the_surface() {
    let mut random = Random(3);
    let mut rejected = 0;
    let mut sampled = 0;
    while sampled < 10_000_000 {
        let a = random.log_uniform(1e-3, 8.0);
        let b = random.log_uniform(1e-3, 8.0);
        let alpha = Alpha::clamped(a, if sampled % 40 == 0 { a } else { b });
        let wo = random.view();
        for _ in 0..20 {
            let u = [random.next(), random.next()];
            let wi = vndf::exact::sample_direction(alpha, wo, u);
            let unit = (wi.length() - 1.0).abs() < 1e-5;
            assert!(unit, "{alpha:?} {wo:?} {u:?}: {wi:?}");
            rejected += u32::from(wi.z <= 0.0);
            sampled += 1;
        }
    }
    println!("{rejected} of {sampled} reflections rejected by rounding");
    assert!(rejected <= 10, "{rejected}");
}

/// `N` is the integral of `D(wm) / 4` over the reflections above the surface.
#[test]
fn the_exact_norm_is_an_integral() {
    let (heights, turns) = (400_u32, 400_u32);
    for &(ax, ay) in &[
        (0.3, 0.3),
        (1.0, 1.0),
        (3.0, 3.0),
        (0.2, 0.8),
        (0.6, 1.0),
        (1.2, 3.0),
        (0.4, 8.0),
    ] {
        let alpha = Alpha::clamped(ax, ay);
        for wo in [
            view(0.0, 0.0),
            view(40.0, 0.4),
            view(75.0, 1.1),
            view(82.0, 2.5),
        ] {
            let mut sum = 0.0;
            for i in 0..heights {
                // Substituted so that the horizon, where D may peak, is resolved.
                let x = (f64::from(i) + 0.5) / f64::from(heights);
                let (z, dz) = (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x));
                for j in 0..turns {
                    let phi = std::f64::consts::TAU * f64::from(j) / f64::from(turns);
                    let sine = (1.0 - z * z).sqrt();
                    let wm = (wo + vec3(sine * phi.cos(), sine * phi.sin(), z)).normalize();
                    sum += dz * Ggx::new(alpha).d(wm);
                }
            }
            let cell = std::f64::consts::TAU / f64::from(heights * turns);
            let (expected, got) = (0.25 * sum * cell, vndf::exact::norm(alpha, wo));
            assert!(
                (expected - got).abs() < 2e-4 * got,
                "{ax} {ay} {wo:?}: {expected} {got}"
            );
        }
    }
}

/// The root, as a bisection finds it.
#[test]
fn the_exact_norm_has_its_root() {
    let mut random = Random(4);
    let mut worst = [0.0_f64; 2];
    for _ in 0..20_000 {
        let mut alpha = || f64::from(random.log_uniform(1e-3, 8.0));
        let alpha = Alpha::clamped(alpha(), alpha());
        let wo: Vec3<f64> = random.view().cast();
        let wo = wo.normalize();
        let h = alpha.stretch(wo);
        let offsets = [wo.z * alpha.x * alpha.x, wo.z * alpha.y * alpha.y];
        let excess = |l: f64| {
            let poles = h.x * h.x / (l + offsets[0]) + h.y * h.y / (l + offsets[1]);
            l - wo.z - poles
        };
        let (mut low, mut high) = (wo.z, wo.z + h.length() + 1.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let d = offsets.map(|o| low + o);
        let axis2 = 1.0 + (h.x / d[0]).powi(2) + (h.y / d[1]).powi(2);
        let expected = low * low / (axis2 * (d[0] * d[1]).sqrt());
        let error = (vndf::exact::norm(alpha, wo) / expected - 1.0).abs();
        let rough = usize::from(alpha.x.at_least(alpha.y) > 2.0);
        worst[rough] = worst[rough].max(error);
    }
    println!("largest relative errors of N: {worst:?}");
    assert!(worst[0] < 1e-12 && worst[1] < 1e-7, "{worst:?}");
}

#[test]
fn the_exact_norm_continues_that_of_caps_below_the_horizon() {
    for &(ax, ay) in &[(1e-3, 1e-3), (0.3, 0.3), (0.2, 0.8), (1.0, 8.0)] {
        let alpha = Alpha::clamped(ax, ay);
        let at = |z: f64| vndf::exact::norm(alpha, vec3(0.6, 0.8, z));
        assert!((at(1e-12) / at(-1e-12) - 1.0).abs() < 1e-7, "{ax} {ay}");
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
                assert!(vndf::exact::sample_direction(alpha, narrow, u32).is_finite());
                let pdf = vndf::bounded::reflection_pdf(alpha, narrow, bounded);
                assert!(pdf.is_finite() && pdf >= 0.0);
            }
        }
    }
}

#[test]
fn heitz_and_cap_sample_only_visible_normals() {
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
        assert!(separable <= correlated + 1e-15 && correlated <= g1o.at_most(g1i) + 1e-15);
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
    for name in ["heitz", "cap", "bounded", "exact"] {
        assert_eq!(name.parse::<vndf::Sampler>().unwrap().to_string(), name);
    }
    assert!("ggx".parse::<vndf::Sampler>().is_err());
}

/// The largest random number of `f32` is at the disk's rim, which is the horizon.
#[test]
fn the_last_random_number_stays_above_the_horizon() {
    let last = 1.0 - f32::EPSILON / 2.0;
    let (mut below, mut count) = (0, 0);
    for (x, y) in [
        (0.05, 0.05),
        (0.3, 0.3),
        (1.0, 1.0),
        (4.0, 4.0),
        (0.1, 0.9),
        (2.0, 0.4),
    ] {
        let alpha = Alpha::<f32>::clamped(x, y);
        for degrees in [1e-3, 20.0, 60.0, 85.0, 89.5] {
            let wo = view(degrees, 0.7).cast::<f32>();
            for i in 0_u8..=255 {
                let u = [last, f32::from(i) / 256.0];
                below += u32::from(vndf::exact::sample_reflection(alpha, wo, u).is_none());
                count += 1;
            }
        }
    }
    assert_eq!(below, 0, "of {count}");
}
