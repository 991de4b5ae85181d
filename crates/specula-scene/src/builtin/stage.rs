//! Where the orbs stand: a floor that turns up into a backdrop, a step, and the lights.

use glam::DVec3;
use specula_bsdf::math::rgb;

use super::{SceneBuilder, studio};
use crate::num::f32_of;
use crate::scene::{
    ColourParam, EnvironmentMapping, FloatParam, ImageId, Light, MaterialKind, Mesh, Texture,
    TextureId, TextureMapping, UvMapping,
};

/// Where the front row stands.
pub(super) const FRONT_ROW_Y: f64 = -2.0;
/// Where the back row stands, on the step.
pub(super) const BACK_ROW_Y: f64 = 1.55;
/// Height of the step.
pub(super) const STEP_HEIGHT: f64 = 1.6;

/// Half the width of everything that stands on the floor.
const HALF_WIDTH: f64 = 40.0;

impl SceneBuilder {
    /// Floor, backdrop, step and lights.
    pub(super) fn stage(&mut self) {
        let checks = self.checks();
        let floor = self.material(
            "floor",
            MaterialKind::Diffuse {
                reflectance: ColourParam::Texture(checks),
                roughness: FloatParam::Value(0.0),
            },
        );
        let black = self.material(
            "light",
            MaterialKind::Diffuse {
                reflectance: ColourParam::Value(rgb(0.0, 0.0, 0.0)),
                roughness: FloatParam::Value(0.0),
            },
        );
        let cyclorama = self.mesh(swept(&cyclorama_profile()));
        self.shape(cyclorama, glam::DMat4::IDENTITY, floor);
        let step = self.mesh(swept(&step_profile()));
        self.shape(step, glam::DMat4::IDENTITY, floor);

        // Key: large, above and to the left; rim: a bar behind, out of sight.
        let target = DVec3::new(0.0, 0.0, 1.5);
        let key = softbox(DVec3::new(-9.0, -9.0, 13.0), target, 5.5, 3.2);
        self.emitter(key, black, rgb(5.4, 5.2, 4.9));
        let rim = softbox(DVec3::new(0.0, 4.0, 10.5), target, 11.0, 0.55);
        self.emitter(rim, black, rgb(8.0, 8.4, 9.0));

        self.scene.images.push(studio::environment());
        self.scene.lights.push(Light::Infinite {
            radiance: rgb(1.0, 1.0, 1.0),
            image: Some((ImageId(0), EnvironmentMapping::LatitudeLongitude)),
            to_world: glam::DMat4::IDENTITY,
        });
    }

    fn checks(&mut self) -> TextureId {
        let textures = &mut self.scene.textures;
        textures.push(Texture::Constant(rgb(0.07, 0.073, 0.08)));
        textures.push(Texture::Constant(rgb(0.13, 0.133, 0.14)));
        textures.push(Texture::Checkerboard {
            even: TextureId(0),
            odd: TextureId(1),
            mapping: TextureMapping::Uv(UvMapping::scaled([1.0 / 1.36; 2], [0.5, 0.0])),
        });
        TextureId(textures.len() - 1)
    }
}

/// `(y, z)` from before the orbs, over the floor, up the backdrop.
fn cyclorama_profile() -> Vec<[f64; 2]> {
    const BEND: u32 = 48;
    const RADIUS: f64 = 6.0;
    const START: f64 = 7.0;
    let mut profile = vec![[-40.0, 0.0]];
    profile.extend((0..=BEND).map(|i| {
        let angle = std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(BEND);
        [START + RADIUS * angle.sin(), RADIUS * (1.0 - angle.cos())]
    }));
    profile.push([START + RADIUS, 30.0]);
    profile
}

/// `(y, z)` of the step: front with a rounded edge, then its top up to the backdrop.
fn step_profile() -> Vec<[f64; 2]> {
    const EDGE: u32 = 12;
    const RADIUS: f64 = 0.12;
    const FRONT: f64 = BACK_ROW_Y - 1.25;
    let mut profile = vec![[FRONT, 0.0]];
    profile.extend((0..=EDGE).map(|i| {
        let angle = std::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(EDGE);
        [
            FRONT + RADIUS * (1.0 - angle.cos()),
            STEP_HEIGHT - RADIUS * (1.0 - angle.sin()),
        ]
    }));
    profile.push([12.5, STEP_HEIGHT]);
    profile
}

/// A profile of `(y, z)`, swept along x; normals to the left of its direction. u is x, v the length
/// of the profile so far.
fn swept(profile: &[[f64; 2]]) -> Mesh {
    let mut mesh = Mesh::default();
    let mut length = 0.0;
    for (i, [y, z]) in profile.iter().enumerate() {
        let (p, q) = (
            profile[i.saturating_sub(1)],
            profile[(i + 1).min(profile.len() - 1)],
        );
        let here = [*y, *z];
        length += (here[0] - p[0]).hypot(here[1] - p[1]);
        // Where a straight part meets a bend, the straight part has its own normal.
        let (p, q) = match i {
            1 => (profile[0], here),
            _ if i + 2 == profile.len() => (here, q),
            _ => (p, q),
        };
        let normal = [0.0, p[1] - q[1], q[0] - p[0]];
        for x in [-HALF_WIDTH, HALF_WIDTH] {
            mesh.positions.push([x, *y, *z].map(f32_of));
            mesh.normals.push(normal.map(f32_of));
            mesh.uvs.push([x, length].map(f32_of));
        }
    }
    let rows = u32::try_from(profile.len()).unwrap_or(1);
    for row in 0..rows - 1 {
        let a = 2 * row;
        mesh.triangles.push([a, a + 1, a + 3]);
        mesh.triangles.push([a, a + 3, a + 2]);
    }
    mesh
}

/// A rectangle about `centre` that faces `target`, of the given half width (level) and half height.
fn softbox(centre: DVec3, target: DVec3, half_width: f64, half_height: f64) -> Mesh {
    let facing = (target - centre).normalize();
    let right = facing.cross(DVec3::Z).normalize();
    let up = right.cross(facing);
    let corner = |x: f64, y: f64| {
        let p = centre + right * (x * half_width) + up * (y * half_height);
        [p.x, p.y, p.z].map(f32_of)
    };
    let normal = [facing.x, facing.y, facing.z].map(f32_of);
    Mesh {
        // Counterclockwise as seen from the target, which sees `right` on its left.
        positions: vec![
            corner(1.0, -1.0),
            corner(-1.0, -1.0),
            corner(-1.0, 1.0),
            corner(1.0, 1.0),
        ],
        normals: vec![normal; 4],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn geometric(mesh: &Mesh, triangle: usize) -> Vec3 {
        let [a, b, c] = mesh.triangles[triangle].map(|i| Vec3::from(mesh.positions[i as usize]));
        (b - a).cross(c - a).normalize()
    }

    #[test]
    fn softboxes_face_their_target() {
        let (centre, target) = (DVec3::new(-9.0, -9.0, 13.0), DVec3::new(0.0, 0.0, 1.5));
        let mesh = softbox(centre, target, 2.0, 1.0);
        let facing = (target - centre).normalize().as_vec3();
        for triangle in 0..2 {
            assert!(geometric(&mesh, triangle).dot(facing) > 0.999_9);
        }
    }

    #[test]
    fn floors_face_up_and_walls_the_viewer() {
        for profile in [cyclorama_profile(), step_profile()] {
            let mesh = swept(&profile);
            for triangle in 0..mesh.triangles.len() {
                let n = geometric(&mesh, triangle);
                assert!(n.z > -1e-6 && n.y < 1e-6, "{triangle}: {n}");
                let vertex = mesh.triangles[triangle][0] as usize;
                assert!(n.dot(Vec3::from(mesh.normals[vertex])) > 0.0);
            }
        }
    }
}
