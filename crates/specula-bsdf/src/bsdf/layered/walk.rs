//! The random walk between coat and base: its value for two directions, and its samples.
//!
//! A value is the sum of the connections of every vertex below the coat (`connect`). Such a walk
//! never leaves: at the coat it is always reflected, with the reflectance as a factor.
//!
//! A walk that samples follows the samples of the surfaces until it leaves.

use super::coat::Onward;
use super::connect::Ends;
use super::{Layered, Medium};
use crate::bsdf::{Event, Transport};
use crate::math::{Real, Rgb, Stream, Vec3};

/// Walks whose throughput is below this may end, so that those which go on carry as much.
const ROULETTE_BELOW: f64 = 0.25;

/// A walk below the coat.
struct State<T> {
    w: Vec3<T>,
    throughput: Rgb<T>,
    /// Above the base.
    height: T,
    /// Interfaces and particles met.
    events: u32,
}

/// What a flight ends at.
enum End {
    Base,
    Coat,
    Particle,
}

impl<T: Real> State<T> {
    /// Flies on; `None` where the walk has met too much.
    #[inline]
    fn fly(&mut self, lobe: &Layered<T>, stream: &mut Stream) -> Option<End> {
        // Leaving is an event too.
        if self.events + 1 >= lobe.max_depth {
            return None;
        }
        self.events += 1;
        self.land(lobe, stream)
    }

    #[inline]
    fn land(&mut self, lobe: &Layered<T>, stream: &mut Stream) -> Option<End> {
        let Medium {
            thickness, albedo, ..
        } = lobe.medium;
        let is_up = self.w.z > T::ZERO;
        if lobe.medium.scatters() {
            let depth = Medium::depth_of_collision(self.w, stream);
            let height = T::select(is_up, self.height + depth, self.height - depth);
            if height > T::ZERO && height < thickness {
                self.height = height;
                self.throughput *= albedo;
                return Some(End::Particle);
            }
        } else {
            self.throughput *= Medium::transmittance(thickness, self.w);
        }
        self.height = T::select(is_up, thickness, T::ZERO);
        Some(if is_up { End::Coat } else { End::Base })
    }

    /// Whether the walk goes on, by Russian roulette.
    #[inline]
    fn survives(&mut self, stream: &mut Stream) -> bool {
        let carried = self.throughput.max_channel();
        let least = T::of(ROULETTE_BELOW);
        if carried >= least {
            return true;
        }
        let is_alive = stream.next::<T>() * least < carried;
        self.throughput *= least / carried.at_least(T::TINY);
        is_alive
    }
}

/// An estimate of `f |cos|` without the coat's own reflection.
pub(super) fn eval<T: Real>(
    lobe: &Layered<T>,
    wo: Vec3<T>,
    wi: Vec3<T>,
    stream: &mut Stream,
) -> Rgb<T> {
    let start = lobe.coat.enter(wo, Transport::Importance, stream);
    let is_sampled_from_light =
        lobe.is_base_narrow() && !lobe.medium.scatters() && lobe.max_depth >= 2;
    let mut ends = Ends {
        wo,
        wi,
        entry: lobe.coat.enter(wi, Transport::Radiance, stream),
        first: (start.filter(|_| is_sampled_from_light)).map(|start| start.pdf),
    };
    let mut sum = if is_sampled_from_light {
        ends.sampled_from_light(lobe, stream)
    } else {
        Rgb::BLACK
    };
    let Some(start) = start else { return sum };
    let mut state = State {
        w: start.w,
        throughput: Rgb::splat(start.weight),
        height: lobe.medium.thickness,
        events: 0,
    };
    while let Some(end) = state.fly(lobe, stream) {
        let next = match end {
            End::Coat => lobe.coat.bounce(state.w, stream),
            End::Base => {
                let (light, next) = ends.at_base(lobe, state.w, stream);
                sum += state.throughput * light;
                next
            }
            End::Particle => {
                let ways = [state.height, lobe.medium.thickness - state.height];
                let left = lobe.max_depth - state.events;
                let (light, w) = ends.at_particle(lobe, state.w, ways, left, stream);
                sum += state.throughput * light;
                Some(Onward {
                    w,
                    weight: Rgb::WHITE,
                })
            }
        };
        let Some(Onward { w, weight }) = next else {
            break;
        };
        ends.first = None;
        state.w = w;
        state.throughput *= weight;
        if w.z == T::ZERO || !state.survives(stream) {
            break;
        }
    }
    sum
}

/// A direction that left.
pub(super) struct Exit<T> {
    pub(super) wi: Vec3<T>,
    pub(super) weight: Rgb<T>,
    /// Whether every surface on the way was smooth.
    pub(super) specular: bool,
}

/// Samples a direction by the walk; `None` where nothing leaves.
///
/// * `u`: samples the first event at the coat.
pub(super) fn sample<T: Real>(
    lobe: &Layered<T>,
    wo: Vec3<T>,
    u: [T; 3],
    stream: &mut Stream,
) -> Option<Exit<T>> {
    let first = lobe.coat.scatter_above(wo, u)?;
    let mut specular = first.specular;
    if first.event == Event::Reflection {
        return Some(Exit {
            wi: first.wi,
            weight: first.weight,
            specular,
        });
    }
    let mut state = State {
        w: first.wi,
        throughput: first.weight,
        height: lobe.medium.thickness,
        events: 0,
    };
    loop {
        // Leaving is the last event.
        if state.events >= lobe.max_depth {
            return None;
        }
        state.events += 1;
        match state.land(lobe, stream)? {
            End::Base => {
                let (w, weight, _) = lobe.base.sample(-state.w, stream)?;
                specular &= lobe.base.is_mirror();
                state.w = w;
                state.throughput *= weight;
            }
            End::Particle => {
                state.w = lobe.medium.turned(state.w, stream);
                specular = false;
            }
            End::Coat => {
                let next = lobe.coat.scatter_below(state.w, stream)?;
                state.throughput *= next.weight;
                state.w = next.wi;
                if next.event == Event::Transmission {
                    return Some(Exit {
                        wi: state.w,
                        weight: state.throughput,
                        specular,
                    });
                }
            }
        }
        if state.w.z == T::ZERO || !state.survives(stream) {
            return None;
        }
    }
}
