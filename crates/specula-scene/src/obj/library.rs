//! Libraries of materials of OBJ files: `.mtl`, with the parameters of physically based materials.
//!
//! A line with a mistake is left out, which a message says: these files are written by hand and by old programs.

use crate::num::{parsed_f32, shortened};

/// A material, as its lines say.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LibraryMaterial {
    pub(super) name: String,
    /// `Kd`, `Ks`, `Ke` and `Tf`.
    pub(super) diffuse: [f32; 3],
    pub(super) specular: [f32; 3],
    pub(super) emission: [f32; 3],
    pub(super) filter: Option<[f32; 3]>,
    /// `Ns`: Phong's exponent.
    pub(super) exponent: f32,
    /// `Ni`.
    pub(super) ior: f32,
    /// `d`, or 1 less `Tr`.
    pub(super) opacity: f32,
    /// `illum`.
    pub(super) model: u32,
    /// `Pr` and `Pm`.
    pub(super) roughness: Option<f32>,
    pub(super) metallic: Option<f32>,
    pub(super) maps: Maps,
}

/// Pictures of a material.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Maps {
    /// `map_Kd`.
    pub(super) diffuse: Option<Map>,
    /// `map_Ke`.
    pub(super) emission: Option<Map>,
    /// `map_d`.
    pub(super) opacity: Option<Map>,
    /// `map_Pr` and `map_Pm`.
    pub(super) roughness: Option<Map>,
    pub(super) metallic: Option<Map>,
    /// `map_Bump` or `bump`, which may hold normals.
    pub(super) bump: Option<Map>,
    /// `norm`.
    pub(super) normal: Option<Map>,
}

/// A picture and how it lies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    /// `-bm`.
    pub(super) strength: f32,
    /// `-s` and `-o`: coordinates are scaled, then moved.
    pub(super) scale: [f32; 2],
    pub(super) offset: [f32; 2],
    /// `-clamp on`.
    pub(super) clamps: bool,
}

impl LibraryMaterial {
    fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            diffuse: [0.8; 3],
            specular: [0.0; 3],
            emission: [0.0; 3],
            filter: None,
            exponent: 0.0,
            ior: 1.5,
            opacity: 1.0,
            model: 2,
            roughness: None,
            metallic: None,
            maps: Maps::default(),
        }
    }

    /// Takes a line.
    fn set(&mut self, word: &str, rest: &str) -> Result<(), String> {
        match word.to_ascii_lowercase().as_str() {
            "kd" => self.diffuse = share(rest)?,
            "ks" => self.specular = share(rest)?,
            "ke" => self.emission = colour(rest)?,
            "tf" => self.filter = Some(share(rest)?),
            "ns" => self.exponent = number(rest)?.max(0.0),
            "ni" => self.ior = number(rest)?.min(100.0),
            "d" => self.opacity = number(rest.trim_start_matches("-halo"))?.clamp(0.0, 1.0),
            "tr" => self.opacity = 1.0 - number(rest)?.clamp(0.0, 1.0),
            "illum" => {
                let model = rest.trim().parse();
                self.model = model.map_err(|_| expected("a number from 0 to 10", rest))?;
            }
            "pr" => self.roughness = Some(number(rest)?.clamp(0.0, 1.0)),
            "pm" => self.metallic = Some(number(rest)?.clamp(0.0, 1.0)),
            "map_kd" => self.maps.diffuse = Some(map(rest)?),
            "map_ke" => self.maps.emission = Some(map(rest)?),
            "map_d" | "map_tr" => self.maps.opacity = Some(map(rest)?),
            "map_pr" => self.maps.roughness = Some(map(rest)?),
            "map_pm" => self.maps.metallic = Some(map(rest)?),
            "map_bump" | "bump" => self.maps.bump = Some(map(rest)?),
            "norm" | "map_kn" => self.maps.normal = Some(map(rest)?),
            _ => {}
        }
        Ok(())
    }
}

/// The materials of a library, and what is left out of it, with the numbers of lines.
pub(super) fn parse(bytes: &[u8]) -> (Vec<LibraryMaterial>, Vec<(usize, String)>) {
    let text = String::from_utf8_lossy(bytes);
    let (mut materials, mut faults) = (Vec::<LibraryMaterial>::new(), Vec::new());
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        let (word, rest) = line
            .split_once(|c: char| c.is_ascii_whitespace())
            .unwrap_or((line, ""));
        if word == "newmtl" {
            materials.push(LibraryMaterial::new(rest.trim()));
        } else if let Some(material) = materials.last_mut()
            && let Err(message) = material.set(word, rest)
        {
            faults.push((i + 1, format!("{word}: {message}: it is left out")));
        }
    }
    (materials, faults)
}

fn expected(what: &str, found: &str) -> String {
    format!(
        "expected {what}, found `{}`",
        shortened(found.trim().as_bytes())
    )
}

fn finite(word: &str) -> Option<f32> {
    parsed_f32(word.as_bytes()).filter(|x: &f32| x.is_finite())
}

fn number(text: &str) -> Result<f32, String> {
    let word = text.split_ascii_whitespace().next().unwrap_or_default();
    finite(word).ok_or_else(|| expected("a finite number", text))
}

/// Three numbers, or one for all.
fn colour(text: &str) -> Result<[f32; 3], String> {
    let words = text.split_ascii_whitespace().take(3);
    let found: Option<Vec<f32>> = words.map(finite).collect();
    match found.as_deref() {
        Some([r, g, b]) => Ok([*r, *g, *b].map(|x| x.max(0.0))),
        Some([all]) => Ok([all.max(0.0); 3]),
        _ => Err(expected("three finite numbers", text)),
    }
}

/// A colour that reflects or passes: at most 1.
fn share(text: &str) -> Result<[f32; 3], String> {
    colour(text).map(|c| c.map(|x| x.min(1.0)))
}

/// The options of a picture, and its file: all that follows them.
fn map(text: &str) -> Result<Map, String> {
    let mut map = Map {
        file: String::new(),
        strength: 1.0,
        scale: [1.0; 2],
        offset: [0.0; 2],
        clamps: false,
    };
    let mut rest = text.trim();
    while let Some(option) = rest.strip_prefix('-') {
        let (name, after) = word(option);
        rest = after;
        // How many values there may be; -o, -s and -t may have fewer, so that what is no number is the file.
        let most = match name {
            "o" | "s" | "t" => 3,
            "mm" => 2,
            _ => 1,
        };
        let mut values = Vec::new();
        for _ in 0..most {
            let (value, after) = word(rest);
            if value.is_empty() || (most == 3 && finite(value).is_none()) {
                break;
            }
            values.push(value);
            rest = after;
        }
        let of = |i: usize, default: f32| values.get(i).and_then(|v| finite(v)).unwrap_or(default);
        match name {
            "bm" => map.strength = of(0, 1.0),
            "s" => map.scale = [of(0, 1.0), of(1, 1.0)],
            "o" => map.offset = [of(0, 0.0), of(1, 0.0)],
            "clamp" => map.clamps = values.first() == Some(&"on"),
            _ => {}
        }
    }
    if rest.is_empty() {
        return Err("expected the name of a picture".to_owned());
    }
    map.file = rest.replace('\\', "/");
    Ok(map)
}

/// The first word, and what follows.
fn word(text: &str) -> (&str, &str) {
    let (word, rest) = text
        .split_once(|c: char| c.is_ascii_whitespace())
        .unwrap_or((text, ""));
    (word, rest.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_are_read_line_by_line() {
        let text = "# made by hand\nKd 1 1 1\nnewmtl red paint\n\tKd 0.5 0.1 0.1\r\nKs 0.5\nNs 98\nd 0.25\nillum 2\n\
                    map_Kd -s 2 3 -clamp on folder\\my picture.png\nnewmtl b\nPr 0.3\nPm 1\nTr 0.25\n\
                    map_Bump -bm 0.5 -o 0.1 n.png\nKe 3 2 1\nNi 1.33\nTf 1 0 0\n";
        let (found, faults) = parse(text.as_bytes());
        assert!(faults.is_empty(), "{faults:?}");
        assert_eq!(found.len(), 2);
        let [a, b] = [&found[0], &found[1]];
        assert_eq!(a.name, "red paint");
        assert_eq!((a.diffuse, a.specular), ([0.5, 0.1, 0.1], [0.5; 3]));
        assert_eq!((a.exponent, a.opacity, a.model), (98.0, 0.25, 2));
        let picture = a.maps.diffuse.as_ref().unwrap();
        assert_eq!(picture.file, "folder/my picture.png");
        assert_eq!((picture.scale, picture.clamps), ([2.0, 3.0], true));
        assert_eq!(
            (b.roughness, b.metallic, b.opacity),
            (Some(0.3), Some(1.0), 0.75)
        );
        assert_eq!(
            (b.emission, b.ior, b.filter),
            ([3.0, 2.0, 1.0], 1.33, Some([1.0, 0.0, 0.0]))
        );
        let bump = b.maps.bump.as_ref().unwrap();
        assert_eq!((bump.strength, bump.offset), (0.5, [0.1, 0.0]));
    }

    #[test]
    fn lines_with_mistakes_are_left_out_and_told() {
        let (found, faults) =
            parse(b"newmtl a\nKd 0.1 x 0.1\nNs inf\nmap_Kd -s 1 2\nillum -1\nd 0.5\n");
        let lines: Vec<_> = faults.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [2, 3, 4, 5]);
        assert_eq!(
            faults[0].1,
            "Kd: expected three finite numbers, found `0.1 x 0.1`: it is left out"
        );
        assert_eq!((found[0].diffuse, found[0].opacity), ([0.8; 3], 0.5));
    }
}
