//! Bytes as a measured material: an error or a sound scene, never a panic.
#![no_main]

use libfuzzer_sys::fuzz_target;
use specula_bsdf::{Bsdf, Transport, Vec3};
use specula_scene::measured::MeasuredBrdf;

fuzz_target!(|data: &[u8]| {
    let Ok(brdf) = MeasuredBrdf::from_bytes("fuzz", data) else {
        return;
    };
    let wo = Vec3 { x: 0.6, y: 0.0, z: 0.8 };
    for u in [[0.1, 0.2, 0.3], [0.5, 0.9, 0.7]] {
        if let Some(sample) = brdf.lobe().sample(wo, u, Transport::Radiance) {
            assert!(sample.pdf.is_finite() && sample.wi.is_finite());
        }
    }
});
