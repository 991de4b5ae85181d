// Where in the microsurface a walk collides, given its directions alone: our state without
// cancellation.
//
// Let `l = |Lambda(d)|` be the rate of a flight (see `walk`). The depth of the k-th collision, given
// `d_0 .. d_{k-1}` and that the walk has not left, is a mixture
//
//     sum_j c_j Hypoexponential(l_j, .., l_N)          all c_j >= 0,  sum_j c_j = mass not yet left
//
// of sums of independent exponential layers. Every layer is memoryless, which gives the updates:
//
//     down (rate l):  one more layer below:       append l, c = 0 ... the depth grows by Exp(l)
//     up (rate L):    climbs Exp(L), topmost layer last. Within the layer j it is met by a facet
//                     with probability L / (L + l_j), and what is left of it is again Exp(l_j):
//                         r = (c_j + carry) / (L + l_j),   c_j = L r,   carry = l_j r,   j = 1..N
//                     the last carry is the mass that leaves
//     exit (rate L):  that mass alone:            s = (s + c_j) l_j / (l_j + L)
//
// All terms are positive: nothing cancels, and equal rates are no special case. That is why f32 is
// enough for it.

import package::math::stream::{StreamState, stream_next};

/// Layers that the state can hold: one for each downward flight.
const STATE_LAYERS: u32 = 48u;

/// The mixture of the module's text.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState.
struct StateDepth {
    /// `l_j`.
    rates: array<f32, STATE_LAYERS>,
    /// `c_j`.
    masses: array<f32, STATE_LAYERS>,
    /// How many are in use, at least 1.
    layers: u32,
}

/// The first collision of a ray that enters at the rate `rate`: `Exp(rate)`, mass 1.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::new.
fn state_new(rate: f32) -> StateDepth {
    var state: StateDepth;
    state.rates[0] = rate;
    state.masses[0] = 1.0;
    state.layers = 1u;
    return state;
}

/// A downward flight to the next collision. Returns `false` where there is no room for it.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::down.
fn state_down(state: ptr<function, StateDepth>, rate: f32) -> bool {
    let layers = (*state).layers;
    if layers >= STATE_LAYERS {
        return false;
    }
    (*state).rates[layers] = rate;
    (*state).masses[layers] = 0.0;
    (*state).layers = layers + 1u;
    return true;
}

/// An upward flight to the next collision, if there is one. Returns the mass that leaves.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::up.
fn state_up(state: ptr<function, StateDepth>, rate: f32) -> f32 {
    let layers = (*state).layers;
    var carry = 0.0;
    for (var j = 0u; j < layers; j++) {
        let l = (*state).rates[j];
        let r = ((*state).masses[j] + carry) / (rate + l);
        (*state).masses[j] = rate * r;
        carry = l * r;
    }
    return carry;
}

/// The mass that an upward flight would lead out.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::exit.
fn state_exit(state: ptr<function, StateDepth>, rate: f32) -> f32 {
    let layers = (*state).layers;
    var leaving = 0.0;
    for (var j = 0u; j < layers; j++) {
        let l = (*state).rates[j];
        leaving = (leaving + (*state).masses[j]) * (l / (l + rate));
    }
    return leaving;
}

/// Scales all masses.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::scale.
fn state_scale(state: ptr<function, StateDepth>, factor: f32) {
    let layers = (*state).layers;
    for (var j = 0u; j < layers; j++) {
        (*state).masses[j] *= factor;
    }
}

/// The mass that has not left.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::mass.
fn state_mass(state: ptr<function, StateDepth>) -> f32 {
    let layers = (*state).layers;
    var sum = 0.0;
    for (var j = 0u; j < layers; j++) {
        sum += (*state).masses[j];
    }
    return sum;
}

/// A depth `tau` of the mixture (its mass taken as 1).
///
/// * `choice`: uniform in `[0, 1)`, chooses the component.
/// * `stream`: one number is taken for each layer of it.
///
/// Twin: specula-bsdf/src/multibounce/state.rs, DepthState::sample_depth.
fn state_sample_depth(
    state: ptr<function, StateDepth>,
    choice: f32,
    stream: ptr<function, StreamState>,
) -> f32 {
    let layers = (*state).layers;
    var left = choice * state_mass(state);
    var depth = 0.0;
    var inside = false;
    for (var j = 0u; j < layers; j++) {
        left -= (*state).masses[j];
        inside = inside || left < 0.0 || j + 1u == layers;
        if inside {
            depth -= log(1.0 - stream_next(stream)) / (*state).rates[j];
        }
    }
    return depth;
}
