//! Triangles of a small scene in clusters: those that share corners, and those that lie in one plane.

use super::Bounds;

/// Corners of a cluster: those of a box. A power of two.
pub(super) const CORNERS: usize = 8;

/// Most triangles of a cluster: the bits of a mask.
pub(super) const TRIANGLES: usize = 64;

/// Triangles one after the other, and the corners that they share.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    /// By the axis in which directions are greatest, with coordinates in the order of its shear.
    pub(super) corners: [Vec<[f32; 3]>; 3],
    /// Bounds on the absolute values of the coordinates along each axis.
    pub(super) reach: [f32; 3],
    /// Indices of corners.
    pub(super) triangles: Vec<[u8; 3]>,
    /// Where all of them lie in one.
    pub(super) plane: Option<Plane>,
}

/// A plane across an axis, as thick as the rounding of what lies in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) axis: usize,
    /// Least and greatest coordinate.
    pub(super) range: [f32; 2],
    /// Whether the whole scene lies on one side.
    is_outer: bool,
}

impl Plane {
    /// That of a triangle, if it lies in one.
    ///
    /// * `scene`: a box around the scene.
    pub(super) fn of(corners: &[[f32; 3]; 3], scene: &Bounds) -> Option<Self> {
        const THICKNESS: f32 = 1e-6;
        let own = Bounds::around(corners);
        (0..3).find_map(|axis| {
            let thickness = THICKNESS * (scene.max[axis] - scene.min[axis]);
            let range = [own.min[axis], own.max[axis]];
            (range[1] - range[0] <= thickness).then(|| Self {
                axis,
                range,
                is_outer: range[0] <= scene.min[axis] + thickness
                    || range[1] >= scene.max[axis] - thickness,
            })
        })
    }

    /// The plane of both, if it is one.
    fn union(&self, other: &Self) -> Option<Self> {
        let [a, b] = [self.range, other.range];
        let overlap = a[0] <= b[1] && b[0] <= a[1];
        (self.axis == other.axis && overlap).then(|| Self {
            range: [a[0].min(b[0]), a[1].max(b[1])],
            ..*self
        })
    }
}

impl Cluster {
    const EMPTY: Self = Self {
        corners: [const { Vec::new() }; 3],
        reach: [0.0; 3],
        triangles: Vec::new(),
        plane: None,
    };

    /// Those of all triangles, which have their indices before them.
    ///
    /// * `plane`: that of a triangle, where its cluster is to be kept in it.
    pub(super) fn all(
        triangles: &[(u32, [[f32; 3]; 3])],
        plane: impl Fn(&[[f32; 3]; 3]) -> Option<Plane>,
    ) -> Vec<Self> {
        let mut clusters: Vec<Self> = Vec::new();
        for (_, corners) in triangles {
            let plane = plane(corners);
            if !(clusters.last_mut()).is_some_and(|c| c.take(corners, plane)) {
                clusters.push(Self::new(corners, plane));
            }
        }
        clusters
    }

    /// Of one triangle.
    fn new(corners: &[[f32; 3]; 3], plane: Option<Plane>) -> Self {
        let mut cluster = Self::EMPTY;
        cluster.add(corners);
        cluster.plane = plane;
        cluster
    }

    /// Adds a triangle, or returns `false`: where its corners are too many, or a plane would be lost that most packs
    /// of rays stay on one side of.
    fn take(&mut self, corners: &[[f32; 3]; 3], plane: Option<Plane>) -> bool {
        let both = match (self.plane, plane) {
            (Some(a), Some(b)) => a.union(&b),
            _ => None,
        };
        let outer = |plane: Option<Plane>| plane.is_some_and(|plane| plane.is_outer);
        let is_apart = !corners.iter().any(|p| self.corners[2].contains(p));
        let lost = both.is_none() && (self.plane.is_some() || plane.is_some());
        if lost && (is_apart || outer(self.plane) || outer(plane)) {
            return false;
        }
        let is_added = self.add(corners);
        if is_added {
            self.plane = both;
        }
        is_added
    }

    /// Adds a triangle; `false` where its corners are too many.
    fn add(&mut self, corners: &[[f32; 3]; 3]) -> bool {
        let mut all = self.corners[2].clone();
        let places = corners.map(|p| {
            // By their bits: what is sheared must be the same to the sign of zero.
            let bits = |p: &[f32; 3]| p.map(f32::to_bits);
            let known = all.iter().position(|q| bits(q) == bits(&p));
            known.unwrap_or_else(|| {
                all.push(p);
                all.len() - 1
            })
        });
        if all.len() > CORNERS || self.triangles.len() >= TRIANGLES {
            return false;
        }
        for p in corners {
            self.reach = [0, 1, 2].map(|axis| self.reach[axis].max(p[axis].abs()));
        }
        self.corners = [0, 1, 2].map(|axis: usize| {
            let permuted = |p: &[f32; 3]| [p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]];
            all.iter().map(permuted).collect()
        });
        self.triangles
            .push(places.map(|place| u8::try_from(place).unwrap_or(0)));
        true
    }
}
