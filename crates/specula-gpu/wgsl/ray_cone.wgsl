// Ray cones: how wide what a path stands for is, for filtered textures. A cone is its radius at the ray's origin, and its
// spread, by which the radius grows with the distance.
//
// Twin of specula-render/src/ray_cone.rs.

/// Largest spread: a cone of 45 degrees around its axis.
const RAY_CONE_MOST_SPREAD: f32 = 1.0;
/// Least share of a pixel's area, or of a lobe, that a path stands for.
const RAY_CONE_LEAST_SHARE: f32 = 0.015625;

/// The cone of a path that stands for a share of what this one covers.
///
/// * `index`: of the pixel's sample, from 0 on.
///
/// Twin: specula-render/src/ray_cone.rs, RayCone::of_sample.
fn ray_cone_of_sample(cone: vec2f, index: u32) -> vec2f {
    return cone * sqrt(ray_cone_share(index));
}

/// The cone at a distance; behind its focus it widens.
///
/// Twin: specula-render/src/ray_cone.rs, RayCone::at.
fn ray_cone_at(cone: vec2f, distance: f32) -> vec2f {
    let there = vec2f(cone.x + cone.y * distance, cone.y);
    return select(there, -there, there.x < 0.0);
}

/// The cone after a perfect mirror.
///
/// * `mean_curvature`: above 0 where the surface is convex seen from where the path came.
///
/// Twin: specula-render/src/ray_cone.rs, RayCone::after.
fn ray_cone_mirrored(cone: vec2f, mean_curvature: f32) -> vec2f {
    return ray_cone_bounded(cone.x, cone.y + 2.0 * mean_curvature * cone.x);
}

/// The cone after a perfectly smooth interface.
///
/// * `mean_curvature`: as of `ray_cone_mirrored`.
/// * `eta`: index beyond it over the index before it.
///
/// Twin: specula-render/src/ray_cone.rs, RayCone::after.
fn ray_cone_refracted(cone: vec2f, mean_curvature: f32, eta: f32) -> vec2f {
    if eta == 1.0 {
        return ray_cone_bounded(cone.x, cone.y);
    }
    let inverse = 1.0 / eta;
    return ray_cone_bounded(cone.x, cone.y * inverse - mean_curvature * cone.x * (1.0 - inverse));
}

/// The cone after a lobe that is not perfectly smooth.
///
/// * `pdf`: density of the sampled direction in 1/sr.
/// * `index`: as of `ray_cone_of_sample`.
///
/// Twin: specula-render/src/ray_cone.rs, RayCone::after.
fn ray_cone_scattered(cone: vec2f, pdf: f32, index: u32) -> vec2f {
    let of_lobe = sqrt(ray_cone_share(index) / (3.1415927 * max(pdf, 1.1754944e-38)));
    return ray_cone_bounded(cone.x, max(abs(cone.y), of_lobe));
}

/// A cone of at most the largest spread.
fn ray_cone_bounded(radius: f32, spread: f32) -> vec2f {
    return vec2f(radius, clamp(spread, -RAY_CONE_MOST_SPREAD, RAY_CONE_MOST_SPREAD));
}

/// What a sample stands for, of all that a pixel covers.
///
/// Twin: specula-render/src/ray_cone.rs, share.
fn ray_cone_share(index: u32) -> f32 {
    return max(1.0 / (f32(index) + 1.0), RAY_CONE_LEAST_SHARE);
}
