//! Random stress of junctions: a force and two torques per bond.
//!
//! The stress of a bond with strain `sigma` and curvatures `kappa_E`, `kappa_C` has the energy
//!
//! ```text
//! -(|lhat| n . sigma + D_E m_E . kappa_E + D_C m_C . kappa_C)
//! ```
//!
//! If the law of the rod couples strain and curvature, the random stress of the rod covers also the
//! half of the end segment beyond the last frame. The junction then excludes this half: for `b`
//! bonds of weight `w` and a segment of length `L`, the covariance of `D_C m_C` is kT times the
//! bending tangent times the positive matrix
//!
//! ```text
//! w D_C on the diagonal, minus L / (2 b^2) in all entries
//! ```
//!
//! The difference between random and elastic stress exerts the torques about the frame axes of the
//! rest state. Otherwise displacements would change these torques and bend filaments further in
//! long time steps.

use crate::Junction;
use crate::bond::Bond;
use actin_mechanics::{
    InternalCouple, InternalForce, Loads, Matrix3, RandomStress, SecondOrder, State, StepStress,
    Stiffness, Vector3, correlate,
};

/// Vectors per bond: force, torque at the monomer, torque at the rod.
const OF_BOND: usize = 3;
/// Components of a vector.
const VECTOR: usize = 3;

fn drawn(c: Matrix3, deviates: [f64; VECTOR]) -> Vector3 {
    let mut values = deviates;
    correlate(c, &mut values);
    values.into()
}

impl Bond {
    fn internal(
        &self,
        [force, end, centre]: [Vector3; OF_BOND],
    ) -> (InternalForce, [InternalCouple; 2]) {
        let offsets = self.offsets();
        // The chain starts at the monomer or at the rod.
        let couples = if self.monomer == 0 {
            [end, centre]
        } else {
            [centre, end]
        };
        let couple = |k: usize| {
            let [a, b] = [offsets[k], offsets[k + 1]];
            InternalCouple {
                frames: [self.frames[k], self.frames[k + 1]],
                // The strain log((Qa oa)^T Qb ob) in other axes: log(ob oa^T Qa^T Qb) = ob log(...).
                rest: a * b.inverse(),
                couple: b * couples[k],
            }
        };
        let force = InternalForce {
            points: self.points,
            frame: self.junction(),
            force,
        };
        (force, [couple(0), couple(1)])
    }
}

impl Junction {
    /// Half of the end segment (nm) if the stress of the rod includes it, else 0.
    fn covered(&self) -> f64 {
        if self.is_covered {
            self.half_segment
        } else {
            0.0
        }
    }

    /// Lower triangle of the Cholesky factor of the matrix in the module documentation.
    fn factor(&self) -> [[f64; 2]; 2] {
        let n = self.bonds.len() as f64;
        let shared = self.covered() / (n * n);
        let length = |k: usize| {
            self.bonds
                .get(k)
                .map_or(0.0, |b| self.weight * b.towards_rod().0.rest_distance)
        };
        let first = (length(0) - shared).sqrt();
        let Some(_) = self.bonds.get(1) else {
            return [[first, 0.0], [0.0, 0.0]];
        };
        let below = -shared / first;
        [
            [first, 0.0],
            [below, (length(1) - shared - below * below).sqrt()],
        ]
    }

    /// Mean curvature (rad/nm) of the elements at the rod, including the rest curvature of the rod.
    fn curvature_of_rod(&self, state: &State) -> Vector3 {
        let of = |bond: &Bond| bond.curvature_towards_rod(state) + bond.curvature_difference;
        self.bonds.iter().map(of).sum::<Vector3>() / self.bonds.len() as f64
    }

    fn own(&self, bond: &Bond, state: &State) -> [Vector3; OF_BOND] {
        let (_, of_end) = bond.towards_monomer();
        let (_, of_rod) = bond.towards_rod();
        [
            self.material.shear_force(bond.strain(state)),
            of_end.bending_couple(bond.curvature_towards_monomer(state)),
            of_rod.bending_couple(bond.curvature_towards_rod(state)),
        ]
        .map(|stress| stress * self.weight)
    }
}

fn written(stresses: &[f64]) -> impl Iterator<Item = [Vector3; OF_BOND]> + '_ {
    let (vectors, _) = stresses.as_chunks::<VECTOR>();
    let (vectors, _) = vectors.as_chunks::<OF_BOND>();
    vectors.iter().map(|vectors| vectors.map(Vector3::from))
}

impl RandomStress for Junction {
    fn components(&self) -> usize {
        OF_BOND * VECTOR * self.bonds.len()
    }

    fn draw(&self, state: &State, thermal_energy: f64, stresses: &mut [f64]) {
        let (vectors, _) = stresses.as_chunks_mut::<VECTOR>();
        let (vectors, _) = vectors.as_chunks_mut::<OF_BOND>();
        let kt = thermal_energy;
        let factor = self.factor();
        let tangent = self.material.bending_tangent(self.curvature_of_rod(state));
        let towards_rod: Vec<Vector3> = vectors.iter().map(|v| drawn(tangent * kt, v[2])).collect();
        for (b, (bond, vectors)) in self.bonds.iter().zip(vectors).enumerate() {
            let (element, material) = bond.towards_monomer();
            let end = bond.curvature_towards_monomer(state);
            let shear = self.material.shear_tangent(bond.strain(state));
            let of = |tangent: Matrix3, length: f64| tangent * (self.weight * kt / length);
            let couple: Vector3 = towards_rod.iter().zip(factor[b]).map(|(v, f)| v * f).sum();
            let (rod, _) = bond.towards_rod();
            *vectors = [
                drawn(of(shear, bond.shear.rest_length), vectors[0]),
                drawn(
                    of(material.bending_tangent(end), element.rest_distance),
                    vectors[1],
                ),
                couple / rod.rest_distance,
            ]
            .map(Into::into);
        }
    }

    fn balance(&self, state: &State, stresses: &mut [f64]) {
        let (vectors, _) = stresses.as_chunks_mut::<VECTOR>();
        let (vectors, _) = vectors.as_chunks_mut::<OF_BOND>();
        let n = self.bonds.len() as f64;
        let couple = self.material.bending_couple(self.curvature_of_rod(state));
        let by_rod = couple * (self.covered() / n);
        for (bond, vectors) in self.bonds.iter().zip(vectors) {
            let [force, end, centre] = self.own(bond, state);
            let (element, _) = bond.towards_rod();
            let left = centre - by_rod / element.rest_distance;
            *vectors = [force, end, left].map(Into::into);
        }
    }

    fn add_stress_loads(&self, state: &State, stresses: &[f64], loads: &mut Loads) {
        for (bond, stress) in self.bonds.iter().zip(written(stresses)) {
            let own = self.own(bond, state);
            let left = [0, 1, 2].map(|k| stress[k] - own[k]);
            let (force, couples) = bond.internal(left);
            let shear = &bond.shear;
            let rest = shear.rest_direction * shear.rest_length;
            force.add_loads_without_spin(rest, state, loads);
            for couple in couples {
                couple.add_loads_without_spin(state, loads);
            }
            let (force, couples) = bond.internal(own);
            force.add_loads(state, loads);
            for couple in couples {
                couple.add_loads(state, loads);
            }
        }
    }

    fn add_stressed_stiffness(
        &self,
        state: &State,
        stress: &StepStress<'_>,
        stiffness: &mut Stiffness,
    ) {
        self.add_stiffness(state, stiffness);
        for (bond, stress) in self.bonds.iter().zip(written(stress.values)) {
            let (force, couples) = bond.internal(stress);
            force.add_stiffness(state, stiffness);
            for couple in couples {
                couple.add_stiffness(state, stiffness);
            }
        }
    }
}
