//! Directives of the world: materials, textures, shapes, lights, media, instances.

use std::rc::Rc;

use super::context::Entity;
use super::directive::{InstanceEntity, MaterialEntity, Reader};
use super::medium::MediumEntity;
use super::shape::ShapeEntity;
use super::state::MaterialUse;
use super::token::{TokenKind, Tokens};
use super::{light, texture, unknown, v3};
use crate::error::{ErrorKind, Place, SceneError};
use crate::num::shorten;

impl Reader {
    /// Follows a directive that stands after `WorldBegin`.
    pub(super) fn world_directive(
        &mut self,
        word: &str,
        place: &Place,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), SceneError> {
        match word {
            "MakeNamedMedium" => {
                let mut entity = self.entity(tokens, word)?;
                entity.params = entity.params.with_inherited(&self.state.attributes[3]);
                self.media.push(MediumEntity { entity, used: None });
            }
            "MediumInterface" => self.medium_interface(tokens)?,
            "Material" | "MakeNamedMaterial" | "NamedMaterial" => {
                self.expect_world(word, place)?;
                self.material(word, tokens)?;
            }
            "Texture" => {
                self.expect_world(word, place)?;
                texture::read(&mut self.context, &self.state, tokens)?;
            }
            "Shape" => {
                self.expect_world(word, place)?;
                let entity = self.entity(tokens, word)?;
                self.shape(entity);
            }
            "LightSource" => {
                self.expect_world(word, place)?;
                let mut entity = self.entity(tokens, word)?;
                entity.params = entity.params.with_inherited(&self.state.attributes[1]);
                if self.state.end().is_some() {
                    self.context
                        .warn(place, "the light moves; it is rendered where it starts");
                }
                light::fetch_picture(&mut self.context, &entity)?;
                self.lights.push((entity, self.state.transforms[0]));
            }
            "AreaLightSource" => {
                self.expect_world(word, place)?;
                let mut entity = self.entity(tokens, word)?;
                entity.params = entity.params.with_inherited(&self.state.attributes[1]);
                light::fetch_picture(&mut self.context, &entity)?;
                self.state.area_light = Some(Rc::new(entity));
            }
            "ReverseOrientation" => {
                self.state.reverse_orientation = !self.state.reverse_orientation;
            }
            "ObjectInstance" => {
                let (name, place) = tokens.expect_text("the name of an object")?;
                self.expect_world(word, &place)?;
                if self.in_object {
                    let message = "`ObjectInstance` within an object";
                    return Err(SceneError::new(ErrorKind::Structure, &place, message));
                }
                let name = self.used(v3::Kind::Object, name);
                let to_world = self.state.transforms[0];
                self.instances.push(InstanceEntity {
                    name,
                    place,
                    to_world,
                    end: self.state.end(),
                });
            }
            _ => return Err(unknown::directive(word, place)),
        }
        Ok(())
    }

    fn medium_interface(&mut self, tokens: &mut Tokens<'_>) -> Result<(), SceneError> {
        let inside = tokens.expect_text("the name of a medium")?;
        let mut sides = [self.medium(inside)?; 2];
        if matches!(tokens.peek()?.map(|t| &t.kind), Some(TokenKind::Text(_))) {
            let outside = tokens.expect_text("the name of a medium")?;
            sides[1] = self.medium(outside)?;
        }
        self.state.media = sides;
        Ok(())
    }

    /// The medium of a name; none has an empty one.
    fn medium(&mut self, (name, place): (String, Place)) -> Result<Option<usize>, SceneError> {
        if name.is_empty() {
            return Ok(None);
        }
        let Some(i) = self.media.iter().rposition(|m| m.entity.name == name) else {
            let message = format!("no medium \"{}\" is defined before this", shorten(&name));
            let error = SceneError::new(ErrorKind::UnknownName, &place, message);
            return self.context.problems.record(error).map(|()| None);
        };
        self.media[i].used.get_or_insert(place);
        Ok(Some(i))
    }

    fn material(&mut self, word: &str, tokens: &mut Tokens<'_>) -> Result<(), SceneError> {
        if word == "NamedMaterial" {
            let (name, place) = tokens.expect_text("the name of a material")?;
            let name = self.used(v3::Kind::Material, name);
            self.state.material = MaterialUse::Named(name, place);
            return Ok(());
        }
        let mut entity = self.entity(tokens, word)?;
        entity.params = entity.params.with_inherited(&self.state.attributes[2]);
        let index = self.materials.len();
        if word == "Material" {
            self.materials.push(MaterialEntity { name: None, entity });
            self.state.material = MaterialUse::Defined(index);
            return Ok(());
        }
        let kind = entity.params.string("type")?;
        let (kind, place) = match kind.map(|(k, p)| (k.to_owned(), p.clone())) {
            Some(kind) => kind,
            None => {
                let message = "a named material needs its \"string type\"";
                let error = SceneError::new(ErrorKind::Parameter, &entity.place, message);
                entity.params.keep_unless_damaged(error)?;
                ("diffuse".to_owned(), entity.place.clone())
            }
        };
        let name = std::mem::replace(&mut entity.name, kind);
        let name = self.defined(v3::Kind::Material, name);
        let named_at = std::mem::replace(&mut entity.place, place);
        if self.named_materials.insert(name.clone(), index).is_some() {
            let message = format!("material \"{}\" is defined twice", shorten(&name));
            let error = SceneError::new(ErrorKind::Duplicate, &named_at, message);
            self.context.problems.record(error)?;
        }
        self.materials.push(MaterialEntity {
            name: Some(name),
            entity,
        });
        Ok(())
    }

    fn shape(&mut self, mut entity: Entity) {
        entity.params = entity.params.with_inherited(&self.state.attributes[0]);
        let mut area_light = self.state.area_light.clone();
        if self.in_object && area_light.take().is_some() {
            // pbrt-v4 does the same.
            self.context.warn(
                &entity.place,
                "area lights in objects are not supported: this shape emits nothing",
            );
        }
        let mut end = self.state.end();
        if area_light.is_some() && end.take().is_some() {
            // pbrt-v4 refuses it.
            let message = "the shape moves and emits light: it is rendered where it starts";
            self.context.warn(&entity.place, message);
        }
        let shape = ShapeEntity {
            entity,
            to_world: self.state.transforms[0],
            end,
            reverse_orientation: self.state.reverse_orientation,
            material: self.state.material.clone(),
            media: self.state.media,
            area_light,
        };
        match self.objects.last_mut() {
            Some(object) if self.in_object => object.shapes.push(shape),
            _ => self.shapes.push(shape),
        }
    }
}
