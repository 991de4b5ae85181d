//! `Camera`, with a file of its lenses.

use std::fmt::Write;

use super::{WriteError, Writer, list, quoted};
use crate::image::Image;
use crate::scene::{Camera, EnvironmentMapping, LensSystem, Projection};

impl Writer<'_> {
    /// The directive; lenses are written to a file beside the scene.
    pub(super) fn camera_text(&mut self, camera: &Camera) -> Result<String, WriteError> {
        let thin = format!(
            "\"float lensradius\" [ {} ] \"float focaldistance\" [ {} ] \"float screenwindow\" [ {} ]",
            camera.lens_radius,
            camera.focal_distance,
            list(&camera.screen_window),
        );
        let kind = match &camera.projection {
            Projection::Perspective { fov_deg } => {
                format!("\"perspective\" \"float fov\" [ {fov_deg} ] {thin}")
            }
            Projection::Orthographic => format!("\"orthographic\" {thin}"),
            Projection::Spherical(mapping) => format!(
                "\"spherical\" \"string mapping\" [ \"{}\" ]",
                match mapping {
                    EnvironmentMapping::EqualAreaOctahedral => "equalarea",
                    EnvironmentMapping::LatitudeLongitude
                    | EnvironmentMapping::LatitudeLongitudePoles => "equirectangular",
                }
            ),
            Projection::Lenses(lenses) => self.lenses(lenses, camera.focal_distance)?,
        };
        Ok(format!("Camera {kind}"))
    }

    fn lenses(&mut self, lenses: &LensSystem, distance: f64) -> Result<String, WriteError> {
        let mm = |metres: f64| metres * 1e3;
        let mut text = String::from("# curvature radius, thickness, eta, aperture diameter; mm\n");
        for i in &lenses.interfaces {
            let row = [
                mm(i.curvature_radius),
                mm(i.thickness),
                i.eta,
                2.0 * mm(i.aperture_radius),
            ];
            text.push_str(&list(&row));
            text.push('\n');
        }
        let stop = lenses.interfaces.iter().find(|i| i.curvature_radius == 0.0);
        let diameter = stop.map_or(1.0, |stop| 2.0 * mm(stop.aperture_radius));
        let name = self.asset("lenses.dat", || Ok(text.into_bytes()))?;
        let mut kind = format!(
            "\"realistic\" \"string lensfile\" [ {} ] \"float aperturediameter\" [ {diameter} ] \
             \"float focusdistance\" [ {distance} ]",
            quoted(&name)
        );
        if let Some(stop) = &lenses.stop {
            let rows = stop.values.chunks(stop.width as usize).rev();
            let picture = Image {
                name: String::new(),
                width: stop.width,
                height: stop.height,
                pixels: rows.flatten().map(|&v| [v; 3]).collect::<Vec<_>>().into(),
            };
            let name = self.picture("stop.exr", &picture, |c| c)?;
            let _ = write!(kind, " \"string aperture\" [ {} ]", quoted(&name));
        }
        Ok(kind)
    }
}
