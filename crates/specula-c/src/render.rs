//! Renders: passes until the samples, the noise or the time are reached, or the caller has had enough.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};
use specula_render::picture::Metadata;
use specula_render::{
    MOST_SAMPLES, MemoryEstimate, PreparedScene, RenderGoal, RenderOptions, Renderer, TextureFilter,
};

use crate::failure::{Failure, Status};
use crate::options;
use crate::picture::PictureHandle;
use crate::scene::SceneHandle;

/// Between two calls of the progress function.
const POLL: Duration = Duration::from_millis(50);
/// Where a render by time ends in any case.
const MOST_BY_TIME: u32 = RenderGoal::MOST_BY_TIME;

/// A range check of an option.
fn within(name: &str, value: f64, most: f64) -> Result<Option<f64>, Failure> {
    match value {
        0.0 => Ok(None),
        x if x > 0.0 && x <= most => Ok(Some(x)),
        x => Err(Failure::invalid(format!(
            "options.{name}: expected 0 for none, or a number up to {most}, got {x}"
        ))),
    }
}

/// What a caller's options ask for.
fn asked(
    scene: &SceneHandle,
    given: &options::RenderOptions,
) -> Result<(RenderOptions, RenderGoal), Failure> {
    let mut options = RenderOptions::from_scene(&scene.scene);
    let noise = within("noise", given.noise, 1.0)?;
    let time = within("seconds", given.seconds, 1e9)?;
    options.samples_per_pixel = match given.samples_per_pixel {
        0 if noise.is_some() || time.is_some() => MOST_BY_TIME,
        0 => options.samples_per_pixel,
        samples @ 1..=MOST_BY_TIME => samples,
        samples => {
            return Err(Failure::invalid(format!(
                "options.samples_per_pixel: expected 0 for the scene's, or up to {MOST_BY_TIME}, got {samples}"
            )));
        }
    };
    options.seed = given.seed;
    options.texture_filter = match given.texture_filter {
        options::SPECULA_TEXTURE_FILTER_SCENE => TextureFilter::Scene,
        options::SPECULA_TEXTURE_FILTER_BILINEAR => TextureFilter::Bilinear,
        options::SPECULA_TEXTURE_FILTER_TRILINEAR => TextureFilter::Trilinear,
        options::SPECULA_TEXTURE_FILTER_EWA => TextureFilter::Ewa,
        other => {
            return Err(Failure::invalid(format!(
                "options.texture_filter: expected one of SPECULA_TEXTURE_FILTER_*, got {other}"
            )));
        }
    };
    options.filter_normal_maps = match given.filter_normal_maps {
        0 => false,
        1 => true,
        other => {
            return Err(Failure::invalid(format!(
                "options.filter_normal_maps: expected 0 or 1, got {other}"
            )));
        }
    };
    options.max_depth = match given.max_depth {
        -1 => options.max_depth,
        depth => u32::try_from(depth).map_err(|_| {
            Failure::invalid(format!(
                "options.max_depth: expected -1 for the scene's, or 0 or more, got {depth}"
            ))
        })?,
    };
    options.resolution = match [given.width, given.height] {
        [0, 0] => None,
        [0, _] | [_, 0] => {
            return Err(Failure::invalid(
                "options.width, options.height: expected both, or 0 and 0 for the scene's",
            ));
        }
        size => Some(size),
    };
    #[expect(clippy::cast_possible_truncation, reason = "in [0, 1], rounded")]
    let single = |x: f64| x as f32;
    options.noise = noise.map(single);
    let mut samples = options.samples_per_pixel;
    if options.noise.is_some() {
        // What is done is the film's to say.
        options.samples_per_pixel = samples.min(MOST_SAMPLES);
        samples = MOST_SAMPLES;
    }
    let time = time.map(Duration::from_secs_f64);
    Ok((
        options,
        RenderGoal {
            most_samples: samples,
            time,
        },
    ))
}

/// Fails where a render would take more memory than there is: allocations later on cannot fail.
fn has_memory(scene: &SceneHandle, options: &RenderOptions, threads: usize) -> Result<(), Failure> {
    let [width, height] = options.resolution.unwrap_or(scene.scene.film.resolution);
    // More is refused, for its size, when it is prepared.
    let most = 1 << 30;
    if u64::from(width) * u64::from(height) > most {
        return Ok(());
    }
    are_free(MemoryEstimate::new(&scene.scene, options, threads).peak())
}

fn are_free(bytes: u64) -> Result<(), Failure> {
    let reserved =
        usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok());
    match reserved {
        true => Ok(()),
        false => Err(Failure::new(
            Status::OutOfMemory,
            format!("the render takes {bytes} bytes of memory: more than there are"),
        )),
    }
}

/// Calls the caller's function; it returns whether the render goes on.
pub(crate) type Tell<'a> = &'a mut dyn FnMut(f64, f64) -> bool;

/// Renders a scene; returns the picture, and whether the render was cancelled.
pub(crate) fn render(
    scene: &SceneHandle,
    given: &options::RenderOptions,
    tell: Tell<'_>,
) -> Result<(PictureHandle, bool), Failure> {
    let start = Instant::now();
    let (options, goal) = asked(scene, given)?;
    let pool = ThreadPoolBuilder::new()
        .num_threads(given.threads as usize)
        .build()
        .map_err(|e| Failure::new(Status::Internal, format!("cannot start threads: {e}")))?;
    has_memory(scene, &options, pool.current_num_threads())?;
    let prepared = pool
        .install(|| PreparedScene::new(&scene.scene, &options))
        .map_err(Failure::invalid)?;
    let mut renderer = Renderer::new(&prepared, options);
    let goes_on = passes(&pool, &mut renderer, goal, tell);
    let film = renderer.film();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "for people: the nearest number is near enough, and none is below 0"
    )]
    let (samples, seconds) = (
        film.most_and_mean_samples().1.round() as u32,
        start.elapsed().as_secs_f32(),
    );
    let metadata = Metadata {
        software: Some(format!("specula {}", env!("CARGO_PKG_VERSION"))),
        scene: Some(scene.name.clone()),
        samples_per_pixel: Some(samples),
        seed: Some(renderer.options().seed),
        render_seconds: Some(seconds),
        bias: renderer.options().bias(),
        missing: None,
    };
    let picture = film.picture();
    Ok((PictureHandle { picture, metadata }, !goes_on))
}

/// Takes samples; returns whether the caller let all of them be taken.
fn passes(
    pool: &ThreadPool,
    renderer: &mut Renderer<'_>,
    goal: RenderGoal,
    tell: Tell<'_>,
) -> bool {
    let start = Instant::now();
    let mut last = None;
    let mut told = (0.0, 0.0);
    while let Some(done) = renderer.samples_done() {
        let Some(next) = goal.next_pass(done, last, start.elapsed()) else {
            break;
        };
        let pass_start = Instant::now();
        if !pass(pool, renderer, next, &mut || tell(told.0, told.1)) {
            return false;
        }
        last = Some((next, pass_start.elapsed()));
        let of_samples = renderer.share_done(goal.most_samples);
        told = (
            goal.share_done(of_samples, start.elapsed()),
            renderer.film().most_and_mean_samples().1,
        );
        if !tell(told.0, told.1) {
            return false;
        }
    }
    true
}

/// One pass, in the pool; this thread asks meanwhile whether it is to go on.
fn pass(
    pool: &ThreadPool,
    renderer: &mut Renderer<'_>,
    samples: u32,
    goes_on: &mut dyn FnMut() -> bool,
) -> bool {
    let stop = AtomicBool::new(false);
    let (sender, receiver) = channel();
    pool.in_place_scope(|scope| {
        scope.spawn(|_| {
            let pass = || renderer.render_pass(samples, &stop);
            // Nobody waits any more where the render was stopped.
            let _ = sender.send(catch_unwind(AssertUnwindSafe(pass)));
        });
        loop {
            match receiver.recv_timeout(POLL) {
                Ok(Ok(_)) => return true,
                Ok(Err(panic)) => resume_unwind(panic),
                Err(RecvTimeoutError::Disconnected) => return false,
                Err(RecvTimeoutError::Timeout) => {
                    if !goes_on() {
                        stop.store(true, Ordering::Relaxed);
                        return false;
                    }
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_is_not_there_is_a_failure() {
        assert!(are_free(1 << 20).is_ok());
        for bytes in [1 << 62, u64::MAX] {
            let failure = are_free(bytes).err().map(|f| (f.status, f.message));
            let message = format!("the render takes {bytes} bytes of memory: more than there are");
            assert_eq!(failure, Some((Status::OutOfMemory, message)));
        }
    }
}
