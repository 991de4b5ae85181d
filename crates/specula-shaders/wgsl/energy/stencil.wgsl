// Four neighbouring knots of a uniform axis, with Lagrange's cubic weights.

/// Where a place lies among the knots of `[0, 1]`.
///
/// The interpolant is continuous and exact at the knots; its error falls with the fourth power of
/// the knots' distance.
///
/// Twin: specula-bsdf/src/energy/stencil.rs, Stencil.
struct StencilWeights {
    /// Index of the first knot.
    first: u32,
    /// Weights of the four knots from the first on.
    weights: vec4f,
}

/// The stencil of `x`, clamped to `[0, 1]`, among `count >= 4` knots.
///
/// Twin: specula-bsdf/src/energy/stencil.rs, Stencil::new.
fn stencil_at(x: f32, count: u32) -> StencilWeights {
    let end = f32(count - 1u);
    let place = clamp(x * end, 0.0, end);
    let first = min(max(floor(place) - 1.0, 0.0), f32(count - 4u));
    let a = place - first;
    let b = a - 1.0;
    let c = a - 2.0;
    let d = a - 3.0;
    let sixth = 1.0 / 6.0;
    let weights = vec4f(-b * c * d * sixth, a * c * d * 0.5, -a * b * d * 0.5, a * b * c * sixth);
    return StencilWeights(u32(first), weights);
}
