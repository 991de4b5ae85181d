//! Serves the studio with pages from a folder, for those who write them:
//! `cargo run -p specula-studio-server --example serve -- --port 8000 --web crates/specula-studio-server/web/dist`

use std::io::Write as _;
use std::path::PathBuf;

use specula_studio_server::{Assets, Options, Server};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments
            .next()
            .ok_or_else(|| format!("{name} needs a value"))?;
        match name.as_str() {
            "--port" => options.port = value.parse()?,
            "--web" => options.assets = Assets::Folder(PathBuf::from(value)),
            "--folder" => options.folder = PathBuf::from(value),
            _ => {
                return Err(
                    format!("unknown option {name}; there are --port, --web and --folder").into(),
                );
            }
        }
    }
    let pool = rayon::ThreadPoolBuilder::new().build()?;
    let server = Server::bind(options, pool)?;
    writeln!(std::io::stdout(), "studio: {}", server.address())?;
    Ok(server.run()?)
}
