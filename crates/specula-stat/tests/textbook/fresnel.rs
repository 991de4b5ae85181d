//! Fresnel's equations as printed: sines and tangents for dielectrics, complex numbers for metals.

use std::ops::{Add, Div, Mul, Sub};

use specula_bsdf::{Rgb, Vec3};

/// Reflectance by Fresnel's sine and tangent laws.
///
/// * `eta`: index beyond over the index on the side of the light.
pub(crate) fn dielectric(cos: f64, eta: f64) -> f64 {
    let i = cos.min(1.0).acos();
    let sine = i.sin() / eta;
    if sine >= 1.0 {
        return 1.0;
    }
    if i < 1e-6 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let t = sine.asin();
    let s = (i - t).sin() / (i + t).sin();
    let p = (i - t).tan() / (i + t).tan();
    0.5 * (s * s + p * p)
}

/// The refraction of `wo` at the facet `m` by Snell's law in the plane of the two; `None`: reflected in whole.
pub(crate) fn refracted(wo: Vec3<f64>, m: Vec3<f64>, eta: f64) -> Option<Vec3<f64>> {
    let cos = wo.dot(m);
    let along = (m * cos - wo) * (1.0 / eta);
    let sine2 = along.dot(along);
    (sine2 < 1.0).then(|| along - m * (1.0 - sine2).sqrt())
}

#[derive(Clone, Copy)]
struct Complex {
    re: f64,
    im: f64,
}

impl Complex {
    fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    fn squared_modulus(self) -> f64 {
        self.re * self.re + self.im * self.im
    }

    /// The root in the right half plane.
    fn sqrt(self) -> Self {
        let (r, angle) = (self.re.hypot(self.im), self.im.atan2(self.re));
        Self::new(
            r.sqrt() * (0.5 * angle).cos(),
            r.sqrt() * (0.5 * angle).sin(),
        )
    }
}

impl Add for Complex {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self::new(self.re + b.re, self.im + b.im)
    }
}

impl Sub for Complex {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        Self::new(self.re - b.re, self.im - b.im)
    }
}

impl Mul for Complex {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        Self::new(
            self.re * b.re - self.im * b.im,
            self.re * b.im + self.im * b.re,
        )
    }
}

impl Div for Complex {
    type Output = Self;

    fn div(self, b: Self) -> Self {
        let inverse = 1.0 / b.squared_modulus();
        self * Self::new(b.re * inverse, -b.im * inverse)
    }
}

/// Reflectance of a metal of index `eta + i k`, by Snell's law and Fresnel's amplitudes in complex numbers.
pub(crate) fn conductor(cos: f64, eta: f64, k: f64) -> f64 {
    let n = Complex::new(eta, k);
    let one = Complex::new(1.0, 0.0);
    let cos_i = Complex::new(cos, 0.0);
    let sine = Complex::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0) / n;
    let cos_t = (one - sine * sine).sqrt();
    let s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
    let p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
    0.5 * (s.squared_modulus() + p.squared_modulus())
}

/// Indices of gold for red, green and blue, about.
pub(crate) const GOLD: [[f64; 2]; 3] = [[0.143, 3.983], [0.375, 2.386], [1.442, 1.603]];

/// Reflectance of a metal, per channel.
pub(crate) fn of_metal(indices: [[f64; 2]; 3]) -> impl Fn(f64) -> Rgb<f64> {
    move |cos| {
        let [r, g, b] = indices.map(|[eta, k]| conductor(cos, eta, k));
        Rgb { r, g, b }
    }
}

/// Schlick's `F0 + (1 - F0) (1 - cos)^5`.
pub(crate) fn schlick(f0: Rgb<f64>, cos: f64) -> Rgb<f64> {
    f0.map(|f| f + (1.0 - f) * (1.0 - cos).powi(5))
}

/// `2 int F(mu) mu dmu`, per channel.
pub(crate) fn average(fresnel: impl Fn(f64) -> Rgb<f64>) -> Rgb<f64> {
    let count = 2000;
    let mut sum = Rgb::BLACK;
    for i in 0..count {
        let mu = (f64::from(i) + 0.5) / f64::from(count);
        sum += fresnel(mu) * (2.0 * mu / f64::from(count));
    }
    sum
}
