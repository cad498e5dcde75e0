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

const ONE: Jet = [1.0, 0.0, 0.0];

fn linear(x: f64) -> Jet {
    [x, 1.0, 0.0]
}

fn square(x: f64) -> Jet {
    [x * x, 2.0 * x, 2.0]
}

fn times(f: Jet, g: Jet) -> Jet {
    [
        f[0] * g[0],
        f[1] * g[0] + f[0] * g[1],
        f[2] * g[0] + 2.0 * f[1] * g[1] + f[0] * g[2],
    ]
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
fn bounded_square(x: f64, size: f64) -> Jet {
    let q = 1.0 + x / (size * size);
    [x / q, q.powi(-2), -2.0 / (size * size) * q.powi(-3)]
}

/// `1 / (1 + x / size^2)`.
fn fading(x: f64, size: f64) -> Jet {
    let (s, q) = (size * size, 1.0 + x / (size * size));
    [q.recip(), -q.powi(-2) / s, 2.0 / (s * s) * q.powi(-3)]
}

/// `sqrt(A + b^2) - b`.
fn root(a: f64) -> Jet {
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

#[derive(Clone, Copy, Debug)]
pub(super) struct Factors {
    e: f64,
    a: f64,
    g: f64,
    c: f64,
    k: f64,
    /// `E`.
    stretch: Jet,
    /// `A`.
    bend: Jet,
    /// `r`.
    root: Jet,
    /// `G`.
    shear: Jet,
    /// Decay of `C` with curvature and shear.
    fading: [Jet; 2],
}

impl Factors {
    pub(super) fn at([e, a, g, c, k]: Invariants) -> Self {
        Self {
            e,
            a,
            g,
            c,
            k,
            stretch: bounded(e, EXTENSION),
            bend: bounded_square(a, CURVATURE),
            root: root(a),
            shear: bounded_square(g, SHEAR),
            fading: [fading(a, CURVATURE), fading(g, SHEAR)],
        }
    }
}

impl Factors {
    fn coupled(&self, stretch: Jet, bend: Jet, shear: Jet) -> [Jet; 5] {
        let [of_a, of_g] = self.fading;
        [
            stretch,
            times(bend, of_a),
            times(shear, of_g),
            linear(self.c),
            ONE,
        ]
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

    #[inline]
    fn factors(self, of: &Factors) -> [Jet; 5] {
        let &Factors { e, a, g, k, .. } = of;
        let &Factors {
            stretch,
            bend,
            root,
            shear,
            ..
        } = of;
        let coupled = |stretch, bend, shear| of.coupled(stretch, bend, shear);
        match self {
            Self::AnyStretch => [square(e), ONE, ONE, ONE, ONE],
            Self::AnyBend => [ONE, linear(a), ONE, ONE, ONE],
            Self::AnyShear => [ONE, ONE, linear(g), ONE, ONE],
            Self::Twist => [ONE, ONE, ONE, ONE, square(k)],
            Self::Turn => [ONE, ONE, ONE, ONE, linear(k)],
            Self::Stretch => [times(stretch, stretch), ONE, ONE, ONE, ONE],
            Self::StretchThrice => [times(stretch, times(stretch, stretch)), ONE, ONE, ONE, ONE],
            Self::Compression => [ONE; 5],
            Self::Bend => [ONE, bend, ONE, ONE, ONE],
            Self::BendRoot => [ONE, root, ONE, ONE, ONE],
            Self::StretchRoot => [stretch, root, ONE, ONE, ONE],
            Self::StretchBend => [stretch, bend, ONE, ONE, ONE],
            Self::Shear => [ONE, ONE, shear, ONE, ONE],
            Self::StretchShear => [stretch, ONE, shear, ONE, ONE],
            Self::Coupling => coupled(ONE, ONE, ONE),
            Self::StretchCoupling => coupled(stretch, ONE, ONE),
            Self::RootShear => [ONE, root, shear, ONE, ONE],
            Self::RootCoupling => coupled(ONE, root, ONE),
            Self::ShearCoupling => coupled(ONE, ONE, shear),
            Self::ShearTwice => [ONE, ONE, times(shear, shear), ONE, ONE],
            Self::ShearThrice => [ONE, ONE, times(shear, times(shear, shear)), ONE, ONE],
            Self::RootTwiceShear => [ONE, times(root, root), shear, ONE, ONE],
            Self::StretchTwiceRoot => [times(stretch, stretch), root, ONE, ONE, ONE],
            Self::Pull => [stretch, ONE, ONE, ONE, ONE],
            Self::StretchTwiceShear => [times(stretch, stretch), ONE, shear, ONE, ONE],
            Self::StretchShearTwice => [stretch, ONE, times(shear, shear), ONE, ONE],
        }
    }

    /// Value without polynomial, bit-identical to that of [`jet`](Self::jet).
    #[inline]
    pub(super) fn value(self, of: &Factors) -> f64 {
        if self == Self::Compression {
            return compressed(of).value;
        }
        let factors = self.factors(of);
        factors
            .iter()
            .fold(1.0, |value, [factor, ..]| value * factor)
    }

    pub(super) fn jet(self, of: &Factors) -> InvariantJet {
        if self == Self::Compression {
            return compressed(of);
        }
        let mut jet = InvariantJet {
            value: 1.0,
            ..InvariantJet::default()
        };
        for (variable, factor) in self.factors(of).into_iter().enumerate() {
            if factor != ONE {
                jet = jet.times(variable, factor);
            }
        }
        jet
    }
}

fn compressed(&Factors { e, g, k, root, .. }: &Factors) -> InvariantJet {
    let [of_r, of_g, of_k] = TIGHT;
    let r = root.map(|x| of_r * x);
    let [value, slope, bend] = compression(e + r[0] + of_g * g + of_k * k * k);
    let by = [1.0, r[1], of_g, 0.0, 2.0 * of_k * k];
    let mut second = by.map(|x| by.map(|y| bend * x * y));
    second[1][1] += r[2] * slope;
    second[BY_TWIST][BY_TWIST] += 2.0 * of_k * slope;
    InvariantJet {
        value,
        first: by.map(|x| slope * x),
        second,
    }
}

impl InvariantJet {
    /// Product with a function of one invariant.
    pub(super) fn times(mut self, variable: usize, [p, slope, bend]: Jet) -> Self {
        let (value, first, by_it) = (self.value, self.first, self.second[variable]);
        for row in &mut self.second {
            for x in row {
                *x *= p;
            }
        }
        for k in 0..5 {
            self.first[k] *= p;
            self.second[variable][k] = p * by_it[k] + slope * first[k];
            self.second[k][variable] = self.second[variable][k];
        }
        self.second[variable][variable] =
            p * by_it[variable] + 2.0 * slope * first[variable] + bend * value;
        self.first[variable] += slope * value;
        self.value *= p;
        self
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.value += other.value;
        for i in 0..5 {
            self.first[i] += other.first[i];
            for j in 0..5 {
                self.second[i][j] += other.second[i][j];
            }
        }
    }
}
