//! Animations: where nodes stand at a time.
//!
//! Source: glTF 2.0, section 3.11 and appendix C.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::animation::{Interpolation, Property};
use gltf::scene::Transform;

use super::Reader;
use crate::error::{ErrorKind, SceneError};

/// The channels of a file, by node and part of its transform.
#[derive(Default)]
pub(super) struct Animations {
    channels: HashMap<(usize, Part), Channel>,
}

/// A part of a node's transform.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Part {
    Translation,
    Rotation,
    Scale,
    /// The weight of a morph target.
    Weight(usize),
}

/// Values over time.
struct Channel {
    /// Seconds, ascending; not empty.
    times: Vec<f32>,
    /// One for each time; of cubic splines three: tangent before, value, tangent behind.
    values: Vec<[f32; 4]>,
    interpolation: Interpolation,
    is_rotation: bool,
}

impl Channel {
    /// The value at a time; outside of the times that of the nearest.
    fn at(&self, time: f64) -> DVec4 {
        let behind = self.times.partition_point(|t| f64::from(*t) <= time);
        let last = self.times.len() - 1;
        let k = behind.saturating_sub(1);
        let [t0, t1] = [k, (k + 1).min(last)].map(|k| f64::from(self.times[k]));
        if behind == 0 || k == last || self.interpolation == Interpolation::Step {
            return self.value(k);
        }
        let s = (time - t0) / (t1 - t0);
        match self.interpolation {
            Interpolation::CubicSpline => {
                let spans = [self.tangent(k, 2), self.tangent(k + 1, 0)].map(|v| v * (t1 - t0));
                let (s2, s3) = (s * s, s * s * s);
                let value = self.value(k) * (2.0 * s3 - 3.0 * s2 + 1.0)
                    + spans[0] * (s3 - 2.0 * s2 + s)
                    + self.value(k + 1) * (3.0 * s2 - 2.0 * s3)
                    + spans[1] * (s3 - s2);
                match self.is_rotation {
                    true => value.try_normalize().unwrap_or(DVec4::W),
                    false => value,
                }
            }
            _ if self.is_rotation => slerp(self.value(k), self.value(k + 1), s),
            _ => self.value(k).lerp(self.value(k + 1), s),
        }
    }

    /// The value at a keyframe; rotations have length 1.
    fn value(&self, k: usize) -> DVec4 {
        let value = match self.interpolation {
            Interpolation::CubicSpline => self.tangent(k, 1),
            _ => DVec4::from_array(self.values[k].map(f64::from)),
        };
        match self.is_rotation {
            true => value.try_normalize().unwrap_or(DVec4::W),
            false => value,
        }
    }

    fn tangent(&self, k: usize, which: usize) -> DVec4 {
        DVec4::from_array(self.values[3 * k + which].map(f64::from))
    }
}

/// Between rotations, the shorter way.
fn slerp(from: DVec4, to: DVec4, s: f64) -> DVec4 {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    let angle = 2.0 * (to - from).length().atan2((to + from).length());
    if angle < 1e-6 {
        return from.lerp(to, s).normalize();
    }
    (from * ((1.0 - s) * angle).sin() + to * (s * angle).sin()) / angle.sin()
}

impl Animations {
    /// The transform of a node at a time.
    ///
    /// * `own`: where it stands without animations.
    pub(super) fn transform(&self, node: usize, own: &Transform, time: f64) -> DMat4 {
        let Transform::Decomposed {
            translation,
            rotation,
            scale,
        } = own
        else {
            return matrix(own);
        };
        let at = |part| self.channels.get(&(node, part)).map(|c| c.at(time));
        let three = |part, own: &[f32; 3]| {
            let own = DVec3::from_array(own.map(f64::from));
            at(part).map_or(own, DVec4::truncate)
        };
        let rotation = DVec4::from_array(rotation.map(f64::from));
        let rotation = at(Part::Rotation).unwrap_or(rotation);
        DMat4::from_scale_rotation_translation(
            three(Part::Scale, scale),
            DQuat::from_vec4(rotation).normalize(),
            three(Part::Translation, translation),
        )
    }

    /// The weight of a morph target of a node at a time; `None` where nothing animates it.
    pub(super) fn weight(&self, node: usize, target: usize, time: f64) -> Option<f64> {
        let channel = self.channels.get(&(node, Part::Weight(target)))?;
        Some(channel.at(time).x)
    }
}

/// The matrix of a transform.
pub(super) fn matrix(transform: &Transform) -> DMat4 {
    let columns = transform.clone().matrix();
    DMat4::from_cols_array_2d(&columns.map(|c| c.map(f64::from)))
}

/// How many morph targets a mesh has.
pub(super) fn targets(mesh: &gltf::Mesh<'_>) -> usize {
    let of_primitives = mesh.primitives().map(|p| p.morph_targets().count());
    of_primitives.max().unwrap_or(0)
}

/// The path of a channel's sampler.
fn sampler_name(channel: &gltf::animation::Channel<'_>) -> String {
    let (animation, sampler) = (channel.animation().index(), channel.sampler().index());
    format!("animations[{animation}].samplers[{sampler}]")
}

impl<'a> Reader<'a> {
    /// The animation that was asked for, else all, else the first where several animate the same.
    fn played(&mut self) -> Result<Vec<gltf::Animation<'a>>, SceneError> {
        let document = self.document;
        let mut all: Vec<gltf::Animation<'a>> = document.animations().collect();
        let named = |a: &gltf::Animation<'_>| match a.name() {
            Some(name) => format!("\"{name}\""),
            None => a.index().to_string(),
        };
        let names = || all.iter().map(named).collect::<Vec<_>>().join(", ");
        if let Some(wanted) = self.animation {
            let is_it = |a: &&gltf::Animation<'_>| a.name() == Some(wanted);
            let number = wanted.parse::<usize>().ok();
            let found = all.iter().find(is_it).cloned();
            let found = found.or_else(|| all.get(number?).cloned());
            return found.map(|a| vec![a]).ok_or_else(|| {
                let message = match all.is_empty() {
                    true => format!("animation \"{wanted}\" is asked for: the file has none"),
                    false => format!(
                        "animation \"{wanted}\" is asked for: expected one of {}",
                        names()
                    ),
                };
                self.error(ErrorKind::Parameter, message)
            });
        }
        let mut animated = HashMap::new();
        let is_twice = all.iter().any(|a| {
            let parts = a.channels().map(|c| {
                let target = c.target();
                (target.node().index(), target.property() as u8)
            });
            let parts: Vec<_> = parts.collect();
            let mut owners = parts.into_iter();
            owners.any(|part| *animated.entry(part).or_insert(a.index()) != a.index())
        });
        if is_twice {
            let names = names();
            all.truncate(1);
            self.warn(format!(
                "several animations move the same ({names}): the first is played; `--animation NAME` plays another"
            ));
        }
        Ok(all)
    }
}

impl Reader<'_> {
    /// Reads the animations of the file that play.
    ///
    /// # Errors
    ///
    /// Where the keyframes of one are damaged, or the one that was asked for is not there.
    pub(super) fn animations(&mut self) -> Result<Animations, SceneError> {
        let mut all = Animations::default();
        for animation in self.played()? {
            for (j, channel) in animation.channels().enumerate() {
                let what = format!("animations[{}].channels[{j}]", animation.index());
                let node = channel.target().node();
                let part = match channel.target().property() {
                    Property::Translation => Part::Translation,
                    Property::Rotation => Part::Rotation,
                    Property::Scale => Part::Scale,
                    Property::MorphTargetWeights => {
                        self.weight_channels(&what, &channel, &mut all)?;
                        continue;
                    }
                };
                if matches!(node.transform(), Transform::Matrix { .. }) {
                    let index = node.index();
                    self.warn(format!(
                        "{what}: nodes[{index}] has a matrix, which cannot be animated: it stands still"
                    ));
                    continue;
                }
                let read = self.channel(&channel, part == Part::Rotation).map(Some);
                let Some(read) = self.problems.or(read, || None)? else {
                    continue;
                };
                self.add_channel(&what, &mut all, (node.index(), part), read);
            }
        }
        Ok(all)
    }

    /// Adds a channel, where no other one animates the same.
    fn add_channel(
        &mut self,
        what: &str,
        all: &mut Animations,
        of: (usize, Part),
        channel: Channel,
    ) {
        match all.channels.entry(of) {
            Entry::Vacant(entry) => {
                entry.insert(channel);
            }
            Entry::Occupied(_) => self.warn(format!(
                "{what}: another channel animates this part of nodes[{}]: it is left out",
                of.0
            )),
        }
    }

    /// A channel for the weight of each morph target.
    fn weight_channels(
        &mut self,
        what: &str,
        channel: &gltf::animation::Channel<'_>,
        all: &mut Animations,
    ) -> Result<(), SceneError> {
        let node = channel.target().node();
        let targets = node.mesh().map_or(0, |mesh| targets(&mesh));
        if targets == 0 {
            let index = node.index();
            self.warn(format!("{what}: nodes[{index}] has no morph targets"));
            return Ok(());
        }
        let output = format!("{}.output", sampler_name(channel));
        let values = self.floats::<1>(&output, &channel.sampler().output());
        let Some(values) = self.problems.or(values.map(Some), || None)? else {
            return Ok(());
        };
        for target in 0..targets {
            // By keyframe, and of splines by tangents and value, those of all targets.
            let own = values.iter().skip(target).step_by(targets);
            let own = own.map(|[w]| [*w, 0.0, 0.0, 0.0]).collect();
            let read = self.keyframes(channel, own, false).map(Some);
            let Some(read) = self.problems.or(read, || None)? else {
                return Ok(());
            };
            self.add_channel(what, all, (node.index(), Part::Weight(target)), read);
        }
        Ok(())
    }

    fn channel(
        &self,
        channel: &gltf::animation::Channel<'_>,
        is_rotation: bool,
    ) -> Result<Channel, SceneError> {
        let sampler = channel.sampler();
        let output = format!("{}.output", sampler_name(channel));
        let values: Vec<[f32; 4]> = if is_rotation {
            self.floats::<4>(&output, &sampler.output())?
        } else {
            let values = self.floats::<3>(&output, &sampler.output())?;
            values.into_iter().map(|[x, y, z]| [x, y, z, 0.0]).collect()
        };
        self.keyframes(channel, values, is_rotation)
    }

    /// A channel of these values at the times of its sampler.
    fn keyframes(
        &self,
        channel: &gltf::animation::Channel<'_>,
        values: Vec<[f32; 4]>,
        is_rotation: bool,
    ) -> Result<Channel, SceneError> {
        let sampler = channel.sampler();
        let what = sampler_name(channel);
        let times: Vec<f32> = self
            .floats::<1>(&format!("{what}.input"), &sampler.input())?
            .into_iter()
            .map(|[t]| t)
            .collect();
        let interpolation = sampler.interpolation();
        let per_time = match interpolation {
            Interpolation::CubicSpline => 3,
            Interpolation::Linear | Interpolation::Step => 1,
        };
        let fault = if times.is_empty() {
            Some("expected at least one keyframe".to_owned())
        } else if !times.iter().all(|t| t.is_finite()) || !times.is_sorted_by(|a, b| a < b) {
            Some("expected finite times that ascend".to_owned())
        } else if values.len() != per_time * times.len() {
            let (found, expected) = (values.len(), per_time * times.len());
            Some(format!(
                "expected {expected} values for {} times, found {found}",
                times.len()
            ))
        } else if !values.iter().flatten().all(|x| x.is_finite()) {
            Some("expected finite values".to_owned())
        } else {
            None
        };
        match fault {
            Some(fault) => Err(self.error(ErrorKind::Parameter, format!("{what}: {fault}"))),
            None => Ok(Channel {
                times,
                values,
                interpolation,
                is_rotation,
            }),
        }
    }

    /// What of a file is animated, in a person's words; `None`: nothing.
    pub(super) fn animated(&self) -> Option<String> {
        let mut nodes: Vec<usize> = Vec::new();
        let mut end = 0.0_f64;
        for channel in self
            .document
            .animations()
            .flat_map(|a| a.channels().collect::<Vec<_>>())
        {
            nodes.push(channel.target().node().index());
            let times = self
                .floats::<1>("", &channel.sampler().input())
                .unwrap_or_default();
            end = times.iter().fold(end, |end, [t]| end.max(f64::from(*t)));
        }
        nodes.sort_unstable();
        nodes.dedup();
        match nodes.len() {
            0 => None,
            1 => Some(format!("1 node moves within {end:.3} s")),
            n => Some(format!("{n} nodes move within {end:.3} s")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channel(interpolation: Interpolation, is_rotation: bool, values: &[[f32; 4]]) -> Channel {
        Channel {
            times: vec![1.0, 2.0, 4.0],
            values: values.to_vec(),
            interpolation,
            is_rotation,
        }
    }

    #[test]
    fn values_between_keyframes() {
        let values = [[0.0; 4], [2.0, 1.0, 0.0, 0.0], [4.0, 0.0, 0.0, 0.0]];
        let linear = channel(Interpolation::Linear, false, &values);
        let step = channel(Interpolation::Step, false, &values);
        for (time, a, b) in [
            (0.0, [0.0, 0.0], [0.0, 0.0]),
            (1.0, [0.0, 0.0], [0.0, 0.0]),
            (1.5, [1.0, 0.5], [0.0, 0.0]),
            (2.0, [2.0, 1.0], [2.0, 1.0]),
            (3.5, [3.5, 0.25], [2.0, 1.0]),
            (4.0, [4.0, 0.0], [4.0, 0.0]),
            (9.0, [4.0, 0.0], [4.0, 0.0]),
        ] {
            for (channel, expected) in [(&linear, a), (&step, b)] {
                let found = channel.at(time);
                assert_eq!([found.x, found.y], expected, "{time}");
            }
        }
    }

    #[test]
    fn cubic_splines_pass_their_values_with_their_tangents() {
        // x = t^3 on [1, 2] and [2, 4]: values t^3, tangents 3 t^2.
        let key = |t: f32| {
            let tangent = [3.0 * t * t, 0.0, 0.0, 0.0];
            [tangent, [t * t * t, 0.0, 0.0, 0.0], tangent]
        };
        let values: Vec<[f32; 4]> = [1.0, 2.0, 4.0].into_iter().flat_map(key).collect();
        let cubic = channel(Interpolation::CubicSpline, false, &values);
        for time in [1.0, 1.25, 1.9, 2.0, 2.5, 3.9, 4.0] {
            let found = cubic.at(time).x;
            assert!((found - time.powi(3)).abs() < 1e-9, "{time}: {found}");
        }
        assert_eq!((cubic.at(0.0).x, cubic.at(5.0).x), (1.0, 64.0));
    }

    #[test]
    fn rotations_run_at_constant_speed_the_shorter_way() {
        let turn = |angle: f64| DQuat::from_rotation_y(angle).as_quat().to_array();
        let negative = turn(1.0).map(|x| -x);
        let linear = channel(
            Interpolation::Linear,
            true,
            &[turn(0.0), negative, turn(1.0)],
        );
        for (time, angle) in [(1.25, 0.25), (1.5, 0.5), (1.9, 0.9), (3.0, 1.0)] {
            let found = DQuat::from_vec4(linear.at(time));
            let expected = DQuat::from_rotation_y(angle);
            assert!(found.dot(expected).abs() > 1.0 - 1e-12, "{time}: {found}");
        }
        // Cubic ones are unit, too.
        let zero = [0.0; 4];
        let values = [
            zero,
            turn(0.0),
            zero,
            zero,
            turn(2.0),
            zero,
            zero,
            turn(0.0),
            zero,
        ];
        let cubic = channel(Interpolation::CubicSpline, true, &values);
        for time in [1.1, 1.5, 3.3] {
            assert!((cubic.at(time).length() - 1.0).abs() < 1e-12);
        }
        let half = DQuat::from_vec4(cubic.at(1.5));
        assert!(half.dot(DQuat::from_rotation_y(1.0)) > 1.0 - 1e-12);
    }
}
