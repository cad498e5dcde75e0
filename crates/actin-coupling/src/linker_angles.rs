use crate::linker_ends::LinkerEnds;
use crate::site::{curvature_of_product, ensure};
use crate::{LinkerEnd, LinkerError, LinkerKey, Site};
use actin_mechanics::{Coordinates, Loads, Matrix3, State, Stiffness, Vector3};

/// Numbers per strain vector.
const VECTOR: usize = 3;

/// Stiffness of a linker between two sites against tilt and twist.
///
/// ```text
/// E = k_t |e_1|^2 / 2 + k_t |e_2|^2 / 2 + k_w |e_3|^2 / 2
/// e_i = Q_i^T f - m_i,   e_3 = Q_1^T Q_2 w - u
/// ```
///
/// `f` is the direction of the linker (lab frame), and `Q_i` are the frames of the two sites. `m_i` (body frames) are
/// the rest directions of the linker, and `u` and `w` are one direction across it. For the angles `a_1`, `a_2` between
/// the linker and its rest directions and `b` between the two filaments,
/// `E = k_t (2 - cos a_1 - cos a_2) + k_w (1 - cos b)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkerAngles {
    /// Stiffness of each strain vector (pN nm).
    stiffness: [f64; 3],
    rest: Rest,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Rest {
    /// Given directions.
    Given(Directions),
    /// The linker is normal to both filaments at its sites, and the filaments are parallel.
    Normal,
}

/// Rest directions in the frames of both sites.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Directions {
    along: [Vector3; 2],
    across: [Vector3; 2],
}

/// Angles of a linker at a state.
pub(crate) struct AnglesAt<'a> {
    ends: &'a LinkerEnds,
    state: &'a State,
    /// Frames of the two sites.
    frames: [usize; 2],
    stiffness: [f64; 3],
    rest: Directions,
    /// Length of the linker (nm).
    length: f64,
    /// Unit vector along the linker (lab frame).
    f: Vector3,
    /// Projection across the linker.
    projection: Matrix3,
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
    /// Components of the random stress.
    pub(crate) const COMPONENTS: usize = 3 * VECTOR;

    /// Stiffness against tilt at each end and against twist (pN nm) of a linker that is normal to both filaments at rest.
    ///
    /// The rest directions are the [normal](Site::with_normal) of the first site and the opposite of the normal of the
    /// second one. At rest the third axes of both frames are parallel.
    ///
    /// # Errors
    /// If a stiffness is negative or not finite.
    pub fn normal_to_sites((tilt, twist): (f64, f64)) -> Result<Self, LinkerError> {
        for (key, value) in [(LinkerKey::Tilt, tilt), (LinkerKey::Twist, twist)] {
            let holds = value.is_finite() && value >= 0.0;
            ensure(holds, key, value, "finite and not negative")?;
        }
        Ok(Self {
            stiffness: [tilt, tilt, twist],
            rest: Rest::Normal,
        })
    }

    /// See [`Linker::angles_as_built`](crate::Linker::angles_as_built).
    pub(crate) fn as_built(
        ends: &LinkerEnds,
        stiffness: (f64, f64),
        state: &State,
    ) -> Result<Self, LinkerError> {
        let angles = Self::normal_to_sites(stiffness)?;
        let length = ends.reach(state).norm();
        ensure(length > 0.0, LinkerKey::Length, length, "positive")?;
        let sites = sites(ends).ok_or(LinkerError::Angles)?;
        let q = sites.map(|site| state.frames.orientation.get(site.frame()));
        let f = ends.reach(state) / length;
        let beside = |axis: Vector3| {
            let lab = q[0] * axis;
            lab - f * f.dot(&lab)
        };
        // A filament along the linker has no projection of its tangent.
        let [tangent, other] = [Vector3::z(), Vector3::x()].map(beside);
        let across = if tangent.norm() > 0.5 { tangent } else { other }.normalize();
        let in_frames = |lab: Vector3| q.map(|q| q.inverse_transform_vector(&lab));
        let rest = Rest::Given(Directions {
            along: in_frames(f),
            across: in_frames(across),
        });
        Ok(Self { rest, ..angles })
    }

    /// Angles at a state; `None` within a monomer or segment, and for an anchor.
    pub(crate) fn at<'a>(&self, ends: &'a LinkerEnds, state: &'a State) -> Option<AnglesAt<'a>> {
        let sites = sites(ends)?;
        let d = ends.reach(state);
        // Linkers without length have no direction and no stiffness of tilt.
        let (f, length) = d
            .try_normalize(0.0)
            .map_or((Vector3::zeros(), f64::INFINITY), |f| (f, d.norm()));
        let frames = sites.map(Site::frame);
        let axes = |i| state.frames.orientation.get(i).to_rotation_matrix();
        Some(AnglesAt {
            ends,
            state,
            frames,
            stiffness: self.stiffness,
            rest: self.rest.directions(sites),
            length,
            f,
            projection: Matrix3::identity() - f * f.transpose(),
            q: frames.map(|i| axes(i).into_inner()),
        })
    }

    /// Scales deviates to random stresses.
    pub(crate) fn draw(&self, thermal_energy: f64, stresses: &mut [f64]) {
        for (own, k) in stresses.chunks_mut(VECTOR).zip(self.stiffness) {
            for stress in own {
                *stress *= (k * thermal_energy).sqrt();
            }
        }
    }
}

/// Sites of a linker in two different frames.
fn sites(ends: &LinkerEnds) -> Option<[&Site; 2]> {
    match &ends.end {
        LinkerEnd::Site(other) if other.frame() != ends.site.frame() => Some([&ends.site, other]),
        LinkerEnd::Site(_) | LinkerEnd::Anchor(_) => None,
    }
}

impl Rest {
    fn directions(self, [first, second]: [&Site; 2]) -> Directions {
        match self {
            Self::Given(directions) => directions,
            Self::Normal => Directions {
                along: [first.normal(), -second.normal()],
                across: [Vector3::z(); 2],
            },
        }
    }
}

impl AnglesAt<'_> {
    /// Energy (pN nm).
    pub(crate) fn energy(&self) -> f64 {
        let parts = self.strains().into_iter().zip(self.stiffness);
        parts
            .map(|(strain, k)| 0.5 * k * strain.norm_squared())
            .sum()
    }

    /// Force of stresses on the first site (pN, lab frame). The force on the second one is opposite.
    pub(crate) fn force(&self, stresses: &[Vector3; 3]) -> Vector3 {
        gradient(&self.strain_slopes(), stresses, 0)
    }

    /// Linker and rest direction across it, in the axes of the first, the second and the first frame.
    fn seen(&self) -> [Vector3; 3] {
        let [a, b] = self.q;
        let across = self.rest.across[1];
        [
            a.tr_mul(&self.f),
            b.tr_mul(&self.f),
            a.tr_mul(&(b * across)),
        ]
    }

    /// Strain vectors.
    fn strains(&self) -> [Vector3; 3] {
        let [first, second, beside] = self.seen();
        let Directions { along, across } = &self.rest;
        [first - along[0], second - along[1], beside - across[0]]
    }

    /// Stresses of the strains (pN nm).
    pub(crate) fn stresses(&self) -> [Vector3; 3] {
        let strains = self.strains();
        std::array::from_fn(|k| strains[k] * self.stiffness[k])
    }

    /// Derivatives of each strain vector with respect to the linker vector and both rotations (body axes).
    fn strain_slopes(&self) -> [[Matrix3; 3]; 3] {
        let [a, b] = self.q;
        let [first, second, beside] = self.seen();
        let zero = Matrix3::zeros();
        let by_vector = |q: Matrix3| q.transpose() * self.projection / self.length;
        let turned = -(a.transpose() * b * self.rest.across[1].cross_matrix());
        [
            [by_vector(a), first.cross_matrix(), zero],
            [by_vector(b), zero, second.cross_matrix()],
            [zero, beside.cross_matrix(), turned],
        ]
    }

    /// Adds the loads `-sum s . de/dq` of stresses `s`, times `sign`.
    pub(crate) fn add_stress(&self, stresses: &[Vector3; 3], sign: f64, loads: &mut Loads) {
        let slopes = self.strain_slopes();
        let force = gradient(&slopes, stresses, 0) * sign;
        self.ends.add_force(force, self.state, loads);
        for (k, frame) in self.frames.into_iter().enumerate() {
            let torque = gradient(&slopes, stresses, k + 1) * -sign;
            loads.torque.add(frame, torque);
        }
    }

    /// Second derivatives of `sum s . e` for constant stresses `s`.
    fn curvature(&self, stresses: &[Vector3; 3]) -> Second {
        let [a, b] = self.q;
        let seen = self.seen();
        let mut second = Second::default();
        for (k, q) in [a, b].into_iter().enumerate() {
            let c = stresses[k];
            let g = q * c;
            let beside = self.projection * g;
            let outer = self.f * beside.transpose();
            let along = self.projection * g.dot(&self.f) + outer + outer.transpose();
            second.0[0][0] -= along / (self.length * self.length);
            second.0[0][k + 1] -= self.projection * q * c.cross_matrix() / self.length;
            second.0[k + 1][k + 1] += curvature_of_product(c, seen[k]);
        }
        let (c, w) = (stresses[2], self.rest.across[1]);
        let relative = a.transpose() * b;
        second.0[1][1] += curvature_of_product(c, seen[2]);
        second.0[2][2] += curvature_of_product(relative.tr_mul(&c), w);
        second.0[1][2] -= c.cross_matrix() * relative * w.cross_matrix();
        second
    }

    /// Adds the stiffness of the strains, and the geometric stiffness of `stresses`.
    pub(crate) fn push_stiffness(&self, stresses: &[Vector3; 3], stiffness: &mut Stiffness) {
        let slopes = self.strain_slopes();
        let mut second = self.curvature(stresses);
        for (of, k) in slopes.iter().zip(self.stiffness) {
            for i in 0..3 {
                for j in i..3 {
                    second.0[i][j] += of[i].tr_mul(&of[j]) * k;
                }
            }
        }
        let bodies = self.slopes();
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
        let force = gradient(&slopes, stresses, 0);
        self.ends.push_curvature(force, self.state, stiffness);
    }

    fn slopes(&self) -> Vec<Slopes> {
        let (zero, one) = (Matrix3::zeros(), Matrix3::identity());
        let mut all: Vec<Slopes> = Vec::new();
        for (k, slopes) in self.ends.slopes_of_ends(self.state).into_iter().enumerate() {
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

/// Sum `s . de/dq` of all strain vectors for one variable: the linker vector or a rotation.
fn gradient(slopes: &[[Matrix3; 3]; 3], stresses: &[Vector3; 3], variable: usize) -> Vector3 {
    let parts = slopes.iter().zip(stresses);
    parts.map(|(of, stress)| of[variable].tr_mul(stress)).sum()
}

/// Components of a random stress as three vectors.
pub(crate) fn vectors(stresses: &[f64]) -> [Vector3; 3] {
    std::array::from_fn(|k| Vector3::from_column_slice(&stresses[VECTOR * k..VECTOR * (k + 1)]))
}

pub(crate) fn write_vectors(from: &[Vector3; 3], stresses: &mut [f64]) {
    for (to, stress) in stresses.chunks_mut(VECTOR).zip(from) {
        to.copy_from_slice(stress.as_slice());
    }
}
