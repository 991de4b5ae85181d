//! Names that are defined again: in pbrt-v3 each definition holds from there on.

use std::collections::HashMap;

use crate::pbrt::param::{ParamList, Values};

/// What a name is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::pbrt) enum Kind {
    Texture(&'static str),
    Material,
    Object,
}

/// The newest name of everything that is defined.
#[derive(Debug, Default)]
pub(in crate::pbrt) struct Names {
    newest: HashMap<(Kind, String), String>,
    count: usize,
}

impl Names {
    /// Defines a name, which becomes another where it was defined before.
    pub(in crate::pbrt) fn define(&mut self, kind: Kind, name: &mut String) {
        let key = (kind, name.clone());
        if self.newest.contains_key(&key) {
            self.count += 1;
            *name = format!("{name} (renamed {})", self.count);
        }
        self.newest.insert(key, name.clone());
    }

    /// The newest thing of a name.
    pub(in crate::pbrt) fn newest(&self, kind: Kind, name: &mut String) {
        if let Some(newest) = self.newest.get(&(kind, name.clone())) {
            name.clone_from(newest);
        }
    }

    /// Lets a mixture refer to the newest materials.
    pub(super) fn use_materials(&self, params: &mut ParamList) {
        if self.count == 0 {
            return;
        }
        for param in params.own_mut().filter(|p| p.name == "materials") {
            if let Values::Texts(texts) = &mut param.values {
                texts
                    .iter_mut()
                    .for_each(|(name, _)| self.newest(Kind::Material, name));
            }
        }
    }

    /// Lets parameters refer to the newest textures.
    pub(super) fn use_textures(&self, params: &mut ParamList) {
        if self.count == 0 {
            return;
        }
        for param in params.own_mut().filter(|p| p.kind == "texture") {
            let Values::Texts(texts) = &mut param.values else {
                continue;
            };
            for (name, _) in texts {
                let before = name.clone();
                self.newest(Kind::Texture("float"), name);
                if *name == before {
                    self.newest(Kind::Texture("spectrum"), name);
                }
            }
        }
    }
}
