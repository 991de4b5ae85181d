//! Renders the built-in scene from a program of one's own.

use std::error::Error;
use std::sync::atomic::AtomicBool;

use specula::render::picture::{self, Metadata};
use specula::render::{PreparedScene, RenderOptions, Renderer};

fn main() -> Result<(), Box<dyn Error>> {
    let scene = specula::scene::builtin::orbs();
    let options = RenderOptions::from_scene(&scene);
    let prepared = PreparedScene::new(&scene, &options)?;
    let mut renderer = Renderer::new(&prepared, options);
    renderer.render_pass(16, &AtomicBool::new(false));
    let picture = renderer.film().picture();
    picture::write_exr("orbs.exr".as_ref(), &picture, &Metadata::default())?;
    Ok(())
}
