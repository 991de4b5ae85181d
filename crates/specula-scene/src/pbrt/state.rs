//! The graphics state that directives change and `AttributeBegin` saves.

use std::rc::Rc;

use glam::{DMat4, DVec3, DVec4};

use super::context::Entity;
use super::medium::Sides;
use super::param::Param;
use crate::error::{ErrorKind, Place, SceneError};
use crate::spectrum::ColourSpace;
use crate::transform::check_finite;

/// The material of shapes to come.
#[derive(Clone, Debug)]
pub(super) enum MaterialUse {
    /// pbrt-v4's default: diffuse.
    Default,
    /// The n-th material of the file.
    Defined(usize),
    /// One of a name, which may be defined later.
    Named(String, Place),
}

/// What `Attribute` sets parameters of.
pub(super) const ATTRIBUTE_TARGETS: [&str; 5] = ["shape", "light", "material", "medium", "texture"];

/// The graphics state.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// Transform to world space at the start and at the end: see [`Reader::times`](super::directive::Reader).
    pub(super) transforms: [DMat4; 2],
    /// Which of them directives change.
    pub(super) active: [bool; 2],
    pub(super) reverse_orientation: bool,
    pub(super) material: MaterialUse,
    /// Media inside and outside of shapes to come; the camera is in the latter.
    pub(super) media: Sides,
    pub(super) area_light: Option<Rc<Entity>>,
    /// The colour space of later RGB parameters.
    pub(super) space: ColourSpace,
    /// Parameters for each of [`ATTRIBUTE_TARGETS`].
    pub(super) attributes: [Vec<Rc<Param>>; 5],
}

impl State {
    pub(super) fn new() -> Self {
        Self {
            transforms: [DMat4::IDENTITY; 2],
            active: [true; 2],
            reverse_orientation: false,
            material: MaterialUse::Default,
            media: [None; 2],
            area_light: None,
            space: ColourSpace::Srgb,
            attributes: Default::default(),
        }
    }

    /// Replaces the active transforms.
    ///
    /// # Errors
    ///
    /// Where the result is not finite. One that cannot be inverted is a matter of what stands in it.
    pub(super) fn transform(
        &mut self,
        place: &Place,
        change: impl Fn(DMat4) -> DMat4,
    ) -> Result<(), SceneError> {
        for (transform, active) in self.transforms.iter_mut().zip(self.active) {
            if active {
                *transform = change(*transform);
                check_finite(transform)
                    .map_err(|m| SceneError::new(ErrorKind::Transform, place, m))?;
            }
        }
        Ok(())
    }

    /// The transform at the end, where it is another than that of the start.
    pub(super) fn end(&self) -> Option<DMat4> {
        let [start, end] = self.transforms;
        (start != end).then_some(end)
    }
}

/// World to camera, as pbrt-v4 defines it: the camera looks along +z, +y is up, +x is right.
pub(super) fn look_at(v: [f64; 9]) -> Option<DMat4> {
    let (eye, at, up) = (
        DVec3::new(v[0], v[1], v[2]),
        DVec3::new(v[3], v[4], v[5]),
        DVec3::new(v[6], v[7], v[8]),
    );
    let direction = (at - eye).try_normalize()?;
    let right = up.try_normalize()?.cross(direction).try_normalize()?;
    let new_up = direction.cross(right);
    let camera_to_world = DMat4::from_cols(
        right.extend(0.0),
        new_up.extend(0.0),
        direction.extend(0.0),
        DVec4::new(eye.x, eye.y, eye.z, 1.0),
    );
    Some(camera_to_world.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn look_at_puts_the_target_on_the_axis() {
        let m = look_at([1.0, 2.0, 3.0, 4.0, 6.0, 3.0, 0.0, 0.0, 1.0]).unwrap();
        let at = m.transform_point3(DVec3::new(4.0, 6.0, 3.0));
        assert!((at - DVec3::new(0.0, 0.0, 5.0)).length() < 1e-12);
        let above = m.transform_point3(DVec3::new(1.0, 2.0, 4.0));
        assert!((above - DVec3::Y).length() < 1e-12);
        // No mirror: pbrt's world is left-handed, as its camera space is.
        assert!((m.determinant() - 1.0).abs() < 1e-12);
        assert!(look_at([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0]).is_none());
    }
}
