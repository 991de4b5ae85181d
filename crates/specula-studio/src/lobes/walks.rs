//! `lobes.walks`: random walks of light between the facets of a rough metal, for drawings.
//!
//! The walks are those of Heitz et al. 2016, which alone have heights. The other unbiased models of the library have
//! the same walks with the heights integrated out.
//!
//! In the depth `tau = -ln C1(h)` (`specula-bsdf/src/multibounce/heitz2016.rs`) a ray along `d` meets facets at the
//! rate `sigma(-d) / |d.z|`; one going up is out where `tau < 0`. Results do not depend on the distribution of heights.
//! For drawings they are Gaussian, `h = C1^-1(exp(-tau))`, in standard deviations.

use serde_json::json;
use specula_bsdf::math::{Real, Stream};
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Rgb, Vec3};
use specula_lobes::MetalFacets;
use statrs::function::erf::erfc_inv;

use crate::fields::{Fields, wrong};
use crate::{Answer, AskError};

/// Most walks.
const MOST: u32 = 20_000;
/// Bounces after which a walk ends: as many as `specula-bsdf` has.
const MOST_BOUNCES: usize = 64;
/// Numbers of bounces that are told apart; the last is "more".
const TOLD: usize = 10;

/// Vertices of walks, one walk after the other. The first vertex of each is out of the surface, where light comes in.
#[derive(Default)]
struct Walks {
    offsets: Vec<u32>,
    height: Vec<f32>,
    direction: Vec<f32>,
    weight: Vec<f32>,
    bounces: [u32; TOLD],
}

/// Walks of light that comes from the viewer's direction.
pub(super) fn walks(mut fields: Fields) -> Result<Answer, AskError> {
    let named = super::lobe(&mut fields)?;
    let wo = fields.direction("wo")?;
    let count = fields.count("count", 1, MOST)?;
    let mut stream = Stream::new(fields.seed()?);
    fields.end()?;
    let Some(facets) = named.metal_facets() else {
        let expected =
            "a rough metal (conductor or multibounce-conductor), between whose facets light walks";
        return Err(wrong("lobe", expected, &named.kind().name));
    };
    if wo.z <= 0.0 {
        return Err(wrong(
            "wo",
            "a view above the horizon",
            &format!("z {}", wo.z),
        ));
    }
    let mut walks = Walks::default();
    for _ in 0..count {
        if facets.is_beckmann {
            walks.walk(&Beckmann::new(facets.alpha), &facets, wo, &mut stream);
        } else {
            walks.walk(&Ggx::new(facets.alpha), &facets, wo, &mut stream);
        }
    }
    walks.offsets.push(walks.vertices());
    let shares = walks.bounces.map(|n| f64::from(n) / f64::from(count));
    let n = walks.height.len();
    Ok(Answer::new(json!({ "bounces": shares }))
        .with_u32("offsets", &[walks.offsets.len()], &walks.offsets)
        .with_f32("height", &[n], &walks.height)
        .with_f32("direction", &[n, 3], &walks.direction)
        .with_f32("weight", &[n, 3], &walks.weight))
}

impl Walks {
    fn vertices(&self) -> u32 {
        u32::try_from(self.height.len()).unwrap_or(u32::MAX)
    }

    fn push(&mut self, height: f64, direction: Vec3<f64>, weight: Rgb<f64>) {
        self.height.push(f32::of(height));
        self.direction.extend(direction.to_array().map(f32::of));
        self.weight.extend(weight.to_array().map(f32::of));
    }

    fn walk(
        &mut self,
        ndf: &impl VisibleNormals<f64>,
        facets: &MetalFacets,
        wo: Vec3<f64>,
        stream: &mut Stream,
    ) {
        self.offsets.push(self.vertices());
        let (mut d, mut weight) = (-wo, Rgb::WHITE);
        self.push(f64::INFINITY, d, weight);
        let mut tau = step(ndf, d, stream);
        let mut bounces = 0;
        while bounces < MOST_BOUNCES {
            bounces += 1;
            let wm = ndf.sample_wm(-d, [stream.next(), stream.next()]);
            let along = d.dot(wm);
            weight *= facets.reflectance.eval(-along);
            d -= wm * (2.0 * along);
            self.push(height(tau), d, weight);
            let s = step(ndf, d, stream);
            tau = if d.z > 0.0 { tau - s } else { tau + s };
            if tau < 0.0 {
                break;
            }
        }
        self.bounces[bounces.min(TOLD) - 1] += 1;
    }
}

/// How much depth a ray crosses before it meets a facet.
fn step(ndf: &impl VisibleNormals<f64>, d: Vec3<f64>, stream: &mut Stream) -> f64 {
    let facing = ndf.lambda_cos(d).max(1e-24) + (-d.z).max(0.0);
    -(1.0 - stream.next::<f64>()).ln() * d.z.abs().max(1e-12) / facing
}

/// The height of a depth: the quantile of the standard Gaussian at `exp(-tau)`; within 8 deviations.
fn height(tau: f64) -> f64 {
    let share = (-tau).exp().clamp(1e-15, 1.0 - 1e-15);
    -std::f64::consts::SQRT_2 * erfc_inv(2.0 * share)
}
