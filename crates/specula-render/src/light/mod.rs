//! Lights, and the choice among them: see [`select`] for how one is chosen at a point.

mod alias;
mod area;
mod build;
mod cone;
mod delta;
mod environment;
mod node;
mod octahedral;
mod select;
mod tree;

#[cfg(test)]
mod tests;

use glam::DMat4;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{Light, Scene};

use crate::accel::Bounds;
use crate::geometry::{Geometry, Surface};
use area::Area;
use build::Emitter;
use delta::Delta;
use environment::Environment;
use select::Selection;

pub(crate) use node::Receiver;

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
    /// With their places in `sources`.
    environments: Vec<(Environment, u32)>,
    selection: Selection,
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
        let mut lights = Self {
            sources: Vec::new(),
            environments: Vec::new(),
            selection: Selection::default(),
        };
        let mut near = Vec::new();
        let mut far = Vec::new();
        lights.add_emitters(geometry, &mut near);
        for light in &scene.lights {
            let index = crate::convert::id(lights.sources.len());
            if let Some(delta) = Delta::new(light) {
                match delta.bounds() {
                    None => far.push((index, delta.strength())),
                    Some((p, cone)) => near.push(Emitter {
                        light: index,
                        bounds: Bounds {
                            min: p.to_array(),
                            max: p.to_array(),
                        },
                        cone,
                        intensity: delta.strength(),
                    }),
                }
                lights.sources.push(Source::Delta(delta));
            } else if let Light::Infinite {
                radiance,
                image,
                to_world,
            } = light
            {
                let image = image.map(|(id, mapping)| (&scene.images[id.0], mapping));
                let environment = Environment::new(*radiance, image, to_world);
                far.push((index, environment.luminous_integral()));
                let number = lights.environments.len();
                lights.sources.push(Source::Environment(number));
                lights.environments.push((environment, index));
            }
        }
        lights.selection = Selection::new(near, &far, lights.sources.len());
        lights
    }

    fn add_emitters(&mut self, geometry: &Geometry, near: &mut Vec<Emitter>) {
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
                let colour = shape.radiance.luminance().max(shape.radiance.mean());
                near.push(Emitter {
                    light: crate::convert::id(self.sources.len()),
                    bounds: area.bounds(),
                    cone: area.cone(shape.two_sided),
                    intensity: f64::from(colour) * f64::from(area.projected_area()),
                });
                self.sources.push(Source::Area {
                    area,
                    radiance: shape.radiance,
                    two_sided: shape.two_sided,
                });
            }
        }
    }

    /// How many lights there are, each emitting primitive counted.
    pub(crate) fn len(&self) -> usize {
        self.sources.len()
    }

    /// Light at a point from one light.
    ///
    /// * `u`: choice of light, two for the point on it, finer digits of the choice.
    #[inline]
    pub(crate) fn sample(&self, receiver: &Receiver, u: [f32; 4]) -> Option<LightSample> {
        let p = receiver.point;
        let (index, probability) = self.selection.sample(receiver, [u[0], u[3]])?;
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

    /// Density in 1/sr, times the probability of the light, with which [`Lights::sample`] at the
    /// receiver draws the direction to the emitting surface `s`.
    #[inline]
    pub(crate) fn pdf_of_surface(&self, receiver: &Receiver, s: &Surface) -> f32 {
        match self.sources.get(s.light as usize) {
            Some(Source::Area { area, .. }) => {
                let probability = self.selection.probability_near(receiver, s.light);
                probability * area.pdf(receiver.point, s.position, s.ng)
            }
            _ => 0.0,
        }
    }

    /// Lights from infinity in the direction `wi`: radiance, and density in 1/sr, times the
    /// probability among the lights from infinity. [`Lights::sample`] draws it with that density
    /// times [`Lights::share_from_infinity`].
    #[inline]
    pub(crate) fn arriving_from_infinity(
        &self,
        wi: Vec3<f32>,
    ) -> impl Iterator<Item = (Rgb<f32>, f32)> {
        self.environments.iter().map(move |(environment, index)| {
            let probability = self.selection.probability_far(*index);
            (environment.radiance(wi), probability * environment.pdf(wi))
        })
    }

    /// Probability with which [`Lights::sample`] takes any light from infinity.
    #[inline]
    pub(crate) fn share_from_infinity(&self, receiver: &Receiver) -> f32 {
        self.selection.share_far(receiver)
    }
}

fn world_corners(corners: [Vec3<f32>; 3], m: &DMat4) -> [Vec3<f32>; 3] {
    if *m == DMat4::IDENTITY {
        return corners;
    }
    corners.map(|p| Vec3::from(crate::convert::transform_point(m, p.to_array())))
}
