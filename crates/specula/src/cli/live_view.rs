//! A live view: the picture so far, sent to the viewer tev.

use std::net::{TcpStream, ToSocketAddrs};
use std::time::{Duration, Instant};

use specula::render::FilmBuffer;
use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

use super::Failure;

/// The port that tev listens on.
const PORT: u16 = 14158;
/// Between two updates.
const EVERY: Duration = Duration::from_secs(1);
/// Sending takes at most this share of the time.
const LARGEST_SHARE: f64 = 0.05;
/// A viewer that takes nothing for so long is lost.
const PATIENCE: Duration = Duration::from_secs(5);
/// Pixels of an update: packets stay small.
const MOST_PIXELS: usize = 1 << 20;
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// A viewer that shows the render.
pub(crate) struct LiveView {
    /// `None`: lost.
    client: Option<TevClient>,
    image: String,
    created: bool,
    sent: Option<Instant>,
    cost: Duration,
}

impl LiveView {
    /// Connects to a viewer at `host:port`; fails where there is none.
    pub(crate) fn connect(address: &str, image: &str) -> Result<Self, Failure> {
        let fail = |e: &dyn std::fmt::Display| {
            Failure::bad_input(format_args!(
                "--display-server {address}: no viewer answers: {e}\n\
                 tev listens on port {PORT} unless it is started with --host"
            ))
        };
        let mut last = None;
        for place in address.to_socket_addrs().map_err(|e| fail(&e))? {
            match TcpStream::connect_timeout(&place, PATIENCE) {
                Ok(stream) => {
                    stream
                        .set_write_timeout(Some(PATIENCE))
                        .map_err(|e| fail(&e))?;
                    return Ok(Self {
                        client: Some(TevClient::wrap(stream)),
                        // The protocol ends names with a zero byte.
                        image: image.replace('\0', " "),
                        created: false,
                        sent: None,
                        cost: Duration::ZERO,
                    });
                }
                Err(e) => last = Some(e),
            }
        }
        Err(last.map_or_else(|| fail(&"it has no address"), |e| fail(&e)))
    }

    /// Shows a film that is being rendered, now and then.
    pub(crate) fn update(&mut self, film: &FilmBuffer) {
        let rest = self.cost.mul_f64(1.0 / LARGEST_SHARE);
        if self
            .sent
            .is_none_or(|sent| sent.elapsed() >= EVERY.max(rest))
        {
            self.show(film);
        }
    }

    /// Shows a film. A render goes on without a viewer that is lost.
    pub(crate) fn show(&mut self, film: &FilmBuffer) {
        let Some(mut client) = self.client.take() else {
            return;
        };
        let start = Instant::now();
        match self.send(&mut client, film) {
            Ok(()) => self.client = Some(client),
            Err(e) => eprintln!("warning: the viewer is lost, and the render goes on: {e}"),
        }
        self.cost = start.elapsed();
        self.sent = Some(Instant::now());
    }

    fn send(&mut self, client: &mut TevClient, film: &FilmBuffer) -> std::io::Result<()> {
        let [width, height] = film.full_resolution();
        if !self.created {
            client.send(PacketCreateImage {
                image_name: &self.image,
                grab_focus: true,
                width,
                height,
                channel_names: &CHANNELS,
            })?;
            self.created = true;
        }
        let [x0, x1, y0, y1] = film.crop();
        let columns = x1 - x0;
        let colour = film.colour();
        let rows = u32::try_from(MOST_PIXELS / columns as usize).map_or(1, |rows| rows.max(1));
        let mut data = Vec::new();
        for (y, pixels) in (y0..y1)
            .step_by(rows as usize)
            .zip(colour.chunks((rows * columns) as usize))
        {
            data.clear();
            data.extend(pixels.iter().flat_map(|c| c.to_array()));
            client.send(PacketUpdateImage {
                image_name: &self.image,
                grab_focus: false,
                channel_names: &CHANNELS,
                channel_offsets: &[0, 1, 2],
                channel_strides: &[3; 3],
                x: x0,
                y,
                width: columns,
                height: rows.min(y1 - y),
                data: &data,
            })?;
        }
        Ok(())
    }
}

/// `host:port`; the port may be left out.
pub(crate) fn address(text: &str) -> Result<String, String> {
    const EXPECTED: &str = "expected a host and a port, as in localhost:14158 or [::1]:14158";
    // An address of IPv6 has colons of its own, and brackets around it where a port follows.
    let (host, port) = match text.rsplit_once(':') {
        Some((host, port)) if !port.ends_with(']') => (host, Some(port)),
        _ => (text, None),
    };
    let bare = host.strip_prefix('[').and_then(|h| h.strip_suffix(']'));
    let sound = match bare {
        Some(v6) => v6.parse::<std::net::Ipv6Addr>().is_ok(),
        None => !host.is_empty() && !host.contains([':', '[', ']', '/', ' ']),
    };
    let port = port.map_or(Some(PORT), |p| p.parse().ok().filter(|p| *p > 0));
    match (sound, port) {
        (true, Some(port)) => Ok(format!("{host}:{port}")),
        _ => Err(EXPECTED.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_have_a_host_and_maybe_a_port() {
        for (text, expected) in [
            ("localhost", "localhost:14158"),
            ("localhost:5", "localhost:5"),
            ("10.0.0.7:14159", "10.0.0.7:14159"),
            ("[::1]", "[::1]:14158"),
            ("[::1]:9", "[::1]:9"),
        ] {
            assert_eq!(address(text).as_deref(), Ok(expected));
        }
        for bad in [
            "",
            ":1",
            "host:",
            "host:x",
            "host:0",
            "host:70000",
            "::1",
            "[::1",
            "[x]:4",
            "http://host:1",
        ] {
            assert!(address(bad).is_err(), "{bad}");
        }
    }
}
