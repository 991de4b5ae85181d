//! Functions that `core` lacks: the standard library's with the feature `std`, else those of `libm`.

/// `platform!(f32::sin or sinf(x))`: a function of the standard library, or its twin in `libm`.
#[cfg(feature = "std")]
macro_rules! platform {
    ($t:ident::$name:ident or $libm:ident($($x:expr),*)) => {
        $t::$name($($x),*)
    };
}

#[cfg(not(feature = "std"))]
macro_rules! platform {
    ($t:ident::$name:ident or $libm:ident($($x:expr),*)) => {
        libm::$libm($($x),*)
    };
}

pub(super) use platform;
