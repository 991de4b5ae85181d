//! A scene as a shader takes it: the text of the path tracer for it, and the arrays that it reads.

use specula_render::{FlatScene, PreparedScene, RenderOptions};
use specula_shaders::ComposeError;

use crate::program;
use crate::tree::Tree;

/// The shader of a scene, for whichever device runs it: [`Tracer`](crate::Tracer) by wgpu, a page by WebGPU.
///
/// [`ENTRY`](Self::ENTRY) is a compute shader; a thread takes one sample. Group 0 binds storage buffers, of which the
/// first five are only read:
///
/// | binding | holds |
/// |---|---|
/// | 0 to 3 | [`arrays`](Self::arrays): tables, nodes, triangles, words |
/// | 4 | requests, vectors of four words: slots of a run, number of runs, 0, 0; [`settings`](Self::settings); of each run column, row, first sample, number of samples |
/// | 5 | results, [`SAMPLE_SIZE`](Self::SAMPLE_SIZE) bytes a slot: `path_results` in `wgsl/path.wgsl` says what |
///
/// Thread `i` takes sample `i % slots` of run `i / slots`, if that run has so many. The text needs no extension, and no
/// more than WebGPU's default limits where the arrays are within them.
#[derive(Clone, Debug)]
pub struct SceneProgram<'a> {
    pub(crate) flat: FlatScene<'a>,
    tree: Tree,
    settings: [u32; 4],
}

/// What shaders do not support of a scene or its options.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the GPU does not render {}", .0.join(", "))]
pub struct MissingFeatures(pub Vec<String>);

/// Features of a scene that shaders do not support, in words for a message; none: a device can render it.
#[must_use]
pub fn missing(scene: &PreparedScene) -> Vec<String> {
    scene.flatten().missing
}

impl<'a> SceneProgram<'a> {
    /// The entry point that takes samples.
    pub const ENTRY: &'static str = "path_main";
    /// Threads of a workgroup.
    pub const WORKGROUP: u32 = 64;
    /// Bytes of a sample among the results.
    pub const SAMPLE_SIZE: u64 = 48;

    /// Lays out a scene's arrays.
    ///
    /// # Errors
    /// Where shaders do not support the scene, or that paths share.
    pub fn new(scene: &'a PreparedScene, options: &RenderOptions) -> Result<Self, MissingFeatures> {
        let mut flat = scene.flatten();
        let mut missing = std::mem::take(&mut flat.missing);
        if options.share_paths > 1 {
            missing.push("paths that share".to_owned());
        }
        if !missing.is_empty() {
            return Err(MissingFeatures(missing));
        }
        let tree = Tree::new(&mut flat);
        Ok(Self {
            flat,
            tree,
            settings: program::settings(options),
        })
    }

    /// The text, in WGSL.
    ///
    /// # Errors
    /// Where the library's modules do not fit together.
    pub fn text(&self) -> Result<String, ComposeError> {
        program::source(&self.flat, false)
    }

    /// The text with rays cast by the adapter's ray queries, an extension of wgpu.
    #[cfg(feature = "device")]
    pub(crate) fn text_with_queries(&self) -> Result<String, ComposeError> {
        program::source(&self.flat, true)
    }

    /// Tables, nodes, triangles, words: what is bound as 0 to 3. Some may be empty, which bindings must not be.
    #[must_use]
    pub fn arrays(&self) -> [&[u8]; 4] {
        [
            bytemuck::cast_slice(specula_shaders::tables()),
            self.tree.nodes(),
            self.tree.triangles(),
            bytemuck::cast_slice(&self.flat.words),
        ]
    }

    /// Bytes of the largest array.
    #[must_use]
    pub fn largest_array(&self) -> u64 {
        let sizes = self.arrays().map(|array| array.len() as u64);
        sizes.into_iter().max().unwrap_or(0)
    }

    /// What the render asks of the shader, the second vector of the requests: seed, longest path, strategy, and the
    /// bound of indirect light.
    #[must_use]
    pub fn settings(&self) -> [u32; 4] {
        self.settings
    }
}
