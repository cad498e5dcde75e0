//! The linker as an interaction: a spring to a site. Where sites are is in `site.rs`.

use crate::site::{Site, ensure};
use crate::{LinkerError, LinkerKey};
use actin_mechanics::{
    ControlId, Coordinates, Hooke, Interaction, Loads, Matrix3, RandomStress, SecondOrder, State,
    Stiffness, Vector3, correlate,
};

/// A point outside of the filament that holds one end of a linker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Where it is before it is moved (nm, lab frame).
    pub position: Vector3,
    /// The three components of its displacement (nm, lab frame); none if it stays.
    pub controls: Option<[ControlId; 3]>,
}

impl Anchor {
    /// An anchor that stays at `position` (nm, lab frame).
    pub fn fixed(position: Vector3) -> Self {
        Self {
            position,
            controls: None,
        }
    }

    /// An anchor at `position` (nm, lab frame) that three controls of its own displace, which begin
    /// at zero.
    pub fn movable(state: &mut State, position: Vector3) -> Self {
        Self {
            position,
            controls: Some([0.0; 3].map(|component| state.add_control(component))),
        }
    }

    /// Where it is in `state` (nm, lab frame).
    pub fn position(&self, state: &State) -> Vector3 {
        let displacement = self
            .controls
            .map(|c| c.map(|component| state.controls[component]));
        self.position + displacement.map_or_else(Vector3::zeros, Vector3::from)
    }
}

/// What holds the other end of a linker.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkerEnd {
    /// A point outside of the filament.
    Anchor(Anchor),
    /// Another site, of the same filament or of another.
    Site(Site),
}

/// A Hookean linker between a site and an anchor or another site: term `linker`, one element.
///
/// With `d` from the site to the other end (nm), `k` the stiffness (pN/nm) and `L` the rest length
/// (nm), `E = k (|d| - L)^2 / 2`. The force on the site is `k (|d| - L) d / |d|`, that on the other
/// end the opposite; on a segment or monomer either acts as the site's own derivative has it, so
/// that forces and couples are the gradient of `E`.
///
/// At `d = 0` with a rest length [`Hooke`] has a negative stiffness in every direction, so a state
/// in which a linker is shut is never taken for a minimum.
///
/// # Source
/// arXiv 2203.01284, Section 3, whose linker forces come in halves with a couple about the middle
/// of the segment: statically equivalent, but not the gradient of an energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Linker {
    site: Site,
    end: LinkerEnd,
    spring: Hooke,
}

impl Linker {
    /// A linker of a stiffness (pN/nm) and a rest length (nm).
    ///
    /// # Errors
    /// A stiffness that is not positive, a negative rest length, or an anchor that is not finite.
    ///
    /// ```
    /// use actin_coupling::{Anchor, Linker, LinkerEnd, RodPlace, Site, State, StraightRod, Vector3};
    /// let mut state = State::default();
    /// let rod = StraightRod::uniform(2, 10.0).push(&mut state)?;
    /// // A quarter of the way from node 1 to node 2, on the axis, pulled along x by 3 nm.
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
        Ok(Self { site, end, spring })
    }

    /// The site.
    pub fn site(&self) -> &Site {
        &self.site
    }

    /// What holds the other end.
    pub fn end(&self) -> &LinkerEnd {
        &self.end
    }

    /// The controls of the displacement of its anchor, if it has one that moves.
    pub fn anchor_controls(&self) -> Option<[ControlId; 3]> {
        match &self.end {
            LinkerEnd::Anchor(anchor) => anchor.controls,
            LinkerEnd::Site(_) => None,
        }
    }

    /// Where the other end is (nm, lab frame).
    pub fn end_position(&self, state: &State) -> Vector3 {
        match &self.end {
            LinkerEnd::Anchor(anchor) => anchor.position(state),
            LinkerEnd::Site(site) => site.position(state),
        }
    }

    /// Length beyond the rest length (nm); negative where the linker is shorter.
    pub fn extension(&self, state: &State) -> f64 {
        self.reach(state).norm() - self.spring.rest_length
    }

    /// Force on the filament at the site (pN, lab frame). What holds the other end feels the
    /// opposite.
    pub fn force(&self, state: &State) -> Vector3 {
        self.spring.force(self.reach(state))
    }

    /// From the site to the other end (lab frame).
    #[inline]
    fn reach(&self, state: &State) -> Vector3 {
        self.end_position(state) - self.site.position(state)
    }

    /// Every coordinate that the linker follows, and the derivative of its vector by it.
    fn slopes(&self, state: &State) -> Vec<(Coordinates, Matrix3)> {
        let mut slopes: Vec<_> = self.site.slopes(state).map(|(c, j)| (c, -j)).collect();
        if let LinkerEnd::Site(other) = &self.end {
            slopes.extend(other.slopes(state));
        }
        slopes
    }

    /// Adds the loads of a force on the filament at the site (pN, lab frame).
    fn add_force(&self, force: Vector3, state: &State, loads: &mut Loads) {
        self.site.add_force(force, state, loads);
        if let LinkerEnd::Site(other) = &self.end {
            other.add_force(-force, state, loads);
        }
    }

    /// Pushes `J^T K J` with `J` the derivative of the linker's vector by each coordinate and `K` that of its force, and
    /// for each frame the part in which the force turns the arm.
    fn push_stiffness(
        &self,
        (force, spring): (Vector3, Matrix3),
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let slopes = self.slopes(state);
        for (k, &(a, slope_a)) in slopes.iter().enumerate() {
            stiffness.push(a, a, symmetric(slope_a.transpose() * spring * slope_a));
            for &(b, slope_b) in &slopes[k + 1..] {
                let block = slope_a.transpose() * spring * slope_b;
                if a == b {
                    // Both sites follow this body: the block and its transpose are on the diagonal.
                    stiffness.push(a, a, block + block.transpose());
                } else {
                    stiffness.push(a, b, block);
                }
            }
        }
        let geometric = |site: &Site, g: Vector3, stiffness: &mut Stiffness| {
            let frame = Coordinates::Frame(site.frame());
            stiffness.push(frame, frame, site.curvature_of_work(g, state));
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

/// A force in the lab frame, conjugate to the linker's vector.
impl RandomStress for Linker {
    fn components(&self) -> usize {
        3
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let tangent = self.spring.tangent(self.reach(state));
        for stress in stresses.as_chunks_mut().0 {
            correlate(tangent * thermal_energy, stress);
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        stresses.copy_from_slice(self.force(state).as_slice());
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        self.add_force(-Vector3::from_column_slice(stresses), state, loads);
    }

    fn add_stress_stiffness(&self, state: &State, stresses: &[f64], stiffness: &mut Stiffness) {
        let force = -Vector3::from_column_slice(stresses);
        self.push_stiffness((force, Matrix3::zeros()), state, stiffness);
    }

    fn add_convexity(&self, state: &State, is_wanted: bool, stiffness: &mut Stiffness) {
        let lacking = if is_wanted {
            negative_part(self.spring.tangent(self.reach(state)))
        } else {
            Matrix3::zeros()
        };
        self.push_stiffness((Vector3::zeros(), lacking), state, stiffness);
    }
}

/// Returns the matrix with the sizes of the negative eigenvalues of `m` (symmetric) and zeros for the others.
fn negative_part(m: Matrix3) -> Matrix3 {
    let eigen = m.symmetric_eigen();
    let sizes = eigen.eigenvalues.map(|value| (-value).max(0.0));
    let vectors = eigen.eigenvectors;
    vectors * Matrix3::from_diagonal(&sizes) * vectors.transpose()
}

/// The symmetric part, which differs from `m` by round-off.
fn symmetric(m: Matrix3) -> Matrix3 {
    0.5 * (m + m.transpose())
}
