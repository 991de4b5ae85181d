//! Parameters in another scalar: the same values in `f32` and in its fused twin, rounded from `f64` to `f32`. Lobes
//! stand with their batches.

use crate::alpha::Alpha;
use crate::fresnel::{Conductor, F82Tint, Reflectance, Schlick, Tinted, Untinted};
use crate::math::Real;
use crate::ndf::{Beckmann, Ggx, Ndf};

/// A type with a scalar parameter, convertible to another scalar.
pub(super) trait Recast {
    /// The same in the scalar `U`.
    type In<U: Real>;

    /// The same values, rounded.
    fn recast<U: Real>(&self) -> Self::In<U>;
}

/// `x` in another scalar.
#[inline(always)]
pub(super) fn convert<T: Real, U: Real>(x: T) -> U {
    U::of(x.to_f64())
}

/// Implements [`Recast`] for a type with one scalar parameter.
macro_rules! recast {
    ($name:ident, $self:ident, $u:ident => $body:expr) => {
        impl<T: Real> Recast for $name<T> {
            type In<U: Real> = $name<U>;

            #[inline(always)]
            fn recast<$u: Real>(&$self) -> $name<$u> {
                $body
            }
        }
    };
}

pub(super) use recast;

recast!(Alpha, self, U => Alpha { x: convert(self.x), y: convert(self.y) });
recast!(Ggx, self, U => Ggx::new(self.alpha().recast()));
recast!(Beckmann, self, U => Beckmann::new(self.alpha().recast()));
recast!(Conductor, self, U => Conductor {
    eta: self.eta.cast(),
    k: self.k.cast(),
});
recast!(Schlick, self, U => Schlick { f0: self.f0.cast() });
recast!(F82Tint, self, U => F82Tint {
    schlick: self.schlick.recast(),
    hump: self.hump.cast(),
});
recast!(Untinted, self, U => match self {
    Self::Conductor(f) => Untinted::Conductor(f.recast()),
    Self::Schlick(f) => Untinted::Schlick(f.recast()),
    Self::F82Tint(f) => Untinted::F82Tint(f.recast()),
});
recast!(Reflectance, self, U => match self {
    Self::Constant(colour) => Reflectance::Constant(colour.cast()),
    Self::Conductor(f) => Reflectance::Conductor(f.recast()),
    Self::Schlick(f) => Reflectance::Schlick(f.recast()),
    Self::F82Tint(f) => Reflectance::F82Tint(f.recast()),
    Self::Tinted(f) => Reflectance::Tinted(Tinted {
        tint: f.tint.cast(),
        of: f.of.recast(),
    }),
});
