//! Lights, and the choice among them: see [`select`] for how one is chosen at a point.

mod alias;
mod angles;
mod area;
mod batch;
mod build;
mod choices;
mod cone;
mod delta;
mod environment;
mod few;
mod flat;
mod node;
mod octahedral;
mod parallelogram;
mod piecewise;
mod portal;
mod projected;
mod select;
mod shape_queues;
mod sphere;
mod sun;
mod textured;
mod tree;
mod treelet;
mod triangle;

#[cfg(test)]
mod tests;

use glam::DMat4;
use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{ColourParam, Light, Scene};

use crate::accel::Bounds;
use crate::geometry::{Geometry, GroupData, Placement, ShapeRecord, Surface, parallelogram};
use crate::offset::SurfacePoint;
use crate::texture::Textures;
use area::{Area, AreaSample};
use build::Emitter;
use delta::Delta;
use environment::Environment;
use portal::Portal;
use select::Selection;
use sun::Sun;
use textured::{Textured, Varying};

pub(crate) use batch::LightQueues;
pub(crate) use environment::direction as direction_of_sphere;
pub(crate) use node::Receiver;
pub(crate) use parallelogram::{Parallelogram, ParallelogramSample};
pub use select::{FINER, LEAST_SHARE};

#[derive(Clone, Debug)]
enum Source {
    Area {
        area: Area,
        radiance: Rgb<f32>,
        two_sided: bool,
    },
    Textured(Box<Textured>),
    /// Index among the lights with extent at infinity.
    Far(usize),
    /// Index among the lights behind portals.
    Portal(usize),
    Delta(Delta),
}

/// A light with extent at infinity.
#[derive(Clone, Debug)]
enum Far {
    Environment(Environment),
    Sun(Sun),
}

/// All lights of a scene. The first are the emitting primitives, in the order of
/// [`Surface::light`].
#[derive(Clone, Debug)]
pub(crate) struct Lights {
    sources: Vec<Source>,
    /// With their places in `sources`.
    far: Vec<(Far, u32)>,
    /// Lights from infinity whose radiance depends on the point, with their places in `sources`.
    portals: Vec<(Portal, u32)>,
    /// Index in `far` of the environment light that is sampled in batches, if any.
    environment: Option<usize>,
    /// Of each light the queue in which it waits until many are sampled; see `batch`.
    queues: Vec<u8>,
    selection: Selection,
}

/// A light sample, of which occlusion is not known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample {
    /// Unit, towards the light.
    pub(crate) wi: Vec3<f32>,
    /// Radiance; of a delta light, irradiance on a surface that faces it.
    pub(crate) radiance: Rgb<f32>,
    /// Density in 1/sr, times the probability of the light; the probability alone where `delta`.
    pub(crate) pdf: f32,
    /// Whether no sampled direction can hit it.
    pub(crate) delta: bool,
    /// The point of a light; `None` for light from infinity.
    pub(crate) target: Option<SurfacePoint>,
}

/// A light that is part of a shape: itself, its place in the tree, and what that is built from.
pub(crate) const BYTES_PER_EMITTER: u64 =
    (size_of::<Source>() + 2 * size_of::<node::Node>() + 8 + size_of::<Emitter>()) as u64;

/// A pixel of an infinite light's picture.
pub(crate) const BYTES_PER_FAR_PIXEL: u64 = environment::BYTES_PER_PIXEL;

impl Lights {
    /// Gathers the lights of a scene.
    ///
    /// * `beside_lobes`: whether lobes are sampled as well, combined by MIS.
    pub(crate) fn new(
        scene: &Scene,
        geometry: &Geometry,
        textures: &Textures,
        beside_lobes: bool,
    ) -> Self {
        let mut lights = Self {
            sources: Vec::new(),
            far: Vec::new(),
            portals: Vec::new(),
            environment: None,
            queues: Vec::new(),
            selection: Selection::default(),
        };
        let mut near = Vec::new();
        let mut far = Vec::new();
        lights.add_emitters(geometry, textures, &mut near);
        for light in &scene.lights {
            let index = crate::convert::id(lights.sources.len());
            if let Some(delta) = Delta::new(light, textures) {
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
            } else if let Some(light) = behind_portal(light, scene) {
                far.push((index, light.sampled_integral()));
                lights.sources.push(Source::Portal(lights.portals.len()));
                lights.portals.push((light, index));
            } else if let Some(light) = Far::new(light, scene, beside_lobes) {
                far.push((index, light.sampled_integral()));
                lights.sources.push(Source::Far(lights.far.len()));
                lights.far.push((light, index));
            }
        }
        lights.selection = Selection::new(near, &far, lights.sources.len());
        lights.environment = lights.far.iter().position(|(light, _)| light.is_image());
        lights.queues = lights.assigned_queues();
        lights
    }

    fn add_emitters(&mut self, geometry: &Geometry, textures: &Textures, near: &mut Vec<Emitter>) {
        let varies = |shape: &ShapeRecord| {
            matches!(shape.radiance, ColourParam::Texture(_)) || shape.alpha.is_some()
        };
        let each = |p: &Placement| &geometry.groups[p.group as usize];
        let shape_of = |group: &GroupData, primitive: u32| {
            &geometry.shapes[group.shape_of[primitive as usize] as usize]
        };
        let varying = geometry.placements.iter().map(|p| {
            let group = each(p);
            let emitters = group.emitters.iter();
            emitters.filter(|&&e| varies(shape_of(group, e))).count()
        });
        let cells = textured::cells_for(varying.sum());
        for (instance, placement) in (0..).zip(&geometry.placements) {
            let group = each(placement);
            let triangles = group.triangles.len();
            let m = &placement.transform;
            // The winding's side turns over under a mirror; the outside does not.
            let mirrored = glam::DMat3::from_mat4(*m).determinant() < 0.0;
            for &primitive in &group.emitters {
                let shape = shape_of(group, primitive);
                let area = if (primitive as usize) < triangles {
                    let light = group.light_of(primitive);
                    let own = group.corners(primitive);
                    let whole = (group.light_of(primitive + 1) == light)
                        .then(|| parallelogram([own, group.corners(primitive + 1)]));
                    let turned = |corners| {
                        let [a, b, c] = world_corners(corners, m);
                        if mirrored { [a, c, b] } else { [a, b, c] }
                    };
                    match whole.flatten() {
                        Some(corners) => Area::parallelogram(turned(corners)),
                        None => Area::triangle(turned(own)),
                    }
                } else {
                    let q = &group.quadrics[primitive as usize - triangles];
                    Area::quadric(q.shape, &(*m * q.to_group), q.flipped)
                };
                let (source, colour) = match shape.radiance {
                    ColourParam::Value(radiance) if shape.alpha.is_none() => (
                        Source::Area {
                            area,
                            radiance,
                            two_sided: shape.two_sided,
                        },
                        f64::from(radiance.luminance().max(radiance.mean())),
                    ),
                    radiance => {
                        let light = Textured::new(
                            area,
                            Varying {
                                radiance,
                                alpha: shape.alpha,
                            },
                            shape.two_sided,
                            (instance, primitive, mirrored),
                            (geometry, textures),
                            cells,
                        );
                        let mean = light.mean;
                        (Source::Textured(Box::new(light)), mean)
                    }
                };
                near.push(Emitter {
                    light: crate::convert::id(self.sources.len()),
                    bounds: area.bounds(),
                    cone: area.cone(shape.two_sided),
                    intensity: colour * f64::from(area.projected_area()),
                });
                self.sources.push(source);
            }
        }
    }

    /// How many lights there are, each emitting primitive counted.
    pub(crate) fn len(&self) -> usize {
        self.sources.len()
    }

    /// Samples a light at a point.
    ///
    /// * `world`: what textured lights lie on.
    /// * `u`: choice of light, two for the point on it, finer digits of the choice.
    #[inline]
    pub(crate) fn sample(
        &self,
        receiver: &Receiver,
        world: (&Geometry, &Textures),
        u: [f32; 4],
    ) -> Option<LightSample> {
        let chosen = self.selection.sample(receiver, [u[0], u[3]])?;
        self.sample_one(chosen, receiver.point, world, [u[1], u[2]])
    }

    /// Light at a point `p` from a light that was sampled with a probability.
    #[inline]
    fn sample_one(
        &self,
        (index, probability): (u32, f32),
        p: Vec3<f32>,
        world: (&Geometry, &Textures),
        u: [f32; 2],
    ) -> Option<LightSample> {
        match &self.sources[index as usize] {
            Source::Area {
                area,
                radiance,
                two_sided,
            } => from_area(&area.sample(p, u)?, *radiance, *two_sided, probability),
            Source::Textured(light) => {
                let (s, radiance) = light.sample(p, u, world)?;
                from_area(&s, radiance, light.two_sided, probability)
            }
            Source::Far(_) | Source::Portal(_) => {
                let (wi, radiance, pdf) = match &self.sources[index as usize] {
                    Source::Portal(index) => self.portals[*index].0.sample(p, u)?,
                    Source::Far(index) => self.far[*index].0.sample(u)?,
                    _ => return None,
                };
                Some(LightSample {
                    wi,
                    radiance,
                    pdf: probability * pdf,
                    delta: false,
                    target: None,
                })
            }
            Source::Delta(delta) => {
                let (radiance, wi, place) = delta.illuminate(p, world.1);
                (radiance.is_finite() && wi.is_finite() && !radiance.is_black()).then_some(
                    LightSample {
                        wi,
                        radiance,
                        pdf: probability,
                        delta: true,
                        target: place.map(|position| SurfacePoint {
                            position,
                            error: Vec3::ZERO,
                            normal: wi,
                        }),
                    },
                )
            }
        }
    }

    /// The one light of the scene, where that is a parallelogram; its radiance; whether it emits to
    /// both sides.
    #[inline]
    pub(crate) fn lone_parallelogram(&self) -> Option<(&Parallelogram, Rgb<f32>, bool)> {
        let [
            Source::Area {
                area: Area::Parallelogram(light),
                radiance,
                two_sided,
            },
        ] = self.sources.as_slice()
        else {
            return None;
        };
        (!self.selection.is_empty()).then_some((light, *radiance, *two_sided))
    }

    /// Whether there is more than one light to choose from.
    pub(crate) fn are_chosen(&self) -> bool {
        self.selection.chooses() && !self.selection.is_empty()
    }

    /// Density in 1/sr, times the probability of the light, with which [`Lights::sample`] at the
    /// receiver samples the direction to the emitting surface `s`.
    #[inline]
    pub(crate) fn pdf_of_surface(&self, receiver: &Receiver, s: &Surface) -> f32 {
        match self.sources.get(s.light as usize) {
            Some(Source::Area { area, .. }) => {
                let probability = self.selection.probability_near(receiver, s.light);
                probability * area.pdf(receiver.point, s.position, s.ng)
            }
            Some(Source::Textured(light)) => {
                let probability = self.selection.probability_near(receiver, s.light);
                probability * light.pdf(receiver.point, s)
            }
            _ => 0.0,
        }
    }

    /// Lights from infinity in the direction `wi`: radiance, and density in 1/sr, times the
    /// probability among the lights from infinity. [`Lights::sample`] samples it with that density
    /// times [`Lights::share_from_infinity`].
    #[inline]
    pub(crate) fn arriving_from_infinity(
        &self,
        wi: Vec3<f32>,
    ) -> impl Iterator<Item = (Rgb<f32>, f32)> {
        self.far.iter().map(move |(light, index)| {
            let probability = self.selection.probability_far(*index);
            let (radiance, pdf) = light.arriving(wi);
            (radiance, probability * pdf)
        })
    }

    /// Whether there are lights behind portals.
    #[inline]
    pub(crate) fn has_portals(&self) -> bool {
        !self.portals.is_empty()
    }

    /// [`Lights::arriving_from_infinity`] of the lights behind portals, at a point.
    #[inline]
    pub(crate) fn arriving_through_portals(
        &self,
        point: Vec3<f32>,
        wi: Vec3<f32>,
    ) -> impl Iterator<Item = (Rgb<f32>, f32)> {
        self.portals.iter().map(move |(light, index)| {
            let probability = self.selection.probability_far(*index);
            let (radiance, pdf) = light.arriving(point, wi);
            (radiance, probability * pdf)
        })
    }

    /// Probability with which [`Lights::sample`] takes any light from infinity.
    #[inline]
    pub(crate) fn share_from_infinity(&self, receiver: &Receiver) -> f32 {
        self.selection.share_far(receiver)
    }
}

/// `None` for lights without a portal.
fn behind_portal(light: &Light, scene: &Scene) -> Option<Portal> {
    let Light::Portal {
        radiance,
        image,
        to_world,
        corners,
    } = light
    else {
        return None;
    };
    let image = image.map(|(id, mapping)| (&scene.images[id.0], mapping));
    let side = image.map_or(0, |(image, _)| image.width.max(image.height) as usize);
    let sky = Environment::new(*radiance, image, to_world, false);
    Some(Portal::new(&sky, side, *corners))
}

impl Far {
    /// `None` for lights without extent or with a portal.
    fn new(light: &Light, scene: &Scene, beside_lobes: bool) -> Option<Self> {
        match light {
            Light::Infinite {
                radiance,
                image,
                to_world,
            } => {
                let image = image.map(|(id, mapping)| (&scene.images[id.0], mapping));
                Some(Self::Environment(Environment::new(
                    *radiance,
                    image,
                    to_world,
                    beside_lobes,
                )))
            }
            Light::Distant {
                irradiance,
                to_light,
                half_angle_deg,
            } => Some(Self::Sun(Sun::new(*irradiance, *to_light, *half_angle_deg))),
            Light::Portal { .. }
            | Light::Point { .. }
            | Light::Spot { .. }
            | Light::Picture { .. } => None,
        }
    }

    /// Radiance from a direction, and the density in 1/sr with which [`Far::sample`] samples it.
    #[inline]
    fn arriving(&self, wi: Vec3<f32>) -> (Rgb<f32>, f32) {
        match self {
            Self::Environment(light) => light.arriving(wi),
            Self::Sun(light) => (light.radiance(wi), light.pdf(wi)),
        }
    }

    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<(Vec3<f32>, Rgb<f32>, f32)> {
        match self {
            Self::Environment(light) => light.sample(u),
            Self::Sun(light) => Some(light.sample(u)),
        }
    }

    fn is_image(&self) -> bool {
        matches!(self, Self::Environment(light) if light.is_image())
    }

    fn sampled_integral(&self) -> f64 {
        match self {
            Self::Environment(light) => light.sampled_integral(),
            Self::Sun(light) => light.sampled_integral(),
        }
    }
}

/// A sampled point of a light of this probability; `None` where that sends nothing to the receiver.
#[inline(always)]
fn from_area(
    s: &AreaSample,
    radiance: Rgb<f32>,
    two_sided: bool,
    probability: f32,
) -> Option<LightSample> {
    let arrives = (s.pdf > 0.0) & (two_sided | (s.normal.dot(s.wi) < 0.0));
    arrives.then_some(LightSample {
        wi: s.wi,
        radiance,
        pdf: probability * s.pdf,
        delta: false,
        target: Some(SurfacePoint {
            position: s.point,
            error: s.error,
            normal: s.normal,
        }),
    })
}

fn world_corners(corners: [Vec3<f32>; 3], m: &DMat4) -> [Vec3<f32>; 3] {
    if *m == DMat4::IDENTITY {
        return corners;
    }
    corners.map(|p| Vec3::from(crate::convert::transform_point(m, p.to_array())))
}
