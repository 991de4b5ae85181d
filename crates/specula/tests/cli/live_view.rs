//! `specula render --display-server`: a viewer of our own reads what is sent.

use std::collections::BTreeMap;
use std::io::Read;
use std::net::{TcpListener, TcpStream};

use crate::common::{small_scene, specula, stderr};
use specula::render::picture::read_exr;

/// Kinds of packets, as tev's documentation numbers them.
const CREATE_IMAGE: u8 = 4;
const UPDATE_IMAGE: u8 = 6;

/// A packet yet to be read: little endian, texts end with a zero byte.
struct Packet(Vec<u8>);

impl Packet {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let rest = self.0.split_off(N);
        std::mem::replace(&mut self.0, rest)
            .try_into()
            .expect("a sound packet")
    }

    fn byte(&mut self) -> u8 {
        u8::from_le_bytes(self.take())
    }

    fn number(&mut self) -> usize {
        u32::from_le_bytes(self.take()) as usize
    }

    fn long(&mut self) -> usize {
        usize::try_from(u64::from_le_bytes(self.take())).expect("a sound packet")
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|&b| b == 0).expect("a sound packet");
        let rest = self.0.split_off(end + 1);
        let mut text = std::mem::replace(&mut self.0, rest);
        text.pop();
        String::from_utf8(text).expect("a sound packet")
    }

    /// The next packet of a connection; `None` at its end.
    fn read(stream: &mut TcpStream) -> Option<Self> {
        let mut length = [0; 4];
        stream.read_exact(&mut length).ok()?;
        // The length counts itself.
        let mut bytes = vec![0; u32::from_le_bytes(length) as usize - 4];
        stream.read_exact(&mut bytes).ok()?;
        Some(Self(bytes))
    }
}

/// What a viewer shows.
#[derive(Default)]
struct Shown {
    name: String,
    size: [usize; 2],
    channels: BTreeMap<String, Vec<f32>>,
    updates: usize,
}

impl Shown {
    fn receive(&mut self, mut packet: Packet) {
        match packet.byte() {
            CREATE_IMAGE => {
                assert!(self.channels.is_empty(), "created once");
                let _grab_focus = packet.byte();
                self.name = packet.text();
                self.size = [packet.number(), packet.number()];
                for _ in 0..packet.number() {
                    let black = vec![0.0; self.size[0] * self.size[1]];
                    self.channels.insert(packet.text(), black);
                }
            }
            UPDATE_IMAGE => {
                let _grab_focus = packet.byte();
                assert_eq!(packet.text(), self.name);
                let channels = packet.number();
                let names: Vec<_> = (0..channels).map(|_| packet.text()).collect();
                let [x, y, width, height] = std::array::from_fn(|_| packet.number());
                let offsets: Vec<_> = (0..channels).map(|_| packet.long()).collect();
                let strides: Vec<_> = (0..channels).map(|_| packet.long()).collect();
                let (data, rest) = packet.0.as_chunks::<4>();
                assert!(rest.is_empty());
                for ((name, offset), stride) in names.iter().zip(offsets).zip(strides) {
                    let channel = self.channels.get_mut(name).expect("a sound packet");
                    for i in 0..width * height {
                        let at = (y + i / width) * self.size[0] + x + i % width;
                        channel[at] = f32::from_le_bytes(data[offset + i * stride]);
                    }
                }
                self.updates += 1;
            }
            other => panic!("packet of kind {other}"),
        }
        assert!(packet.0.is_empty() || self.updates > 0);
    }
}

/// Renders with a viewer that hangs up after so many packets; what it showed, and the messages.
fn watched(arguments: &[&str], packets: usize) -> (Shown, String, tempfile::TempDir) {
    let (folder, scene) = small_scene();
    let server = TcpListener::bind("127.0.0.1:0").expect("a program that runs and answers");
    let address = server
        .local_addr()
        .expect("a program that runs and answers")
        .to_string();
    let viewer = std::thread::spawn(move || {
        let (mut stream, _) = server.accept().expect("a program that runs and answers");
        let mut shown = Shown::default();
        for _ in 0..packets {
            let Some(packet) = Packet::read(&mut stream) else {
                break;
            };
            shown.receive(packet);
        }
        shown
    });
    let run = specula(folder.path())
        .args(["render", "--display-server", &address, "-o", "a.exr"])
        .args(arguments)
        .arg(&scene)
        .output()
        .expect("a program that runs and answers");
    assert!(run.status.success(), "{}", stderr(&run));
    (
        viewer.join().expect("a program that runs and answers"),
        stderr(&run),
        folder,
    )
}

#[test]
fn the_viewer_shows_the_picture_that_is_written() {
    for crop in [&[][..], &["--crop", "5,17,3,11"]] {
        let (shown, messages, folder) = watched(crop, usize::MAX);
        assert!(!messages.contains("warning"), "{messages}");
        assert_eq!((shown.name.as_str(), shown.size), ("small", [24, 16]));
        assert!(shown.updates >= 1);
        let picture = read_exr(&folder.path().join("a.exr")).unwrap();
        let [x0, y0] = picture.offset;
        for (channel, name) in ["R", "G", "B"].iter().enumerate() {
            let mut outside = shown.channels[*name].clone();
            for (i, c) in (0_u32..).zip(&picture.colour) {
                let (x, y) = (x0 + i % picture.width, y0 + i / picture.width);
                let value = &mut outside[(y * 24 + x) as usize];
                assert_eq!(*value, c.to_array()[channel], "{name} at ({x}, {y})");
                *value = 0.0;
            }
            assert!(outside.iter().all(|&v| v == 0.0), "{name} beside the crop");
        }
    }
}

#[test]
fn a_render_survives_its_viewer() {
    // Long enough for many updates; one packet is taken, then the viewer is gone.
    let (shown, messages, folder) = watched(&["--time", "4s", "--threads", "1"], 1);
    assert_eq!(shown.size, [24, 16]);
    assert_eq!(
        messages.matches("the viewer is lost").count(),
        1,
        "{messages}"
    );
    assert!(read_exr(&folder.path().join("a.exr")).is_ok());
}

#[test]
fn without_a_viewer_nothing_begins() {
    let (folder, scene) = small_scene();
    // A port that was free a moment ago.
    let free = TcpListener::bind("127.0.0.1:0")
        .unwrap()
        .local_addr()
        .unwrap();
    for (address, expected) in [
        (free.to_string(), "no viewer answers"),
        ("no port: here".to_owned(), "expected a host and a port"),
    ] {
        let run = specula(folder.path())
            .args(["render", "-o", "a.exr", "--display-server", &address])
            .arg(&scene)
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
        assert!(stderr(&run).contains(expected), "{}", stderr(&run));
        assert!(!folder.path().join("a.exr").exists());
    }
}

/// A viewer that takes the connection and never reads: packets of a large picture pile up.
#[test]
fn a_viewer_that_does_not_read_does_not_hold_up_the_render() {
    let (folder, scene) = small_scene();
    let server = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = server.local_addr().unwrap().to_string();
    let start = std::time::Instant::now();
    let run = specula(folder.path())
        .args(["render", "--display-server", &address, "-o", "a.exr"])
        .args(["--time", "3s", "--resolution", "1024x768"])
        .arg(&scene)
        .output()
        .unwrap();
    let said = stderr(&run);
    assert!(run.status.success(), "{said}");
    // 3 s, the last picture's 2 s, and the files.
    let taken = start.elapsed().as_secs_f64();
    assert!(taken < 12.0, "{taken}: {said}");
    assert!(said.contains("the viewer"), "{said}");
    let picture = read_exr(&folder.path().join("a.exr")).unwrap();
    assert!(picture.sample_count[0] > 1.0, "{said}");
}
