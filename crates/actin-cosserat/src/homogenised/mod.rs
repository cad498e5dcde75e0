//! One potential for all six strains, as periodic cells of monomers give it.
//!
//! Its form is here; its numbers come from a fit to measured cells (`mean_filament.rs`). Twist, shear and
//! stretch of one place are one law, and a rod has them at different places: `joint.rs` and `segment.rs` share the
//! energy among them.

mod joint;
mod mean_filament;
mod segment;
mod spline;
mod terms;
mod twist_stability;

pub use mean_filament::StrainRange;
pub use terms::Term;

use crate::RodParameterError;
use nalgebra::{Matrix6, Vector6};
pub(crate) use segment::STRAIGHT;
use segment::joined;
use spline::Spline;
use terms::TermJet;

/// Strains: `kappa_1`, `kappa_2`, `kappa_3` (rad/nm), `sigma_1`, `sigma_2`, `sigma_3`; or couple (pN nm) and
/// force (pN) in body axes.
type SixVector = Vector6<f64>;

/// The twists at which coefficients are given, and the natural length of the straight rod there.
///
/// The extension that counts is `e = sigma_3 - n(kappa_3)`, with `n` the stretch of the straight rod of this
/// twist without force. A rod that is isotropic about its axis, and the same when turned end for end, stores what
/// `kappa_3` and the four invariants
///
/// `e`, `a = kappa_1^2 + kappa_2^2`, `g = sigma_1^2 + sigma_2^2`, `c = kappa_1 sigma_1 + kappa_2 sigma_2`
///
/// say. (`kappa_1 sigma_2 - kappa_2 sigma_1` changes its sign when the rod is turned end for end.) `c` has none
/// where left and right are the same.
#[derive(Clone, Debug, PartialEq)]
pub struct HomogenisedForm {
    nodes: Vec<f64>,
    natural: Spline,
    /// The splines that are 1 at one node and 0 at all others.
    cardinal: Vec<Spline>,
}

/// A potential `W = sum_k C_k(kappa_3) f_k(e, a, g, c)` per length (pN), `f_k` the [`Term`]s, `C_k`
/// natural cubic splines in the twist.
///
/// Couple and force are its gradient, the tangent its second derivatives, all exact. Coefficients go on in
/// a straight line beyond the first and the last node; the terms are not bounded, so that
/// the law is no better than its data beyond their range.
///
/// ```
/// use actin_cosserat::{Homogenised, HomogenisedForm, Term};
/// // S3 = 3.4e4 pN and B = 3e4 pN nm^2 at any twist; over-twist shortens.
/// let form = HomogenisedForm::new(&[-0.1, 0.0, 0.1], &[0.028, 0.0, -0.028])?;
/// let law = Homogenised::new(form, |term, _| match term {
///     Term::Stretch => 1.7e4,
///     Term::Bend => 1.5e4,
///     _ => 0.0,
/// })?;
/// let loads = law.loads(&[1e-3, 0.0, 0.01, 0.0, 0.0, 0.0].into());
/// assert!((loads[0] - 30.0).abs() < 1e-9);
/// assert!((loads[5] - 3.4e4 * 0.0028).abs() < 1e-9);
/// # Ok::<(), actin_cosserat::RodParameterError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Homogenised {
    form: HomogenisedForm,
    /// One per term.
    coefficients: Vec<Spline>,
    range: StrainRange,
}

/// Energy per length and loads that one unit of a coefficient adds.
pub type EnergyAndLoads = (f64, SixVector);

impl HomogenisedForm {
    /// The form for these twists (rad/nm, ascending) and natural lengths there, as strains.
    ///
    /// # Errors
    /// Fewer than three nodes, or nodes that do not ascend; natural lengths that are not finite or not as many.
    pub fn new(nodes: &[f64], natural: &[f64]) -> Result<Self, RodParameterError> {
        let unit = |k: usize| -> Vec<f64> {
            (0..nodes.len())
                .map(|i| f64::from(u8::from(i == k)))
                .collect()
        };
        let cardinal = (0..nodes.len()).map(|k| Spline::new(nodes, &unit(k)));
        Ok(Self {
            nodes: nodes.to_vec(),
            natural: Spline::new(nodes, natural)?,
            cardinal: cardinal.collect::<Result<_, _>>()?,
        })
    }

    /// The twists (rad/nm).
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Stretch of the straight rod of this twist without force.
    pub fn natural_stretch(&self, twist: f64) -> f64 {
        self.natural.jet(twist)[0]
    }

    /// What a unit of each coefficient of `term` adds at these strains: one for each node. The law is linear in
    /// its coefficients.
    pub fn units(&self, term: Term, strain: &SixVector) -> Vec<EnergyAndLoads> {
        let jet = term.jet(self.invariants(strain));
        let unit = |cardinal: &Spline| {
            let [value, slope, _] = cardinal.jet(strain[2]);
            let of_invariants = jet.first.map(|first| value * first);
            let loads = self.gradient(strain, of_invariants, slope * jet.value);
            (value * jet.value, loads)
        };
        self.cardinal.iter().map(unit).collect()
    }

    /// `e`, `a`, `g`, `c`.
    fn invariants(&self, s: &SixVector) -> [f64; 4] {
        [
            s[5] - self.natural.jet(s[2])[0],
            s[0] * s[0] + s[1] * s[1],
            s[3] * s[3] + s[4] * s[4],
            s[0] * s[3] + s[1] * s[4],
        ]
    }

    /// The gradient by the strains from that by the invariants and by the twist at fixed ones.
    fn gradient(&self, s: &SixVector, by: [f64; 4], by_twist: f64) -> SixVector {
        let [e, a, g, c] = by;
        SixVector::new(
            2.0 * s[0] * a + s[3] * c,
            2.0 * s[1] * a + s[4] * c,
            by_twist - self.natural.jet(s[2])[1] * e,
            2.0 * s[3] * g + s[0] * c,
            2.0 * s[4] * g + s[1] * c,
            e,
        )
    }
}

/// The potential as a function of the invariants and of the twist.
#[derive(Default)]
struct Sum {
    /// Value and derivatives by the invariants.
    terms: TermJet,
    /// First and second derivative by the twist, and the mixed ones.
    twist: f64,
    twist_twice: f64,
    mixed: [f64; 4],
}

impl Homogenised {
    /// The law with the coefficient of each term at each node of the form.
    ///
    /// # Errors
    /// A coefficient that is not finite.
    pub fn new(
        form: HomogenisedForm,
        coefficient: impl Fn(Term, usize) -> f64,
    ) -> Result<Self, RodParameterError> {
        let spline = |term: Term| {
            let values: Vec<f64> = (0..form.nodes.len())
                .map(|k| coefficient(term, k))
                .collect();
            Spline::new(&form.nodes, &values)
        };
        let coefficients = Term::ALL
            .into_iter()
            .map(spline)
            .collect::<Result<_, _>>()?;
        Ok(Self {
            form,
            coefficients,
            range: StrainRange::UNBOUNDED,
        })
    }

    /// The form.
    pub fn form(&self) -> &HomogenisedForm {
        &self.form
    }

    /// The coefficient of a term at a node.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn coefficient(&self, term: Term, node: usize) -> f64 {
        let twist = self.form.nodes[node];
        let mut all = Term::ALL.into_iter().zip(&self.coefficients);
        let found = all.find(|(other, _)| *other == term);
        found.map_or(0.0, |(_, spline)| spline.jet(twist)[0])
    }

    /// Energy per rest length (pN).
    pub fn energy_density(&self, strain: &SixVector) -> f64 {
        self.sum(strain).terms.value
    }

    /// Couple (pN nm) and force (pN), the gradient of [`energy_density`](Self::energy_density).
    pub fn loads(&self, strain: &SixVector) -> SixVector {
        let sum = self.sum(strain);
        self.form.gradient(strain, sum.terms.first, sum.twist)
    }

    /// The derivatives of [`loads`](Self::loads), symmetric.
    pub fn tangent(&self, strain: &SixVector) -> Matrix6<f64> {
        let sum = self.sum(strain);
        let [_, slope, bend] = self.form.natural.jet(strain[2]);
        let s = strain;
        // Gradients of the invariants and of the twist.
        let rows = [
            SixVector::new(0.0, 0.0, -slope, 0.0, 0.0, 1.0),
            SixVector::new(2.0 * s[0], 2.0 * s[1], 0.0, 0.0, 0.0, 0.0),
            SixVector::new(0.0, 0.0, 0.0, 2.0 * s[3], 2.0 * s[4], 0.0),
            SixVector::new(s[3], s[4], 0.0, s[0], s[1], 0.0),
        ];
        let twist = SixVector::ith(2, 1.0);
        let mut tangent = sum.twist_twice * twist * twist.transpose();
        for (i, row) in rows.iter().enumerate() {
            let both = row * twist.transpose();
            tangent += sum.mixed[i] * (both + both.transpose());
            for (j, column) in rows.iter().enumerate() {
                tangent += sum.terms.second[i][j] * row * column.transpose();
            }
        }
        let [e, a, g, c] = sum.terms.first;
        tangent[(2, 2)] -= bend * e;
        for k in 0..2 {
            tangent[(k, k)] += 2.0 * a;
            tangent[(k + 3, k + 3)] += 2.0 * g;
            tangent[(k, k + 3)] += c;
            tangent[(k + 3, k)] += c;
        }
        tangent
    }

    /// Adds up the terms.
    fn sum(&self, strain: &SixVector) -> Sum {
        let invariants = self.form.invariants(strain);
        let mut sum = Sum::default();
        for (term, spline) in Term::ALL.into_iter().zip(&self.coefficients) {
            let [c, slope, bend] = spline.jet(strain[2]);
            let jet = term.jet(invariants);
            sum.terms.value += c * jet.value;
            sum.twist += slope * jet.value;
            sum.twist_twice += bend * jet.value;
            for i in 0..4 {
                sum.terms.first[i] += c * jet.first[i];
                sum.mixed[i] += slope * jet.first[i];
                for j in 0..4 {
                    sum.terms.second[i][j] += c * jet.second[i][j];
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests;
