//! `sphere`, `disk` and `cylinder`.

use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::pbrt::context::Entity;
use crate::scene::{Geometry, QuadricPart};

/// Reads a shape: whole spheres and disks, or parts.
pub(super) fn read(entity: &Entity) -> Result<Geometry, SceneError> {
    let params = &entity.params;
    let radius = params.float_above("radius", 1.0, 0.0)?;
    let phi_deg = params.float_above("phimax", 360.0, 0.0)?.min(360.0);
    let phi_max = f32_of(phi_deg.to_radians());
    let turn = phi_deg >= 360.0;
    let wrong = |place, message| SceneError::new(ErrorKind::Parameter, place, message);
    if entity.name == "disk" {
        let height = f32_of(params.float("height", 0.0)?);
        let inner = params.float_from_zero("innerradius", 0.0)?;
        if f32_of(inner) >= f32_of(radius) {
            let message =
                format!("\"innerradius\": expected less than the radius {radius}, found {inner}");
            return Err(wrong(&params.place_of("innerradius"), message));
        }
        let (radius, inner) = (f32_of(radius), f32_of(inner));
        if turn && inner == 0.0 {
            return Ok(Geometry::Disk { radius, height });
        }
        return Ok(Geometry::QuadricPart(QuadricPart::Disk {
            radius,
            inner,
            height,
            phi_max,
        }));
    }
    let sphere = entity.name == "sphere";
    let reach = if sphere { radius } else { f64::INFINITY };
    let default = if sphere { radius } else { 1.0 };
    let a = params.float("zmin", -default)?.clamp(-reach, reach);
    let b = params.float("zmax", default)?.clamp(-reach, reach);
    let z = [a.min(b), a.max(b)].map(f32_of);
    if z[0] == z[1] {
        let message = "expected \"zmin\" below \"zmax\"".to_owned();
        return Err(wrong(&entity.place, message));
    }
    let radius = f32_of(radius);
    if sphere && turn && z == [-radius, radius] {
        return Ok(Geometry::Sphere { radius });
    }
    Ok(Geometry::QuadricPart(match sphere {
        true => QuadricPart::Sphere { radius, z, phi_max },
        false => QuadricPart::Cylinder { radius, z, phi_max },
    }))
}
