//! Meshes in Wavefront's OBJ files, plain or gzipped.
//!
//! All of a file's faces become one mesh, or one for each material: groups and smoothing are skipped. Polygons
//! fan out from their first vertex. Indices count from 1, or back from the last where negative.
//! Vertices may carry a colour (`v x y z r g b`). Texture coordinates are not changed: v runs upwards.
//!
//! In a check a line with a mistake does not end the reading. One that defines a vertex, a coordinate
//! or a normal defines zeros then, so that the indices of later faces stay what they are.

mod library;
mod looks;

use std::collections::HashMap;
use std::path::Path;

use crate::Limits;
use crate::faults::{Fault, Faults};
use crate::num::{parsed_f32, shortened};
use crate::read_file::Files;
use crate::scene::Mesh;
use crate::search::Search;
use crate::single::{Look, Staged};

/// A file's mesh, and where its faces change their material.
struct ObjFile {
    mesh: Mesh,
    /// From this triangle on, the material of this name.
    uses: Vec<(usize, String)>,
    /// Names of libraries.
    libraries: Vec<String>,
}

/// Reads a mesh with its materials.
///
/// * `search`: where libraries and pictures are looked for.
///
/// # Errors
///
/// As of [`read`]; libraries and pictures that cannot be read are left out, which a message says.
pub(crate) fn read_looks(
    path: &Path,
    files: &Files,
    collects: bool,
    search: &Search,
) -> Result<Staged, Vec<Fault>> {
    let bytes = files.unpacked(path).map_err(|m| vec![m.into()])?;
    let ObjFile {
        mesh,
        uses,
        libraries,
    } = parse(&bytes, files.limits(), collects)?;
    if uses.is_empty() || libraries.is_empty() {
        return Ok(Staged::of(mesh));
    }
    let mut looks = looks::Looks::new(files, search);
    let mut known = HashMap::new();
    for name in libraries {
        let path = search.find(&name);
        let name = shortened(name.as_bytes());
        match files.unpacked(&path) {
            Ok(bytes) => {
                let (materials, faults) = library::parse(&bytes);
                let told = faults.into_iter();
                let told = told.map(|(line, message)| format!("{name}, line {line}: {message}"));
                looks.messages.extend(told);
                known.extend(materials.into_iter().map(|m| (m.name.clone(), m)));
            }
            Err(message) => looks.messages.push(format!(
                "the library of materials {name} {message}: grey paint stands in for them"
            )),
        }
    }
    let mut numbers: HashMap<String, usize> = HashMap::new();
    let mut made: Vec<Look> = Vec::new();
    let mut parts: Vec<Vec<[u32; 3]>> = Vec::new();
    let ends = uses.iter().skip(1).map(|(from, _)| *from);
    let ends = ends.chain([mesh.triangles.len()]);
    let unnamed = (0, String::new());
    let first = uses.first().map_or(0, |(from, _)| *from);
    let runs = std::iter::once((&unnamed, first)).chain(uses.iter().zip(ends));
    for ((from, name), to) in runs.filter(|((from, _), to)| from < to) {
        let number = *numbers.entry(name.clone()).or_insert_with(|| {
            made.push(known.get(name).map_or_else(Look::grey, |m| looks.look(m)));
            parts.push(Vec::new());
            made.len() - 1
        });
        parts[number].extend(&mesh.triangles[*from..to]);
    }
    if made.is_empty() {
        return Ok(Staged::of(mesh));
    }
    let parts = parts.into_iter().enumerate();
    let mut places = Places::new(mesh.positions.len());
    Ok(Staged {
        meshes: parts
            .map(|(k, part)| (places.part(&mesh, part), k))
            .collect(),
        looks: made,
        textures: looks.textures,
        images: looks.images,
        paint: "the materials of its libraries",
        messages: looks.messages,
    })
}

/// By vertex of a mesh, its number within a part.
struct Places {
    /// The part that it was numbered for, and the number.
    numbers: Vec<(u32, u32)>,
    part: u32,
}

impl Places {
    fn new(count: usize) -> Self {
        Self {
            numbers: vec![(0, 0); count],
            part: 0,
        }
    }

    /// A mesh of some triangles of another.
    fn part(&mut self, of: &Mesh, mut triangles: Vec<[u32; 3]>) -> Mesh {
        self.part += 1;
        let mut kept: Vec<usize> = Vec::new();
        for i in triangles.iter_mut().flatten() {
            let (part, number) = &mut self.numbers[*i as usize];
            if *part != self.part {
                (*part, *number) = (self.part, u32::try_from(kept.len()).unwrap_or(NONE));
                kept.push(*i as usize);
            }
            *i = *number;
        }
        fn pick<T: Copy>(kept: &[usize], all: &[T]) -> Vec<T> {
            kept.iter().filter_map(|&i| all.get(i).copied()).collect()
        }
        Mesh {
            positions: pick(&kept, &of.positions),
            normals: pick(&kept, &of.normals),
            uvs: pick(&kept, &of.uvs),
            colours: pick(&kept, &of.colours),
            triangles,
            ..Mesh::default()
        }
    }
}

/// Reads a mesh.
///
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// What is wrong with the file.
pub(crate) fn read(path: &Path, files: &Files, collects: bool) -> Result<Mesh, Vec<Fault>> {
    let bytes = files.unpacked(path).map_err(|m| vec![m.into()])?;
    Ok(parse(&bytes, files.limits(), collects)?.mesh)
}

/// Reads a mesh from the bytes of an OBJ file.
///
/// # Errors
///
/// What was expected, with its line.
fn parse(bytes: &[u8], limits: &Limits, collects: bool) -> Result<ObjFile, Vec<Fault>> {
    let mut faults = Faults::new(collects);
    let read = parse_into(bytes, limits, &mut faults);
    faults.end(read)
}

fn parse_into(bytes: &[u8], limits: &Limits, faults: &mut Faults) -> Result<ObjFile, Fault> {
    let mut reader = Reader::new(limits);
    let mut joined = Vec::new();
    for (number, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        // A backslash at the end of a line carries on with the next.
        if let Some(part) = line.strip_suffix(b"\\") {
            joined.extend_from_slice(part);
            joined.push(b' ');
            continue;
        }
        let whole = if joined.is_empty() {
            line
        } else {
            joined.extend_from_slice(line);
            &joined
        };
        match reader.line(whole) {
            Ok(()) => {}
            Err(LineError::Line(message)) => {
                faults.record(Fault::at_line(number + 1, message))?;
                reader.stand_in(whole);
            }
            Err(LineError::Limit(message)) => return Err(Fault::at_line(number + 1, message)),
        }
        joined.clear();
    }
    let uses = std::mem::take(&mut reader.uses);
    let libraries = std::mem::take(&mut reader.libraries);
    let mesh = match reader.finish() {
        // A file with mistakes need not yield a mesh.
        Err(_) if !faults.is_empty() => Mesh::default(),
        mesh => mesh?,
    };
    Ok(ObjFile {
        mesh,
        uses,
        libraries,
    })
}

/// What is wrong with a line.
enum LineError {
    Line(String),
    /// Reading cannot go on.
    Limit(String),
}

impl<T: Into<String>> From<T> for LineError {
    fn from(message: T) -> Self {
        Self::Line(message.into())
    }
}

/// No index.
const NONE: u32 = u32::MAX;

struct Reader<'a> {
    limits: &'a Limits,
    positions: Vec<[f32; 3]>,
    colours: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    mesh: Mesh,
    /// The first vertex made of a position, and for each vertex the next one of that position.
    first: Vec<u32>,
    next: Vec<u32>,
    /// Indices of position, coordinates and normal of each vertex.
    keys: Vec<[u32; 3]>,
    has_uvs: bool,
    has_normals: bool,
    /// As of [`ObjFile`].
    uses: Vec<(usize, String)>,
    libraries: Vec<String>,
}

impl<'a> Reader<'a> {
    fn new(limits: &'a Limits) -> Self {
        Self {
            limits,
            positions: Vec::new(),
            colours: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            mesh: Mesh::default(),
            first: Vec::new(),
            next: Vec::new(),
            keys: Vec::new(),
            has_uvs: false,
            has_normals: false,
            uses: Vec::new(),
            libraries: Vec::new(),
        }
    }

    fn line(&mut self, line: &[u8]) -> Result<(), LineError> {
        let line = line.trim_ascii_start();
        let Some(end) = line.iter().position(u8::is_ascii_whitespace) else {
            return Ok(());
        };
        let rest = &line[end..];
        match &line[..end] {
            b"v" => self.vertex(rest),
            b"vt" => {
                let mut uv = [0.0; 2];
                let found = numbers(rest, &mut uv)?;
                if found == 0 {
                    return Err("expected at least one coordinate after `vt`".into());
                }
                self.uvs.push(uv);
                Ok(())
            }
            b"vn" => {
                let mut normal = [0.0; 3];
                if numbers(rest, &mut normal)? < 3 {
                    return Err("expected three numbers after `vn`".into());
                }
                self.normals.push(normal);
                Ok(())
            }
            b"f" => self.face(rest),
            b"usemtl" => {
                self.uses.push((self.mesh.triangles.len(), name(rest)));
                Ok(())
            }
            b"mtllib" => {
                let name = name(rest);
                if !self.libraries.contains(&name) {
                    self.libraries.push(name);
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Defines a stand-in for what a line with a mistake defines.
    fn stand_in(&mut self, line: &[u8]) {
        match line.split(u8::is_ascii_whitespace).find(|w| !w.is_empty()) {
            Some(b"v") => {
                self.positions.push([0.0; 3]);
                self.first.push(NONE);
            }
            Some(b"vt") => self.uvs.push([0.0; 2]),
            Some(b"vn") => self.normals.push([0.0; 3]),
            _ => {}
        }
    }

    fn vertex(&mut self, rest: &[u8]) -> Result<(), LineError> {
        let mut values = [0.0; 7];
        let found = numbers(rest, &mut values)?;
        let [x, y, z, ..] = values;
        if found < 3 {
            return Err("expected three numbers after `v`".into());
        }
        self.positions.push([x, y, z]);
        self.first.push(NONE);
        // After a weight there is no colour in any dialect but with seven numbers.
        let colour = match found {
            6 => Some([values[3], values[4], values[5]]),
            7 => Some([values[4], values[5], values[6]]),
            _ => None,
        };
        if let Some(colour) = colour {
            self.colours.resize(self.positions.len() - 1, [1.0; 3]);
            self.colours.push(colour.map(|c| c.max(0.0)));
        }
        if self.positions.len() as u64 > self.limits.max_vertices {
            let most = self.limits.max_vertices;
            let message = format!("more than {most} vertices (`max_vertices`)");
            return Err(LineError::Limit(message));
        }
        Ok(())
    }

    fn face(&mut self, rest: &[u8]) -> Result<(), LineError> {
        let words = rest
            .split(u8::is_ascii_whitespace)
            .filter(|w| !w.is_empty());
        let (mut first, mut previous, mut count) = (0, 0, 0);
        for word in words.take_while(|w| w[0] != b'#') {
            let vertex = self.corner(word)?;
            if count == 0 {
                first = vertex;
            } else if count > 1 {
                self.mesh.triangles.push([first, previous, vertex]);
            }
            previous = vertex;
            count += 1;
        }
        if count < 3 {
            return Err(format!("a face has {count} vertices; expected at least 3").into());
        }
        let most = self.limits.max_vertices;
        if self.mesh.triangles.len() as u64 > most || self.keys.len() as u64 > most {
            return Err(LineError::Limit(format!(
                "more than {most} triangles or vertices (`max_vertices`)"
            )));
        }
        Ok(())
    }

    /// The vertex of `position`, `position/uv`, `position//normal` or `position/uv/normal`.
    fn corner(&mut self, word: &[u8]) -> Result<u32, String> {
        let mut parts = word.split(|b| *b == b'/');
        let mut part = |count: usize, what: &str| match parts.next() {
            None | Some([]) => Ok(NONE),
            Some(digits) => index(digits, count, what),
        };
        let position = part(self.positions.len(), "vertex")?;
        let uv = part(self.uvs.len(), "texture coordinate")?;
        let normal = part(self.normals.len(), "normal")?;
        if position == NONE || parts.next().is_some() {
            return Err(format!(
                "expected a corner such as 1/2/3, found `{}`",
                shortened(word)
            ));
        }
        let key = [position, uv, normal];
        let mut vertex = self.first[position as usize];
        while vertex != NONE {
            if self.keys[vertex as usize] == key {
                return Ok(vertex);
            }
            vertex = self.next[vertex as usize];
        }
        let new = u32::try_from(self.keys.len())
            .ok()
            .filter(|n| *n < NONE)
            .ok_or("too many vertices")?;
        self.next.push(self.first[position as usize]);
        self.first[position as usize] = new;
        self.keys.push(key);
        self.has_uvs |= uv != NONE;
        self.has_normals |= normal != NONE;
        Ok(new)
    }

    fn finish(mut self) -> Result<Mesh, String> {
        if self.mesh.triangles.is_empty() && self.positions.is_empty() {
            return Err("it has no vertices: expected lines such as `v 0 0 0`".to_owned());
        }
        let mut mesh = std::mem::take(&mut self.mesh);
        let keys = &self.keys;
        mesh.positions = keys.iter().map(|k| self.positions[k[0] as usize]).collect();
        if self.has_uvs {
            let uv = |k: &[u32; 3]| self.uvs.get(k[1] as usize).copied().unwrap_or_default();
            mesh.uvs = keys.iter().map(uv).collect();
        }
        if self.has_normals {
            let normal =
                |k: &[u32; 3]| self.normals.get(k[2] as usize).copied().unwrap_or_default();
            mesh.normals = keys.iter().map(normal).collect();
        }
        if !self.colours.is_empty() {
            let colour =
                |k: &[u32; 3]| self.colours.get(k[0] as usize).copied().unwrap_or([1.0; 3]);
            mesh.colours = keys.iter().map(colour).collect();
        }
        Ok(mesh)
    }
}

/// A name, which may have spaces in it.
fn name(rest: &[u8]) -> String {
    String::from_utf8_lossy(rest.trim_ascii()).into_owned()
}

/// Reads up to `out.len()` numbers; returns how many there were.
fn numbers(text: &[u8], out: &mut [f32]) -> Result<usize, String> {
    let words = text
        .split(u8::is_ascii_whitespace)
        .filter(|w| !w.is_empty())
        .take_while(|w| w[0] != b'#');
    let mut found = 0;
    for (word, slot) in words.zip(out) {
        *slot = parsed_f32(word)
            .filter(|x: &f32| x.is_finite())
            .ok_or_else(|| format!("expected a finite number, found `{}`", shortened(word)))?;
        found += 1;
    }
    Ok(found)
}

/// An index from 0 of one of `count` things.
fn index(digits: &[u8], count: usize, what: &str) -> Result<u32, String> {
    let number = std::str::from_utf8(digits)
        .ok()
        .and_then(|w| w.parse::<i64>().ok())
        .ok_or_else(|| format!("expected an index, found `{}`", shortened(digits)))?;
    let known = i64::try_from(count).unwrap_or(i64::MAX);
    let from_zero = if number < 0 {
        known + number
    } else {
        number - 1
    };
    u32::try_from(from_zero)
        .ok()
        .filter(|_| from_zero < known)
        .ok_or_else(|| format!("{what} {number} is out of range; there are {count} before this"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(text: &str) -> Result<Mesh, String> {
        let read = parse(text.as_bytes(), &Limits::default(), false);
        read.map(|file| file.mesh)
            .map_err(|faults| faults[0].to_string())
    }

    fn faults(read: Result<ObjFile, Vec<Fault>>) -> Vec<Fault> {
        read.map_or_else(|faults| faults, |_| Vec::new())
    }

    #[test]
    fn polygons_fan_out_and_corners_are_shared() {
        let mesh = mesh(
            "# square\no s\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\n\
             f 1/1/1 2/2/1 3/2/1 \\\n 4/1/1\nf -4/1/1 -2/2/1 -1/2/1 # again\n",
        )
        .unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 2, 4]]);
        assert_eq!(mesh.positions[4], [0.0, 1.0, 0.0]);
        assert_eq!((mesh.uvs[3], mesh.uvs[4]), ([0.0, 0.0], [1.0, 1.0]));
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 5]);
        assert!(mesh.colours.is_empty());
    }

    #[test]
    fn attributes_that_no_face_has_stay_empty() {
        let mesh = mesh("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1 2 3").unwrap();
        assert!(mesh.uvs.is_empty() && mesh.normals.is_empty());
        assert_eq!(mesh.colours, [[1.0, 0.0, 0.0], [1.0; 3], [1.0; 3]]);
    }

    #[test]
    fn faults_have_their_line() {
        for (text, message) in [
            ("v 0 0\n", "line 1: expected three numbers after `v`"),
            (
                "v 0 0 0\nv 0 x 0\n",
                "line 2: expected a finite number, found `x`",
            ),
            (
                "v 0 0 0\nf 1 1\n",
                "line 2: a face has 2 vertices; expected at least 3",
            ),
            (
                "v 0 0 0\n\nf 1 1 2\n",
                "line 3: vertex 2 is out of range; there are 1 before this",
            ),
            (
                "v 0 0 0\nf 1 1 0",
                "line 2: vertex 0 is out of range; there are 1 before this",
            ),
            (
                "v 0 0 0\nf 1/1 1 1",
                "line 2: texture coordinate 1 is out of range; there are 0 before this",
            ),
            (
                "v 0 0 0\nf 1/1/1/1 1 1",
                "line 2: texture coordinate 1 is out of range; there are 0 before this",
            ),
            ("v 0 0 0\nf /1 1 1", "line 2: texture coordinate 1"),
            ("v nan 0 0", "line 1: expected a finite number, found `nan`"),
            ("", "it has no vertices"),
        ] {
            let found = mesh(text).unwrap_err();
            assert!(found.starts_with(message), "{text:?}: {found}");
        }
    }

    #[test]
    fn limits_are_kept() {
        let limits = Limits {
            max_vertices: 2,
            ..Limits::default()
        };
        for collects in [false, true] {
            let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv x\n";
            let errors = faults(parse(text, &limits, collects));
            assert_eq!(errors.len(), 1, "{errors:?}");
            assert!(errors[0].message.contains("more than 2 vertices"));
        }
    }

    #[test]
    fn a_check_names_every_line_and_keeps_indices_right() {
        // The third vertex is damaged: faces that use it, and the fourth, are no mistakes.
        let text = "v 0 0 0\nv 1 0 0\nv 1 x 0\nv 0 1 0\nvt a\nvn 0 0\nf 1 2 3\nf 1//1 2/1 -1\n\
                    f 1 2\nf 1 2 5\nf 2 4 zwei\nfoo bar\n";
        let read = |collects| faults(parse(text.as_bytes(), &Limits::default(), collects));
        let lines: Vec<_> = read(true).iter().map(|f| f.line).collect();
        assert_eq!(lines, [3, 5, 6, 9, 10, 11].map(Some), "{:?}", read(true));
        assert_eq!(read(false), read(true)[..1]);
    }
}
