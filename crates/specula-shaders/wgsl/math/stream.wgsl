// A stream of random numbers, for lobes whose values are themselves estimates.
//
// SplitMix64 (Steele, Lea and Flood 2014): a 64-bit counter through a strong mix. Departure: WGSL has
// no 64-bit integers, so that the words are pairs `(low, high)`; the values are the same.

/// A small pseudo-random stream. Streams of different seeds are independent for every purpose here; the
/// period is 2^64.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream.
struct StreamState {
    /// The counter, `(low, high)`.
    state: vec2u,
}

/// The stream of a seed.
///
/// * `seed`: `(low, high)`.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::new.
fn stream_new(seed: vec2u) -> StreamState {
    return StreamState(seed);
}

/// The next random number, uniform in `[0, 1)`, in steps of 2^-24.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next.
fn stream_next(stream: ptr<function, StreamState>) -> f32 {
    return f32(stream_next_bits(stream).y >> 8u) * 5.9604644775390625e-8;
}

/// The next 64 bits, `(low, high)`.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next_bits.
fn stream_next_bits(stream: ptr<function, StreamState>) -> vec2u {
    let counter = stream_add((*stream).state, vec2u(0x7f4a7c15u, 0x9e3779b9u));
    (*stream).state = counter;
    let first = stream_multiply(stream_fold(counter, 30u), vec2u(0x1ce4e5b9u, 0xbf58476du));
    let second = stream_multiply(stream_fold(first, 27u), vec2u(0x133111ebu, 0x94d049bbu));
    return stream_fold(second, 31u);
}

/// `a + b` modulo 2^64.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next_bits, `wrapping_add`.
fn stream_add(a: vec2u, b: vec2u) -> vec2u {
    let low = a.x + b.x;
    return vec2u(low, a.y + b.y + select(0u, 1u, low < a.x));
}

/// `a b` modulo 2^64, from products of 16 bits.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next_bits, `wrapping_mul`.
fn stream_multiply(a: vec2u, b: vec2u) -> vec2u {
    let a_low = a.x & 0xffffu;
    let a_high = a.x >> 16u;
    let b_low = b.x & 0xffffu;
    let b_high = b.x >> 16u;
    let crossed = a_high * b_low + ((a_low * b_low) >> 16u);
    let middle = (crossed & 0xffffu) + a_low * b_high;
    let carried = a_high * b_high + (crossed >> 16u) + (middle >> 16u);
    return vec2u(a.x * b.x, carried + a.x * b.y + a.y * b.x);
}

/// `a ^ (a >> shift)`.
///
/// * `shift`: 1 to 31.
///
/// Twin: specula-bsdf/src/math/stream.rs, Stream::next_bits.
fn stream_fold(a: vec2u, shift: u32) -> vec2u {
    return a ^ vec2u((a.x >> shift) | (a.y << (32u - shift)), a.y >> shift);
}
