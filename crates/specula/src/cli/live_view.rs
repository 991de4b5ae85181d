//! A live view: the picture so far, sent to the viewer tev by a thread of its own, so that a viewer that
//! does not read never holds up the render.

use std::net::{TcpStream, ToSocketAddrs};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::bsdf::Rgb;
use crate::render::FilmBuffer;
use tev_client::{PacketCreateImage, PacketUpdateImage, TevClient};

use super::Failure;
use super::console::say;

/// The port that tev listens on.
const PORT: u16 = 14158;
/// Between two updates.
const EVERY: Duration = Duration::from_secs(1);
/// Copying the picture takes at most this share of the time.
const LARGEST_SHARE: f64 = 0.05;
/// A viewer that takes nothing for so long is lost.
const PATIENCE: Duration = Duration::from_secs(5);
/// How long the finished picture may take to be sent.
const LAST_PATIENCE: Duration = Duration::from_secs(2);
/// Pixels of an update: packets stay small.
const MOST_PIXELS: usize = 1 << 20;
const CHANNELS: [&str; 3] = ["R", "G", "B"];

/// A viewer that shows the render.
pub(crate) struct LiveView {
    queue: Arc<Queue>,
    sent: Option<Instant>,
    /// Of copying a picture.
    cost: Duration,
}

/// At most one picture on its way to the thread that sends.
#[derive(Default)]
struct Queue {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    next: Option<Frame>,
    /// Whether `next` is the last.
    closed: bool,
    /// Whether the thread has ended: all is sent, or the viewer is lost.
    ended: bool,
}

/// A picture to be shown.
struct Frame {
    full_resolution: [u32; 2],
    crop: [u32; 4],
    colour: Vec<Rgb<f32>>,
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
                    return Ok(Self::start(stream, image));
                }
                Err(e) => last = Some(e),
            }
        }
        Err(last.map_or_else(|| fail(&"it has no address"), |e| fail(&e)))
    }

    /// Starts the thread that sends.
    fn start(stream: TcpStream, image: &str) -> Self {
        let queue = Arc::new(Queue::default());
        let mut sender = Sender {
            client: TevClient::wrap(stream),
            // The protocol ends names with a zero byte.
            image: image.replace('\0', " "),
            created: None,
        };
        let shared = queue.clone();
        std::thread::spawn(move || {
            while let Some(frame) = shared.take() {
                if let Err(e) = sender.send(&frame) {
                    say!("warning: the viewer is lost, and the render goes on: {e}");
                    break;
                }
            }
            shared.lock().ended = true;
            shared.changed.notify_all();
        });
        Self {
            queue,
            sent: None,
            cost: Duration::ZERO,
        }
    }

    /// Shows a film that is being rendered, now and then, unless the viewer has not taken the last
    /// picture yet.
    pub(crate) fn update(&mut self, film: &FilmBuffer) {
        let rest = self.cost.mul_f64(1.0 / LARGEST_SHARE);
        let is_due = (self.sent).is_none_or(|sent| sent.elapsed() >= EVERY.max(rest));
        let is_free = {
            let state = self.queue.lock();
            state.next.is_none() && !state.ended
        };
        if is_due && is_free {
            self.show(film);
        }
    }

    /// Shows a film in place of one that waits to be sent.
    pub(crate) fn show(&mut self, film: &FilmBuffer) {
        let start = Instant::now();
        let frame = Frame::of(film);
        self.cost = start.elapsed();
        self.sent = Some(start);
        self.queue.lock().next = Some(frame);
        self.queue.changed.notify_all();
    }

    /// Shows the finished film, and waits a little until it is sent.
    pub(crate) fn finish(&mut self, film: &FilmBuffer) {
        if self.queue.lock().ended {
            return;
        }
        self.show(film);
        let mut state = self.queue.lock();
        state.closed = true;
        self.queue.changed.notify_all();
        let waited = (self.queue.changed)
            .wait_timeout_while(state, LAST_PATIENCE, |s| !s.ended)
            .unwrap_or_else(PoisonError::into_inner);
        if waited.1.timed_out() {
            say!("warning: the viewer does not read, and may not show the finished picture");
        }
    }
}

impl Drop for LiveView {
    fn drop(&mut self) {
        self.queue.lock().closed = true;
        self.queue.changed.notify_all();
    }
}

impl Queue {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next picture, when there is one; `None`: there will be none.
    fn take(&self) -> Option<Frame> {
        let waiting = |s: &mut State| s.next.is_none() && !s.closed;
        let state = self.changed.wait_while(self.lock(), waiting);
        state.unwrap_or_else(PoisonError::into_inner).next.take()
    }
}

impl Frame {
    fn of(film: &FilmBuffer) -> Self {
        Self {
            full_resolution: film.full_resolution(),
            crop: film.crop(),
            colour: film.colour(),
        }
    }
}

/// The connection to a viewer.
struct Sender {
    client: TevClient,
    image: String,
    /// The size of the viewer's image.
    created: Option<[u32; 2]>,
}

impl Sender {
    fn send(&mut self, frame: &Frame) -> std::io::Result<()> {
        let [width, height] = frame.full_resolution;
        if self.created != Some(frame.full_resolution) {
            self.client.send(PacketCreateImage {
                image_name: &self.image,
                grab_focus: true,
                width,
                height,
                channel_names: &CHANNELS,
            })?;
            self.created = Some(frame.full_resolution);
        }
        let [x0, x1, y0, y1] = frame.crop;
        let columns = x1 - x0;
        let rows = u32::try_from(MOST_PIXELS / columns as usize).map_or(1, |rows| rows.max(1));
        let mut data = Vec::new();
        for (y, pixels) in (y0..y1)
            .step_by(rows as usize)
            .zip(frame.colour.chunks((rows * columns) as usize))
        {
            data.clear();
            data.extend(pixels.iter().flat_map(|c| c.to_array()));
            self.client.send(PacketUpdateImage {
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
