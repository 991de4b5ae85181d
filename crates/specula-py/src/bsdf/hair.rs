//! The class of hair.

use pyo3::prelude::*;
use specula_bsdf::hair::{self, HairParameters, absorption_of_colour, absorption_of_melanin};
use specula_bsdf::math::{Real, Rgb};

use super::Bsdf;
use super::lobes::{repr, rgb};
use crate::parameters::{Colour, in_range, invalid};

const ROUGHNESS: [f64; 2] = [0.01, 1.0];
const ANY: [f64; 2] = [0.0, f64::MAX];

/// Hair and fur: a dielectric cylinder with rough, tilted scales that absorbs inside.
///
/// Source: Chiang et al. 2016, in the form of pbrt-v4. The fibre runs along the local x, from its root
/// to its tip; z is the normal of its cylinder. Directions are those of the whole sphere. ``eval``
/// returns the scattering function, as a fibre has no cosine of its own.
///
/// Parameters
/// ----------
/// sigma_a : float or (3,), optional
///     Absorption within the fibre, per its radius.
/// eta
///     Index of refraction of the fibre over that around it, in [0.1, 10].
/// beta_m, beta_n
///     Longitudinal and azimuthal roughness, in [0.01, 1].
/// alpha_deg
///     Tilt of the scales towards the root, in degrees, in [-90, 90].
/// colour : float or (3,), optional
///     In [0, 1]: what many such fibres look like together. In place of ``sigma_a``.
/// eumelanin, pheomelanin : optional
///     Concentrations of the two pigments: in place of ``sigma_a``. Of hair without any of these
///     parameters eumelanin is 1.3: brown.
/// h : optional
///     Offset of the view across the fibre, over its radius, in [-1, 1], towards the local y: for flat
///     ribbons. By default it follows from the normal.
///
/// Raises
/// ------
/// ValueError
///     If a parameter is out of its range, or the absorption is given twice.
#[pyclass(extends = Bsdf, frozen, module = "specula_render")]
pub(crate) struct Hair;

#[pymethods]
impl Hair {
    #[new]
    #[pyo3(signature = (
        sigma_a = None,
        *,
        eta = 1.55,
        beta_m = 0.3,
        beta_n = 0.3,
        alpha_deg = 2.0,
        colour = None,
        eumelanin = None,
        pheomelanin = None,
        h = None,
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        sigma_a: Option<Colour>,
        eta: f64,
        beta_m: f64,
        beta_n: f64,
        alpha_deg: f64,
        colour: Option<Colour>,
        eumelanin: Option<f64>,
        pheomelanin: Option<f64>,
        h: Option<f64>,
    ) -> PyResult<PyClassInitializer<Self>> {
        let beta_m = in_range("beta_m", beta_m, ROUGHNESS)?;
        let beta_n = in_range("beta_n", beta_n, ROUGHNESS)?;
        let parameters = HairParameters {
            sigma_a: absorption(sigma_a, (colour, beta_n), [eumelanin, pheomelanin])?,
            eta: in_range("eta", eta, [0.1, 10.0])?,
            beta_m,
            beta_n,
            alpha_deg: in_range("alpha_deg", alpha_deg, [-90.0, 90.0])?,
        };
        let h = h.map(|h| in_range("h", h, [-1.0, 1.0])).transpose()?;
        let mut parts = vec![
            rgb(parameters.sigma_a),
            format!("eta={eta}"),
            format!("beta_m={beta_m}"),
            format!("beta_n={beta_n}"),
            format!("alpha_deg={alpha_deg}"),
        ];
        parts.extend(h.map(|h| format!("h={h}")));
        let bsdf = Bsdf::new(
            fibre::<f32>(&parameters, h),
            fibre::<f64>(&parameters, h),
            repr("Hair", &parts),
        );
        Ok(bsdf.derived(Self))
    }
}

/// The absorption, given in one of three ways, or that of brown hair.
fn absorption(
    sigma_a: Option<Colour>,
    (colour, beta_n): (Option<Colour>, f64),
    melanin: [Option<f64>; 2],
) -> PyResult<Rgb<f64>> {
    let has_melanin = melanin.iter().any(Option::is_some);
    match (sigma_a, colour, has_melanin) {
        (Some(sigma_a), None, false) => sigma_a.within("sigma_a", ANY),
        (None, Some(colour), false) => Ok(absorption_of_colour(colour.share("colour")?, beta_n)),
        (None, None, true) => {
            let eumelanin = in_range("eumelanin", melanin[0].unwrap_or(0.0), ANY)?;
            let pheomelanin = in_range("pheomelanin", melanin[1].unwrap_or(0.0), ANY)?;
            Ok(absorption_of_melanin(eumelanin, pheomelanin))
        }
        (None, None, false) => Ok(HairParameters::<f64>::default().sigma_a),
        _ => Err(invalid(
            "the absorption is given twice (expected sigma_a, colour, or eumelanin and pheomelanin)",
        )),
    }
}

fn fibre<T: Real>(parameters: &HairParameters<f64>, h: Option<f64>) -> hair::Hair<T> {
    let fibre = hair::Hair::new(&HairParameters {
        sigma_a: parameters.sigma_a.cast(),
        eta: T::of(parameters.eta),
        beta_m: T::of(parameters.beta_m),
        beta_n: T::of(parameters.beta_n),
        alpha_deg: T::of(parameters.alpha_deg),
    });
    h.map_or(fibre, |h| fibre.at_offset(T::of(h)))
}
