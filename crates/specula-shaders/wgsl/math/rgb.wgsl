// Colours: linear RGB (sRGB primaries, D65 white), unbounded, as `vec3f`.

/// Relative luminance, Rec. 709 weights.
///
/// Twin: specula-bsdf/src/math/rgb.rs, Rgb::luminance.
fn rgb_luminance(colour: vec3f) -> f32 {
    return dot(colour, vec3f(0.2126, 0.7152, 0.0722));
}

/// Arithmetic mean of the channels.
///
/// Twin: specula-bsdf/src/math/rgb.rs, Rgb::mean.
fn rgb_mean(colour: vec3f) -> f32 {
    return (colour.r + colour.g + colour.b) * 0.33333334;
}

/// The largest channel.
///
/// Twin: specula-bsdf/src/math/rgb.rs, Rgb::max_channel.
fn rgb_max_channel(colour: vec3f) -> f32 {
    return max(max(colour.r, colour.g), colour.b);
}

/// Whether every channel is exactly zero.
///
/// Twin: specula-bsdf/src/math/rgb.rs, Rgb::is_black.
fn rgb_is_black(colour: vec3f) -> bool {
    return colour.r == 0.0 && colour.g == 0.0 && colour.b == 0.0;
}
