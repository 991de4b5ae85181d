//! Lobes as numbers in columns: what their batches are made of.

use super::Bsdf;
use crate::math::{Real, Rgb, Vec3};

/// A lobe whose reflection is computed from `N` numbers of its own, and `Q` numbers that tables say of each direction, by
/// `P` numbers that tell its places in them.
#[doc(hidden)]
pub trait InColumns<T: Real, const N: usize, const P: usize, const Q: usize>: Bsdf<T> {
    /// The lobe's numbers; `None` where it does more than reflect by them.
    fn columns(&self) -> Option<[T; N]>;

    /// A direction's places in the tables; without branches.
    fn places(columns: [T; N], w: Vec3<T>) -> [T; P];

    /// What the tables say of a direction.
    fn look_up(&self, places: [T; P], w: Vec3<T>) -> [T; Q];

    /// A direction, perhaps below the horizon; without branches.
    ///
    /// * `of_wo`: what tables say of `wo`.
    fn sample_wi_of(columns: [T; N], of_wo: [T; Q], wo: Vec3<T>, u: [T; 3]) -> Vec3<T>;

    /// [`Bsdf::eval_pdf`] by the numbers; without branches.
    ///
    /// * `looked_up`: what tables say of `wo` and, above the horizon, of `wi`.
    fn eval_pdf_of(
        columns: [T; N],
        looked_up: [[T; Q]; 2],
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> (Rgb<T>, T);
}
