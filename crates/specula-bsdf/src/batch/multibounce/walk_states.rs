//! Walks in batches: their states in structures of arrays, and the loops of one bounce.
//!
//! All walks are at the same bounce. Layers of [`DepthState`] are rows, one for each bounce: that of
//! a flight up is void, of rate 0. After a bounce the walks that go on are moved to the front, so
//! that loops run over walks under way only; the rest of the last vector is idle and never read.

use crate::batch::slices::{Colours, Directions};
use crate::fresnel::Reflectance;
use crate::math::{Real, Rgb, Stream, Vec3, rgb, vec3};
use crate::multibounce::state::DepthState;
use crate::multibounce::walk::{Facets, Flight, meet};
use crate::ndf::Ggx;

/// Walks at a time: few enough that their states stay in the second nearest cache. As many as an
/// [`Index`] tells apart, so that none is out of bounds.
pub(super) const WALKS: usize = 256;
/// The index of a walk.
pub(super) type Index = u8;
/// One value for every walk.
pub(super) type PerWalk<T> = [T; WALKS];

/// Bounces in batches, at most; survivors go on one by one.
pub(super) const BOUNCES: usize = 8;
/// So few walks go on one by one.
pub(super) const FEW: usize = 6;
/// Lanes of the widest vector: loops run over multiples of it.
const WIDTH: usize = 16;

/// The index of a walk, `i < WALKS`.
#[inline(always)]
pub(super) fn index(i: usize) -> Index {
    #[allow(clippy::cast_possible_truncation, reason = "below WALKS")]
    {
        i as Index
    }
}

/// The reflectance at the cosine of every walk. Each loop knows the model, so that none branches.
#[inline(always)]
pub(super) fn reflect<T: Real>(
    reflectance: &Reflectance<T>,
    cos: &PerWalk<T>,
    fresnel: &mut Colours<PerWalk<T>>,
    count: usize,
) {
    /// The loop of one model.
    macro_rules! each {
        ($f:ident) => {
            for (i, cos) in cos[..whole(count)].iter().enumerate() {
                fresnel.put(i, $f.eval(*cos));
            }
        };
    }
    match reflectance {
        Reflectance::Constant(f) => {
            for i in 0..whole(count) {
                fresnel.put(i, *f);
            }
        }
        Reflectance::Conductor(f) => each!(f),
        Reflectance::Schlick(f) => each!(f),
        Reflectance::F82Tint(f) => each!(f),
        Reflectance::Tinted(f) => each!(f),
    }
}

/// Facets in batches.
pub(super) type Metal<T> = Facets<T, Ggx<T>>;

impl<T: Real> Directions<PerWalk<T>> {
    pub(super) const NONE: Self = Self {
        x: [T::ZERO; WALKS],
        y: [T::ZERO; WALKS],
        z: [T::ZERO; WALKS],
    };

    #[inline(always)]
    pub(super) fn at(&self, i: usize) -> Vec3<T> {
        vec3(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub(super) fn put(&mut self, i: usize, v: Vec3<T>) {
        (self.x[i], self.y[i], self.z[i]) = (v.x, v.y, v.z);
    }
}

impl<T: Real> Colours<PerWalk<T>> {
    pub(super) const NONE: Self = Self {
        r: [T::ZERO; WALKS],
        g: [T::ZERO; WALKS],
        b: [T::ZERO; WALKS],
    };

    #[inline(always)]
    pub(super) fn at(&self, i: usize) -> Rgb<T> {
        rgb(self.r[i], self.g[i], self.b[i])
    }

    #[inline(always)]
    pub(super) fn put(&mut self, i: usize, c: Rgb<T>) {
        (self.r[i], self.g[i], self.b[i]) = (c.r, c.g, c.b);
    }
}

/// The number of walks that a loop over `count` of them runs over: whole vectors.
#[inline(always)]
pub(super) fn whole(count: usize) -> usize {
    (count.min(WALKS) + WIDTH - 1) & !(WIDTH - 1)
}

/// [`Stream::next`] in a form that vectorises: machines without AVX-512 convert no 64-bit integers.
#[inline(always)]
pub(super) fn next<T: Real>(stream: &mut Stream) -> T {
    const TWO_52: f64 = 4_503_599_627_370_496.0;
    const TWO_32: f64 = 4_294_967_296.0;
    let is_single = T::EPSILON.to_f64() > 1e-10;
    let (digits, step) = if is_single {
        (24, 1.0 / 16_777_216.0)
    } else {
        (53, 0.5 / TWO_52)
    };
    let bits = stream.next_bits() >> (64 - digits);
    // 2^52 + x has the bits of x at its end.
    let part = |x: u64| f64::from_bits(TWO_52.to_bits() | x) - TWO_52;
    let low = part(bits & 0xffff_ffff);
    T::of((part(bits >> 32) * TWO_32 + low) * step)
}

/// [`next`], taken from the stream only if needed.
#[inline(always)]
pub(super) fn next_if<T: Real>(stream: &mut Stream, is_needed: bool) -> T {
    let mut after = stream.clone();
    let u = next(&mut after);
    if is_needed {
        *stream = after;
    }
    u
}

/// One stream for every walk.
pub(super) const NO_STREAMS: [Stream; WALKS] = [const { Stream::new(0) }; WALKS];

/// The states of walks.
pub(super) struct Walks<T> {
    /// Which element's walk this is.
    pub(super) element: PerWalk<Index>,
    pub(super) streams: [Stream; WALKS],
    /// Random numbers of the next bounce.
    pub(super) u: [PerWalk<T>; 2],
    pub(super) d: Directions<PerWalk<T>>,
    /// `sigma(-d)`.
    pub(super) facing: PerWalk<T>,
    pub(super) weight: Colours<PerWalk<T>>,
    /// Cosine of incidence on a facet.
    pub(super) cos: PerWalk<T>,
    /// Its reflectance.
    pub(super) fresnel: Colours<PerWalk<T>>,
    /// Rate of a flight up; 0 of a flight down.
    pub(super) climb: PerWalk<T>,
    /// Layers of the depths' states.
    pub(super) rates: [PerWalk<T>; BOUNCES + 1],
    pub(super) masses: [PerWalk<T>; BOUNCES + 1],
    /// Mass that left by the last flight up.
    pub(super) left: PerWalk<T>,
    /// Mass that has not left.
    pub(super) mass: PerWalk<T>,
    /// Direction of the other end of the path, and its rate.
    pub(super) target: Directions<PerWalk<T>>,
    pub(super) target_rate: PerWalk<T>,
    /// Mass that would leave for the target.
    pub(super) exit: PerWalk<T>,
    pub(super) quotient: PerWalk<T>,
    /// 1 where the walk goes on, else 0.
    pub(super) goes_on: PerWalk<Index>,
    /// The walks that go on, in order; behind them, those that do not, reversed.
    pub(super) order: PerWalk<Index>,
}

impl<T: Real> Walks<T> {
    /// No walks: a constant, so that it is not built in one place and moved to another.
    pub(super) const NONE: Self = Self {
        element: [0; WALKS],
        streams: NO_STREAMS,
        u: [[T::ZERO; WALKS]; 2],
        d: Directions::<PerWalk<T>>::NONE,
        facing: [T::ZERO; WALKS],
        weight: Colours::<PerWalk<T>>::NONE,
        cos: [T::ZERO; WALKS],
        fresnel: Colours::<PerWalk<T>>::NONE,
        climb: [T::ZERO; WALKS],
        rates: [[T::ZERO; WALKS]; BOUNCES + 1],
        masses: [[T::ZERO; WALKS]; BOUNCES + 1],
        left: [T::ZERO; WALKS],
        mass: [T::ZERO; WALKS],
        target: Directions::<PerWalk<T>>::NONE,
        target_rate: [T::ZERO; WALKS],
        exit: [T::ZERO; WALKS],
        quotient: [T::ZERO; WALKS],
        goes_on: [0; WALKS],
        order: [0; WALKS],
    };

    /// A bounce: directions, weights, quotients, and a row of layers.
    ///
    /// * `TARGETED`: with quotients.
    #[inline(always)]
    pub(super) fn bounce<const TARGETED: bool>(
        &mut self,
        facets: &Metal<T>,
        row: usize,
        count: usize,
    ) {
        let (rates, masses) = (&mut self.rates[row], &mut self.masses[row]);
        for i in 0..whole(count) {
            let flight = Flight::new(&facets.ndf, self.d.at(i));
            let (_, cos, next) = meet(&facets.ndf, flight.d, [self.u[0][i], self.u[1][i]]);
            if TARGETED {
                self.quotient[i] = flight.facing * (self.quotient[i] / next.backing);
            }
            self.cos[i] = cos;
            self.d.put(i, next.d);
            self.facing[i] = next.facing;
            let up = next.is_upward();
            self.climb[i] = T::select(up, next.rate, T::ZERO);
            rates[i] = T::select(up, T::ZERO, next.rate);
            masses[i] = T::ZERO;
        }
        reflect(&facets.reflectance, &self.cos, &mut self.fresnel, count);
        for i in 0..whole(count) {
            self.weight.put(i, self.weight.at(i) * self.fresnel.at(i));
        }
    }

    /// What flights make of the first `rows` of layers; see [`DepthState`].
    ///
    /// * `TARGETED`: with the mass that would leave for the target.
    #[inline(always)]
    pub(super) fn fly<const TARGETED: bool>(&mut self, rows: usize, count: usize) {
        let whole = whole(count);
        self.left[..whole].fill(T::ZERO);
        self.mass[..whole].fill(T::ZERO);
        self.exit[..whole].fill(T::ZERO);
        for (rates, masses) in self.rates.iter().zip(&mut self.masses).take(rows) {
            for i in 0..whole {
                let (l, c, climb) = (rates[i], masses[i], self.climb[i]);
                let is_layer = l > T::ZERO;
                let r = (c + self.left[i]) / (climb + l);
                let c = T::select(is_layer & (climb > T::ZERO), climb * r, c);
                masses[i] = c;
                self.left[i] = T::select(is_layer, l * r, self.left[i]);
                self.mass[i] += c;
                if TARGETED {
                    let exit = (self.exit[i] + c) * (l / (l + self.target_rate[i]));
                    self.exit[i] = T::select(is_layer, exit, self.exit[i]);
                }
            }
        }
    }

    /// Puts the walks that go on first in `order`. Returns how many they are.
    ///
    /// * `ENDED`: puts the others last, the first of them at the very end.
    #[inline(always)]
    pub(super) fn sort<const ENDED: bool>(&mut self, count: usize) -> usize {
        let mut going = 0;
        for i in 0..count.min(WALKS) {
            // Written to both places; the wrong one is free, and written again or not read.
            self.order[going % WALKS] = index(i);
            if ENDED {
                self.order[(WALKS - 1 + going - i) % WALKS] = index(i);
            }
            going += usize::from(self.goes_on[i]);
        }
        going.min(WALKS)
    }

    /// Moves the first `count` in `order` to the front, but for their elements and streams.
    #[inline(always)]
    pub(super) fn move_up<const TARGETED: bool>(&mut self, rows: usize, count: usize) {
        let count = count.min(WALKS);
        for j in 0..count {
            let i = usize::from(self.order[j]);
            self.d.put(j, self.d.at(i));
            self.weight.put(j, self.weight.at(i));
            if TARGETED {
                self.target.put(j, self.target.at(i));
                self.target_rate[j] = self.target_rate[i];
                self.quotient[j] = self.quotient[i];
            }
        }
        for (rates, masses) in self.rates.iter_mut().zip(&mut self.masses).take(rows) {
            for j in 0..count {
                let i = usize::from(self.order[j]);
                rates[j] = rates[i];
                masses[j] = masses[i];
            }
        }
    }

    /// Random numbers for the next facets.
    #[inline(always)]
    pub(super) fn sample_facets(&mut self, count: usize) {
        let streams = &mut self.streams[..whole(count)];
        for u in &mut self.u {
            for (u, stream) in u.iter_mut().zip(&mut *streams) {
                *u = next(stream);
            }
        }
    }

    /// The walk `i` as the scalar functions have it.
    #[inline(always)]
    pub(super) fn state(
        &self,
        facets: &Metal<T>,
        rows: usize,
        i: usize,
    ) -> (DepthState<T>, Flight<T>) {
        let layers = self.rates.iter().zip(&self.masses).take(rows);
        let layers = layers.map(|(rates, masses)| (rates[i], masses[i]));
        (
            DepthState::of_layers(layers.filter(|(rate, _)| *rate > T::ZERO)),
            Flight::new(&facets.ndf, self.d.at(i)),
        )
    }
}
