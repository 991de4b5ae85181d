//! The state of the paths of a wavefront, as a structure of arrays.

use specula_bsdf::{Rgb, Vec3};

use super::vertex_batch::{Floats, Vectors, WAVEFRONT_SIZE, ZERO};
use super::{Path, PathState, PreviousVertex, Tally, estimator};
use crate::accel::Ray;
use crate::film::PixelSample;
use crate::light::{Lights, Receiver};
use crate::medium_stack::MediumStack;
use crate::ray_cone::RayCone;
use crate::sampler::Sampler;

/// The states, by index of the path.
pub(super) struct PathStates {
    pub(super) samplers: [Sampler; WAVEFRONT_SIZE],
    /// Their times, in exposures: 0 where nothing moves.
    pub(super) times: Floats,
    pub(super) radiance: Vectors,
    pub(super) throughput: Vectors,
    /// Product of the squared relative indices so far.
    pub(super) eta_scale: Floats,
    /// The media that they are in.
    media: [MediumStack; WAVEFRONT_SIZE],
    /// Their cones, where textures are filtered.
    pub(super) cones: [RayCone; WAVEFRONT_SIZE],
    /// As of `PathState`.
    pub(super) straight: [bool; WAVEFRONT_SIZE],
    pub(super) rough: [bool; WAVEFRONT_SIZE],
    pub(super) bound: Floats,
    pub(super) previous: Receivers,
    /// Density with which the last direction was sampled there; 0 where no light sample could have had it.
    pub(super) previous_pdf: Floats,
    /// Probability with which light sampling took a light from infinity there; negative where it is not stored.
    pub(super) previous_share: Floats,
    pub(super) first: FirstHits,
}

/// Receivers of light; see [`Receiver`].
pub(super) struct Receivers {
    point: Vectors,
    /// Zero where light arrives from both sides.
    normal: Vectors,
}

/// Albedo, normal and depth of the first vertices.
pub(super) struct FirstHits {
    pub(super) albedo: Vectors,
    pub(super) normal: Vectors,
    /// Distance along the camera rays; infinite where they hit nothing.
    pub(super) depth: Floats,
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
            times: ZERO,
            radiance: Vectors::ZERO,
            throughput: Vectors::ZERO,
            eta_scale: ZERO,
            media: [MediumStack::NONE; WAVEFRONT_SIZE],
            cones: [RayCone::NONE; WAVEFRONT_SIZE],
            straight: [true; WAVEFRONT_SIZE],
            rough: [false; WAVEFRONT_SIZE],
            bound: Floats::of(f32::INFINITY),
            previous: Receivers {
                point: Vectors::ZERO,
                normal: Vectors::ZERO,
            },
            previous_pdf: ZERO,
            previous_share: ZERO,
            first: FirstHits {
                albedo: Vectors::ZERO,
                normal: Vectors::ZERO,
                depth: ZERO,
            },
        })
    }

    /// Begins the first `n` paths anew; their samplers are set elsewhere.
    ///
    /// * `has_media`: whether the scene has absorbing media.
    /// * `bound`: as of `PathTracer`.
    pub(super) fn begin(&mut self, n: usize, has_media: bool, bound: f32) {
        self.radiance.fill(0..n, 0.0);
        self.throughput.fill(0..n, 1.0);
        self.first.albedo.fill(0..n, 0.0);
        self.first.normal.fill(0..n, 0.0);
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

    /// Adds light that was scattered `events` times on its way to the camera.
    #[inline(always)]
    pub(super) fn add(&mut self, i: usize, contribution: Rgb<f32>, events: u32) {
        let radiance = estimator::clamp_indirect(contribution, events, self.bound[i]);
        self.radiance.x[i] += radiance.r;
        self.radiance.y[i] += radiance.g;
        self.radiance.z[i] += radiance.b;
    }

    /// Where the last direction was sampled, if a light sample could have had it.
    #[inline(always)]
    pub(super) fn previous(&self, i: usize) -> Option<PreviousVertex> {
        let pdf = self.previous_pdf[i];
        (pdf > 0.0).then(|| PreviousVertex {
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
        let stored = self.previous_share[i];
        if stored >= 0.0 {
            stored
        } else {
            lights.share_from_infinity(receiver)
        }
    }

    /// Whether something absorbs where a path is, or it remembers bodies that it is in.
    #[inline(always)]
    pub(super) fn is_in_a_medium(&self, i: usize) -> bool {
        !self.media[i].is_empty()
    }

    /// What a path adds to its pixel.
    #[inline(always)]
    pub(super) fn pixel_sample(&self, i: usize) -> PixelSample {
        let depth = self.first.depth[i];
        PixelSample {
            colour: self.radiance.colour(i),
            albedo: self.first.albedo.colour(i),
            normal: self.first.normal.get(i),
            depth: (depth < f32::INFINITY).then_some(depth),
        }
    }

    /// One path, which continues with `ray`.
    pub(super) fn load(&self, i: usize, ray: Ray) -> Path {
        Path {
            sampler: self.samplers[i],
            ray,
            state: PathState {
                radiance: self.radiance.colour(i),
                throughput: self.throughput.colour(i),
                eta_scale: self.eta_scale[i],
                media: self.media[i],
                cone: self.cones[i],
                straight: self.straight[i],
                rough: self.rough[i],
                bound: self.bound[i],
                previous: self.previous(i),
                tally: Tally::default(),
            },
            first: self.pixel_sample(i),
        }
    }

    /// Stores a path; returns its counts.
    pub(super) fn store(&mut self, i: usize, path: &Path) -> Tally {
        let PathState {
            radiance,
            throughput,
            eta_scale,
            media,
            cone,
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
        self.cones[i] = *cone;
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
