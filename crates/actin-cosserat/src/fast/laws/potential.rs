//! Potential of all strains.

use super::Law;
use crate::Term;
use crate::homogenised::{
    BENT, CURVATURE, EXTENSION, HomogenisedForm, Polynomial, SHEAR, SLACK, TIGHT, TWIST_SIZE,
};
use actin_mechanics::wide::{Scalar, Simd, Wide3};

/// Law of `Homogenised`: coefficients of terms, as constants or as polynomials in the bounded
/// twist.
///
/// Joints have the terms of curvature alone. These cancel in segments, whose energy is `W - U`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Potential {
    /// Factors of bending, twist and shear in all terms but `twist` and `turn`.
    scales: [f64; 3],
    rest: f64,
    natural: [f64; 10],
    any_stretch: [f64; 1],
    any_bend: [f64; 1],
    any_shear: [f64; 1],
    twist: [f64; 10],
    turn: [f64; 1],
    stretch: [f64; 9],
    stretch_thrice: [f64; 5],
    compression: [f64; 7],
    bend: [f64; 9],
    root: [f64; 9],
    stretch_root: [f64; 7],
    stretch_bend: [f64; 7],
    shear: [f64; 10],
    stretch_shear: [f64; 9],
    coupling: [f64; 10],
    stretch_coupling: [f64; 6],
    root_shear: [f64; 6],
    root_coupling: [f64; 9],
    shear_coupling: [f64; 8],
    shear_twice: [f64; 7],
    shear_thrice: [f64; 3],
    root_twice_shear: [f64; 6],
    stretch_twice_root: [f64; 7],
    pull: [f64; 7],
    stretch_twice_shear: [f64; 4],
    stretch_shear_twice: [f64; 4],
}

impl Potential {
    pub(crate) fn new(
        form: &HomogenisedForm,
        terms: &[Polynomial; Term::ALL.len()],
        scales: [f64; 3],
    ) -> Self {
        Self {
            scales,
            rest: form.rest(),
            natural: std::array::from_fn(|k| form.natural()[k]),
            any_stretch: of(terms, Term::AnyStretch),
            any_bend: of(terms, Term::AnyBend),
            any_shear: of(terms, Term::AnyShear),
            twist: of(terms, Term::Twist),
            turn: of(terms, Term::Turn),
            stretch: of(terms, Term::Stretch),
            stretch_thrice: of(terms, Term::StretchThrice),
            compression: of(terms, Term::Compression),
            bend: of(terms, Term::Bend),
            root: of(terms, Term::BendRoot),
            stretch_root: of(terms, Term::StretchRoot),
            stretch_bend: of(terms, Term::StretchBend),
            shear: of(terms, Term::Shear),
            stretch_shear: of(terms, Term::StretchShear),
            coupling: of(terms, Term::Coupling),
            stretch_coupling: of(terms, Term::StretchCoupling),
            root_shear: of(terms, Term::RootShear),
            root_coupling: of(terms, Term::RootCoupling),
            shear_coupling: of(terms, Term::ShearCoupling),
            shear_twice: of(terms, Term::ShearTwice),
            shear_thrice: of(terms, Term::ShearThrice),
            root_twice_shear: of(terms, Term::RootTwiceShear),
            stretch_twice_root: of(terms, Term::StretchTwiceRoot),
            pull: of(terms, Term::Pull),
            stretch_twice_shear: of(terms, Term::StretchTwiceShear),
            stretch_shear_twice: of(terms, Term::StretchShearTwice),
        }
    }
}

impl Potential {
    /// Torque (pN nm) of a twist (rad/nm) without bending.
    #[inline]
    pub(crate) fn twisting(&self, k: f64) -> f64 {
        self.twist_alone(Scalar, k, bounded(Scalar, k))
    }

    /// Torque of the terms of twist alone at a twist, with `t` and its derivative.
    #[inline(always)]
    fn twist_alone<S: Simd>(&self, simd: S, k: S::f64s, [t, slope]: [S::f64s; 2]) -> S::f64s {
        let [twist, by_t] = jet(simd, &self.twist, t);
        let by_t = simd.mul_f64s(simd.mul_f64s(by_t, slope), k);
        let over_k = simd.mul_add_e_f64s(simd.splat_f64s(2.0), twist, by_t);
        simd.mul_add_e_f64s(k, over_k, simd.splat_f64s(self.turn[0]))
    }

    /// Scales the curvature and the twist, or their torques.
    #[inline(always)]
    fn scaled<S: Simd>(&self, simd: S, [x, y, z]: Wide3<S>) -> Wide3<S> {
        let [bend, twist, _] = self.scales.map(|scale| simd.splat_f64s(scale));
        [
            simd.mul_f64s(bend, x),
            simd.mul_f64s(bend, y),
            simd.mul_f64s(twist, z),
        ]
    }

    /// Scales the shear, or its forces.
    #[inline(always)]
    fn scaled_shear<S: Simd>(&self, simd: S, [x, y, z]: Wide3<S>) -> Wide3<S> {
        let shear = simd.splat_f64s(self.scales[2]);
        [simd.mul_f64s(shear, x), simd.mul_f64s(shear, y), z]
    }
}

fn of<const N: usize>(terms: &[Polynomial; Term::ALL.len()], term: Term) -> [f64; N] {
    debug_assert_eq!(N, term.degree() + 1, "{term:?}");
    let mut all = Term::ALL.into_iter().zip(terms);
    let found = all.find(|(other, _)| *other == term);
    std::array::from_fn(|k| found.map_or(0.0, |(_, polynomial)| polynomial[k]))
}

#[inline(always)]
fn jet<S: Simd, const N: usize>(simd: S, coefficients: &[f64; N], t: S::f64s) -> [S::f64s; 2] {
    let mut value = simd.splat_f64s(coefficients[N - 1]);
    let mut slope = value;
    for k in (1..N - 1).rev() {
        value = simd.mul_add_e_f64s(value, t, simd.splat_f64s(coefficients[k]));
        slope = simd.mul_add_e_f64s(slope, t, value);
    }
    let lowest = simd.splat_f64s(coefficients[0]);
    [simd.mul_add_e_f64s(value, t, lowest), slope]
}

/// Bounded twist `t = k / sqrt(k^2 + k_0^2)` and its derivative `k_0^2 / (k^2 + k_0^2)^(3/2)`.
#[inline(always)]
fn bounded<S: Simd>(simd: S, k: S::f64s) -> [S::f64s; 2] {
    let size = simd.splat_f64s(TWIST_SIZE);
    let root = simd.sqrt_f64s(simd.mul_add_e_f64s(k, k, simd.mul_f64s(size, size)));
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), root);
    let ratio = simd.mul_f64s(size, inverse);
    [
        simd.mul_f64s(k, inverse),
        simd.mul_f64s(simd.mul_f64s(ratio, ratio), inverse),
    ]
}

#[inline(always)]
fn squared<S: Simd>(simd: S, [x, y, _]: Wide3<S>) -> S::f64s {
    simd.mul_add_e_f64s(y, y, simd.mul_f64s(x, x))
}

/// `1 + x / size^2`.
#[inline(always)]
fn denominator<S: Simd>(simd: S, x: S::f64s, size: f64) -> S::f64s {
    simd.mul_add_e_f64s(
        x,
        simd.splat_f64s((size * size).recip()),
        simd.splat_f64s(1.0),
    )
}

/// Square roots and denominators of the terms of twist and bending.
struct Roots<S: Simd> {
    /// `sqrt(k^2 + k_0^2)`.
    twist: S::f64s,
    /// `q = 1 + a / size^2`.
    q: S::f64s,
    /// `s = sqrt((a + b^2 q) q)`, with the root `s / q`.
    s: S::f64s,
}

struct BendingTerms<S: Simd> {
    /// Bounded twist `t = k / sqrt(k^2 + k_0^2)` and `k_0^2 / (k^2 + k_0^2)^(3/2)`.
    twist: [S::f64s; 2],
    /// `1 / q`.
    fading: S::f64s,
    /// `A` and `1 / q^2`.
    bend: [S::f64s; 2],
    /// `r`.
    root: [S::f64s; 2],
}

impl<S: Simd> Roots<S> {
    #[inline(always)]
    fn new(simd: S, a: S::f64s, k: S::f64s) -> Self {
        let q = denominator(simd, a, CURVATURE);
        let p = simd.mul_add_e_f64s(q, simd.splat_f64s(BENT * BENT), a);
        let twist = simd.mul_add_e_f64s(k, k, simd.splat_f64s(TWIST_SIZE * TWIST_SIZE));
        Self {
            twist: simd.sqrt_f64s(twist),
            q,
            s: simd.sqrt_f64s(simd.mul_f64s(p, q)),
        }
    }

    /// `q s`.
    #[inline(always)]
    fn product(&self, simd: S) -> S::f64s {
        simd.mul_f64s(self.q, self.s)
    }

    #[inline(always)]
    fn bent(
        &self,
        simd: S,
        [a, k]: [S::f64s; 2],
        [of_twist, of_qs]: [S::f64s; 2],
    ) -> BendingTerms<S> {
        let ratio = simd.mul_f64s(simd.splat_f64s(TWIST_SIZE), of_twist);
        let fading = simd.mul_f64s(of_qs, self.s);
        let fading_twice = simd.mul_f64s(fading, fading);
        let root = simd.mul_f64s(self.s, fading);
        // q / s, halved.
        let over_root = simd.mul_f64s(simd.mul_f64s(of_qs, self.q), self.q);
        let half = simd.mul_f64s(over_root, simd.splat_f64s(0.5));
        BendingTerms {
            twist: [
                simd.mul_f64s(k, of_twist),
                simd.mul_f64s(simd.mul_f64s(ratio, ratio), of_twist),
            ],
            fading,
            bend: [simd.mul_f64s(a, fading), fading_twice],
            root: [
                simd.sub_f64s(root, simd.splat_f64s(BENT)),
                simd.mul_f64s(half, fading_twice),
            ],
        }
    }
}

#[inline(always)]
fn twice<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    simd.add_f64s(x, x)
}

impl Law for Potential {
    const COUPLES: bool = true;
    const COVERS: bool = true;

    #[inline(always)]
    fn bending<S: Simd>(&self, simd: S, kappa: Wide3<S>) -> Wide3<S> {
        let unscaled = kappa[2];
        let kappa = self.scaled(simd, kappa);
        let [x, y, k] = kappa;
        let a = squared(simd, kappa);
        let roots = Roots::new(simd, a, k);
        let qs = roots.product(simd);
        let inverse = simd.div_f64s(simd.splat_f64s(1.0), simd.mul_f64s(qs, roots.twist));
        let inverses = [qs, roots.twist].map(|other| simd.mul_f64s(inverse, other));
        let bent = roots.bent(simd, [a, k], inverses);
        let [t, slope] = bent.twist;
        // Without a factor, this saves a square root and a division.
        let bounded_twist = if self.scales[1].total_cmp(&1.0).is_eq() {
            bent.twist
        } else {
            bounded(simd, unscaled)
        };
        let [bend, bend_slope] = jet(simd, &self.bend, t);
        let [root, root_slope] = jet(simd, &self.root, t);
        let mut by_a = simd.mul_add_e_f64s(bend, bent.bend[1], simd.splat_f64s(self.any_bend[0]));
        by_a = twice(simd, simd.mul_add_e_f64s(root, bent.root[1], by_a));
        let mut by_t = simd.mul_f64s(bend_slope, bent.bend[0]);
        by_t = simd.mul_add_e_f64s(root_slope, bent.root[0], by_t);
        let about = simd.mul_f64s(by_t, slope);
        let bent = [simd.mul_f64s(x, by_a), simd.mul_f64s(y, by_a), about];
        let [x, y, about] = self.scaled(simd, bent);
        let twist = self.twist_alone(simd, unscaled, bounded_twist);
        [x, y, simd.add_f64s(about, twist)]
    }

    #[inline(always)]
    fn segment<S: Simd>(&self, simd: S, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2] {
        let (sigma, kappa) = (self.scaled_shear(simd, sigma), self.scaled(simd, kappa));
        let strained = StrainTerms::new(simd, self, sigma, kappa);
        let [force, couple] = strained.loads(simd, self, sigma, kappa);
        [self.scaled_shear(simd, force), self.scaled(simd, couple)]
    }
}

struct StrainTerms<S: Simd> {
    bent: BendingTerms<S>,
    /// Derivative of the natural length with respect to twist.
    natural: S::f64s,
    /// `e`, `E` and the derivative of `E`.
    stretch: [S::f64s; 3],
    /// `1 / (1 + g / size^2)`, `G` and its derivative.
    shear: [S::f64s; 3],
    /// `C` and its derivative with respect to `c`.
    coupling: [S::f64s; 2],
    /// Function of compression and its derivative with respect to extension.
    slack: [S::f64s; 2],
}

impl<S: Simd> StrainTerms<S> {
    #[inline(always)]
    fn new(simd: S, law: &Potential, sigma: Wide3<S>, kappa: Wide3<S>) -> Self {
        let [x, y, k] = kappa;
        let (a, g) = (squared(simd, kappa), squared(simd, sigma));
        let c = simd.mul_add_e_f64s(x, sigma[0], simd.mul_f64s(y, sigma[1]));
        let (roots, of_shear) = (Roots::new(simd, a, k), denominator(simd, g, SHEAR));
        // One division for four inverses.
        let (qs, others) = (roots.product(simd), simd.mul_f64s(of_shear, roots.twist));
        let inverse = simd.div_f64s(simd.splat_f64s(1.0), simd.mul_f64s(qs, others));
        let (of_others, of_qs) = (simd.mul_f64s(inverse, qs), simd.mul_f64s(inverse, others));
        let of_twist = simd.mul_f64s(of_others, of_shear);
        let fading = simd.mul_f64s(of_others, roots.twist);
        let bent = roots.bent(simd, [a, k], [of_twist, of_qs]);
        let [t, slope] = bent.twist;
        let [value, by_t] = jet(simd, &law.natural, t);
        let beyond = simd.sub_f64s(sigma[2], simd.splat_f64s(law.rest));
        let e = simd.negate_mul_add_e_f64s(k, value, beyond);
        let by_c = simd.mul_f64s(bent.fading, fading);
        let (stretch, slack) = extended(simd, e, [bent.root[0], g, k]);
        Self {
            bent,
            natural: simd.mul_add_e_f64s(simd.mul_f64s(k, slope), by_t, value),
            stretch,
            shear: [
                fading,
                simd.mul_f64s(g, fading),
                simd.mul_f64s(fading, fading),
            ],
            coupling: [simd.mul_f64s(c, by_c), by_c],
            slack,
        }
    }
}

/// `e`, `E` and its derivative, and `y^5 / (y^2 + w^2)^(3/2)` with its derivative with respect to extension.
///
/// `y` is the compression beyond the onset of slack, or zero.
#[inline(always)]
fn extended<S: Simd>(simd: S, e: S::f64s, [r, g, k]: [S::f64s; 3]) -> ([S::f64s; 3], [S::f64s; 2]) {
    let [of_r, of_g, of_k] = TIGHT.map(|each| simd.splat_f64s(each));
    let mut x = simd.mul_add_e_f64s(of_r, r, simd.mul_f64s(of_k, simd.mul_f64s(k, k)));
    x = simd.add_f64s(e, simd.mul_add_e_f64s(of_g, g, x));
    let y = simd.max_f64s(simd.neg_f64s(x), simd.splat_f64s(0.0));
    let square = simd.mul_add_e_f64s(y, y, simd.splat_f64s(SLACK * SLACK));
    let sum = simd.sqrt_f64s(square);
    let q = simd.sqrt_f64s(denominator(simd, simd.mul_f64s(e, e), EXTENSION));
    let inverse = simd.div_f64s(simd.splat_f64s(1.0), simd.mul_f64s(q, sum));
    let (of_q, of_sum) = (simd.mul_f64s(inverse, sum), simd.mul_f64s(inverse, q));
    let slope = simd.mul_f64s(simd.mul_f64s(of_q, of_q), of_q);
    let stretch = [e, simd.mul_f64s(e, of_q), slope];
    let share = simd.mul_f64s(y, of_sum);
    let squared = simd.mul_f64s(share, share);
    let product = simd.mul_f64s(simd.mul_f64s(y, share), squared);
    // -(5 - 3 u^2) y u^3
    let by_u = simd.mul_add_e_f64s(simd.splat_f64s(3.0), squared, simd.splat_f64s(-5.0));
    let by_x = simd.mul_f64s(product, by_u);
    (stretch, [simd.mul_f64s(y, product), by_x])
}

struct Slopes<S: Simd> {
    /// With respect to `E`, `A`, `r`, `G` and `C`.
    by: [S::f64s; 5],
    /// With respect to the bounded twist.
    by_t: S::f64s,
    /// With respect to the extension in the compression term.
    pushed: S::f64s,
}

impl<S: Simd> StrainTerms<S> {
    #[inline(always)]
    fn loads(&self, simd: S, law: &Potential, sigma: Wide3<S>, kappa: Wide3<S>) -> [Wide3<S>; 2] {
        let Slopes {
            by: [by_stretch, by_bend, by_root, by_shear, by_coupling],
            by_t,
            pushed,
        } = self.slopes(simd, law);
        let [of_r, of_g, of_k] = TIGHT.map(|each| simd.splat_f64s(each));
        let coupled = simd.mul_f64s(by_coupling, self.coupling[0]);
        let (a_size, g_size) = (
            simd.splat_f64s(-CURVATURE.powi(-2)),
            simd.splat_f64s(-SHEAR.powi(-2)),
        );
        let [e, _, stretch_slope] = self.stretch;
        let mut by_e = simd.mul_add_e_f64s(by_stretch, stretch_slope, pushed);
        by_e = simd.mul_add_e_f64s(simd.splat_f64s(2.0 * law.any_stretch[0]), e, by_e);
        let by_root = simd.mul_add_e_f64s(of_r, pushed, by_root);
        let mut by_a = simd.mul_f64s(by_root, self.bent.root[1]);
        by_a = simd.mul_add_e_f64s(by_bend, self.bent.bend[1], by_a);
        by_a = simd.mul_add_e_f64s(simd.mul_f64s(coupled, self.bent.fading), a_size, by_a);
        by_a = twice(simd, by_a);
        let [fading, _, shear_slope] = self.shear;
        let any = simd.splat_f64s(law.any_shear[0]);
        let mut by_g = simd.mul_add_e_f64s(by_shear, shear_slope, any);
        by_g = simd.mul_add_e_f64s(simd.mul_f64s(coupled, fading), g_size, by_g);
        by_g = twice(simd, simd.mul_add_e_f64s(of_g, pushed, by_g));
        let by_c = simd.mul_f64s(by_coupling, self.coupling[1]);
        let by_k = twice(simd, simd.mul_f64s(of_k, pushed));
        let about = simd.mul_add_e_f64s(by_t, self.bent.twist[1], simd.mul_f64s(by_k, kappa[2]));
        let force = |k: usize| simd.mul_add_e_f64s(sigma[k], by_g, simd.mul_f64s(kappa[k], by_c));
        let couple = |k: usize| simd.mul_add_e_f64s(kappa[k], by_a, simd.mul_f64s(sigma[k], by_c));
        let about = simd.negate_mul_add_e_f64s(self.natural, by_e, about);
        [[force(0), force(1), by_e], [couple(0), couple(1), about]]
    }

    #[inline(always)]
    fn slopes(&self, simd: S, law: &Potential) -> Slopes<S> {
        let [t, _] = self.bent.twist;
        let ([_, stretch, _], [_, shear, _]) = (self.stretch, self.shear);
        let (bend, root, coupling) = (self.bent.bend[0], self.bent.root[0], self.coupling[0]);
        let mut sums = Sums {
            simd,
            t,
            by: [simd.splat_f64s(0.0); 5],
            by_t: simd.splat_f64s(0.0),
        };
        sums.add(&law.pull, (0, stretch));
        sums.add_square(&law.stretch, (0, stretch));
        sums.add_product(&law.stretch_root, [(0, stretch), (2, root)]);
        sums.add_product(&law.stretch_bend, [(0, stretch), (1, bend)]);
        sums.add(&law.shear, (3, shear));
        sums.add_product(&law.stretch_shear, [(0, stretch), (3, shear)]);
        sums.add(&law.coupling, (4, coupling));
        sums.add_product(&law.stretch_coupling, [(0, stretch), (4, coupling)]);
        sums.add_product(&law.root_shear, [(2, root), (3, shear)]);
        sums.add_product(&law.root_coupling, [(2, root), (4, coupling)]);
        sums.add_product(&law.shear_coupling, [(3, shear), (4, coupling)]);
        sums.add_square(&law.shear_twice, (3, shear));
        sums.add_cube(&law.shear_thrice, (3, shear));
        let twice = [(2, root), (2, root), (3, shear)];
        sums.add_triple(&law.root_twice_shear, twice);
        let twice = [(0, stretch), (0, stretch), (2, root)];
        sums.add_triple(&law.stretch_twice_root, twice);
        let twice = [(0, stretch), (0, stretch), (3, shear)];
        sums.add_triple(&law.stretch_twice_shear, twice);
        let twice = [(0, stretch), (3, shear), (3, shear)];
        sums.add_triple(&law.stretch_shear_twice, twice);
        sums.add_cube(&law.stretch_thrice, (0, stretch));
        let [compression, slope] = jet(simd, &law.compression, t);
        Slopes {
            by: sums.by,
            by_t: simd.mul_add_e_f64s(slope, self.slack[0], sums.by_t),
            pushed: simd.mul_f64s(compression, self.slack[1]),
        }
    }
}

/// Sums of the derivatives of terms, with respect to their factors and to `t`.
struct Sums<S: Simd> {
    simd: S,
    t: S::f64s,
    by: [S::f64s; 5],
    by_t: S::f64s,
}

impl<S: Simd> Sums<S> {
    /// Returns the polynomial, and adds its slope times the term to `by_t`.
    #[inline(always)]
    fn value<const N: usize>(&mut self, coefficients: &[f64; N], term: S::f64s) -> S::f64s {
        let [value, slope] = jet(self.simd, coefficients, self.t);
        self.by_t = self.simd.mul_add_e_f64s(slope, term, self.by_t);
        value
    }

    #[inline(always)]
    fn add<const N: usize>(&mut self, coefficients: &[f64; N], (i, x): (usize, S::f64s)) {
        let value = self.value(coefficients, x);
        self.by[i] = self.simd.add_f64s(self.by[i], value);
    }

    #[inline(always)]
    fn add_square<const N: usize>(&mut self, coefficients: &[f64; N], (i, x): (usize, S::f64s)) {
        let value = self.value(coefficients, self.simd.mul_f64s(x, x));
        let doubled = self.simd.add_f64s(value, value);
        self.by[i] = self.simd.mul_add_e_f64s(doubled, x, self.by[i]);
    }

    #[inline(always)]
    fn add_cube<const N: usize>(&mut self, coefficients: &[f64; N], (i, x): (usize, S::f64s)) {
        let square = self.simd.mul_f64s(x, x);
        let value = self.value(coefficients, self.simd.mul_f64s(square, x));
        let tripled = self.simd.mul_f64s(self.simd.splat_f64s(3.0), value);
        self.by[i] = self.simd.mul_add_e_f64s(tripled, square, self.by[i]);
    }

    #[inline(always)]
    fn add_product<const N: usize>(
        &mut self,
        coefficients: &[f64; N],
        [(i, x), (j, y)]: [(usize, S::f64s); 2],
    ) {
        let value = self.value(coefficients, self.simd.mul_f64s(x, y));
        self.by[i] = self.simd.mul_add_e_f64s(value, y, self.by[i]);
        self.by[j] = self.simd.mul_add_e_f64s(value, x, self.by[j]);
    }

    #[inline(always)]
    fn add_triple<const N: usize>(
        &mut self,
        coefficients: &[f64; N],
        [(i, x), (j, y), (k, z)]: [(usize, S::f64s); 3],
    ) {
        let simd = self.simd;
        let (xy, yz, zx) = (
            simd.mul_f64s(x, y),
            simd.mul_f64s(y, z),
            simd.mul_f64s(z, x),
        );
        let value = self.value(coefficients, simd.mul_f64s(xy, z));
        for (place, rest) in [(i, yz), (j, zx), (k, xy)] {
            self.by[place] = simd.mul_add_e_f64s(value, rest, self.by[place]);
        }
    }
}
