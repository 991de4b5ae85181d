// Filters over pyramids: means over a point's footprint.
//
// A pyramid is the number of its smaller levels, then the offsets of all levels (texture_raster.wgsl), the picture itself
// first.
//
// Twin of specula-render/src/texture/raster/filter.rs. Departure: as of texture_raster.wgsl.

import tracer::texture_raster::{texture_raster_at, texture_raster_floor, texture_raster_pixel, texture_raster_position};
import tracer::world::{word};

/// Intervals of the squared distance from the middle of an ellipse, each with one weight.
const TEXTURE_FILTER_WEIGHTS: f32 = 256.0;
/// Longer than every footprint in pixels whose square is a number.
const TEXTURE_FILTER_LONGEST: f32 = 1.0e38;

/// How a picture is sampled.
///
/// Twin: specula-render/src/texture/raster.rs, Lookup.
struct TextureLookup {
    /// Offset of the picture.
    picture: u32,
    /// Offset of its pyramid, where it is filtered.
    pyramid: u32,
    /// Along s and t.
    wrap: vec2u,
    /// One of the codes `TEXTURE_FILTER_*`.
    kind: u32,
    /// Whether what the picture itself contributes is left out.
    means_only: bool,
    /// Most times that an ellipse is longer than wide.
    max_anisotropy: f32,
}

/// What a footprint is a sum of: the picture, interpolated, and two levels of its pyramid.
///
/// Drivers compile a copy of the code of pictures for every call: what is summed is told first, so that there is one.
struct TextureMean {
    /// Weights of the picture, the level and the one above it.
    weights: vec3f,
    level: u32,
    /// In pixels of the picture.
    ellipse: TextureEllipse,
}

/// The matrix `[[xx, xy], [xy, yy]]` of an ellipse.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Ellipse.
struct TextureEllipse {
    xx: f32,
    xy: f32,
    yy: f32,
}

/// The value at `(s, t)`; where the picture is filtered, the mean around it over a footprint.
///
/// * `axes`: half axes of the footprint, `(ds, dt)` each.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Raster::filtered.
fn texture_filter_at(lookup: TextureLookup, st: vec2f, axes: vec4f) -> vec3f {
    var mean: TextureMean;
    mean.weights.x = 1.0;
    var last = 0u;
    if lookup.kind >= TEXTURE_FILTER_TRILINEAR && word(lookup.picture) != 0u {
        mean = texture_filter_mean(lookup, axes);
        last = word(lookup.pyramid);
        if lookup.means_only {
            mean.weights.x = 0.0;
            if lookup.kind == TEXTURE_FILTER_TRILINEAR && mean.level == 0u && last > 0u {
                mean.weights.y = 0.0;
            }
        }
    }
    var sum = vec3f(0.0);
    for (var part = 0u; part < 3u; part++) {
        let weight = mean.weights[part];
        if weight <= 0.0 {
            continue;
        }
        var at = lookup.picture;
        var place = st;
        var wrap = lookup.wrap;
        var is_mean = false;
        if part > 0u {
            let level = min(mean.level + part - 1u, last);
            at = word(lookup.pyramid + 1u + level);
            is_mean = level < last && lookup.kind == TEXTURE_FILTER_EWA;
            if level == last {
                // Its only pixel, the mean of the picture.
                place = vec2f(0.5);
                wrap = vec2u(TEXTURE_RASTER_CLAMP);
            }
        }
        if is_mean {
            let within = texture_filter_within(lookup.picture, at, mean.ellipse);
            sum += texture_filter_mean_over(at, place, wrap, within) * weight;
        } else {
            sum += texture_raster_at(at, place, wrap, lookup.kind == TEXTURE_FILTER_NEAREST) * weight;
        }
    }
    return sum;
}

/// What a footprint is a sum of.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Raster::filtered, trilinear and ewa.
fn texture_filter_mean(lookup: TextureLookup, axes: vec4f) -> TextureMean {
    let size = vec2f(f32(word(lookup.picture)), -f32(word(lookup.picture + 1u)));
    let ellipse = texture_filter_ellipse(axes.xy * size, axes.zw * size);
    let trace = ellipse.xx + ellipse.yy;
    if !(trace < TEXTURE_FILTER_LONGEST) {
        return TextureMean(vec3f(0.0, 1.0, 0.0), word(lookup.pyramid), ellipse);
    }
    if trace <= 0.0 {
        return TextureMean(vec3f(1.0, 0.0, 0.0), 0u, ellipse);
    }
    if lookup.kind == TEXTURE_FILTER_TRILINEAR {
        let side = 2.0 * sqrt(max(ellipse.xx, ellipse.yy));
        return texture_filter_between(lookup, ellipse, log2(side), 1.0);
    }
    let squared = texture_filter_squared_axes(ellipse);
    let share = clamp(2.0 * sqrt(squared.x) - 1.0, 0.0, 1.0);
    // No axis is longer than `max_anisotropy` times the other.
    let least = squared.x / (lookup.max_anisotropy * lookup.max_anisotropy);
    let widened = texture_filter_widened(ellipse, squared, least);
    return texture_filter_between(lookup, widened, 0.5 * log2(max(squared.y, least)), share);
}

/// The picture, and linear interpolation between two levels.
///
/// * `level`: with a fraction; what is below 0 is 0.
/// * `share`: of the levels; the rest is the picture's.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Raster::between_levels.
fn texture_filter_between(lookup: TextureLookup, ellipse: TextureEllipse, level: f32, share: f32) -> TextureMean {
    let above = clamp(level, 0.0, f32(word(lookup.pyramid)));
    let whole = floor(above);
    let part = above - whole;
    return TextureMean(vec3f(1.0 - share, (1.0 - part) * share, part * share), u32(whole), ellipse);
}

/// An ellipse by its half axes, in pixels.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Ellipse::new.
fn texture_filter_ellipse(a: vec2f, b: vec2f) -> TextureEllipse {
    return TextureEllipse(a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y);
}

/// Squares of the half axes that are perpendicular, the longer one first.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Ellipse::squared_axes.
fn texture_filter_squared_axes(e: TextureEllipse) -> vec2f {
    let difference = 0.5 * (e.xx - e.yy);
    let long = 0.5 * (e.xx + e.yy) + sqrt(difference * difference + e.xy * e.xy);
    // Not the difference of what was added, which cancels.
    let determinant = e.xx * e.yy - e.xy * e.xy;
    return vec2f(long, clamp(determinant / max(long, 1.0e-37), 0.0, long));
}

/// The ellipse, widened across its longer axis, so that the square of the shorter one is no less than `least`.
///
/// * `squared`: squares of its half axes.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Ellipse::widened.
fn texture_filter_widened(e: TextureEllipse, squared: vec2f, least: f32) -> TextureEllipse {
    if squared.y >= least {
        return e;
    }
    // (long - C) / (long - short) projects on the shorter axis.
    let scale = (least - squared.y) / (squared.x - squared.y);
    return TextureEllipse(
        e.xx + scale * (squared.x - e.xx),
        e.xy - scale * e.xy,
        e.yy + scale * (squared.x - e.yy),
    );
}

/// An ellipse in pixels of a level, wider by the reconstruction of its pixels.
fn texture_filter_within(picture: u32, level: u32, ellipse: TextureEllipse) -> TextureEllipse {
    // A pixel's size is that of the level, which odd sizes round.
    let scale = texture_filter_size(level) / texture_filter_size(picture);
    return TextureEllipse(
        ellipse.xx * (scale.x * scale.x) + 1.0,
        ellipse.xy * (scale.x * scale.y),
        ellipse.yy * (scale.y * scale.y) + 1.0,
    );
}

/// The weighted mean of the pixels with their centres in an ellipse around a point. Its half axes are 1 or longer: some
/// pixel is in it.
///
/// Twin: specula-render/src/texture/raster/filter.rs, Raster::mean_over.
fn texture_filter_mean_over(at: u32, st: vec2f, wrap: vec2u, ellipse: TextureEllipse) -> vec3f {
    let size = vec2i(vec2u(word(at), word(at + 1u)));
    let centre = texture_raster_position(size, st, wrap) - 0.5;
    // Rows: |dy| < sqrt(yy). In one of them dx is around the slope times dy.
    let slope = ellipse.xy / ellipse.yy;
    let across = ellipse.xx - slope * ellipse.xy;
    let reach = sqrt(ellipse.yy);
    let rows = texture_raster_floor(vec2f(centre.y - reach, centre.y + reach));
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var row = rows.x + 1; row <= rows.y; row++) {
        let dy = f32(row) - centre.y;
        let of_row = dy * dy / ellipse.yy;
        let half_width = sqrt(across * max(1.0 - of_row, 0.0));
        let middle = centre.x + slope * dy;
        let columns = texture_raster_floor(vec2f(middle - half_width, middle + half_width));
        for (var column = columns.x + 1; column <= columns.y; column++) {
            let dx = f32(column) - middle;
            let place = floor((of_row + dx * dx / across) * TEXTURE_FILTER_WEIGHTS);
            if place >= TEXTURE_FILTER_WEIGHTS {
                continue;
            }
            let weight = texture_filter_weight((place + 0.5) / TEXTURE_FILTER_WEIGHTS);
            sum += texture_raster_pixel(at, size, vec2i(column, row), wrap) * weight;
            total += weight;
        }
    }
    if total > 0.0 {
        return sum / total;
    }
    // Far away neighbouring columns have the same coordinate.
    return texture_raster_pixel(at, size, texture_raster_floor(centre), wrap);
}

/// The Gaussian weight over the square of the distance from the middle of an ellipse, 1 at its edge, where it is 0.
///
/// Twin: specula-render/src/texture/raster/filter.rs, WEIGHTS.
fn texture_filter_weight(squared: f32) -> f32 {
    return exp(-2.0 * squared) - 0.13533528;
}

/// Width and height of a level.
fn texture_filter_size(at: u32) -> vec2f {
    return vec2f(f32(word(at)), f32(word(at + 1u)));
}
