//! Rays at a scene's shapes, by seeds.

use glam::{Mat4, Vec3};
use specula_bsdf::math::Stream;
use specula_render::{FlatGroup, FlatInstance, PreparedScene};

/// A ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    origin: Vec3,
    direction: Vec3,
    t_max: f32,
    /// Whether any hit will do.
    pub(crate) any: bool,
}

impl Ray {
    pub(crate) fn words(&self) -> [f32; 8] {
        let ([a, b, c], [d, e, f]) = (self.origin.to_array(), self.direction.to_array());
        [a, b, c, d, e, f, self.t_max, f32::from(u8::from(self.any))]
    }
}

/// What rays are sent to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    /// Triangles, quadrics and what is beside these.
    Faces,
    /// Edges and corners of triangles, as exactly as `f32` has them.
    Edges,
}

/// Never reached.
const FARTHEST: f32 = 3e38;

/// Random numbers by a seed.
struct Random(Stream);

impl Random {
    fn new(seed: u64) -> Self {
        Self(Stream::new(seed))
    }

    fn number(&mut self) -> f32 {
        self.0.next()
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number below `count`"
    )]
    fn below(&mut self, count: usize) -> usize {
        ((f64::from(self.number()) * count as f64) as usize).min(count - 1)
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::from([(); 3].map(|()| 2.0 * self.number() - 1.0))
    }
}

fn placed(instance: &FlatInstance) -> Mat4 {
    let [a, b, c] = instance.to_world;
    Mat4::from_cols_array_2d(&[a, b, c, [0.0, 0.0, 0.0, 1.0]]).transpose()
}

/// A point of a shape in the world.
fn point(
    groups: &[FlatGroup<'_>],
    instances: &[FlatInstance],
    aim: Aim,
    random: &mut Random,
) -> Vec3 {
    let meshes = |i: &&FlatInstance| !groups[i.group as usize].triangles.is_empty();
    let with_edges: Vec<&FlatInstance> = instances.iter().filter(meshes).collect();
    let instance = match aim {
        Aim::Faces => &instances[random.below(instances.len())],
        Aim::Edges => with_edges[random.below(with_edges.len())],
    };
    let group = &groups[instance.group as usize];
    let boxes = match aim {
        Aim::Faces => group.boxes.len(),
        Aim::Edges => 0,
    };
    // As if there were a few triangles only: quadrics have their turn.
    let triangles = group.triangles.len().min(4);
    let at = random.below(triangles + boxes);
    let local = if at < triangles {
        let triangle = group.triangles[random.below(group.triangles.len())];
        let [a, b, c] = triangle.map(|v| Vec3::from(group.positions[v as usize]));
        let [u, v] = [random.number(), random.number()];
        match (aim, random.below(2)) {
            (Aim::Edges, 0) => a,
            (Aim::Edges, _) => a + u * (b - a),
            _ if u + v < 1.0 => a + u * (b - a) + v * (c - a),
            _ => a + (1.0 - u) * (b - a) + (1.0 - v) * (c - a),
        }
    } else {
        let bounds = &group.boxes[at - triangles];
        let (low, high) = (Vec3::from(bounds.min), Vec3::from(bounds.max));
        0.5 * (low + high) + 0.55 * (high - low) * random.vector()
    };
    placed(instance).transform_point3(local)
}

/// Rays from between and around the shapes to points of them: directions of any length, closest hits and
/// any, some with an end.
pub(crate) fn towards(scene: &PreparedScene, aim: Aim, count: usize, seed: u64) -> Vec<Ray> {
    let (groups, instances) = scene.groups();
    let mut random = Random::new(seed);
    let one = |_| {
        let target = point(&groups, &instances, aim, &mut random);
        let [a, b] = [(); 2].map(|()| point(&groups, &instances, aim, &mut random));
        // Beside another point, not on it: rays that begin on a surface are no question to either.
        let origin =
            b + (0.1 + random.number()) * (b - a + (target - b).length() * random.vector());
        let length = 4.0_f32.powf(4.0 * random.number() - 2.0);
        Ray {
            origin,
            direction: length * (target - origin),
            t_max: match random.below(4) {
                0 => 1.5 * random.number() / length,
                _ => FARTHEST,
            },
            any: random.below(4) == 0,
        }
    };
    (0..count).map(one).collect()
}

/// Rays from about the middle of the first instance to points of it, along axes, and anywhere.
pub(crate) fn from_within(scene: &PreparedScene, aim: Aim, count: usize, seed: u64) -> Vec<Ray> {
    let (groups, instances) = scene.groups();
    let middle = placed(&instances[0]);
    let mut random = Random::new(seed);
    let one = |_| {
        let origin = middle.transform_point3(0.3 * random.vector());
        let direction = match random.below(4) {
            0 if aim == Aim::Faces => random.vector(),
            1 if aim == Aim::Faces => [Vec3::X, Vec3::NEG_Y, Vec3::Z][random.below(3)],
            _ => point(&groups, &instances, aim, &mut random) - origin,
        };
        Ray {
            origin,
            direction,
            t_max: FARTHEST,
            any: random.below(4) == 0,
        }
    };
    (0..count).map(one).collect()
}
