//! Vertices of a batch that have a lobe of their own each, of a kind that the library evaluates and samples many at once:
//! they are gathered from all runs.
//!
//! The lobe and its material alone decide whether a vertex is gathered, never the others of its batch: what is computed in
//! vectors may be rounded otherwise.

use core::ops::Range;

use specula_bsdf::batch::{
    Colours, Directions, Each, LengthMismatch, Level, Lobes, PerElement, SampleOutcome, Samples,
};
use specula_bsdf::bsdf::{Gltf, Lobe, Principled, RoughConductor, RoughDielectric};
use specula_bsdf::{Alpha, Transport, Vec3};

use super::estimator;
use super::ray_queue::index;
use super::vertex_batch::{LightSamples, ScatterSamples, Surfaces};
use crate::convert::id;

/// The vertices, by kind of lobe.
#[derive(Default)]
pub(super) struct OwnLobes {
    gltf: Gathered<OfElements<Gltf<f32>>>,
    principled: Gathered<OfElements<Principled<f32>>>,
    metals: ByMaterial<RoughConductor<f32>>,
    glasses: ByMaterial<RoughDielectric<f32>>,
    buffers: Buffers,
}

/// Vertices with lobes of one kind.
#[derive(Default)]
struct Gathered<O> {
    vertices: Vec<u32>,
    own: O,
}

/// Lobes that differ in all that they have.
struct OfElements<L>(Vec<L>);

/// Lobes that differ in their alphas.
struct OfAlphas<L> {
    /// What they have in common.
    lobe: L,
    alpha_x: Vec<f32>,
    alpha_y: Vec<f32>,
    /// Index beyond the surface over that before it.
    eta: f32,
}

/// Lobes that differ in their alphas, of each material and side.
struct ByMaterial<L> {
    groups: Vec<(u32, Gathered<OfAlphas<L>>)>,
    /// How many are in use; the others keep their memory.
    count: usize,
}

/// What the library reads and writes, where the vertices are not in one piece.
#[derive(Default)]
struct Buffers {
    wo: Directions<Vec<f32>>,
    wi: Directions<Vec<f32>>,
    u: [Vec<f32>; 3],
    f_cos: Colours<Vec<f32>>,
    pdf: Vec<f32>,
    samples: Samples<Vec<f32>, Vec<SampleOutcome>>,
}

/// Lobes of gathered vertices.
trait Own {
    /// As the library takes them.
    type Lobes<'l>: Lobes<f32>
    where
        Self: 'l;

    fn lobes(&self) -> Self::Lobes<'_>;

    /// Index of refraction of transmitted samples.
    fn eta(&self) -> f32;
}

impl<L> Default for OfElements<L> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<L> Own for OfElements<L>
where
    for<'l> Each<'l, L>: Lobes<f32>,
{
    type Lobes<'l>
        = Each<'l, L>
    where
        Self: 'l;

    fn lobes(&self) -> Each<'_, L> {
        Each(&self.0)
    }

    fn eta(&self) -> f32 {
        1.0
    }
}

impl<L: Copy> Own for OfAlphas<L>
where
    for<'l> PerElement<'l, f32, L>: Lobes<f32>,
{
    type Lobes<'l>
        = PerElement<'l, f32, L>
    where
        Self: 'l;

    fn lobes(&self) -> PerElement<'_, f32, L> {
        PerElement {
            lobe: self.lobe,
            alpha_x: &self.alpha_x,
            alpha_y: &self.alpha_y,
        }
    }

    fn eta(&self) -> f32 {
        self.eta
    }
}

impl<L> Default for ByMaterial<L> {
    fn default() -> Self {
        Self {
            groups: Vec::new(),
            count: 0,
        }
    }
}

impl<L: Copy> ByMaterial<L> {
    /// * `material`: whose lobes differ from this one in their alphas alone.
    /// * `eta`: as of [`OfAlphas`]; it tells a material's sides apart.
    #[inline]
    fn push(&mut self, i: usize, (material, eta): (u32, f32), lobe: &L, alpha: Alpha<f32>) {
        let mut used = self.groups[..self.count].iter();
        let of_this = |(of, group): &(u32, Gathered<OfAlphas<L>>)| {
            *of == material && group.own.eta.to_bits() == eta.to_bits()
        };
        let at = used.position(of_this).unwrap_or_else(|| {
            let at = self.count;
            self.count += 1;
            if let Some((of, group)) = self.groups.get_mut(at) {
                *of = material;
                group.vertices.clear();
                group.own.alpha_x.clear();
                group.own.alpha_y.clear();
                (group.own.lobe, group.own.eta) = (*lobe, eta);
            } else {
                let own = OfAlphas {
                    lobe: *lobe,
                    alpha_x: Vec::new(),
                    alpha_y: Vec::new(),
                    eta,
                };
                let vertices = Vec::new();
                self.groups.push((material, Gathered { vertices, own }));
            }
            at
        });
        let group = &mut self.groups[at].1;
        group.vertices.push(id(i));
        group.own.alpha_x.push(alpha.x);
        group.own.alpha_y.push(alpha.y);
    }

    /// Those in use.
    fn used(&self) -> impl Iterator<Item = &Gathered<OfAlphas<L>>> {
        self.groups[..self.count].iter().map(|(_, group)| group)
    }
}

impl<L> Gathered<OfElements<L>> {
    fn clear(&mut self) {
        self.vertices.clear();
        self.own.0.clear();
    }

    #[inline]
    fn push(&mut self, i: usize, lobe: L) {
        self.vertices.push(id(i));
        self.own.0.push(lobe);
    }
}

impl OwnLobes {
    pub(super) fn clear(&mut self) {
        self.gltf.clear();
        self.principled.clear();
        self.metals.count = 0;
        self.glasses.count = 0;
    }

    /// Takes a vertex, if its lobe is of a kind that is gathered.
    ///
    /// * `i`: index of the vertex.
    /// * `material`: that of the lobe, where lobes of it differ in their alphas alone.
    #[inline]
    pub(super) fn push(&mut self, i: usize, lobe: &Lobe<f32>, material: Option<u32>) -> bool {
        match (lobe, material) {
            (Lobe::Gltf(gltf), _) if !gltf.transmits() => self.gltf.push(i, *gltf),
            (Lobe::Principled(lobe), _) if !lobe.transmits() => self.principled.push(i, *lobe),
            (Lobe::RoughConductor(metal), Some(of)) => {
                self.metals.push(i, (of, 1.0), metal, metal.alpha());
            }
            (Lobe::RoughDielectric(glass), Some(of)) => {
                (self.glasses).push(i, (of, glass.eta()), glass, glass.alpha());
            }
            _ => return false,
        }
        true
    }

    /// Evaluates the lobes towards light samples.
    pub(super) fn evaluate(&mut self, s: &Surfaces, a: &mut LightSamples) {
        let buffers = &mut self.buffers;
        self.gltf.evaluate(buffers, s, a);
        self.principled.evaluate(buffers, s, a);
        self.metals.used().for_each(|g| g.evaluate(buffers, s, a));
        self.glasses.used().for_each(|g| g.evaluate(buffers, s, a));
    }

    /// Samples the lobes.
    ///
    /// * `u`: random numbers of all vertices.
    pub(super) fn sample(&mut self, s: &Surfaces, u: [&[f32]; 3], scatter: &mut ScatterSamples) {
        let b = &mut self.buffers;
        self.gltf.sample(b, s, u, scatter);
        self.principled.sample(b, s, u, scatter);
        (self.metals.used()).for_each(|group| group.sample(b, s, u, scatter));
        (self.glasses.used()).for_each(|group| group.sample(b, s, u, scatter));
    }
}

impl<O: Own> Gathered<O> {
    /// The vertices as a range, where they are one.
    fn range(&self) -> Option<Range<usize>> {
        let (first, last) = (*self.vertices.first()?, *self.vertices.last()?);
        let end = index(last) + 1;
        (end - index(first) == self.vertices.len()).then_some(index(first)..end)
    }

    fn evaluate(&self, buffers: &mut Buffers, s: &Surfaces, a: &mut LightSamples) {
        let lobes = self.own.lobes();
        let (level, radiance) = (Level::best(), Transport::Radiance);
        let n = self.vertices.len();
        if let Some(range) = self.range() {
            let wo = s.wo.directions(range.clone());
            let wi = a.wi.directions(range.clone());
            let f_cos = a.f_cos.colours_mut(range.clone());
            let pdf = &mut a.lobe_pdf[range];
            done(level.eval_pdf(&lobes, wo, wi, radiance, f_cos, pdf));
        } else if n > 0 {
            buffers.gather(&self.vertices, s);
            for (k, &i) in self.vertices.iter().enumerate() {
                set(&mut buffers.wi, k, a.wi.get(index(i)));
            }
            let Buffers {
                wo, wi, f_cos, pdf, ..
            } = buffers;
            let (wo, wi) = (first(wo, n), first(wi, n));
            let values = first_colours(f_cos, n);
            done(level.eval_pdf(&lobes, wo, wi, radiance, values, &mut pdf[..n]));
            for (k, &i) in self.vertices.iter().enumerate() {
                let i = index(i);
                a.f_cos.set_array(i, &[f_cos.r[k], f_cos.g[k], f_cos.b[k]]);
                a.lobe_pdf[i] = pdf[k];
            }
        }
    }

    fn sample(
        &self,
        buffers: &mut Buffers,
        s: &Surfaces,
        u: [&[f32]; 3],
        scatter: &mut ScatterSamples,
    ) {
        let lobes = self.own.lobes();
        let (level, radiance) = (Level::best(), Transport::Radiance);
        let n = self.vertices.len();
        if let Some(range) = self.range() {
            let wo = s.wo.directions(range.clone());
            let samples = Samples {
                wi: scatter.wi.directions_mut(range.clone()),
                weight: scatter.weight.colours_mut(range.clone()),
                pdf: &mut scatter.pdf[range.clone()],
                outcome: &mut scatter.outcome[range.clone()],
            };
            let u = u.map(|u| &u[range.clone()]);
            done(level.sample(&lobes, wo, u, radiance, samples));
        } else if n > 0 {
            buffers.gather(&self.vertices, s);
            for (to, from) in buffers.u.iter_mut().zip(u) {
                to.clear();
                to.extend(self.vertices.iter().map(|&i| from[index(i)]));
            }
            let Buffers { wo, u, samples, .. } = buffers;
            let u = u.each_ref().map(|u| &u[..]);
            let all = first_samples(samples, n);
            done(level.sample(&lobes, first(wo, n), u, radiance, all));
            let (wi, weight) = (&samples.wi, &samples.weight);
            for (k, &i) in self.vertices.iter().enumerate() {
                let i = index(i);
                scatter.wi.set_array(i, &[wi.x[k], wi.y[k], wi.z[k]]);
                let weight = [weight.r[k], weight.g[k], weight.b[k]];
                scatter.weight.set_array(i, &weight);
                scatter.pdf[i] = samples.pdf[k];
                scatter.outcome[i] = samples.outcome[k];
            }
        }
        self.set_eta(scatter);
    }

    /// Sets what samples say of indices of refraction.
    fn set_eta(&self, scatter: &mut ScatterSamples) {
        let beyond = self.own.eta();
        for &i in &self.vertices {
            let i = index(i);
            let is_transmitted = scatter.outcome[i] == SampleOutcome::Transmission;
            scatter.eta[i] = if is_transmitted { beyond } else { 1.0 };
            if is_transmitted {
                scatter.eta_scale[i] = estimator::eta_scale_after(scatter.eta_scale[i], beyond);
            }
        }
    }
}

impl Buffers {
    /// Makes room for vertices, and gathers the directions towards their viewers.
    fn gather(&mut self, vertices: &[u32], s: &Surfaces) {
        let n = vertices.len();
        if self.pdf.len() < n {
            self.wo = Directions::zeroed(n);
            self.wi = Directions::zeroed(n);
            self.f_cos = Colours::zeroed(n);
            self.pdf = vec![0.0; n];
            self.samples = Samples::rejected(n);
        }
        for (k, &i) in vertices.iter().enumerate() {
            set(&mut self.wo, k, s.wo.get(index(i)));
        }
    }
}

/// The first `n` of columns.
fn first(directions: &Directions<Vec<f32>>, n: usize) -> Directions<&[f32]> {
    Directions {
        x: &directions.x[..n],
        y: &directions.y[..n],
        z: &directions.z[..n],
    }
}

fn first_colours(colours: &mut Colours<Vec<f32>>, n: usize) -> Colours<&mut [f32]> {
    Colours {
        r: &mut colours.r[..n],
        g: &mut colours.g[..n],
        b: &mut colours.b[..n],
    }
}

fn first_samples(
    samples: &mut Samples<Vec<f32>, Vec<SampleOutcome>>,
    n: usize,
) -> Samples<&mut [f32], &mut [SampleOutcome]> {
    Samples {
        wi: Directions {
            x: &mut samples.wi.x[..n],
            y: &mut samples.wi.y[..n],
            z: &mut samples.wi.z[..n],
        },
        weight: first_colours(&mut samples.weight, n),
        pdf: &mut samples.pdf[..n],
        outcome: &mut samples.outcome[..n],
    }
}

#[inline(always)]
fn set(directions: &mut Directions<Vec<f32>>, k: usize, w: Vec3<f32>) {
    [directions.x[k], directions.y[k], directions.z[k]] = [w.x, w.y, w.z];
}

fn done(outcome: Result<(), LengthMismatch>) {
    debug_assert_eq!(outcome, Ok(()), "all slices are as long");
}
