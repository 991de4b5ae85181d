//! Lights for shaders: see `lights.wgsl` of the crate `specula-gpu`.

use super::delta::Delta;
use super::{Far, Lights, Source};
use crate::codes;
use crate::convert::id;
use crate::words::Words;

impl Lights {
    /// Every light, those at infinity, and how one is chosen.
    pub(crate) fn flatten(&self, to: &mut Words) {
        let places: Vec<u32> = self.sources.iter().map(|s| s.flatten(to)).collect();
        to.constant("LIGHT_COUNT", id(places.len()));
        self.say_what_there_is(to);
        to.begin("LIGHT_PLACES");
        to.ids(places);
        let far = self.far.iter();
        let far: Vec<[u32; 2]> = far.map(|(f, light)| [f.flatten(to), *light]).collect();
        to.constant("LIGHT_FAR_COUNT", id(far.len()));
        to.begin("LIGHT_FAR");
        to.ids(far.into_iter().flatten());
        self.selection.flatten(to);
    }
}

impl Lights {
    /// Constants by which shaders leave out what a scene lacks.
    fn say_what_there_is(&self, to: &mut Words) {
        let has = |test: fn(&Source) -> bool| u32::from(self.sources.iter().any(test));
        let projected = has(|s| matches!(s, Source::Delta(Delta::ProjectedImage(_))));
        let is_far = |test: fn(&Far) -> bool| u32::from(self.far.iter().any(|(far, _)| test(far)));
        for (name, value) in [
            ("LIGHT_HAS_AREA", has(|s| matches!(s, Source::Area { .. }))),
            (
                "LIGHT_HAS_TEXTURED",
                has(|s| matches!(s, Source::Textured(_))),
            ),
            ("LIGHT_HAS_DELTA", has(|s| matches!(s, Source::Delta(_)))),
            ("LIGHT_HAS_PROJECTED", projected),
            ("LIGHT_HAS_SUN", is_far(|f| matches!(f, Far::Sun(_)))),
            (
                "LIGHT_HAS_ENVIRONMENT",
                is_far(|f| matches!(f, Far::Environment(_))),
            ),
        ] {
            to.constant(name, value);
        }
        let areas = self.sources.iter().filter_map(|source| match source {
            Source::Area { area, .. } => Some(area.kind()),
            Source::Textured(light) => Some(light.area.kind()),
            _ => None,
        });
        let kinds: Vec<u32> = areas.collect();
        for (name, of) in [
            ("AREA_HAS_PARALLELOGRAM", &[codes::AREA_PARALLELOGRAM][..]),
            ("AREA_HAS_SPHERE", &[codes::AREA_SPHERE]),
            ("AREA_HAS_ELLIPSOID", &[codes::AREA_ELLIPSOID]),
            ("AREA_HAS_FLAT", &[codes::AREA_TRIANGLE, codes::AREA_DISK]),
        ] {
            to.constant(name, u32::from(kinds.iter().any(|kind| of.contains(kind))));
        }
    }
}

impl Source {
    /// Kind and parameters; returns their place.
    fn flatten(&self, to: &mut Words) -> u32 {
        // Arrays stand before the record that names them.
        let table = match self {
            Self::Textured(light) => light.flatten_table(to),
            _ => [0; 3],
        };
        let place = to.offset();
        match self {
            Self::Textured(light) => {
                to.id(codes::LIGHTS_TEXTURED);
                to.flag(light.two_sided);
                light.flatten(table, to);
            }
            Self::Area {
                area,
                radiance,
                two_sided,
            } => {
                to.id(codes::LIGHTS_AREA);
                to.flag(*two_sided);
                to.colour(*radiance);
                area.flatten(to);
            }
            Self::Far(number) => to.ids([codes::LIGHTS_FAR, id(*number)]),
            // No shader's: see `Lights::has_portals`.
            Self::Portal(_) => {}
            Self::Delta(delta) => {
                to.id(codes::LIGHTS_DELTA);
                delta.flatten(to);
            }
        }
        place
    }
}

impl Far {
    /// Kind and parameters; returns their place.
    fn flatten(&self, to: &mut Words) -> u32 {
        match self {
            Self::Environment(light) => light.flatten(codes::LIGHTS_ENVIRONMENT, to),
            Self::Sun(light) => {
                let place = to.offset();
                to.id(codes::LIGHTS_SUN);
                light.flatten(to);
                place
            }
        }
    }
}
