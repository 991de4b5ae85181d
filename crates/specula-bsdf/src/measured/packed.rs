//! The tables as one array, for shaders.

use alloc::vec::Vec;

use super::Measured;
use super::warp::count;
use crate::math::Real;

impl<T: Real> Measured<T> {
    /// The tables with all that was computed from them, as one array: what `measured_of` in `measured.wgsl` reads.
    ///
    /// ```text
    /// 0    azimuths and polar angles of views, how many
    /// 2    whether the lobe turns with the view; how many times the azimuths cover a turn
    /// 4    whether colours are multiplied by ndf / (4 sigma)
    /// 5    nodes along x and y of ndf, sigma, vndf, luminance
    /// 13   albedo
    /// 16   azimuths, polar angles, ndf, sigma
    ///      vndf, then luminance: densities, integrals along rows, integrals of rows, of each all slices
    ///      rgb
    /// ```
    ///
    /// Counts are numbers, too: all are at most `2^24`, which `f32` holds.
    #[must_use]
    pub fn packed(&self) -> Vec<T> {
        let flag = |is_set: bool| T::select(is_set, T::ONE, T::ZERO);
        let warps = [&self.vndf, &self.luminance];
        let sizes = [self.ndf.size(), self.sigma.size()].into_iter();
        let sizes = sizes.chain(warps.map(|warp| warp.size()));
        let mut all = alloc::vec![
            count(self.phi_i.len()),
            count(self.theta_i.len()),
            flag(self.turns),
            T::of(self.symmetry.into()),
            flag(self.jacobian),
        ];
        all.extend(sizes.flatten().map(count::<T>));
        all.extend(self.albedo.to_array());
        for table in [
            &self.phi_i[..],
            &self.theta_i,
            self.ndf.values(),
            self.sigma.values(),
        ] {
            all.extend(table);
        }
        for table in warps.into_iter().flat_map(|warp| warp.values()) {
            all.extend(table);
        }
        all.extend(self.rgb.values());
        all
    }
}

#[cfg(test)]
mod tests {
    use crate::Alpha;
    use crate::bsdf::RoughConductor;
    use crate::fresnel::Reflectance;
    use crate::math::Rgb;
    use crate::measured::{Measured, Resolution, Symmetry, tabulate};
    use crate::ndf::Ggx;

    #[test]
    fn everything_is_packed_once() {
        let ndf = Ggx::new(Alpha { x: 0.3, y: 0.3 });
        let lobe = RoughConductor::new(ndf, Reflectance::Constant(Rgb::splat(0.8)));
        let size = Resolution {
            theta: 3,
            phi: 4,
            normals: [5, 6],
            colours: 7,
        };
        let tables = tabulate(&ndf, &lobe, Symmetry::HalfTurn, size);
        let measured = Measured::<f32>::new(&tables).unwrap();
        let packed = measured.packed();
        assert_eq!(packed.len() as u64 * 4, measured.size_in_bytes() + 16 * 4);
        let counts = [
            4.0, 3.0, 0.0, 2.0, 1.0, 5.0, 6.0, 5.0, 6.0, 5.0, 6.0, 7.0, 7.0,
        ];
        assert_eq!(packed[..13], counts);
        assert_eq!(packed[16..20], tables.phi_i);
        assert_eq!(packed[20..23], tables.theta_i);
        assert_eq!(packed[23..53], tables.ndf.values);
        let rgb = tables.rgb.len();
        assert_eq!(packed[packed.len() - rgb..], tables.rgb);
        // Integrals of the last slice's rows end at 1.
        let marginal = packed[packed.len() - rgb - 1];
        assert!((marginal - 1.0).abs() < 1e-6, "{marginal}");
    }
}
