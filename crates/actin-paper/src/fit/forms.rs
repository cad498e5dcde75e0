//! The laws of rods as models to fit: values, and derivatives with respect to the parameters.

use actin_cosserat::{RootedStretch, SidedTwist, Stiffening, StretchLaw, TanhTwist, TwistRise};
use actin_fit::Model;

type ToLaw<L> = Box<dyn Fn(&[f64]) -> L>;

/// A law of one variable with `N` fitted parameters.
pub(super) struct LawForm<L, const N: usize> {
    /// Law with these parameters.
    pub law: ToLaw<L>,
    pub value: fn(&L, f64) -> f64,
    /// Derivatives of the value with respect to the parameters.
    gradient: fn(&L, f64) -> [f64; N],
}

impl<L, const N: usize> Model for LawForm<L, N> {
    fn parameters(&self) -> usize {
        N
    }

    fn value(&self, x: &[f64], p: &[f64]) -> f64 {
        (self.value)(&(self.law)(p), x[0])
    }

    fn gradient(&self, x: &[f64], p: &[f64], gradient: &mut [f64]) {
        gradient.copy_from_slice(&(self.gradient)(&(self.law)(p), x[0]));
    }
}

impl LawForm<TanhTwist, 7> {
    /// Published form of B3 against twist with fixed limits: `lambda_1` to `lambda_7`.
    pub(super) fn tanh(limits: TanhTwist) -> Self {
        let law = move |p: &[f64]| {
            let mut law = limits;
            law.lambda.copy_from_slice(p);
            law
        };
        Self {
            law: Box::new(law),
            value: TanhTwist::secant,
            gradient: |law, k| {
                let [_, _, lambda @ ..] = law.secant_gradient(k);
                lambda
            },
        }
    }
}

impl LawForm<SidedTwist, 7> {
    /// B3 against twist, saturating separately in under-twist and over-twist: `rest`, then `rise`,
    /// `half` and `slow` of each side.
    pub(super) fn sided(range: f64) -> Self {
        let side = |p: &[f64]| TwistRise {
            rise: p[0],
            half: p[1],
            slow: p[2],
        };
        let law = move |p: &[f64]| SidedTwist {
            rest: p[0],
            under: side(&p[1..4]),
            over: side(&p[4..7]),
            range,
        };
        Self {
            law: Box::new(law),
            value: SidedTwist::secant,
            gradient: SidedTwist::secant_gradient,
        }
    }
}

impl LawForm<RootedStretch, 4> {
    /// `xi - 1` against twist with two slopes: `slope`, `bend`, `half`, `cubic`.
    pub(super) fn rooted(range: f64) -> Self {
        let law = move |p: &[f64]| RootedStretch {
            slope: p[0],
            bend: p[1],
            half: p[2],
            cubic: p[3],
            range,
        };
        Self {
            law: Box::new(law),
            value: |law, k| law.jet(k)[0],
            gradient: RootedStretch::gradient,
        }
    }
}

impl LawForm<Stiffening, 3> {
    /// Bending rigidity against curvature: `rest`, `rise` and the curvature at half the rise.
    pub(super) fn stiffened(range: f64) -> Self {
        let law = move |p: &[f64]| Stiffening {
            rest: p[0],
            rise: p[1],
            curvature: p[2],
            twist: f64::INFINITY,
            shear: f64::INFINITY,
            range,
        };
        Self {
            law: Box::new(law),
            value: |law, k| law.secant(k, 0.0),
            gradient: Stiffening::secant_gradient,
        }
    }
}

impl LawForm<StretchLaw, 3> {
    /// Strain against axial force: `tension`, `compression` and `width` of the law.
    pub(super) fn stretched() -> Self {
        let law = |p: &[f64]| StretchLaw::Sided {
            tension: p[0],
            compression: p[1],
            width: p[2],
        };
        Self {
            law: Box::new(law),
            value: strain,
            gradient: strain_gradient,
        }
    }
}

/// Strain at a force: root of a quadratic equation, refined by one Newton step against cancellation.
fn strain(law: &StretchLaw, force: f64) -> f64 {
    let (tension, compression, width) = match *law {
        StretchLaw::Constant { rigidity } => return force / rigidity,
        StretchLaw::Sided {
            tension,
            compression,
            width,
        } => (tension, compression, width),
    };
    let (mean, half) = (0.5 * (tension + compression), 0.5 * (tension - compression));
    let shifted = mean * (force + half * width);
    let squared = (mean * width).powi(2) + force * (force + 2.0 * half * width);
    let root = (shifted - half * squared.max(0.0).sqrt()) / (tension * compression);
    root - (law.force(root) - force) / law.tangent(root)
}

/// `de/dp = -(dF/dp) / (dF/de)` at the strain of the force.
fn strain_gradient(law: &StretchLaw, force: f64) -> [f64; 3] {
    let StretchLaw::Sided {
        tension,
        compression,
        width,
    } = *law
    else {
        return [0.0; 3];
    };
    let strain = strain(law, force);
    let root = strain.hypot(width);
    let bent = strain * strain / (root + width);
    let by = [
        0.5 * (strain + bent),
        0.5 * (strain - bent),
        0.5 * (tension - compression) * (width / root - 1.0),
    ];
    let tangent = law.tangent(strain);
    by.map(|by| -by / tangent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_fit::{Data, Observations, check_gradient};

    /// The force at the strain of a force equals that force to rounding.
    #[test]
    fn strains_of_forces() {
        let form = LawForm::stretched();
        for p in [[3e4, 1.5e4, 1e-3], [1e4, 2e4, 1e-4], [2e4, 2e4, 1e-3]] {
            for force in [-500.0, -20.0, -1.0, -1e-3, 0.0, 1e-6, 0.1, 5.0, 300.0] {
                let strain = form.value(&[force], &p);
                let borne = (form.law)(&p).force(strain);
                assert!(
                    (borne - force).abs() <= 1e-13 * f64::abs(force),
                    "{p:?} {force} {borne}"
                );
            }
        }
    }

    #[test]
    fn gradient_of_the_strain() {
        let x = [-50.0, -3.0, 1.0, 20.0];
        let data = Data::new(&x, Observations::new(&[0.0; 4]).unwrap()).unwrap();
        let check = check_gradient(&LawForm::stretched(), &data, &[3e4, 1.5e4, 1e-3]).unwrap();
        assert!(check.error < 1e-9, "{check:?}");
    }
}
