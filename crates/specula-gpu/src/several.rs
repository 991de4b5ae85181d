//! Several GPUs that take the samples of one render, each as many as it is fast.

use std::collections::VecDeque;
use std::sync::atomic::AtomicBool;
use std::{mem, panic, thread};

use specula_render::{
    Most, PassReport, PreparedScene, RenderOptions, Renderer, RunSums, SampleDevice, Wanted,
};

use crate::adapter::{AdapterDescription, Gpu, GpuError};
use crate::error::TracerError;
use crate::tracer::{Tracer, TracerOptions};

/// Tracers of one scene, each on a GPU of its own.
///
/// A pass gives each of them tiles in the ratio of their samples a second so far. The samples are those of one GPU: films
/// are the same bit for bit where the GPUs and their drivers are, else they differ by rounding, as those of other GPUs do.
#[derive(Debug)]
pub struct Tracers<'a> {
    members: Vec<Tracer<'a>>,
    /// Of what was begun and is not finished: whether each member has a part.
    begun: VecDeque<Vec<bool>>,
    /// What was finished last, of all members.
    sums: Vec<RunSums>,
    /// Places of members that failed in this pass, and how.
    failed: Vec<(usize, GpuError)>,
    lost: Vec<LostGpu>,
}

/// A GPU that failed, and that others go on without.
#[derive(Clone, Debug)]
pub struct LostGpu {
    /// Which one.
    pub adapter: AdapterDescription,
    /// How it failed.
    pub error: GpuError,
}

impl<'a> Tracers<'a> {
    /// Compiles the scene's shader on each GPU and uploads the scene, all at the same time.
    ///
    /// # Errors
    /// The first GPU, by its place in `gpus`, on which [`Tracer::with_options`] fails.
    pub fn new(
        gpus: &'a [Gpu],
        scene: &PreparedScene,
        options: &RenderOptions,
        on_gpu: TracerOptions,
    ) -> Result<Self, (usize, TracerError)> {
        let made = concurrently(gpus.iter().collect(), |gpu| {
            Tracer::with_options(gpu, scene, options, on_gpu)
        });
        let members = made.into_iter().enumerate();
        let members = members.map(|(place, tracer)| tracer.map_err(|error| (place, error)));
        Ok(Self {
            members: members.collect::<Result<_, _>>()?,
            begun: VecDeque::new(),
            sums: Vec::new(),
            failed: Vec::new(),
            lost: Vec::new(),
        })
    }

    /// The tracers that are left.
    #[must_use]
    pub fn members(&self) -> &[Tracer<'a>] {
        &self.members
    }

    /// GPUs that failed since this was asked last. Others have taken their samples.
    pub fn lost(&mut self) -> Vec<LostGpu> {
        mem::take(&mut self.lost)
    }

    /// Adds samples to a render's film: [`Renderer::render_pass`] on the devices. Without a GPU that fails the others go
    /// on.
    ///
    /// # Errors
    /// Those of the last GPU. Samples of finished batches stay in the film.
    pub fn render_pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        loop {
            // What an earlier pass left that failed.
            self.begun.clear();
            self.failed.clear();
            self.members.iter_mut().for_each(Tracer::forget);
            match renderer.render_pass_with(samples, stop, self) {
                Err(_) if (1..self.members.len()).contains(&self.failed.len()) => self.leave_out(),
                result => return result,
            }
        }
    }

    /// Goes on without the members that failed.
    fn leave_out(&mut self) {
        for (place, error) in self.failed.drain(..).rev() {
            let adapter = self.members.remove(place).gpu().adapter.clone();
            self.lost.push(LostGpu { adapter, error });
        }
    }

    /// The share of the samples that each member gets: by their rates, or equal ones until all are known.
    fn shares(&self) -> Vec<f64> {
        let rates: Option<Vec<f64>> = self.members.iter().map(Tracer::rate).collect();
        let rates = rates.unwrap_or_else(|| vec![1.0; self.members.len()]);
        let sum: f64 = rates.iter().sum();
        rates.iter().map(|rate| rate / sum).collect()
    }

    /// Notes who failed; returns the first error.
    fn checked<T>(&mut self, results: Vec<Result<T, GpuError>>) -> Result<Vec<T>, GpuError> {
        let errors = results.iter().map(|result| result.as_ref().err());
        let failed = errors.enumerate();
        let failed = failed.filter_map(|(place, error)| Some((place, error?.clone())));
        self.failed = failed.collect();
        results.into_iter().collect()
    }
}

impl SampleDevice for Tracers<'_> {
    type Error = GpuError;

    fn most(&self) -> Most {
        let most = |of: fn(Most) -> usize| {
            let each = self.members.iter().zip(self.shares());
            let each = each.map(|(member, share)| of(member.most()) as f64 / share);
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "positive, and saturating"
            )]
            let least = each.fold(f64::INFINITY, f64::min) as usize;
            least
        };
        Most {
            samples: most(|most| most.samples),
            runs: most(|most| most.runs),
        }
    }

    fn begin(&mut self, wanted: &[Wanted]) -> Result<(), GpuError> {
        let parts = parts(wanted, &self.shares());
        let given: Vec<_> = self.members.iter_mut().zip(parts).collect();
        let results = concurrently(given, |(member, part)| match part.is_empty() {
            true => Ok(false),
            false => member.begin(part).map(|()| true),
        });
        let begun = self.checked(results)?;
        self.begun.push_back(begun);
        Ok(())
    }

    fn finish(&mut self) -> Result<&[RunSums], GpuError> {
        let has_part = self.begun.pop_front().unwrap_or_default();
        let given: Vec<_> = self.members.iter_mut().zip(&has_part).collect();
        let results = concurrently(given, |(member, has_part)| match has_part {
            true => member.finish().map(|_| ()),
            false => Ok(()),
        });
        self.checked(results)?;
        if let [member] = self.members.as_slice() {
            return Ok(member.sums());
        }
        self.sums.clear();
        for (member, has_part) in self.members.iter().zip(has_part) {
            if has_part {
                self.sums.extend_from_slice(member.sums());
            }
        }
        Ok(&self.sums)
    }
}

/// Does something for all of them at the same time, in their order; a panic goes on here.
fn concurrently<T: Send, R: Send>(each: Vec<T>, does: impl Fn(T) -> R + Sync) -> Vec<R> {
    if each.len() == 1 {
        return each.into_iter().map(does).collect();
    }
    let does = &does;
    thread::scope(|scope| {
        let threads: Vec<_> = each
            .into_iter()
            .map(|one| scope.spawn(move || does(one)))
            .collect();
        let joined = threads.into_iter().map(thread::ScopedJoinHandle::join);
        joined
            .map(|result| result.unwrap_or_else(|cause| panic::resume_unwind(cause)))
            .collect()
    })
}

/// Cuts what is wanted where the shares of its samples end, one after the other. A tile goes whole to the one in whose
/// share its middle lies.
fn parts<'w>(wanted: &'w [Wanted], shares: &[f64]) -> Vec<&'w [Wanted]> {
    let all: usize = wanted.iter().map(Wanted::len).sum();
    let (mut rest, mut before, mut end) = (wanted, 0, 0.0);
    let mut parts = Vec::with_capacity(shares.len());
    for (place, share) in shares.iter().enumerate() {
        end += share * all as f64;
        let is_last = place + 1 == shares.len();
        let mut count = 0;
        for one in rest {
            if !is_last && before as f64 + 0.5 * one.len() as f64 >= end {
                break;
            }
            before += one.len();
            count += 1;
        }
        let (part, later) = rest.split_at(count);
        parts.push(part);
        rest = later;
    }
    parts
}

#[cfg(test)]
mod tests;
