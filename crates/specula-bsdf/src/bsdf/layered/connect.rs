//! The contribution of a vertex below the coat: connections to the light.
//!
//! A first bounce off the base runs `wo`, `-u`, `v`, `wi`, with `u` and `v` the directions up from the
//! base. Where the coat is rough there are three ways to sample it, weighed by the power heuristic
//! (Veach and Guibas 1995):
//!
//! ```text
//! A: u from wo, v from wi        B: u from wo, v from the base        C: v from wi, u from the base
//! p(u | wo) p(v | wi)            p(u | wo) p(v | u)                   p(v | wi) p(u | v)
//! ```
//!
//! Over a narrow base the tails are rare and bright without C: a light off the mirror's direction is
//! seen by a rare `u` and a common `v` as much as the other way round. Over a wide one C is left
//! out, and later vertices have A and B. A smooth coat leaves A, which then takes no random number: the
//! first bounce is a closed form. Over a mirror B and C remain.

use super::Layered;
use super::coat::{CoatSample, Onward};
use super::medium::Medium;
use crate::bsdf::Transport;
use crate::math::{Real, Rgb, Stream, Vec3, vec3};

/// Both ends of the paths that are evaluated.
#[derive(Clone, Copy)]
pub(super) struct Ends<T> {
    pub(super) wo: Vec3<T>,
    pub(super) wi: Vec3<T>,
    /// How light of `wi` comes in: for `Transport::Radiance`, the way back from it.
    pub(super) entry: Option<CoatSample<T>>,
    /// `p(u | wo)` of how light of `wo` came in, at a first vertex that C may sample.
    pub(super) first: Option<T>,
}

/// Densities of the three ways to sample one path.
struct Ways<T> {
    a: T,
    b: T,
    c: T,
}

impl<T: Real> Ways<T> {
    /// * `from_wo`: `p(u | wo)`, and whether C is a way.
    /// * `from_wi`: `p(v | wi)`.
    /// * `on`, `back`: `p(v | u)` and `p(u | v)` at the base.
    #[inline(always)]
    fn new(lobe: &Layered<T>, from_wo: Option<T>, from_wi: T, on: T, back: T) -> Self {
        let first = from_wo.unwrap_or(T::ONE);
        let mirror = lobe.base.is_mirror();
        let [on, back] = [on, back].map(|p| T::select(mirror, T::ONE, p));
        Self {
            a: T::select(mirror, T::ZERO, first * from_wi),
            b: first * on,
            c: T::select(from_wo.is_some(), from_wi * back, T::ZERO),
        }
    }

    #[inline(always)]
    fn share(&self, own: T) -> T {
        let scale = T::ONE / (self.a + self.b + self.c).at_least(T::TINY);
        let [own, a, b, c] = [own, self.a, self.b, self.c].map(|p| (p * scale).squared());
        own / (a + b + c).at_least(T::TINY)
    }
}

impl<T: Real> Ends<T> {
    /// Light by way of the base, which is met along `down`; and how the walk goes on.
    #[inline]
    pub(super) fn at_base(
        &self,
        lobe: &Layered<T>,
        down: Vec3<T>,
        stream: &mut Stream,
    ) -> (Rgb<T>, Option<Onward<T>>) {
        let u = -down;
        let is_rough = lobe.coat.is_rough();
        let depth = lobe.medium.thickness;
        let mut sum = Rgb::BLACK;
        if let Some(entry) = self.entry {
            let v = -entry.w;
            let (f_cos, on) = lobe.base.eval_pdf(u, v);
            if f_cos.max_channel() > T::ZERO {
                let share = if is_rough {
                    let back = self.back(lobe, u, v);
                    let ways = Ways::new(lobe, self.first, entry.pdf, on, back);
                    ways.share(ways.a)
                } else {
                    T::ONE
                };
                sum += f_cos * (self.arriving(entry, v) * Medium::transmittance(depth, v) * share);
            }
        }
        let next = lobe.base.sample(u, stream);
        if let Some((v, weight, on)) = next
            && is_rough
        {
            let (f, from_wi) = lobe.coat.passes(self.wi, v, Transport::Radiance);
            let ways = Ways::new(lobe, self.first, from_wi, on, self.back(lobe, u, v));
            let left = Medium::transmittance(depth, v) * ways.share(ways.b);
            sum += weight * (f * self.wi.z * left);
        }
        (sum, next.map(|(w, weight, _)| Onward { w, weight }))
    }

    /// C: light by way of the base, sampled from the light.
    #[inline]
    pub(super) fn sampled_from_light(&self, lobe: &Layered<T>, stream: &mut Stream) -> Rgb<T> {
        let Some(entry) = self.entry else {
            return Rgb::BLACK;
        };
        let v = -entry.w;
        let Some((u, weight, back)) = lobe.base.sample(v, stream) else {
            return Rgb::BLACK;
        };
        let (f, from_wo) = lobe.coat.passes(self.wo, u, Transport::Importance);
        let (_, on) = lobe.base.eval_pdf(u, v);
        let ways = Ways::new(lobe, Some(from_wo), entry.pdf, on, back);
        let depth = lobe.medium.thickness;
        let crossed = Medium::transmittance(depth, u) * Medium::transmittance(depth, v);
        weight * (entry.weight * self.wi.z * f * crossed * ways.share(ways.c))
    }

    /// Light by way of a particle, which is met along `from`, and where the walk goes on.
    ///
    /// * `events`: how many more are allowed.
    #[inline]
    pub(super) fn at_particle(
        &self,
        lobe: &Layered<T>,
        from: Vec3<T>,
        [to_base, to_coat]: [T; 2],
        events: u32,
        stream: &mut Stream,
    ) -> (Rgb<T>, Vec3<T>) {
        let is_rough = lobe.coat.is_rough();
        let share = |own: T, other: T| {
            let share = own / (own + other).at_least(T::TINY);
            T::select(is_rough, share, T::ONE)
        };
        let mut sum = Rgb::BLACK;
        if let Some(entry) = self.entry {
            let v = -entry.w;
            let phase = lobe.medium.phase(from.dot(v));
            let up = phase * Medium::transmittance(to_coat, v) * share(entry.pdf, phase);
            let lit = if !is_rough && lobe.base.is_mirror() {
                // Both surfaces smooth: only here can light be met that they have mirrored.
                let turned = lobe.medium.phase(from.dot(vec3(v.x, v.y, -v.z)));
                let down = turned * Medium::transmittance(to_base + lobe.medium.thickness, v);
                lobe.echoes(v, up, down, events)
            } else {
                Rgb::splat(up)
            };
            sum += lit * self.arriving(entry, v);
        }
        let w = lobe.medium.turned(from, stream);
        if is_rough && w.z > T::ZERO {
            let (f, from_wi) = lobe.coat.passes(self.wi, w, Transport::Radiance);
            let phase = lobe.medium.phase(from.dot(w));
            let left = Medium::transmittance(to_coat, w) * share(phase, from_wi);
            sum += Rgb::splat(f * self.wi.z * left);
        }
        (sum, w)
    }

    /// What of `f |cos|` at a vertex reaches the light along `v`: reciprocity changes the cosines.
    #[inline(always)]
    fn arriving(&self, entry: CoatSample<T>, v: Vec3<T>) -> T {
        entry.weight * self.wi.z / v.z.at_least(T::TINY)
    }

    /// `p(u | v)` at the base, where it matters.
    #[inline(always)]
    fn back(&self, lobe: &Layered<T>, u: Vec3<T>, v: Vec3<T>) -> T {
        match self.first {
            Some(_) => lobe.base.eval_pdf(v, u).1,
            None => T::ZERO,
        }
    }
}
