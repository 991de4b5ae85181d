//! A deterministic path tracer on the CPU.
