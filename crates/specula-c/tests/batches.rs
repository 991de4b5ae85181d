//! Batches are those of the library bit for bit: all lobes, both precisions, every layout.

#![allow(
    unsafe_code,
    reason = "the functions are called as C calls them, with pointers"
)]
#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use std::ffi::{CStr, CString};
use std::path::Path;
use std::ptr::{null, null_mut};

use specula_bsdf::batch::{self, Directions, Level, SampleOutcome, Samples};
use specula_bsdf::bsdf::{Bsdf, Event, Lobe, RoughConductor};
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::{Real, Stream, rgb, vec3};
use specula_bsdf::measured::{Measured, Resolution, Symmetry, tabulate};
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Rgb, Transport, Vec3};
use specula_c::abi::{self, BatchOptions, LobeHandle, Status};
use tools::known_lobes::{TEXTS, known};

const N: usize = 1300;
const SEED: u64 = 7;

/// A lobe as C has it.
struct Made(*mut LobeHandle);

// SAFETY: lobes may be used from many threads, as the header says.
unsafe impl Sync for Made {}

impl Drop for Made {
    fn drop(&mut self) {
        // SAFETY: it was made by `made`, and is not used any more.
        unsafe { abi::specula_lobe_free(self.0) }
    }
}

fn made(text: &str) -> Made {
    let text = CString::new(text).unwrap();
    let mut lobe = null_mut();
    // SAFETY: a text that ends with a zero, and room for a pointer.
    let status = unsafe { abi::specula_lobe_parse(text.as_ptr(), &mut lobe) };
    assert_eq!(status, Status::Ok, "{text:?}: {}", last());
    Made(lobe)
}

fn last() -> String {
    // SAFETY: the message is a text, and valid until the next call.
    let text = unsafe { CStr::from_ptr(abi::specula_last_error()) };
    text.to_str().unwrap().to_owned()
}

fn options(transport: u32, threads: u32) -> BatchOptions {
    BatchOptions {
        seed: SEED,
        transport,
        threads,
        ..BatchOptions::default()
    }
}

/// What both precisions have, by the functions of each.
trait Precision: Real {
    fn eval_pdf(
        lobe: &Made,
        inputs: [&Rows<Self>; 2],
        options: &BatchOptions,
        results: &mut Results<Self>,
    ) -> [Status; 3];
    fn sample(
        lobe: &Made,
        inputs: [&Rows<Self>; 2],
        options: &BatchOptions,
        samples: &mut Results<Self>,
    ) -> Status;
    fn bits(self) -> u64;
}

/// Vectors in some layout: the values, where each component begins, and the stride.
#[derive(Clone)]
struct Rows<T> {
    values: Vec<T>,
    begins: [usize; 3],
    stride: usize,
}

impl<T: Precision> Rows<T> {
    /// * `stride`: 0: one for all; 1: an array per component; else rows with what does not belong to them between.
    fn new(vectors: &[Vec3<T>], stride: usize) -> Self {
        let n = vectors.len();
        let begins = match stride {
            1 => [0, n, 2 * n],
            _ => [0, 1, 2],
        };
        let mut rows = Self {
            values: vec![T::of(-9.0); if stride == 0 { 3 } else { n * stride.max(3) }],
            begins,
            stride,
        };
        for (i, v) in vectors.iter().enumerate() {
            for (c, value) in v.to_array().into_iter().enumerate() {
                rows.values[begins[c] + i * stride] = value;
            }
        }
        rows
    }

    fn at(&self, i: usize) -> [u64; 3] {
        self.begins.map(|b| self.values[b + i * self.stride].bits())
    }

    /// Whether what lies between the elements is as it was.
    fn is_untouched_between(&self, n: usize) -> bool {
        let between = |&k: &usize| self.stride > 3 && (k % self.stride > 2 || k / self.stride >= n);
        let mut outside = (0..self.values.len()).filter(between);
        outside.all(|k| self.values[k] == T::of(-9.0))
    }
}

struct Results<T> {
    vectors: [Rows<T>; 2],
    numbers: Vec<T>,
    /// By the function for densities alone.
    densities: Vec<T>,
    outcomes: Vec<u8>,
}

impl<T: Precision> Results<T> {
    fn new(stride: usize) -> Self {
        let empty = vec![vec3(T::of(-9.0), T::of(-9.0), T::of(-9.0)); N];
        let rows = Rows::new(&empty, stride);
        Self {
            vectors: [rows.clone(), rows],
            // The last one is no element's.
            numbers: vec![T::of(-9.0); N + 1],
            densities: vec![T::of(-9.0); N + 1],
            outcomes: vec![99; N + 1],
        }
    }

    fn assert_untouched_outside(&self) {
        assert!(self.vectors.iter().all(|v| v.is_untouched_between(N)));
        let last = [self.numbers[N], self.densities[N]];
        assert!(last == [T::of(-9.0); 2] && self.outcomes[N] == 99);
    }
}

macro_rules! precision {
    (
        $T:ident, $Input:ident, $Output:ident, $Samples:ident,
        $eval:ident, $pdf:ident, $eval_pdf:ident, $sample:ident
    ) => {
        impl Precision for $T {
            fn eval_pdf(
                lobe: &Made,
                inputs: [&Rows<$T>; 2],
                options: &BatchOptions,
                results: &mut Results<$T>,
            ) -> [Status; 3] {
                let [wo, wi] = inputs.map(|rows| {
                    let [x, y, z] = rows.begins.map(|b| rows.values[b..].as_ptr());
                    let stride = rows.stride;
                    abi::$Input { x, y, z, stride }
                });
                let to = results.vectors.each_mut().map(|rows| {
                    let [x, y, z] = rows.begins.map(|b| rows.values[b..].as_mut_ptr());
                    let stride = rows.stride;
                    abi::$Output { x, y, z, stride }
                });
                let pdf = results.numbers.as_mut_ptr();
                // SAFETY: all arrays have `N` elements of their strides, and do not overlap.
                unsafe {
                    let both = abi::$eval_pdf(lobe.0, N, wo, wi, options, to[1], pdf);
                    let eval = abi::$eval(lobe.0, N, wo, wi, options, to[0]);
                    let alone = results.densities.as_mut_ptr();
                    let pdf = abi::$pdf(lobe.0, N, wo, wi, options, alone);
                    [both, eval, pdf]
                }
            }

            fn sample(
                lobe: &Made,
                inputs: [&Rows<$T>; 2],
                options: &BatchOptions,
                samples: &mut Results<$T>,
            ) -> Status {
                let [wo, u] = inputs.map(|rows| {
                    let [x, y, z] = rows.begins.map(|b| rows.values[b..].as_ptr());
                    let stride = rows.stride;
                    abi::$Input { x, y, z, stride }
                });
                let [wi, weight] = samples.vectors.each_mut().map(|rows| {
                    let [x, y, z] = rows.begins.map(|b| rows.values[b..].as_mut_ptr());
                    let stride = rows.stride;
                    abi::$Output { x, y, z, stride }
                });
                let samples = abi::$Samples {
                    wi,
                    weight,
                    pdf: samples.numbers.as_mut_ptr(),
                    outcome: samples.outcomes.as_mut_ptr(),
                };
                // SAFETY: all arrays have `N` elements of their strides, and do not overlap.
                unsafe { abi::$sample(lobe.0, N, wo, u, options, &samples) }
            }

            fn bits(self) -> u64 {
                self.to_bits().into()
            }
        }
    };
}

precision!(
    f32,
    InputF,
    OutputF,
    SamplesF,
    specula_lobe_eval_f,
    specula_lobe_pdf_f,
    specula_lobe_eval_pdf_f,
    specula_lobe_sample_f
);
precision!(
    f64,
    InputD,
    OutputD,
    SamplesD,
    specula_lobe_eval_d,
    specula_lobe_pdf_d,
    specula_lobe_eval_pdf_d,
    specula_lobe_sample_d
);

/// Random numbers in [0, 1), the same at every call.
fn uniform<T: Real>(n: usize, seed: u64) -> Vec<Vec3<T>> {
    let mut stream = Stream::new(seed);
    let mut next = || T::of(f64::from(stream.next::<f32>()));
    (0..n).map(|_| vec3(next(), next(), next())).collect()
}

/// Directions on both sides.
fn directions<T: Real>(n: usize, seed: u64) -> Vec<Vec3<T>> {
    let on_sphere = |u: Vec3<f64>| {
        let z = 1.0 - 2.0 * u.x;
        let (r, phi) = ((1.0 - z * z).max(0.0).sqrt(), std::f64::consts::TAU * u.y);
        vec3(r * phi.cos(), r * phi.sin(), z).cast()
    };
    uniform::<f64>(n, seed).into_iter().map(on_sphere).collect()
}

fn stream(i: usize) -> Stream {
    let step = (i as u64).wrapping_mul(0xd134_2543_de82_ef95);
    Stream::new(SEED.rotate_left(32).wrapping_add(step))
}

/// Runs `$call` with a lobe whose batches are vectors, or `$other`.
macro_rules! batched {
    ($lobe:expr, $l:ident => $call:expr, _ => $other:expr) => {
        match $lobe {
            Lobe::Lambert($l) => $call,
            Lobe::Eon($l) => $call,
            Lobe::DiffuseTransmission($l) => $call,
            Lobe::SmoothConductor($l) => $call,
            Lobe::RoughConductor($l) => $call,
            Lobe::SmoothDielectric($l) => $call,
            Lobe::RoughDielectric($l) => $call,
            Lobe::ThinDielectric($l) => $call,
            Lobe::RoughConductorBeckmann($l) => $call,
            Lobe::RoughDielectricBeckmann($l) => $call,
            Lobe::Principled($l) => $call,
            Lobe::Gltf($l) => $call,
            _ => $other,
        }
    };
}

/// Values and densities by the library; of walks and other lobes one by one.
fn expected<T: Real>(
    lobe: &Lobe<T>,
    wo: &[Vec3<T>],
    wi: &[Vec3<T>],
    transport: Transport,
) -> Vec<(Rgb<T>, T)> {
    let (a, b): (Directions<Vec<T>>, Directions<Vec<T>>) =
        (wo.iter().copied().collect(), wi.iter().copied().collect());
    let (a, b) = (a.as_slices(), b.as_slices());
    let mut f = Directions::zeroed(wo.len());
    let mut pdf = vec![T::ZERO; wo.len()];
    let to = batch::Colours {
        r: &mut f.x[..],
        g: &mut f.y[..],
        b: &mut f.z[..],
    };
    let level = Level::best();
    if let Lobe::MultibounceConductor(metal) = lobe {
        let mut streams: Vec<_> = (0..wo.len()).map(stream).collect();
        (level.eval_pdf_random(metal, a, b, &mut streams, to, &mut pdf)).unwrap();
    } else {
        batched!(lobe, l => level.eval_pdf(l, a, b, transport, to, &mut pdf).unwrap(), _ => {
            let one = |(i, (&wo, &wi))| lobe.eval_pdf_random(wo, wi, transport, &mut stream(i));
            return wo.iter().zip(wi).enumerate().map(one).collect();
        });
    }
    let colours = (0..wo.len()).map(|i| Rgb::from([f.x[i], f.y[i], f.z[i]]));
    colours.zip(pdf).collect()
}

fn expected_densities<T: Real>(lobe: &Lobe<T>, wo: &[Vec3<T>], wi: &[Vec3<T>]) -> Vec<T> {
    let (a, b): (Directions<Vec<T>>, Directions<Vec<T>>) =
        (wo.iter().copied().collect(), wi.iter().copied().collect());
    let (a, b) = (a.as_slices(), b.as_slices());
    let mut pdf = vec![T::ZERO; wo.len()];
    batched!(lobe, l => Level::best().pdf(l, a, b, &mut pdf).unwrap(), _ => {
        return wo.iter().zip(wi).map(|(&wo, &wi)| lobe.pdf(wo, wi)).collect();
    });
    pdf
}

/// A sample: direction, weight, density, outcome.
type Sample<T> = (Vec3<T>, Rgb<T>, T, u8);

fn expected_samples<T: Real>(
    lobe: &Lobe<T>,
    wo: &[Vec3<T>],
    u: &[Vec3<T>],
    transport: Transport,
) -> Vec<Sample<T>> {
    let n = wo.len();
    let (a, v): (Directions<Vec<T>>, Directions<Vec<T>>) =
        (wo.iter().copied().collect(), u.iter().copied().collect());
    let (a, v) = (a.as_slices(), [&v.x[..], &v.y[..], &v.z[..]]);
    let mut samples = Samples::rejected(n);
    let to = samples.as_mut_slices();
    let level = Level::best();
    if let Lobe::MultibounceConductor(metal) = lobe {
        let mut streams: Vec<_> = (0..n).map(stream).collect();
        (level.sample_random(metal, a, v, &mut streams, to)).unwrap();
    } else {
        batched!(lobe, l => level.sample(l, a, v, transport, to).unwrap(), _ => {
            let one = |(i, (&wo, &u)): (usize, (&Vec3<T>, &Vec3<T>))| {
                let sample = lobe.sample_random(wo, u.to_array(), transport, &mut stream(i));
                sample.map_or((Vec3::ZERO, Rgb::BLACK, T::ZERO, 0), |s| {
                    let code = match s.event {
                        Event::Reflection => 1,
                        Event::Transmission => 2,
                    };
                    (s.wi, s.weight, s.pdf, if s.specular { code + 2 } else { code })
                })
            };
            return wo.iter().zip(u).enumerate().map(one).collect();
        });
    }
    let wi = samples.wi.as_slices();
    let weight = |i: usize| {
        let w = &samples.weight;
        Rgb::from([w.r[i], w.g[i], w.b[i]])
    };
    let outcome = |i: usize| samples.outcome[i] as u8;
    (0..n)
        .map(|i| (wi.get(i).unwrap(), weight(i), samples.pdf[i], outcome(i)))
        .collect()
}

/// Layouts of the two inputs and of the outputs, and threads.
const LAYOUTS: [([usize; 2], usize, u32); 5] = [
    ([1, 1], 1, 1),
    ([3, 3], 3, 0),
    ([5, 1], 4, 3),
    ([0, 3], 1, 2),
    ([3, 0], 7, 1),
];

fn check<T: Precision>(text: &str, lobe: &Lobe<T>, made: &Made, transport: (u32, Transport)) {
    let (code, transport) = transport;
    for (strides, to, threads) in LAYOUTS {
        let said = format!("{text}, strides {strides:?} to {to}");
        let options = options(code, threads);
        let laid = |vectors: &mut [Vec3<T>], stride: usize| {
            if stride == 0 {
                let last = vectors[N - 1];
                vectors.fill(last);
            }
            Rows::new(vectors, stride)
        };
        let (mut wo, mut wi, mut u) = (directions(N, 1), directions(N, 2), uniform(N, 3));
        let [a, b] = strides;
        let (a, b, v) = (laid(&mut wo, a), laid(&mut wi, b), laid(&mut u, b));
        let mut results = Results::<T>::new(to);
        let statuses = T::eval_pdf(made, [&a, &b], &options, &mut results);
        assert_eq!(statuses, [Status::Ok; 3], "{said}: {}", last());
        for (i, (f, pdf)) in expected(lobe, &wo, &wi, transport).into_iter().enumerate() {
            let colour = f.to_array().map(T::bits);
            assert_eq!(results.vectors[0].at(i), colour, "{said}: eval of {i}");
            assert_eq!(results.vectors[1].at(i), colour, "{said}: eval_pdf of {i}");
            assert_eq!(results.numbers[i].bits(), pdf.bits(), "{said}: pdf of {i}");
        }
        let densities = expected_densities(lobe, &wo, &wi);
        for (i, (got, pdf)) in results.densities.iter().zip(densities).enumerate() {
            assert_eq!(got.bits(), pdf.bits(), "{said}: pdf alone of {i}");
        }
        results.assert_untouched_outside();
        let mut results = Results::<T>::new(to);
        let status = T::sample(made, [&a, &v], &options, &mut results);
        assert_eq!(status, Status::Ok, "{said}: {}", last());
        let samples = expected_samples(lobe, &wo, &u, transport);
        for (i, (wi, weight, pdf, outcome)) in samples.into_iter().enumerate() {
            let [got, weighs] = results.vectors.each_ref().map(|v| v.at(i));
            assert_eq!(got, wi.to_array().map(T::bits), "{said}: wi of {i}");
            assert_eq!(
                weighs,
                weight.to_array().map(T::bits),
                "{said}: weight of {i}"
            );
            assert_eq!(
                results.numbers[i].bits(),
                pdf.bits(),
                "{said}: pdf of sample {i}"
            );
            assert_eq!(results.outcomes[i], outcome, "{said}: outcome of {i}");
        }
        results.assert_untouched_outside();
    }
}

#[test]
fn batches_are_those_of_the_library() {
    let transports = [(0, Transport::Radiance), (1, Transport::Importance)];
    for (i, text) in TEXTS.into_iter().enumerate() {
        let made = made(text);
        for transport in transports {
            check::<f32>(text, &known::<f32>()[i], &made, transport);
            check::<f64>(text, &known::<f64>()[i], &made, transport);
        }
    }
}

fn read_measured(file: &Path) -> (Status, *mut LobeHandle) {
    let text = CString::new(file.to_str().unwrap()).unwrap();
    let mut lobe = null_mut();
    // SAFETY: a text that ends with a zero, and room for a pointer.
    let status = unsafe { abi::specula_lobe_measured(text.as_ptr(), &mut lobe) };
    (status, lobe)
}

fn check_measured<T: Precision>(made: &Made, lobe: &Measured<T>) {
    let (wo, wi, u) = (directions(N, 1), directions(N, 2), uniform(N, 3));
    let [a, b, v] = [&wo, &wi, &u].map(|vectors| Rows::new(vectors, 3));
    let options = options(0, 2);
    let mut results = Results::<T>::new(3);
    let statuses = T::eval_pdf(made, [&a, &b], &options, &mut results);
    assert_eq!(statuses, [Status::Ok; 3], "{}", last());
    let mut lit = 0;
    for i in 0..N {
        let (f, pdf) = lobe.eval_pdf(wo[i], wi[i], Transport::Radiance);
        assert_eq!(results.vectors[0].at(i), f.to_array().map(T::bits));
        assert_eq!(results.vectors[1].at(i), f.to_array().map(T::bits));
        let both = [results.numbers[i], results.densities[i]];
        assert_eq!(both.map(T::bits), [pdf.bits(); 2]);
        lit += usize::from(f.max_channel() > T::ZERO);
    }
    assert!(lit > N / 8, "{lit}");
    let mut results = Results::<T>::new(3);
    let status = T::sample(made, [&a, &v], &options, &mut results);
    assert_eq!(status, Status::Ok, "{}", last());
    for i in 0..N {
        let sample = lobe.sample(wo[i], u[i].to_array(), Transport::Radiance);
        let wi = sample.map_or(Vec3::ZERO, |s| s.wi);
        assert_eq!(results.vectors[0].at(i), wi.to_array().map(T::bits));
        assert_eq!(results.outcomes[i], u8::from(sample.is_some()));
    }
}

#[test]
fn measured_materials_are_those_of_the_library() {
    let ggx = Ggx::new(Alpha::isotropic(0.4));
    let metal = RoughConductor::new(ggx, Reflectance::Constant(rgb(0.9, 0.6, 0.3)));
    let size = Resolution {
        theta: 6,
        phi: 1,
        normals: [16, 2],
        colours: 8,
    };
    let tables = tabulate(&ggx, &metal, Symmetry::Isotropic, size);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("metal.bsdf");
    std::fs::write(&file, specula_scene::measured::to_bytes(&tables, "metal")).unwrap();
    let (status, lobe) = read_measured(&file);
    assert_eq!(status, Status::Ok, "{}", last());
    let made = Made(lobe);
    let tables = specula_scene::measured::read_tables(&file).unwrap();
    check_measured::<f32>(&made, &Measured::new(&tables).unwrap());
    check_measured::<f64>(&made, &Measured::new(&tables).unwrap());
    std::fs::write(&file, "tensor_fil").unwrap();
    for (name, words) in [("metal.bsdf", "metal.bsdf: "), ("none.bsdf", "none.bsdf: ")] {
        let (status, lobe) = read_measured(&folder.path().join(name));
        assert_eq!(status, Status::Unreadable);
        assert!(lobe.is_null() && last().contains(words), "{}", last());
    }
}

#[test]
fn outcomes_are_those_of_the_header() {
    let known = [
        SampleOutcome::Rejected as u8,
        SampleOutcome::Reflection as u8,
        SampleOutcome::Transmission as u8,
        SampleOutcome::SpecularReflection as u8,
        SampleOutcome::SpecularTransmission as u8,
    ];
    let header = [
        abi::SPECULA_OUTCOME_REJECTED,
        abi::SPECULA_OUTCOME_REFLECTION,
        abi::SPECULA_OUTCOME_TRANSMISSION,
        abi::SPECULA_OUTCOME_SPECULAR_REFLECTION,
        abi::SPECULA_OUTCOME_SPECULAR_TRANSMISSION,
    ];
    assert_eq!(known, header);
}

#[test]
fn the_first_bad_element_is_named() {
    let lobe = made("lambert");
    for threads in [1, 2, 0] {
        let options = options(0, threads);
        let (mut wo, wi, mut u) = (directions(N, 1), directions(N, 2), uniform(N, 3));
        wo[1200] = vec3(0.0, 0.0, 1.1_f64);
        wo[1201] = vec3(f64::NAN, 0.0, 1.0);
        let laid = [&Rows::new(&wo, 3), &Rows::new(&wi, 1)];
        let statuses = f64::eval_pdf(&lobe, laid, &options, &mut Results::new(1));
        assert_eq!(statuses, [Status::InvalidArgument; 3]);
        assert_eq!(last(), "wo[1200]: expected a unit vector, got (0, 0, 1.1)");
        u[700] = vec3(0.0, 1.0, 0.5);
        let laid = [&Rows::new(&wi, 3), &Rows::new(&u, 3)];
        let status = f64::sample(&lobe, laid, &options, &mut Results::new(3));
        assert_eq!(status, Status::InvalidArgument);
        assert_eq!(
            last(),
            "u[700]: expected numbers in [0, 1), got (0, 1, 0.5)"
        );
    }
}

#[test]
fn many_threads_use_one_lobe() {
    let lobe = &made("multibounce-conductor Au alpha 0.4");
    let (wo, wi) = (directions::<f32>(N, 1), directions::<f32>(N, 2));
    let inputs = &[Rows::new(&wo, 3), Rows::new(&wi, 1)];
    let run = |threads| {
        let mut results = Results::new(3);
        let inputs = inputs.each_ref();
        let statuses = f32::eval_pdf(lobe, inputs, &options(0, threads), &mut results);
        assert_eq!(statuses, [Status::Ok; 3]);
        results.vectors[0].values.clone()
    };
    let alone = run(1);
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|i| scope.spawn(move || run(i % 3))).collect();
        for thread in threads {
            assert!(thread.join().unwrap() == alone);
        }
    });
}

#[test]
fn a_message_is_of_its_thread() {
    // SAFETY: NULL is an error.
    let fail = || unsafe { abi::specula_lobe_parse(null(), null_mut()) };
    assert_eq!(fail(), Status::InvalidArgument);
    let before = last();
    assert!(!before.is_empty());
    std::thread::scope(|scope| {
        scope.spawn(|| assert_eq!(last(), ""));
    });
    assert_eq!(last(), before);
}
