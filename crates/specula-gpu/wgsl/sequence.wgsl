// Random numbers of samples: Owen-scrambled Sobol sequences, one per pixel and set of four dimensions (Burley 2020),
// and hashes.
//
// Twin of specula-render/src/sampler.rs, bit for bit; its table of sets holds here too.

import tracer::world::{word};

/// The random numbers of one sample of one pixel.
struct Sequence {
    /// The sample within its block in the lower half, the place of the pixel within its block above.
    index: u32,
    /// Of the block of pixels and of samples.
    seed: u32,
}

/// A bijective mix of 32 bits (Wellons 2018, `lowbias32`).
///
/// Twin: specula-render/src/sampler.rs, hash.
fn sequence_hash(bits: u32) -> u32 {
    var x = bits + 0x9e3779b9u;
    x = x ^ (x >> 16u);
    x = x * 0x7feb352du;
    x = x ^ (x >> 15u);
    x = x * 0x846ca68bu;
    return x ^ (x >> 16u);
}

/// The random numbers of sample `number` of a pixel.
///
/// Twin: specula-render/src/sampler.rs, Sampler::new.
fn sequence_of(pixel: vec2u, number: u32, seed: u32) -> Sequence {
    let block = pixel >> vec2u(4u);
    let mixed = sequence_hash(block.y ^ sequence_hash(seed ^ sequence_hash(number >> 16u)));
    let index = sequence_place(pixel) | (number & 0xffffu);
    return Sequence(index, sequence_hash(block.x ^ mixed));
}

/// The index of the sample within its block of 2^16.
///
/// Twin: specula-render/src/sampler.rs, Sampler::index.
fn sequence_index(s: Sequence) -> u32 {
    return s.index & 0xffffu;
}

/// The place of a pixel within its block of 16 x 16: bits of `x` and `y` in turn, from bit 31 down.
///
/// Twin: specula-render/src/sampler/pixel_blocks.rs, place.
fn sequence_place(pixel: vec2u) -> u32 {
    var place = 0u;
    for (var level = 0u; level < 4u; level += 1u) {
        place |= ((pixel.x >> level) & 1u) << (31u - 2u * level);
        place |= ((pixel.y >> level) & 1u) << (30u - 2u * level);
    }
    return place;
}

/// The mix of the crate `sobol_burley`.
fn sequence_mix(bits: u32) -> u32 {
    var n = bits ^ 0xe6fe3bebu;
    n = n ^ (n >> 16u);
    n = n * 0x7feb352du;
    n = n ^ (n >> 15u);
    n = n * 0x846ca68bu;
    return n ^ (n >> 16u);
}

/// Owen scrambling of reversed bits (Burley 2020, with the constants of the crate `sobol_burley`).
fn sequence_scramble(reversed: u32, key: u32) -> u32 {
    var n = reversed;
    n = n ^ (n * 0x3d20adeau);
    n = n + key;
    n = n * ((key >> 16u) | 1u);
    n = n ^ (n * 0x05526c56u);
    return n ^ (n * 0x53a22864u);
}

/// Where the shift of a pixel is in its table: its place within its block after a shuffle.
///
/// Twin: specula-render/src/sampler/pixel_blocks.rs, shuffled.
fn sequence_shuffled(place: u32, key: u32) -> u32 {
    let power = ((key >> 16u) * 3u) >> 16u;
    return (power << 8u) | (sequence_scramble(place, sequence_mix(key ^ 0x2c1b3c6du)) >> 24u);
}

/// The shuffled index, bits reversed, for the sets that are stratified together with the camera's.
///
/// Twin: specula-render/src/sampler.rs, turned.
fn sequence_turned(rest: u32) -> u32 {
    var bits = 0u;
    for (var bit = 0u; bit < 16u; bit += 1u) {
        if ((rest << bit) & 0x80000000u) != 0u {
            bits = bits ^ word(SEQUENCE_TURN + bit);
        }
    }
    return bits;
}

/// Four random numbers in `[0, 1)`.
///
/// Twin: specula-render/src/sampler.rs, Sampler::set.
fn sequence_set(s: Sequence, purpose: u32) -> vec4f {
    let seed = sequence_hash(s.seed + purpose * 0x9e3779b9u);
    // The sets of the first vertex are stratified together with the camera's.
    let together = purpose == 1u || purpose == 2u;
    let shuffle = select(seed, sequence_hash(s.seed), together);
    var rest = sequence_scramble(reverseBits(sequence_index(s)), sequence_mix(shuffle ^ 0x79c68e4au));
    if together {
        rest = sequence_turned(rest);
    }
    var bits = vec4u(0u);
    var at = SOBOL_COLUMNS;
    for (var bit = 0u; bit < 16u; bit += 1u) {
        if ((rest << bit) & 0x80000000u) != 0u {
            bits = bits ^ vec4u(word(at), word(at + 1u), word(at + 2u), word(at + 3u));
        }
        at += 4u;
    }
    // What tells the pixels of a block apart.
    let place = s.index & 0xffff0000u;
    let shift = word(SEQUENCE_SHIFTS + sequence_shuffled(place, seed));
    bits = bits ^ vec4u(0u, shift & 0xffffu, shift >> 16u, 0u);
    let of_block = seed * 0x9c8f2d3bu;
    let of_pixel = (seed ^ place) * 0x9c8f2d3bu;
    let keys = vec4u(of_pixel, of_block, of_block, of_pixel) ^ vec4u(0x691e72cau, 0x912f69bau, 0x174f18abu, 0xb40cc1b8u);
    let scrambled = vec4u(
        sequence_scramble(bits.x, sequence_mix(keys.x)),
        sequence_scramble(bits.y, sequence_mix(keys.y)),
        sequence_scramble(bits.z, sequence_mix(keys.z)),
        sequence_scramble(bits.w, sequence_mix(keys.w)),
    );
    return bitcast<vec4f>((reverseBits(scrambled) >> vec4u(9u)) | vec4u(0x3f800000u)) - 1.0;
}

/// Random numbers for the camera: the second and third for the filter, the first and last for the lens.
fn sequence_camera(s: Sequence) -> vec4f {
    return sequence_set(s, 0u);
}

/// Random numbers for scattering: three for the lobe, one for Russian roulette.
fn sequence_scatter(s: Sequence, depth: u32) -> vec4f {
    return sequence_set(s, 1u + 2u * depth);
}

/// Random numbers for a light: one for its choice, two for the point on it, one for finer digits of the choice.
fn sequence_light(s: Sequence, depth: u32) -> vec4f {
    return sequence_set(s, 2u + 2u * depth);
}

/// A random number in `[0, 1)`, by a hash of the sample and `key`.
///
/// Twin: specula-render/src/sampler.rs, Sampler::hashed.
fn sequence_hashed(s: Sequence, key: vec3u) -> f32 {
    let inner = sequence_hash(key.x ^ sequence_hash(key.y ^ sequence_hash(key.z)));
    let bits = sequence_hash(s.seed ^ sequence_hash(s.index ^ inner));
    return f32(bits >> 8u) * (1.0 / 16777216.0);
}

/// The state of an endless stream of random numbers, for lobes whose values are estimates: low word, high word.
///
/// Twin: specula-render/src/sampler.rs, Sampler::stream.
fn sequence_stream(s: Sequence, depth: u32, purpose: u32) -> vec2u {
    let low = sequence_hash(s.seed ^ sequence_hash(depth ^ sequence_hash(purpose)));
    return vec2u(low, sequence_hash(low ^ sequence_hash(s.index)));
}
