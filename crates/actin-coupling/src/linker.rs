use crate::site::{Site, ensure};
use crate::{LinkerError, LinkerKey, PeriodicImage};
use actin_mechanics::{
    ControlId, Coordinates, Hooke, Interaction, Loads, Matrix3, RandomStress, SecondOrder, State,
    StepStress, Stiffness, Vector3,
};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Distance to a kink of the energy, relative to the negative rest length, below which the stiffness does not grow.
const CLOSE: f64 = 1e-6;

/// External point at one end of a linker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Position without displacement (nm, lab frame).
    pub position: Vector3,
    /// Components of the displacement (nm, lab frame), or `None` for a fixed anchor.
    pub controls: Option<[ControlId; 3]>,
}

impl Anchor {
    /// Creates a fixed anchor at `position` (nm, lab frame).
    pub fn fixed(position: Vector3) -> Self {
        Self {
            position,
            controls: None,
        }
    }

    /// Creates a movable anchor at `position` (nm, lab frame) and adds the three controls of its
    /// displacement to the state.
    pub fn movable(state: &mut State, position: Vector3) -> Self {
        Self {
            position,
            controls: Some([0.0; 3].map(|component| state.add_control(component))),
        }
    }

    /// Current position (nm, lab frame).
    pub(crate) fn position(&self, state: &State) -> Vector3 {
        let displacement = self
            .controls
            .map(|c| c.map(|component| state.controls[component]));
        self.position + displacement.map_or_else(Vector3::zeros, Vector3::from)
    }
}

/// Second end of a linker.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkerEnd {
    /// External point.
    Anchor(Anchor),
    /// Site of the same or another filament.
    Site(Site),
}

/// Hookean spring between a site and an anchor or another site: term `linker`, one element.
///
/// ```text
/// E = k (|d| - L)^2 / 2,   F = k (|d| - L) d / |d|
/// ```
///
/// `d` is the vector from the site to the other end (nm, lab frame). `k` is the stiffness (pN/nm),
/// `L` the rest length (nm) and `F` the force on the site (pN, lab frame). Loads are the negative
/// gradient of `E`.
///
/// At `d = 0` with a positive rest length the stiffness is negative in every direction, see
/// [`Hooke`]. This state is not a minimum.
///
/// # Source
/// arXiv 2203.01284, Section 3. The paper uses statically equivalent forces that are not a
/// gradient.
#[derive(Clone, Debug, PartialEq)]
pub struct Linker {
    site: Site,
    end: LinkerEnd,
    spring: Hooke,
    image: Option<PeriodicImage>,
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
            site,
            end,
            spring,
            image: None,
        })
    }

    /// Joins the linker to a periodic image of its second end.
    #[must_use]
    pub fn with_image(self, image: Option<PeriodicImage>) -> Self {
        Self { image, ..self }
    }

    /// Periodic image of the second end, or `None` for the end itself.
    pub fn image(&self) -> Option<&PeriodicImage> {
        self.image.as_ref()
    }

    /// Creates a linker from valid parts.
    pub(crate) fn with_spring(site: Site, end: LinkerEnd, spring: Hooke) -> Self {
        Self {
            site,
            end,
            spring,
            image: None,
        }
    }

    /// Stiffness and rest length.
    pub fn spring(&self) -> &Hooke {
        &self.spring
    }

    /// First end.
    pub fn site(&self) -> &Site {
        &self.site
    }

    /// Second end.
    pub fn end(&self) -> &LinkerEnd {
        &self.end
    }

    /// Controls of a movable anchor.
    pub fn anchor_controls(&self) -> Option<[ControlId; 3]> {
        match &self.end {
            LinkerEnd::Anchor(anchor) => anchor.controls,
            LinkerEnd::Site(_) => None,
        }
    }

    /// Position of the second end or of its image (nm, lab frame).
    pub fn end_position(&self, state: &State) -> Vector3 {
        let end = match &self.end {
            LinkerEnd::Anchor(anchor) => anchor.position(state),
            LinkerEnd::Site(site) => site.position(state),
        };
        end + self.image_displacement(end, state)
    }

    /// Displacement of the image of the second end from this end (nm, lab frame); zero without periodic images.
    pub fn periodic_displacement(&self, state: &State) -> Vector3 {
        match &self.end {
            LinkerEnd::Site(site) => self.image_displacement(site.position(state), state),
            LinkerEnd::Anchor(_) => Vector3::zeros(),
        }
    }

    fn image_displacement(&self, end: Vector3, state: &State) -> Vector3 {
        self.image.map_or_else(Vector3::zeros, |image| {
            image.displacement(end - self.site.position(state), state)
        })
    }

    /// Length minus rest length (nm).
    pub fn extension(&self, state: &State) -> f64 {
        self.reach(state).norm() - self.spring.rest_length
    }

    /// Force on the filament at the site (pN, lab frame). The force on the other end is opposite.
    pub fn force(&self, state: &State) -> Vector3 {
        self.spring.force(self.reach(state))
    }

    /// Force of a random stress on the first end (pN, lab frame), to be subtracted from the force of the spring.
    pub(crate) fn random_force(&self, state: &State, stresses: &[f64]) -> Vector3 {
        let axis = self.reach(state).try_normalize(0.0).unwrap_or_default();
        axis * stresses[0] + Vector3::from_column_slice(&stresses[1..])
    }

    /// Vector from the first to the second end (nm, lab frame).
    #[inline]
    pub(crate) fn reach(&self, state: &State) -> Vector3 {
        self.end_position(state) - self.site.position(state)
    }

    /// Derivatives of the linker vector with respect to the bodies of each end.
    pub(crate) fn slopes_of_ends(&self, state: &State) -> [Vec<(Coordinates, Matrix3)>; 2] {
        let first = self.site.slopes(state).map(|(c, j)| (c, -j)).collect();
        let second = match &self.end {
            LinkerEnd::Site(other) => other.slopes(state).collect(),
            LinkerEnd::Anchor(_) => Vec::new(),
        };
        [first, second]
    }

    /// Adds a force on the first end and the opposite force on the second one (pN, lab frame).
    pub(crate) fn add_force(&self, force: Vector3, state: &State, loads: &mut Loads) {
        self.site.add_force(force, state, loads);
        if let LinkerEnd::Site(other) = &self.end {
            other.add_force(-force, state, loads);
        }
    }

    /// Adds `J^T K J` and the geometric stiffness of the arms. `J` is the derivative of the linker
    /// vector and `K` the tangent of the force.
    fn push_stiffness(
        &self,
        (force, spring): (Vector3, Matrix3),
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let [mut slopes, second] = self.slopes_of_ends(state);
        let of_site = slopes.len();
        slopes.extend(second);
        for (k, &(a, slope_a)) in slopes.iter().enumerate() {
            stiffness.push(a, a, symmetric(slope_a.transpose() * spring * slope_a));
            for (l, &(b, slope_b)) in slopes.iter().enumerate().skip(k + 1) {
                let block = slope_a.transpose() * spring * slope_b;
                if a == b {
                    // Both sites follow this body: block and transpose are on the diagonal.
                    stiffness.push(a, a, block + block.transpose());
                } else if k < of_site && l >= of_site {
                    stiffness.push_link(a, b, block);
                } else {
                    stiffness.push(a, b, block);
                }
            }
        }
        self.push_curvature(force, state, stiffness);
    }

    /// Adds the geometric stiffness of the arms under a force on the first end (pN, lab frame).
    pub(crate) fn push_curvature(&self, force: Vector3, state: &State, stiffness: &mut Stiffness) {
        let geometric = |site: &Site, g: Vector3, stiffness: &mut Stiffness| {
            if site.has_arm() {
                let frame = Coordinates::Frame(site.frame());
                stiffness.push(frame, frame, site.curvature_of_work(g, state));
            }
        };
        geometric(&self.site, -force, stiffness);
        if let LinkerEnd::Site(other) = &self.end {
            geometric(other, force, stiffness);
        }
    }
}

impl Interaction for Linker {
    fn term(&self) -> &'static str {
        "linker"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.add_force(self.force(state), state, loads);
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), 1, "a linker is one element");
        energies[0] = self.spring.energy(self.reach(state));
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
        let d = self.reach(state);
        let of_spring = (self.spring.force(d), self.spring.tangent(d));
        self.push_stiffness(of_spring, state, stiffness);
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
/// force `v` with the energy `-v . d`. Linkers without rest length have the force alone, and long ones the tension.
impl RandomStress for Linker {
    fn components(&self) -> usize {
        4
    }

    fn draw(&self, _: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let scale = (self.spring.stiffness * thermal_energy).sqrt();
        let of = Amplitudes::new(self.spring.rest_length * self.spring.stiffness / scale);
        let deviate = Vector3::from_column_slice(&stresses[1..]);
        let of_length = of.share * of.force * (Amplitudes::mean_length() - deviate.norm());
        stresses[0] = scale * (of.tension * stresses[0] + of_length);
        stresses[1..].copy_from_slice((deviate * (scale * of.force)).as_slice());
    }

    /// Keeps the tension, which changes the rest length.
    fn balance(&self, state: &State, stresses: &mut [f64]) {
        stresses[1..].fill(0.0);
        let force = self.force(state) - self.random_force(state, stresses);
        stresses[1..].copy_from_slice(force.as_slice());
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        self.add_force(-self.random_force(state, stresses), state, loads);
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        let d = self.reach(state);
        let force = self.spring.force(d) - self.random_force(state, stress.values);
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
        self.push_stiffness((force, tangent), state, stiffness);
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

fn symmetric(m: Matrix3) -> Matrix3 {
    0.5 * (m + m.transpose())
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
