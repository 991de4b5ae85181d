//! Shaders of textures on a GPU.

use specula_gpu::{AdapterKind, ComputeKernel, Gpu, Tree};
use specula_render::PreparedScene;

/// A file of `wgsl/`, by its name.
pub(crate) type Module = (&'static str, &'static str);

const WORLD: Module = ("world", include_str!("../../wgsl/world.wgsl"));
const ANGLES: Module = ("angles", include_str!("../../wgsl/angles.wgsl"));
const PLACE: Module = (
    "texture_coordinates",
    include_str!("../../wgsl/texture_coordinates.wgsl"),
);
const MAPPING: Module = (
    "texture_mapping",
    include_str!("../../wgsl/texture_mapping.wgsl"),
);
const RASTER: Module = (
    "texture_raster",
    include_str!("../../wgsl/texture_raster.wgsl"),
);
const FILTER: Module = (
    "texture_filter",
    include_str!("../../wgsl/texture_filter.wgsl"),
);
const NOISE: Module = (
    "texture_noise",
    include_str!("../../wgsl/texture_noise.wgsl"),
);
const GRAPH: Module = (
    "texture_graph",
    include_str!("../../wgsl/texture_graph.wgsl"),
);

/// Modules of textures.
pub(crate) const TEXTURES: [Module; 8] =
    [WORLD, ANGLES, PLACE, MAPPING, RASTER, FILTER, NOISE, GRAPH];

/// Modules of bump maps, besides the library's `frame`.
pub(crate) const BUMPS: [Module; 13] = [
    WORLD,
    ANGLES,
    PLACE,
    MAPPING,
    RASTER,
    FILTER,
    NOISE,
    GRAPH,
    ("ray", include_str!("../../wgsl/ray.wgsl")),
    ("surface", include_str!("../../wgsl/surface.wgsl")),
    ("partials", include_str!("../../wgsl/partials.wgsl")),
    ("slopes", include_str!("../../wgsl/slopes.wgsl")),
    ("bump", include_str!("../../wgsl/bump.wgsl")),
];

/// A text of a module that is replaced by a wrong one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fault {
    pub(crate) module: &'static str,
    pub(crate) from: &'static str,
    pub(crate) to: &'static str,
}

/// What a test runs.
pub(crate) struct Shader<'a> {
    /// Reads binding 0, writes binding 4.
    pub(crate) kernel: &'a str,
    pub(crate) modules: &'a [Module],
    pub(crate) fault: Option<Fault>,
}

/// The GPU of the tests.
pub(crate) struct Device(&'static Gpu);

impl Device {
    /// By how much more than software's arithmetic this one may round: real GPUs fuse and approximate.
    pub(crate) fn rounding(&self) -> f32 {
        match self.0.adapter.kind {
            AdapterKind::Software => 1.0,
            _ => 4.0,
        }
    }

    /// The GPU, or `None` where there is none and the test is left out.
    pub(crate) fn open(test: &str) -> Option<Self> {
        crate::common::gpu(test).map(Self)
    }

    /// Runs a shader over a scene.
    ///
    /// * `inputs`: the values that it reads.
    /// * `count`: how many values it writes.
    pub(crate) fn run(
        &self,
        scene: &PreparedScene,
        shader: &Shader<'_>,
        inputs: &[f32],
        count: usize,
        workgroups: [u32; 3],
    ) -> Vec<f32> {
        let gpu = self.0;
        let mut flat = scene.flatten();
        let tree = Tree::new(&mut flat);
        let mut source = specula_shaders::compose(&["frame"]).unwrap();
        source += &flat.declarations();
        for (name, text) in shader.modules {
            let text = match shader.fault {
                Some(fault) if fault.module == *name => {
                    assert_eq!(text.matches(fault.from).count(), 1, "{fault:?}");
                    text.replace(fault.from, fault.to)
                }
                _ => (*text).to_owned(),
            };
            let code = text.lines().filter(|line| !line.starts_with("import "));
            source.extend(code.flat_map(|line| [line, "\n"]));
        }
        source += shader.kernel;
        let module = gpu.shader("textures", &source).unwrap();
        let kernel = ComputeKernel::new(gpu, &module, "main", 4).unwrap();
        let or_one = |bytes: &[u8]| {
            if bytes.is_empty() {
                vec![0; 16]
            } else {
                bytes.to_vec()
            }
        };
        let inputs = [
            or_one(bytes(inputs)),
            or_one(tree.nodes()),
            or_one(tree.triangles()),
            or_one(bytes(&flat.words)),
        ];
        let inputs: Vec<&[u8]> = inputs.iter().map(Vec::as_slice).collect();
        let arrays = kernel.upload(gpu, &inputs, 4 * count as u64).unwrap();
        kernel.run(gpu, &arrays, workgroups).unwrap();
        let output = arrays.output(gpu).unwrap();
        let float = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
        output.chunks_exact(4).map(float).collect()
    }
}

fn bytes<T: bytemuck::NoUninit>(values: &[T]) -> &[u8] {
    bytemuck::cast_slice(values)
}
