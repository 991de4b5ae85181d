//! Lights, and the choice among them.
//!
//! Every light is chosen in proportion to its power (luminance times area or solid angle; of light
//! from infinity, what meets the scene's bounding sphere). Where there are both lights from infinity
//! and lights in the scene, either class keeps at least a fifth of the samples: the power of a sky
//! over a large floor says little about a room.

mod area;
mod delta;
mod environment;
mod octahedral;
mod select;

use glam::DMat4;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{Light, Scene};

use crate::geometry::{Geometry, Surface};
use area::Area;
use delta::Delta;
use environment::Environment;
use select::AliasTable;

/// Smallest share of either class of lights where there are both.
const LEAST_SHARE: f64 = 0.2;

#[derive(Clone, Debug)]
enum Source {
    Area {
        area: Area,
        radiance: Rgb<f32>,
        two_sided: bool,
    },
    /// Index among the environments.
    Environment(usize),
    Delta(Delta),
}

/// All lights of a scene. The first are the emitting primitives, in the order of
/// [`Surface::light`].
#[derive(Clone, Debug)]
pub(crate) struct Lights {
    sources: Vec<Source>,
    environments: Vec<(Environment, u32)>,
    table: AliasTable,
}

/// Light that could arrive, if nothing is in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Unit, towards the light.
    pub(crate) wi: Vec3<f32>,
    /// Radiance; of a delta light, irradiance on a surface that faces it.
    pub(crate) radiance: Rgb<f32>,
    /// Density in 1/sr, times the probability of the light; the probability alone where `delta`.
    pub(crate) pdf: f32,
    /// Whether no direction drawn otherwise can find it.
    pub(crate) delta: bool,
    /// Where it comes from; `None`: from infinity.
    pub(crate) from: Option<Target>,
}

/// The end of a shadow ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub(crate) point: Vec3<f32>,
    pub(crate) error: Vec3<f32>,
    pub(crate) normal: Vec3<f32>,
}

impl Lights {
    /// Gathers the lights of a scene.
    pub(crate) fn new(scene: &Scene, geometry: &Geometry) -> Self {
        let radius = geometry.accel.bounds().map_or(1.0, |b| {
            let d = [0, 1, 2].map(|i| f64::from(b.max[i]) - f64::from(b.min[i]));
            0.5 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
        });
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let mut lights = Self {
            sources: Vec::new(),
            environments: Vec::new(),
            table: AliasTable::default(),
        };
        let mut powers = Vec::new();
        lights.add_emitters(geometry, &mut powers);
        for light in &scene.lights {
            if let Some(delta) = Delta::new(light) {
                powers.push(delta.power(radius));
                lights.sources.push(Source::Delta(delta));
            } else if let Light::Infinite {
                radiance,
                image,
                to_world,
            } = light
            {
                let image = image.map(|(id, mapping)| (&scene.images[id.0], mapping));
                let environment = Environment::new(*radiance, image, to_world);
                let section = core::f64::consts::PI * radius * radius;
                powers.push(environment.luminous_integral() * section);
                let index = crate::convert::id(lights.sources.len());
                let number = lights.environments.len();
                lights.sources.push(Source::Environment(number));
                lights.environments.push((environment, index));
            }
        }
        lights.table = AliasTable::new(&lights.balanced(powers));
        lights
    }

    fn add_emitters(&mut self, geometry: &Geometry, powers: &mut Vec<f64>) {
        for placement in &geometry.placements {
            let group = &geometry.groups[placement.group as usize];
            let triangles = group.triangles.len();
            let m = &placement.transform;
            // The winding's side turns over under a mirror; the outside does not.
            let mirrored = glam::DMat3::from_mat4(*m).determinant() < 0.0;
            for &primitive in &group.emitters {
                let shape = &geometry.shapes[group.shape_of[primitive as usize] as usize];
                let area = if (primitive as usize) < triangles {
                    let [a, b, c] = world_corners(group.corners(primitive), m);
                    Area::triangle(if mirrored { [a, c, b] } else { [a, b, c] })
                } else {
                    let q = &group.quadrics[primitive as usize - triangles];
                    Area::quadric(q.shape, &(*m * q.to_group), q.flipped)
                };
                let sides = if shape.two_sided { 2.0 } else { 1.0 };
                let colour = shape.radiance.luminance().max(shape.radiance.mean());
                let power = f64::from(colour) * f64::from(area.area()) * sides;
                powers.push(core::f64::consts::PI * power);
                self.sources.push(Source::Area {
                    area,
                    radiance: shape.radiance,
                    two_sided: shape.two_sided,
                });
            }
        }
    }

    /// Powers as weights, with the least share of either class.
    fn balanced(&self, mut powers: Vec<f64>) -> Vec<f64> {
        let from_infinity: Vec<bool> = self.sources.iter().map(Source::is_infinite).collect();
        let (mut far, mut near) = (0.0, 0.0);
        for (p, &infinite) in powers.iter_mut().zip(&from_infinity) {
            if !(*p > 0.0 && p.is_finite()) {
                *p = 0.0;
            }
            *(if infinite { &mut far } else { &mut near }) += *p;
        }
        if far > 0.0 && near > 0.0 {
            let share = (far / (far + near)).clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
            for (p, infinite) in powers.iter_mut().zip(from_infinity) {
                *p *= if infinite {
                    share / far
                } else {
                    (1.0 - share) / near
                };
            }
        }
        powers
    }

    /// How many lights there are, each emitting primitive counted.
    pub(crate) fn len(&self) -> usize {
        self.sources.len()
    }

    /// Light at `p` from one light.
    ///
    /// * `u`: choice of light, two for the point on it, coin of the choice.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3<f32>, u: [f32; 4]) -> Option<LightSample> {
        let (index, probability) = self.table.sample(u[0], u[3])?;
        match &self.sources[index as usize] {
            Source::Area {
                area,
                radiance,
                two_sided,
            } => {
                let s = area.sample(p, [u[1], u[2]])?;
                (*two_sided || s.normal.dot(s.wi) < 0.0).then_some(LightSample {
                    wi: s.wi,
                    radiance: *radiance,
                    pdf: probability * s.pdf,
                    delta: false,
                    from: Some(Target {
                        point: s.point,
                        error: s.error,
                        normal: s.normal,
                    }),
                })
            }
            Source::Environment(number) => {
                let (wi, radiance, pdf) = self.environments[*number].0.sample([u[1], u[2]])?;
                Some(LightSample {
                    wi,
                    radiance,
                    pdf: probability * pdf,
                    delta: false,
                    from: None,
                })
            }
            Source::Delta(delta) => {
                let (radiance, wi, place) = delta.illuminate(p);
                (radiance.is_finite() && wi.is_finite() && !radiance.is_black()).then_some(
                    LightSample {
                        wi,
                        radiance,
                        pdf: probability,
                        delta: true,
                        from: place.map(|point| Target {
                            point,
                            error: Vec3::ZERO,
                            normal: wi,
                        }),
                    },
                )
            }
        }
    }

    /// Density in 1/sr, times the probability of the light, with which [`Lights::sample`] at `p`
    /// draws the direction to the emitting surface `s`.
    #[inline]
    pub(crate) fn pdf_of_surface(&self, p: Vec3<f32>, s: &Surface) -> f32 {
        match self.sources.get(s.light as usize) {
            Some(Source::Area { area, .. }) => {
                self.table.probability(s.light) * area.pdf(p, s.position, s.ng)
            }
            _ => 0.0,
        }
    }

    /// Lights from infinity in the direction `wi`: radiance, and density of [`Lights::sample`].
    #[inline]
    pub(crate) fn arriving_from_infinity(
        &self,
        wi: Vec3<f32>,
    ) -> impl Iterator<Item = (Rgb<f32>, f32)> {
        self.environments.iter().map(move |(environment, index)| {
            (
                environment.radiance(wi),
                self.table.probability(*index) * environment.pdf(wi),
            )
        })
    }
}

impl Source {
    fn is_infinite(&self) -> bool {
        match self {
            Self::Area { .. } => false,
            Self::Environment(_) => true,
            Self::Delta(delta) => matches!(delta, Delta::Distant { .. }),
        }
    }
}

fn world_corners(corners: [Vec3<f32>; 3], m: &DMat4) -> [Vec3<f32>; 3] {
    if *m == DMat4::IDENTITY {
        return corners;
    }
    corners.map(|p| Vec3::from(crate::convert::transform_point(m, p.to_array())))
}
