//! Potential of all six strains, fitted to periodic cells of monomers.
//!
//! Form: `terms.rs` and `polynomial.rs`. Coefficients: `mean_filament.rs`, in a heat
//! bath `heated.rs`. Elements of rods:
//! `joint.rs` and `segment.rs`.

mod heated;
mod joint;
mod mean_filament;
mod polynomial;
mod segment;
mod softened;
mod terms;
mod twist_stability;

pub use mean_filament::StrainRange;
pub use terms::Term;

pub(crate) use polynomial::{Polynomial, TWIST_SIZE};
pub(crate) use terms::{BENT, CURVATURE, EXTENSION, SHEAR, SLACK, TIGHT};

use crate::RodParameterError;
use crate::fast::{Law, Potential};
use actin_mechanics::wide::Scalar;
use nalgebra::{Matrix6, Vector6};
use polynomial::{DEGREE, bounded_twist, polynomial, value_of};
pub(crate) use segment::STRAIGHT;
use segment::joined;
use terms::{BY_TWIST, InvariantJet, Invariants, Jet, TermSum, Variables, values};

/// Strains `kappa_1`, `kappa_2`, `kappa_3` (rad/nm), `sigma_1`, `sigma_2`, `sigma_3`, or torques
/// (pN nm) and forces (pN), body axes.
type SixVector = Vector6<f64>;

/// Search for the stretch without tension: number of steps, largest step and tolerance (stretch), and
/// lower bound of the stiffness, relative to the stiffness of the straight rod.
const FREE_STEPS: usize = 30;
const LARGEST_FREE_STEP: f64 = 2e-3;
const FREE_TOLERANCE: f64 = 1e-7;
const SOFTEST_STRETCH: f64 = 0.03;

/// Invariants of the strains, with the natural length of the straight rod.
///
/// ```text
/// e = sigma_3 - n(kappa_3),  n = rest + kappa_3 p(t),  t = kappa_3 / sqrt(kappa_3^2 + 0.02^2)
/// a = kappa_1^2 + kappa_2^2
/// g = sigma_1^2 + sigma_2^2
/// c = kappa_1 sigma_1 + kappa_2 sigma_2
/// ```
///
/// `n` is the stretch of the straight rod without force, `p` a polynomial. The invariants are
/// complete for rods that are isotropic about their axis and symmetric under reversal.
#[derive(Clone, Debug, PartialEq)]
pub struct HomogenisedForm {
    rest: f64,
    natural: Polynomial,
}

/// Potential `W = sum_k P_k(t) f_k(e, a, g, c, kappa_3)` per length (pN).
///
/// `f_k` are the [`Term`]s, `P_k` polynomials in the bounded twist `t`. Derivatives are exact.
/// Outside the range of the data the law remains finite but inaccurate.
///
/// ```
/// use actin_cosserat::{Homogenised, HomogenisedForm, Term};
/// // S3 = 3.4e4 pN and B = 3e4 pN nm^2 at any twist; over-twist shortens.
/// let form = HomogenisedForm::new(&[-0.28])?;
/// let law = Homogenised::new(form, |term| match term {
///     Term::AnyStretch => vec![1.7e4],
///     Term::AnyBend => vec![1.5e4],
///     _ => vec![],
/// })?;
/// let loads = law.loads(&[1e-3, 0.0, 0.01, 0.0, 0.0, 0.0].into());
/// assert!((loads[0] - 30.0).abs() < 1e-9);
/// assert!((loads[5] - 3.4e4 * 0.0028).abs() < 1e-9);
/// # Ok::<(), actin_cosserat::RodParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Homogenised {
    form: HomogenisedForm,
    coefficients: [Polynomial; Term::ALL.len()],
    range: StrainRange,
    /// Factors of the strains in all terms except [`OF_TWIST`]; 1 by default, and always for stretch.
    scales: SixVector,
    /// Factor of the twisting rigidity; 1 by default.
    twist_factor: f64,
    /// Same coefficients, in a form for first derivatives.
    unrolled: Potential,
}

/// Value and derivatives of a potential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PotentialJet {
    /// Energy per rest length (pN).
    pub energy: f64,
    /// Gradient: torques (pN nm) and forces (pN).
    pub loads: SixVector,
    /// Second derivatives, symmetric.
    pub tangent: Matrix6<f64>,
}

fn padded(coefficients: &[f64], most: usize) -> Result<Polynomial, RodParameterError> {
    let refused = |value, rule| RodParameterError {
        key: "coefficients",
        value,
        rule,
    };
    if coefficients.len() > most {
        let count = coefficients.len() as f64;
        return Err(refused(count, "at most one more than the degree"));
    }
    if let Some(value) = coefficients.iter().find(|value| !value.is_finite()) {
        return Err(refused(*value, "finite"));
    }
    let mut polynomial = Polynomial::default();
    polynomial[..coefficients.len()].copy_from_slice(coefficients);
    Ok(polynomial)
}

impl HomogenisedForm {
    /// Creates the form with the coefficients of the natural length, lowest order first.
    ///
    /// # Errors
    /// If there are more than ten coefficients, or if one is not finite.
    pub fn new(natural: &[f64]) -> Result<Self, RodParameterError> {
        let natural = padded(natural, DEGREE + 1)?;
        Ok(Self { rest: 0.0, natural })
    }

    /// Sets the stretch without twist and force, as due to temperature.
    ///
    /// # Errors
    /// If `rest` is not finite and above -1.
    pub fn with_rest(self, rest: f64) -> Result<Self, RodParameterError> {
        if !(rest.is_finite() && rest > -1.0) {
            return Err(RodParameterError {
                key: "coefficients",
                value: rest,
                rule: "finite and above -1",
            });
        }
        Ok(Self { rest, ..self })
    }

    /// Stretch of the straight rod without twist and force.
    pub fn rest(&self) -> f64 {
        self.rest
    }

    /// Derivatives of the natural length with respect to its coefficients, at a twist (rad/nm).
    pub fn natural_units(twist: f64) -> [f64; DEGREE + 1] {
        let [t, ..] = bounded_twist(twist);
        let mut unit = twist;
        std::array::from_fn(|_| {
            let this = unit;
            unit *= t;
            this
        })
    }

    /// Coefficients of the natural length, lowest order first.
    pub fn natural(&self) -> &[f64] {
        &self.natural
    }

    /// Stretch of the straight rod without force at a twist (rad/nm).
    pub fn natural_stretch(&self, twist: f64) -> f64 {
        let [t, ..] = bounded_twist(twist);
        self.rest + twist * value_of(&self.natural, t)
    }

    fn natural_jet(&self, twist: f64) -> Jet {
        let [p, slope, bend] = polynomial(&self.natural, bounded_twist(twist));
        let value = self.rest + twist * p;
        [value, p + twist * slope, 2.0 * slope + twist * bend]
    }

    /// Derivatives of the potential with respect to the coefficients of `term`, lowest order first.
    /// The potential is linear in its coefficients.
    pub fn units(&self, term: Term, strain: &SixVector) -> Vec<PotentialJet> {
        let [t, slope, bend] = bounded_twist(strain[2]);
        let natural = self.natural_jet(strain[2]);
        let variables = Variables::at(invariants(strain, natural[0]));
        let mut sum = TermSum::new();
        sum.add(term, [1.0, 0.0, 0.0], &variables);
        let jet = sum.by_invariants(&variables);
        let mut power = [1.0, 0.0, 0.0];
        let units = (0..=term.degree()).map(|_| {
            let unit = by_strain(strain, natural, &jet.times_twist(power));
            let [p, dp, ddp] = power;
            power = [
                p * t,
                dp * t + p * slope,
                ddp * t + 2.0 * dp * slope + p * bend,
            ];
            unit
        });
        units.collect()
    }
}

/// Terms of twist alone.
const OF_TWIST: [Term; 2] = [Term::Twist, Term::Turn];

/// Other terms.
fn coupled_terms() -> impl Iterator<Item = Term> {
    let all = Term::ALL.into_iter();
    all.filter(|term| !OF_TWIST.contains(term))
}

/// `e`, `a`, `g`, `c`, `kappa_3`.
fn invariants(s: &SixVector, natural_stretch: f64) -> Invariants {
    [
        s[5] - natural_stretch,
        s[0] * s[0] + s[1] * s[1],
        s[3] * s[3] + s[4] * s[4],
        s[0] * s[3] + s[1] * s[4],
        s[2],
    ]
}

/// Converts derivatives with respect to invariants to derivatives with respect to strains.
fn by_strain(s: &SixVector, [_, slope, bend]: Jet, jet: &InvariantJet) -> PotentialJet {
    // Gradients of the invariants.
    let rows = [
        SixVector::new(0.0, 0.0, -slope, 0.0, 0.0, 1.0),
        SixVector::new(2.0 * s[0], 2.0 * s[1], 0.0, 0.0, 0.0, 0.0),
        SixVector::new(0.0, 0.0, 0.0, 2.0 * s[3], 2.0 * s[4], 0.0),
        SixVector::new(s[3], s[4], 0.0, s[0], s[1], 0.0),
        SixVector::ith(2, 1.0),
    ];
    let mut loads = SixVector::zeros();
    let mut tangent = Matrix6::zeros();
    for (row, (first, second)) in rows.iter().zip(jet.first.iter().zip(&jet.second)) {
        loads += *first * row;
        let others = rows.iter().zip(second);
        let column: SixVector = others.map(|(other, x)| *x * other).sum();
        tangent += row * column.transpose();
    }
    let [e, a, g, c, _] = jet.first;
    tangent[(2, 2)] -= bend * e;
    for k in 0..2 {
        tangent[(k, k)] += 2.0 * a;
        tangent[(k + 3, k + 3)] += 2.0 * g;
        tangent[(k, k + 3)] += c;
        tangent[(k + 3, k)] += c;
    }
    PotentialJet {
        energy: jet.value,
        loads,
        tangent: 0.5 * (tangent + tangent.transpose()),
    }
}

impl Homogenised {
    /// Creates the law from the coefficients of each term, lowest order first; missing ones are
    /// zero.
    ///
    /// # Errors
    /// If a term has more coefficients than its [degree](Term::degree) allows, or if one is not
    /// finite.
    pub fn new(
        form: HomogenisedForm,
        coefficients: impl Fn(Term) -> Vec<f64>,
    ) -> Result<Self, RodParameterError> {
        let mut all = [Polynomial::default(); Term::ALL.len()];
        for (polynomial, term) in all.iter_mut().zip(Term::ALL) {
            *polynomial = padded(&coefficients(term), term.degree() + 1)?;
        }
        Ok(Self {
            unrolled: Potential::new(&form, &all, [1.0; 3]),
            scales: SixVector::repeat(1.0),
            twist_factor: 1.0,
            form,
            coefficients: all,
            range: StrainRange::UNBOUNDED,
        })
    }

    /// Form for vector kernels.
    pub(crate) fn unrolled(&self) -> Potential {
        self.unrolled
    }

    /// Factor of the twisting rigidity relative to unaltered rods.
    pub(crate) fn twist_factor(&self) -> f64 {
        self.twist_factor
    }

    /// Form of the law.
    pub fn form(&self) -> &HomogenisedForm {
        &self.form
    }

    /// Coefficients of a term, lowest order first.
    pub fn coefficients(&self, term: Term) -> &[f64] {
        &self.coefficients[term as usize][..=term.degree()]
    }

    /// Energy per rest length (pN).
    pub fn energy_density(&self, strain: &SixVector) -> f64 {
        let [twist, ..] = self.twist_jet(strain[2]);
        let strain = &strain.component_mul(&self.scales);
        let values = values(invariants(strain, self.form.natural_stretch(strain[2])));
        let [t, ..] = bounded_twist(strain[2]);
        let coupled = coupled_terms().fold(0.0, |sum, term| {
            sum + term.value(&values) * value_of(self.coefficients(term), t)
        });
        coupled + twist
    }

    /// Terms of twist alone with two derivatives.
    fn twist_jet(&self, twist: f64) -> Jet {
        let [p, slope, bend] = polynomial(self.coefficients(Term::Twist), bounded_twist(twist));
        let turn = self.coefficients(Term::Turn)[0];
        let square = twist * twist;
        [
            square * p + turn * twist,
            2.0 * twist * p + square * slope + turn,
            2.0 * p + 4.0 * twist * slope + square * bend,
        ]
    }

    /// Torques (pN nm) and forces (pN), the gradient of [`energy_density`](Self::energy_density).
    pub fn loads(&self, strain: &SixVector) -> SixVector {
        let [x, y, k, s1, s2, s3] = (*strain).into();
        let [force, couple] = self.unrolled.segment(Scalar, [s1, s2, s3], [x, y, k]);
        let joint = self.unrolled.bending(Scalar, [x, y, k]);
        let couple = [0, 1, 2].map(|i| couple[i] + joint[i]);
        SixVector::from_row_slice([couple, force].as_flattened())
    }

    /// Derivatives of [`loads`](Self::loads), symmetric.
    pub fn tangent(&self, strain: &SixVector) -> Matrix6<f64> {
        self.jet(strain).tangent
    }

    /// Energy, loads and tangent.
    pub fn jet(&self, strain: &SixVector) -> PotentialJet {
        let twist = self.twist_jet(strain[2]);
        let strain = &strain.component_mul(&self.scales);
        let natural = self.form.natural_jet(strain[2]);
        let mut jet = by_strain(strain, natural, &self.sum(invariants(strain, natural[0])));
        jet.loads.component_mul_assign(&self.scales);
        jet.tangent
            .component_mul_assign(&(self.scales * self.scales.transpose()));
        jet.energy += twist[0];
        jet.loads[2] += twist[1];
        jet.tangent[(2, 2)] += twist[2];
        jet
    }

    /// Stretch of the straight rod without force at a twist (rad/nm).
    pub fn natural_stretch(&self, twist: f64) -> f64 {
        self.form.natural_stretch(self.scales[2] * twist)
    }

    /// Stretch at a strain, relative to the length that the [range](StrainRange::stretch) refers to.
    pub fn stretch_in_range(&self, strain: &SixVector) -> f64 {
        let natural = self.natural_stretch(strain[2]);
        if !self.range.is_tension_free {
            return strain[5] - natural;
        }
        let straight = SixVector::new(0.0, 0.0, strain[2], 0.0, 0.0, natural);
        let softest = SOFTEST_STRETCH * self.tangent(&straight)[(5, 5)];
        // Bending and shear shorten the straight rod.
        let mut free = *strain;
        free[5] = natural;
        // Newton's method; steps are limited and the stiffness is bounded, since the tension may
        // have an inflection beyond the data.
        for _ in 0..FREE_STEPS {
            let jet = self.jet(&free);
            let step = jet.loads[5] / f64::max(jet.tangent[(5, 5)], softest);
            free[5] -= step.clamp(-LARGEST_FREE_STEP, LARGEST_FREE_STEP);
            if step.abs() < FREE_TOLERANCE {
                break;
            }
        }
        strain[5] - free[5]
    }

    fn sum(&self, invariants: Invariants) -> InvariantJet {
        let variables = Variables::at(invariants);
        let t = bounded_twist(invariants[BY_TWIST]);
        let mut sum = TermSum::new();
        for term in coupled_terms() {
            sum.add(term, polynomial(self.coefficients(term), t), &variables);
        }
        sum.by_invariants(&variables)
    }
}

#[cfg(test)]
mod tests;
