//! Rays alone: traversal of the tree, and the GPU's ray queries.

use std::time::Instant;

use specula_bsdf::math::Stream;
use specula_gpu::{Gpu, RayCaster, RayWords, Rays};
use specula_render::{FlatGroup, FlatInstance, PreparedScene, RenderOptions};

use super::scenes::{Subject, subjects};
use super::text::{figure, row, table};
use super::{Effort, Result};
use crate::experiments::stopwatch::median;

/// Rays that are cast at once.
const COUNT: usize = 1 << 20;
/// The same in quick runs.
const FEW: usize = 1 << 12;
/// Never reached.
const FARTHEST: f32 = 3e38;

/// Millions of rays per second between points of the scenes: no two neighbours go the same way.
pub(super) fn rays(gpu: &Gpu, effort: &Effort<'_>) -> Result<String> {
    let mut rows = vec![row([
        "scene",
        "rays",
        "triangles",
        "first hits: Mrays/s",
        "any hit: Mrays/s",
        "share that hits",
    ])];
    for subject in subjects(effort.quick, &[]) {
        effort.go_on()?;
        for rays in [Rays::Tree, Rays::Query] {
            if rays == Rays::Tree || gpu.has_ray_queries() {
                rows.push(speed(gpu, effort, &subject, rays)?);
            }
        }
    }
    Ok(format!(
        "## Rays alone\n\n\
         {} rays between random points of the surfaces, beginning beside them, so that neighbours go different ways. \
         Medians of {} rounds.\n\n{}",
        count(effort),
        effort.render_rounds,
        table(&rows)
    ))
}

fn count(effort: &Effort<'_>) -> usize {
    if effort.quick { FEW } else { COUNT }
}

fn speed(gpu: &Gpu, effort: &Effort<'_>, subject: &Subject, rays: Rays) -> Result<Vec<String>> {
    let scene = subject.load()?;
    let prepared = PreparedScene::new(&scene, &RenderOptions::from_scene(&scene))?;
    let caster = RayCaster::new(gpu, &prepared, rays)?;
    let (groups, instances) = prepared.groups();
    let triangles: usize = groups.iter().map(|group| group.triangles.len()).sum();
    let mut cells = row([&subject.name, &rays.to_string(), &triangles.to_string()]);
    let mut share = 0.0;
    for any in [false, true] {
        let list = between(&groups, &instances, count(effort), any);
        let batch = caster.upload(&list)?;
        caster.cast(&batch)?;
        let hits = caster.hits(&batch)?;
        let there = hits.iter().filter(|hit| hit.instance.is_some());
        share = there.count() as f64 / list.len() as f64;
        let mut times = Vec::new();
        for _ in 0..effort.render_rounds {
            let start = Instant::now();
            caster.cast(&batch)?;
            times.push(start.elapsed().as_secs_f64());
        }
        cells.push(figure(1e-6 * list.len() as f64 / median(times)));
    }
    cells.push(format!("{:.1} %", 100.0 * share));
    Ok(cells)
}

/// Rays from beside a random point of the surfaces to another.
fn between(
    groups: &[FlatGroup<'_>],
    instances: &[FlatInstance],
    count: usize,
    any: bool,
) -> Vec<RayWords> {
    let mut stream = Stream::new(1);
    let one = |_| {
        let [a, b] = [(); 2].map(|()| point(groups, instances, &mut stream));
        let d: [f32; 3] = std::array::from_fn(|i| b[i] - a[i]);
        // A thousandth of the way, turned: off the surface.
        let [x, y, z] = [0, 1, 2].map(|i: usize| a[i] + 1e-3 * d[(i + 1) % 3]);
        [
            x,
            y,
            z,
            d[0],
            d[1],
            d[2],
            FARTHEST,
            f32::from(u8::from(any)),
        ]
    };
    (0..count).map(one).collect()
}

/// A point of a triangle or of a box about a sphere or disk, in the world.
fn point(groups: &[FlatGroup<'_>], instances: &[FlatInstance], stream: &mut Stream) -> [f32; 3] {
    let instance = &instances[below(instances.len(), stream)];
    let group = &groups[instance.group as usize];
    let at = below(group.triangles.len() + group.boxes.len(), stream);
    let [mut u, mut v, w]: [f32; 3] = [(); 3].map(|()| stream.next());
    let local: [f32; 3] = match group.triangles.get(at) {
        Some(triangle) => {
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b, c] = triangle.map(|corner| group.positions[corner as usize]);
            std::array::from_fn(|i| a[i] + u * (b[i] - a[i]) + v * (c[i] - a[i]))
        }
        None => {
            let bounds = &group.boxes[at - group.triangles.len()];
            let share = [u, v, w];
            std::array::from_fn(|i| bounds.min[i] + share[i] * (bounds.max[i] - bounds.min[i]))
        }
    };
    instance
        .to_world
        .map(|[x, y, z, d]| x * local[0] + y * local[1] + z * local[2] + d)
}

fn below(count: usize, stream: &mut Stream) -> usize {
    let share: f64 = stream.next();
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below `count`"
    )]
    let place = (share * count as f64) as usize;
    place.min(count - 1)
}
