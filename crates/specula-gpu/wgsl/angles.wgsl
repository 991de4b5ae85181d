// Sines of angles and angles of points, as polynomials without branches.
//
// The coefficients are Chebyshev fits in the square of the argument, computed in 40 digits. WGSL's own
// functions have errors of up to 2^-11 (sin, cos) and 4096 ulps (atan2, acos): too large for samples that should be
// those of the CPU.

/// `size` with the sign of another number, that of zero included: `f32::copysign`.
fn angles_with_sign(size: f32, signed: f32) -> f32 {
    return bitcast<f32>((bitcast<u32>(size) & 0x7fffffffu) | (bitcast<u32>(signed) & 0x80000000u));
}

/// `sin(pi t)` for `t` in `[-1/2, 1/2]`; relative error at most 3e-7.
/// Twin: specula-render/src/light/angles.rs, sine.
fn angles_sine(t: f32) -> f32 {
    let x = t * t;
    var sum = 0.07765591;
    sum = sum * x - 0.5982904;
    sum = sum * x + 2.5500774;
    sum = sum * x - 5.16771;
    sum = sum * x + 3.1415927;
    return t * sum;
}

/// `(sin(pi v), cos(pi v))` for `v` in `[0, 1]`; relative error of the sine at most 3e-7.
/// Twin: specula-render/src/light/angles.rs, sin_cos_half_turns.
fn angles_sin_cos_half_turns(v: f32) -> vec2f {
    return vec2f(angles_sine(min(v, 1.0 - v)), angles_sine(0.5 - v));
}

/// `(sin(2 pi u), cos(2 pi u))` for `u` in `[0, 1]`; absolute error at most 3e-7.
/// Twin: specula-render/src/light/angles.rs, sin_cos_turns.
fn angles_sin_cos_turns(u: f32) -> vec2f {
    // Half a turn away both change their signs.
    return -angles_sin_cos_of_half(u - 0.5);
}

/// The same for `u` in `[-1/2, 1/2]`.
/// Twin: specula-render/src/light/angles.rs, sin_cos_of_half.
fn angles_sin_cos_of_half(u: f32) -> vec2f {
    let size = abs(u);
    let folded = select(u, angles_with_sign(0.5 - size, u), size > 0.25);
    return vec2f(angles_sine(2.0 * folded), angles_sine(0.5 - 2.0 * size));
}

/// The angle of the point `(x, y)` in turns, in `[-1/2, 1/2]`; 0 at the origin. Absolute error at most
/// 1e-7.
/// Twin: specula-render/src/light/angles.rs, turns.
fn angles_turns(y: f32, x: f32) -> f32 {
    let size = abs(vec2f(x, y));
    let steep = size.y > size.x;
    let high = max(size.x, size.y);
    var t = 0.0;
    if high > 0.0 {
        t = min(size.x, size.y) / high;
    }
    let z = t * t;
    var sum = 0.0004402677;
    sum = sum * z - 0.002503706;
    sum = sum * z + 0.006706411;
    sum = sum * z - 0.011867953;
    sum = sum * z + 0.016899662;
    sum = sum * z - 0.022596497;
    sum = sum * z + 0.03181805;
    sum = sum * z - 0.053051176;
    sum = sum * z + 0.15915494;
    let eighth = t * sum;
    let quarter = select(eighth, 0.25 - eighth, steep);
    return angles_with_sign(select(quarter, 0.5 - quarter, x < 0.0), y);
}
