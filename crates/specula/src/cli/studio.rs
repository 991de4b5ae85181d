//! `specula studio`.

use std::net::{IpAddr, Ipv4Addr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use specula_studio_server::{Assets, GivenScene, Options, Server, ServerError, export};

use crate::render::RenderOptions;
use crate::scene::Scene;

use super::console::say;
use super::load::Named;
use super::loading::LoadingArguments;
use super::machine::MachineArguments;
use super::stop::StopFlag;
use super::{ExitCode, Failure, load, machine, memory, print};

/// How often it is looked whether the program is to end.
const POLL: Duration = Duration::from_millis(50);

const EXAMPLES: &str = "\
Examples:
  specula studio
      samplers, lobes, proofs and the built-in scenes, in the browser that opens
  specula studio room.pbrt
      with a scene of yours; pages open others from its folder, or take what is dropped on them
  specula studio --no-open --port 8080
      prints the address, and opens nothing
  specula studio --export site --wasm specula-studio.wasm
      the same pages as files, for a web server or from disk; `cargo xtask studio-wasm` makes the module

Only this machine reaches the studio, and only with the token of the address that is printed. Ctrl-C ends it.";

#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct StudioArguments {
    /// A scene for the page of renders: pbrt-v4, Mitsuba 3, glTF 2.0, OBJ or PLY
    pub(crate) scene: Option<PathBuf>,

    /// Port to listen on [default: any free one]
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    pub(crate) port: u16,

    /// Address to listen on; any other than the machine's own lets others in who know the token
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub(crate) listen: IpAddr,

    /// Print the address and open no browser
    #[arg(long)]
    pub(crate) no_open: bool,

    /// Write the pages as files to this folder, and serve nothing
    #[arg(long, value_name = "DIR", conflicts_with_all = ["scene", "port", "listen", "no_open"])]
    pub(crate) export: Option<PathBuf>,

    /// The library in WebAssembly, for exported pages
    #[arg(long, value_name = "FILE", requires = "export")]
    pub(crate) wasm: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,

    #[command(flatten)]
    pub(crate) machine: MachineArguments,
}

/// Serves the studio until Ctrl-C, or writes its pages.
pub(crate) fn run(arguments: &StudioArguments) -> Result<ExitCode, Failure> {
    if let Some(folder) = &arguments.export {
        let wasm = arguments.wasm.as_deref();
        let names = export(folder, &Assets::default(), wasm).map_err(failure)?;
        say!("wrote {}: {}", folder.display(), names.join(", "));
        return Ok(ExitCode::SUCCESS);
    }
    let load = arguments.loading.options(&[]);
    let threads = arguments.machine.thread_count();
    // Before a scene is read, which would make the pool.
    machine::global_pool(threads, arguments.machine.nice)?;
    let most = arguments.machine.max_memory;
    let fits = move |scene: &Scene, quiet: bool| {
        memory::check(
            scene,
            &RenderOptions::from_scene(scene),
            threads,
            most,
            quiet,
        )
    };
    // Before the server is there: a signal may end the program while a scene is read.
    let given = match &arguments.scene {
        None => None,
        Some(path) => {
            let named = load::scene(Some(path), &load)?;
            load::print_warnings(&named.warnings);
            fits(&named.scene, false)?;
            Some(named)
        }
    };
    let options = Options {
        address: arguments.listen,
        port: arguments.port,
        folder: folder(arguments.scene.as_deref()),
        load,
        admit: Box::new(move |scene| fits(scene, true).map_err(|failure| failure.message())),
        ..Options::default()
    };
    let server = Server::bind(options).map_err(failure)?;
    if let Some(Named {
        name,
        scene,
        warnings,
        ..
    }) = given
    {
        let warnings = load::warning_lines(&warnings);
        server.add_scene(&name, GivenScene { scene, warnings });
    }
    serve(server, arguments)
}

/// Serves until the program is asked to stop.
fn serve(server: Server, arguments: &StudioArguments) -> Result<ExitCode, Failure> {
    let stop = StopFlag::listen("the studio ends")?;
    let stopper = server.stopper();
    let asked = Arc::clone(&stop.asked);
    std::thread::spawn(move || {
        while !asked.load(Ordering::Relaxed) {
            std::thread::sleep(POLL);
        }
        stopper.stop();
    });
    if !arguments.listen.is_loopback() {
        say!(
            "warning: all who reach {} and know the token may use this studio, and what they send is not encrypted",
            arguments.listen
        );
    }
    let address = server.address();
    print(&format!("studio: {address}\n"))?;
    if !arguments.no_open && opener::open_browser(&address).is_err() {
        say!("no browser could be opened: open the address above");
    }
    server.run().map_err(failure)?;
    Ok(ExitCode::from(stop.signal().exit_code()))
}

/// Where pages open scenes from: beside the scene, or here.
fn folder(scene: Option<&Path>) -> PathBuf {
    let parent = scene.and_then(Path::parent);
    match parent {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn failure(error: ServerError) -> Failure {
    match error.is_bad_input() {
        true => Failure::bad_input(error),
        false => Failure::other(error),
    }
}
