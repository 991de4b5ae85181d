//! The table of lobes: one row each, from which everything is made that must know every lobe.

/// Hands the rows of the table to the macro `callback!`, behind `context`.
///
/// ```text
/// /// documentation
/// Variant: Type, sides, batch, "path of its shader";
/// ```
///
/// * sides: `reflects` where the lobe is black below the surface, `transmits` where it is not, `depends` where its
///   parameters decide.
/// * batch: how a renderer deals with many elements of the lobe at once: `closed` evaluates and samples them by
///   [`batch`](crate::batch), `delta` samples them (nothing is left to evaluate), `walks` gives each element a stream
///   of random numbers, `scalar` takes them one by one.
/// * shader: the module of `specula-shaders/wgsl` that is its twin.
///
/// [`Lobe`](crate::bsdf::Lobe), its dispatch and conversions, what `specula-render` knows of lobes, and the tests that
/// no shader is missing are made of these rows: a row without an entry does not compile.
#[doc(hidden)]
#[macro_export]
macro_rules! lobe_table {
    ($callback:ident $($context:tt)*) => {
        $callback! {
            $($context)*
            /// See [`Lambert`].
            Lambert: $crate::bsdf::Lambert<T>, reflects, closed, "bsdf/lambert";
            /// See [`Eon`].
            Eon: $crate::bsdf::Eon<T>, reflects, closed, "bsdf/eon";
            /// See [`DiffuseTransmission`].
            DiffuseTransmission: $crate::bsdf::DiffuseTransmission<T>, transmits, scalar, "bsdf/diffuse_transmission";
            /// See [`SmoothConductor`].
            SmoothConductor: $crate::bsdf::SmoothConductor<T>, reflects, delta, "bsdf/smooth_conductor";
            /// See [`RoughConductor`].
            RoughConductor: $crate::bsdf::RoughConductor<T>, reflects, closed, "bsdf/rough_conductor";
            /// See [`SmoothDielectric`].
            SmoothDielectric: $crate::bsdf::SmoothDielectric<T>, transmits, delta, "bsdf/smooth_dielectric";
            /// See [`RoughDielectric`].
            RoughDielectric: $crate::bsdf::RoughDielectric<T>, transmits, closed, "bsdf/rough_dielectric";
            /// See [`ThinDielectric`].
            ThinDielectric: $crate::bsdf::ThinDielectric<T>, transmits, scalar, "bsdf/thin_dielectric";
            /// See [`CoatedDiffuse`].
            CoatedDiffuse: $crate::bsdf::CoatedDiffuse<T>, reflects, closed, "bsdf/coated_diffuse";
            /// See [`Layered`].
            Layered: $crate::bsdf::Layered<T>, reflects, scalar, "bsdf/layered/layered";
            /// See [`Compensated`].
            Compensated: $crate::bsdf::Compensated<T>, reflects, closed, "bsdf/compensated";
            /// See [`CompensatedDielectric`].
            CompensatedDielectric: $crate::bsdf::CompensatedDielectric<T>, transmits, scalar,
                "bsdf/compensated_dielectric";
            /// See [`MultibounceConductor`].
            MultibounceConductor: $crate::bsdf::MultibounceConductor<T>, reflects, walks,
                "multibounce/multibounce_conductor";
            /// See [`MultibounceDielectric`].
            MultibounceDielectric: $crate::bsdf::MultibounceDielectric<T>, transmits, scalar,
                "multibounce/multibounce_dielectric";
            /// See [`Black`].
            Black: $crate::bsdf::Black, reflects, scalar, "bsdf/black";
            /// See [`RoughConductor`], with Beckmann's normals.
            RoughConductorBeckmann: $crate::bsdf::RoughConductor<T, $crate::ndf::Beckmann<T>>, reflects, scalar,
                "bsdf/rough_conductor";
            /// See [`RoughDielectric`], with Beckmann's normals.
            RoughDielectricBeckmann: $crate::bsdf::RoughDielectric<T, $crate::ndf::Beckmann<T>>, transmits, scalar,
                "bsdf/rough_dielectric";
            /// See [`Compensated`], with Beckmann's normals.
            CompensatedBeckmann: $crate::bsdf::Compensated<T, $crate::ndf::Beckmann<T>>, reflects, scalar,
                "bsdf/compensated";
            /// See [`CompensatedDielectric`], with Beckmann's normals.
            CompensatedDielectricBeckmann: $crate::bsdf::CompensatedDielectric<T, $crate::ndf::Beckmann<T>>,
                transmits, scalar, "bsdf/compensated_dielectric";
            /// See [`MultibounceConductor`], with Beckmann's normals.
            MultibounceConductorBeckmann: $crate::bsdf::MultibounceConductor<T, $crate::ndf::Beckmann<T>>,
                reflects, scalar, "multibounce/multibounce_conductor";
            /// See [`MultibounceDielectric`], with Beckmann's normals.
            MultibounceDielectricBeckmann: $crate::bsdf::MultibounceDielectric<T, $crate::ndf::Beckmann<T>>,
                transmits, scalar, "multibounce/multibounce_dielectric";
            /// See [`Plastic`].
            Plastic: $crate::bsdf::Plastic<T>, reflects, scalar, "bsdf/plastic";
            /// See [`Plastic`], with Beckmann's normals.
            PlasticBeckmann: $crate::bsdf::Plastic<T, $crate::ndf::Beckmann<T>>, reflects, scalar, "bsdf/plastic";
            /// See [`Principled`].
            Principled: $crate::bsdf::Principled<T>, depends, scalar, "bsdf/principled_solid";
            /// See [`Gltf`].
            Gltf: $crate::bsdf::Gltf<T>, depends, scalar, "bsdf/gltf";
        }
    };
}
