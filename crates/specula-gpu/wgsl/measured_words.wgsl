// The numbers of measured materials, in place of the library's module `measured_table`: words of the scene.

import tracer::world::{number};

/// The number at `index` of the scene's words.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_table(index: u32) -> f32 {
    return number(index);
}
