//! `--material`: one material for all surfaces, or for those of a name.

use std::str::FromStr;

use crate::scene::Scene;
use crate::scene::material_text::parse_material;
use crate::scene::scene::MaterialKind;
use globset::{Glob, GlobMatcher};

use super::Failure;

/// Most names that an error lists.
const MOST_NAMES: usize = 12;

/// A material that takes the place of others.
#[derive(Clone, Debug)]
pub(crate) struct MaterialOverride {
    /// Of the materials that it replaces; `None`: all.
    pattern: Option<GlobMatcher>,
    kind: MaterialKind,
}

impl FromStr for MaterialOverride {
    type Err = String;

    /// `TEXT`, or `NAME=TEXT`.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (pattern, material) = match text.rsplit_once('=') {
            Some((pattern, material)) => (Some(pattern.trim()), material.trim()),
            None => (None, text),
        };
        let kind = parse_material(material).map_err(|e| e.to_string())?;
        let matcher = |p: &str| Glob::new(p).map(|g| g.compile_matcher());
        let pattern = pattern.map(matcher).transpose();
        let pattern =
            pattern.map_err(|e| format!("{e}: expected a name, or a pattern of * ? [..]"))?;
        Ok(Self { pattern, kind })
    }
}

impl MaterialOverride {
    /// Replaces the materials that it means.
    ///
    /// # Errors
    ///
    /// Where no material of the scene has such a name.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        let Some(pattern) = &self.pattern else {
            scene.replace_materials(self.kind);
            return Ok(());
        };
        let matches = |name: &str| pattern.is_match(name);
        if scene.replace_materials_named(matches, self.kind) > 0 {
            return Ok(());
        }
        Err(Failure::bad_input(format_args!(
            "--material: no material is named '{}'; {}",
            pattern.glob(),
            names(scene)
        )))
    }
}

/// What the materials of a scene are named.
fn names(scene: &Scene) -> String {
    let named = scene.materials.iter().filter_map(|m| m.name.as_deref());
    let mut all: Vec<String> = named.map(|n| format!("'{n}'")).collect();
    all.sort();
    all.dedup();
    match all.len() {
        0 => "none of the scene's materials has a name".to_owned(),
        n if n <= MOST_NAMES => format!("the scene has {}", all.join(", ")),
        n => format!(
            "the scene has {} and {} more",
            all[..MOST_NAMES].join(", "),
            n - MOST_NAMES
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtin;
    use crate::scene::scene::Material;

    fn scene_with(names: &[&str]) -> Scene {
        let mut scene = builtin::orbs();
        scene.materials.clear();
        for name in names {
            let mut material = Material::new(MaterialKind::Interface);
            material.kind = parse_material("diffuse 0.5").unwrap();
            material.name = Some((*name).to_owned());
            scene.materials.push(material);
        }
        scene.shapes.clear();
        scene.objects.clear();
        scene
    }

    fn replaced(text: &str, names: &[&str]) -> Vec<bool> {
        let mut scene = scene_with(names);
        let before = scene.materials[0].kind;
        let wanted: MaterialOverride = text.parse().unwrap();
        wanted
            .apply(&mut scene)
            .unwrap_or_else(|f| panic!("{}", f.message()));
        scene.materials.iter().map(|m| m.kind != before).collect()
    }

    #[test]
    fn names_and_patterns_choose_materials() {
        let names = ["Gold", "Gold trim", "paint=red", "Glass"];
        let gold = "conductor Au alpha 0.3";
        assert_eq!(replaced(gold, &names), [true; 4]);
        assert_eq!(
            replaced("Gold=conductor Au", &names),
            [true, false, false, false]
        );
        assert_eq!(
            replaced("Gold*=conductor Au", &names),
            [true, true, false, false]
        );
        assert_eq!(
            replaced("G[lo]*d = conductor Au", &names),
            [true, false, false, false]
        );
        assert_eq!(
            replaced("paint=red=conductor Au", &names),
            [false, false, true, false]
        );
    }

    #[test]
    fn a_name_that_nothing_has_is_an_error_with_the_names() {
        let wanted: MaterialOverride = "Silver=conductor Ag".parse().unwrap();
        let error = wanted
            .apply(&mut scene_with(&["Gold", "Glass"]))
            .err()
            .unwrap();
        let (code, said) = error.told();
        assert_eq!(code, 2);
        assert!(
            said.contains("'Silver'") && said.contains("'Glass', 'Gold'"),
            "{said}"
        );
        assert!("Gold=unobtainium".parse::<MaterialOverride>().is_err());
        assert!("[=conductor Au".parse::<MaterialOverride>().is_err());
    }
}
