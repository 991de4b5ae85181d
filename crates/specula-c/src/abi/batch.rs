//! Lobes over arrays, in two precisions.

use crate::batch::{self, How, Pair, SamplesToWrite, ToRead, ToWrite};
use crate::border::border;
use crate::failure::{Failure, Status};
use crate::lobe::LobeHandle;
use crate::options::{BatchOptions, SPECULA_TRANSPORT_IMPORTANCE, SPECULA_TRANSPORT_RADIANCE};
use crate::pointers::Caller;
use specula_bsdf::Transport;

/// Outcome of a sample: no direction; `wi`, `weight` and `pdf` are zero.
pub const SPECULA_OUTCOME_REJECTED: u8 = 0;
/// Outcome of a sample: `wi` on the side of `wo`.
pub const SPECULA_OUTCOME_REFLECTION: u8 = 1;
/// Outcome of a sample: `wi` on the other side.
pub const SPECULA_OUTCOME_TRANSMISSION: u8 = 2;
/// Outcome of a sample: a mirrored direction; `pdf` is its probability.
pub const SPECULA_OUTCOME_SPECULAR_REFLECTION: u8 = 3;
/// Outcome of a sample: a refracted or straight direction; `pdf` is its probability.
pub const SPECULA_OUTCOME_SPECULAR_TRANSMISSION: u8 = 4;

/// What a caller's options say.
fn how(caller: &Caller, options: *const BatchOptions) -> Result<How, Failure> {
    let options = caller.options(options)?;
    let transport = match options.transport {
        SPECULA_TRANSPORT_RADIANCE => Transport::Radiance,
        SPECULA_TRANSPORT_IMPORTANCE => Transport::Importance,
        other => {
            return Err(Failure::invalid(format!(
                "options.transport: expected 0 (radiance) or 1 (importance), got {other}"
            )));
        }
    };
    Ok(How {
        transport,
        seed: options.seed,
        threads: options.threads as usize,
    })
}

/// Sets the defaults of options.
///
/// * `options`: room for `size` bytes.
/// * `size`: `sizeof(specula_batch_options)` of the caller's header.
///
/// May be called from any thread.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_batch_options_init(
    options: *mut BatchOptions,
    size: usize,
) -> Status {
    border(|caller| caller.initialise(options, size))
}

/// Vectors to read, in single precision: element `i` is (x[i * stride], y[i * stride], z[i * stride]).
///
/// * An array per component: their addresses, and a stride of 1.
/// * Rows of three: `p`, `p + 1`, `p + 2`, and a stride of 3.
/// * One vector for all elements: the addresses of its components, and a stride of 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct InputF {
    /// First components.
    pub x: *const f32,
    /// Second components.
    pub y: *const f32,
    /// Third components: along the surface's normal.
    pub z: *const f32,
    /// Numbers from one element to the next; 0: one for all.
    pub stride: usize,
}

impl InputF {
    fn to_read(self) -> ToRead<f32> {
        ToRead([self.x, self.y, self.z], self.stride)
    }
}

/// Vectors or colours to write, in single precision, laid out as `specula_input_f`. Components do not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct OutputF {
    /// First components; red.
    pub x: *mut f32,
    /// Second components; green.
    pub y: *mut f32,
    /// Third components; blue.
    pub z: *mut f32,
    /// Numbers from one element to the next, 1 or more.
    pub stride: usize,
}

impl OutputF {
    fn to_write(self) -> ToWrite<f32> {
        ToWrite([self.x, self.y, self.z], self.stride)
    }
}

/// Where samples go, in single precision; every array is wanted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SamplesF {
    /// Directions to the light, unit; zero where rejected.
    pub wi: OutputF,
    /// f |cos| / pdf, for red, green and blue; zero where rejected.
    pub weight: OutputF,
    /// One per element: in 1/sr, or a probability where the outcome is specular; zero where rejected.
    pub pdf: *mut f32,
    /// One per element: SPECULA_OUTCOME_...
    pub outcome: *mut u8,
}

impl SamplesF {
    fn to_write(self) -> SamplesToWrite<f32> {
        SamplesToWrite {
            wi: self.wi.to_write(),
            weight: self.weight.to_write(),
            pdf: self.pdf,
            outcome: self.outcome,
        }
    }
}

/// Vectors to read, in double precision: element `i` is (x[i * stride], y[i * stride], z[i * stride]).
///
/// * An array per component: their addresses, and a stride of 1.
/// * Rows of three: `p`, `p + 1`, `p + 2`, and a stride of 3.
/// * One vector for all elements: the addresses of its components, and a stride of 0.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct InputD {
    /// First components.
    pub x: *const f64,
    /// Second components.
    pub y: *const f64,
    /// Third components: along the surface's normal.
    pub z: *const f64,
    /// Numbers from one element to the next; 0: one for all.
    pub stride: usize,
}

impl InputD {
    fn to_read(self) -> ToRead<f64> {
        ToRead([self.x, self.y, self.z], self.stride)
    }
}

/// Vectors or colours to write, in double precision, laid out as `specula_input_d`. Components do not overlap.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct OutputD {
    /// First components; red.
    pub x: *mut f64,
    /// Second components; green.
    pub y: *mut f64,
    /// Third components; blue.
    pub z: *mut f64,
    /// Numbers from one element to the next, 1 or more.
    pub stride: usize,
}

impl OutputD {
    fn to_write(self) -> ToWrite<f64> {
        ToWrite([self.x, self.y, self.z], self.stride)
    }
}

/// Where samples go, in double precision; every array is wanted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SamplesD {
    /// Directions to the light, unit; zero where rejected.
    pub wi: OutputD,
    /// f |cos| / pdf, for red, green and blue; zero where rejected.
    pub weight: OutputD,
    /// One per element: in 1/sr, or a probability where the outcome is specular; zero where rejected.
    pub pdf: *mut f64,
    /// One per element: SPECULA_OUTCOME_...
    pub outcome: *mut u8,
}

impl SamplesD {
    fn to_write(self) -> SamplesToWrite<f64> {
        SamplesToWrite {
            wi: self.wi.to_write(),
            weight: self.weight.to_write(),
            pdf: self.pdf,
            outcome: self.outcome,
        }
    }
}

/// Evaluates a lobe: f(wo, wi) |cos theta_i|, in 1/sr, without Dirac deltas.
///
/// * `n`: elements; where it is 0, arrays may be NULL.
/// * `wo`, `wi`: directions to the viewer and to the light: unit, in the surface's frame, whose normal is z.
/// * `options`: NULL for the defaults.
/// * `f_cos`: `n` colours. It may lie on `wo` or `wi` with the same addresses and stride, but not overlap otherwise.
/// * Returns: SPECULA_STATUS_INVALID_ARGUMENT where a vector is not unit; the message names the first, and some
///   elements before it may have been written. Nothing is written outside of the `n` elements.
///
/// May be called from any thread, by several with one lobe.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_eval_f(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputF,
    wi: InputF,
    options: *const BatchOptions,
    f_cos: OutputF,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::eval(caller, lobe, n, pair, how, f_cos.to_write())
    })
}

/// `specula_lobe_eval_f` in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_eval_d(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputD,
    wi: InputD,
    options: *const BatchOptions,
    f_cos: OutputD,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::eval(caller, lobe, n, pair, how, f_cos.to_write())
    })
}

/// Gives the density with which `specula_lobe_sample_f` samples `wi`, in 1/sr, without Dirac deltas.
///
/// * `pdf`: `n` numbers.
/// * All else: as for `specula_lobe_eval_f`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_pdf_f(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputF,
    wi: InputF,
    options: *const BatchOptions,
    pdf: *mut f32,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::pdf(caller, lobe, n, pair, how, pdf)
    })
}

/// `specula_lobe_pdf_f` in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_pdf_d(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputD,
    wi: InputD,
    options: *const BatchOptions,
    pdf: *mut f64,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::pdf(caller, lobe, n, pair, how, pdf)
    })
}

/// Does `specula_lobe_eval_f` and `specula_lobe_pdf_f` together, at little more than the price of one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_eval_pdf_f(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputF,
    wi: InputF,
    options: *const BatchOptions,
    f_cos: OutputF,
    pdf: *mut f32,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::eval_pdf(caller, lobe, n, pair, how, (f_cos.to_write(), pdf))
    })
}

/// `specula_lobe_eval_pdf_f` in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_eval_pdf_d(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputD,
    wi: InputD,
    options: *const BatchOptions,
    f_cos: OutputD,
    pdf: *mut f64,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), wi.to_read());
        batch::eval_pdf(caller, lobe, n, pair, how, (f_cos.to_write(), pdf))
    })
}

/// Samples directions to the light.
///
/// * `wo`: directions to the viewer, as for `specula_lobe_eval_f`.
/// * `u`: three uniform random numbers in [0, 1) per element: the first chooses among lobes, the others the direction.
/// * `samples`: where the results go; arrays that overlap neither one another nor the inputs, but for the same
///   addresses and stride.
/// * All else: as for `specula_lobe_eval_f`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_sample_f(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputF,
    u: InputF,
    options: *const BatchOptions,
    samples: *const SamplesF,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), u.to_read());
        let samples = caller.lent("samples", samples)?.to_write();
        batch::sample(caller, lobe, n, pair, how, samples)
    })
}

/// `specula_lobe_sample_f` in double precision.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn specula_lobe_sample_d(
    lobe: *const LobeHandle,
    n: usize,
    wo: InputD,
    u: InputD,
    options: *const BatchOptions,
    samples: *const SamplesD,
) -> Status {
    border(|caller| {
        let lobe = caller.lent("lobe", lobe)?;
        let how = how(caller, options)?;
        let pair = Pair(wo.to_read(), u.to_read());
        let samples = caller.lent("samples", samples)?.to_write();
        batch::sample(caller, lobe, n, pair, how, samples)
    })
}
