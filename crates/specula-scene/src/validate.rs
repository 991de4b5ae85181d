//! The invariants of a scene, checked.

use glam::DMat4;
use specula_bsdf::Rgb;

use crate::bounds::{self, FARTHEST};
use crate::scene::{
    ColourParam, ConductorFresnel, Filter, FloatParam, Geometry, Light, MaterialKind, Mesh,
    Roughness, Scene, Shape, Texture,
};

/// Which invariant a scene breaks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {problem}")]
pub struct Invalid {
    what: String,
    problem: String,
}

impl Invalid {
    /// The part of the scene, such as `material 3`.
    pub fn what(&self) -> &str {
        &self.what
    }

    /// What is wrong with it.
    pub fn problem(&self) -> &str {
        &self.problem
    }
}

fn ensure(holds: bool, what: &str, problem: &str) -> Result<(), Invalid> {
    if holds {
        return Ok(());
    }
    Err(Invalid {
        what: what.to_owned(),
        problem: problem.to_owned(),
    })
}

impl Scene {
    /// Checks that renderers may rely on the scene:
    ///
    /// * every index is in range; textures refer only to textures before them, mixed materials
    ///   only to materials before them;
    /// * every number is finite; colours, pictures, radii and roughnesses are not negative;
    ///   indices of refraction are above 0; directions of lights have length 1;
    /// * every transform is finite in `f32`, affine and invertible;
    /// * meshes have triangles; attributes are empty or one per vertex; shading normals are not 0;
    /// * the picture has pixels, the crop lies in it and is not empty;
    /// * nothing reaches beyond 1e18 from the origin;
    /// * there is something to see: a shape, or an instance of an object that has one.
    ///
    /// # Errors
    ///
    /// The first invariant that is broken.
    pub fn validate(&self) -> Result<(), Invalid> {
        self.check_picture()?;
        for (i, image) in self.images.iter().enumerate() {
            let what = format!("image {i} ({})", image.name);
            let count = u64::from(image.width) * u64::from(image.height);
            ensure(
                count > 0 && count == image.pixels.len() as u64,
                &what,
                "pixels do not match its size",
            )?;
            let good = image
                .pixels
                .iter()
                .flatten()
                .all(|v| v.is_finite() && *v >= 0.0);
            ensure(good, &what, "a pixel is negative or not finite")?;
        }
        for (i, texture) in self.textures.iter().enumerate() {
            self.check_texture(i, texture)?;
        }
        for (i, material) in self.materials.iter().enumerate() {
            self.check_material(i, &material.kind)?;
        }
        for (i, mesh) in self.meshes.iter().enumerate() {
            check_mesh(&format!("mesh {i}"), mesh)?;
        }
        for (i, shape) in self.shapes.iter().enumerate() {
            self.check_shape(&format!("shape {i}"), shape)?;
        }
        for object in &self.objects {
            for (i, shape) in object.shapes.iter().enumerate() {
                self.check_shape(&format!("shape {i} of object {}", object.name), shape)?;
            }
        }
        for (i, instance) in self.instances.iter().enumerate() {
            let what = format!("instance {i}");
            let object = self.objects.get(instance.object.0);
            ensure(
                object.is_some_and(|o| !o.shapes.is_empty()),
                &what,
                "its object has no shapes",
            )?;
            check_transform(&what, &instance.to_world)?;
        }
        for (i, light) in self.lights.iter().enumerate() {
            self.check_light(&format!("light {i}"), light)?;
        }
        ensure(
            !(self.shapes.is_empty() && self.instances.is_empty()),
            "scene",
            "there is no shape",
        )?;
        let reach = bounds::of_scene(self).farthest();
        ensure(
            reach <= FARTHEST,
            "scene",
            "it reaches beyond 1e18 from the origin",
        )
    }

    fn check_picture(&self) -> Result<(), Invalid> {
        let film = &self.film;
        let ([width, height], [x0, x1, y0, y1]) = (film.resolution, film.crop);
        ensure(width > 0 && height > 0, "film", "it has no pixels")?;
        ensure(
            x0 < x1 && x1 <= width && y0 < y1 && y1 <= height,
            "film",
            "its crop is empty or outside",
        )?;
        ensure(
            film.exposure.is_finite() && film.exposure > 0.0,
            "film",
            "its exposure is not above 0",
        )?;
        let (Filter::Box { radius }
        | Filter::Triangle { radius }
        | Filter::Gaussian { radius, .. }
        | Filter::Mitchell { radius, .. }
        | Filter::LanczosSinc { radius, .. }) = film.filter;
        ensure(
            radius.iter().all(|r| r.is_finite() && *r > 0.0),
            "filter",
            "its radius is not above 0",
        )?;
        let shape = match film.filter {
            Filter::Gaussian { sigma, .. } => sigma > 0.0 && sigma.is_finite(),
            Filter::Mitchell { b, c, .. } => b.is_finite() && c.is_finite(),
            Filter::LanczosSinc { tau, .. } => tau > 0.0 && tau.is_finite(),
            Filter::Box { .. } | Filter::Triangle { .. } => true,
        };
        ensure(shape, "filter", "a parameter is out of range")?;
        ensure(
            self.settings.samples_per_pixel > 0,
            "settings",
            "no samples are asked for",
        )?;
        let camera = &self.camera;
        check_transform("camera", &camera.to_world)?;
        ensure(
            camera.fov_deg > 0.0 && camera.fov_deg < 180.0,
            "camera",
            "its field of view is not in (0, 180)",
        )?;
        ensure(
            camera.lens_radius >= 0.0 && camera.lens_radius.is_finite(),
            "camera",
            "its lens is negative",
        )?;
        ensure(
            camera.focal_distance > 0.0 && camera.focal_distance.is_finite(),
            "camera",
            "its focus is not above 0",
        )?;
        let [x0, x1, y0, y1] = camera.screen_window;
        let window = x0 < x1 && y0 < y1 && camera.screen_window.iter().all(|x| x.is_finite());
        ensure(window, "camera", "its screen window is empty")
    }

    fn float(&self, what: &str, param: FloatParam) -> Result<(), Invalid> {
        match param {
            FloatParam::Value(x) => ensure(
                x.is_finite() && x >= 0.0,
                what,
                "a number is negative or not finite",
            ),
            FloatParam::Texture(id) => ensure(
                id.0 < self.textures.len(),
                what,
                "a texture is out of range",
            ),
        }
    }

    fn colour(&self, what: &str, param: ColourParam) -> Result<(), Invalid> {
        match param {
            ColourParam::Value(c) => {
                ensure(is_light(c), what, "a colour is negative or not finite")
            }
            ColourParam::Texture(id) => ensure(
                id.0 < self.textures.len(),
                what,
                "a texture is out of range",
            ),
        }
    }

    fn roughness(&self, what: &str, roughness: &Roughness) -> Result<(), Invalid> {
        self.float(what, roughness.u)?;
        self.float(what, roughness.v)
    }

    fn fresnel(&self, what: &str, fresnel: &ConductorFresnel) -> Result<(), Invalid> {
        match *fresnel {
            ConductorFresnel::Index { eta, k } => {
                self.colour(what, eta)?;
                self.colour(what, k)
            }
            ConductorFresnel::Reflectance(c) => self.colour(what, c),
        }
    }

    fn check_texture(&self, i: usize, texture: &Texture) -> Result<(), Invalid> {
        let what = format!("texture {i}");
        let before = |ids: &[usize]| {
            ensure(
                ids.iter().all(|j| *j < i),
                &what,
                "it refers to a texture after it",
            )
        };
        match texture {
            Texture::Constant(c) => ensure(
                [c.r, c.g, c.b].iter().all(|x| x.is_finite()),
                &what,
                "it is not finite",
            ),
            Texture::Image {
                image,
                mapping,
                scale,
                ..
            } => {
                ensure(
                    image.0 < self.images.len(),
                    &what,
                    "its image is out of range",
                )?;
                let numbers = [mapping.scale, mapping.offset, [*scale, 0.0]];
                ensure(
                    numbers.iter().flatten().all(|x| x.is_finite()),
                    &what,
                    "a number is not finite",
                )
            }
            Texture::Scale { a, b } => before(&[a.0, b.0]),
            Texture::Mix { a, b, amount } => {
                before(&[a.0, b.0])?;
                match amount {
                    FloatParam::Texture(id) => before(&[id.0]),
                    FloatParam::Value(x) => {
                        ensure(x.is_finite(), &what, "its amount is not finite")
                    }
                }
            }
            Texture::Checkerboard { even, odd, mapping } => {
                before(&[even.0, odd.0])?;
                let numbers = [mapping.scale, mapping.offset];
                ensure(
                    numbers.iter().flatten().all(|x| x.is_finite()),
                    &what,
                    "a number is not finite",
                )
            }
        }
    }

    fn check_material(&self, i: usize, kind: &MaterialKind) -> Result<(), Invalid> {
        let what = &format!("material {i}");
        let eta = |eta: f32| {
            ensure(
                eta > 0.0 && eta.is_finite(),
                what,
                "its index is not above 0",
            )
        };
        match kind {
            MaterialKind::Diffuse {
                reflectance,
                roughness,
            } => {
                self.colour(what, *reflectance)?;
                self.float(what, *roughness)
            }
            MaterialKind::DiffuseTransmission {
                reflectance,
                transmittance,
            } => {
                self.colour(what, *reflectance)?;
                self.colour(what, *transmittance)
            }
            MaterialKind::Conductor { fresnel, roughness } => {
                self.fresnel(what, fresnel)?;
                self.roughness(what, roughness)
            }
            MaterialKind::Dielectric { eta: e, roughness } => {
                eta(*e)?;
                self.roughness(what, roughness)
            }
            MaterialKind::ThinDielectric { eta: e } => eta(*e),
            MaterialKind::CoatedDiffuse {
                reflectance,
                eta: e,
                roughness,
            } => {
                self.colour(what, *reflectance)?;
                eta(*e)?;
                self.roughness(what, roughness)
            }
            MaterialKind::CoatedConductor {
                coat_eta,
                coat_roughness,
                fresnel,
                roughness,
            } => {
                eta(*coat_eta)?;
                self.roughness(what, coat_roughness)?;
                self.fresnel(what, fresnel)?;
                self.roughness(what, roughness)
            }
            MaterialKind::Mix { materials, amount } => {
                ensure(
                    materials.iter().all(|m| m.0 < i),
                    what,
                    "it mixes a material after it",
                )?;
                self.float(what, *amount)
            }
            MaterialKind::Interface => Ok(()),
        }
    }

    fn check_shape(&self, what: &str, shape: &Shape) -> Result<(), Invalid> {
        check_transform(what, &shape.to_world)?;
        ensure(
            shape.material.0 < self.materials.len(),
            what,
            "its material is out of range",
        )?;
        self.float(what, shape.alpha)?;
        if let Some(emission) = shape.emission {
            ensure(
                is_light(emission.radiance),
                what,
                "its emission is negative or not finite",
            )?;
        }
        match shape.geometry {
            Geometry::Mesh(id) => {
                ensure(id.0 < self.meshes.len(), what, "its mesh is out of range")
            }
            Geometry::Sphere { radius } => ensure(
                radius > 0.0 && radius.is_finite(),
                what,
                "its radius is not above 0",
            ),
            Geometry::Disk { radius, height } => {
                ensure(
                    radius > 0.0 && radius.is_finite(),
                    what,
                    "its radius is not above 0",
                )?;
                ensure(height.is_finite(), what, "its height is not finite")
            }
        }
    }

    fn check_light(&self, what: &str, light: &Light) -> Result<(), Invalid> {
        let colour =
            |c: Rgb<f32>| ensure(is_light(c), what, "its colour is negative or not finite");
        let point = |p: &[f64; 3]| {
            ensure(
                p.iter().all(|x| x.abs() <= FARTHEST),
                what,
                "its position is too far",
            )
        };
        let unit = |v: &[f64; 3]| {
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            ensure(
                (length - 1.0).abs() < 1e-6,
                what,
                "its direction has not length 1",
            )
        };
        match light {
            Light::Infinite {
                radiance,
                image,
                to_world,
            } => {
                colour(*radiance)?;
                check_transform(what, to_world)?;
                let good = image.is_none_or(|(id, _)| id.0 < self.images.len());
                ensure(good, what, "its image is out of range")
            }
            Light::Distant {
                irradiance,
                to_light,
            } => {
                colour(*irradiance)?;
                unit(to_light)
            }
            Light::Point {
                position,
                intensity,
            } => {
                colour(*intensity)?;
                point(position)
            }
            Light::Spot {
                position,
                axis,
                intensity,
                cone_angle_deg,
                falloff_start_deg,
            } => {
                colour(*intensity)?;
                point(position)?;
                unit(axis)?;
                let cone = *cone_angle_deg > 0.0 && *cone_angle_deg <= 180.0;
                let falloff = *falloff_start_deg >= 0.0 && falloff_start_deg <= cone_angle_deg;
                ensure(cone && falloff, what, "its cone is out of range")
            }
        }
    }
}

fn is_light(c: Rgb<f32>) -> bool {
    [c.r, c.g, c.b].iter().all(|x| x.is_finite() && *x >= 0.0)
}

fn check_transform(what: &str, m: &DMat4) -> Result<(), Invalid> {
    ensure(
        m.row(3) == glam::DVec4::W,
        what,
        "its transform is not affine",
    )?;
    crate::pbrt::check_transform(m).map_err(|problem| Invalid {
        what: what.to_owned(),
        problem: problem.to_owned(),
    })
}

fn check_mesh(what: &str, mesh: &Mesh) -> Result<(), Invalid> {
    let count = mesh.positions.len();
    ensure(!mesh.triangles.is_empty(), what, "it has no triangles")?;
    let inside = mesh
        .triangles
        .iter()
        .flatten()
        .all(|i| (*i as usize) < count);
    ensure(
        inside,
        what,
        "a triangle refers to a vertex that does not exist",
    )?;
    let finite = mesh.positions.iter().flatten().all(|x| x.is_finite());
    ensure(finite, what, "a vertex is not finite")?;
    ensure(
        [0, count].contains(&mesh.normals.len()),
        what,
        "it has not one normal per vertex",
    )?;
    ensure(
        [0, count].contains(&mesh.uvs.len()),
        what,
        "it has not one surface coordinate per vertex",
    )?;
    let normals = mesh
        .normals
        .iter()
        .all(|n| n.iter().all(|x| x.is_finite()) && *n != [0.0; 3]);
    ensure(normals, what, "a normal is 0 or not finite")?;
    ensure(
        mesh.uvs.iter().flatten().all(|x| x.is_finite()),
        what,
        "a surface coordinate is not finite",
    )
}

#[cfg(test)]
mod tests;
