//! Transforms of what moves, and of what does not.

use glam::DMat4;

use super::{Writer, transform};
use crate::scene::{Motion, Scene, Trajectory};

/// The times of all motions, in exposures, where they have the same; else those of the shutter.
pub(super) fn times(scene: &Scene) -> [f64; 2] {
    let mut motions = scene.motions().map(|(_, motion)| motion.times);
    match motions.next() {
        Some(times) if motions.all(|other| other == times) => times,
        _ => SHUTTER,
    }
}

/// When the shutter opens and closes: pbrt-v4's defaults.
pub(super) const SHUTTER: [f64; 2] = [0.0, 1.0];

impl Writer<'_> {
    /// The directives that set the current transform.
    pub(super) fn place(&mut self, start: &DMat4, motion: Option<&Motion>) -> String {
        match motion {
            None => transform(start),
            Some(motion) => at_both(self.ends(start, motion)),
        }
    }

    /// The same of a camera, whose transform leads to camera space.
    pub(super) fn camera_place(&mut self, start: &DMat4, motion: Option<&Motion>) -> String {
        match motion {
            None => transform(&start.inverse()),
            Some(motion) => at_both(self.ends(start, motion).map(|m| m.inverse())),
        }
    }

    /// The transforms at the times that the file gives to all motions.
    ///
    /// A part of a motion that does not stand still within is itself such a motion, from and to its own ends.
    fn ends(&mut self, start: &DMat4, motion: &Motion) -> [DMat4; 2] {
        let [from, to] = self.times;
        if motion.times == self.times {
            return [*start, motion.end];
        }
        if motion.times[0] > from || motion.times[1] < to {
            self.note("motions of other times are written as if they took the whole exposure");
        }
        let trajectory = Trajectory::new(start, motion);
        [trajectory.at(from), trajectory.at(to)]
    }
}

fn at_both([start, end]: [DMat4; 2]) -> String {
    format!(
        "ActiveTransform StartTime\n{}\nActiveTransform EndTime\n{}\nActiveTransform All",
        transform(&start),
        transform(&end)
    )
}
