// A view in the space of unit roughness, with what every sampler needs of it.

/// `(t, t + z)` of a stretched view `h`, with `t = |h|`; the second is `2 sigma`.
///
///     t + z = (x^2 + y^2) / (t - z)   for z < 0, where nothing cancels
///
/// `x^2 + y^2` has a floor, so that the straight view from below is finite: it sees only facets at the horizon.
///
/// Twin: specula-bsdf/src/vndf/mod.rs, Stretched::new.
fn stretched_lengths(h: vec3f) -> vec2f {
    let radius = max(h.x * h.x + h.y * h.y, 1e-24);
    let length = sqrt(radius + h.z * h.z);
    let long = length + abs(h.z);
    return vec2f(length, select(radius / long, long, h.z >= 0.0));
}
