// Densities for multiple importance sampling: close to that of a walk's directions, in closed form.

import package::multibounce::multibounce_interface::{MultibounceInterface, multibounce_interface_phase};
import package::multibounce::normalised::{normalised_pdf};
import package::multibounce::normals::{NormalsModel, normals_d, normals_projected_area};
import package::multibounce::walk::{walk_flight};

/// Visible normals plus a Lambertian term (Heitz et al. 2016). Integrates to more than 1: a weight, not a
/// density. Twin: specula-bsdf/src/multibounce/mis_pdf.rs, MisPdf::Lambert.
const MIS_PDF_LAMBERT: u32 = 0u;
/// Visible normals plus the multiple scattering of an isotropic medium (Cui et al. 2023, eqs. 15 and
/// 16, with `H(mu) = (1 + 2 mu) / (1 + 2 mu sqrt(1 - a))`). Integrates to 0.97 to 1.71: a weight, not a
/// density. Of reflection alone: at a dielectric it is `MIS_PDF_LAMBERT`.
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, MisPdf::Hapke.
const MIS_PDF_HAPKE: u32 = 1u;
/// The density of `normalised_pdf`. Integrates to 1.
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, MisPdf::Normalised.
const MIS_PDF_NORMALISED: u32 = 2u;

/// The density `mis` of a reflected `wi`, in 1/sr; 0 where `wi.z <= 0`, above 0 elsewhere.
///
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, reflection.
fn mis_pdf_reflection(mis: u32, normals: NormalsModel, wo: vec3f, wi: vec3f) -> f32 {
    if wi.z <= 0.0 {
        return 0.0;
    }
    if mis == MIS_PDF_NORMALISED {
        return normalised_pdf(normals, wo, wi);
    }
    let first = mis_pdf_first_facet(normals, wo, wi);
    if mis == MIS_PDF_HAPKE {
        let mean = 0.5 * (normals.alpha.x + normals.alpha.y);
        return first + mis_pdf_hapke(mean, abs(wo.z), wi.z);
    }
    return first + wi.z * 0.31830987;
}

/// Density of directions after the first facet, over the whole sphere: `D(wm) / (4 sigma(wo))`.
///
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, first_facet.
fn mis_pdf_first_facet(normals: NormalsModel, wo: vec3f, wi: vec3f) -> f32 {
    let between = wo + wi;
    let size = length(between);
    if between.z > 0.0 && size > 1e-6 {
        let d = normals_d(normals, between * (1.0 / size));
        return d / (4.0 * normals_projected_area(normals, wo));
    }
    return 0.0;
}

/// Hapke 1981: all but the first scattering in a half space of albedo `a`.
///
///     a / (4 pi) (H(mu_o) H(mu_i) - 1) / (mu_o + mu_i),    H(mu) = (1 + 2 mu) / (1 + 2 mu sqrt(1 - a))
///
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, hapke.
fn mis_pdf_hapke(a: f32, mu_o: f32, mu_i: f32) -> f32 {
    // The released code's cap; at 1 the term alone integrates to 1.6.
    let albedo = min(a, 0.975);
    let root = sqrt(1.0 - albedo);
    let h_o = (1.0 + 2.0 * mu_o) / (1.0 + 2.0 * mu_o * root);
    let h_i = (1.0 + 2.0 * mu_i) / (1.0 + 2.0 * mu_i * root);
    // H(0) = 1: two grazing directions leave 0/0, whose limit is finite.
    let sum = max(mu_o + mu_i, 1e-6);
    let excess = max(h_o * h_i - 1.0, 0.0);
    return albedo * 0.25 * 0.31830987 * excess / sum;
}

/// The share `s` of all but the first flight at a dielectric, in `mis_pdf_interface`.
///
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, lambert_share.
fn mis_pdf_lambert_share(normals: NormalsModel) -> f32 {
    let area = normals.alpha.x * normals.alpha.y;
    let fourth = area * area;
    return max(0.8 * fourth / (fourth + 0.15), 0.002);
}

/// The density `mis` at a dielectric, over the sphere: the walk's first flight, which may leave on either
/// side, and a lobe for the rest.
///
///     normalised:  (1 - s) phase(wo, wi) + s |wi.z| / (2 pi)          integrates to 1
///     Lambert:     phase(wo, wi) + |wi.z| / (2 pi)                    does not
///
/// `MIS_PDF_HAPKE` is defined for metals only; here it is `MIS_PDF_LAMBERT`.
///
/// Twin: specula-bsdf/src/multibounce/mis_pdf.rs, interface.
fn mis_pdf_interface(mis: u32, facets: MultibounceInterface, wo: vec3f, wi: vec3f) -> f32 {
    let flight = walk_flight(facets.normals, -wo);
    let reflected = multibounce_interface_phase(facets, flight, wi, true);
    let first = reflected + multibounce_interface_phase(facets, flight, wi, false);
    let lobe = abs(wi.z) * 0.5 * 0.31830987;
    if mis == MIS_PDF_NORMALISED {
        let s = mis_pdf_lambert_share(facets.normals);
        return (1.0 - s) * first + s * lobe;
    }
    return first + lobe;
}
