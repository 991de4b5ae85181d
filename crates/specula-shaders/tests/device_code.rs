//! The C++ header for GPUs: clang compiles every function of it to NVIDIA's PTX and to AMD's machine code, without
//! warnings. Neither CUDA's toolkit nor ROCm is needed: clang's own headers declare what its code calls.

#![allow(clippy::unwrap_used, reason = "a panic is a failed test")]

mod tools;

use specula_shaders::{Language, export};
use tools::{Folder, STRICT};

/// What compiles is the device's half.
const DEVICE: [&str; 4] = ["--cuda-device-only", "-S", "-o", "whole.s"];

/// Compiles all of the library for a device, and the same with a function that devices do not have.
///
/// * `functions`: what stands in front of a function in the device's code; there are so many of them at least as
///   the header has.
#[track_caller]
fn compiles_for_the_device(what: &str, flags: &[&str], functions: &str) {
    let Some(clang) = tools::program("clang++", what) else {
        return;
    };
    let folder = Folder::with(&export(Language::Cpp, &[]).unwrap());
    // Functions that no kernel calls are compiled and checked, too.
    folder.write(
        "whole.cpp",
        "#define SPECULA_FN __device__ __attribute__((used)) inline\n#include \"specula.hpp\"\n",
    );
    folder.write("cuda.h", include_str!("tools/cuda.h"));
    folder.write("hip.h", include_str!("tools/hip.h"));
    let all = [flags, STRICT, &DEVICE, &["whole.cpp"]].concat();
    folder.accepted(&clang, &all);
    let header = folder.read("specula.hpp");
    let declared = header.matches("\nSPECULA_FN ").count();
    let compiled = folder.read("whole.s").matches(functions).count();
    assert!(declared > 500, "{declared} functions in the header");
    assert!(compiled >= declared, "{compiled} of {declared}");

    // A square root that the processor alone has.
    let of_the_host =
        "__host__ static float host_root(float x) { return x; }\n#define sqrtf host_root\n";
    let (head, body) = header.split_once("namespace specula {").unwrap();
    folder.write(
        "specula.hpp",
        &format!("{head}{of_the_host}namespace specula {{{body}"),
    );
    folder.refused(&clang, &all);
}

#[test]
fn cuda_compiles_to_ptx() {
    let flags = [
        "-x",
        "cuda",
        "--cuda-gpu-arch=sm_70",
        "-nocudainc",
        "-nocudalib",
        "-include",
        "cuda.h",
    ];
    compiles_for_the_device("CUDA for the device", &flags, ".func ");
}

#[test]
fn hip_compiles_to_machine_code() {
    let flags = [
        "-x",
        "hip",
        "--offload-arch=gfx906",
        "-nogpuinc",
        "-nogpulib",
        "-include",
        "hip.h",
    ];
    compiles_for_the_device("HIP for the device", &flags, "@function");
}
