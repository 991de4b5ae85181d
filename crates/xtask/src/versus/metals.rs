//! What the metals of a compared scene are: those of its file, or all gold, or all white.

use clap::ValueEnum;

/// The metals of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Metals {
    /// Those that its file says.
    Own,
    /// All gold: blue light is absorbed within few bounces, red light goes on.
    Gold,
    /// All white, 0.9996 of the light reflected: paths end where they are too long, or by roulette.
    White,
}

impl Metals {
    /// Index of refraction and extinction of red, green and blue, where they are not the file's.
    fn eta_and_k(self) -> Option<[[f32; 3]; 2]> {
        match self {
            Self::Own => None,
            Self::Gold => Some([[0.143, 0.375, 1.442], [3.98, 2.39, 1.60]]),
            Self::White => Some([[0.01; 3], [10.0; 3]]),
        }
    }

    /// What all metals are, where they are not the file's.
    pub(crate) fn word(self) -> Option<&'static str> {
        match self {
            Self::Own => None,
            Self::Gold => Some("gold"),
            Self::White => Some("white"),
        }
    }

    /// The name of a scene with these metals.
    pub(crate) fn name_of(self, scene: &str) -> String {
        self.word()
            .map_or_else(|| scene.to_owned(), |word| format!("{scene}-{word}"))
    }

    /// What a scene with these metals holds.
    pub(crate) fn title_of(self, title: &str) -> String {
        self.word().map_or_else(
            || title.to_owned(),
            |word| format!("{title}; all metals {word}"),
        )
    }

    /// A scene's text, in either form, with these metals.
    pub(crate) fn replace_in(self, text: &str) -> String {
        let Some(values) = self.eta_and_k() else {
            return text.to_owned();
        };
        let mut text = text.to_owned();
        for (name, [r, g, b]) in ["eta", "k"].into_iter().zip(values) {
            let xml = (format!("<rgb name=\"{name}\" value=\""), "\"");
            text = replace_between(&text, &xml.0, xml.1, &format!("{r}, {g}, {b}"));
            let pbrt = (format!("\"rgb {name}\" ["), "]");
            text = replace_between(&text, &pbrt.0, pbrt.1, &format!(" {r} {g} {b} "));
        }
        text
    }
}

/// Replaces what is between `open` and the next `close`, everywhere.
fn replace_between(text: &str, open: &str, close: &str, with: &str) -> String {
    let mut parts = text.split(open);
    let mut replaced = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(close).unwrap_or(part.len());
        replaced.push_str(open);
        replaced.push_str(with);
        replaced.push_str(&part[end..]);
    }
    replaced
}

#[cfg(test)]
mod tests {
    use specula_scene::scene::MaterialKind;

    use super::super::scenes::SCENES;
    use super::*;
    use crate::workspace;

    #[test]
    fn every_metal_of_both_forms_is_replaced_and_nothing_else() {
        let folder = std::env::temp_dir().join(format!("versus-metals-{}", std::process::id()));
        for file in &SCENES {
            for metals in [Metals::Gold, Metals::White] {
                let own = (file.scene(&workspace::root(), &folder, Metals::Own)).unwrap();
                let scene = (file.scene(&workspace::root(), &folder, metals)).unwrap();
                assert_eq!(
                    scene.name,
                    format!("{}-{}", file.name, metals.word().unwrap())
                );
                assert!(scene.title.ends_with(metals.word().unwrap()));
                let [eta, k] = metals.eta_and_k().unwrap();
                let mut counts = Vec::new();
                for (before, after) in [(own.mitsuba, scene.mitsuba), (own.pbrt, scene.pbrt)] {
                    let load = |path: Option<std::path::PathBuf>| {
                        specula_scene::load(&path.unwrap()).unwrap().scene
                    };
                    let (before, after) = (load(before), load(after));
                    let mut count = 0;
                    for (before, after) in before.materials.iter().zip(&after.materials) {
                        let text = format!("{:?}", after.kind);
                        if matches!(after.kind, MaterialKind::Conductor { .. }) {
                            count += 1;
                            for value in eta.iter().chain(&k) {
                                assert!(text.contains(&format!("{value:?}")), "{text}");
                            }
                        } else {
                            assert_eq!(format!("{:?}", before.kind), text);
                        }
                    }
                    assert_eq!(before.materials.len(), after.materials.len());
                    counts.push(count > 0);
                }
                assert_eq!(counts, [true, true], "{}", scene.name);
            }
        }
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn own_metals_stay() {
        let text = "\"rgb eta\" [ 1 2 3 ] <rgb name=\"k\" value=\"4\"/>";
        assert_eq!(Metals::Own.replace_in(text), text);
        assert_eq!(
            Metals::White.replace_in(text),
            "\"rgb eta\" [ 0.01 0.01 0.01 ] <rgb name=\"k\" value=\"10, 10, 10\"/>"
        );
        assert_eq!(Metals::Own.name_of("room"), "room");
    }
}
