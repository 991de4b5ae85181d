//! What moves while the shutter is open: transforms at two times.

use glam::DMat4;

use super::context::Context;
use crate::error::Place;
use crate::scene::Motion;
use crate::transform::{is_invertible, mirrors};

/// When the transforms of start and end hold: the shutter opens at 0 and closes at 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exposure {
    times: [f64; 2],
}

impl Exposure {
    /// * `times`: those of `TransformTimes`, ascending.
    /// * `shutter`: when it opens and closes, ascending.
    pub(super) fn new(times: [f64; 2], [open, close]: [f64; 2]) -> Self {
        Self {
            times: times.map(|t| (t - open) / (close - open)),
        }
    }

    /// The transform of what moves between two, and its motion; still where it does not move while the shutter is
    /// open, and where the end has no proper transform, of which a warning says so.
    ///
    /// * `what`: what moves, for the warning.
    pub(super) fn place(
        &self,
        context: &mut Context,
        (what, place): (&str, &Place),
        start: DMat4,
        end: Option<DMat4>,
    ) -> (DMat4, Option<Motion>) {
        let Some(end) = end else {
            return (start, None);
        };
        let times = self.times;
        if times[0] >= 1.0 {
            return (start, None);
        }
        if !is_invertible(&start) || !is_invertible(&end) || mirrors(&start) != mirrors(&end) {
            let message =
                format!("the {what} is pressed flat as it moves: it is rendered where it starts");
            context.warn(place, message);
            return (start, None);
        }
        if times[1] <= 0.0 {
            return (end, None);
        }
        (start, Some(Motion { end, times }))
    }
}
