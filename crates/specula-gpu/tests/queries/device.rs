//! Casts rays on a GPU, by traversal or by queries.

use specula_gpu::{ComputeKernel, Gpu, Structures, Tree};
use specula_render::PreparedScene;

use crate::rays::Ray;

/// A text of `query.wgsl` that is replaced by a wrong one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fault {
    pub(crate) from: &'static str,
    pub(crate) to: &'static str,
}

/// How rays are cast.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RayCasting {
    Tree,
    Query(Option<Fault>),
}

/// What a ray hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) t: f32,
    pub(crate) u: f32,
    pub(crate) v: f32,
    pub(crate) primitive: u32,
    pub(crate) instance: u32,
}

impl Hit {
    pub(crate) fn is_there(&self) -> bool {
        self.instance != u32::MAX
    }
}

const SHARED: [&str; 6] = [
    include_str!("../../wgsl/world.wgsl"),
    include_str!("../../wgsl/ray.wgsl"),
    include_str!("../../wgsl/quadric.wgsl"),
    include_str!("../../wgsl/angles.wgsl"),
    include_str!("../../wgsl/texture_coordinates.wgsl"),
    include_str!("../../wgsl/surface.wgsl"),
];
const TREE: &str = include_str!("../../wgsl/traverse.wgsl");
const QUERY: &str = include_str!("../../wgsl/query.wgsl");

const ENTRY: &str = include_str!("../../wgsl/cast.wgsl");

/// What the rays hit; their number is a multiple of 64.
pub(crate) fn hits(
    gpu: &Gpu,
    scene: &PreparedScene,
    rays: &[Ray],
    casting: RayCasting,
) -> Vec<Hit> {
    let mut flat = scene.flatten();
    let tree = Tree::new(&mut flat);
    let structures =
        matches!(casting, RayCasting::Query(_)).then(|| Structures::new(gpu, scene).unwrap());
    let module = gpu
        .shader("rays", &source(&flat.declarations(), casting))
        .unwrap();
    let kernel = match &structures {
        None => ComputeKernel::new(gpu, &module, "cast_main", 4),
        Some(structures) => {
            ComputeKernel::with_structures(gpu, &module, "cast_main", 4, structures)
        }
    };
    let kernel = kernel.unwrap();
    let words: Vec<[f32; 8]> = rays.iter().map(Ray::words).collect();
    let or_some = |bytes: &[u8]| match bytes {
        [] => vec![0; 16],
        bytes => bytes.to_vec(),
    };
    let inputs = [
        bytemuck::cast_slice(&words).to_vec(),
        or_some(tree.nodes()),
        or_some(tree.triangles()),
        bytemuck::cast_slice(&flat.words).to_vec(),
    ];
    let inputs: Vec<&[u8]> = inputs.iter().map(Vec::as_slice).collect();
    let size = rays.len() * size_of::<[u32; 5]>();
    let arrays = kernel.upload(gpu, &inputs, size as u64).unwrap();
    let groups = u32::try_from(rays.len() / 64).unwrap();
    kernel.run(gpu, &arrays, [groups, 1, 1]).unwrap();
    let output: Vec<[u32; 5]> = bytemuck::pod_collect_to_vec(&arrays.output(gpu).unwrap());
    let hit = |[t, u, v, primitive, instance]: [u32; 5]| Hit {
        t: f32::from_bits(t),
        u: f32::from_bits(u),
        v: f32::from_bits(v),
        primitive,
        instance,
    };
    output.into_iter().map(hit).collect()
}

fn source(declarations: &str, casting: RayCasting) -> String {
    let (mut text, module) = match casting {
        RayCasting::Tree => (String::new(), TREE.to_owned()),
        RayCasting::Query(fault) => {
            let module = match fault {
                None => QUERY.to_owned(),
                Some(Fault { from, to }) => {
                    assert_eq!(QUERY.matches(from).count(), 1, "{from}");
                    QUERY.replace(from, to)
                }
            };
            ("enable wgpu_ray_query;\n".to_owned(), module)
        }
    };
    text += "const STACK_SIZE: u32 = 256u;\n";
    text += declarations;
    for module in SHARED.into_iter().chain([module.as_str(), ENTRY]) {
        let code = module.lines().filter(|line| !line.starts_with("import "));
        text.extend(code.flat_map(|line| [line, "\n"]));
    }
    text
}
