//! What the paths of a wavefront carry, in columns by the number of the path.

use specula_bsdf::{Rgb, Vec3};

use super::vertex_batch::{Column, Vectors, WAVEFRONT_SIZE, ZERO};
use super::{Path, Previous, State, Tally, bias};
use crate::accel::Ray;
use crate::film::PixelSample;
use crate::light::{Lights, Receiver};
use crate::medium_stack::MediumStack;
use crate::sampler::Sampler;

/// The columns.
pub(super) struct PathStates {
    pub(super) samplers: [Sampler; WAVEFRONT_SIZE],
    pub(super) radiance: Vectors,
    pub(super) throughput: Vectors,
    /// Product of the squared relative indices so far.
    pub(super) eta_scale: Column,
    /// What they are in.
    media: [MediumStack; WAVEFRONT_SIZE],
    /// As of `State`.
    pub(super) straight: [bool; WAVEFRONT_SIZE],
    pub(super) rough: [bool; WAVEFRONT_SIZE],
    pub(super) bound: Column,
    pub(super) previous: Receivers,
    /// Density of the last direction there; 0 where no light could have found it.
    pub(super) previous_pdf: Column,
    /// Probability with which the light sampled there was to be one from infinity; negative where it was not
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

impl PathStates {
    pub(super) fn new() -> Box<Self> {
        Box::new(Self {
            samplers: [Sampler::new([0; 2], 0, 0); WAVEFRONT_SIZE],
            radiance: Vectors::ZERO,
            throughput: Vectors::ZERO,
            eta_scale: ZERO,
            media: [MediumStack::NONE; WAVEFRONT_SIZE],
            straight: [true; WAVEFRONT_SIZE],
            rough: [false; WAVEFRONT_SIZE],
            bound: [f32::INFINITY; WAVEFRONT_SIZE],
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
    /// * `has_media`: whether paths may have entered any.
    /// * `bound`: as of `PathTracer`.
    pub(super) fn begin(&mut self, n: usize, has_media: bool, bound: f32) {
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
        if has_media {
            self.media[..n].fill(MediumStack::NONE);
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

    /// Where the last direction was sampled, if lights could have found it too.
    #[inline(always)]
    pub(super) fn previous(&self, i: usize) -> Option<Previous> {
        let pdf = self.previous_pdf[i];
        (pdf > 0.0).then(|| Previous {
            receiver: self.previous.get(i),
            pdf,
        })
    }

    /// [`Lights::share_from_infinity`] where the last direction was sampled, at `receiver`.
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
                media: self.media[i],
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
            media,
            straight,
            rough,
            bound: _,
            previous,
            tally,
        } = &path.state;
        self.radiance.set_colour(i, *radiance);
        self.throughput.set_colour(i, *throughput);
        self.eta_scale[i] = *eta_scale;
        self.media[i] = *media;
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
