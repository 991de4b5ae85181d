//! GGX and Beckmann over arrays: densities, masking, samplers of visible normals and of reflections.

use pyo3::prelude::*;
use specula_bsdf::Alpha;
use specula_bsdf::batch::{self, Directions, Level};
use specula_bsdf::math::{Vec3, vec3};
use specula_bsdf::ndf::{self, Masking, Ndf as _};
use specula_bsdf::vndf::{Sampler, VisibleNormals, cap, heitz};

use crate::arrays::{
    Argument, Axis, Must, Output, Scalar, are_double, common_shape, finished, output,
};
use crate::parallel::{Outputs, run};
use crate::parameters::{self, Alphas, invalid, named};

/// The calls of one precision.
struct Call<'a, 'py> {
    py: Python<'py>,
    arguments: [&'a Argument<'py>; 2],
    axis: Axis,
    threads: usize,
}

impl<'py> Call<'_, 'py> {
    /// A number of each pair of directions.
    fn numbers<T: Scalar>(
        &self,
        f: impl Fn(Vec3<T>, Vec3<T>) -> T + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.blocks_of_numbers(|[ax, ay, az], [bx, by, bz], numbers| {
            for (i, number) in numbers.iter_mut().enumerate() {
                *number = f(vec3(ax[i], ay[i], az[i]), vec3(bx[i], by[i], bz[i]));
            }
        })
    }

    /// Numbers of pairs of directions, a block at a time.
    fn blocks_of_numbers<T: Scalar>(
        &self,
        f: impl Fn([&[T]; 3], [&[T]; 3], &mut [T]) + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [a, b] = [
            self.arguments[0].vectors::<T>(self.axis)?,
            self.arguments[1].vectors::<T>(self.axis)?,
        ];
        let shape = common_shape(&[(a.name, &a.elements), (b.name, &b.elements)])?;
        let (array, mut written) = output::<T>(self.py, &shape, None)?;
        let sources = [a.source(Must::Unit)?, b.source(Must::Unit)?];
        let numbers = written.as_slice_mut()?;
        let n = numbers.len();
        let outputs = Outputs {
            numbers: Some(numbers),
            ..Outputs::default()
        };
        run(self.py, n, self.threads, &sources, outputs, |block| {
            let [a, b] = block.sources;
            f(a, b, block.numbers);
        })?;
        drop(written);
        finished(array)
    }

    /// A vector of each direction and three random numbers, of which two are of account.
    fn vectors<T: Scalar>(
        &self,
        f: impl Fn([&[T]; 3], [&[T]; 3], [&mut [T]; 3]) + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let wo = self.arguments[0].vectors::<T>(self.axis)?;
        let u = self.arguments[1].vectors::<T>(self.axis)?;
        let shape = common_shape(&[(wo.name, &wo.elements), (u.name, &u.elements)])?;
        let (array, mut written) = output::<T>(self.py, &self.axis.around(&shape), None)?;
        let sources = [wo.source(Must::Unit)?, u.source(Must::RandomPair)?];
        let all = written.as_slice_mut()?;
        let n = all.len() / 3;
        let outputs = Outputs {
            vectors: [Some(Output::new(all, self.axis)), None],
            ..Outputs::default()
        };
        run(self.py, n, self.threads, &sources, outputs, |block| {
            let [to, _] = block.vectors;
            f(block.sources[0], block.sources[1], to);
        })?;
        drop(written);
        finished(array)
    }
}

/// Directions of a block.
fn of<T>([x, y, z]: [&[T]; 3]) -> Directions<&[T]> {
    Directions { x, y, z }
}

/// Vectors one by one.
fn each<T: Scalar>(
    [x, y, z]: [&[T]; 3],
    [_, u, v]: [&[T]; 3],
    [to_x, to_y, to_z]: [&mut [T]; 3],
    f: impl Fn(Vec3<T>, [T; 2]) -> Vec3<T>,
) {
    for i in 0..x.len() {
        let w = f(vec3(x[i], y[i], z[i]), [u[i], v[i]]);
        (to_x[i], to_y[i], to_z[i]) = (w.x, w.y, w.z);
    }
}

/// Runs `$body` with `T` as the precision of the arguments.
macro_rules! in_precision {
    ($call:expr, $T:ident => $body:expr) => {
        if are_double(&$call.arguments)? {
            type $T = f64;
            $body
        } else {
            type $T = f32;
            $body
        }
    };
}

/// What both distributions have.
macro_rules! distribution {
    ($name:ident, $make:ident, $doc:literal, { $($more:tt)* }) => {
        #[doc = $doc]
        #[pyclass(frozen, module = "specula_render")]
        pub(crate) struct $name {
            alpha: Alpha<f64>,
        }

        #[pymethods]
        impl $name {
            #[new]
            fn new(alpha: Alphas) -> PyResult<Self> {
                Ok(Self { alpha: alpha.checked()? })
            }

            /// The alphas along x and y.
            #[getter]
            fn alpha(&self) -> (f64, f64) {
                (self.alpha.x, self.alpha.y)
            }

            /// Density of normals.
            #[pyo3(signature = (wm, *, axis = -1, threads = 1))]
            fn d<'py>(
                &self,
                wm: &Bound<'py, PyAny>,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let wm = Argument::new("wm", wm)?;
                let call = Call::of([&wm, &wm], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|wm, _| ndf.d(wm))
                })
            }

            /// Smith's Lambda.
            #[pyo3(name = "lambda_", signature = (w, *, axis = -1, threads = 1))]
            fn lambda<'py>(
                &self,
                w: &Bound<'py, PyAny>,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let w = Argument::new("w", w)?;
                let call = Call::of([&w, &w], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|w, _| ndf.lambda(w))
                })
            }

            /// Masking of one direction.
            #[pyo3(signature = (w, *, axis = -1, threads = 1))]
            fn g1<'py>(
                &self,
                w: &Bound<'py, PyAny>,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let w = Argument::new("w", w)?;
                let call = Call::of([&w, &w], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|w, _| ndf.g1(w))
                })
            }

            /// Masking and shadowing of two directions.
            #[pyo3(signature = (wo, wi, *, masking = "height-correlated", axis = -1, threads = 1))]
            fn g2<'py>(
                &self,
                wo: &Bound<'py, PyAny>,
                wi: &Bound<'py, PyAny>,
                masking: &str,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let masking = parameters::masking(masking)?;
                let (wo, wi) = (Argument::new("wo", wo)?, Argument::new("wi", wi)?);
                let call = Call::of([&wo, &wi], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|wo, wi| match masking {
                        Masking::HeightCorrelated => ndf.g2_correlated(wo, wi),
                        Masking::Separable => ndf.g2_separable(wo, wi),
                    })
                })
            }

            /// Projected area of the facets that a direction sees.
            #[pyo3(signature = (w, *, axis = -1, threads = 1))]
            fn projected_area<'py>(
                &self,
                w: &Bound<'py, PyAny>,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let w = Argument::new("w", w)?;
                let call = Call::of([&w, &w], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|w, _| ndf.projected_area(w))
                })
            }

            /// Density of visible normals.
            #[pyo3(signature = (wo, wm, *, axis = -1, threads = 1))]
            fn d_visible<'py>(
                &self,
                wo: &Bound<'py, PyAny>,
                wm: &Bound<'py, PyAny>,
                axis: isize,
                threads: usize,
            ) -> PyResult<Bound<'py, PyAny>> {
                let (wo, wm) = (Argument::new("wo", wo)?, Argument::new("wm", wm)?);
                let call = Call::of([&wo, &wm], axis, threads)?;
                in_precision!(call, T => {
                    let ndf = parameters::$make::<T>(self.alpha);
                    call.numbers::<T>(|wo, wm| ndf.d_visible(wo, wm))
                })
            }

            $($more)*
        }
    };
}

impl<'a, 'py> Call<'a, 'py> {
    fn of(arguments: [&'a Argument<'py>; 2], axis: isize, threads: usize) -> PyResult<Self> {
        Ok(Self {
            py: arguments[0].py(),
            arguments,
            axis: Axis::numbered(axis)?,
            threads,
        })
    }
}

distribution!(
    Ggx,
    ggx,
    "GGX: Trowbridge and Reitz 1975, Walter et al. 2007.",
    {
        /// Samples visible normals.
        #[pyo3(signature = (wo, u, *, sampler = "cap", axis = -1, threads = 1))]
        fn sample_wm<'py>(
            &self,
            wo: &Bound<'py, PyAny>,
            u: &Bound<'py, PyAny>,
            sampler: &str,
            axis: isize,
            threads: usize,
        ) -> PyResult<Bound<'py, PyAny>> {
            let is_cap = match named::<Sampler>(sampler)? {
                Sampler::Heitz => false,
                Sampler::Cap => true,
                _ => {
                    return Err(invalid(format!(
                        "{sampler} samples reflections, not normals (expected heitz or cap)"
                    )));
                }
            };
            let (wo, u) = (Argument::new("wo", wo)?, Argument::new("u", u)?);
            let call = Call::of([&wo, &u], axis, threads)?;
            in_precision!(call, T => {
                let alpha = parameters::cast::<T>(self.alpha);
                match is_cap {
                    true => call.vectors::<T>(|wo, u, to| each(wo, u, to, |wo, u| cap::sample_wm(alpha, wo, u))),
                    false => call.vectors::<T>(|wo, u, to| each(wo, u, to, |wo, u| heitz::sample_wm(alpha, wo, u))),
                }
            })
        }

        /// Samples reflections; `(0, 0, 0)` where one falls below the horizon.
        #[pyo3(signature = (wo, u, *, sampler = "exact", axis = -1, threads = 1))]
        fn sample_reflection<'py>(
            &self,
            wo: &Bound<'py, PyAny>,
            u: &Bound<'py, PyAny>,
            sampler: &str,
            axis: isize,
            threads: usize,
        ) -> PyResult<Bound<'py, PyAny>> {
            let sampler = named::<Sampler>(sampler)?;
            let (wo, u) = (Argument::new("wo", wo)?, Argument::new("u", u)?);
            let call = Call::of([&wo, &u], axis, threads)?;
            in_precision!(call, T => {
                let alphas = batch::Alphas::<T>::Same(parameters::cast(self.alpha));
                call.vectors::<T>(|wo, [_, u, v], [x, y, z]| {
                    let wi = Directions { x, y, z };
                    let done = Level::best().sample_reflection(sampler, alphas, of(wo), [u, v], wi);
                    debug_assert!(done.is_ok());
                })
            })
        }

        /// Density of sampled reflections.
        #[pyo3(signature = (wo, wi, *, sampler = "exact", axis = -1, threads = 1))]
        fn reflection_pdf<'py>(
            &self,
            wo: &Bound<'py, PyAny>,
            wi: &Bound<'py, PyAny>,
            sampler: &str,
            axis: isize,
            threads: usize,
        ) -> PyResult<Bound<'py, PyAny>> {
            let sampler = named::<Sampler>(sampler)?;
            let (wo, wi) = (Argument::new("wo", wo)?, Argument::new("wi", wi)?);
            let call = Call::of([&wo, &wi], axis, threads)?;
            in_precision!(call, T => {
                let alphas = batch::Alphas::<T>::Same(parameters::cast(self.alpha));
                call.blocks_of_numbers::<T>(|wo, wi, pdf| {
                    let done = Level::best().reflection_pdf(sampler, alphas, of(wo), of(wi), pdf);
                    debug_assert!(done.is_ok());
                })
            })
        }
    }
);

distribution!(
    Beckmann,
    beckmann,
    "Beckmann and Spizzichino 1963, Walter et al. 2007.",
    {
        /// Samples visible normals.
        #[pyo3(signature = (wo, u, *, axis = -1, threads = 1))]
        fn sample_wm<'py>(
            &self,
            wo: &Bound<'py, PyAny>,
            u: &Bound<'py, PyAny>,
            axis: isize,
            threads: usize,
        ) -> PyResult<Bound<'py, PyAny>> {
            let (wo, u) = (Argument::new("wo", wo)?, Argument::new("u", u)?);
            let call = Call::of([&wo, &u], axis, threads)?;
            in_precision!(call, T => {
                let ndf: ndf::Beckmann<T> = parameters::beckmann(self.alpha);
                call.vectors::<T>(|wo, u, to| each(wo, u, to, |wo, u| ndf.sample_wm(wo, u)))
            })
        }
    }
);
