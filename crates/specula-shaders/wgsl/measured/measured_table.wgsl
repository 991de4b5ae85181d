// The numbers of measured materials.
//
// They are read from the array of the energy tables. Who has no such tables binds a measured material there, at
// place 0; who has, appends materials. Who stores them elsewhere leaves this module out and writes `measured_table`
// himself.

import package::energy::energy_table::{energy_table};

/// The number at `index` of the array that holds measured materials.
///
/// Twin: specula-bsdf/src/measured/packed.rs, Measured::packed.
fn measured_table(index: u32) -> f32 {
    return energy_table(index);
}
