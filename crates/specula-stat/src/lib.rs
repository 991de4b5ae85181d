//! Statistical proof for samplers and BSDFs.
