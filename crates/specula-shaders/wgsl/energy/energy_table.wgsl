// The values of all energy tables, as a storage buffer.
//
// The only module with a binding. Who stores the tables elsewhere (a texture, a constant buffer of the
// part that is used) leaves this module out and writes `energy_table` himself.

/// The tables, as the crate `specula-shaders` gives them: `tables()`, little-endian.
@group(0) @binding(0) var<storage, read> specula_tables: array<f32>;

/// The value at `index` of the tables; modules that read them state their offsets.
///
/// Twin: specula-shaders/src/tables.rs, tables.
fn energy_table(index: u32) -> f32 {
    return specula_tables[index];
}
