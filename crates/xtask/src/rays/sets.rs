//! Sets of rays: what a path tracer asks for.

use std::f32::consts::TAU;

use specula_bsdf::math::vec3;
use specula_bsdf::{Frame, Vec3};
use specula_render::accel::{Accel, Hit, Ray};

use super::meshes::Mesh;

/// Side of the picture that camera rays make.
const SIDE: u16 = 512;
/// Side of the squares in which they come, a batch each.
const TILE: u16 = 16;
/// Rays of a batch.
pub(super) const BATCH: usize = 256;
const CAMERA: Vec3<f32> = Vec3 {
    x: 0.3,
    y: -0.2,
    z: 0.1,
};
const LAMP: Vec3<f32> = Vec3 {
    x: -0.4,
    y: 0.3,
    z: 0.35,
};

/// Rays of one kind.
pub(super) struct Set {
    /// As the peer calls it.
    pub(super) name: &'static str,
    pub(super) what: &'static str,
    /// Whether any hit will do.
    pub(super) any: bool,
    pub(super) rays: Vec<Ray>,
}

/// Four kinds of rays within a closed mesh.
pub(super) fn sets(mesh: &Mesh, accel: &Accel) -> Vec<Set> {
    let camera = camera();
    let mut random = Random(1);
    let at: Vec<_> = hits(accel, &camera).collect();
    let bounce: Vec<Ray> = at
        .iter()
        .map(|(ray, hit)| onward(mesh, ray, hit, &mut random, f32::INFINITY))
        .collect();
    let shadow = at.iter().map(|(ray, hit)| {
        let origin = leave(mesh, ray, hit);
        Ray {
            origin,
            direction: LAMP - origin,
            t_max: 0.999,
        }
    });
    let shadow = shadow.collect();
    let ambient = hits(accel, &bounce)
        .map(|(ray, hit)| onward(mesh, &ray, &hit, &mut random, 0.5))
        .collect();
    let set = |name, what, any, rays| Set {
        name,
        what,
        any,
        rays,
    };
    vec![
        set("camera", "camera, closest hit", false, camera),
        set("bounce", "bounce, closest hit", false, bounce),
        set("shadow", "towards a lamp, any hit", true, shadow),
        set("ambient", "bounce to half a radius, any hit", true, ambient),
    ]
}

/// A wide pinhole, square by square.
fn camera() -> Vec<Ray> {
    let tiles = SIDE / TILE;
    let centre = |i: u16| (f32::from(i) + 0.5) / f32::from(SIDE) * 2.0 - 1.0;
    (0..tiles * tiles)
        .flat_map(|tile| (0..TILE * TILE).map(move |i| (tile, i)))
        .map(|(tile, i)| {
            let x = tile % tiles * TILE + i % TILE;
            let y = tile / tiles * TILE + i / TILE;
            Ray {
                origin: CAMERA,
                direction: vec3(centre(x), centre(y), 1.0).normalize(),
                t_max: f32::INFINITY,
            }
        })
        .collect()
}

fn hits<'a>(accel: &'a Accel, rays: &'a [Ray]) -> impl Iterator<Item = (Ray, Hit)> + 'a {
    let hit = |ray: &Ray| Some((*ray, accel.intersect(ray)?));
    rays.iter().filter_map(hit)
}

/// Just off the surface.
fn leave(mesh: &Mesh, ray: &Ray, hit: &Hit) -> Vec3<f32> {
    let normal = mesh.normal(hit.primitive, ray.direction);
    ray.origin + ray.direction * hit.t + normal * 1e-5
}

/// A ray that goes on in a direction of cosine density.
fn onward(mesh: &Mesh, ray: &Ray, hit: &Hit, random: &mut Random, t_max: f32) -> Ray {
    let frame = Frame::from_normal(mesh.normal(hit.primitive, ray.direction));
    let (square, turn) = (random.unit(), TAU * random.unit());
    let radius = square.sqrt();
    let local = vec3(
        radius * turn.cos(),
        radius * turn.sin(),
        (1.0 - square).sqrt(),
    );
    Ray {
        origin: leave(mesh, ray, hit),
        direction: frame.to_world(local),
        t_max,
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    /// In `[0, 1)`, 23 bits.
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        let bits = u32::try_from(z >> 41).unwrap_or(0);
        f32::from_bits(0x3f80_0000 | bits) - 1.0
    }
}
