//! Lobes: made, asked, freed.

use std::ffi::c_char;
use std::fmt::Display;
use std::path::Path;

use crate::border::border;
use crate::failure::{Failure, Status};
use crate::lobe::LobeHandle;
use crate::pointers::Caller;
use specula_lobes::{Argument, LobeError, Value};
use specula_scene::measured;

/// What is no lobe.
fn refused(error: LobeError) -> Failure {
    Failure::invalid(error.to_string())
}

/// A parameter of a lobe: a name with a text, or with one to three numbers.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Parameter {
    /// Such as "alpha"; hyphens and underscores are the same.
    pub name: *const c_char,
    /// A value as in `specula_lobe_parse`, such as "Au"; NULL where there are numbers.
    pub text: *const c_char,
    /// A number, two alphas, or the channels of a colour in linear sRGB.
    pub numbers: [f64; 3],
    /// How many numbers there are, 1 to 3; 0 with a text.
    pub count: usize,
}

impl Parameter {
    fn read<'a>(&self, caller: &'a Caller) -> Result<Argument<'a>, Failure> {
        let name = caller.text("parameters.name", self.name)?;
        let [x, y, z] = self.numbers;
        let value = match (self.text.is_null(), self.count) {
            (false, 0) => Value::of_text(caller.text(name, self.text)?),
            (true, 1) => Value::One(x),
            (true, 2) => Value::Two([x, y]),
            (true, 3) => Value::Three([x, y, z]),
            (false, _) => {
                return Err(Failure::invalid(format!(
                    "{name}: expected a text or numbers, got both"
                )));
            }
            (true, count) => {
                return Err(Failure::invalid(format!(
                    "{name}: expected a text, or 1 to 3 numbers, got {count}"
                )));
            }
        };
        Ok(Argument { name, value })
    }
}

/// Makes a lobe of a text, such as "conductor Au alpha 0.3".
///
/// The text is a kind and then keys with their values, in any order, between white space. Values have no spaces:
/// numbers, words, `true` or `false`, two alphas along x and y as 0.1,0.4, colours in linear sRGB as 0.8,0.2,0.1 or as
/// one number for a grey. What is not given has the default in brackets; alphas without one must be given.
///
/// ```text
/// lambert                 albedo [0.5]
/// eon                     albedo [0.5], roughness [0.5]: rough diffuse reflection
/// diffuse-transmission    reflectance, transmittance [0.25]
/// smooth-conductor        a reflectance
/// conductor               a reflectance, alpha, distribution [ggx] or beckmann, sampler [exact], bounded, cap or
///                         heitz, masking [height-correlated] or separable, energy turquin, turquin-series or
///                         kulla-conty
/// multibounce-conductor   a reflectance, alpha, distribution, model [specula], heitz, bitterli, wang,
///                         wang-uncorrelated, cui or cui-bidirectional, mis_pdf [normalised], hapke or lambert
/// smooth-dielectric       eta [1.5], reflection_tint [1], transmission_tint [1]
/// thin-dielectric         the same: a pane
/// dielectric              the same, alpha, distribution, sampler [cap], masking, compensated [false]
/// multibounce-dielectric  eta, tints, alpha, distribution, model [specula] or heitz, mis_pdf
/// coated-diffuse          alpha (smooth without), eta [1.5], albedo [0.5], thickness [0], max_depth (no limit
///                         without), scattering [lossless] or single
/// layered                 alpha (smooth without), eta [1.5], the base's albedo or a reflectance with base_alpha
///                         (smooth without), thickness [0], medium_albedo [0], g [0]
/// plastic                 alpha (smooth without), eta [1.49], diffuse [0.5], specular [1], nonlinear [false],
///                         distribution, masking [separable]
/// principled              base_color [0.5], roughness [0.5], anisotropic, metallic, spec_trans, eta [1.5], spec_tint,
///                         sheen, sheen_tint, clearcoat, clearcoat_gloss, flatness, diff_trans [all 0], thin [false],
///                         outside [true]
/// gltf                    base_color, metallic, roughness [1], anisotropy [0], ior [1.5], specular, specular_color
///                         [1], transmission [0], volume [false], outside [true], clearcoat, clearcoat_roughness,
///                         sheen_color, sheen_roughness [0], compensated [false]
/// ```
///
/// A reflectance is one of these, white without: the chemical symbol of a measured metal, alone or after
/// `reflectance`; a colour after `reflectance`; `conductor_eta` and `conductor_k`; `f0` (Schlick), and with it
/// `f82_tint`. `tint` is a factor on any.
///
/// * `text`: UTF-8, ends with a zero.
/// * `lobe`: where the lobe goes, NULL where the call fails. The caller frees it by `specula_lobe_free`.
/// * Returns: SPECULA_STATUS_INVALID_ARGUMENT where the text is no lobe; the message lists what is known.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_parse(
    text: *const c_char,
    lobe: *mut *mut LobeHandle,
) -> Status {
    border(|caller| {
        caller.write("lobe", lobe, std::ptr::null_mut())?;
        let text = caller.text("text", text)?;
        let made = specula_lobes::parse(text).map_err(refused)?;
        caller.hand_over("lobe", lobe, LobeHandle::named(&made))
    })
}

/// Makes a lobe of parameters: what `specula_lobe_parse` does, without a text.
///
/// * `kind`: such as "conductor".
/// * `parameters`: `count` of them; may be NULL where there are none.
/// * `lobe`: as for `specula_lobe_parse`.
/// * Returns: SPECULA_STATUS_INVALID_ARGUMENT where the parameters make no lobe.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_make(
    kind: *const c_char,
    parameters: *const Parameter,
    count: usize,
    lobe: *mut *mut LobeHandle,
) -> Status {
    border(|caller| {
        caller.write("lobe", lobe, std::ptr::null_mut())?;
        let kind = caller.text("kind", kind)?;
        let parameters = caller.items("parameters", parameters, count)?;
        let read: Result<Vec<_>, _> = parameters.iter().map(|p| p.read(caller)).collect();
        let made = specula_lobes::make(kind, &read?).map_err(refused)?;
        caller.hand_over("lobe", lobe, LobeHandle::named(&made))
    })
}

/// Reads a measured material, which reflects light as a gonioreflectometer has measured it.
///
/// Its samples have a density of their own (Dupuy and Jakob 2018, "An Adaptive Parameterization for Efficient Material
/// Acquisition and Rendering"). It is black where either direction is below the horizon.
///
/// * `file`: path of a `.bsdf` file of the RGL database, or of a `.binary` file of the MERL database; UTF-8.
/// * `lobe`: as for `specula_lobe_parse`.
/// * Returns: SPECULA_STATUS_UNREADABLE where the file cannot be read, or is no such file.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_measured(
    file: *const c_char,
    lobe: *mut *mut LobeHandle,
) -> Status {
    border(|caller| {
        caller.write("lobe", lobe, std::ptr::null_mut())?;
        let file = caller.text("file", file)?;
        let wrong = |e: &dyn Display| Failure::new(Status::Unreadable, format!("{file}: {e}"));
        let tables = measured::read_tables(Path::new(file)).map_err(|e| wrong(&e))?;
        let made = LobeHandle::measured(&tables).map_err(|e| wrong(&e))?;
        caller.hand_over("lobe", lobe, made)
    })
}

/// Frees a lobe, which no thread may use any more; NULL is nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_free(lobe: *mut LobeHandle) {
    border(|caller| caller.free(lobe));
}

/// Tells whether values of a lobe are estimates, each with random numbers of its own, as of walks.
///
/// * `is_stochastic`: where the answer goes.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_is_stochastic(
    lobe: *const LobeHandle,
    is_stochastic: *mut bool,
) -> Status {
    border(|caller| {
        let is = caller.lent("lobe", lobe)?.as_bsdf().is_stochastic();
        caller.write("is_stochastic", is_stochastic, is)
    })
}

/// Tells whether nothing but Dirac deltas is left of a lobe, as of a mirror.
///
/// * `is_specular`: where the answer goes.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_is_specular(
    lobe: *const LobeHandle,
    is_specular: *mut bool,
) -> Status {
    border(|caller| {
        let is = caller.lent("lobe", lobe)?.as_bsdf().is_specular();
        caller.write("is_specular", is_specular, is)
    })
}

/// Gives the complex index of refraction of a measured metal, eta + i k, for red, green and blue of linear sRGB.
///
/// * `symbol`: its chemical symbol, such as "Au".
/// * `eta`, `k`: room for 3 numbers each.
/// * Returns: SPECULA_STATUS_INVALID_ARGUMENT where it is not among the measured; the message lists them.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_metal(
    symbol: *const c_char,
    eta: *mut f64,
    k: *mut f64,
) -> Status {
    border(|caller| {
        let symbol = caller.text("symbol", symbol)?;
        let metal = specula_lobes::metal(symbol).map_err(refused)?;
        let (eta, k) = (
            caller.target(["eta"], [eta], 1, 3)?,
            caller.target(["k"], [k], 1, 3)?,
        );
        eta.write(0, [&metal.eta]);
        k.write(0, [&metal.k]);
        Ok(())
    })
}
