//! What a measured lobe is made of: the fields of a file of the RGL database, with colours as RGB.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// The fields of a measurement, as the files name them.
///
/// Every grid is bilinear over the unit square. Along x lies a polar angle, `x = sqrt(2 theta / pi)`; along y
/// an azimuth, `y = (phi + pi) / (2 pi)`, which of isotropic measurements is relative to the view's.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredTables {
    /// Polar angles of the views, radians in `[0, pi/2]`, ascending.
    pub theta_i: Vec<f32>,
    /// Azimuths of the views, radians, ascending; one or two where the surface is isotropic. Others cover a
    /// turn, or from `-pi` on a half or a quarter of one where the surface has that symmetry.
    pub phi_i: Vec<f32>,
    /// Density of normals, 1/sr, over the normals.
    pub ndf: MeasuredGrid,
    /// Projected area of the microsurface, over the views.
    pub sigma: MeasuredGrid,
    /// Density of visible normals over the normals, as a density on the unit square of any scale:
    /// a slice for each azimuth and polar angle, the latter faster.
    pub vndf: MeasuredGrid,
    /// Density by luminance over the coordinates in which `vndf` is uniform; slices as of `vndf`.
    pub luminance: MeasuredGrid,
    /// `f cos` over the coordinates of `luminance`; divided by `ndf / (4 sigma)` where `jacobian`.
    /// As many nodes as `luminance`; each slice has all of red, of green, of blue.
    pub rgb: Vec<f32>,
    /// Whether `rgb` is to be multiplied by `ndf / (4 sigma)`.
    pub jacobian: bool,
}

/// Slices of values on a grid of the unit square.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredGrid {
    /// Nodes along x and along y, at least 2 each.
    pub size: [usize; 2],
    /// Slices of rows of x.
    pub values: Vec<f32>,
}

/// Why tables are no measurement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("\"{field}\" {problem}")]
pub struct MeasuredError {
    field: &'static str,
    problem: String,
}

/// Most slices, and most nodes of a slice: their products then fit 64 bits.
const MOST: usize = 1 << 24;

impl MeasuredTables {
    /// Whether the lobe turns with the view.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.phi_i.len() <= 2
    }

    /// # Errors
    ///
    /// Where sizes do not agree, angles do not ascend, or values are not finite.
    pub(super) fn check(&self) -> Result<(), MeasuredError> {
        use core::f32::consts::{FRAC_PI_2, PI};
        angles("theta_i", &self.theta_i, -1e-4, FRAC_PI_2 + 1e-4)?;
        // Azimuths may be any turn's.
        angles("phi_i", &self.phi_i, -2.001 * PI, 2.001 * PI)?;
        let slices = self.theta_i.len().saturating_mul(self.phi_i.len());
        if slices > MOST {
            return Err(error(
                "phi_i",
                format!("and \"theta_i\" have more than {MOST} views"),
            ));
        }
        grid("ndf", &self.ndf, 1)?;
        grid("sigma", &self.sigma, 1)?;
        grid("vndf", &self.vndf, slices)?;
        grid("luminance", &self.luminance, slices)?;
        let expected = 3 * self.luminance.values.len();
        if self.rgb.len() != expected {
            let found = self.rgb.len();
            return Err(error(
                "rgb",
                format!("has {found} values; expected {expected}"),
            ));
        }
        finite("rgb", &self.rgb)?;
        if !self.is_isotropic() {
            self.symmetry()?;
        }
        Ok(())
    }

    /// How many times the azimuths of an anisotropic measurement cover a turn: 1, 2 or 4.
    pub(super) fn symmetry(&self) -> Result<u32, MeasuredError> {
        use core::f32::consts::{PI, TAU};
        let (Some(&first), Some(&last)) = (self.phi_i.first(), self.phi_i.last()) else {
            return Err(error("phi_i", String::from("has no values")));
        };
        let times = TAU / (last - first);
        let starts = (first + PI).abs() < 1e-2;
        [1_u8, 2, 4]
            .into_iter()
            .find(|&n| (times - f32::from(n)).abs() < 0.02 * f32::from(n) && starts)
            .map(u32::from)
            .ok_or_else(|| {
                let problem = format!(
                    "covers {first} to {last}; expected a turn, a half or a quarter of one, from {}",
                    -PI
                );
                error("phi_i", problem)
            })
    }
}

fn error(field: &'static str, problem: String) -> MeasuredError {
    MeasuredError { field, problem }
}

fn angles(field: &'static str, all: &[f32], low: f32, high: f32) -> Result<(), MeasuredError> {
    finite(field, all)?;
    if all.is_empty() || all.len() > MOST {
        let problem = format!("has {} values; expected 1 to {MOST}", all.len());
        return Err(error(field, problem));
    }
    if let Some(bad) = all.windows(2).find(|p| p[0] >= p[1]) {
        let problem = format!("does not ascend: {} before {}", bad[0], bad[1]);
        return Err(error(field, problem));
    }
    if let Some(bad) = all.iter().find(|&&a| a < low || a > high) {
        let problem = format!("has the angle {bad}; expected radians from {low} to {high}");
        return Err(error(field, problem));
    }
    Ok(())
}

fn grid(field: &'static str, grid: &MeasuredGrid, slices: usize) -> Result<(), MeasuredError> {
    let [w, h] = grid.size;
    let nodes = w.saturating_mul(h);
    if w < 2 || h < 2 || nodes > MOST {
        let problem = format!("has {h} x {w} nodes; expected at least 2 x 2, at most {MOST}");
        return Err(error(field, problem));
    }
    let (expected, found) = (nodes.saturating_mul(slices), grid.values.len());
    if found != expected {
        return Err(error(
            field,
            format!("has {found} values; expected {expected}"),
        ));
    }
    finite(field, &grid.values)
}

fn finite(field: &'static str, values: &[f32]) -> Result<(), MeasuredError> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(i) => {
            let problem = format!(
                "has the value {} at {i}; expected finite numbers",
                values[i]
            );
            Err(error(field, problem))
        }
    }
}
