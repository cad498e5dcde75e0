use crate::site::ensure;
use crate::{Linker, LinkerEnd, LinkerError, LinkerKey};
use actin_mechanics::{
    Coordinates, Interaction, Loads, Matrix3, RandomStress, SecondOrder, State, StepStress,
    Stiffness, Vector3,
};

/// Numbers per strain vector.
const VECTOR: usize = 3;

/// Stiffness of a linker between two sites against tilt and twist: term `linker`, one element.
///
/// ```text
/// E = k_t |e_1|^2 / 2 + k_t |e_2|^2 / 2 + k_w |e_3|^2 / 2
/// e_i = Q_i^T f - m_i,   e_3 = Q_1^T Q_2 w - u
/// ```
///
/// `f` is the direction of the linker (lab frame), and `Q_i` are the frames of the two sites. The
/// vectors `m_i` (body frames) are the direction of the linker in a reference configuration, and `u` and
/// `w` are one direction across the linker. `u` is the projection of the third axis of the first frame, the
/// tangent of the filament. For the angles `a_1`, `a_2` between the linker and its reference directions and
/// `b` between the two filaments, `E = k_t (2 - cos a_1 - cos a_2) + k_w (1 - cos b)`.
#[derive(Clone, Debug)]
pub struct LinkerAngles {
    linker: Linker,
    /// Frames of the two sites.
    frames: [usize; 2],
    /// Stiffness of each strain vector (pN nm).
    stiffness: [f64; 3],
    /// Reference directions of the linker in both frames.
    along: [Vector3; 2],
    /// Reference directions across the linker in both frames.
    across: [Vector3; 2],
}

/// Directions at a state.
struct Directions {
    /// Length of the linker (nm).
    length: f64,
    /// Unit vector along the linker (lab frame).
    f: Vector3,
    /// Projection across the linker.
    across: Matrix3,
    /// Axes of both frames.
    q: [Matrix3; 2],
}

/// Second derivatives with respect to the linker vector and the rotations of both frames; `[i][j]` for
/// `i <= j`.
#[derive(Default)]
struct Second([[Matrix3; 3]; 3]);

/// Derivatives of the linker vector and of both rotations with respect to a body.
struct Slopes {
    body: Coordinates,
    /// `true` for a body of the second site.
    is_second: bool,
    of: [Matrix3; 3],
}

impl LinkerAngles {
    /// Creates the stiffness of a linker against tilt at each end and against twist (pN nm), with the
    /// reference configuration `state`.
    ///
    /// # Errors
    /// If a stiffness is negative or not finite, or the linker has no length, or does not connect sites of
    /// two different frames.
    ///
    /// ```
    /// use actin_coupling::{
    ///     Interaction, Linker, LinkerAngles, LinkerEnd, RodPlace, Site, State, StraightRod, rotation,
    ///     Vector3,
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
    /// let angles = LinkerAngles::new(&linker, (60.0, 0.0), &state)?;
    /// // The frame of the first segment turns by 0.1 rad about the filament.
    /// let frame = one.frames().start;
    /// state.frames.orientation.set(frame, rotation::exp(Vector3::z() * 0.1));
    /// assert!((angles.energy(&state) - 60.0 * (1.0 - 0.1_f64.cos())).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(
        linker: &Linker,
        (tilt, twist): (f64, f64),
        state: &State,
    ) -> Result<Self, LinkerError> {
        for (key, value) in [(LinkerKey::Tilt, tilt), (LinkerKey::Twist, twist)] {
            let holds = value.is_finite() && value >= 0.0;
            ensure(holds, key, value, "finite and not negative")?;
        }
        let length = linker.reach(state).norm();
        ensure(length > 0.0, LinkerKey::Length, length, "positive")?;
        let LinkerEnd::Site(other) = linker.end() else {
            return Err(LinkerError::Angles);
        };
        let frames = [linker.site().frame(), other.frame()];
        if frames[0] == frames[1] {
            return Err(LinkerError::Angles);
        }
        let q = frames.map(|i| state.frames.orientation.get(i));
        let f = linker.reach(state) / length;
        let beside = |axis: Vector3| {
            let lab = q[0] * axis;
            lab - f * f.dot(&lab)
        };
        // A filament along the linker has no projection of its tangent.
        let [tangent, other] = [Vector3::z(), Vector3::x()].map(beside);
        let across = if tangent.norm() > 0.5 { tangent } else { other }.normalize();
        let in_frames = |lab: Vector3| q.map(|q| q.inverse_transform_vector(&lab));
        Ok(Self {
            linker: linker.clone(),
            frames,
            stiffness: [tilt, tilt, twist],
            along: in_frames(f),
            across: in_frames(across),
        })
    }

    /// Linker whose tilt and twist are resisted.
    pub fn linker(&self) -> &Linker {
        &self.linker
    }

    /// Force on the first site (pN, lab frame). The force on the second one is opposite.
    pub fn force(&self, state: &State) -> Vector3 {
        let at = self.directions(state);
        let slopes = self.strain_slopes(&at);
        let parts = slopes.iter().zip(self.stresses(&at));
        parts.map(|(of, stress)| of[0].tr_mul(&stress)).sum()
    }

    fn directions(&self, state: &State) -> Directions {
        let d = self.linker.reach(state);
        let length = d.norm();
        let f = d / length;
        let axes = |i| state.frames.orientation.get(i).to_rotation_matrix();
        Directions {
            length,
            f,
            across: Matrix3::identity() - f * f.transpose(),
            q: self.frames.map(|i| axes(i).into_inner()),
        }
    }

    /// Linker and reference direction across it, in the axes of the first, the second and the first frame.
    fn seen(&self, at: &Directions) -> [Vector3; 3] {
        let [a, b] = at.q;
        [
            a.tr_mul(&at.f),
            b.tr_mul(&at.f),
            a.tr_mul(&(b * self.across[1])),
        ]
    }

    /// Strain vectors.
    fn strains(&self, at: &Directions) -> [Vector3; 3] {
        let [first, second, beside] = self.seen(at);
        [
            first - self.along[0],
            second - self.along[1],
            beside - self.across[0],
        ]
    }

    /// Stresses of the strains (pN nm).
    fn stresses(&self, at: &Directions) -> [Vector3; 3] {
        let strains = self.strains(at);
        std::array::from_fn(|k| strains[k] * self.stiffness[k])
    }

    /// Derivatives of each strain vector with respect to the linker vector and both rotations (body axes).
    fn strain_slopes(&self, at: &Directions) -> [[Matrix3; 3]; 3] {
        let [a, b] = at.q;
        let [first, second, beside] = self.seen(at);
        let zero = Matrix3::zeros();
        let by_vector = |q: Matrix3| q.transpose() * at.across / at.length;
        let turned = -(a.transpose() * b * self.across[1].cross_matrix());
        [
            [by_vector(a), first.cross_matrix(), zero],
            [by_vector(b), zero, second.cross_matrix()],
            [zero, beside.cross_matrix(), turned],
        ]
    }

    /// Adds the loads `-sum s . de/dq` of stresses `s`.
    fn add_stress(&self, stresses: &[Vector3; 3], sign: f64, state: &State, loads: &mut Loads) {
        let slopes = self.strain_slopes(&self.directions(state));
        let gradient = |variable: usize| -> Vector3 {
            let parts = slopes.iter().zip(stresses);
            parts.map(|(of, stress)| of[variable].tr_mul(stress)).sum()
        };
        self.linker.add_force(gradient(0) * sign, state, loads);
        for (k, frame) in self.frames.into_iter().enumerate() {
            loads.torque.add(frame, gradient(k + 1) * -sign);
        }
    }

    /// Second derivatives of `sum s . e` for constant stresses `s`.
    fn curvature(&self, at: &Directions, stresses: &[Vector3; 3]) -> Second {
        let [a, b] = at.q;
        let seen = self.seen(at);
        let mut second = Second::default();
        let turning = |c: Vector3, v: Vector3| {
            let product = c * v.transpose();
            0.5 * (product + product.transpose()) - Matrix3::from_diagonal_element(product.trace())
        };
        for (k, q) in [a, b].into_iter().enumerate() {
            let c = stresses[k];
            let g = q * c;
            let beside = at.across * g;
            let outer = at.f * beside.transpose();
            let along = at.across * g.dot(&at.f) + outer + outer.transpose();
            second.0[0][0] -= along / (at.length * at.length);
            second.0[0][k + 1] -= at.across * q * c.cross_matrix() / at.length;
            second.0[k + 1][k + 1] += turning(c, seen[k]);
        }
        let (c, w) = (stresses[2], self.across[1]);
        let relative = a.transpose() * b;
        second.0[1][1] += turning(c, seen[2]);
        second.0[2][2] += turning(relative.tr_mul(&c), w);
        second.0[1][2] -= c.cross_matrix() * relative * w.cross_matrix();
        second
    }

    /// Adds the stiffness of the strains, and the geometric stiffness of `stresses`.
    fn push_stiffness(&self, state: &State, stresses: &[Vector3; 3], stiffness: &mut Stiffness) {
        let at = self.directions(state);
        let slopes = self.strain_slopes(&at);
        let mut second = self.curvature(&at, stresses);
        for (of, k) in slopes.iter().zip(self.stiffness) {
            for i in 0..3 {
                for j in i..3 {
                    second.0[i][j] += of[i].tr_mul(&of[j]) * k;
                }
            }
        }
        let bodies = self.slopes(state);
        for (k, first) in bodies.iter().enumerate() {
            for other in &bodies[k..] {
                let block = second.between(first, other);
                let (a, b) = (first.body, other.body);
                if std::ptr::eq(first, other) {
                    stiffness.push(a, a, 0.5 * (block + block.transpose()));
                } else if a == b {
                    // Both sites follow this body: block and transpose are on the diagonal.
                    stiffness.push(a, a, block + block.transpose());
                } else if first.is_second == other.is_second {
                    stiffness.push(a, b, block);
                } else {
                    stiffness.push_link(a, b, block);
                }
            }
        }
        let parts = slopes.iter().zip(stresses);
        let force: Vector3 = parts.map(|(of, stress)| of[0].tr_mul(stress)).sum();
        self.linker.push_curvature(force, state, stiffness);
    }

    fn slopes(&self, state: &State) -> Vec<Slopes> {
        let (zero, one) = (Matrix3::zeros(), Matrix3::identity());
        let mut all: Vec<Slopes> = Vec::new();
        for (k, slopes) in self.linker.slopes_of_ends(state).into_iter().enumerate() {
            let frame = Coordinates::Frame(self.frames[k]);
            let mut turned = [zero; 3];
            turned[k + 1] = one;
            let is_second = k == 1;
            for (body, slope) in slopes {
                let mut of = if body == frame { turned } else { [zero; 3] };
                of[0] = slope;
                all.push(Slopes {
                    body,
                    is_second,
                    of,
                });
            }
            if all.last().is_none_or(|last| last.body != frame) {
                all.push(Slopes {
                    body: frame,
                    is_second,
                    of: turned,
                });
            }
        }
        all
    }
}

impl Second {
    fn between(&self, first: &Slopes, other: &Slopes) -> Matrix3 {
        let mut block = Matrix3::zeros();
        for i in 0..3 {
            for j in 0..3 {
                let own = if i <= j {
                    self.0[i][j]
                } else {
                    self.0[j][i].transpose()
                };
                block += first.of[i].tr_mul(&own) * other.of[j];
            }
        }
        block
    }
}

fn vectors(stresses: &[f64]) -> [Vector3; 3] {
    std::array::from_fn(|k| Vector3::from_column_slice(&stresses[VECTOR * k..VECTOR * (k + 1)]))
}

impl Interaction for LinkerAngles {
    fn term(&self) -> &'static str {
        "linker"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        let stresses = self.stresses(&self.directions(state));
        self.add_stress(&stresses, 1.0, state, loads);
    }

    fn elements(&self) -> usize {
        1
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), 1, "a linker is one element");
        let at = self.directions(state);
        let parts = self.strains(&at).into_iter().zip(self.stiffness);
        energies[0] = parts
            .map(|(strain, k)| 0.5 * k * strain.norm_squared())
            .sum();
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl SecondOrder for LinkerAngles {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        let stresses = self.stresses(&self.directions(state));
        self.push_stiffness(state, &stresses, stiffness);
    }
}

impl RandomStress for LinkerAngles {
    fn components(&self) -> usize {
        VECTOR * self.stiffness.len()
    }

    fn draw(&self, _state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        for (own, k) in stresses.chunks_mut(VECTOR).zip(self.stiffness) {
            for stress in own {
                *stress *= (k * thermal_energy).sqrt();
            }
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let own = self.stresses(&self.directions(state));
        for (to, stress) in stresses.chunks_mut(VECTOR).zip(own) {
            to.copy_from_slice(stress.as_slice());
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        self.add_stress(&vectors(stresses), -1.0, state, loads);
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        let own = self.stresses(&self.directions(state));
        let random = vectors(stress.values);
        let rest = std::array::from_fn(|k| own[k] - random[k]);
        self.push_stiffness(state, &rest, stiffness);
    }
}
