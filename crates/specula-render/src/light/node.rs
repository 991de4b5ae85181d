//! A set of lights as a point sees it: the bound on what could arrive.

use specula_bsdf::Vec3;

use super::cone::EmissionCone;
use crate::convert::narrow;
use crate::layout;
use crate::words::Words;

/// How far a cosine must be beyond its bound before a light is left out; also the least value of
/// either cosine that is not left out. It covers the rounding of `f32`.
pub(super) const SLACK: f32 = 1e-3;
/// Above every importance: two of them add up to a finite number.
pub(super) const MOST: f32 = 1e37;

/// Least share of the lesser child: rounding must not take its chance.
pub(super) const LEAST_SHARE: f32 = 1e-6;

/// A point to be lit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    pub(crate) point: Vec3<f32>,
    /// Unit; light from below it is lost. `None` where light from every side counts.
    pub(crate) normal: Option<Vec3<f32>>,
}

/// A node of the tree of lights: bounds of the lights below it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Of a sphere around the lights.
    pub(super) centre: Vec3<f32>,
    pub(super) radius: f32,
    /// `1 / radius^2`.
    pub(super) inverse_square: f32,
    pub(super) axis: Vec3<f32>,
    pub(super) cos_o: f32,
    pub(super) sin_o: f32,
    pub(super) cos_e: f32,
    /// Sum of the peak intensities.
    pub(super) intensity: f32,
    pub(super) two_sided: bool,
    pub(super) leaf: bool,
    /// Of a leaf, its light; otherwise the distance to the right child. The left child follows.
    pub(super) link: u32,
}

impl Node {
    /// * `centre`, `radius`: sphere around the lights.
    pub(super) fn new(
        centre: Vec3<f32>,
        radius: f32,
        cone: &EmissionCone,
        intensity: f64,
        (leaf, link): (bool, u32),
    ) -> Self {
        // Rounded outwards.
        let cos_o = (narrow(cone.theta_o.cos()) - 1e-6).max(-1.0);
        Self {
            centre,
            radius,
            inverse_square: 1.0 / (radius * radius),
            axis: cone.axis.cast(),
            cos_o,
            sin_o: (1.0 - cos_o * cos_o).max(0.0).sqrt(),
            cos_e: narrow(cone.theta_e.cos()),
            intensity: narrow(intensity).clamp(f32::MIN_POSITIVE, MOST),
            two_sided: cone.two_sided,
            leaf,
            link,
        }
    }

    /// For shaders: sphere, axis, cosines, intensity, flags (two-sided, leaf), link.
    pub(super) fn flatten(&self, to: &mut Words) {
        let record = to.offset();
        to.vector(self.centre);
        to.number(self.radius);
        to.vector(self.axis);
        to.floats([self.cos_o, self.cos_e, self.intensity]);
        to.id(u32::from(self.two_sided) | u32::from(self.leaf) << 1);
        to.id(self.link);
        to.field(record, layout::LIGHT_NODE_SIZE);
    }

    /// An estimate of the irradiance by the node's lights, 0 only where none can contribute.
    ///
    /// ```text
    /// I cos(theta') cos(theta_i') / max(d^2, r^2),
    /// theta' = max(theta - theta_o - theta_u, 0),   theta_i' = max(theta_i - theta_u, 0)
    /// ```
    ///
    /// with the angles `theta` of the axis and `theta_i` of the receiver's normal to the line
    /// between the centres, and the half angle `theta_u` of the sphere around the lights; 0 where
    /// `theta' > theta_e` or `theta_i' > pi/2`.
    ///
    /// * Returns: in the unit of the intensities over that of lengths squared; finite.
    ///
    /// Source: Conty Estevez and Kulla 2018, eq. 3. Departures: peak intensity stands for power,
    /// so that lights of different kinds compare by what they send to a point; the distance is
    /// bounded by the sphere's radius; receivers within the sphere know no angles.
    #[inline]
    pub(super) fn importance(&self, receiver: &Receiver) -> f32 {
        self.importance_at(receiver.point, receiver.normal.unwrap_or(Vec3::ZERO))
    }

    /// [`Node::importance`] without branches on the receiver, so that loops over many become vectors.
    ///
    /// * `normal`: zero where light from every side counts.
    #[inline(always)]
    pub(super) fn importance_at(&self, point: Vec3<f32>, normal: Vec3<f32>) -> f32 {
        self.estimate::<false>(point, normal)
    }

    /// [`Node::importance_at`], also without branches on the node.
    #[inline(always)]
    pub(super) fn importance_without_branches(&self, point: Vec3<f32>, normal: Vec3<f32>) -> f32 {
        self.estimate::<true>(point, normal)
    }

    #[inline(always)]
    fn estimate<const WITHOUT_BRANCHES: bool>(&self, point: Vec3<f32>, normal: Vec3<f32>) -> f32 {
        // Cosines and sines are kept as multiples of the distance: roots and divisions are what takes time.
        let d = self.centre - point;
        let (distance_squared, radius_squared) = (d.length_squared(), self.radius * self.radius);
        let inverse_square = 1.0 / distance_squared;
        let with_sine = |cos: f32| [cos, root(distance_squared - cos * cos)];
        let sphere = [root(distance_squared - radius_squared), self.radius];
        let has_normal = (normal.x != 0.0) | (normal.y != 0.0) | (normal.z != 0.0);
        let [cos, sin] = minus(with_sine(normal.dot(d)), sphere);
        let nearest = (sin < 0.0) | !has_normal;
        let cos_i = if nearest { 1.0 } else { cos * inverse_square };
        let mut lit = cos_i > -SLACK;
        let mut factor = cos_i.max(SLACK);
        // Lights all around their normals, spheres and points, send everywhere alike.
        let directed = self.cos_o > -1.0;
        if WITHOUT_BRANCHES | directed {
            let along = -self.axis.dot(d);
            let along = if self.two_sided { along.abs() } else { along };
            let outside = minus(with_sine(along), [self.cos_o, self.sin_o]);
            let [cos, sin] = minus(outside, sphere);
            let nearest = (outside[1] < 0.0) | (sin < 0.0);
            let cos = if nearest { 1.0 } else { cos * inverse_square };
            lit &= !directed | (cos > self.cos_e - SLACK);
            factor *= if directed { cos.max(SLACK) } else { 1.0 };
        }
        let inside = distance_squared <= radius_squared;
        let (intensity, inverse_square) = if inside {
            (self.intensity, self.inverse_square)
        } else {
            (self.intensity * factor, inverse_square)
        };
        let importance = (intensity * inverse_square).min(MOST);
        if inside | lit { importance } else { 0.0 }
    }
}

/// Share of the first of two importances, off 0 and 1 unless one is 0 alone; a half where both are: nothing arrives
/// then, but the probabilities still add up to 1.
#[inline(always)]
pub(super) fn share([a, b]: [f32; 2]) -> f32 {
    let between = (a / (a + b)).clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
    let without_b = if a > 0.0 { 1.0 } else { 0.5 };
    let without_a = if b > 0.0 { 0.0 } else { 0.5 };
    let one = if a > 0.0 { without_b } else { without_a };
    if (a > 0.0) & (b > 0.0) { between } else { one }
}

/// Cosine and sine of `a - b`, of angles in `[0, pi]`, times the factors of both: the sine is negative where `a < b`.
#[inline(always)]
fn minus([cos_a, sin_a]: [f32; 2], [cos_b, sin_b]: [f32; 2]) -> [f32; 2] {
    [cos_a * cos_b + sin_a * sin_b, sin_a * cos_b - cos_a * sin_b]
}

/// The square root; 0 of what rounding made negative.
#[inline(always)]
fn root(x: f32) -> f32 {
    x.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use specula_bsdf::math::vec3;

    #[test]
    fn small_far_lights_have_the_importance_of_their_irradiance() {
        let cone = EmissionCone::flat(-Vec3::Z, false);
        let node = Node::new(vec3(3.0, 0.0, 4.0), 1e-4, &cone, 2.0, (true, 0));
        let at = |normal| Receiver {
            point: Vec3::ZERO,
            normal,
        };
        let expected = 2.0 / 25.0 * 0.8;
        assert!((node.importance(&at(None)) / expected - 1.0).abs() < 2e-3);
        let up = node.importance(&at(Some(Vec3::Z)));
        assert!((up / (expected * 0.8) - 1.0).abs() < 3e-3);
        assert_eq!(node.importance(&at(Some(-Vec3::Z))), 0.0);
        let behind = Receiver {
            point: vec3(3.0, 0.0, 5.0),
            normal: None,
        };
        assert_eq!(node.importance(&behind), 0.0);
        let two_sided = EmissionCone::flat(-Vec3::Z, true);
        let node = Node::new(vec3(3.0, 0.0, 4.0), 1e-4, &two_sided, 2.0, (true, 0));
        assert!((node.importance(&behind) - 2.0).abs() < 1e-2);
    }
}
