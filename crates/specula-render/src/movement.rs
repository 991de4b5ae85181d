//! How groups of shapes move while the shutter is open.

use glam::DMat4;
use specula_scene::bounds::BoundingBox;
use specula_scene::scene::{Motion, Trajectory};

/// Transforms one within the other, some of which change with time. The outermost comes first: that of the instance,
/// then that of a shape in its object.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Movement {
    links: Vec<Link>,
}

#[derive(Clone, Debug, PartialEq)]
enum Link {
    Still(DMat4),
    Moving(Box<Trajectory>),
}

/// Memory of a movement, in the geometry and in the tree over it.
pub(crate) const BYTES: u64 =
    (2 * (size_of::<Movement>() + 2 * (size_of::<Link>() + size_of::<Trajectory>()))) as u64;

impl Movement {
    /// The same in a space that a transform leads out of.
    pub(crate) fn within(mut self, to_outer: DMat4, motion: Option<&Motion>) -> Self {
        let link = match motion {
            Some(motion) => Link::Moving(Box::new(Trajectory::new(&to_outer, motion))),
            None => Link::Still(to_outer),
        };
        self.links.insert(0, link);
        self
    }

    /// Whether any transform changes.
    pub(crate) fn moves(&self) -> bool {
        self.links
            .iter()
            .any(|link| matches!(link, Link::Moving(_)))
    }

    /// The transform to the world at a time, in exposures.
    pub(crate) fn at(&self, time: f32) -> DMat4 {
        let time = f64::from(time);
        let poses = self.links.iter().map(|link| match link {
            Link::Still(m) => *m,
            Link::Moving(trajectory) => trajectory.at(time),
        });
        poses
            .reduce(|outer, inner| outer * inner)
            .unwrap_or_default()
    }

    /// A box around everything in the world that a box sweeps over.
    pub(crate) fn swept(&self, of: BoundingBox) -> BoundingBox {
        self.links.iter().rev().fold(of, |of, link| match link {
            Link::Still(m) => of.transformed(m),
            Link::Moving(trajectory) => {
                let [min, max] = trajectory.swept([of.min, of.max]);
                BoundingBox { min, max }
            }
        })
    }
}
