//! Bump maps: heights and normal maps that bend shading normals.

use specula_bsdf::{Frame, Vec3};
use specula_scene::scene::{Bump, BumpRules};

use crate::codes;
use crate::convert::id;
use crate::geometry::{Geometry, Partials, Surface, unit_or};
use crate::slopes::SlopeSpread;
use crate::texture::{TextureCoordinates, Textures, float_parameter};
use crate::words::Words;

/// Step of finite differences in surface coordinates, as in pbrt where it knows no footprint: half
/// a pixel of a picture of 1000.
pub(crate) const STEP: f32 = 0.0005;

/// How light fades towards the horizon of a bent normal, by Mitsuba's rules.
///
/// ```text
/// 2 / (1 + sqrt(1 + a tan^2(n0, wi))),   a = min(tan^2(n0, n) / 8, 1)
/// ```
///
/// with `n0` the normal before it was bent to `n`.
///
/// Source: Conty Estevez, Lecocq and Stein 2019, "A Microfacet-Based Shadowing Function to Solve
/// the Bump Terminator Problem".
#[derive(Clone, Copy, Debug)]
pub(crate) struct Softness {
    /// The normal before it was bent, unit.
    normal: Vec3<f32>,
    a: f32,
}

impl Softness {
    /// The bent normal, turned back where it faces away from `wo` though the unbent one does not
    /// (or the other way round), and how light fades on it.
    ///
    /// * `unbent`, `bent`: unit, on the same side of the surface.
    /// * `fades`: whether it fades at all.
    pub(crate) fn new(
        unbent: Vec3<f32>,
        bent: Vec3<f32>,
        wo: Vec3<f32>,
        fades: bool,
    ) -> (Vec3<f32>, Option<Self>) {
        let along = unbent.dot(bent);
        let bent = if unbent.dot(wo) * bent.dot(wo) <= 0.0 {
            unbent * (2.0 * along) - bent
        } else {
            bent
        };
        let softness = Self {
            normal: unbent,
            a: (0.125 * squared_tangent(along)).min(1.0),
        };
        (bent, fades.then_some(softness))
    }

    /// Factor on what the surface does with light from `wi`, in `(0, 1]`.
    #[inline]
    pub(crate) fn factor(&self, wi: Vec3<f32>) -> f32 {
        let grown = self.a * squared_tangent(self.normal.dot(wi));
        2.0 / (1.0 + (1.0 + grown.min(1e12)).sqrt())
    }
}

/// `tan^2` of the angle with this cosine.
fn squared_tangent(cosine: f32) -> f32 {
    let squared = (cosine * cosine).max(1e-12);
    (1.0 - squared).max(0.0) / squared
}

/// A bent shading normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BumpedFrame {
    pub(crate) normal: Vec3<f32>,
    /// Along u.
    pub(crate) tangent: Vec3<f32>,
    /// How the slopes of what a filter averaged vary about the normal; where normal maps are filtered into roughness.
    pub(crate) spread: Option<SlopeSpread>,
}

/// The shading normal and the tangent along u of a surface under its bump.
///
/// The normal points to the outside of the surface it bends, not necessarily to the side of the
/// geometric one.
pub(crate) fn bend(
    bump: &Bump,
    rules: BumpRules,
    textures: &Textures,
    geometry: &Geometry,
    surface: &Surface,
) -> BumpedFrame {
    let partials = geometry.partials(surface);
    let n = surface.ns;
    // The triangle's plane is not that of its shading normal.
    let mut dp = partials.dp.map(|d| d - n * n.dot(d));
    if dp[0].cross(dp[1]).length_squared() <= 0.0 {
        let frame = Frame::from_normal_tangent(n, surface.tangent);
        dp = [frame.s, frame.t];
    }
    match *bump {
        Bump::Height(height) => {
            let at = |place: &TextureCoordinates| textures.float(height, place);
            let (normal, tangent) = displaced(surface, &Partials { dp, ..partials }, at);
            BumpedFrame {
                normal,
                tangent,
                spread: None,
            }
        }
        Bump::Normal { map, scale } => {
            let place = surface.place();
            let ([x, y, z], moments) = textures.normal(map, &place);
            let s = unit_or(dp[0], n);
            let t = n.cross(s);
            let follows_v = rules == BumpRules::Plain;
            let t = if follows_v && t.dot(dp[1]) < 0.0 {
                -t
            } else {
                t
            };
            let bent = s * (x * scale) + t * (y * scale) + n * z;
            BumpedFrame {
                normal: unit_or(bent, n),
                tangent: dp[0],
                spread: moments.and_then(|m| SlopeSpread::new(&m, scale, [s, t])),
            }
        }
    }
}

/// 4 words for shaders: what it is (nothing, heights, normals), its rules (plain, Mitsuba's, with
/// light that fades), then the parameter of the heights or the normals' texture and factor. Textures of moments follow
/// that of normals that are filtered into roughness.
pub(crate) fn flatten(bump: Option<&Bump>, rules: BumpRules, textures: &Textures, to: &mut Words) {
    let filtered = match bump {
        Some(Bump::Normal { map, .. }) => textures.filtered_normals(*map),
        _ => None,
    };
    to.id(match bump {
        None => codes::BUMP_NONE,
        Some(Bump::Height(_)) => codes::BUMP_HEIGHT,
        Some(Bump::Normal { .. }) if filtered.is_some() => codes::BUMP_FILTERED_NORMAL,
        Some(Bump::Normal { .. }) => codes::BUMP_NORMAL,
    });
    to.id(match rules {
        BumpRules::Plain => codes::BUMP_PLAIN,
        BumpRules::Mitsuba { fades: false } => codes::BUMP_MITSUBA,
        BumpRules::Mitsuba { fades: true } => codes::BUMP_FADES,
    });
    match bump {
        None => to.ids([0; 2]),
        Some(Bump::Height(height)) => float_parameter(to, *height),
        Some(Bump::Normal { map, scale }) => {
            to.id(id(filtered.unwrap_or(*map).0));
            to.number(*scale);
        }
    }
}

/// Step of finite differences along u or v: half of what the footprint covers, as in pbrt, but no less than
/// [`STEP`], below which heights in single precision have no slope.
fn step(place: &TextureCoordinates, axis: usize) -> f32 {
    place.footprint.as_ref().map_or(STEP, |footprint| {
        let [a, b] = footprint.uv;
        STEP.max(0.5 * (a[axis].abs() + b[axis].abs()))
    })
}

/// Normal and tangent of the surface moved along its normal by `height`:
///
/// ```text
/// dp'/du = dp/du + dh/du n + h dn/du,   n' ~ +-(dp'/du x dp'/dv)
/// ```
///
/// Source: Blinn 1978; Pharr, Jakob and Humphreys, 4th edition, 10.5.3. Departure: dp/dv is the
/// surface's own. For meshes with normals pbrt-v4 takes dp/du turned by 90 degrees in its place,
/// which doubles the heights' slope along v where a texture is twice as long that way.
fn displaced(
    surface: &Surface,
    partials: &Partials,
    height: impl Fn(&TextureCoordinates) -> f32,
) -> (Vec3<f32>, Vec3<f32>) {
    let place = surface.place();
    let n = surface.ns;
    let here = height(&place);
    let moved = |axis: usize| {
        let mut there = place;
        let wanted = step(&place, axis);
        there.uv[axis] += wanted;
        there.position += partials.dp[axis] * wanted;
        // The step that rounding left: coordinates of large tiled planes have few digits.
        let step = there.uv[axis] - place.uv[axis];
        let slope = if step > 0.0 {
            (height(&there) - here) / step
        } else {
            0.0
        };
        partials.dp[axis] + n * slope + partials.dn[axis] * here
    };
    let [along_u, along_v] = [moved(0), moved(1)];
    let normal = unit_or(along_u.cross(along_v), n);
    let side = partials.dp[0].cross(partials.dp[1]).dot(n);
    (if side < 0.0 { -normal } else { normal }, along_u)
}
