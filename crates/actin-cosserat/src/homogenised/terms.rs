//! Terms of the potential.

/// Invariants `e`, `a`, `g`, `c` and `k = kappa_3`.
pub(super) type Invariants = [f64; 5];

pub(super) const BY_TWIST: usize = 4;

/// Saturation of extension, curvature (rad/nm) and shear in bounded terms.
pub(crate) const EXTENSION: f64 = 0.02;
pub(crate) const CURVATURE: f64 = 0.02;
pub(crate) const SHEAR: f64 = 0.1;
/// Curvature (rad/nm) above which the shift of the neutral axis is constant.
pub(crate) const BENT: f64 = 2.5e-3;
/// Width of the transition from tension to compression.
pub(crate) const SLACK: f64 = 2e-4;
/// Coefficients of bending (nm), shear and twist (nm^2) in the onset of slack.
pub(crate) const TIGHT: [f64; 3] = [0.5, 5.0, 20.0];

/// Term of the potential: a function of the invariants times a polynomial of
/// [`degree`](Self::degree) in the bounded twist.
///
/// ```text
/// E = e / sqrt(1 + (e / 0.02)^2)
/// A = a / (1 + a / 0.02^2)
/// G = g / (1 + g / 0.1^2)
/// C = c / ((1 + a / 0.02^2) (1 + g / 0.1^2))
/// r = sqrt(A + b^2) - b,  b = 0.0025 /nm
/// ```
///
/// [`HomogenisedForm`](crate::HomogenisedForm) defines `e`, `a`, `g` and `c`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// `e^2`: unbounded stretch.
    AnyStretch,
    /// `a`: unbounded bending.
    AnyBend,
    /// `g`: unbounded shear.
    AnyShear,
    /// `kappa_3^2`: twist.
    Twist,
    /// `kappa_3`: twist of the free filament, due to temperature.
    Turn,
    /// `E^2`: stretch.
    Stretch,
    /// `E^3`: stiffening in tension, softening in compression.
    StretchThrice,
    /// `y^5 / (y^2 + w^2)^(3/2)`, `y = max(-x, 0)`, `w = 2e-4`, `x = e + 0.5 r + 5 g + 20 kappa_3^2`: slack bonds in
    /// compression, unless bending, shear or twist tightens them.
    Compression,
    /// `A`: bending.
    Bend,
    /// `r`: bending with a saturating torque.
    BendRoot,
    /// `E r`: shortening by bending at small twist.
    StretchRoot,
    /// `E A`: coupling of stretch and bending.
    StretchBend,
    /// `G`: shear, stiffened by twist.
    Shear,
    /// `E G`: shortening by shear, and stiffening of shear by tension.
    StretchShear,
    /// `C`: coupling of bending and shear about the same axis.
    Coupling,
    /// `E C`: dependence of the bending-shear coupling on stretch.
    StretchCoupling,
    /// `r G`: stiffening of shear by bending.
    RootShear,
    /// `r C`: dependence of the bending-shear coupling on bending.
    RootCoupling,
    /// `G C`: dependence of the bending-shear coupling on shear.
    ShearCoupling,
    /// `G^2`: fourth-order shear.
    ShearTwice,
    /// `G^3`: sixth-order shear.
    ShearThrice,
    /// `r^2 G`: correction to `r G` at large bending.
    RootTwiceShear,
    /// `E^2 r`: softening of stretch by bending.
    StretchTwiceRoot,
    /// `E`: tension at the natural length, in rods whose segments differ in length from the cells.
    Pull,
    /// `E^2 G`: correction to `E G` at large stretch.
    StretchTwiceShear,
    /// `E G^2`: dependence of fourth-order shear on stretch.
    StretchShearTwice,
}

/// Function of one variable with two derivatives.
pub(super) type Jet = [f64; 3];

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct InvariantJet {
    pub(super) value: f64,
    pub(super) first: Invariants,
    pub(super) second: [Invariants; 5],
}

pub(super) fn of(f: Jet, inner: Jet) -> Jet {
    [
        f[0],
        f[1] * inner[1],
        f[2] * inner[1] * inner[1] + f[1] * inner[2],
    ]
}

/// `e / sqrt(1 + (e / size)^2)`.
pub(super) fn bounded(e: f64, size: f64) -> Jet {
    let q = (1.0 + (e / size).powi(2)).sqrt();
    [e / q, q.powi(-3), -3.0 * e / (size * size) * q.powi(-5)]
}

/// `x / (1 + x / size^2)`.
pub(super) fn bounded_square(x: f64, size: f64) -> Jet {
    let q = 1.0 + x / (size * size);
    [x / q, q.powi(-2), -2.0 / (size * size) * q.powi(-3)]
}

/// `1 / (1 + x / size^2)`.
fn fading(x: f64, size: f64) -> Jet {
    let (s, q) = (size * size, 1.0 + x / (size * size));
    [q.recip(), -q.powi(-2) / s, 2.0 / (s * s) * q.powi(-3)]
}

/// `sqrt(A + b^2) - b`.
pub(super) fn root(a: f64) -> Jet {
    let bent = bounded_square(a, CURVATURE);
    let r = (bent[0] + BENT * BENT).sqrt();
    // Avoids the cancellation of the difference.
    let outer = [bent[0] / (r + BENT), 0.5 / r, -0.25 / (r * r * r)];
    of(outer, bent)
}

/// `y^5 / (y^2 + w^2)^(3/2)` with `y = max(-x, 0)`: four continuous derivatives.
fn compression(x: f64) -> Jet {
    let y = (-x).max(0.0);
    let u = y / y.hypot(SLACK);
    let (u2, u3) = (u * u, u * u * u);
    [
        y * y * u3,
        -y * u3 * (5.0 - 3.0 * u2),
        u3 * (20.0 - 33.0 * u2 + 15.0 * u2 * u2),
    ]
}

/// Variables of the terms: the invariants `k`, `e`, `a`, `g`, and functions of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    One,
    Twist,
    AnyStretch,
    AnyBend,
    AnyShear,
    /// `E`.
    Stretch,
    /// `A`.
    Bend,
    /// `r`.
    Root,
    /// `G`.
    Shear,
    /// `C`.
    Coupling,
    Compression,
}

const VARIABLES: usize = 11;

/// Values of the [`Variable`]s.
pub(super) type Values = [f64; VARIABLES];

/// [`Variable`]s with their derivatives with respect to the invariants.
pub(super) struct Variables {
    values: Values,
    first: [Invariants; VARIABLES],
    second: [[Invariants; 5]; VARIABLES],
}

impl Variables {
    pub(super) fn at(invariants: Invariants) -> Self {
        let [e, a, g, c, k] = invariants;
        let mut all = Self {
            values: [0.0; VARIABLES],
            first: [[0.0; 5]; VARIABLES],
            second: [[[0.0; 5]; 5]; VARIABLES],
        };
        let root = root(a);
        all.values[Variable::One as usize] = 1.0;
        all.set(Variable::Twist, BY_TWIST, [k, 1.0, 0.0]);
        all.set(Variable::AnyStretch, 0, [e, 1.0, 0.0]);
        all.set(Variable::AnyBend, 1, [a, 1.0, 0.0]);
        all.set(Variable::AnyShear, 2, [g, 1.0, 0.0]);
        all.set(Variable::Stretch, 0, bounded(e, EXTENSION));
        all.set(Variable::Bend, 1, bounded_square(a, CURVATURE));
        all.set(Variable::Root, 1, root);
        all.set(Variable::Shear, 2, bounded_square(g, SHEAR));
        all.set_jet(Variable::Coupling, coupling(a, g, c));
        all.set_jet(Variable::Compression, compressed([e, g, k], root));
        all
    }

    fn set(&mut self, variable: Variable, invariant: usize, [value, slope, bend]: Jet) {
        let n = variable as usize;
        self.values[n] = value;
        self.first[n][invariant] = slope;
        self.second[n][invariant][invariant] = bend;
    }

    fn set_jet(&mut self, variable: Variable, jet: InvariantJet) {
        let n = variable as usize;
        self.values[n] = jet.value;
        self.first[n] = jet.first;
        self.second[n] = jet.second;
    }
}

/// Values of the [`Variable`]s.
pub(super) fn values([e, a, g, c, k]: Invariants) -> Values {
    let root = root(a);
    [
        1.0,
        k,
        e,
        a,
        g,
        bounded(e, EXTENSION)[0],
        bounded_square(a, CURVATURE)[0],
        root[0],
        bounded_square(g, SHEAR)[0],
        c * fading(a, CURVATURE)[0] * fading(g, SHEAR)[0],
        compression(onset([e, g, k], root[0]))[0],
    ]
}

/// `C`.
fn coupling(a: f64, g: f64, c: f64) -> InvariantJet {
    let ([f, df, ddf], [h, dh, ddh]) = (fading(a, CURVATURE), fading(g, SHEAR));
    let (ag, ac, gc) = (c * df * dh, df * h, f * dh);
    InvariantJet {
        value: c * f * h,
        first: [0.0, c * ac, c * gc, f * h, 0.0],
        second: [
            [0.0; 5],
            [0.0, c * ddf * h, ag, ac, 0.0],
            [0.0, ag, c * f * ddh, gc, 0.0],
            [0.0, ac, gc, 0.0, 0.0],
            [0.0; 5],
        ],
    }
}

/// Extension beyond the onset of slack.
fn onset([e, g, k]: [f64; 3], r: f64) -> f64 {
    let [of_r, of_g, of_k] = TIGHT;
    e + of_r * r + of_g * g + of_k * k * k
}

fn compressed([e, g, k]: [f64; 3], root: Jet) -> InvariantJet {
    let [of_r, of_g, of_k] = TIGHT;
    let [value, slope, bend] = compression(onset([e, g, k], root[0]));
    let by = [1.0, of_r * root[1], of_g, 0.0, 2.0 * of_k * k];
    let mut second = by.map(|x| by.map(|y| bend * x * y));
    second[1][1] += of_r * root[2] * slope;
    second[BY_TWIST][BY_TWIST] += 2.0 * of_k * slope;
    InvariantJet {
        value,
        first: by.map(|x| slope * x),
        second,
    }
}

impl Term {
    /// All terms, in the order of the coefficients.
    pub const ALL: [Self; 26] = [
        Self::AnyStretch,
        Self::AnyBend,
        Self::AnyShear,
        Self::Twist,
        Self::Turn,
        Self::Stretch,
        Self::StretchThrice,
        Self::Compression,
        Self::Bend,
        Self::BendRoot,
        Self::StretchRoot,
        Self::StretchBend,
        Self::Shear,
        Self::StretchShear,
        Self::Coupling,
        Self::StretchCoupling,
        Self::RootShear,
        Self::RootCoupling,
        Self::ShearCoupling,
        Self::ShearTwice,
        Self::ShearThrice,
        Self::RootTwiceShear,
        Self::StretchTwiceRoot,
        Self::Pull,
        Self::StretchTwiceShear,
        Self::StretchShearTwice,
    ];

    /// Degree of the polynomial in the bounded twist.
    pub const fn degree(self) -> usize {
        match self {
            Self::AnyStretch | Self::AnyBend | Self::AnyShear | Self::Turn => 0,
            Self::ShearThrice => 2,
            Self::StretchThrice => 4,
            Self::StretchTwiceShear | Self::StretchShearTwice => 3,
            Self::StretchCoupling | Self::RootShear | Self::RootTwiceShear => 5,
            Self::Compression
            | Self::StretchRoot
            | Self::StretchBend
            | Self::StretchTwiceRoot
            | Self::Pull
            | Self::ShearTwice => 6,
            Self::ShearCoupling => 7,
            Self::Bend
            | Self::BendRoot
            | Self::Stretch
            | Self::StretchShear
            | Self::RootCoupling => 8,
            Self::Twist | Self::Shear | Self::Coupling => 9,
        }
    }

    /// Factors of the term.
    const fn factors(self) -> [Variable; 3] {
        use Variable as V;
        match self {
            Self::AnyStretch => [V::AnyStretch, V::AnyStretch, V::One],
            Self::AnyBend => [V::AnyBend, V::One, V::One],
            Self::AnyShear => [V::AnyShear, V::One, V::One],
            Self::Twist => [V::Twist, V::Twist, V::One],
            Self::Turn => [V::Twist, V::One, V::One],
            Self::Stretch => [V::Stretch, V::Stretch, V::One],
            Self::StretchThrice => [V::Stretch, V::Stretch, V::Stretch],
            Self::Compression => [V::Compression, V::One, V::One],
            Self::Bend => [V::Bend, V::One, V::One],
            Self::BendRoot => [V::Root, V::One, V::One],
            Self::StretchRoot => [V::Stretch, V::Root, V::One],
            Self::StretchBend => [V::Stretch, V::Bend, V::One],
            Self::Shear => [V::Shear, V::One, V::One],
            Self::StretchShear => [V::Stretch, V::Shear, V::One],
            Self::Coupling => [V::Coupling, V::One, V::One],
            Self::StretchCoupling => [V::Stretch, V::Coupling, V::One],
            Self::RootShear => [V::Root, V::Shear, V::One],
            Self::RootCoupling => [V::Root, V::Coupling, V::One],
            Self::ShearCoupling => [V::Shear, V::Coupling, V::One],
            Self::ShearTwice => [V::Shear, V::Shear, V::One],
            Self::ShearThrice => [V::Shear, V::Shear, V::Shear],
            Self::RootTwiceShear => [V::Root, V::Root, V::Shear],
            Self::StretchTwiceRoot => [V::Stretch, V::Stretch, V::Root],
            Self::Pull => [V::Stretch, V::One, V::One],
            Self::StretchTwiceShear => [V::Stretch, V::Stretch, V::Shear],
            Self::StretchShearTwice => [V::Stretch, V::Shear, V::Shear],
        }
    }

    /// Value without polynomial.
    // Inlined into the loop over all terms, it crashes LLVM 22 in builds with one codegen unit.
    #[inline(never)]
    pub(super) fn value(self, of: &Values) -> f64 {
        let [x, y, z] = self.factors().map(|factor| of[factor as usize]);
        x * y * z
    }
}

/// Sum of terms: derivatives with respect to the [`Variable`]s.
pub(super) struct TermSum {
    value: f64,
    first: Values,
    second: [Values; VARIABLES],
}

impl TermSum {
    pub(super) fn new() -> Self {
        Self {
            value: 0.0,
            first: [0.0; VARIABLES],
            second: [[0.0; VARIABLES]; VARIABLES],
        }
    }

    /// Adds a term times a function of the twist.
    #[inline]
    pub(super) fn add(&mut self, term: Term, [p, slope, bend]: Jet, of: &Variables) {
        let twist = Variable::Twist as usize;
        let factors = term.factors().map(|factor| factor as usize);
        let [x, y, z] = factors.map(|factor| of.values[factor]);
        for (i, rest) in factors.into_iter().zip([y * z, z * x, x * y]) {
            self.first[i] += p * rest;
            self.second[i][twist] += slope * rest;
            self.second[twist][i] += slope * rest;
        }
        let [i, j, k] = factors;
        for ([a, b], rest) in [([i, j], z), ([j, k], x), ([k, i], y)] {
            self.second[a][b] += p * rest;
            self.second[b][a] += p * rest;
        }
        let product = x * y * z;
        self.value += p * product;
        self.first[twist] += slope * product;
        self.second[twist][twist] += bend * product;
    }

    /// Derivatives with respect to the invariants.
    pub(super) fn by_invariants(&self, of: &Variables) -> InvariantJet {
        let mut jet = InvariantJet {
            value: self.value,
            ..InvariantJet::default()
        };
        for (n, (by, row)) in self.first.iter().zip(&self.second).enumerate() {
            let mut column = [0.0; 5];
            for (x, first) in row.iter().zip(&of.first) {
                for (sum, y) in column.iter_mut().zip(first) {
                    *sum += x * y;
                }
            }
            let (first, second) = (of.first[n], &of.second[n]);
            for v in 0..5 {
                jet.first[v] += by * first[v];
                let pairs = second[v].iter().zip(column);
                for (sum, (x, y)) in jet.second[v].iter_mut().zip(pairs) {
                    *sum += by * x + first[v] * y;
                }
            }
        }
        jet
    }
}

impl InvariantJet {
    /// Product with a function of the twist.
    pub(super) fn times_twist(&self, [p, slope, bend]: Jet) -> Self {
        let mut second = self.second.map(|row| row.map(|x| p * x));
        let mut first = self.first.map(|x| p * x);
        for (k, x) in self.first.into_iter().enumerate() {
            second[BY_TWIST][k] += slope * x;
            second[k][BY_TWIST] += slope * x;
        }
        second[BY_TWIST][BY_TWIST] += bend * self.value;
        first[BY_TWIST] += slope * self.value;
        Self {
            value: p * self.value,
            first,
            second,
        }
    }
}
