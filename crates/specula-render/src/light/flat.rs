//! Lights for shaders: see `lights.wgsl` of the crate `specula-gpu`.

use super::{Far, Lights, Source};
use crate::convert::id;
use crate::flat::Flattening;

/// Kinds of lights: the first word of each.
const AREA: u32 = 0;
const FAR: u32 = 1;
const DELTA: u32 = 2;
/// Without a twin: never lit.
const UNKNOWN: u32 = 3;
/// Kinds of lights with extent at infinity.
const ENVIRONMENT: u32 = 0;
const SUN: u32 = 1;

impl Lights {
    /// Every light, those at infinity, and how one is chosen.
    pub(crate) fn flatten(&self, to: &mut Flattening) {
        let places: Vec<u32> = self.sources.iter().map(|s| s.flatten(to)).collect();
        to.words.constant("LIGHT_COUNT", id(places.len()));
        to.words.begin("LIGHT_PLACES");
        to.words.ids(places);
        let far = self.far.iter();
        let far: Vec<[u32; 2]> = far.map(|(f, light)| [f.flatten(to), *light]).collect();
        to.words.constant("LIGHT_FAR_COUNT", id(far.len()));
        to.words.begin("LIGHT_FAR");
        to.words.ids(far.into_iter().flatten());
        self.selection.flatten(&mut to.words);
    }
}

impl Source {
    /// Kind and parameters; returns their place.
    fn flatten(&self, to: &mut Flattening) -> u32 {
        let place = to.words.place();
        match self {
            Self::Area {
                area,
                radiance,
                two_sided,
            } => {
                to.words.id(AREA);
                to.words.flag(*two_sided);
                to.words.colour(*radiance);
                area.flatten(&mut to.words);
            }
            Self::Textured(_) => {
                to.lacks("shapes that shine with a texture or an opacity");
                to.words.id(UNKNOWN);
            }
            Self::Far(number) => to.words.ids([FAR, id(*number)]),
            Self::Delta(delta) => {
                to.words.id(DELTA);
                delta.flatten(to);
            }
        }
        place
    }
}

impl Far {
    /// Kind and parameters; returns their place.
    fn flatten(&self, to: &mut Flattening) -> u32 {
        match self {
            Self::Environment(light) => light.flatten(ENVIRONMENT, &mut to.words),
            Self::Sun(light) => {
                let place = to.words.place();
                to.words.id(SUN);
                light.flatten(&mut to.words);
                place
            }
        }
    }
}
