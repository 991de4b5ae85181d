//! `.binary` files of MERL's database: isotropic reflections over half vectors and differences.
//!
//! ```text
//! three i32: nodes of theta_h, theta_d and phi_d (90, 90, 180)
//! f64 of red, then green, then blue: [theta_h][theta_d][phi_d], f / scale, below 0 where nothing is known
//! theta_h = (pi / 2) ((i + 1/2) / 90)^2     theta_d = (pi / 2) (j + 1/2) / 90     phi_d = pi (k + 1/2) / 180
//! ```
//!
//! `theta_h` is the half vector's angle from the normal; `theta_d` and `phi_d` are the light's where the half vector is
//! the axis. Between the middles of cells, values are interpolated; cells without a value are left out.
//!
//! Source: Matusik, Pfister, Brand and McMillan 2003, "A Data-Driven Reflectance Model"; the coordinates are those of
//! Rusinkiewicz 1998.

use std::f64::consts::{FRAC_PI_2, PI};

use specula_bsdf::bsdf::BsdfSample;
use specula_bsdf::measured::{MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};

/// Nodes of the files that there are.
const SIZE: [usize; 3] = [90, 90, 180];
/// What stored values are multiplied by.
const SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];
/// Bytes before the values.
const HEAD: usize = 12;

/// A reflection of MERL's database.
#[derive(Clone, Debug)]
pub struct Merl {
    /// Of each channel: theta_h, theta_d, phi_d, the last one fastest.
    values: Vec<f64>,
}

impl Merl {
    /// Whether bytes begin as such a file.
    #[must_use]
    pub fn is_one(bytes: &[u8]) -> bool {
        let size = SIZE.map(|n| u32::try_from(n).unwrap_or(0).to_le_bytes());
        bytes.starts_with(&size.concat())
    }

    /// # Errors
    ///
    /// Where the file has other sizes or a value that is not finite.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let count = 3 * SIZE.iter().product::<usize>();
        let expected = HEAD + 8 * count;
        if !Self::is_one(bytes) || bytes.len() != expected {
            return Err(format!(
                "has {} bytes; expected {expected}: 90 x 90 x 180 values of three channels",
                bytes.len()
            ));
        }
        let values: Vec<f64> = (bytes[HEAD..].chunks_exact(8))
            .map(|b| f64::from_le_bytes(b.try_into().unwrap_or([0; 8])))
            .collect();
        match values.iter().position(|v| !v.is_finite()) {
            None => Ok(Self { values }),
            Some(i) => Err(format!(
                "has the value {} at {i}; expected finite numbers",
                values[i]
            )),
        }
    }

    /// The file of a lobe that is isotropic and reflects only.
    pub fn to_bytes(lobe: &impl Bsdf<f64>) -> Vec<u8> {
        let mut bytes: Vec<u8> = SIZE
            .into_iter()
            .flat_map(|n| u32::try_from(n).unwrap_or(0).to_le_bytes())
            .collect();
        let values: Vec<Rgb<f64>> = cells().map(|cell| at_middle(lobe, cell)).collect();
        for (channel, scale) in SCALE.into_iter().enumerate() {
            let of_channel = values.iter().map(|v| v.to_array()[channel] / scale);
            bytes.extend(of_channel.flat_map(f64::to_le_bytes));
        }
        bytes
    }

    /// The same reflection as tables, which can be sampled.
    ///
    /// Normals are sampled by a GGX distribution as wide as the measured peak; densities by luminance over its visible
    /// normals make up for what it is not.
    #[must_use]
    pub fn tables(&self) -> MeasuredTables {
        let size = Resolution {
            theta: 24,
            phi: 1,
            normals: [128, 32],
            colours: 64,
        };
        let alpha = self.width();
        let ndf = Ggx::new(Alpha::clamped(alpha, alpha));
        tabulate(&ndf, self, Symmetry::Isotropic, size)
    }

    /// Alpha of a GGX distribution whose density falls to a quarter where the measured peak does.
    ///
    /// ```text
    /// D(theta) / D(0) = 1 / (cos^4 theta (1 + tan^2 theta / alpha^2)^2) = 1/4
    /// alpha^2 = sin^2 theta / (1 + sin^2 theta)
    /// ```
    fn width(&self) -> f64 {
        let [n, _, _] = SIZE;
        // Light beside the viewer: the density of normals, but for a constant.
        let profile: Vec<[f64; 2]> = (0..n)
            .map(theta_h)
            .take_while(|theta| *theta < 1.2)
            .map(|theta| {
                let value = self.value([theta, 0.0, 0.0]).luminance();
                [theta, value * theta.cos().powi(2)]
            })
            .collect();
        let floor = profile.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        let peak = profile.iter().map(|p| p[1]).fold(0.0, f64::max) - floor;
        let fallen = |p: &&[f64; 2]| p[1] - floor > 0.25 * peak;
        let sine = profile
            .iter()
            .rev()
            .find(fallen)
            .map_or(1.0, |p| p[0].sin());
        (sine / (1.0 + sine * sine).sqrt()).clamp(0.01, 0.9)
    }

    /// f at angles in radians.
    fn value(&self, [h, d, p]: [f64; 3]) -> Rgb<f64> {
        let [nh, nd, np] = SIZE;
        let middle = |x: f64, n: usize| x * n as f64 - 0.5;
        let pairs = [
            neighbours(middle((h / FRAC_PI_2).max(0.0).sqrt(), nh), nh),
            neighbours(middle(d / FRAC_PI_2, nd), nd),
            around(middle(p / PI, np), np),
        ];
        let mut sum = [0.0; 3];
        let mut total = [0.0; 3];
        for corner in 0..8_usize {
            let pick = |axis: usize| pairs[axis][corner >> axis & 1];
            let [(i, u), (j, v), (k, w)] = [pick(0), pick(1), pick(2)];
            let place = (i * nd + j) * np + k;
            for channel in 0..3 {
                let value = self.values[channel * nh * nd * np + place];
                if value >= 0.0 {
                    sum[channel] += u * v * w * value;
                    total[channel] += u * v * w;
                }
            }
        }
        let channel = |c: usize| SCALE[c] * sum[c] / f64::max(total[c], f64::MIN_POSITIVE);
        Rgb::from([channel(0), channel(1), channel(2)])
    }
}

impl Bsdf<f64> for Merl {
    fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>, _: Transport) -> Rgb<f64> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Rgb::BLACK;
        }
        self.value(half_difference(wo, wi)) * wi.z
    }

    fn pdf(&self, _: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        wi.z.max(0.0) / PI
    }

    fn sample(&self, wo: Vec3<f64>, u: [f64; 3], transport: Transport) -> Option<BsdfSample<f64>> {
        let diffuse = specula_bsdf::bsdf::Lambert::new(Rgb::WHITE);
        let sample = diffuse.sample(wo, u, transport)?;
        let weight = self.eval(wo, sample.wi, transport) * (1.0 / sample.pdf);
        Some(BsdfSample { weight, ..sample })
    }

    fn albedo(&self) -> Rgb<f64> {
        Rgb::splat(0.5)
    }
}

/// Angles of the half vector and of the light about it.
fn half_difference(wo: Vec3<f64>, wi: Vec3<f64>) -> [f64; 3] {
    let half = (wo + wi).normalize();
    let radius = half.x.hypot(half.y);
    let theta_h = radius.atan2(half.z);
    let (cos, sin) = if radius > 0.0 {
        (half.x / radius, half.y / radius)
    } else {
        (1.0, 0.0)
    };
    // The light, turned so that the half vector lies in the plane of x and z, then onto z.
    let x = wi.x * cos + wi.y * sin;
    let y = wi.y * cos - wi.x * sin;
    let along = x * half.z - wi.z * radius;
    let up = x * radius + wi.z * half.z;
    let theta_d = along.hypot(y).atan2(up);
    let phi_d = y.atan2(along);
    [theta_h, theta_d, phi_d.rem_euclid(PI)]
}

/// f at the middle of a cell; -1 where a direction is below the horizon.
fn at_middle(lobe: &impl Bsdf<f64>, [i, j, k]: [usize; 3]) -> Rgb<f64> {
    let (sin_h, cos_h) = theta_h(i).sin_cos();
    let middle = |i: usize, n: usize| (i as f64 + 0.5) / n as f64;
    let (sin_d, cos_d) = (FRAC_PI_2 * middle(j, SIZE[1])).sin_cos();
    let (sin_p, cos_p) = (PI * middle(k, SIZE[2])).sin_cos();
    let turned = |along: f64, y: f64| Vec3 {
        x: along * cos_h + cos_d * sin_h,
        y,
        z: cos_d * cos_h - along * sin_h,
    };
    let wi = turned(sin_d * cos_p, sin_d * sin_p);
    let wo = turned(-sin_d * cos_p, -sin_d * sin_p);
    if wi.z <= 0.0 || wo.z <= 0.0 {
        return Rgb::splat(-1.0);
    }
    lobe.eval(wo, wi, Transport::Radiance) * (1.0 / wi.z)
}

fn theta_h(i: usize) -> f64 {
    let x = (i as f64 + 0.5) / SIZE[0] as f64;
    FRAC_PI_2 * x * x
}

fn cells() -> impl Iterator<Item = [usize; 3]> {
    let [nh, nd, np] = SIZE;
    (0..nh * nd * np).map(move |c| [c / (nd * np), c / np % nd, c % np])
}

/// The two cells about a place and their weights; the outermost go on.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the axis"
)]
fn neighbours(place: f64, n: usize) -> [(usize, f64); 2] {
    let place = place.clamp(0.0, (n - 1) as f64);
    let i = (place as usize).min(n - 2);
    let t = place - i as f64;
    [(i, 1.0 - t), (i + 1, t)]
}

/// The two cells about a place on a circle.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "taken to the circle before"
)]
fn around(place: f64, n: usize) -> [(usize, f64); 2] {
    let place = place.rem_euclid(n as f64);
    let i = (place as usize).min(n - 1);
    let t = place - i as f64;
    [(i, 1.0 - t), ((i + 1) % n, t)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::bsdf::RoughConductor;
    use specula_bsdf::fresnel::{Conductor, Reflectance};
    use specula_bsdf::math::Stream;
    use specula_bsdf::measured::Measured;
    use specula_bsdf::metals::by_symbol;

    fn gold(alpha: f64) -> RoughConductor<f64, Ggx<f64>> {
        let metal = by_symbol("Au").unwrap();
        let fresnel = Conductor {
            eta: metal.eta.into(),
            k: metal.k.into(),
        };
        RoughConductor::new(
            Ggx::new(Alpha::clamped(alpha, alpha)),
            Reflectance::Conductor(fresnel),
        )
    }

    #[test]
    fn the_file_of_a_lobe_is_the_lobe_and_its_tables_sample_it() {
        let lobe = gold(0.3);
        let merl = Merl::from_bytes(&Merl::to_bytes(&lobe)).unwrap();
        assert!((merl.width() - 0.3).abs() < 0.03, "{}", merl.width());
        let tables = Measured::<f64>::new(&merl.tables()).unwrap();
        let mut stream = Stream::new(5);
        let mut worst = [0.0_f64; 2];
        for _ in 0..2000 {
            let (z, phi) = (
                0.3 + 0.7 * stream.next::<f64>(),
                std::f64::consts::TAU * stream.next::<f64>(),
            );
            let sin = (1.0 - z * z).sqrt();
            let (y, x) = phi.sin_cos();
            let wo = Vec3 {
                x: sin * x,
                y: sin * y,
                z,
            };
            let u = [stream.next(), stream.next(), stream.next()];
            let Some(s) = lobe.sample(wo, u, Transport::Radiance) else {
                continue;
            };
            if s.wi.z < 0.2 {
                continue;
            }
            let expected = lobe.eval(wo, s.wi, Transport::Radiance).to_array();
            for (worst, lobe) in worst.iter_mut().zip([&merl as &dyn Bsdf<f64>, &tables]) {
                let found = lobe.eval(wo, s.wi, Transport::Radiance).to_array();
                for (a, b) in found.into_iter().zip(expected) {
                    *worst = worst.max((a / b - 1.0).abs());
                }
            }
        }
        // 0.11 and 2 degrees of half vectors and differences; then 24 views, 64 x 64 nodes.
        assert!(worst[0] < 0.01, "{worst:?}");
        assert!(worst[1] < 0.06, "{worst:?}");
    }

    #[test]
    fn channels_and_unknown_cells_stay_apart() {
        let mut bytes = Merl::to_bytes(&gold(0.5));
        let count: usize = SIZE.iter().product();
        // Nothing is known of green: it is black, and red and blue are as before.
        let before = Merl::from_bytes(&bytes).unwrap().value([0.3, 0.4, 1.0]);
        let green = HEAD + 8 * count;
        for b in bytes[green..green + 8 * count].chunks_exact_mut(8) {
            b.copy_from_slice(&(-1.0_f64).to_le_bytes());
        }
        let after = Merl::from_bytes(&bytes).unwrap().value([0.3, 0.4, 1.0]);
        assert_eq!([after.r, after.g, after.b], [before.r, 0.0, before.b]);
        assert!(before.r > before.g && before.g > before.b);
    }

    #[test]
    fn damaged_files_are_refused() {
        let good = Merl::to_bytes(&gold(0.5));
        let cut = Merl::from_bytes(&good[..good.len() - 1]).unwrap_err();
        assert!(cut.contains("expected 34992012"), "{cut}");
        let mut bad = good;
        bad[HEAD..HEAD + 8].copy_from_slice(&f64::NAN.to_le_bytes());
        let bad = Merl::from_bytes(&bad).unwrap_err();
        assert!(bad.contains("NaN at 0"), "{bad}");
    }
}
