//! Changes of parameters: an older version's names and types become those of pbrt-v4.

use std::cell::Cell;
use std::rc::Rc;

use super::{Param, ParamList, Values};
use crate::error::Place;
use crate::spectrum::ColourSpace;

impl ParamList {
    /// The directive's own parameter of that name; it does not count as used.
    pub(in crate::pbrt) fn own(&self, name: &str) -> Option<&Param> {
        self.own.iter().find(|p| p.name == name).map(|p| &**p)
    }

    /// The numbers of the directive's own parameter of that name and kind.
    pub(in crate::pbrt) fn own_numbers(&self, name: &str, kind: &str) -> Option<&[f64]> {
        match self.own(name) {
            Some(Param {
                kind: found,
                values: Values::Numbers(numbers),
                ..
            }) if *found == kind => Some(numbers),
            _ => None,
        }
    }

    /// The directive's own parameters, to be changed.
    pub(in crate::pbrt) fn own_mut(&mut self) -> impl Iterator<Item = &mut Param> {
        self.own.iter_mut().map(Rc::make_mut)
    }

    /// Gives a parameter another name, unless that is taken.
    pub(in crate::pbrt) fn rename(&mut self, from: &str, to: &str) {
        if self.own(to).is_none()
            && let Some(param) = self.own_mut().find(|p| p.name == from)
        {
            to.clone_into(&mut param.name);
        }
    }

    /// Takes a parameter away.
    pub(in crate::pbrt) fn remove(&mut self, name: &str) -> Option<Param> {
        let at = self.own.iter().position(|p| p.name == name)?;
        Some(Rc::unwrap_or_clone(self.own.remove(at)))
    }

    /// Sets a parameter, in place of one of that name.
    pub(in crate::pbrt) fn set(
        &mut self,
        kind: &'static str,
        name: &str,
        values: Values,
        place: &Place,
    ) {
        self.remove(name);
        self.own.push(Rc::new(Param {
            kind,
            name: name.to_owned(),
            values,
            place: place.clone(),
            space: ColourSpace::Srgb,
            used: Cell::new(false),
        }));
    }

    /// [`ParamList::set`] of a number.
    pub(in crate::pbrt) fn set_float(&mut self, name: &str, value: f64, place: &Place) {
        self.set("float", name, Values::Numbers(vec![value]), place);
    }

    /// [`ParamList::set`] of strings.
    pub(in crate::pbrt) fn set_texts(
        &mut self,
        kind: &'static str,
        name: &str,
        texts: &[&str],
        place: &Place,
    ) {
        let texts = texts.iter().map(|t| ((*t).to_owned(), place.clone()));
        self.set(kind, name, Values::Texts(texts.collect()), place);
    }
}
