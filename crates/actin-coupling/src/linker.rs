use crate::linker_angles::{AnglesAt, vectors, write_vectors};
use crate::linker_ends::LinkerEnds;
use crate::site::{Site, ensure};
use crate::{LinkerAngles, LinkerEnd, LinkerError, LinkerKey, PeriodicImage};
use actin_mechanics::{
    ControlId, Hooke, Interaction, Loads, Matrix3, RandomStress, SecondOrder, State, StepStress,
    Stiffness, Vector3,
};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Distance to a kink of the energy, relative to the negative rest length, below which the stiffness does not grow.
const CLOSE: f64 = 1e-6;

/// Components of the random stress of the spring.
const SPRING: usize = 4;

/// Hookean spring between a site and an anchor or another site: term `linker`, one element.
///
/// ```text
/// E = k (|d| - L)^2 / 2,   F = k (|d| - L) d / |d|
/// ```
///
/// `d` is the vector from the site to the other end (nm, lab frame). `k` is the stiffness (pN/nm),
/// `L` the rest length (nm) and `F` the force on the site (pN, lab frame). [`LinkerAngles`] add their energy. Loads are
/// the negative gradient of the sum.
///
/// At `d = 0` with a positive rest length the stiffness is negative in every direction, see
/// [`Hooke`]. This state is not a minimum.
///
/// # Source
/// arXiv 2203.01284, Section 3. The paper uses statically equivalent forces that are not a
/// gradient.
#[derive(Clone, Debug, PartialEq)]
pub struct Linker {
    ends: LinkerEnds,
    spring: Hooke,
    angles: Option<LinkerAngles>,
}

impl Linker {
    /// Creates a linker with a stiffness (pN/nm) and a rest length (nm).
    ///
    /// # Errors
    /// If the stiffness is not positive, the rest length is negative, or the anchor is not finite.
    ///
    /// ```
    /// use actin_coupling::{Anchor, Linker, LinkerEnd, RodPlace, Site, State, StraightRod, Vector3};
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(2, 10.0).push(&mut state)?;
    /// // A site at a quarter of segment 1, on the axis, 3 nm from the anchor along x.
    /// let place = RodPlace { segment: 1, fraction: 0.25, ..RodPlace::default() };
    /// let site = Site::on_rod(&rod, place)?;
    /// let anchor = LinkerEnd::Anchor(Anchor::fixed(Vector3::new(3.0, 0.0, 12.5)));
    /// let linker = Linker::new(site, anchor, 2.0, 1.0)?;
    /// assert_eq!(linker.extension(&state), 2.0);
    /// assert_eq!(linker.force(&state), Vector3::x() * 4.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        site: Site,
        end: LinkerEnd,
        stiffness: f64,
        rest_length: f64,
    ) -> Result<Self, LinkerError> {
        let stiff = stiffness.is_finite() && stiffness > 0.0;
        ensure(
            stiff,
            LinkerKey::Stiffness,
            stiffness,
            "positive and finite",
        )?;
        let long = rest_length.is_finite() && rest_length >= 0.0;
        ensure(
            long,
            LinkerKey::RestLength,
            rest_length,
            "finite and not negative",
        )?;
        if let LinkerEnd::Anchor(anchor) = &end {
            for value in anchor.position.iter().copied() {
                ensure(value.is_finite(), LinkerKey::Anchor, value, "finite")?;
            }
        }
        let spring = Hooke {
            stiffness,
            rest_length,
        };
        Ok(Self {
            ends: LinkerEnds {
                site,
                end,
                image: None,
            },
            spring,
            angles: None,
        })
    }

    /// Joins the linker to a periodic image of its second end.
    #[must_use]
    pub fn with_image(mut self, image: Option<PeriodicImage>) -> Self {
        self.ends.image = image;
        self
    }

    /// Periodic image of the second end, or `None` for the end itself.
    pub fn image(&self) -> Option<&PeriodicImage> {
        self.ends.image.as_ref()
    }

    /// Adds a stiffness against tilt and twist. It has no effect on linkers to anchors and within a monomer or segment.
    #[must_use]
    pub fn with_angles(self, angles: Option<LinkerAngles>) -> Self {
        Self { angles, ..self }
    }

    /// Stiffness against tilt at each end and against twist (pN nm), free of torques in the configuration `state`.
    ///
    /// The direction across the linker is the projection of the third axis of the first frame, the tangent of the filament.
    ///
    /// # Errors
    /// If a stiffness is negative or not finite, or the linker has no length, or does not connect sites of
    /// two different frames.
    ///
    /// ```
    /// use actin_coupling::{
    ///     Interaction, Linker, LinkerEnd, RodPlace, Site, State, StraightRod, Vector3, rotation,
    /// };
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(1, 10.0);
    /// let (one, other) = (rod.push(&mut state)?, rod.push(&mut state)?);
    /// for node in other.points() {
    ///     state.points.position.add(node, Vector3::x() * 20.0);
    /// }
    /// let middle = RodPlace { fraction: 0.5, ..RodPlace::default() };
    /// let end = LinkerEnd::Site(Site::on_rod(&other, middle)?);
    /// let linker = Linker::new(Site::on_rod(&one, middle)?, end, 1.0, 20.0)?;
    /// let angles = linker.angles_as_built((60.0, 0.0), &state)?;
    /// let linker = linker.with_angles(Some(angles));
    /// // The frame of the first segment turns by 0.1 rad about the filament.
    /// let frame = one.frames().start;
    /// state.frames.orientation.set(frame, rotation::exp(Vector3::z() * 0.1));
    /// assert!((linker.energy(&state) - 60.0 * (1.0 - 0.1_f64.cos())).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn angles_as_built(
        &self,
        stiffness: (f64, f64),
        state: &State,
    ) -> Result<LinkerAngles, LinkerError> {
        LinkerAngles::as_built(&self.ends, stiffness, state)
    }

    /// Stiffness against tilt and twist.
    pub fn angles(&self) -> Option<&LinkerAngles> {
        self.angles.as_ref()
    }

    /// The same linker between other sites.
    pub(crate) fn between(&self, site: Site, end: LinkerEnd) -> Self {
        let image = self.ends.image;
        Self {
            ends: LinkerEnds { site, end, image },
            ..*self
        }
    }

    /// Stiffness and rest length.
    pub fn spring(&self) -> &Hooke {
        &self.spring
    }

    /// First end.
    pub fn site(&self) -> &Site {
        &self.ends.site
    }

    /// Second end.
    pub fn end(&self) -> &LinkerEnd {
        &self.ends.end
    }

    /// Controls of a movable anchor.
    pub fn anchor_controls(&self) -> Option<[ControlId; 3]> {
        match &self.ends.end {
            LinkerEnd::Anchor(anchor) => anchor.controls,
            LinkerEnd::Site(_) => None,
        }
    }

    /// Position of the second end or of its image (nm, lab frame).
    pub fn end_position(&self, state: &State) -> Vector3 {
        self.ends.second(state)
    }

    /// Displacement of the image of the second end from this end (nm, lab frame); zero without periodic images.
    pub fn periodic_displacement(&self, state: &State) -> Vector3 {
        self.ends.periodic_displacement(state)
    }

    /// Length minus rest length (nm).
    pub fn extension(&self, state: &State) -> f64 {
        self.ends.reach(state).norm() - self.spring.rest_length
    }

    /// Force on the filament at the site (pN, lab frame). The force on the other end is opposite.
    pub fn force(&self, state: &State) -> Vector3 {
        let angles = self.angles_at(state);
        let of_angles = angles.map_or_else(Vector3::zeros, |one| one.force(&one.stresses()));
        self.spring.force(self.ends.reach(state)) + of_angles
    }

    fn angles_at<'a>(&'a self, state: &'a State) -> Option<AnglesAt<'a>> {
        self.angles.as_ref()?.at(&self.ends, state)
    }

    /// Force of a random stress on the first end (pN, lab frame), to be subtracted from the force.
    pub(crate) fn random_force(&self, state: &State, stresses: &[f64]) -> Vector3 {
        let (of_spring, of_angles) = stresses.split_at(SPRING);
        let angles = self.angles_at(state);
        let across = angles.map_or_else(Vector3::zeros, |one| one.force(&vectors(of_angles)));
        self.random_spring_force(state, of_spring) + across
    }

    fn random_spring_force(&self, state: &State, stresses: &[f64]) -> Vector3 {
        let axis = self
            .ends
            .reach(state)
            .try_normalize(0.0)
            .unwrap_or_default();
        axis * stresses[0] + Vector3::from_column_slice(&stresses[1..])
    }
}

impl Interaction for Linker {
    fn term(&self) -> &'static str {
        "linker"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.ends
            .add_force(self.spring.force(self.ends.reach(state)), state, loads);
        if let Some(angles) = self.angles_at(state) {
            angles.add_stress(&angles.stresses(), 1.0, loads);
        }
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), 1, "a linker is one element");
        let of_angles = self.angles_at(state).map_or(0.0, |angles| angles.energy());
        energies[0] = self.spring.energy(self.ends.reach(state)) + of_angles;
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl SecondOrder for Linker {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let d = self.ends.reach(state);
        let of_spring = (self.spring.force(d), self.spring.tangent(d));
        self.ends.push_stiffness(of_spring, state, stiffness);
        if let Some(angles) = self.angles_at(state) {
            angles.push_stiffness(&angles.stresses(), stiffness);
        }
    }
}

/// Random tension `s` and random force `v` in units of `sqrt(k kT)`: `v` has independent components of standard deviation
/// `force`, and `s = tension z + share (<|v|> - |v|)` with a normal deviate `z`.
struct Amplitudes {
    tension: f64,
    force: f64,
    share: f64,
}

impl Amplitudes {
    /// Mean length of a vector of three normal deviates.
    fn mean_length() -> f64 {
        (8.0 / PI).sqrt()
    }

    /// For a rest length of `ratio` thermal extensions `sqrt(kT/k)`.
    ///
    /// A linker that relaxes in much less than a step gets the length `L + (s + |v|) / k`. This length has the mean and the
    /// variance of the equilibrium density `d^2 exp(-E/kT)`. A linker that relaxes in about a step keeps its direction, and
    /// the variances of `s` and of the component of `v` in this direction have the sum 1.
    fn new(ratio: f64) -> Self {
        // Integrals of exp(-(x - ratio)^2 / 2), times x, times x^2 over positive x.
        let zeroth = (PI / 2.0).sqrt() * (1.0 + libm::erf(ratio * FRAC_1_SQRT_2));
        let first = ratio * zeroth + (-0.5 * ratio * ratio).exp();
        let second = ratio * first + zeroth;
        let extension = 2.0 * first / second;
        let variance = 3.0 - (ratio + extension) * extension;

        let force = extension / Self::mean_length();
        let of_length = 3.0 - Self::mean_length().powi(2);
        let share = 0.5 + ((1.0 - variance) / (force * force) - 1.0) / (2.0 * of_length);
        // Exact values are between 0 and 0.8; rounding errors are large for long linkers.
        let share = share.clamp(0.0, 1.0);
        let left = variance - of_length * ((1.0 - share) * force).powi(2);
        Self {
            tension: left.max(0.0).sqrt(),
            force,
            share,
        }
    }
}

/// Four components: a tension `s` with the energy `-s |d|`, which rotates with the linker during the step, and a constant
/// force `v` with the energy `-v . d`. Linkers without rest length have the force alone, and long ones the tension. The
/// stresses of the angles follow.
impl RandomStress for Linker {
    fn components(&self) -> usize {
        SPRING + self.angles.map_or(0, |_| LinkerAngles::COMPONENTS)
    }

    fn draw(&self, _: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let scale = (self.spring.stiffness * thermal_energy).sqrt();
        let of = Amplitudes::new(self.spring.rest_length * self.spring.stiffness / scale);
        let (of_spring, of_angles) = stresses.split_at_mut(SPRING);
        let deviate = Vector3::from_column_slice(&of_spring[1..]);
        let of_length = of.share * of.force * (Amplitudes::mean_length() - deviate.norm());
        of_spring[0] = scale * (of.tension * of_spring[0] + of_length);
        of_spring[1..].copy_from_slice((deviate * (scale * of.force)).as_slice());
        if let Some(angles) = &self.angles {
            angles.draw(thermal_energy, of_angles);
        }
    }

    /// Keeps the tension, which changes the rest length.
    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let (of_spring, of_angles) = stresses.split_at_mut(SPRING);
        of_spring[1..].fill(0.0);
        let tension = self.random_spring_force(state, of_spring);
        let force = self.spring.force(self.ends.reach(state)) - tension;
        of_spring[1..].copy_from_slice(force.as_slice());
        if let Some(angles) = self.angles_at(state) {
            write_vectors(&angles.stresses(), of_angles);
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        let (of_spring, of_angles) = stresses.split_at(SPRING);
        let force = self.random_spring_force(state, of_spring);
        self.ends.add_force(-force, state, loads);
        if let Some(angles) = self.angles_at(state) {
            angles.add_stress(&vectors(of_angles), -1.0, loads);
        }
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        let d = self.ends.reach(state);
        let (of_spring, of_angles) = stress.values.split_at(SPRING);
        let force = self.spring.force(d) - self.random_spring_force(state, of_spring);
        // A tension is a change of the rest length.
        let spring = Hooke {
            rest_length: self.spring.rest_length + stress.values[0] / self.spring.stiffness,
            ..self.spring
        };
        let tangent = if spring.rest_length < 0.0 {
            upper_bound(&spring, d)
        } else if stress.is_balanced {
            spring.convex_tangent(d)
        } else {
            spring.tangent(d)
        };
        self.ends.push_stiffness((force, tangent), state, stiffness);
        if let Some(angles) = self.angles_at(state) {
            let (own, random) = (angles.stresses(), vectors(of_angles));
            let rest = std::array::from_fn(|k| own[k] - random[k]);
            angles.push_stiffness(&rest, stiffness);
        }
    }
}

/// Tangent `k (1 - L / |d|)` in all directions, for a negative rest length `L`. Its quadratic energy is an upper bound of
/// the energy. The energy has a kink at `d = 0`, and iterations with the exact tangent alternate about minima close to it.
///
/// # Source
/// E. Weiszfeld, Tohoku Math. J. 43 (1937) 355.
fn upper_bound(spring: &Hooke, d: Vector3) -> Matrix3 {
    let length = d.norm().max(-CLOSE * spring.rest_length);
    Matrix3::identity() * (spring.stiffness * (1.0 - spring.rest_length / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of a function of a standard normal deviate.
    fn mean(of: impl Fn(f64) -> f64) -> f64 {
        const STEP: f64 = 1e-3;
        let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * PI).sqrt();
        let points = (-10_000..=10_000).map(|k| f64::from(k) * STEP);
        points.map(|x| of(x) * density(x) * STEP).sum()
    }

    /// `s + |v|` has the mean and the variance of the density `x^2 exp(-(x - ratio)^2 / 2)`; `s + v_x` has the variance 1.
    #[test]
    fn random_stress_has_the_moments_of_equilibrium() {
        for ratio in [0.0, 0.3, 1.0, 2.7, 6.0, 40.0] {
            let of_length = |power: i32| mean(|x| (ratio + x).max(0.0).powi(power));
            let norm = of_length(2);
            let (length, square) = (of_length(3) / norm, of_length(4) / norm);
            let of = Amplitudes::new(ratio);
            // The length of a vector of three normal deviates has a density proportional to x^2 exp(-x^2 / 2).
            let (force, tension) = (of.force * mean(|x| x.abs().powi(3)), of.tension.powi(2));
            let spread = 3.0 * of.force.powi(2) - force * force;
            let relaxed = tension + (1.0 - of.share).powi(2) * spread;
            let directed = tension + of.share.powi(2) * spread + of.force.powi(2);
            let errors = [
                ratio + force - length,
                relaxed - (square - length * length),
                directed - 1.0,
            ];
            assert!(errors.iter().all(|e| e.abs() < 1e-6), "{ratio}: {errors:?}");
        }
        for ratio in [1e9, 1e60] {
            let long = Amplitudes::new(ratio);
            assert!((long.tension - 1.0).abs() < 1e-15 && long.force * (1.0 + long.share) < 1e-8);
        }
    }
}
