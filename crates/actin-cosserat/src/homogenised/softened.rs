//! Potentials of altered rods.

use super::{Homogenised, OF_TWIST, Potential, SixVector, StrainRange};
use crate::RigidityFactors;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

impl Homogenised {
    /// Potential of a rod whose rigidities are multiplied by factors `f`, with the terms `T` of twist alone:
    ///
    /// ```text
    /// U(x) = f_twist T(x) + f_stretch (W - T)(x_i sqrt(f_i / f_stretch))
    /// ```
    ///
    /// Equal factors multiply the energy, as for softer bonds of the same shape. A smaller factor of one deformation
    /// moves the nonlinearity of the other terms to larger strains. `T` has hardly any rigidity at rest at zero
    /// temperature, so that a scaled twist would divide it by up to the square of the factor.
    pub(crate) fn softened(&'static self, factors: &RigidityFactors) -> &'static Self {
        // Leaked on purpose: see `sampled_filament`.
        static LAWS: Mutex<BTreeMap<(usize, [u64; 4]), &'static Homogenised>> =
            Mutex::new(BTreeMap::new());
        let bits = [factors.shear, factors.stretch, factors.bend, factors.twist].map(f64::to_bits);
        let mut laws = LAWS.lock().unwrap_or_else(PoisonError::into_inner);
        let law = laws.entry((std::ptr::from_ref(self) as usize, bits));
        law.or_insert_with(|| Box::leak(Box::new(self.with_factors(factors))))
    }

    fn with_factors(&self, factors: &RigidityFactors) -> Self {
        let RigidityFactors {
            shear,
            stretch,
            bend,
            twist,
        } = *factors;
        let mut coefficients = self
            .coefficients
            .map(|polynomial| polynomial.map(|coefficient| stretch * coefficient));
        for term in OF_TWIST.map(|term| term as usize) {
            coefficients[term] = self.coefficients[term].map(|coefficient| twist * coefficient);
        }
        let scales = [bend, twist, shear].map(|factor| (factor / stretch).sqrt());
        let [bend_scale, twist_scale, shear_scale] = scales;
        let range = StrainRange {
            // The terms of twist alone are not scaled: their data end at the same twist.
            twist: self.range.twist / twist_scale.max(1.0),
            curvature: self.range.curvature / bend_scale,
            shear: self.range.shear / shear_scale,
            ..self.range
        };
        Self {
            form: self.form.clone(),
            unrolled: Potential::new(&self.form, &coefficients, scales),
            scales: SixVector::new(
                bend_scale,
                bend_scale,
                twist_scale,
                shear_scale,
                shear_scale,
                1.0,
            ),
            twist_factor: twist,
            coefficients,
            range,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homogenised::tests::assert_derivatives;

    fn factors(shear: f64, stretch: f64, bend: f64, twist: f64) -> RigidityFactors {
        RigidityFactors {
            shear,
            stretch,
            bend,
            twist,
        }
    }

    /// Rounding of sums of about a hundred terms.
    #[test]
    fn equal_factors_multiply_the_energy() {
        let law = Homogenised::mean_filament();
        let half = law.softened(&factors(0.5, 0.5, 0.5, 0.5));
        let strain = SixVector::new(2e-3, -1e-3, 8e-3, 5e-3, 2e-3, 1e-3);
        let (whole, jet) = (law.jet(&strain), half.jet(&strain));
        assert!((jet.energy - 0.5 * whole.energy).abs() < 1e-13 * whole.energy);
        assert!((jet.loads - 0.5 * whole.loads).amax() < 1e-13 * whole.loads.amax());
        assert!((half.loads(&strain) - jet.loads).amax() < 1e-11 * jet.loads.amax());
    }

    #[test]
    fn a_factor_of_twist_multiplies_the_energy_and_the_couple_of_twist() {
        for law in [
            Homogenised::mean_filament(),
            Homogenised::heated_rod(10.0, 298.0).unwrap(),
        ] {
            let altered = law.softened(&factors(1.0, 1.0, 0.2, 0.1));
            for twist in [-0.02, -2e-3, 1e-4, 0.01] {
                let kappa = nalgebra::Vector3::z() * twist;
                let [whole, tenth] = [law, altered].map(|law| law.joint_energy(kappa));
                assert!(
                    (tenth / whole - 0.1).abs() < 1e-11,
                    "{twist}: {tenth}, {whole}"
                );
                let [whole, tenth] = [law, altered].map(|law| law.joint_couple(kappa).z);
                assert!(
                    (tenth / whole - 0.1).abs() < 1e-11,
                    "{twist}: {tenth}, {whole}"
                );
            }
        }
    }

    #[test]
    fn each_factor_multiplies_its_rigidity_at_rest() {
        for law in [
            Homogenised::mean_filament(),
            Homogenised::heated_rod(10.0, 298.0).unwrap(),
        ] {
            let rest = SixVector::ith(5, law.natural_stretch(0.0));
            let [shear, stretch, bend, twist] = [0.9, 0.7, 0.2, 0.1];
            let altered = law.softened(&factors(shear, stretch, bend, twist));
            let tangents = [law, altered].map(|law| law.tangent(&rest));
            let expected = [bend, bend, twist, shear, shear, stretch];
            for (k, factor) in expected.into_iter().enumerate() {
                let found = tangents[1][(k, k)] / tangents[0][(k, k)];
                // The natural length depends on the twist, with the rigidity of stretch.
                let is_twist = k == 2;
                assert!(
                    is_twist || (found / factor - 1.0).abs() < 1e-12,
                    "{k}: {found}"
                );
            }
            let joint =
                [law, altered].map(|law| law.joint_tangent(nalgebra::Vector3::zeros())[(2, 2)]);
            assert!((joint[1] / joint[0] / twist - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn loads_and_tangent_are_derivatives() {
        let law = Homogenised::mean_filament().softened(&factors(0.6, 0.8, 0.2, 0.1));
        assert_derivatives(law);
    }
}
