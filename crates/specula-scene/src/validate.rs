//! Checks of a scene's invariants.

use std::cell::Cell;

use glam::{DMat4, DVec3};
use rayon::prelude::*;
use specula_bsdf::Rgb;

use crate::bounds::{self, FARTHEST};
use crate::image::Image;
use crate::mesh::{first, is_finite, is_zero};
use crate::scene::{
    CurveKind, CurveMesh, Filter, Geometry, ImageProjection, Light, Mesh, Motion, ObjectInstance,
    PatchMesh, Profile, Projection, Scene, Shape,
};
use crate::transform::mirrors;

/// A broken invariant of a scene.
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
    /// Checks the invariants that renderers rely on:
    ///
    /// * every index is in range; textures refer only to textures before them, mixed materials
    ///   only to materials before them;
    /// * every number is finite; colours, pictures, radii and roughnesses are not negative;
    ///   indices of refraction are above 0; directions of lights have length 1;
    /// * every transform is finite in `f32`, affine and invertible; what moves does not emit, and mirrors at both
    ///   ends of its motion or at neither;
    /// * meshes have triangles, patches or segments; attributes are empty or one per vertex; shading normals are not 0;
    /// * the picture has pixels, the crop lies in it and is not empty;
    /// * nothing reaches beyond 1e18 from the origin;
    /// * there is a shape, or an instance of an object that has one.
    ///
    /// # Errors
    ///
    /// The first invariant that is broken.
    pub fn validate(&self) -> Result<(), Invalid> {
        self.each_fault(Err)
    }

    /// Calls `take` for every part that breaks an invariant, with the first that it breaks, until `take`
    /// itself fails.
    ///
    /// # Errors
    ///
    /// That of `take`.
    pub(crate) fn each_fault<E>(
        &self,
        mut take: impl FnMut(Invalid) -> Result<(), E>,
    ) -> Result<(), E> {
        let sound = Cell::new(true);
        let mut hear = |part: Result<(), Invalid>| {
            sound.set(sound.get() && part.is_ok());
            part.or_else(&mut take)
        };
        hear(self.check_picture())?;
        for (i, image) in self.images.iter().enumerate() {
            hear(check_image(&format!("image {i} ({})", image.name), image))?;
        }
        for (i, texture) in self.textures.iter().enumerate() {
            hear(self.check_texture(i, texture))?;
        }
        for (i, material) in self.materials.iter().enumerate() {
            hear(self.check_material(i, material))?;
        }
        let meshes = self.meshes.par_iter().enumerate();
        let checked: Vec<_> = meshes
            .map(|(i, mesh)| check_mesh(&format!("mesh {i}"), mesh))
            .collect();
        for mesh in checked {
            hear(mesh)?;
        }
        for (i, mesh) in self.patch_meshes.iter().enumerate() {
            hear(check_patch_mesh(&format!("patch mesh {i}"), mesh))?;
        }
        for (i, curves) in self.curve_meshes.iter().enumerate() {
            hear(check_curves(&format!("curves {i}"), curves))?;
        }
        for (i, shape) in self.shapes.iter().enumerate() {
            hear(self.check_shape(&format!("shape {i}"), shape))?;
        }
        for object in &self.objects {
            for (i, shape) in object.shapes.iter().enumerate() {
                let what = format!("shape {i} of object {}", object.name);
                hear(self.check_shape(&what, shape))?;
            }
        }
        for (i, instance) in self.instances.iter().enumerate() {
            hear(self.check_instance(&format!("instance {i}"), instance))?;
        }
        for (i, light) in self.lights.iter().enumerate() {
            hear(self.check_light(&format!("light {i}"), light))?;
        }
        hear(ensure(
            self.floor.is_none_or(|id| id.0 < self.materials.len()),
            "scene",
            "the material of its floor is out of range",
        ))?;
        hear(ensure(
            !(self.shapes.is_empty() && self.instances.is_empty()),
            "scene",
            "there is no shape",
        ))?;
        if !sound.get() {
            // Without sound indices there are no bounds.
            return Ok(());
        }
        let reach = bounds::of_scene(self).farthest();
        hear(ensure(
            reach <= FARTHEST,
            "scene",
            "it reaches beyond 1e18 from the origin",
        ))
    }

    fn check_instance(&self, what: &str, instance: &ObjectInstance) -> Result<(), Invalid> {
        let object = self.objects.get(instance.object.0);
        ensure(
            object.is_some_and(|o| !o.shapes.is_empty()),
            what,
            "its object has no shapes",
        )?;
        check_transform(what, &instance.to_world)?;
        check_motion(what, &instance.to_world, instance.motion.as_ref())?;
        let emits = object.is_some_and(|o| o.shapes.iter().any(|s| s.emission.is_some()));
        ensure(instance.motion.is_none() || !emits, what, EMITS)
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
        ensure(
            film.max_component.is_none_or(|m| m.is_finite() && m > 0.0),
            "film",
            "its largest component is not above 0",
        )?;
        ensure(
            film.balance.iter().flatten().all(|x| x.is_finite()),
            "film",
            "its white balance is not finite",
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
        check_motion("camera", &camera.to_world, camera.motion.as_ref())?;
        if let Projection::Perspective { fov_deg } = camera.projection {
            ensure(
                fov_deg > 0.0 && fov_deg < 180.0,
                "camera",
                "its field of view is not in (0, 180)",
            )?;
        }
        if let Projection::Lenses(lenses) = &camera.projection {
            ensure(
                lenses.is_sound(),
                "camera",
                "a number of its lenses is out of range",
            )?;
        }
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

    fn check_shape(&self, what: &str, shape: &Shape) -> Result<(), Invalid> {
        check_transform(what, &shape.to_world)?;
        check_motion(what, &shape.to_world, shape.motion.as_ref())?;
        ensure(
            shape.motion.is_none() || shape.emission.is_none(),
            what,
            EMITS,
        )?;
        ensure(
            shape.material.0 < self.materials.len(),
            what,
            "its material is out of range",
        )?;
        self.float(what, shape.alpha)?;
        if let Some(emission) = shape.emission {
            self.colour(&format!("emission of {what}"), emission.radiance)?;
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
            Geometry::QuadricPart(part) => match part.fault() {
                Some(fault) => ensure(false, what, fault),
                None => Ok(()),
            },
            Geometry::Patches(id) => ensure(
                id.0 < self.patch_meshes.len(),
                what,
                "its mesh of patches is out of range",
            ),
            Geometry::Curves(id) => ensure(
                id.0 < self.curve_meshes.len(),
                what,
                "its curves are out of range",
            ),
        }
    }

    /// Environment lights, behind portals or not.
    fn check_sky(&self, what: &str, light: &Light) -> Result<(), Invalid> {
        let (Light::Infinite {
            radiance,
            image,
            to_world,
        }
        | Light::Portal {
            radiance,
            image,
            to_world,
            ..
        }) = light
        else {
            return Ok(());
        };
        ensure(
            is_light(*radiance),
            what,
            "its colour is negative or not finite",
        )?;
        check_transform(what, to_world)?;
        let good = image.is_none_or(|(id, _)| id.0 < self.images.len());
        ensure(good, what, "its image is out of range")?;
        match light {
            Light::Portal { corners, .. } => {
                ensure(is_rectangle(corners), what, "its portal is no rectangle")
            }
            _ => Ok(()),
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
            Light::Infinite { .. } | Light::Portal { .. } => self.check_sky(what, light),
            Light::Distant {
                irradiance,
                to_light,
                half_angle_deg,
            } => {
                colour(*irradiance)?;
                unit(to_light)?;
                ensure(
                    (0.0..90.0).contains(half_angle_deg),
                    what,
                    "its angle is not in [0, 90)",
                )
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
                falloff: _,
            } => {
                colour(*intensity)?;
                point(position)?;
                unit(axis)?;
                let cone = *cone_angle_deg > 0.0 && *cone_angle_deg <= 180.0;
                let falloff = *falloff_start_deg >= 0.0 && falloff_start_deg <= cone_angle_deg;
                ensure(cone && falloff, what, "its cone is out of range")
            }
            Light::Picture {
                to_world,
                intensity,
                image_projection,
            } => {
                self.colour(what, *intensity)?;
                check_transform(what, to_world)?;
                point(&to_world.w_axis.truncate().to_array())?;
                ensure(
                    is_throw(image_projection),
                    what,
                    "its window is out of range",
                )
            }
        }
    }
}

/// What a fault says of a light that moves.
const EMITS: &str = "it moves and emits";

fn check_motion(what: &str, start: &DMat4, motion: Option<&Motion>) -> Result<(), Invalid> {
    let Some(Motion { end, times }) = motion else {
        return Ok(());
    };
    check_transform(&format!("end of the motion of {what}"), end)?;
    ensure(
        mirrors(start) == mirrors(end),
        what,
        "its motion turns it inside out",
    )?;
    ensure(
        times[0] < times[1] && times.iter().all(|t| t.is_finite()),
        what,
        "the times of its motion do not ascend",
    )
}

fn is_throw(image_projection: &ImageProjection) -> bool {
    let ImageProjection::Window { half, profile } = image_projection else {
        return true;
    };
    let cone = match profile {
        Profile::Spot {
            cone_angle_deg: cone,
            falloff_start_deg: start,
        } => *cone > 0.0 && *cone < 90.0 && *start >= 0.0 && start <= cone,
        Profile::Intensity | Profile::Irradiance => true,
    };
    cone && half.iter().all(|h| *h > 0.0 && h.is_finite())
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
    crate::transform::check_transform(m).map_err(|problem| Invalid {
        what: what.to_owned(),
        problem: problem.to_owned(),
    })
}

fn check_image(what: &str, image: &Image) -> Result<(), Invalid> {
    let count = u64::from(image.width) * u64::from(image.height);
    ensure(
        count > 0 && count == image.pixels.len() as u64,
        what,
        "pixels do not match its size",
    )?;
    let bad = |v: f32| !(v.is_finite() && v >= 0.0);
    ensure(
        image.pixels.position(bad).is_none(),
        what,
        "a pixel is negative or not finite",
    )
}

/// Whether four points are the corners of a rectangle, one after the other, up to a thousandth of a right angle:
/// what pbrt-v4 takes for a portal.
pub(crate) fn is_rectangle(corners: &[[f64; 3]; 4]) -> bool {
    const TOLERANCE: f64 = 1e-3;
    let corner = |i: usize| DVec3::from(corners[i % 4]);
    let sides: [DVec3; 4] = std::array::from_fn(|i| corner(i + 1) - corner(i));
    let lengths = sides.map(DVec3::length);
    if !lengths.iter().all(|l| *l > 0.0 && l.is_finite()) {
        return false;
    }
    let cosine = |i: usize, k: usize| sides[i].dot(sides[k]) / (lengths[i] * lengths[k]);
    let opposite = [cosine(0, 2), cosine(1, 3)];
    let at_corners = [cosine(0, 1), cosine(1, 2), cosine(2, 3), cosine(3, 0)];
    opposite.iter().all(|c| (c + 1.0).abs() <= TOLERANCE)
        && at_corners.iter().all(|c| c.abs() <= TOLERANCE)
}

fn check_patch_mesh(what: &str, mesh: &PatchMesh) -> Result<(), Invalid> {
    ensure(!mesh.patches.is_empty(), what, "it has no patches")?;
    let count = mesh.positions.len();
    let is_outside = mesh.patches.iter().flatten().any(|i| *i as usize >= count);
    ensure(
        !is_outside,
        what,
        "a patch refers to a vertex that does not exist",
    )?;
    check_vertices(what, [&mesh.positions, &mesh.normals], &mesh.uvs)
}

fn check_curves(what: &str, curves: &CurveMesh) -> Result<(), Invalid> {
    let count = curves.segments.len();
    ensure(count > 0, what, "they have no segments")?;
    let controls = curves.segments.as_flattened();
    ensure(
        first(controls, |p| !is_finite(p)).is_none(),
        what,
        "a control point is not finite",
    )?;
    let is_width = |w: &f32| w.is_finite() && *w >= 0.0;
    ensure(
        curves.width_at_ends.len() == count
            && curves.width_at_ends.as_flattened().iter().all(is_width),
        what,
        "they have not one width at each end of a segment, none negative",
    )?;
    let expected = match curves.kind {
        CurveKind::Ribbon => count,
        CurveKind::Flat | CurveKind::Cylinder => 0,
    };
    let is_unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-3;
    ensure(
        curves.normals.len() == expected && curves.normals.as_flattened().iter().all(is_unit),
        what,
        "ribbons have not one unit normal at each end of a segment, or others have some",
    )
}

fn check_mesh(what: &str, mesh: &Mesh) -> Result<(), Invalid> {
    let count = mesh.positions.len();
    ensure(!mesh.triangles.is_empty(), what, "it has no triangles")?;
    let outside = |t: &[u32; 3]| t.iter().fold(false, |any, i| any | (*i as usize >= count));
    ensure(
        first(&mesh.triangles, outside).is_none(),
        what,
        "a triangle refers to a vertex that does not exist",
    )?;
    check_vertices(what, [&mesh.positions, &mesh.normals], &mesh.uvs)?;
    ensure(
        [0, count].contains(&mesh.colours.len())
            && mesh
                .colours
                .iter()
                .flatten()
                .all(|x| x.is_finite() && *x >= 0.0),
        what,
        "it has not one colour per vertex, none negative",
    )?;
    ensure(
        [0, count].contains(&mesh.second_uvs.len()) && [0, count].contains(&mesh.tangents.len()),
        what,
        "it has not one second coordinate and one tangent per vertex",
    )?;
    let has_finite_uvs = first(&mesh.second_uvs, |uv| !is_finite(uv)).is_none();
    ensure(
        has_finite_uvs && first(&mesh.tangents, |t| !is_finite(t)).is_none(),
        what,
        "a second surface coordinate or a tangent is not finite",
    )
}

/// What vertices of triangles and of patches have.
fn check_vertices(
    what: &str,
    [positions, normals]: [&[[f32; 3]]; 2],
    uvs: &[[f32; 2]],
) -> Result<(), Invalid> {
    let count = positions.len();
    let not_finite = |p: &[f32; 3]| !is_finite(p);
    ensure(
        first(positions, not_finite).is_none(),
        what,
        "a vertex is not finite",
    )?;
    ensure(
        [0, count].contains(&normals.len()),
        what,
        "it has not one normal per vertex",
    )?;
    ensure(
        [0, count].contains(&uvs.len()),
        what,
        "it has not one surface coordinate per vertex",
    )?;
    let no_normal = |n: &[f32; 3]| !is_finite(n) | is_zero(n);
    ensure(
        first(normals, no_normal).is_none(),
        what,
        "a normal is 0 or not finite",
    )?;
    ensure(
        first(uvs, |uv| !is_finite(uv)).is_none(),
        what,
        "a surface coordinate is not finite",
    )
}

pub(crate) mod surface;

#[cfg(test)]
mod tests;
