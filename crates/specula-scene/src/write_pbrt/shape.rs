//! Shapes, their emission, and instances.

use std::collections::HashMap;

use specula_bsdf::Rgb;

use super::{WriteError, Writer, quoted, rgb_list};
use crate::scene::{
    Channel, CurveKind, CurveMesh, Emission, FloatParam, Geometry, Mesh, MeshId, PatchMesh,
    QuadricPart, Shape,
};

/// Most triangles, and vertices, of a mesh within a text alone.
const MOST_INLINE: usize = 20_000;

impl Writer<'_> {
    pub(super) fn shapes(&mut self) -> Result<(), WriteError> {
        let scene = self.scene;
        let mut meshes = HashMap::new();
        for (i, object) in scene.objects.iter().enumerate() {
            self.line(&format!("ObjectBegin \"object-{i}\""));
            for shape in &object.shapes {
                self.shape(shape, &mut meshes)?;
            }
            self.line("ObjectEnd");
        }
        for shape in &scene.shapes {
            self.shape(shape, &mut meshes)?;
        }
        for instance in &scene.instances {
            let place = self.place(&instance.to_world, instance.motion.as_ref());
            self.line(&format!(
                "AttributeBegin\n{place}\nObjectInstance \"object-{}\"\nAttributeEnd",
                instance.object.0
            ));
        }
        Ok(())
    }

    fn shape(
        &mut self,
        shape: &Shape,
        meshes: &mut HashMap<MeshId, String>,
    ) -> Result<(), WriteError> {
        let mut kinds = match shape.geometry {
            Geometry::Mesh(id) if self.is_inline(id) => vec![inline(&self.scene.meshes[id.0])],
            Geometry::Mesh(id) => {
                let file = match meshes.get(&id) {
                    Some(file) => file.clone(),
                    None => {
                        let file = self.mesh(id)?;
                        meshes.insert(id, file.clone());
                        file
                    }
                };
                vec![format!(
                    "\"plymesh\" \"string filename\" [ {} ]",
                    quoted(&file)
                )]
            }
            Geometry::Sphere { radius } => {
                vec![format!("\"sphere\" \"float radius\" [ {radius} ]")]
            }
            Geometry::Disk { radius, height } => vec![format!(
                "\"disk\" \"float radius\" [ {radius} ] \"float height\" [ {height} ]"
            )],
            Geometry::QuadricPart(part) => vec![quadric_part(&part)],
            Geometry::Patches(id) => vec![patches(&self.scene.patch_meshes[id.0])],
            Geometry::Curves(id) => curves(&self.scene.curve_meshes[id.0]),
        };
        if shape.alpha != FloatParam::Value(1.0) {
            let alpha = self.float_param("alpha", shape.alpha)?;
            kinds.iter_mut().for_each(|kind| *kind += &alpha);
        }
        let emission = match shape.emission {
            Some(emission) => self.emission(emission)?,
            None => String::new(),
        };
        let reverse = if shape.reverse_orientation {
            "ReverseOrientation\n"
        } else {
            ""
        };
        let place = self.place(&shape.to_world, shape.motion.as_ref());
        let material = quoted(self.names.of(shape.material));
        let media = self.sides(shape.material);
        let shapes = kinds.join("\nShape ");
        self.line(&format!(
            "AttributeBegin\n{place}\n{reverse}{emission}{media}NamedMaterial {material}\nShape {shapes}\nAttributeEnd"
        ));
        Ok(())
    }

    /// Whether a mesh is part of the text: there are no files beside it, and it is small.
    fn is_inline(&self, id: MeshId) -> bool {
        let mesh = &self.scene.meshes[id.0];
        !self.keeps && mesh.triangles.len().max(mesh.positions.len()) <= MOST_INLINE
    }

    fn emission(&mut self, emission: Emission) -> Result<String, WriteError> {
        let sides = emission.two_sided;
        let light = match self.plain_picture(emission.radiance) {
            Some((image, factor)) => {
                let file = self.image(image, Channel::Rgb)?;
                let scale = factor.mean();
                if factor != Rgb::splat(scale) {
                    self.note("coloured factors on pictures of lights are written as their mean");
                }
                format!(
                    "\"string filename\" [ {} ] \"float scale\" [ {scale} ]",
                    quoted(&file)
                )
            }
            None => {
                if !matches!(emission.radiance, crate::scene::ColourParam::Value(_)) {
                    self.note(
                        "textures of lights other than a plain picture are written as their mean",
                    );
                }
                format!("\"rgb L\" [ {} ]", rgb_list(self.mean(emission.radiance)))
            }
        };
        Ok(format!(
            "AreaLightSource \"diffuse\" {light} \"bool twosided\" [ {sides} ]\n"
        ))
    }
}

/// A part of a quadric, with the angle in degrees.
fn quadric_part(part: &QuadricPart) -> String {
    let degrees = |phi: f32| f64::from(phi).to_degrees();
    let cut = |kind: &str, radius: f32, [low, high]: [f32; 2], phi_max: f32| {
        format!(
            "\"{kind}\" \"float radius\" [ {radius} ] \"float zmin\" [ {low} ] \"float zmax\" [ {high} ] \
             \"float phimax\" [ {} ]",
            degrees(phi_max)
        )
    };
    match *part {
        QuadricPart::Sphere { radius, z, phi_max } => cut("sphere", radius, z, phi_max),
        QuadricPart::Cylinder { radius, z, phi_max } => cut("cylinder", radius, z, phi_max),
        QuadricPart::Disk {
            radius,
            inner,
            height,
            phi_max,
        } => format!(
            "\"disk\" \"float radius\" [ {radius} ] \"float innerradius\" [ {inner} ] \
             \"float height\" [ {height} ] \"float phimax\" [ {} ]",
            degrees(phi_max)
        ),
    }
}

/// A mesh as a shape of the text.
fn inline(mesh: &Mesh) -> String {
    let indices = list("integer indices", mesh.triangles.iter().flatten());
    let vertices = vertices([&mesh.positions, &mesh.normals], &mesh.uvs);
    format!("\"trianglemesh\"{indices}{vertices}")
}

/// Patches as a shape of the text, in which they always are: files of meshes have none.
fn patches(mesh: &PatchMesh) -> String {
    let indices = list("integer indices", mesh.patches.iter().flatten());
    let vertices = vertices([&mesh.positions, &mesh.normals], &mesh.uvs);
    format!("\"bilinearmesh\"{indices}{vertices}")
}

/// A shape of the text for each segment.
fn curves(curves: &CurveMesh) -> Vec<String> {
    let kind = match curves.kind {
        CurveKind::Flat => "flat",
        CurveKind::Cylinder => "cylinder",
        CurveKind::Ribbon => "ribbon",
    };
    let segments = curves
        .segments
        .iter()
        .zip(&curves.width_at_ends)
        .enumerate();
    let written = segments.map(|(i, (controls, [from, to]))| {
        let points = list("point3 P", controls.iter().flatten());
        let normals = curves.normals.get(i).into_iter().flatten().flatten();
        let normals = list("normal N", normals);
        format!(
            "\"curve\" \"string type\" \"{kind}\"{points}{normals} \"float width0\" [ {from} ] \"float width1\" [ {to} ]"
        )
    });
    written.collect()
}

fn vertices([positions, normals]: [&[[f32; 3]]; 2], uvs: &[[f32; 2]]) -> String {
    let points = list("point3 P", positions.iter().flatten());
    let normals = list("normal N", normals.iter().flatten());
    let uvs = list("point2 uv", uvs.iter().flatten());
    format!("{points}{normals}{uvs}")
}

/// A parameter of numbers; nothing where there are none.
fn list<T: ToString>(name: &str, numbers: impl Iterator<Item = T>) -> String {
    let numbers: Vec<String> = numbers.map(|n| n.to_string()).collect();
    match numbers.is_empty() {
        true => String::new(),
        false => format!(" \"{name}\" [ {} ]", numbers.join(" ")),
    }
}
