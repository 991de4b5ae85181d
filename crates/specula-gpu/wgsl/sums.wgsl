// Sums of the samples of each run, exact: one thread a run.
//
// Every value is a whole number of units, and integers are added in words: nothing depends on the
// order, on how samples are cut into runs, or on how a compiler treats f32. Bits below the unit are left out: of
// values that the largest of the run exceeds by 2^96 and more, and of squares that it exceeds by 2^72. A film's sums
// do not have these bits.
//
// Layout: specula-render/src/film/run.rs, RunSums.

/// As of `path_requests` in path.wgsl.
@group(0) @binding(0) var<storage, read> sums_requests: array<vec4u>;
/// As of `path_results` there, as bits.
@group(0) @binding(1) var<storage, read> sums_results: array<vec4u>;
/// Sums: eleven vectors a run.
@group(0) @binding(2) var<storage, read_write> sums_of_runs: array<vec4u>;

/// Where runs begin in `sums_requests`.
const SUMS_FIRST_RUN: u32 = 2u;
/// Vectors of a run's sums.
const SUMS_SIZE: u32 = 11u;
/// How far the largest value is shifted in its sum: room is left for its 24 bits, for 64 samples, and for the sign.
const SUMS_VALUE_SHIFT: u32 = 96u;
/// The same of squares, which have 48 bits.
const SUMS_SQUARE_SHIFT: u32 = 72u;

/// The biased exponent of a float, 1 for subnormal ones; 255: it is not finite.
fn sums_exponent(bits: u32) -> u32 {
    return max((bits >> 23u) & 0xffu, 1u);
}

/// The significand of a float, in units of `2^(exponent - 150)`.
fn sums_digits(bits: u32) -> u32 {
    let is_normal = ((bits >> 23u) & 0xffu) != 0u;
    return (bits & 0x7fffffu) | select(0u, 0x800000u, is_normal);
}

/// The square of 24 bits: low word, high word.
fn sums_square(digits: u32) -> vec2u {
    let upper = digits >> 12u;
    let lower = digits & 0xfffu;
    let middle = 2u * upper * lower;
    let begin = lower * lower;
    let next = begin + (middle << 12u);
    let low = next + ((upper * upper) << 24u);
    let carries = select(0u, 1u, next < begin) + select(0u, 1u, low < next);
    return vec2u(low, ((upper * upper) >> 8u) + (middle >> 20u) + carries);
}

/// 64 bits, moved down by fewer than 64 places.
fn sums_down(x: vec2u, places: u32) -> vec2u {
    let moved = select(x, vec2u(x.y, 0u), places >= 32u);
    let rest = places & 31u;
    if rest == 0u {
        return moved;
    }
    return vec2u((moved.x >> rest) | (moved.y << (32u - rest)), moved.y >> rest);
}

/// 64 bits as 128, moved up by fewer than 128 places.
fn sums_up(x: vec2u, places: u32) -> vec4u {
    let rest = places & 31u;
    var three = vec3u(x, 0u);
    if rest != 0u {
        let down = 32u - rest;
        three = vec3u(x.x << rest, (x.y << rest) | (x.x >> down), x.y >> down);
    }
    switch places >> 5u {
        case 0u: { return vec4u(three, 0u); }
        case 1u: { return vec4u(0u, three); }
        case 2u: { return vec4u(0u, 0u, three.xy); }
        default: { return vec4u(0u, 0u, 0u, three.x); }
    }
}

/// The sum of two integers of 128 bits, the lowest word first.
fn sums_plus(a: vec4u, b: vec4u) -> vec4u {
    var sum = a + b;
    // A word that a carry overflows is 0 afterwards, and did not overflow before.
    var carry = select(0u, 1u, sum.x < a.x);
    for (var i = 1u; i < 4u; i += 1u) {
        let overflows = sum[i] < a[i];
        sum[i] += carry;
        carry = select(0u, 1u, overflows || sum[i] < carry);
    }
    return sum;
}

/// Adds an integer, shifted up or, where `places` is negative, down; subtracts it where `negative`.
fn sums_add(sum: vec4u, x: vec2u, places: i32, negative: bool) -> vec4u {
    var term = vec4u(0u);
    if places >= 0 {
        term = sums_up(x, u32(places));
    } else if places > -64 {
        term = vec4u(sums_down(x, u32(-places)), 0u, 0u);
    }
    if negative {
        term = sums_plus(~term, vec4u(1u, 0u, 0u, 0u));
    }
    return sums_plus(sum, term);
}

/// Adds a float in units of `2^-30`, rounded, halves away from 0: low word, high word of the sum. NaN counts as 0,
/// and values beyond `2^8` count as that.
fn sums_add_fixed(sum: vec2u, bits: u32) -> vec2u {
    let exponent = sums_exponent(bits);
    let digits = sums_digits(bits);
    if exponent == 255u && digits != 0x800000u {
        return sum;
    }
    var units = vec2u(0u, 1u << 6u);
    if exponent < 120u {
        let places = 120u - exponent;
        // Beyond 24 places less than a half is left.
        units = vec2u(0u);
        if places <= 24u {
            units.x = (digits + (1u << (places - 1u))) >> places;
        }
    } else if exponent < 135u {
        units = sums_up(vec2u(digits, 0u), exponent - 120u).xy;
    }
    if (bits >> 31u) != 0u {
        units = vec2u(~units.x + 1u, ~units.y + select(0u, 1u, units.x == 0u));
    }
    let low = sum.x + units.x;
    return vec2u(low, sum.y + units.y + select(0u, 1u, low < sum.x));
}

/// Whether a sample's picture values are finite.
fn sums_is_finite(value: vec4u) -> bool {
    return all((value.xyz & vec3u(0x7f800000u)) != vec3u(0x7f800000u));
}

/// Whether a surface was met, at a distance that is a number.
fn sums_has_depth(value: vec4u) -> bool {
    return (value.w >> 31u) == 0u && sums_exponent(value.w) != 255u;
}

/// The largest exponents of a run: of picture values, of depths.
fn sums_scales(begin: u32, count: u32) -> vec2u {
    var scales = vec2u(1u);
    for (var i = 0u; i < count; i += 1u) {
        let value = sums_results[begin + 3u * i];
        if !sums_is_finite(value) {
            continue;
        }
        let largest = max(sums_exponent(value.x), max(sums_exponent(value.y), sums_exponent(value.z)));
        scales.x = max(scales.x, largest);
        if sums_has_depth(value) {
            scales.y = max(scales.y, sums_exponent(value.w));
        }
    }
    return scales;
}

/// Adds the samples of one run.
@compute @workgroup_size(64)
fn sums_main(@builtin(global_invocation_id) id: vec3u) {
    let run = id.x;
    if run >= sums_requests[0].y {
        return;
    }
    let count = sums_requests[run + SUMS_FIRST_RUN].w;
    let begin = 3u * run * sums_requests[0].x;
    let scales = sums_scales(begin, count);
    var colour: array<vec4u, 3>;
    var squares: array<vec4u, 3>;
    var albedo: array<vec2u, 3>;
    var normal: array<vec2u, 3>;
    var depth = vec4u(0u);
    var hits = 0u;
    var rays = 0u;
    var invalid = vec2u(0u);
    for (var i = 0u; i < count; i += 1u) {
        let value = sums_results[begin + 3u * i];
        let first = sums_results[begin + 3u * i + 1u];
        let second = sums_results[begin + 3u * i + 2u];
        rays += u32(bitcast<f32>(first.w));
        if !sums_is_finite(value) {
            invalid |= select(vec2u(0u, 1u << (i & 31u)), vec2u(1u << (i & 31u), 0u), i < 32u);
            continue;
        }
        for (var k = 0u; k < 3u; k += 1u) {
            let digits = sums_digits(value[k]);
            let below = i32(scales.x) - i32(sums_exponent(value[k]));
            let negative = (value[k] >> 31u) != 0u;
            colour[k] = sums_add(
                colour[k], vec2u(digits, 0u), i32(SUMS_VALUE_SHIFT) - below, negative);
            squares[k] = sums_add(
                squares[k], sums_square(digits), i32(SUMS_SQUARE_SHIFT) - 2 * below, false);
            albedo[k] = sums_add_fixed(albedo[k], first[k]);
            normal[k] = sums_add_fixed(normal[k], second[k]);
        }
        if sums_has_depth(value) {
            let below = i32(scales.y) - i32(sums_exponent(value.w));
            let places = i32(SUMS_VALUE_SHIFT) - below;
            depth = sums_add(depth, vec2u(sums_digits(value.w), 0u), places, false);
            hits += 1u;
        }
    }
    let at = SUMS_SIZE * run;
    for (var k = 0u; k < 3u; k += 1u) {
        sums_of_runs[at + k] = colour[k];
        sums_of_runs[at + 3u + k] = squares[k];
    }
    sums_of_runs[at + 6u] = depth;
    sums_of_runs[at + 7u] = vec4u(albedo[0], albedo[1]);
    sums_of_runs[at + 8u] = vec4u(albedo[2], normal[0]);
    sums_of_runs[at + 9u] = vec4u(normal[1], normal[2]);
    sums_of_runs[at + 10u] = vec4u(scales.x | (scales.y << 8u) | (hits << 16u), rays, invalid);
}
