//! What rays of small scenes end at, looked up by its place in the scene.
//!
//! Rectangles and faces of boxes are planes: all that is known of them beforehand is here, so that vertices on one of them
//! become surfaces together (`integrator/faces.rs`).

use specula_bsdf::Vec3;

use crate::accel::{BlockHits, Hit};
use crate::convert::{abs, id};
use crate::geometry::{Geometry, NONE, triangle_normal, unit_or};
use crate::offset::coupled;

/// A primitive of a small scene, or two triangles that are a face.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    /// The material, where its vertices are shaded in batches, and whether its sides are materials of their own.
    pub(crate) material: Option<(u32, bool)>,
    /// Whether it is on a light.
    pub(crate) emits: bool,
    pub(crate) face: Option<Face>,
}

/// A face whose normals are all alike.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    /// Geometric, unit, towards the outside.
    pub(crate) normal: Vec3<f32>,
    pub(crate) shading_normal: Vec3<f32>,
    /// A point of it.
    pub(crate) point: Vec3<f32>,
    /// As of `Surface`.
    pub(crate) tangent: Vec3<f32>,
    /// Bound on the error of each component of its points.
    pub(crate) error: f32,
}

/// All of a small scene.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    places: Vec<Place>,
    /// Sides of places (twice its index, and one more for the outside), those of a material one after the other.
    order: Vec<u32>,
}

impl Places {
    /// `None` where the scene is not small, or two triangles that are a face differ in more than their place.
    ///
    /// * `materials`: by shape, as of [`Place`].
    pub(crate) fn new(geometry: &Geometry, materials: &[Option<(u32, bool)>]) -> Option<Self> {
        let (primitives, instance) = geometry.accel.small_primitives()?;
        let hit = |primitive: u32| Hit {
            t: 1.0,
            u: 0.25,
            v: 0.25,
            primitive,
            instance,
        };
        let places = primitives
            .iter()
            .map(|&own| {
                let hits = own.map(hit);
                let group = geometry.group_of(&hits[0]);
                let [shape, other] = own.map(|p| group.shape_of[p as usize]);
                let [emits, emits_too] = own.map(|p| group.light_of(p) != NONE);
                let is_one = shape == other && emits == emits_too;
                is_one.then(|| Place {
                    material: materials[shape as usize],
                    emits,
                    face: (own[0] != own[1])
                        .then(|| Face::of(geometry, hits))
                        .flatten(),
                })
            })
            .collect::<Option<Vec<Place>>>()?;
        let mut order: Vec<u32> = (0..2 * id(places.len())).collect();
        order.sort_by_key(|&side| places[(side / 2) as usize].key(side % 2 == 1));
        Some(Self { places, order })
    }

    /// What a ray of a block hit.
    #[inline(always)]
    pub(crate) fn at(&self, hits: &BlockHits, k: usize) -> Option<(u32, &Place)> {
        let place = hits.place(k);
        Some((place, self.places.get(place as usize)?))
    }

    /// The place of a side.
    #[inline(always)]
    pub(crate) fn of_side(&self, side: u32) -> &Place {
        &self.places[(side / 2) as usize]
    }

    /// Sides, those of a material one after the other.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }
}

impl Place {
    /// Twice the material, and one more for its outside; `None` where its vertices are shaded singly.
    #[inline(always)]
    pub(crate) fn key(&self, outside: bool) -> Option<u32> {
        let (material, _) = self.material?;
        Some(2 * material + u32::from(outside))
    }
}

impl Face {
    /// That of two triangles.
    fn of(geometry: &Geometry, hits: [Hit; 2]) -> Option<Self> {
        const SAME: f32 = 1e-6;
        let facets = [geometry.facet(&hits[0])?, geometry.facet(&hits[1])?];
        let corners = facets.each_ref().map(|f| f.corners.map(|&c| Vec3::from(c)));
        let [normal, other] = corners.map(triangle_normal);
        let [tangent, along] = hits.map(|hit| geometry.tangent(&hit));
        let own = facets.map(|f| f.normals.map(|n| n.map(|&n| Vec3::from(n))));
        let shading_normal = own[0].map_or(normal, |[n, ..]| unit_or(n, normal));
        let others = own.iter().flatten().flatten();
        let are_far = |a: Vec3<f32>, b: Vec3<f32>| (a - b).length() > SAME;
        if are_far(normal, other)
            || are_far(tangent, along)
            || others
                .into_iter()
                .any(|&n| are_far(unit_or(n, normal), shading_normal))
        {
            return None;
        }
        let reach = corners.iter().flatten().fold(0.0_f32, |reach, &p| {
            let [x, y, z] = abs(p).to_array();
            reach.max(x).max(y).max(z)
        });
        Some(Self {
            normal,
            shading_normal,
            point: corners[0][0],
            tangent,
            error: coupled(Vec3::splat(reach)).x,
        })
    }
}
