//! Stability of twist under axial force.

use super::SegmentLaw;
use crate::material::Kind;
use crate::{RodMaterial, StrainLaws};
use actin_mechanics::Vector3;

/// Stability of a segment's twist under axial force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwistStability {
    /// Axial force `N` (pN), negative in compression.
    pub tension: f64,
    /// Derivative of the torque about d3 with respect to twist at constant `N`, bending and shear
    /// (pN nm^2). Twist is unstable if this derivative is not positive.
    pub tangent: f64,
}

/// Stability of twist under an axial force `N`.
///
/// ```text
/// M = dU/dkappa_3 - N xi'(kappa_3)
/// stable:  d2U/dkappa_3^2 - N xi''(kappa_3) > 0
/// ```
///
/// `M` is the torque about d3, `U` the energy of bending and twist per length, and `xi` the natural
/// length. The Legendre-Hadamard condition of the energy in twist and stretch is equivalent. If it
/// fails, short-wave perturbations of the twist grow without work at the ends.
impl SegmentLaw {
    /// Axial force (pN, negative in compression) at which twist becomes unstable:
    /// `d2U/dkappa_3^2 / xi''(kappa_3)`.
    ///
    /// For `xi'' < 0`, as in the published and fitted laws near rest, twist is unstable in stronger
    /// compression; for `xi'' > 0`, under larger tension. Returns `None` if `xi'' = 0`, or if twist
    /// is unstable without axial force. For a potential, this is the smallest force at which the
    /// tangent vanishes within a stretch of 0.02.
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial, SegmentLaw, TanhTwist, TwistLaw, TwistStretch};
    /// use actin_mechanics::Vector3;
    /// let twist = TwistLaw::Tanh(TanhTwist::published());
    /// let material = RodMaterial::new(Rigidities::table4())?.with_twist(twist)?;
    /// let law = SegmentLaw::from_material(&material, Some(TwistStretch::published())).unwrap();
    /// // B3(0) = 566 pN nm^2 over xi''(0) = -2 x 20.508 nm^2.
    /// let rest = Vector3::zeros();
    /// let critical = law.critical_tension(&material, rest, rest).unwrap();
    /// assert!((critical + 13.80).abs() < 0.02);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    pub fn critical_tension(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        kappa: Vector3,
    ) -> Option<f64> {
        let kappa = kappa - material.rest_curvature();
        let laws = match material.kind() {
            Kind::Laws(laws) => laws,
            Kind::Potential(law) => return law.critical_tension(sigma, kappa),
        };
        let [.., second] = self.extension(kappa.z);
        let free = self.free_tangent(laws, sigma, kappa);
        (second != 0.0 && free > 0.0).then(|| free / second)
    }

    /// Axial force and tangent of twist at strain `sigma` and mean curvature `kappa`.
    ///
    /// For a potential, [`critical_tension`](Self::critical_tension) costs several hundred times
    /// more.
    pub fn twist_stability(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        kappa: Vector3,
    ) -> TwistStability {
        let [tension, tangent] = self.tension_and_tangent(material, sigma, kappa);
        TwistStability { tension, tangent }
    }

    /// [`TwistStability::tangent`] alone (pN nm^2).
    pub fn twist_tangent(&self, material: &RodMaterial, sigma: Vector3, kappa: Vector3) -> f64 {
        self.tension_and_tangent(material, sigma, kappa)[1]
    }

    fn tension_and_tangent(
        &self,
        material: &RodMaterial,
        sigma: Vector3,
        kappa: Vector3,
    ) -> [f64; 2] {
        let kappa = kappa - material.rest_curvature();
        let laws = match material.kind() {
            Kind::Laws(laws) => laws,
            Kind::Potential(law) => return law.tension_and_twist_tangent(sigma, kappa),
        };
        let [extension, _, second] = self.extension(kappa.z);
        let (strain, ..) = laws.length_strain(sigma);
        let tension = laws.stretch().force(strain - extension);
        [
            tension,
            self.free_tangent(laws, sigma, kappa) - tension * second,
        ]
    }

    fn free_tangent(&self, material: &StrainLaws, sigma: Vector3, kappa: Vector3) -> f64 {
        let tangent = material.bending_tangent(kappa) + self.shear_by_curvature(sigma, kappa);
        tangent[(2, 2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extended::MeanCurvature;
    use crate::{
        BendLaw, CubicShear, Rigidities, RootedStretch, SidedTwist, Stiffening, StretchLaw,
        TanhTwist, TwistLaw, TwistRise, TwistStretch,
    };
    use actin_mechanics::Xorshift;
    use actin_mechanics::testing::derivative;

    fn published() -> (RodMaterial, SegmentLaw) {
        let material = RodMaterial::new(Rigidities::table4())
            .and_then(|m| m.with_twist(TwistLaw::Tanh(TanhTwist::published())))
            .unwrap();
        let law = SegmentLaw::from_material(&material, Some(TwistStretch::published()));
        (material, law.unwrap())
    }

    fn sided(cubic: bool) -> (RodMaterial, SegmentLaw) {
        let bend = Stiffening {
            rest: 3.2e4,
            rise: 8.1e3,
            curvature: 2.8e-3,
            twist: 2.9e-3,
            shear: 9.9e-3,
            range: 0.015,
        };
        let rise = |rise, half| TwistRise {
            rise,
            half,
            slow: 0.018,
        };
        let twist = SidedTwist {
            rest: 226.0,
            under: rise(1.3e4, 8.7e-3),
            over: rise(2.3e4, 1.1e-2),
            range: 0.0472,
        };
        let stretch = StretchLaw::Sided {
            tension: 3.3e4,
            compression: 1.6e4,
            width: 1e-3,
        };
        let shear = CubicShear {
            linear: [0.0, 0.0],
            cubic: 8.3e5,
        };
        let mut material = RodMaterial::new(Rigidities::table4())
            .and_then(|m| m.with_bend(BendLaw::Stiffening(bend)))
            .and_then(|m| m.with_twist(TwistLaw::Sided(twist)))
            .and_then(|m| m.with_stretch(stretch))
            .unwrap();
        if cubic {
            material = material.with_shear(shear).unwrap();
        }
        let law = SegmentLaw::from_material(&material, Some(TwistStretch::Rooted(ROOTED)));
        (material, law.unwrap())
    }

    const ROOTED: RootedStretch = RootedStretch {
        slope: -0.29,
        bend: 0.46,
        half: 6.6e-3,
        cubic: 27.6,
        range: 0.0472,
    };

    fn strain_under(
        (material, law): &(RodMaterial, SegmentLaw),
        [shear_1, shear_2, tension]: [f64; 3],
        kappa: Vector3,
    ) -> Vector3 {
        let at = |sigma_3: f64| Vector3::new(shear_1, shear_2, sigma_3);
        // Bisection to round-off; the force is monotonic in the strain.
        let (mut low, mut high) = (-0.5, 0.5);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let found = law.twist_stability(material, at(middle), kappa).tension;
            (low, high) = if found < tension {
                (middle, high)
            } else {
                (low, middle)
            };
        }
        at(low)
    }

    #[test]
    fn tangent_is_the_slope_of_the_couple_at_constant_force() {
        let mut noise = Xorshift::new(21);
        for parts in [published(), sided(false), sided(true)] {
            for _ in 0..30 {
                let twist = 0.04 * noise.sample();
                let kappa = Vector3::new(0.01 * noise.sample(), 0.01 * noise.sample(), twist);
                let (g1, g2) = (0.02 * noise.sample(), 0.02 * noise.sample());
                let tension = 100.0 * noise.sample();
                let (material, law) = &parts;
                let couple = |tension: f64, h: f64| {
                    let kappa = kappa + Vector3::z() * h;
                    let sigma = strain_under(&parts, [g1, g2, tension], kappa);
                    let (_, couple) = law.loads(material, sigma, MeanCurvature::inside(kappa));
                    couple.z + material.bending_couple(kappa).z
                };
                let critical = law.critical_tension(material, Vector3::new(g1, g2, 0.0), kappa);
                let [.., second] = law.extension(twist);
                let free = critical.unwrap() * second;
                // Round-off of a torque of about 100 pN nm over steps of 1e-5 rad/nm.
                let slope = derivative(1e-5, |h| couple(tension, h));
                let bound = 1e-6 * 1e4;
                assert!((free - tension * second - slope).abs() < bound, "{kappa}");
                let slope = derivative(1e-5, |h| couple(critical.unwrap(), h));
                if critical.unwrap().abs() < 1e3 {
                    assert!(slope.abs() < bound, "{kappa}: {slope}");
                }
            }
        }
    }

    #[test]
    fn a_state_is_unstable_beyond_its_bound() {
        for parts in [published(), sided(true)] {
            let (material, law) = &parts;
            for twist in [0.0, 2e-3, -4e-3] {
                let kappa = Vector3::z() * twist;
                let rest = Vector3::zeros();
                let bound = -law.critical_tension(material, rest, kappa).unwrap();
                for (share, stable) in [(0.5, true), (0.999, true), (1.001, false), (3.0, false)] {
                    let sigma = strain_under(&parts, [0.0, 0.0, -share * bound], kappa);
                    let state = law.twist_stability(material, sigma, kappa);
                    assert_eq!(state.tangent > 0.0, stable, "{twist}, {share}");
                    let critical = law.critical_tension(material, sigma, kappa).unwrap();
                    assert!((critical + bound).abs() < 1e-12 * bound);
                }
            }
        }
    }

    #[test]
    fn a_linear_law_of_length_has_no_bound() {
        let (material, law) = published();
        let rest = Vector3::zeros();
        let beyond = Vector3::z() * 0.06;
        assert_eq!(law.critical_tension(&material, rest, beyond), None);
        let linear = TwistStretch::linear(9.35e3, 3.4e4);
        let law = SegmentLaw::from_material(&material, Some(linear)).unwrap();
        assert_eq!(law.critical_tension(&material, rest, rest), None);
        let pressed = law.twist_stability(&material, Vector3::z() * -0.01, rest);
        assert!(pressed.tangent > 0.0 && pressed.tension < -300.0);
    }

    #[test]
    fn tension_can_soften_twist() {
        let (material, law) = sided(true);
        let (rest, kappa) = (Vector3::zeros(), Vector3::z() * 0.04);
        let critical = law.critical_tension(&material, rest, kappa).unwrap();
        assert!(critical > 0.0);
    }
}
