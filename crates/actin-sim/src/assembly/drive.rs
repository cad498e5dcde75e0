//! What a scene moves from outside: held ends and load factors, along its path.

use super::Clamped;
use crate::scene::{End, Scene, Setting, Slides};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};

/// A control and its values at the ends of the stages, the first of them before the path.
#[derive(Clone, Debug, PartialEq)]
struct Track<K> {
    what: K,
    values: Vec<Vector3>,
}

impl<K> Track<K> {
    /// The value at path parameter `u`: linear within a stage.
    fn at(&self, u: f64) -> Vector3 {
        let last = self.values.len() - 1;
        let u = u.clamp(0.0, last as f64);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the number of stages"
        )]
        let stage = (u.floor() as usize).min(last.saturating_sub(1));
        let (from, to) = (self.values[stage], self.values[(stage + 1).min(last)]);
        from + (to - from) * (u - stage as f64)
    }
}

/// Everything that the path of a scene moves.
///
/// The path parameter counts stages: `u = 1.5` is halfway through the second.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drive {
    stages: usize,
    loads: Vec<Track<usize>>,
    shifts: Vec<Track<usize>>,
    turns: Vec<Track<usize>>,
    ends: Vec<HeldEnd>,
}

/// A clamped end with its bodies as built.
#[derive(Clone, Debug, PartialEq)]
struct HeldEnd {
    points: Vec<(usize, Vector3)>,
    frames: Vec<(usize, UnitQuaternion)>,
    about: Vector3,
    slides: Slides,
}

impl Drive {
    /// The drive of a scene whose clamps hold these bodies of `rest`.
    pub(super) fn new(scene: &Scene, clamps: &[Clamped], rest: &State) -> Self {
        let stages = scene.path.len();
        let clamp_of = |end: End| clamps.iter().position(|clamp| clamp.end == end);
        let track = |find: &dyn Fn(&Setting) -> Option<Vector3>, start: Vector3| {
            let mut values = vec![start];
            for stage in &scene.path {
                let set = stage.set.iter().rev().find_map(find);
                values.push(set.unwrap_or(values[values.len() - 1]));
            }
            let is_set = scene
                .path
                .iter()
                .any(|s| s.set.iter().any(|s| find(s).is_some()));
            is_set.then_some(values)
        };
        let of_load = |load: usize| {
            let find = move |setting: &Setting| match *setting {
                Setting::LoadFactor { load: l, factor } if l == load => {
                    Some(Vector3::from_element(factor))
                }
                _ => None,
            };
            track(&find, Vector3::zeros()).map(|values| Track { what: load, values })
        };
        let of_clamp = |clamp: usize, turn: bool| {
            let find = move |setting: &Setting| match *setting {
                Setting::Shift { end, shift_nm } if !turn && clamp_of(end) == Some(clamp) => {
                    Some(shift_nm.into())
                }
                Setting::Turn { end, turn_deg } if turn && clamp_of(end) == Some(clamp) => {
                    Some(turn_deg.map(f64::to_radians).into())
                }
                _ => None,
            };
            let values = track(&find, Vector3::zeros());
            values.map(|values| Track {
                what: clamp,
                values,
            })
        };
        Self {
            stages,
            loads: (0..scene.loads.len()).filter_map(of_load).collect(),
            shifts: (0..clamps.len())
                .filter_map(|c| of_clamp(c, false))
                .collect(),
            turns: (0..clamps.len())
                .filter_map(|c| of_clamp(c, true))
                .collect(),
            ends: clamps.iter().map(|c| HeldEnd::new(c, rest)).collect(),
        }
    }

    /// Number of stages.
    pub fn stages(&self) -> usize {
        self.stages
    }

    /// Whether the path moves nothing.
    pub fn is_still(&self) -> bool {
        self.stages == 0
    }

    /// Puts controls and held bodies where they belong at path parameter `u`. Of an end that
    /// slides, the component along which it slides stays as it is in `state`.
    pub fn place(&self, state: &mut State, u: f64) {
        for track in &self.loads {
            state.controls[track.what] = track.at(u).x;
        }
        let value = |tracks: &[Track<usize>], clamp| {
            let track = tracks.iter().find(|track| track.what == clamp);
            track.map_or(Vector3::zeros(), |track| track.at(u))
        };
        for (clamp, end) in self.ends.iter().enumerate() {
            end.place(state, value(&self.shifts, clamp), value(&self.turns, clamp));
        }
    }
}

impl HeldEnd {
    fn new(clamp: &Clamped, rest: &State) -> Self {
        let point = |&i: &usize| (i, rest.points.position.get(i));
        let frame = |&i: &usize| (i, rest.frames.orientation.get(i));
        Self {
            points: clamp.points.iter().map(point).collect(),
            frames: clamp.frames.iter().map(frame).collect(),
            about: clamp.about_nm,
            slides: clamp.slides,
        }
    }

    fn place(&self, state: &mut State, shift: Vector3, turn: Vector3) {
        let turn = rotation::exp(turn);
        let turned = |rest: Vector3| self.about + turn * (rest - self.about);
        let (reference, rest) = self.points[0];
        let present = state.points.position.get(reference) - turned(rest);
        let shift = match self.slides {
            Slides::Nowhere => shift,
            Slides::AlongAxis => Vector3::new(shift.x, shift.y, present.z),
            Slides::Freely => present,
        };
        for &(i, rest) in &self.points {
            state.points.position.set(i, turned(rest) + shift);
        }
        for &(i, rest) in &self.frames {
            state.frames.orientation.set(i, turn * rest);
        }
    }
}
