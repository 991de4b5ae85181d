//! What the paths of a block carry, in columns by the number of the path.

use specula_bsdf::{Rgb, Vec3};

use super::lanes::{Column, LANES, Vectors, ZERO};
use super::{Path, Previous, State, Tally, bias};
use crate::accel::Ray;
use crate::bodies::Bodies;
use crate::film::PixelSample;
use crate::light::{Lights, Receiver};
use crate::sampler::Sampler;

/// The columns.
pub(super) struct Paths {
    pub(super) samplers: [Sampler; LANES],
    pub(super) radiance: Vectors,
    pub(super) throughput: Vectors,
    /// Product of the squared relative indices so far.
    pub(super) eta_scale: Column,
    /// What they are in.
    bodies: [Bodies; LANES],
    /// As of `State`.
    pub(super) straight: [bool; LANES],
    pub(super) rough: [bool; LANES],
    pub(super) bound: Column,
    pub(super) previous: Receivers,
    /// Density of the last direction there; 0 where no light could have found it.
    pub(super) previous_pdf: Column,
    /// Probability with which the light drawn there was to be one from infinity; negative where it was not
    /// kept.
    pub(super) previous_share: Column,
    pub(super) first: FirstSeen,
}

/// Points as lights are chosen for them.
pub(super) struct Receivers {
    point: Vectors,
    /// Zero where light arrives from both sides.
    normal: Vectors,
}

/// What the first vertices show.
pub(super) struct FirstSeen {
    pub(super) albedo: Vectors,
    pub(super) normal: Vectors,
    /// Distance along the camera rays; infinite where they meet nothing.
    pub(super) depth: Column,
}

impl Receivers {
    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> Receiver {
        let normal = self.normal.get(i);
        Receiver {
            point: self.point.get(i),
            normal: (normal != Vec3::ZERO).then_some(normal),
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, receiver: &Receiver) {
        self.point.set(i, receiver.point);
        self.normal.set(i, receiver.normal.unwrap_or(Vec3::ZERO));
    }
}

impl Paths {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            samplers: [Sampler::new([0; 2], 0, 0); LANES],
            radiance: Vectors::ZERO,
            throughput: Vectors::ZERO,
            eta_scale: ZERO,
            bodies: [Bodies::NONE; LANES],
            straight: [true; LANES],
            rough: [false; LANES],
            bound: [f32::INFINITY; LANES],
            previous: Receivers {
                point: Vectors::ZERO,
                normal: Vectors::ZERO,
            },
            previous_pdf: ZERO,
            previous_share: ZERO,
            first: FirstSeen {
                albedo: Vectors::ZERO,
                normal: Vectors::ZERO,
                depth: ZERO,
            },
        })
    }

    /// Makes the first `n` paths new ones, but for their samplers.
    ///
    /// * `has_bodies`: whether paths may have entered any.
    /// * `bound`: as of `PathTracer`.
    pub(super) fn begin(&mut self, n: usize, has_bodies: bool, bound: f32) {
        let columns = |v: &mut Vectors, value: f32| {
            v.x[..n].fill(value);
            v.y[..n].fill(value);
            v.z[..n].fill(value);
        };
        columns(&mut self.radiance, 0.0);
        columns(&mut self.throughput, 1.0);
        columns(&mut self.first.albedo, 0.0);
        columns(&mut self.first.normal, 0.0);
        self.first.depth[..n].fill(f32::INFINITY);
        self.eta_scale[..n].fill(1.0);
        self.previous_pdf[..n].fill(0.0);
        self.straight[..n].fill(true);
        self.rough[..n].fill(false);
        self.bound[..n].fill(bound);
        if has_bodies {
            self.bodies[..n].fill(Bodies::NONE);
        }
    }

    /// Adds light that was scattered so many times on its way to the camera.
    #[inline(always)]
    pub(super) fn add(&mut self, i: usize, contribution: Rgb<f32>, events: u32) {
        let radiance = bias::bounded(contribution, events, self.bound[i]);
        self.radiance.x[i] += radiance.r;
        self.radiance.y[i] += radiance.g;
        self.radiance.z[i] += radiance.b;
    }

    /// Where the last direction was drawn, if lights could have found it too.
    #[inline(always)]
    pub(super) fn previous(&self, i: usize) -> Option<Previous> {
        let pdf = self.previous_pdf[i];
        (pdf > 0.0).then(|| Previous {
            receiver: self.previous.get(i),
            pdf,
        })
    }

    /// [`Lights::share_from_infinity`] where the last direction was drawn, at `receiver`.
    #[inline(always)]
    pub(super) fn share_from_infinity(
        &self,
        i: usize,
        lights: &Lights,
        receiver: &Receiver,
    ) -> f32 {
        let kept = self.previous_share[i];
        if kept >= 0.0 {
            kept
        } else {
            lights.share_from_infinity(receiver)
        }
    }

    /// What a path brings to its pixel.
    #[inline(always)]
    pub(super) fn seen(&self, i: usize) -> PixelSample {
        let depth = self.first.depth[i];
        PixelSample {
            colour: self.radiance.colour(i),
            albedo: self.first.albedo.colour(i),
            normal: self.first.normal.get(i),
            depth: (depth < f32::INFINITY).then_some(depth),
        }
    }

    /// A path for itself, which goes on with `ray`.
    pub(super) fn take(&self, i: usize, ray: Ray) -> Path {
        Path {
            sampler: self.samplers[i],
            ray,
            state: State {
                radiance: self.radiance.colour(i),
                throughput: self.throughput.colour(i),
                eta_scale: self.eta_scale[i],
                bodies: self.bodies[i],
                straight: self.straight[i],
                rough: self.rough[i],
                bound: self.bound[i],
                previous: self.previous(i),
                tally: Tally::default(),
            },
            first: self.seen(i),
        }
    }

    /// Puts a path back; returns what it counted since.
    pub(super) fn put(&mut self, i: usize, path: &Path) -> Tally {
        let State {
            radiance,
            throughput,
            eta_scale,
            bodies,
            straight,
            rough,
            bound: _,
            previous,
            tally,
        } = &path.state;
        self.radiance.set_colour(i, *radiance);
        self.throughput.set_colour(i, *throughput);
        self.eta_scale[i] = *eta_scale;
        self.bodies[i] = *bodies;
        self.straight[i] = *straight;
        self.rough[i] = *rough;
        self.previous_pdf[i] = previous.map_or(0.0, |p| p.pdf);
        self.previous_share[i] = -1.0;
        if let Some(previous) = previous {
            self.previous.set(i, &previous.receiver);
        }
        self.first.albedo.set_colour(i, path.first.albedo);
        self.first.normal.set(i, path.first.normal);
        self.first.depth[i] = path.first.depth.unwrap_or(f32::INFINITY);
        *tally
    }
}
