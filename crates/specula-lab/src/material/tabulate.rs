//! Rough metals as tables of a measured material: synthetic measurements, whose truth is known.

use specula_bsdf::bsdf::{BsdfSample, Lobe};
use specula_bsdf::measured::{MeasuredTables, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport, Vec3};
use specula_render::RenderOptions;
use specula_scene::measured::Merl;
use specula_scene::scene::MaterialKind;

use super::lobes;
use crate::{LabError, Result};

/// A lobe in double precision, as tables ask for it: they are `f32` themselves.
struct Widened(Lobe<f32>);

impl Bsdf<f64> for Widened {
    fn eval(&self, wo: Vec3<f64>, wi: Vec3<f64>, transport: Transport) -> Rgb<f64> {
        self.0.eval(wo.cast(), wi.cast(), transport).cast()
    }

    fn pdf(&self, wo: Vec3<f64>, wi: Vec3<f64>) -> f64 {
        self.0.pdf(wo.cast(), wi.cast()).into()
    }

    fn sample(&self, _: Vec3<f64>, _: [f64; 3], _: Transport) -> Option<BsdfSample<f64>> {
        None
    }

    fn albedo(&self) -> Rgb<f64> {
        Bsdf::<f32>::albedo(&self.0).cast()
    }
}

/// A rough metal that scatters once, and its alphas.
fn rough_metal(kind: &MaterialKind) -> Result<(Widened, [f64; 2])> {
    let alphas = lobes::alphas(kind).filter(|a| a.iter().all(|&a| a > 0.0));
    let (MaterialKind::Conductor { .. }, Some(alphas)) = (kind, alphas) else {
        let message = "expected a rough metal, such as \"conductor Au alpha 0.3\"";
        return Err(LabError::Material(message.into()));
    };
    let options = RenderOptions::default();
    let lobe = lobes::lobe(&mut lobes::bare(), kind, &options)?;
    Ok((Widened(lobe), alphas))
}

/// The tables of a rough metal that scatters once.
///
/// * `kind`: a conductor without textures; anisotropic where its alphas differ, with the symmetry of GGX.
///
/// # Errors
///
/// Where it is another material, or smooth.
pub fn tables(kind: &MaterialKind, size: Resolution) -> Result<MeasuredTables> {
    let (lobe, [x, y]) = rough_metal(kind)?;
    let symmetry = if x == y {
        Symmetry::Isotropic
    } else {
        Symmetry::QuarterTurn
    };
    Ok(tabulate(
        &Ggx::new(Alpha::clamped(x, y)),
        &lobe,
        symmetry,
        size,
    ))
}

/// A rough metal that scatters once as a `.binary` file of MERL's database.
///
/// * `kind`: a conductor without textures whose alphas are equal.
///
/// # Errors
///
/// Where it is another material, smooth, or anisotropic.
pub fn merl(kind: &MaterialKind) -> Result<Vec<u8>> {
    let (lobe, [x, y]) = rough_metal(kind)?;
    if x != y {
        let message = "files of MERL's are isotropic; expected one alpha, or a file .bsdf";
        return Err(LabError::Material(message.into()));
    }
    Ok(Merl::to_bytes(&lobe))
}
