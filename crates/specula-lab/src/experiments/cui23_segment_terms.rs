//! Three algorithms for the probability of leaving along a path, with a count of their arithmetic: Cui
//! et al. 2023, algorithm 1, Bitterli and d'Eon 2022 (with its signs), and Specula's depth state.
//!
//! A path is given by the rates `|Lambda(d_i)|` of its flights. All three compute the same number,
//! `prod |Lambda(d_i)| S_k`.

/// Flights that go down at most.
pub(super) const MOST: usize = 40;

/// A flight of a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// `|Lambda(d)|`.
    pub(super) rate: f64,
    /// Whether it goes down.
    pub(super) down: bool,
}

/// A growing path.
pub(super) trait Term {
    /// A path that will leave along the rate `out`; without flights yet.
    fn new(out: f64) -> Self;
    /// One flight more; the first goes down.
    fn add(&mut self, step: Step);
    /// The probability.
    fn exit(&self) -> f64;
    /// Additions, multiplications and divisions of [`add`](Term::add) now.
    fn cost_of_adding(&self, step: Step) -> u32;
    /// Those of [`exit`](Term::exit) now.
    fn cost_of_exit(&self) -> u32;
}

/// Algorithm 1 of Cui et al. 2023 and the product of rates, which is not counted: there it is part
/// of the vertex terms.
pub(super) struct Segment {
    out: f64,
    n: usize,
    only_down: bool,
    m: f64,
    rates: f64,
    l: [f64; MOST],
    e: [f64; MOST],
    g: [f64; MOST],
}

impl Term for Segment {
    fn new(out: f64) -> Self {
        let none = [0.0; MOST];
        Self {
            out,
            n: 0,
            only_down: true,
            m: 1.0,
            rates: 1.0,
            l: none,
            e: none,
            g: none,
        }
    }

    #[inline(always)]
    fn add(&mut self, Step { rate, down }: Step) {
        self.rates *= rate;
        if down {
            let n = self.n;
            self.l[n] = rate;
            self.e[n] = 1.0 / (self.out + rate);
            self.g[n] = 0.0;
            self.m *= self.e[n];
            self.n += 1;
            return;
        }
        let last = self.n - 1;
        let start = if self.only_down { 1.0 } else { self.g[last] };
        self.only_down = false;
        self.g[last] = start / (rate + self.l[last]);
        for i in (0..last).rev() {
            self.g[i] = (self.g[i] + self.g[i + 1]) / (rate + self.l[i]);
        }
    }

    #[inline(always)]
    fn exit(&self) -> f64 {
        let s = if self.only_down {
            self.m
        } else {
            (0..self.n)
                .rev()
                .fold(0.0, |s, i| self.e[i] * (s + self.g[i]))
        };
        s * self.rates
    }

    fn cost_of_adding(&self, step: Step) -> u32 {
        // e: 2, m: 1; g: 3 each but for the last, 2.
        if step.down { 3 } else { 3 * count(self.n) - 1 }
    }

    fn cost_of_exit(&self) -> u32 {
        if self.only_down { 0 } else { 2 * count(self.n) }
    }
}

/// Algorithm 5 there, after Bitterli and d'Eon 2022: a sum of exponentials with signs.
pub(super) struct Exponentials {
    out: f64,
    n: usize,
    a: [f64; MOST],
    b: [f64; MOST],
}

impl Term for Exponentials {
    fn new(out: f64) -> Self {
        Self {
            out,
            n: 0,
            a: [0.0; MOST],
            b: [0.0; MOST],
        }
    }

    #[inline(always)]
    fn add(&mut self, Step { rate, down }: Step) {
        let n = self.n;
        let terms = self.a[..n].iter_mut().zip(&self.b[..n]);
        if n == 0 {
            self.a[0] = rate;
            self.b[0] = rate;
            self.n = 1;
        } else if down {
            let mut sum = 0.0;
            for (a, b) in terms {
                *a *= rate / (rate - b);
                sum += *a;
            }
            self.a[n] = -sum;
            self.b[n] = rate;
            self.n += 1;
        } else {
            for (a, b) in terms {
                *a *= rate / (rate + b);
            }
        }
    }

    #[inline(always)]
    fn exit(&self) -> f64 {
        let terms = self.a[..self.n].iter().zip(&self.b[..self.n]);
        terms.map(|(a, b)| a / (b + self.out)).sum()
    }

    fn cost_of_adding(&self, step: Step) -> u32 {
        count(self.n) * if step.down { 4 } else { 3 }
    }

    fn cost_of_exit(&self) -> u32 {
        3 * count(self.n)
    }
}

/// The depth state of Specula.
pub(super) struct Depths {
    out: f64,
    state: Option<specula_bsdf::internal::DepthState<f64>>,
    n: usize,
}

impl Term for Depths {
    fn new(out: f64) -> Self {
        Self {
            out,
            state: None,
            n: 0,
        }
    }

    #[inline(always)]
    fn add(&mut self, Step { rate, down }: Step) {
        match &mut self.state {
            None => self.state = Some(specula_bsdf::internal::DepthState::new(rate)),
            Some(state) if down => {
                // It has room for more than are sampled here.
                if !state.down(rate) {
                    return;
                }
            }
            Some(state) => {
                state.up(rate);
            }
        }
        self.n += usize::from(down);
    }

    #[inline(always)]
    fn exit(&self) -> f64 {
        self.state
            .as_ref()
            .map_or(0.0, |state| state.exit(self.out))
    }

    fn cost_of_adding(&self, step: Step) -> u32 {
        if step.down { 0 } else { 5 * count(self.n) }
    }

    fn cost_of_exit(&self) -> u32 {
        4 * count(self.n)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a few flights")]
fn count(n: usize) -> u32 {
    n as u32
}

/// `prod |Lambda(d_i)| S_k` by the recursion of eq. 14 itself.
pub(super) fn by_recursion(path: &[Step], out: f64) -> f64 {
    let mut all = path.to_vec();
    all.push(Step {
        rate: out,
        down: false,
    });
    segment(&all) * path.iter().map(|s| s.rate).product::<f64>()
}

fn segment(path: &[Step]) -> f64 {
    let (Some(first), Some(last)) = (path.first(), path.last()) else {
        return 0.0;
    };
    if !first.down || last.down {
        return 0.0;
    }
    let inner = if path.len() == 2 {
        1.0
    } else {
        segment(&path[..path.len() - 1]) + segment(&path[1..])
    };
    inner / (first.rate + last.rate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_compute_the_same() {
        let step = |rate, down| Step { rate, down };
        let path = [
            step(1.3, true),
            step(2.1, true),
            step(1.1, true),
            step(0.7, false),
            step(0.2, false),
        ];
        for k in 1..=path.len() {
            let exact = by_recursion(&path[..k], 0.4);
            let close = |found: f64| assert!((found / exact - 1.0).abs() < 1e-12, "{k}");
            close(of::<Segment>(&path[..k]));
            close(of::<Exponentials>(&path[..k]));
            close(of::<Depths>(&path[..k]));
        }
    }

    fn of<T: Term>(path: &[Step]) -> f64 {
        let mut term = T::new(0.4);
        for step in path {
            term.add(*step);
        }
        term.exit()
    }
}
