//! The absorbing media that a path is in.
//!
//! pbrt and Mitsuba name what is on either side of a boundary, so that crossing it tells what the
//! path is in. glTF names the inside alone: around a body is whatever the path was in before, so the
//! media that it entered are remembered until it leaves them, in any order. Neither has priorities:
//! where media overlap, the one entered last counts.

use specula_bsdf::Rgb;

/// How many media are remembered; those entered first are forgotten.
pub const MOST_MEDIA: usize = 4;

/// What absorbs on the two sides of a surface, per scene unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Boundary {
    /// Beyond the surface, seen from its outside.
    pub(crate) inside: Rgb<f32>,
    /// Before it, where that is known; else what the path was in before it entered.
    pub(crate) around: Option<Rgb<f32>>,
}

/// What a path is in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MediumStack {
    absorption: Option<Rgb<f32>>,
    /// Materials of the media entered, with their absorption; the first `count` are meant.
    entered: [(u32, Rgb<f32>); MOST_MEDIA],
    count: usize,
}

impl MediumStack {
    /// Empty space.
    pub(crate) const NONE: Self = Self {
        absorption: None,
        entered: [(0, Rgb::BLACK); MOST_MEDIA],
        count: 0,
    };

    /// What absorbs where the path is, if anything does.
    #[inline]
    pub(crate) fn absorption(&self) -> Option<Rgb<f32>> {
        self.absorption
    }

    /// Whether it is as in empty space.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.absorption.is_none() && self.count == 0
    }

    /// Passes a boundary.
    ///
    /// * `material`: that of the boundary: all surfaces of a body share it.
    /// * `inwards`: whether from its outside to its inside.
    pub(crate) fn cross(&mut self, material: u32, boundary: &Boundary, inwards: bool) {
        let now = match (boundary.around, inwards) {
            (Some(_), true) => boundary.inside,
            (Some(around), false) => around,
            (None, true) => {
                self.enter(material, boundary.inside);
                boundary.inside
            }
            (None, false) => self.leave(material),
        };
        self.absorption = Some(now).filter(|a| !a.is_black());
    }

    fn enter(&mut self, material: u32, inside: Rgb<f32>) {
        if self.count == MOST_MEDIA {
            self.entered.rotate_left(1);
            self.count -= 1;
        }
        self.entered[self.count] = (material, inside);
        self.count += 1;
    }

    /// Forgets the body of that material that was entered last; what absorbs then.
    fn leave(&mut self, material: u32) -> Rgb<f32> {
        let entered = &mut self.entered[..self.count];
        if let Some(i) = entered.iter().rposition(|b| b.0 == material) {
            entered[i..].rotate_left(1);
            self.count -= 1;
        }
        let innermost = self.entered[..self.count].last();
        innermost.map_or(Rgb::BLACK, |b| b.1)
    }
}

/// What absorption leaves over a distance: `exp(-absorption distance)` (Beer and Lambert).
#[inline]
pub(crate) fn transmittance(absorption: Rgb<f32>, distance: f32) -> Rgb<f32> {
    absorption.map(|a| (-a * distance).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(inside: f32) -> Boundary {
        Boundary {
            inside: Rgb::splat(inside),
            around: None,
        }
    }

    fn absorption(media: &MediumStack) -> f32 {
        media.absorption().map_or(0.0, |a| a.r)
    }

    /// Crosses `(material, inwards)`, each medium absorbing as much as its index says.
    fn along(steps: &[(u32, bool)]) -> Vec<f32> {
        let mut media = MediumStack::NONE;
        let each = steps.iter().map(|&(material, inwards)| {
            media.cross(material, &body(material as f32), inwards);
            absorption(&media)
        });
        each.collect()
    }

    #[test]
    fn medium_stack_within_medium_stack_give_back_what_is_around_them() {
        let steps = [
            (3, true),
            (5, true),
            (5, true),
            (5, false),
            (5, false),
            (3, false),
        ];
        assert_eq!(along(&steps), [3.0, 5.0, 5.0, 5.0, 3.0, 0.0]);
        // A clear body in an absorbing one.
        assert_eq!(along(&[(2, true), (0, true), (0, false)]), [2.0, 0.0, 2.0]);
    }

    #[test]
    fn medium_stack_that_overlap_may_be_left_in_any_order() {
        let steps = [(3, true), (5, true), (3, false), (5, false)];
        assert_eq!(along(&steps), [3.0, 5.0, 5.0, 0.0]);
    }

    #[test]
    fn paths_that_begin_inside_leave_into_empty_space() {
        assert_eq!(along(&[(3, false), (4, true), (4, false)]), [0.0, 4.0, 0.0]);
    }

    #[test]
    fn the_outermost_is_forgotten_first() {
        let inwards = [1, 2, 3, 4, 5].map(|m| (m, true));
        let outwards = [5, 4, 3, 2, 1].map(|m| (m, false));
        let found = along(&[inwards, outwards].concat());
        assert_eq!(found[5..], [4.0, 3.0, 2.0, 0.0, 0.0]);
    }

    #[test]
    fn what_is_named_on_both_sides_holds_whatever_came_before() {
        let fog = Boundary {
            inside: Rgb::BLACK,
            around: Some(Rgb::splat(7.0)),
        };
        let mut media = MediumStack::NONE;
        media.cross(1, &fog, false);
        assert_eq!(absorption(&media), 7.0);
        media.cross(1, &fog, true);
        assert_eq!(media.absorption(), None);
    }
}
