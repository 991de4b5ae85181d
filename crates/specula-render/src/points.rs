//! What a prepared scene answers about single points: textures, bump maps, and lights as a point sees them.
//!
//! For previews and for other renderers of the scene: shaders are compared with these values.

use specula_bsdf::{Frame, Rgb, Vec3};
use specula_scene::scene::{BumpRules, ColourParam, TextureId};

use crate::accel::Ray;
use crate::bump::{self, Softness};
use crate::geometry::{FARTHEST, NONE, PrimitiveLocation, Surface};
use crate::integrator::estimator::MOST_PASSES;
use crate::light::Receiver;
use crate::prepared::PreparedScene;
use crate::slopes::{SlopeCovariance, Widening};
use crate::texture::{Footprint, TextureCoordinates};

/// Where a texture is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexturePoint {
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Second texture coordinates.
    pub second_uv: [f32; 2],
    /// Position in the world.
    pub position: [f32; 3],
    /// Geometric normal in the world, unit.
    pub normal: [f32; 3],
    /// Vertex colour of the mesh.
    pub colour: [f32; 3],
    /// What filtered textures are means over; `None`: the point alone.
    pub footprint: Option<TextureFootprint>,
}

/// An ellipse in the tangent plane of a surface, by two half axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureFootprint {
    /// The half axes, in the world.
    pub axes: [[f32; 3]; 2],
    /// How much the texture coordinates change along each.
    pub uv: [[f32; 2]; 2],
    /// How much the second texture coordinates change along each.
    pub second_uv: [[f32; 2]; 2],
}

/// A point to be lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitPoint {
    /// Position in the world.
    pub position: [f32; 3],
    /// Unit normal; `None` where light from every side counts.
    pub normal: Option<[f32; 3]>,
}

/// A sampled light, as a point sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLighting {
    /// Unit, towards the light.
    pub wi: [f32; 3],
    /// Radiance; of a light without extent, irradiance on a surface that faces it.
    pub radiance: [f32; 3],
    /// Density in 1/sr with which `wi` is sampled; of a light without extent, its probability.
    pub pdf: f32,
    /// Whether the light has no extent.
    pub is_delta: bool,
    /// The light's point, that point's error, and the normal there; `None`: from infinity.
    pub target: Option<[[f32; 3]; 3]>,
}

/// A point of a surface: its primitive, and where it is on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrimitivePoint {
    /// Index of the instance, index of the primitive within its group.
    pub primitive: [u32; 2],
    /// Barycentric weights of a triangle's second and third vertex.
    pub weights: [f32; 2],
    /// The point in the world, roughly; for quadrics only.
    pub near: [f32; 3],
}

/// How Mitsuba's rules soften a bump map: see [`PreparedScene::softened_normal`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftenedNormal {
    /// The bent normal, turned back towards the viewer.
    pub normal: [f32; 3],
    /// Factor on light from `wi`.
    pub factor: f32,
}

/// A normal map that is filtered into roughness, at a point: see [`PreparedScene::filtered_normal`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilteredNormal {
    /// The mean normal, unit.
    pub normal: [f32; 3],
    /// Covariance `(xx, xy, yy)` of the slopes about it, along the tangent and across it.
    pub covariance: [f32; 3],
    /// The lobe's alphas, along the principal axes.
    pub alphas: [f32; 2],
    /// The alpha of a clear coat that has had the first of the lobe's.
    pub coat_alpha: f32,
    /// Angle from the tangent to the first principal axis, in radians.
    pub turn_rad: f32,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenSurface {
    /// Index of its material in the scene; of a mix, the mix.
    pub material: usize,
    /// The point in the world.
    pub position: [f32; 3],
    /// Unit geometric normal, towards the outside of the shape.
    pub normal: [f32; 3],
    /// Along the camera ray.
    pub distance: f32,
}

impl PreparedScene {
    /// The surface that the ray through a point of the picture and the middle of the lens meets: what is more
    /// transparent than opaque, interfaces of media and lights that are hidden let it pass. `None`: there is none.
    ///
    /// * `raster`: columns from the left and rows from the top of the whole picture; pixels have their centres at
    ///   halves.
    #[must_use]
    pub fn seen(&self, raster: [f32; 2]) -> Option<SeenSurface> {
        // In the middle of the exposure.
        let time = 0.5;
        let (eye, direction, _) = self.camera.through_lenses(time, raster, [0.5; 2])?;
        let mut ray = Ray {
            origin: eye,
            direction,
            t_max: FARTHEST,
        };
        let mut hidden = self.hide_emitters;
        for _ in 0..MOST_PASSES {
            let hit = self.geometry.accel.intersect_at(&ray, time)?;
            let surface = self.geometry.surface(&ray, &hit, time);
            hidden &= surface.light != NONE;
            let shape = &self.geometry.shapes[surface.shape as usize];
            let opacity = |alpha| self.textures.float(alpha, &surface.place());
            let passes = shape.is_interface
                || shape.is_left_by(surface.ng, direction)
                || shape.alpha.is_some_and(|alpha| opacity(alpha) < 0.5);
            if !hidden && !passes {
                return Some(SeenSurface {
                    material: shape.material as usize,
                    position: surface.position.to_array(),
                    normal: surface.ng.to_array(),
                    distance: (surface.position - eye).length(),
                });
            }
            ray.origin = surface.point().ray_origin(direction);
        }
        None
    }

    /// The value of a texture at a point.
    ///
    /// * `texture`: index of one of the scene's textures.
    ///
    /// # Panics
    /// Where there is no such texture.
    #[must_use]
    pub fn texture_value(&self, texture: usize, at: &TexturePoint) -> [f32; 3] {
        let place = TextureCoordinates {
            uv: at.uv,
            second_uv: at.second_uv,
            position: Vec3::from(at.position),
            normal: Vec3::from(at.normal),
            colour: Rgb::from(at.colour),
            footprint: at.footprint.map(|footprint| Footprint {
                position: footprint.axes.map(Vec3::from),
                uv: footprint.uv,
                second_uv: footprint.second_uv,
            }),
        };
        let parameter = ColourParam::Texture(TextureId(texture));
        self.textures.colour(parameter, &place).to_array()
    }

    /// Samples a light; `None` where no light reaches the point.
    ///
    /// * `u`: uniform in `[0, 1)`: the light by the first and the last, its point by the others.
    #[must_use]
    pub fn sample_light(&self, lit: &LitPoint, u: [f32; 4]) -> Option<PointLighting> {
        let world = (&self.geometry, &self.textures);
        let sample = self.lights.sample(&receiver(lit), world, u)?;
        let target = sample
            .target
            .map(|t| [t.position, t.error, t.normal].map(Vec3::to_array));
        Some(PointLighting {
            wi: sample.wi.to_array(),
            radiance: sample.radiance.to_array(),
            pdf: sample.pdf,
            is_delta: sample.delta,
            target,
        })
    }

    /// Density in 1/sr with which [`sample_light`](Self::sample_light) samples a point of a light's surface.
    ///
    /// * `on_light`: position and unit normal of that point.
    /// * `weights`: of its primitive's second and third corner.
    #[must_use]
    pub fn light_pdf(
        &self,
        lit: &LitPoint,
        light: u32,
        on_light: [[f32; 3]; 2],
        weights: [f32; 2],
    ) -> f32 {
        let [position, normal] = on_light.map(Vec3::from);
        let surface = Surface {
            position,
            error: Vec3::ZERO,
            ng: normal,
            ns: normal,
            tangent: Vec3::ZERO,
            uv: [0.0; 2],
            second_uv: [0.0; 2],
            colour: Rgb::WHITE,
            shape: 0,
            light,
            at: PrimitiveLocation {
                weights,
                ..PrimitiveLocation::default()
            },
            footprint: None,
        };
        self.lights.pdf_of_surface(&receiver(lit), &surface)
    }

    /// Radiance of every light at infinity from a direction, with the density of that direction; without those behind
    /// portals.
    #[must_use]
    pub fn radiance_from_infinity(&self, wi: [f32; 3]) -> Vec<[f32; 4]> {
        let arriving = self.lights.arriving_from_infinity(Vec3::from(wi));
        arriving.map(|(c, pdf)| [c.r, c.g, c.b, pdf]).collect()
    }

    /// Probability with which [`sample_light`](Self::sample_light) samples a light at infinity.
    #[must_use]
    pub fn probability_of_infinity(&self, lit: &LitPoint) -> f32 {
        self.lights.share_from_infinity(&receiver(lit))
    }

    /// Shading normal and tangent under the bump map of a material.
    ///
    /// # Panics
    /// Where there is no such material or primitive.
    #[must_use]
    pub fn bumped_frame(&self, material: u32, at: &PrimitivePoint) -> [[f32; 3]; 2] {
        let (textures, geometry) = (&self.textures, &self.geometry);
        let surface = geometry.surface_at(&location(at), || near(at));
        let chosen = self
            .materials
            .at(material, textures, &surface.place(), true, |_| 0.5);
        let material = chosen.material;
        let (normal, tangent) = match &material.bump {
            None => (surface.ns, surface.tangent),
            Some(map) => {
                let bent = bump::bend(map, material.bump_rules, textures, geometry, &surface);
                (bent.normal, bent.tangent)
            }
        };
        [normal.to_array(), tangent.to_array()]
    }

    /// The normal of a material's normal map that is filtered into roughness, and how it widens a lobe there.
    ///
    /// * `changes`: `(du, dv)` along the half axes of the footprint.
    /// * `alphas`: of the lobe, along the tangent and across it; 0 where it is smooth.
    ///
    /// # Panics
    /// Where there is no such material or primitive.
    #[must_use]
    pub fn filtered_normal(
        &self,
        material: u32,
        at: &PrimitivePoint,
        changes: [[f32; 2]; 2],
        alphas: [f32; 2],
    ) -> FilteredNormal {
        let (textures, geometry) = (&self.textures, &self.geometry);
        let mut surface = geometry.surface_at(&location(at), || near(at));
        surface.footprint = Some(Footprint {
            uv: changes,
            ..Footprint::default()
        });
        let chosen = self
            .materials
            .at(material, textures, &surface.place(), true, |_| 0.5);
        let bump = (chosen.material.bump.as_ref()).expect("the material has a normal map");
        let bent = bump::bend(
            bump,
            chosen.material.bump_rules,
            textures,
            geometry,
            &surface,
        );
        let frame = Frame::from_normal_tangent(bent.normal, bent.tangent);
        let within = bent
            .spread
            .map_or_else(SlopeCovariance::default, |s| s.within(&frame));
        let own_coat = bent.spread.map_or(0.0, |s| s.trace_about(bent.normal));
        let (widening, turn_rad) = Widening::new(within, own_coat, alphas);
        FilteredNormal {
            normal: bent.normal.to_array(),
            covariance: [within.xx, within.xy, within.yy],
            alphas: widening.of(alphas),
            coat_alpha: widening.of_own_coat(alphas[0]),
            turn_rad,
        }
    }

    /// A bent normal as a material's rules turn it back, and their factor on light from `wi`.
    ///
    /// * `directions`: the normals without and with the bump map, `wo`, and `wi`.
    ///
    /// # Panics
    /// Where there is no such material.
    #[must_use]
    pub fn softened_normal(&self, material: u32, directions: [[f32; 3]; 4]) -> SoftenedNormal {
        let [unbent, bent, wo, wi] = directions.map(Vec3::from);
        let place = TextureCoordinates::default();
        let chosen = (self.materials).at(material, &self.textures, &place, true, |_| 0.5);
        let (normal, softness) = match chosen.material.bump_rules {
            BumpRules::Mitsuba { fades } if chosen.material.bump.is_some() => {
                Softness::new(unbent, bent, wo, fades)
            }
            _ => (bent, None),
        };
        SoftenedNormal {
            normal: normal.to_array(),
            factor: softness.map_or(1.0, |s| s.factor(wi)),
        }
    }
}

/// What [`crate::geometry::Geometry::surface_at`] needs of a point of a primitive that is no curve.
fn near(at: &PrimitivePoint) -> [Vec3<f32>; 2] {
    [Vec3::from(at.near), Vec3::ZERO]
}

fn location(at: &PrimitivePoint) -> PrimitiveLocation {
    let [instance, primitive] = at.primitive;
    PrimitiveLocation {
        instance,
        primitive,
        weights: at.weights,
        time: 0.0,
    }
}

fn receiver(lit: &LitPoint) -> Receiver {
    Receiver {
        point: Vec3::from(lit.position),
        normal: lit.normal.map(Vec3::from),
    }
}
