//! Cui et al. 2023, fig. 10 (right): downward flights of light paths.

use glam::DVec3;
use specula_bsdf::math::{Stream, vec3};
use specula_bsdf::ndf::{Beckmann, Ggx};
use specula_bsdf::vndf::VisibleNormals;
use specula_bsdf::{Alpha, Vec3};
use specula_render::RenderOptions;
use specula_scene::Scene;
use specula_scene::scene::{MicrofacetDistribution, Projection};

use super::cui23_walks::{evaluated, sampled};
use crate::output::Table;
use crate::plot::{Axis, Bars, Content, Figure, Panel};
use crate::scenes::statues::{Metal, SET, VASES, decorative_set, vases};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "cui23-fig10-histogram",
    source: Source::Cui23,
    item: "fig. 10, right",
    title: "downward flights of light paths",
    statement: "About 90 % of the light paths on the Vase and DecorativeSet scenes have only one or \
                two directions that point downwards.",
    run,
};

/// Downward flights that are told apart; the last stands for more too.
const MOST: usize = 8;

/// Shares of paths by their downward flights, from one on.
type Shares = [f64; MOST];

/// What was counted in a scene.
struct Counted {
    name: &'static str,
    style: usize,
    sampled: Shares,
    evaluated: Shares,
}

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let size = lab.pick([96, 48], [256, 128]);
    let mut all = Vec::new();
    for (name, style, scene, metals) in [
        ("three vases", 2, vases(size, &[]), &VASES[..]),
        ("decorative set", 1, decorative_set(size, &[]), &SET),
    ] {
        lab.step(0.5 * all.len() as f64, name)?;
        all.push(count(lab, (name, style), &scene, metals)?);
    }
    lab.table(table(&all))?;
    let caption = "Share of light paths by the number of their flights that go down: of paths as they \
                   are sampled, and of those that evaluations connect.";
    lab.plot("histogram", caption, &figure(&all))?;
    Ok(verdict(&all))
}

/// Counts over the pixels that show the metals.
fn count(
    lab: &Lab<'_>,
    (name, style): (&'static str, usize),
    scene: &Scene,
    metals: &[Metal],
) -> Result<Counted> {
    let each = lab.pick(20, 60);
    let mut stream = Stream::new(lab.seed());
    let (mut sampled, mut connected) = ([0.0; MOST], [0.0; MOST]);
    let add = |to: &mut Shares, downward: usize| to[downward.clamp(1, MOST) - 1] += 1.0;
    // The floor is the first shape.
    for (i, metal) in metals.iter().enumerate() {
        for wo in views(lab, scene, i + 1)? {
            for _ in 0..each {
                let alpha = Alpha::isotropic(f64::from(metal.alpha));
                let (one, many) = match metal.distribution {
                    MicrofacetDistribution::Ggx => paths(&Ggx::new(alpha), wo, &mut stream),
                    MicrofacetDistribution::Beckmann => {
                        paths(&Beckmann::new(alpha), wo, &mut stream)
                    }
                };
                add(&mut sampled, one);
                for downward in many {
                    add(&mut connected, downward);
                }
            }
        }
    }
    let shares = |counts: Shares| {
        let all: f64 = counts.iter().sum();
        counts.map(|c| c / all)
    };
    Ok(Counted {
        name,
        style,
        sampled: shares(sampled),
        evaluated: shares(connected),
    })
}

fn paths<N: VisibleNormals<f64>>(
    ndf: &N,
    wo: Vec3<f64>,
    stream: &mut Stream,
) -> (usize, Vec<usize>) {
    (sampled(ndf, wo, stream), evaluated(ndf, wo, stream))
}

/// Local directions to the camera of all pixels that would show the shape if it were alone.
fn views(lab: &Lab<'_>, scene: &Scene, shape: usize) -> Result<Vec<Vec3<f64>>> {
    let mut alone = scene.clone();
    alone.shapes = vec![scene.shapes[shape].clone()];
    let options = RenderOptions {
        samples_per_pixel: 1,
        max_depth: 0,
        seed: lab.render_seed(),
        ..RenderOptions::default()
    };
    let picture = lab.render(&alone, &options)?.picture;
    let half = match alone.camera.projection {
        Projection::Perspective { fov_deg } => (0.5 * fov_deg).to_radians().tan(),
        _ => 0.0,
    };
    let [x0, x1, y0, y1] = alone.camera.screen_window;
    let mut views = Vec::new();
    for y in 0..picture.height {
        for x in 0..picture.width {
            let n = picture.normal[(y * picture.width + x) as usize];
            let n = DVec3::new(f64::from(n.x), f64::from(n.y), f64::from(n.z));
            let across = x0 + (x1 - x0) * (f64::from(x) + 0.5) / f64::from(picture.width);
            let up = y1 - (y1 - y0) * (f64::from(y) + 0.5) / f64::from(picture.height);
            let ray = DVec3::new(half * across, half * up, 1.0);
            let to_camera = -alone.camera.to_world.transform_vector3(ray).normalize();
            let cos = n.normalize_or_zero().dot(to_camera);
            if cos > 0.0 {
                views.push(vec3((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos));
            }
        }
    }
    Ok(views)
}

fn table(all: &[Counted]) -> Table {
    let mut table = Table::new(
        "histogram",
        "Shares of light paths; the last row of each scene holds longer ones too.",
        &["scene", "downward flights", "sampled [%]", "evaluated [%]"],
    );
    for counted in all {
        for (i, n) in (0..MOST).zip(1_u32..) {
            table.push([
                counted.name.into(),
                n.into(),
                (100.0 * counted.sampled[i]).into(),
                (100.0 * counted.evaluated[i]).into(),
            ]);
        }
    }
    table
}

fn figure(all: &[Counted]) -> Figure {
    let panel = |title: &str, shares: fn(&Counted) -> &Shares| {
        let bar = |counted: &Counted| {
            let heights = shares(counted).iter().map(|s| 100.0 * s);
            (counted.name.to_owned(), counted.style, heights.collect())
        };
        Panel {
            title: title.to_owned(),
            x: Axis::linear("downward flights"),
            y: Axis::linear("share of paths [%]").from_to(0.0, 100.0),
            content: Content::Bars(Bars {
                groups: (1..=MOST).map(|n| n.to_string()).collect(),
                bars: all.iter().map(bar).collect(),
            }),
        }
    };
    Figure::grid(
        2,
        vec![
            panel("sampled paths", |c| &c.sampled),
            panel("evaluated paths", |c| &c.evaluated),
        ],
    )
}

fn verdict(all: &[Counted]) -> Verdict {
    let few = |shares: &Shares| 100.0 * (shares[0] + shares[1]);
    let [a, b] = [&all[0], &all[1]];
    let least = all
        .iter()
        .flat_map(|c| [few(&c.sampled), few(&c.evaluated)])
        .fold(100.0, f64::min);
    Verdict {
        summary: format!(
            "One or two downward flights: {:.1} and {:.1} % of sampled paths, {:.1} and {:.1} % of \
             evaluated ones.",
            few(&a.sampled),
            few(&b.sampled),
            few(&a.evaluated),
            few(&b.evaluated)
        ),
        claims: vec![Claim::law(
            "Most light paths have one or two downward flights",
            "about 90 %",
            format!("at least {least:.1} %"),
            least > 85.0,
        )],
        caveat:
            "Vases and statues of our own; views are those of all pixels that show metal. Flights \
                 go down first and up then: a facet that reflects never turns an upward one down."
                .to_owned(),
    }
}
