//! A plugin as the file names it: its kind, its name and its properties.

use std::cell::Cell;
use std::rc::Rc;

use glam::{DMat4, DVec3};

use super::value::Value;
use crate::error::{ErrorKind, Place, SceneError};
use crate::num::shorten;
use crate::problems::Problems;

/// A plugin with its properties.
#[derive(Debug)]
pub(super) struct Element {
    /// The tag: `bsdf`, `shape`, `emitter` and so on.
    pub(super) class: &'static str,
    /// The attribute `type`.
    pub(super) plugin: String,
    pub(super) id: Option<String>,
    pub(super) place: Place,
    /// Whether the file is of the 0.6 dialect.
    pub(super) legacy: bool,
    pub(super) properties: Vec<Property>,
    /// Whether its properties were read: unused ones are reported only then.
    pub(super) visited: Cell<bool>,
    /// Whether something refers to its id.
    pub(super) referenced: Cell<bool>,
    pub(super) problems: Problems,
    /// Whether a mistake was recorded: others may follow from it.
    pub(super) damaged: Rc<Cell<bool>>,
}

/// A property with its name; nameless children have an empty one.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) value: Value,
    pub(super) place: Place,
    pub(super) used: Cell<bool>,
    /// That of the plugin that has it.
    pub(super) damaged: Rc<Cell<bool>>,
}

impl Element {
    /// `bsdf "diffuse"`, for messages.
    pub(super) fn title(&self) -> String {
        format!("{} \"{}\"", self.class, shorten(&self.plugin))
    }

    pub(super) fn error(&self, message: impl Into<String>) -> SceneError {
        SceneError::new(ErrorKind::Parameter, &self.place, message)
    }

    /// Records a mistake in one of the properties.
    ///
    /// # Errors
    ///
    /// The mistake, in an ordinary load.
    pub(super) fn record(&self, error: SceneError) -> Result<(), SceneError> {
        self.damaged.set(true);
        self.problems.record(error)
    }

    /// What was read of the plugin, or a stand-in where its mistakes are recorded; one that may follow
    /// from another is not. Nesting that is too deep may occur in many places: that
    /// mistake goes on to the outermost plugin.
    ///
    /// # Errors
    ///
    /// That of `read`, in an ordinary load.
    pub(super) fn or<T>(
        &self,
        read: Result<T, SceneError>,
        stand_in: impl FnOnce() -> T,
    ) -> Result<T, SceneError> {
        match read {
            Err(error) if error.kind() != ErrorKind::Limit => {
                if !(self.damaged.get() && self.problems.is_check()) {
                    self.record(error)?;
                }
                Ok(stand_in())
            }
            other => other,
        }
    }

    /// The property `name`, which then counts as used.
    pub(super) fn find(&self, name: &str) -> Option<&Property> {
        self.visited.set(true);
        let found = self.properties.iter().find(|p| p.name == name)?;
        found.used.set(true);
        Some(found)
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.properties.iter().any(|p| p.name == name)
    }

    /// Marks properties as used that change no picture.
    pub(super) fn ignore(&self, names: &[&str]) {
        for name in names {
            self.find(name);
        }
    }

    pub(super) fn number(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        let Some(property) = self.find(name) else {
            return Ok(default);
        };
        match property.value {
            Value::Number(x) => Ok(x),
            #[expect(clippy::cast_precision_loss, reason = "far beyond any sensible value")]
            Value::Integer(x) => Ok(x as f64),
            _ => self.record(property.wrong("a float")).map(|()| default),
        }
    }

    /// A number that is not negative.
    pub(super) fn not_negative(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        let x = self.number(name, default)?;
        if x >= 0.0 {
            return Ok(x);
        }
        self.record(self.out_of_range(name, "not negative", x))?;
        Ok(default)
    }

    /// A number above zero.
    pub(super) fn above_zero(&self, name: &str, default: f64) -> Result<f64, SceneError> {
        let x = self.number(name, default)?;
        if x > 0.0 {
            return Ok(x);
        }
        self.record(self.out_of_range(name, "above 0", x))?;
        Ok(default)
    }

    fn out_of_range(&self, name: &str, expected: &str, found: f64) -> SceneError {
        let message = format!("\"{name}\": expected a number {expected}, found {found}");
        SceneError::new(ErrorKind::Parameter, &self.place_of(name), message)
    }

    pub(super) fn integer(&self, name: &str, default: i64) -> Result<i64, SceneError> {
        let Some(property) = self.find(name) else {
            return Ok(default);
        };
        match property.value {
            Value::Integer(x) => Ok(x),
            #[expect(clippy::cast_possible_truncation, reason = "whole, and bounded before")]
            Value::Number(x) if x.fract() == 0.0 && x.abs() < 9e15 => Ok(x as i64),
            _ => self.record(property.wrong("an integer")).map(|()| default),
        }
    }

    /// An integer within a range.
    pub(super) fn integer_within(
        &self,
        name: &str,
        default: u32,
        range: std::ops::RangeInclusive<u32>,
    ) -> Result<u32, SceneError> {
        let found = self.integer(name, i64::from(default))?;
        match u32::try_from(found).ok().filter(|x| range.contains(x)) {
            Some(x) => Ok(x),
            None => {
                let (least, most) = (range.start(), range.end());
                let message = format!(
                    "\"{name}\": expected an integer from {least} to {most}, found {found}"
                );
                let place = self.place_of(name);
                self.record(SceneError::new(ErrorKind::Parameter, &place, message))?;
                Ok(default)
            }
        }
    }

    pub(super) fn boolean(&self, name: &str, default: bool) -> Result<bool, SceneError> {
        match self.find(name) {
            None => Ok(default),
            Some(property) => match property.value {
                Value::Boolean(x) => Ok(x),
                _ => self.record(property.wrong("a boolean")).map(|()| default),
            },
        }
    }

    pub(super) fn text(&self, name: &str) -> Result<Option<&str>, SceneError> {
        match self.find(name) {
            None => Ok(None),
            Some(property) => match &property.value {
                Value::Text(text) => Ok(Some(text)),
                _ => self.record(property.wrong("a string")).map(|()| None),
            },
        }
    }

    pub(super) fn vector(&self, name: &str) -> Result<Option<DVec3>, SceneError> {
        match self.find(name) {
            None => Ok(None),
            Some(property) => match property.value {
                Value::Vector(v) => Ok(Some(v)),
                _ => {
                    let error = property.wrong("a point or vector");
                    self.record(error).map(|()| None)
                }
            },
        }
    }

    pub(super) fn transform(&self, name: &str) -> Result<DMat4, SceneError> {
        match self.find(name) {
            None => Ok(DMat4::IDENTITY),
            Some(property) => match property.value {
                Value::Transform(m) => Ok(m),
                _ => {
                    let error = property.wrong("a transform");
                    self.record(error).map(|()| DMat4::IDENTITY)
                }
            },
        }
    }

    /// The place of a property, else of the plugin.
    pub(super) fn place_of(&self, name: &str) -> Place {
        let property = self.properties.iter().find(|p| p.name == name);
        property.map_or_else(|| self.place.clone(), |p| p.place.clone())
    }
}

impl Property {
    /// The error for a value of another type.
    pub(super) fn wrong(&self, expected: &str) -> SceneError {
        let message = format!(
            "\"{}\": expected {expected}, found <{}>",
            shorten(&self.name),
            self.value.kind()
        );
        SceneError::new(ErrorKind::Parameter, &self.place, message)
    }

    pub(super) fn error(&self, message: impl Into<String>) -> SceneError {
        SceneError::new(ErrorKind::Parameter, &self.place, message)
    }

    /// The plugin that is nested here, without looking up references.
    pub(super) fn nested(&self) -> Option<&Rc<Element>> {
        match &self.value {
            Value::Element(element) => Some(element),
            _ => None,
        }
    }
}
