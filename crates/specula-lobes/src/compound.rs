//! Lobes of several, out of parameters: coats, layers, plastics, principled, glTF.

use specula_bsdf::bsdf::{
    self, Base, CoatLayer, CoatScattering, GltfParameters, Medium, PrincipledParameters,
};
use specula_bsdf::math::{Real, Rgb};

use crate::given::{Distribution, Given, beckmann, ggx};
use crate::reflectance::Reflectance;
use crate::{Pair, both};

type Made = Result<Pair, String>;

pub(crate) fn coated_diffuse(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta")?;
    let albedo = given.albedo("albedo")?;
    let thickness = given.number("thickness")?;
    let max_depth = given.count("max_depth")?;
    let scattering = match given.word("scattering")? {
        None | Some("lossless") => CoatScattering::Lossless,
        Some("single") => CoatScattering::Single,
        Some(name) => {
            return Err(format!(
                "no such scattering: '{name}' (expected lossless or single)"
            ));
        }
    };
    Ok(both!(T => {
        let layer = CoatLayer {
            thickness: T::of(thickness),
            max_depth,
            scattering,
        };
        bsdf::CoatedDiffuse::<T>::over_layer(alpha.map(ggx), T::of(eta), albedo.cast(), layer)
    }))
}

pub(crate) fn layered(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta")?;
    let base_alpha = given.alpha("base_alpha")?;
    let diffuse = given.colour("albedo")?;
    let metal = Reflectance::given(given)?;
    if diffuse.is_some() == metal.is_some() {
        return Err(
            "expected the base's albedo (diffuse) or its reflectance (metal), one of the two"
                .to_owned(),
        );
    }
    if diffuse.is_some() && base_alpha.is_some() {
        return Err("base_alpha: a diffuse base has none".to_owned());
    }
    let thickness = given.number("thickness")?;
    let scattered = given.albedo("medium_albedo")?;
    let g = given.number("g")?;
    Ok(both!(T => {
        let base = match metal {
            Some(metal) => Base::<T>::metal(base_alpha.map(ggx), metal.cast()),
            None => Base::diffuse(diffuse.unwrap_or(Rgb::BLACK).cast()),
        };
        let medium = Medium {
            thickness: T::of(thickness),
            albedo: scattered.cast(),
            g: T::of(g),
        };
        bsdf::Layered::<T>::new(alpha.map(ggx), T::of(eta), base).with_medium(medium)
    }))
}

pub(crate) fn plastic(given: Given<'_>) -> Made {
    let alpha = given.alpha("alpha")?;
    let eta = given.number("eta")?;
    let diffuse = given.albedo("diffuse")?;
    let specular = given.albedo("specular")?;
    let nonlinear = given.flag("nonlinear")?;
    let smith = given.masking()?;
    let lobe = match (alpha, given.distribution()?) {
        (None, _) => both!(T => {
            bsdf::Plastic::<T>::smooth(T::of(eta), diffuse.cast(), specular.cast(), nonlinear)
        }),
        (Some(alpha), Distribution::Ggx) => both!(T => {
            let (diffuse, specular) = (diffuse.cast(), specular.cast());
            let ndf = ggx::<T>(alpha);
            bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
        }),
        (Some(alpha), Distribution::Beckmann) => both!(T => {
            let (diffuse, specular) = (diffuse.cast(), specular.cast());
            let ndf = beckmann::<T>(alpha);
            bsdf::Plastic::rough(ndf, smith, T::of(eta), diffuse, specular, nonlinear)
        }),
    };
    Ok(lobe)
}

pub(crate) fn principled(given: Given<'_>) -> Made {
    let base = given.albedo("base_color")?;
    let roughness = given.number("roughness")?;
    let anisotropic = given.number("anisotropic")?;
    let metallic = given.number("metallic")?;
    let spec_trans = given.number("spec_trans")?;
    let eta = given.number("eta")?;
    let spec_tint = given.number("spec_tint")?;
    let sheen = given.number("sheen")?;
    let sheen_tint = given.number("sheen_tint")?;
    let clearcoat = given.number("clearcoat")?;
    let clearcoat_gloss = given.number("clearcoat_gloss")?;
    let flatness = given.number("flatness")?;
    let diff_trans = given.number("diff_trans")?;
    let thin = given.flag("thin")?;
    let outside = given.flag("outside")?;
    Ok(both!(T => bsdf::Principled::<T>::new(PrincipledParameters {
        base_colour: base.cast(),
        roughness: T::of(roughness),
        anisotropic: T::of(anisotropic),
        metallic: T::of(metallic),
        spec_trans: T::of(spec_trans),
        eta: T::of(eta),
        spec_tint: T::of(spec_tint),
        sheen: T::of(sheen),
        sheen_tint: T::of(sheen_tint),
        clearcoat: T::of(clearcoat),
        clearcoat_gloss: T::of(clearcoat_gloss),
        flatness: T::of(flatness),
        diff_trans: T::of(diff_trans),
        thin,
        outside,
    })))
}

pub(crate) fn gltf(given: Given<'_>) -> Made {
    let base = given.albedo("base_color")?;
    let metallic = given.number("metallic")?;
    let roughness = given.number("roughness")?;
    let anisotropy = given.number("anisotropy")?;
    let ior = given.number("ior")?;
    let specular = given.number("specular")?;
    let specular_colour = given.albedo("specular_color")?;
    let transmission = given.number("transmission")?;
    let volume = given.flag("volume")?;
    let outside = given.flag("outside")?;
    let clearcoat = given.number("clearcoat")?;
    let clearcoat_roughness = given.number("clearcoat_roughness")?;
    let sheen = given.albedo("sheen_color")?;
    let sheen_roughness = given.number("sheen_roughness")?;
    let compensated = given.flag("compensated")?;
    Ok(both!(T => bsdf::Gltf::<T>::new(GltfParameters {
        base_colour: base.cast(),
        metallic: T::of(metallic),
        roughness: T::of(roughness),
        anisotropy: T::of(anisotropy),
        ior: T::of(ior),
        specular: T::of(specular),
        specular_colour: specular_colour.cast(),
        transmission: T::of(transmission),
        volume,
        outside,
        clearcoat: T::of(clearcoat),
        clearcoat_roughness: T::of(clearcoat_roughness),
        sheen_colour: sheen.cast(),
        sheen_roughness: T::of(sheen_roughness),
        compensated,
    })))
}
