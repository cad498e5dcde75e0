//! Couples on frames: axial couples, which have a potential, and follower couples, which have none.

use std::f64::consts::TAU;

use crate::{
    ControlId, Coordinates, Interaction, Loads, Matrix3, SecondOrder, State, Stiffness,
    UnitQuaternion, Vector3,
};

/// Dependence of a couple on the rotation of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoupleKind {
    /// Conservative couple about the axis `e` of the lab frame.
    ///
    /// The rotation `R` of the frame since the couple was created is split into a twist by `psi`
    /// about `e` and a swing of `e` to `R e` by the angle `beta`.
    ///
    /// ```text
    /// E = -M psi                                (pN nm)
    /// torque = M (e + R e) / (1 + e . R e)      (lab frame)
    /// ```
    ///
    /// The component of the torque along `e` is always `M`; its magnitude is `M / cos(beta / 2)`. A
    /// couple of constant direction in the lab frame is not conservative, because rotations about
    /// different axes do not commute.
    Axial,
    /// Couple of constant direction in the frame, without a potential.
    Follower,
}

/// A couple distributed over frames and scaled by a control: one element per frame.
///
/// # Source
/// H. Ziegler, Principles of Structural Stability, 2nd ed. (1977), chapter 5, on conservative
/// couples. The angle `psi` is the sum of the first and third Euler angle about `e`.
#[derive(Clone, Debug, PartialEq)]
pub struct Couple {
    /// Index, share and orientation at `psi = 0` of each frame.
    shares: Vec<(usize, f64, UnitQuaternion)>,
    /// Frames along which turns are counted: index, orientation at `psi = 0`, and element if the
    /// couple acts on the frame.
    chain: Vec<(usize, UnitQuaternion, Option<usize>)>,
    moment: Vector3,
    kind: CoupleKind,
    control: ControlId,
    /// Control that stores `psi` of the first frame of the chain (rad).
    turned: ControlId,
}

impl Couple {
    /// Creates the couple `moment` (lab frame, at control value 1) on frames with the given shares.
    ///
    /// The present orientations define `psi = 0`. The load factor is `control`; a new control
    /// counts turns.
    ///
    /// ```
    /// use actin_mechanics::{
    ///     Couple, CoupleKind, Frame, Inertia, Interaction, Loads, State, UnitQuaternion, Vector3,
    /// };
    /// let mut state = State::default();
    /// let inertia = Inertia::from_moments([1.0, 1.0, 2.0])?;
    /// let frame = Frame { orientation: UnitQuaternion::identity(), inertia };
    /// let i = state.frames.push(frame);
    /// let factor = state.add_control(1.0);
    /// let couple = Couple::new(&mut state, &[(i, 1.0)], Vector3::z() * 3.0, CoupleKind::Axial, factor);
    /// // Half a radian about the axis: the work is 3 times 0.5.
    /// state.frames.orientation.set(i, UnitQuaternion::new(Vector3::z() * 0.5));
    /// assert!((couple.energy(&state) + 1.5).abs() < 1e-15);
    /// # Ok::<(), actin_mechanics::InertiaError>(())
    /// ```
    ///
    /// # Panics
    /// If `state` lacks a frame or the control, or if the couple or a share is not finite.
    pub fn new(
        state: &mut State,
        shares: &[(usize, f64)],
        moment: Vector3,
        kind: CoupleKind,
        control: ControlId,
    ) -> Self {
        let frames = state.frames.len();
        assert!(
            state.controls.has(control),
            "a couple has {control:?}, which the state does not have"
        );
        assert!(
            moment.iter().all(|m| m.is_finite()),
            "a couple must be finite, got {moment:?}"
        );
        let with_rest = |&(i, share): &(usize, f64)| {
            assert!(
                i < frames,
                "a couple acts on frame {i}, but there are only {frames} frames"
            );
            assert!(
                share.is_finite(),
                "shares of a couple must be finite, got {share}"
            );
            (i, share, state.frames.orientation.get(i))
        };
        let shares: Vec<_> = shares.iter().map(with_rest).collect();
        let own = |(element, &(i, _, rest)): (usize, &(usize, f64, UnitQuaternion))| {
            (i, rest, Some(element))
        };
        Self {
            chain: shares.iter().enumerate().map(own).collect(),
            shares,
            moment,
            kind,
            control,
            turned: state.add_control(0.0),
        }
    }

    /// Counts turns along a chain of frames, so that the potential is continuous over full turns.
    ///
    /// An orientation defines `psi` modulo two turns; the value nearest to the preceding frame's is
    /// used. The first frame should be next to a held frame. The present orientations define
    /// `psi = 0`.
    ///
    /// # Panics
    /// If a frame of the couple is missing in the chain.
    #[must_use]
    pub fn counted_along(mut self, state: &State, chain: &[usize]) -> Self {
        let element = |i: usize| self.shares.iter().position(|share| share.0 == i);
        let link = |&i: &usize| (i, state.frames.orientation.get(i), element(i));
        let chain: Vec<_> = chain.iter().map(link).collect();
        let reached = chain.iter().filter(|link| link.2.is_some()).count();
        assert!(
            reached == self.shares.len(),
            "{reached} of {} frames of a couple are on the chain along which turns are counted",
            self.shares.len()
        );
        let last = chain.iter().rposition(|link| link.2.is_some());
        let counted = last.map_or(0, |last| last + 1);
        self.chain = chain.into_iter().take(counted).collect();
        self
    }

    fn axis(&self) -> Option<(f64, Vector3)> {
        let size = self.moment.norm();
        (size > 0.0).then(|| (size, self.moment / size))
    }
}

/// Twist `psi` of a frame about `axis`, modulo two turns nearest to `near`.
fn twist(axis: Vector3, [now, rest]: [UnitQuaternion; 2], near: f64) -> f64 {
    let turn = now * rest.inverse();
    let known = 2.0 * turn.imag().dot(&axis).atan2(turn.w);
    known + 2.0 * TAU * ((near - known) / (2.0 * TAU)).round()
}

/// Components of a lab axis in the present and in the initial body frame.
fn seen(axis: Vector3, now: UnitQuaternion, rest: UnitQuaternion) -> (Vector3, Vector3) {
    let seen = |q: UnitQuaternion| q.inverse_transform_vector(&axis);
    (seen(now), seen(rest))
}

impl Interaction for Couple {
    fn term(&self) -> &'static str {
        "load"
    }

    fn is_conservative(&self) -> bool {
        self.kind == CoupleKind::Axial
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let Some((size, axis)) = self.axis() else {
            return;
        };
        let factor = state.controls[self.control] * size;
        for &(i, share, rest) in &self.shares {
            let (a, b) = seen(axis, state.frames.orientation.get(i), rest);
            let torque = match self.kind {
                CoupleKind::Axial => (a + b) / (1.0 + a.dot(&b)),
                CoupleKind::Follower => b,
            };
            loads.torque.add(i, torque * (factor * share));
        }
    }

    fn elements(&self) -> usize {
        self.shares.len()
    }

    /// Energy `-M psi` with counted turns, or zero for a follower couple.
    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        energies.fill(0.0);
        let Some((size, axis)) = self.axis().filter(|_| self.is_conservative()) else {
            return;
        };
        let factor = state.controls[self.control] * size;
        let mut psi = state.controls[self.turned];
        for &(i, rest, element) in &self.chain {
            psi = twist(axis, [state.frames.orientation.get(i), rest], psi);
            if let Some(element) = element {
                energies[element] = -factor * self.shares[element].1 * psi;
            }
        }
    }

    fn count_turns(&self, state: &mut State) {
        if let (Some((_, axis)), Some(&(i, rest, _))) = (self.axis(), self.chain.first()) {
            let now = state.frames.orientation.get(i);
            let counted = &mut state.controls[self.turned];
            *counted = twist(axis, [now, rest], *counted);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        self.is_conservative().then_some(self as &dyn SecondOrder)
    }
}

impl SecondOrder for Couple {
    /// Symmetric part of the derivative of the torque `M (a + b) / (1 + a . b)`, with
    /// `d a / d phi = [a]x`.
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let (size, axis) = self.axis().unwrap_or_default();
        let factor = state.controls[self.control] * size;
        for &(i, share, rest) in &self.shares {
            let (a, b) = seen(axis, state.frames.orientation.get(i), rest);
            let (cross, scale) = (a.cross_matrix(), 1.0 / (1.0 + a.dot(&b)));
            let slope: Matrix3 = cross * scale - (a + b) * (b.transpose() * cross) * scale.powi(2);
            let block = (slope + slope.transpose()) * (-0.5 * factor * share);
            let frame = Coordinates::Frame(i);
            stiffness.push(frame, frame, block);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::push_frame;
    use crate::testing::{assert_is_gradient, assert_is_stiffness, loads_of};
    use crate::{Frame, Inertia, Xorshift, rotation};

    /// Two frames under a couple of 3.7 with shares of 1/4 and 3/4, rotated by `turn`.
    fn turned(kind: CoupleKind, turn: Vector3) -> (State, Couple) {
        let mut state = State::default();
        let control = state.add_control(0.8);
        let mut noise = Xorshift::new(5);
        for _ in 0..2 {
            push_frame(&mut state, rotation::exp(noise.vector()), [1.0, 1.0, 2.0]);
        }
        let moment = Vector3::new(1.2, -3.0, 1.8);
        let couple = Couple::new(&mut state, &[(0, 0.25), (1, 0.75)], moment, kind, control);
        for i in 0..2 {
            let q = rotation::exp(turn) * state.frames.orientation.get(i);
            state.frames.orientation.set(i, q);
        }
        (state, couple)
    }

    #[test]
    fn axial_couples_have_a_potential() {
        for turn in [[0.01, -0.02, 0.03], [0.3, -0.2, 0.9], [-1.4, 0.8, 1.5]] {
            let (state, couple) = turned(CoupleKind::Axial, turn.into());
            // Eighth-order differences of angles over 1 rad; round-off 1e-16 / 1e-2.
            assert_is_gradient(&couple, &state, 1e-2, 1e-10);
            assert_is_stiffness(&couple, &state, 1e-2, 1e-9);
        }
    }

    #[test]
    fn axial_couples_keep_their_component() {
        let axis = Vector3::new(1.2, -3.0, 1.8).normalize();
        let size = 0.8 * Vector3::new(1.2f64, -3.0, 1.8).norm();
        for turn in [axis * 6.2, Vector3::new(0.9, 0.9, -1.1)] {
            let (state, couple) = turned(CoupleKind::Axial, turn);
            let loads = loads_of(&couple, &state);
            let lab = |i| state.frames.orientation.get(i) * loads.torque.get(i);
            let total = lab(0) + lab(1);
            assert!((total.dot(&axis) - size).abs() < 1e-13 * size);
        }
        let (state, couple) = turned(CoupleKind::Axial, axis * 6.2);
        assert!((couple.energy(&state) + 6.2 * size).abs() < 1e-12 * size);
    }

    #[test]
    fn turns_are_counted_along_a_chain() {
        let mut state = State::default();
        let control = state.add_control(1.0);
        let inertia = Inertia::from_moments([1.0, 1.0, 2.0]).unwrap();
        let orientation = UnitQuaternion::identity();
        let frames: Vec<usize> = (0..9)
            .map(|_| {
                state.frames.push(Frame {
                    orientation,
                    inertia,
                })
            })
            .collect();
        let moment = Vector3::z() * 3.0;
        let couple = Couple::new(&mut state, &[(8, 1.0)], moment, CoupleKind::Axial, control);
        let couple = couple.counted_along(&state, &frames);
        for turns in [0.3, 0.99, 1.01, 2.7, -3.4] {
            for &i in &frames {
                let swing = rotation::exp(Vector3::new(0.2, -0.1, 0.0) * i as f64);
                let angle = TAU * turns * i as f64 / 8.0;
                let q = rotation::exp(Vector3::z() * angle) * swing;
                state.frames.orientation.set(i, q);
            }
            let work = 3.0 * TAU * turns;
            let energy = couple.energy(&state);
            assert!((energy + work).abs() < 1e-12, "{turns}: {energy}");
        }
    }

    #[test]
    fn turns_of_a_free_frame_are_counted_in_motion() {
        let (start, couple) = turned(CoupleKind::Axial, Vector3::zeros());
        let axis = Vector3::new(1.2, -3.0, 1.8);
        let (mut state, size) = (start.clone(), 0.8 * axis.norm());
        for step in (-40_i32..=70).chain((-90..70).rev()) {
            let angle = 0.3 * f64::from(step);
            for i in 0..2 {
                let turn = rotation::exp(axis.normalize() * angle);
                let q = turn * start.frames.orientation.get(i);
                let sign = if (0.5 * angle).cos() * (turn.w) < 0.0 {
                    -1.0
                } else {
                    1.0
                };
                let q = UnitQuaternion::new_unchecked(q.into_inner() * sign);
                state.frames.orientation.set(i, q);
            }
            if step == -40 {
                state.controls[couple.turned] = angle;
            }
            couple.count_turns(&mut state);
            // Rounding of angles up to 27 rad.
            let error = couple.energy(&state) + size * angle;
            assert!(error.abs() < 1e-12 * size, "{angle}: {error}");
        }
    }

    /// Work along a closed path of rotations about two axes.
    #[test]
    fn only_follower_couples_do_work_on_a_closed_path() {
        let work = |kind| {
            let (mut state, couple) = turned(kind, Vector3::zeros());
            let turn = |state: &mut State, step: Vector3| {
                let q = state.frames.orientation.get(0);
                let middle = q * rotation::exp(step * 0.5);
                state.frames.orientation.set(0, middle);
                let work = loads_of(&couple, state).torque.get(0).dot(&step);
                state.frames.orientation.set(0, q * rotation::exp(step));
                work
            };
            let first = state.frames.orientation.get(0);
            let (mut work, n) = (0.0, 2000);
            for axis in [Vector3::x(), Vector3::y(), -Vector3::x(), -Vector3::y()] {
                for _ in 0..n {
                    work += turn(&mut state, axis / f64::from(n));
                }
            }
            let back = rotation::log(state.frames.orientation.get(0).inverse() * first);
            for _ in 0..n {
                work += turn(&mut state, back / f64::from(n));
            }
            work
        };
        // Midpoint rule with steps of 5e-4 rad, for a couple of 0.75.
        assert!(work(CoupleKind::Axial).abs() < 1e-6);
        assert!(work(CoupleKind::Follower).abs() > 0.05);
        assert!(
            !turned(CoupleKind::Follower, Vector3::zeros())
                .1
                .is_conservative()
        );
    }
}
