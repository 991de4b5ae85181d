//! Loops over blocks of elements, by several threads: structures of arrays for the kernels, whatever the caller's layout.

use macro_rules_attribute::apply;
use pyo3::prelude::*;
use specula_bsdf::batch::SampleOutcome;

use crate::arrays::{Input, Must, Output, Scalar, Source};
use crate::parameters::invalid;

/// Elements of a block: its arrays stay in the first cache.
const BLOCK: usize = 512;

/// What a call writes; a kernel leaves alone what it has no use for, which is empty.
#[derive(Default)]
pub(crate) struct Outputs<'a, T> {
    pub(crate) vectors: [Option<Output<'a, T>>; 2],
    pub(crate) numbers: Option<&'a mut [T]>,
    pub(crate) outcomes: Option<&'a mut [u8]>,
}

impl<T> Outputs<'_, T> {
    fn split(self, n: usize) -> [Self; 2] {
        let [a, b] = self.vectors;
        let (a, a_rest) = halves(a.map(|v| v.split(n)));
        let (b, b_rest) = halves(b.map(|v| v.split(n)));
        let (numbers, numbers_rest) = halves(self.numbers.map(|v| v.split_at_mut(n).into()));
        let (outcomes, outcomes_rest) = halves(self.outcomes.map(|v| v.split_at_mut(n).into()));
        [
            Outputs {
                vectors: [a, b],
                numbers,
                outcomes,
            },
            Outputs {
                vectors: [a_rest, b_rest],
                numbers: numbers_rest,
                outcomes: outcomes_rest,
            },
        ]
    }
}

fn halves<V>(both: Option<[V; 2]>) -> (Option<V>, Option<V>) {
    both.map_or((None, None), |[a, b]| (Some(a), Some(b)))
}

/// A block of elements, one slice per component.
pub(crate) struct Block<'a, T> {
    /// Index of the first element.
    pub(crate) start: usize,
    /// The vectors of each source.
    pub(crate) sources: [[&'a [T]; 3]; 2],
    pub(crate) vectors: [[&'a mut [T]; 3]; 2],
    pub(crate) numbers: &'a mut [T],
    pub(crate) outcomes: &'a mut [SampleOutcome],
}

/// An element that breaks a rule.
struct Broken {
    index: usize,
    name: &'static str,
    must: Must,
    found: [f64; 3],
}

/// Runs a kernel over `n` elements.
///
/// * `threads`: how many share the work; 0 for all.
pub(crate) fn run<T: Scalar>(
    py: Python<'_>,
    n: usize,
    threads: usize,
    sources: &[Source<'_, T>; 2],
    outputs: Outputs<'_, T>,
    kernel: impl Fn(Block<'_, T>) + Sync,
) -> PyResult<()> {
    let kernel = &kernel;
    let outcome = if n <= BLOCK {
        // Handing the interpreter over costs more than so few elements.
        Job::new(sources).run(0, n, outputs, kernel)
    } else {
        py.detach(|| shared(n, threads, sources, outputs, kernel))
    };
    outcome.map_err(|broken| {
        let Broken {
            index,
            name,
            must,
            found: [x, y, z],
        } = broken;
        let expected = match must {
            Must::Unit => "a unit vector",
            Must::Random | Must::RandomPair => "numbers in [0, 1)",
        };
        invalid(format!(
            "{name}[{index}]: expected {expected}, got ({x}, {y}, {z})"
        ))
    })
}

fn shared<T: Scalar>(
    n: usize,
    threads: usize,
    sources: &[Source<'_, T>; 2],
    outputs: Outputs<'_, T>,
    kernel: &(impl Fn(Block<'_, T>) + Sync),
) -> Result<(), Broken> {
    let threads = if threads == 0 {
        rayon::current_num_threads()
    } else {
        threads
    };
    if threads == 1 {
        return Job::new(sources).run(0, n, outputs, kernel);
    }
    let part = n.div_ceil(threads).next_multiple_of(BLOCK);
    let parts = n.div_ceil(part);
    let mut outcomes: Vec<Result<(), Broken>> = (0..parts).map(|_| Ok(())).collect();
    rayon::scope(|scope| {
        let mut rest = outputs;
        for (i, outcome) in outcomes.iter_mut().enumerate() {
            let (start, end) = (i * part, n.min((i + 1) * part));
            let [here, after] = rest.split(end - start);
            rest = after;
            scope.spawn(move |_| *outcome = Job::new(sources).run(start, end, here, kernel));
        }
    });
    outcomes.into_iter().collect()
}

/// One thread's part, with room for a block.
struct Job<'a, T> {
    sources: &'a [Source<'a, T>; 2],
    read: [[Vec<T>; 3]; 2],
    written: [[Vec<T>; 3]; 2],
    outcomes: Vec<SampleOutcome>,
}

impl<'a, T: Scalar> Job<'a, T> {
    fn new(sources: &'a [Source<'a, T>; 2]) -> Self {
        Self {
            sources,
            read: Default::default(),
            written: Default::default(),
            outcomes: Vec::new(),
        }
    }

    fn run(
        mut self,
        start: usize,
        end: usize,
        outputs: Outputs<'_, T>,
        kernel: &impl Fn(Block<'_, T>),
    ) -> Result<(), Broken> {
        let mut rest = outputs;
        for from in (start..end).step_by(BLOCK) {
            let to = end.min(from + BLOCK);
            let [here, after] = rest.split(to - from);
            rest = after;
            self.block(from, to, here, kernel)?;
        }
        Ok(())
    }

    fn block(
        &mut self,
        from: usize,
        to: usize,
        outputs: Outputs<'_, T>,
        kernel: &impl Fn(Block<'_, T>),
    ) -> Result<(), Broken> {
        let n = to - from;
        let [a, b] = &mut self.read;
        let sources = [
            gathered(&self.sources[0], from, to, a),
            gathered(&self.sources[1], from, to, b),
        ];
        let Outputs {
            vectors: [mut first, mut second],
            numbers,
            outcomes,
        } = outputs;
        if outcomes.is_some() {
            self.outcomes.resize(n, SampleOutcome::Rejected);
        }
        let [a, b] = &mut self.written;
        kernel(Block {
            start: from,
            sources,
            vectors: [room(&mut first, a, n), room(&mut second, b, n)],
            numbers: numbers.unwrap_or_default(),
            outcomes: &mut self.outcomes[..],
        });
        // Afterwards: the kernel has read the block into the cache while it computed.
        for (source, vectors) in self.sources.iter().zip(&sources) {
            check(source, vectors, from)?;
        }
        scatter(first, &self.written[0]);
        scatter(second, &self.written[1]);
        if let Some(outcomes) = outcomes {
            for (to, from) in outcomes.iter_mut().zip(&self.outcomes) {
                *to = *from as u8;
            }
        }
        Ok(())
    }
}

/// A block of vectors, one slice per component: those of the array itself where they are so.
fn gathered<'a, T: Scalar>(
    source: &Source<'a, T>,
    from: usize,
    to: usize,
    room: &'a mut [Vec<T>; 3],
) -> [&'a [T]; 3] {
    let n = to - from;
    match source.vectors {
        Input::Columns(columns) => return columns.map(|c| &c[from..to]),
        Input::One(vector) => {
            for (component, value) in room.iter_mut().zip(vector) {
                component.resize(n, value);
            }
        }
        Input::Rows(rows) => {
            let [x, y, z] = room;
            for component in [&mut *x, &mut *y, &mut *z] {
                component.resize(n, T::ZERO);
            }
            let (rows, _) = rows[3 * from..3 * to].as_chunks::<3>();
            for (i, row) in rows.iter().enumerate() {
                [x[i], y[i], z[i]] = *row;
            }
        }
    }
    let [x, y, z] = room;
    [&x[..n], &y[..n], &z[..n]]
}

/// Where a kernel writes a block of vectors.
fn room<'a, T: Scalar>(
    output: &'a mut Option<Output<'_, T>>,
    room: &'a mut [Vec<T>; 3],
    n: usize,
) -> [&'a mut [T]; 3] {
    match output {
        None => Default::default(),
        Some(Output::Columns([x, y, z])) => [&mut **x, &mut **y, &mut **z],
        Some(Output::Rows(_)) => {
            for component in room.iter_mut() {
                component.resize(n, T::ZERO);
            }
            let [x, y, z] = room;
            [&mut x[..n], &mut y[..n], &mut z[..n]]
        }
    }
}

/// Moves a block of vectors to rows.
fn scatter<T: Scalar>(output: Option<Output<'_, T>>, [x, y, z]: &[Vec<T>; 3]) {
    if let Some(Output::Rows(rows)) = output {
        let (rows, _) = rows.as_chunks_mut::<3>();
        for (i, row) in rows.iter_mut().enumerate() {
            *row = [x[i], y[i], z[i]];
        }
    }
}

/// Compiles a function for AVX-512, for AVX2 and for the baseline; the machine's best is called.
macro_rules! simd_levels {
    ($($function:tt)*) => {
        #[multiversion::multiversion(targets(
            "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
            "x86_64+avx2+fma+bmi1+bmi2"
        ))]
        $($function)*
    };
}

#[inline(always)]
fn is_unit<T: Scalar>(x: T, y: T, z: T) -> bool {
    let length2 = x * x + y * y + z * z;
    (length2 - T::ONE).abs() < T::of(2e-3)
}

#[inline(always)]
fn is_random<T: Scalar>(x: T, y: T, z: T) -> bool {
    let holds = |u: T| (u >= T::ZERO) & (u < T::ONE);
    holds(x) & holds(y) & holds(z)
}

/// Whether all vectors are unit, without a branch.
#[apply(simd_levels)]
fn all_unit<T: Scalar>(x: &[T], y: &[T], z: &[T]) -> bool {
    let mut broken = 0_u32;
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        broken |= u32::from(!is_unit(*x, *y, *z));
    }
    broken == 0
}

/// Whether all numbers are random ones, without a branch.
#[apply(simd_levels)]
fn all_random<T: Scalar>(x: &[T], y: &[T], z: &[T]) -> bool {
    let mut broken = 0_u32;
    for ((x, y), z) in x.iter().zip(y).zip(z) {
        broken |= u32::from(!is_random(*x, *y, *z));
    }
    broken == 0
}

fn check<T: Scalar>(
    source: &Source<'_, T>,
    [x, y, z]: &[&[T]; 3],
    from: usize,
) -> Result<(), Broken> {
    let Source { name, must, .. } = *source;
    let (all, holds): (bool, fn(T, T, T) -> bool) = match must {
        Must::Unit => (all_unit(x, y, z), is_unit),
        Must::Random => (all_random(x, y, z), is_random),
        Must::RandomPair => (all_random(y, y, z), |_, y, z| is_random(y, y, z)),
    };
    if all {
        return Ok(());
    }
    match (0..x.len()).find(|&i| !holds(x[i], y[i], z[i])) {
        None => Ok(()),
        Some(i) => Err(Broken {
            index: from + i,
            name,
            must,
            found: [x[i], y[i], z[i]].map(T::to_f64),
        }),
    }
}
