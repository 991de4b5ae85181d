//! Loops over blocks of elements, by several threads: structures of arrays for the kernels, whatever the caller's
//! layout.

use specula_bsdf::batch::SampleOutcome;

use crate::failure::Failure;
use crate::lobe::Precision;
use crate::pointers::{Source, Target};

/// Elements of a block: its arrays stay in the first cache.
const BLOCK: usize = 512;

/// What must hold of a vector.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Must {
    BeUnit,
    BeRandom,
}

/// Vectors of the caller, and their argument's name.
pub(super) struct Given<'a, T> {
    name: &'static str,
    vectors: Source<'a, T, 3>,
    must: Must,
}

impl<'a, T> Given<'a, T> {
    pub(super) fn new(name: &'static str, vectors: Source<'a, T, 3>, must: Must) -> Self {
        Self {
            name,
            vectors,
            must,
        }
    }
}

/// Where a call writes; `None`: it has no such result.
pub(super) struct Targets<'a, T> {
    pub(super) vectors: [Option<Target<'a, T, 3>>; 2],
    pub(super) numbers: Option<Target<'a, T, 1>>,
    pub(super) outcomes: Option<Target<'a, u8, 1>>,
}

impl<T> Default for Targets<'_, T> {
    fn default() -> Self {
        Self {
            vectors: [None, None],
            numbers: None,
            outcomes: None,
        }
    }
}

/// A block of elements, one slice per component; those that the call does not write are empty.
pub(super) struct Block<'a, T> {
    /// Index of the first element.
    pub(super) start: usize,
    /// The vectors of each argument.
    pub(super) sources: [[&'a [T]; 3]; 2],
    pub(super) vectors: [[&'a mut [T]; 3]; 2],
    pub(super) numbers: &'a mut [T],
    pub(super) outcomes: &'a mut [SampleOutcome],
}

/// A call over `n` elements.
pub(super) struct Plan<'a, T> {
    pub(super) n: usize,
    /// How many share the work; 0 for all.
    pub(super) threads: usize,
    pub(super) given: [Given<'a, T>; 2],
    pub(super) targets: Targets<'a, T>,
}

impl<T: Precision> Plan<'_, T> {
    /// Runs a kernel.
    pub(super) fn run(&self, kernel: impl Fn(Block<'_, T>) + Sync) -> Result<(), Failure> {
        let n = self.n;
        let threads = match self.threads {
            _ if n <= BLOCK => 1,
            0 => rayon::current_num_threads(),
            threads => threads,
        };
        if threads == 1 {
            return Room::default().range(self, 0, n, &kernel);
        }
        let part = n.div_ceil(threads).next_multiple_of(BLOCK);
        let mut outcomes: Vec<Result<(), Failure>> =
            (0..n.div_ceil(part)).map(|_| Ok(())).collect();
        let kernel = &kernel;
        rayon::scope(|scope| {
            for (i, outcome) in outcomes.iter_mut().enumerate() {
                let (start, end) = (i * part, n.min((i + 1) * part));
                scope.spawn(move |_| *outcome = Room::default().range(self, start, end, kernel));
            }
        });
        // The first part that failed has the first element that breaks a rule.
        outcomes.into_iter().collect()
    }
}

/// One thread's room for a block.
struct Room<T> {
    read: [[Vec<T>; 3]; 2],
    vectors: [[Vec<T>; 3]; 2],
    numbers: Vec<T>,
    outcomes: Vec<SampleOutcome>,
}

impl<T> Default for Room<T> {
    fn default() -> Self {
        Self {
            read: Default::default(),
            vectors: Default::default(),
            numbers: Vec::new(),
            outcomes: Vec::new(),
        }
    }
}

impl<T: Precision> Room<T> {
    fn range(
        mut self,
        plan: &Plan<'_, T>,
        start: usize,
        end: usize,
        kernel: &impl Fn(Block<'_, T>),
    ) -> Result<(), Failure> {
        for from in (start..end).step_by(BLOCK) {
            self.block(plan, from, end.min(from + BLOCK) - from, kernel)?;
        }
        Ok(())
    }

    fn block(
        &mut self,
        plan: &Plan<'_, T>,
        start: usize,
        n: usize,
        kernel: &impl Fn(Block<'_, T>),
    ) -> Result<(), Failure> {
        for (given, room) in plan.given.iter().zip(&mut self.read) {
            let [x, y, z] = room;
            for component in [&mut *x, &mut *y, &mut *z] {
                component.resize(n, T::ZERO);
            }
            given.vectors.read(start, [x, y, z]);
            check(given, [x, y, z], start)?;
        }
        let targets = &plan.targets;
        for (target, room) in targets.vectors.iter().zip(&mut self.vectors) {
            let n = if target.is_some() { n } else { 0 };
            room.iter_mut().for_each(|v| v.resize(n, T::ZERO));
        }
        if targets.numbers.is_some() {
            self.numbers.resize(n, T::ZERO);
        }
        if targets.outcomes.is_some() {
            self.outcomes.resize(n, SampleOutcome::Rejected);
        }
        kernel(Block {
            start,
            sources: self.read.each_ref().map(|v| v.each_ref().map(|c| &c[..])),
            vectors: (self.vectors.each_mut()).map(|v| v.each_mut().map(|c| &mut c[..])),
            numbers: &mut self.numbers,
            outcomes: &mut self.outcomes,
        });
        for (target, room) in targets.vectors.iter().zip(&self.vectors) {
            if let Some(target) = target {
                target.write(start, room.each_ref().map(|c| &c[..]));
            }
        }
        if let Some(target) = &targets.numbers {
            target.write(start, [&self.numbers]);
        }
        if let Some(target) = &targets.outcomes {
            let codes: Vec<u8> = self.outcomes.iter().map(|&o| o as u8).collect();
            target.write(start, [&codes]);
        }
        Ok(())
    }
}

fn check<T: Precision>(
    given: &Given<'_, T>,
    [x, y, z]: [&[T]; 3],
    start: usize,
) -> Result<(), Failure> {
    let holds = |i: usize| match given.must {
        Must::BeUnit => {
            let length2 = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
            (length2 - T::ONE).abs() < T::of(2e-3)
        }
        Must::BeRandom => {
            let holds = |u: T| (u >= T::ZERO) & (u < T::ONE);
            holds(x[i]) & holds(y[i]) & holds(z[i])
        }
    };
    // All of them, without a branch; the culprit is looked for afterwards.
    if (0..x.len()).fold(true, |all, i| all & holds(i)) {
        return Ok(());
    }
    let i = (0..x.len()).find(|&i| !holds(i)).unwrap_or_default();
    let expected = match given.must {
        Must::BeUnit => "a unit vector",
        Must::BeRandom => "numbers in [0, 1)",
    };
    let [x, y, z] = [x[i], y[i], z[i]].map(T::to_f64);
    Err(Failure::invalid(format!(
        "{}[{}]: expected {expected}, got ({x}, {y}, {z})",
        given.name,
        start + i
    )))
}
