//! The table of gold of the guide's measured material, made as `specula lab tabulate` makes them.

use std::fs;
use std::path::Path;

use specula_bsdf::bsdf::RoughConductor;
use specula_bsdf::fresnel::{Conductor, Reflectance};
use specula_bsdf::math::rgb;
use specula_bsdf::measured::{Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, metals};
use specula_scene::measured;

use crate::Result;

/// Its name, beside the scene.
pub(super) const FILE: &str = "gold.bsdf";

/// Small, as it is part of the repository.
const SIZE: Resolution = Resolution {
    theta: 8,
    phi: 2,
    normals: [32; 2],
    colours: 16,
};

/// Writes it.
pub(super) fn write(path: &Path) -> Result<()> {
    fs::write(path, bytes()?).map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(())
}

fn bytes() -> Result<Vec<u8>> {
    let gold = metals::by_symbol("Au").ok_or("no gold")?;
    let colour = |[r, g, b]: [f64; 3]| rgb(r, g, b);
    let fresnel = Conductor {
        eta: colour(gold.eta),
        k: colour(gold.k),
    };
    let ndf = Ggx::new(Alpha::clamped(0.25, 0.25));
    let lobe = RoughConductor::new(ndf, Reflectance::Conductor(fresnel));
    let tables = tabulate(&ndf, &lobe, Symmetry::Isotropic, SIZE);
    Ok(measured::to_bytes(&tables, "conductor Au alpha 0.25"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn the_committed_table_is_this_one() {
        let path = workspace::root().join("docs/guide/scenes").join(FILE);
        let (committed, made) = (fs::read(path).unwrap(), bytes().unwrap());
        // Another machine's functions may differ in a number's last digits; the layout does not.
        let remedy = "cargo xtask book --pictures measured";
        assert_eq!(committed.len(), made.len(), "{remedy}");
        let equal = committed.iter().zip(&made).filter(|(a, b)| a == b).count();
        assert!(equal * 10 > made.len() * 9, "{equal} bytes: {remedy}");
    }
}
