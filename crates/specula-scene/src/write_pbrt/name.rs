//! Names of materials: the scene's own, each once.

use std::collections::{HashMap, HashSet};

use specula_bsdf::Rgb;

use crate::scene::{Material, MaterialId};

/// The name of every material.
pub(super) struct Names {
    names: Vec<String>,
    /// Whether a material is one before it but for what absorbs on its sides, which shapes say.
    aliases: Vec<bool>,
    taken: HashSet<String>,
}

impl Names {
    pub(super) fn new(materials: &[Material]) -> Self {
        let mut names = Self {
            names: Vec::with_capacity(materials.len()),
            aliases: Vec::with_capacity(materials.len()),
            // Names of the scene come before those that are made up.
            taken: materials.iter().filter_map(|m| m.name.clone()).collect(),
        };
        let mut same: HashMap<&str, Vec<usize>> = HashMap::new();
        for (i, material) in materials.iter().enumerate() {
            let wanted = material.name.as_deref();
            let before = wanted.map(|name| same.entry(name).or_default());
            let twin = before.as_ref().and_then(|before| {
                let twin = |&&j: &&usize| is_alike(material, &materials[j]);
                before.iter().find(twin).copied()
            });
            let name = match (wanted, twin) {
                (_, Some(twin)) => names.names[twin].clone(),
                (Some(name), None) if before.as_ref().is_some_and(|b| b.is_empty()) => {
                    name.to_owned()
                }
                (Some(name), None) => names.unused(name),
                (None, None) => names.unused(&format!("material-{i}")),
            };
            before.into_iter().for_each(|before| before.push(i));
            names.names.push(name);
            names.aliases.push(twin.is_some());
        }
        names
    }

    pub(super) fn of(&self, id: MaterialId) -> &str {
        &self.names[id.0]
    }

    /// Whether a material is written under the name of one before it.
    pub(super) fn is_alias(&self, id: MaterialId) -> bool {
        self.aliases[id.0]
    }

    /// A name for a part of a material.
    pub(super) fn part(&mut self, id: MaterialId, part: &str) -> String {
        let wanted = format!("{}/{part}", self.of(id));
        self.unused(&wanted)
    }

    /// A name that no other material has, derived from `wanted`.
    fn unused(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        let mut number = 2;
        while !self.taken.insert(name.clone()) {
            name = format!("{wanted}-{number}");
            number += 1;
        }
        name
    }
}

/// Whether two materials differ at most in what absorbs on their sides.
fn is_alike(a: &Material, b: &Material) -> bool {
    let plain = |m: &Material| Material {
        absorption: Rgb::BLACK,
        around: None,
        ..m.clone()
    };
    plain(a) == plain(b)
}
