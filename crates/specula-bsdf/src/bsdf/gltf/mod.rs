//! glTF 2.0's metallic-roughness material with its `KHR_materials_*` extensions.

pub(crate) mod albedo;
mod albedo_table;
mod sheen;
mod uncoated;

use super::in_columns::InColumns;
use super::principled::terms::schlick_weight;
use super::{Bsdf, BsdfSample, Transport};
use crate::alpha::Alpha;
use crate::fresnel::{dielectric, refract};
use crate::math::{Frame, Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::{Sampler, VisibleNormals};
use albedo::{LayerAlbedo, LookedUp, PLACES};
use sheen::Sheen;
use uncoated::{BaseShares, COLUMNS, FacetLight, Material, Uncoated};

/// What a [`Gltf`] is made of, by the names of the specification; shares are in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GltfParameters<T> {
    /// `baseColor`.
    pub base_colour: Rgb<T>,
    /// `metallic`.
    pub metallic: T,
    /// `roughness`; alpha is its square.
    pub roughness: T,
    /// `KHR_materials_anisotropy`: `anisotropyStrength`. Its direction is the local x axis: the
    /// renderer turns the frame.
    pub anisotropy: T,
    /// `KHR_materials_ior`; 0 stands for a reflectance of 1.
    pub ior: T,
    /// `KHR_materials_specular`: `specular`.
    pub specular: T,
    /// `KHR_materials_specular`: `specularColor`; may exceed 1.
    pub specular_colour: Rgb<T>,
    /// `KHR_materials_transmission`: `transmission`.
    pub transmission: T,
    /// `KHR_materials_volume`: whether the surface bounds a body, so that light bends.
    pub volume: bool,
    /// Whether it is seen from outside; of account where `volume` is set.
    pub outside: bool,
    /// `KHR_materials_clearcoat`: `clearcoat`.
    pub clearcoat: T,
    /// `KHR_materials_clearcoat`: `clearcoatRoughness`.
    pub clearcoat_roughness: T,
    /// `KHR_materials_sheen`: `sheenColor`.
    pub sheen_colour: Rgb<T>,
    /// `KHR_materials_sheen`: `sheenRoughness`.
    pub sheen_roughness: T,
    /// Whether the metal's facets give back what they lose by scattering once. Not the specification's,
    /// which leaves it open.
    pub compensated: bool,
}

impl<T: Real> Default for GltfParameters<T> {
    /// The specification's defaults.
    fn default() -> Self {
        Self {
            base_colour: Rgb::WHITE,
            metallic: T::ONE,
            roughness: T::ONE,
            anisotropy: T::ZERO,
            ior: T::of(1.5),
            specular: T::ONE,
            specular_colour: Rgb::WHITE,
            transmission: T::ZERO,
            volume: false,
            outside: true,
            clearcoat: T::ZERO,
            clearcoat_roughness: T::ZERO,
            sheen_colour: Rgb::BLACK,
            sheen_roughness: T::ZERO,
            compensated: false,
        }
    }
}

/// glTF 2.0's metallic-roughness material with the extensions ior, specular, anisotropy,
/// transmission, volume (its boundary), sheen and clearcoat, as seen from the geometric side of
/// `wo`.
///
/// ```text
/// metal      = (b + (1 - b) s) G2 D / (4 |wo.z| |wi.z|),        s = (1 - wo.wm)^5,  b = base colour
/// dielectric = w F G2 D / (4 |wo.z| |wi.z|) + (1 - w max F) (b (1 - t) g / pi + b t btdf)
/// F  = f0 + (1 - f0) s,    f0 = min(1, specular_colour ((ior - 1) / (ior + 1))^2),  w = specular
/// f  = (1 - c) (sheen + scale (dielectric (1 - metallic) + metal metallic)) + c G2 D_c / (4 ..)
/// c  = clearcoat (0.04 + 0.96 (1 - |wo.nc|)^5),    nc = the coat's normal
/// scale = min over wo, wi of 1 - max(sheen_colour) E
/// ```
///
/// `G2` is height-correlated; that of `btdf`, a reflection mirrored through the sheet, is
/// separable, as the extension says. The coat is evaluated in the frame of its own normal, which is
/// the local z unless [`Gltf::with_coat_normal`] says otherwise. With `volume`, `btdf` is Walter's refraction, and the Fresnel
/// terms from inside take the refracted cosine.
///
/// `g(wo) g(wi)` is Specula's: the appendix weighs the diffuse base by the Fresnel term at the half
/// vector, with which a smooth white surface reflects up to 1.9 times the light at grazing angles.
/// `g = min(1, (1 - E) / B)`, with the layer's directional albedo `E` and the base's `B`
/// (`albedo` of this module), takes what is too much and nothing else: above 45 degrees of elevation it is over
/// 0.96. So no direction reflects more than it receives (test `gltf_makes_no_light`).
///
/// Where `compensated`, the metal is multiplied by Turquin's factor `1 + b L(wo) / (1 - L(wo))`, with the loss
/// `L` of a white metal (`energy`, as in [`Compensated`](super::Compensated)): a white metal then reflects
/// all light at any roughness.
///
/// Reciprocal where `clearcoat` is 0 and nothing is compensated: the extension weighs the coat by the
/// viewer's angle, Turquin the metal.
///
/// Sampled by a mixture of visible normals of base and coat, the cosine, and for sheen the uniform
/// hemisphere, by the light that each carries from `wo`.
///
/// # Known limitations of the model
///
/// * Alphas below 1e-3 (roughness below 0.03) are taken as 1e-3: a mirror is not a Dirac delta.
/// * Sheen's roughness is at least 0.07: below, its fitted masking reflects more than arrives.
/// * From inside a body there is neither diffuse reflection nor sheen nor clearcoat: what a mixed
///   material (`0 < transmission < 1`) does not transmit is lost.
/// * With a volume of an index within 1e-3 of 1 nothing bends, and transmission is not blurred.
///
/// Source: Khronos, glTF 2.0 specification, appendix B, and the extensions' implementation notes;
/// sheen: Estevez and Kulla 2017.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gltf<T> {
    uncoated: Uncoated<T>,
    /// Normals of transmission: without blur where nothing bends.
    passing: Ggx<T>,
    albedo: LayerAlbedo<T>,
    /// Weight of transmission under the dielectric layer.
    through: T,
    bends: bool,
    /// Index beyond over that on the side of `wo`.
    eta: T,
    clearcoat: T,
    coat: Ggx<T>,
    coat_normal: Vec3<T>,
    sheen: Option<Sheen<T>>,
    /// Whether the metal gives back what its facets lose by scattering once.
    compensated: bool,
}

/// Probabilities of the sampler's parts, and what else depends on the view alone.
#[derive(Clone, Copy)]
struct Shares<T> {
    /// Factor of the metal's reflectance.
    gain: Rgb<T>,
    coat: T,
    sheen: T,
    diffuse: T,
    specular: T,
    transmission: T,
}

impl<T: Real> Gltf<T> {
    /// The material of these parameters; shares outside `[0, 1]` are clamped.
    #[inline]
    pub fn new(parameters: GltfParameters<T>) -> Self {
        let p = parameters;
        let share = |x: T| x.within(T::ZERO, T::ONE);
        let ior = p.ior.within(T::ZERO, T::of(1e3));
        let r = (ior - T::ONE) / (ior + T::ONE);
        let f0 = p.specular_colour.map(|c| share(c * r * r));
        let specular = share(p.specular);
        let bends = p.volume && (ior - T::ONE).abs() >= T::of(1e-3) && ior >= T::of(0.1);
        let inside = p.volume && !p.outside;
        let front = |x: T| T::select(inside, T::ZERO, x);
        let alpha = alpha_of(share(p.roughness));
        let strength = share(p.anisotropy);
        let along = alpha + (T::ONE - alpha) * strength * strength;
        let ggx = Ggx::new(Alpha::clamped(along, alpha));
        let sharp = Ggx::new(Alpha::isotropic(T::of(Alpha::<T>::SPECULAR_BELOW)));
        let metallic = share(p.metallic);
        let transmission = share(p.transmission);
        let sheen = p.sheen_colour.map(|c| front(share(c)));
        Self {
            uncoated: Uncoated {
                base: p.base_colour.map(share),
                ggx,
                f0,
                specular,
                metallic,
                diffuse: front((T::ONE - metallic) * (T::ONE - transmission)),
            },
            passing: if p.volume && !bends { sharp } else { ggx },
            albedo: LayerAlbedo::new(ggx),
            through: (T::ONE - metallic) * transmission,
            bends,
            eta: T::select(inside, T::ONE / ior, ior),
            clearcoat: front(share(p.clearcoat)),
            coat: Ggx::new(Alpha::isotropic(alpha_of(share(p.clearcoat_roughness)))),
            coat_normal: Vec3::Z,
            sheen: (!sheen.is_black()).then(|| Sheen::new(sheen, share(p.sheen_roughness))),
            compensated: p.compensated && metallic > T::ZERO,
        }
    }

    /// The same with a clear coat that has a normal of its own (`clearcoatNormalTexture`).
    ///
    /// * `normal`: unit, local frame.
    #[inline(always)]
    #[must_use]
    pub fn with_coat_normal(self, normal: Vec3<T>) -> Self {
        Self {
            coat_normal: normal,
            ..self
        }
    }

    /// Whether anything passes it; else it only reflects.
    #[inline(always)]
    pub fn transmits(&self) -> bool {
        self.through > T::ZERO
    }

    /// Schlick's weight at a facet, refracted where light leaves the denser body.
    #[inline(always)]
    fn schlick(&self, cos: T) -> T {
        if self.bends && self.eta < T::ONE {
            schlick_weight(dielectric(cos, self.eta).cos_t)
        } else {
            schlick_weight(cos)
        }
    }

    /// The share of the coat, seen from `wo`.
    #[inline(always)]
    fn coat_share(&self, wo: Vec3<T>) -> T {
        let cos = self.coat_normal.dot(wo).abs().at_most(T::ONE);
        self.clearcoat * (T::of(0.04) + T::of(0.96) * schlick_weight(cos))
    }

    /// Factor of the metal's reflectance, seen from `wo`.
    #[inline]
    fn gain(&self, wo: Vec3<T>) -> Rgb<T> {
        if self.compensated {
            let lost = self.albedo.lost(wo);
            self.material().gain(LookedUp { lost, q: T::ZERO })
        } else {
            Rgb::WHITE
        }
    }

    #[inline(always)]
    fn material(&self) -> Material<T> {
        Material {
            of: self.uncoated,
            compensated: self.compensated,
        }
    }

    /// What of the diffuse base is not too much, towards a direction.
    #[inline]
    fn limit(&self, w: Vec3<T>) -> T {
        self.albedo.look_up(w).limit(self.uncoated.ends(), w)
    }

    /// Reflectance of the facets, metal and dielectric, and what the layer leaves to its base.
    ///
    /// * `gain`: factor of the metal's.
    #[inline(always)]
    fn fresnel(&self, cos: T, gain: Rgb<T>) -> FacetLight<T> {
        self.uncoated.fresnel(self.schlick(cos), gain)
    }

    /// Whether it has neither coat nor sheen, and passes nothing.
    #[inline(always)]
    fn is_uncoated(&self) -> bool {
        let is_coated = self.clearcoat > T::ZERO || self.sheen.is_some();
        !is_coated && !self.bends && self.through <= T::ZERO
    }

    #[inline]
    fn shares(&self, wo: Vec3<T>) -> Shares<T> {
        let gain = self.gain(wo);
        let mean = self.fresnel(wo.z.abs(), gain);
        let left = self.uncoated.left_to_base(mean);
        let under = T::ONE - self.coat_share(wo);
        let coat = self.coat_share(wo);
        let sheen = under * self.sheen.map_or(T::ZERO, |sheen| sheen.strength(wo));
        let diffuse = under * left * self.uncoated.diffuse;
        let specular = under * mean.reflectance.max_channel();
        let transmission = under * left * self.through;
        let sum = coat + sheen + diffuse + specular + transmission;
        let scale = T::ONE / sum.at_least(T::TINY);
        Shares {
            gain,
            coat: coat * scale,
            sheen: sheen * scale,
            diffuse: diffuse * scale,
            specular: specular * scale,
            transmission: transmission * scale,
        }
    }

    /// What sheen and coat leave of the base.
    #[inline(always)]
    fn covers(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        let under = T::ONE - self.coat_share(wo);
        under * self.sheen.map_or(T::ONE, |sheen| sheen.left(wo, wi))
    }

    #[inline]
    fn reflection(&self, shares: &Shares<T>, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let wm = (wo + wi).normalize_any();
        // A half vector of zero length is NaN here.
        let facing = wm.z > T::ZERO;
        let (mut f_cos, mut pdf) = if facing {
            self.base_reflection(shares, wo, wi, wm)
        } else {
            (Rgb::BLACK, T::ZERO)
        };
        if self.clearcoat > T::ZERO {
            let coat_share = self.coat_share(wo);
            let frame = Frame::from_normal(self.coat_normal);
            let [wo, wi, wm] = [wo, wi, wm].map(|w| frame.to_local(w));
            if wi.z > T::ZERO && wm.z > T::ZERO {
                let quarter = T::of(0.25) * self.coat.d(wm);
                let shadowed = self.coat.g2_over_cos(Masking::HeightCorrelated, wo, wi);
                f_cos += Rgb::splat(coat_share * quarter * shadowed);
                pdf += shares.coat * quarter / self.coat.reflection_norm(Sampler::Bounded, wo);
            }
        }
        (f_cos, pdf)
    }

    /// Reflection of all but the coat, at facets that are seen.
    #[inline]
    fn base_reflection(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        wm: Vec3<T>,
    ) -> (Rgb<T>, T) {
        let facet = self.fresnel(wo.dot(wm), shares.gain);
        let limit = if self.uncoated.diffuse > T::ZERO {
            self.limit(wo) * self.limit(wi)
        } else {
            T::ONE
        };
        let of_base = BaseShares {
            specular: shares.specular,
            diffuse: shares.diffuse,
        };
        let (mut f_cos, mut pdf) = self.uncoated.at_facet(facet, of_base, limit, [wo, wi, wm]);
        f_cos *= self.covers(wo, wi);
        if let Some(sheen) = self.sheen {
            f_cos += sheen.f_cos(wo, wi, wm) * (T::ONE - self.coat_share(wo));
            pdf += shares.sheen * T::HALF * T::INV_PI;
        }
        (f_cos, pdf)
    }

    #[inline]
    fn transmission(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
    ) -> (Rgb<T>, T) {
        if self.bends {
            return self.refraction(shares, wo, wi, transport);
        }
        let up = vec3(wi.x, wi.y, -wi.z);
        let wm = (wo + up).normalize_any();
        let facing = wm.z > T::ZERO;
        if !facing {
            return (Rgb::BLACK, T::ZERO);
        }
        let FacetLight { left, .. } = self.fresnel(wo.dot(wm), shares.gain);
        let quarter = T::of(0.25) * self.passing.d(wm);
        let shadowed = self.passing.g2_over_cos(Masking::Separable, wo, up);
        let norm = self.passing.reflection_norm(Sampler::Bounded, wo);
        let weight = self.through * left * self.covers(wo, wi);
        (
            self.uncoated.base * (weight * quarter * shadowed),
            shares.transmission * quarter / norm,
        )
    }

    /// Walter's refraction.
    #[inline]
    fn refraction(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
    ) -> (Rgb<T>, T) {
        let generalised = wo + wi * self.eta;
        let wm = (generalised * T::ONE.copysign(generalised.z)).normalize_any();
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        // Facets seen from behind do not scatter; a half vector of zero length is NaN here.
        let lit = cos_o > T::ZERO && cos_i < T::ZERO;
        if !lit {
            return (Rgb::BLACK, T::ZERO);
        }
        let FacetLight { left, .. } = self.fresnel(cos_o, shares.gain);
        let sum = cos_o + self.eta * cos_i;
        let jacobian = self.eta * self.eta * -cos_i / (sum * sum).at_least(T::TINY);
        let visible = self.uncoated.ggx.d(wm) * cos_o * jacobian;
        let shadowed = self
            .uncoated
            .ggx
            .g2_over_cos(Masking::HeightCorrelated, wo, wi);
        let scale = match transport {
            Transport::Radiance => T::ONE / (self.eta * self.eta),
            Transport::Importance => T::ONE,
        };
        let weight = self.through * left * scale * self.covers(wo, wi);
        (
            self.uncoated.base * (weight * visible * shadowed),
            shares.transmission * visible / self.uncoated.ggx.projected_area(wo),
        )
    }

    /// A direction from the coat's facets, in the frame of the base.
    #[inline]
    fn sample_coat(&self, wo: Vec3<T>, direction: [T; 2]) -> Option<Vec3<T>> {
        let frame = Frame::from_normal(self.coat_normal);
        let wo = frame.to_local(wo);
        let wi = self.coat.sample_reflection(Sampler::Bounded, wo, direction);
        (wi.z > T::ZERO).then(|| frame.to_world(wi))
    }

    /// A direction through the surface.
    #[inline]
    fn sample_transmission(&self, wo: Vec3<T>, direction: [T; 2]) -> Option<Vec3<T>> {
        if self.bends {
            let wm = self.uncoated.ggx.sample_wm(wo, direction);
            let cos = wo.dot(wm);
            let bent = dielectric(cos, self.eta);
            let wi = refract(wo, wm, cos, bent.cos_t, self.eta);
            (bent.cos_t > T::ZERO).then_some(wi)
        } else {
            let up = self
                .passing
                .sample_reflection(Sampler::Bounded, wo, direction);
            Some(vec3(up.x, up.y, -up.z))
        }
    }
}

/// The alpha of a roughness, at least what f32 directions resolve.
#[inline(always)]
fn alpha_of<T: Real>(roughness: T) -> T {
    (roughness * roughness).at_least(T::of(Alpha::<T>::SPECULAR_BELOW))
}

impl<T: Real> Bsdf<T> for Gltf<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let shares = self.shares(wo);
        let direction = [u[1], u[2]];
        let transmission = shares.transmission;
        if u[0] < transmission {
            let wi = self.sample_transmission(wo, direction)?;
            let (f_cos, pdf) = self.transmission(&shares, wo, wi, transport);
            let eta = T::select(self.bends, self.eta, T::ONE);
            return BsdfSample::transmitted(wi, f_cos / pdf, pdf, eta);
        }
        let specular = transmission + shares.specular;
        let coat = specular + shares.coat;
        let sheen = coat + shares.sheen;
        let wi = if u[0] < specular {
            self.uncoated
                .ggx
                .sample_reflection(Sampler::Bounded, wo, direction)
        } else if u[0] < coat {
            self.sample_coat(wo, direction)?
        } else if u[0] < sheen {
            uniform_hemisphere(direction)
        } else {
            warp::cosine_hemisphere(direction)
        };
        // Only the coat scatters where the base's facets are seen from behind.
        let from_coat = u[0] >= specular && u[0] < coat;
        if wi.z <= T::ZERO || (!from_coat && wo.z + wi.z <= T::ZERO) {
            return None;
        }
        let (f_cos, pdf) = self.reflection(&shares, wo, wi);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        let shares = self.shares(wo);
        if wi.z > T::ZERO {
            self.reflection(&shares, wo, wi)
        } else if wi.z < T::ZERO && self.through > T::ZERO {
            self.transmission(&shares, wo, wi, transport)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.uncoated.base
    }
}

/// In columns, where it is neither coated nor transmits.
impl<T: Real> InColumns<T, COLUMNS, PLACES, 2> for Gltf<T> {
    #[inline(always)]
    fn columns(&self) -> Option<[T; COLUMNS]> {
        self.is_uncoated().then(|| self.material().columns())
    }

    #[inline(always)]
    fn places(columns: [T; COLUMNS], w: Vec3<T>) -> [T; PLACES] {
        let alpha = Material::of_columns(columns).of.ggx.alpha();
        albedo::places(alpha.x, w)
    }

    /// What is lost, and `q`: nothing where neither counts.
    #[inline(always)]
    fn look_up(&self, places: [T; PLACES], w: Vec3<T>) -> [T; 2] {
        if self.uncoated.diffuse > T::ZERO || self.compensated {
            let LookedUp { lost, q } = self.albedo.look_up_at(places, w);
            [lost, q]
        } else {
            [T::ZERO; 2]
        }
    }

    #[inline(always)]
    fn sample_wi_of(columns: [T; COLUMNS], [lost, q]: [T; 2], wo: Vec3<T>, u: [T; 3]) -> Vec3<T> {
        Material::of_columns(columns).sample_wi(LookedUp { lost, q }, wo, u)
    }

    #[inline(always)]
    fn eval_pdf_of(
        columns: [T; COLUMNS],
        [[lost_o, q_o], [lost_i, q_i]]: [[T; 2]; 2],
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> (Rgb<T>, T) {
        let of_wo = LookedUp {
            lost: lost_o,
            q: q_o,
        };
        let of_wi = LookedUp {
            lost: lost_i,
            q: q_i,
        };
        Material::of_columns(columns).eval_pdf([of_wo, of_wi], wo, wi)
    }
}

/// A direction of the upper hemisphere with density `1 / (2 pi)`.
#[inline(always)]
fn uniform_hemisphere<T: Real>(u: [T; 2]) -> Vec3<T> {
    let w = warp::uniform_sphere(u);
    vec3(w.x, w.y, w.z.abs())
}
