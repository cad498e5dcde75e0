//! The terms of the law: functions of extension, bending, shear, their coupling and twist.

/// Invariants of the strains: `e`, `a`, `g`, `c` and `k = kappa_3`, in this order.
pub(super) type Invariants = [f64; 5];

/// Place of the twist among them.
pub(super) const BY_TWIST: usize = 4;

/// Sizes beyond which extension, curvature (rad/nm) and shear no longer add to a term.
pub(crate) const EXTENSION: f64 = 0.02;
pub(crate) const CURVATURE: f64 = 0.02;
pub(crate) const SHEAR: f64 = 0.1;
/// Curvature (rad/nm) about which the shift of the neutral axis becomes constant.
pub(crate) const BENT: f64 = 2.5e-3;
/// Extension over which tension gives way to compression.
pub(crate) const SLACK: f64 = 2e-5;
/// What bending (nm), shear and twist (nm^2) add to the extension at which bonds begin to give way.
pub(crate) const TIGHT: [f64; 3] = [0.5, 5.0, 20.0];

/// One term: a function of the extension `e`, of `a = kappa_1^2 + kappa_2^2`, of `g = sigma_1^2 + sigma_2^2`, of
/// `c = kappa_1 sigma_1 + kappa_2 sigma_2` and of the twist, times a polynomial of
/// [`degree`](Self::degree) in `t = kappa_3 / sqrt(kappa_3^2 + 0.02^2)`.
///
/// Bounded are `E = e / sqrt(1 + (e / 0.02)^2)`, `A = a / (1 + a / 0.02^2)`, `G = g / (1 + g / 0.1^2)`,
/// `C = c / ((1 + a / 0.02^2) (1 + g / 0.1^2))` and `r = sqrt(A + b^2) - b` with `b = 0.0025` /nm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// `e^2`: stretch at any size.
    AnyStretch,
    /// `a`: bending at any size.
    AnyBend,
    /// `g`: shear at any size.
    AnyShear,
    /// `kappa_3^2`: what twist alone stores.
    Twist,
    /// `kappa_3`: a twist of the free filament, which heat gives.
    Turn,
    /// `E^2`: stretch.
    Stretch,
    /// `E^3`: tension stiffens, compression softens.
    StretchThrice,
    /// `y^3 / (y + 2e-5)` of `y = max(-x, 0)`, `x = e + 0.5 r + 5 g + 20 kappa_3^2`: bonds that are pushed together
    /// give way, unless bending, shear or twist has tightened them.
    Compression,
    /// `A`: bending.
    Bend,
    /// `r`: bending that tends to a constant couple.
    BendRoot,
    /// `E r`: bending shortens at small twist, as the compressed side gives way more.
    StretchRoot,
    /// `E A`.
    StretchBend,
    /// `G`: shear, resisted by what twist has tightened.
    Shear,
    /// `E G`: shear shortens, and tension resists it.
    StretchShear,
    /// `C`: bending turns into shear along its axis.
    Coupling,
    /// `E C`.
    StretchCoupling,
    /// `r G`: bending tightens, and with it resists shear.
    RootShear,
    /// `r C`.
    RootCoupling,
    /// `G C`.
    ShearCoupling,
    /// `G^2`.
    ShearTwice,
    /// `G^3`.
    ShearThrice,
    /// `r^2 G`: strong bending resists shear less, or more, than `r G` says.
    RootTwiceShear,
    /// `E^2 r`: bent rods stretch more easily.
    StretchTwiceRoot,
}

/// A function of one variable with its first and second derivative.
pub(super) type Jet = [f64; 3];

/// A function of the invariants with its derivatives.
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

/// `f` of the inner function, which was taken at its value.
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

/// `x / (1 + x / size^2)`, of a square.
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
    // Without the cancellation of the difference.
    let outer = [bent[0] / (r + BENT), 0.5 / r, -0.25 / (r * r * r)];
    of(outer, bent)
}

/// `y^3 / (y + w)` for `y = -x` above zero: close to `x^2` beyond `w`, nothing in tension.
fn compression(x: f64) -> Jet {
    let y = (-x).max(0.0);
    let q = (y + SLACK).recip();
    let (u, w) = (y * q, SLACK * q);
    // u + w = 1.
    [
        y * y * u,
        -y * u * (2.0 * u + 3.0 * w),
        2.0 * u * (u * u + 3.0 * u * w + 3.0 * w * w),
    ]
}

/// What terms are made of, at some strain.
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
    /// What `c` fades with: curvature and shear.
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
    /// What the coupling is multiplied by, with the coupling.
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
    /// All terms, in the order of the coefficients of a law.
    pub const ALL: [Self; 23] = [
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
    ];

    /// Degree of the polynomial in the twist.
    pub const fn degree(self) -> usize {
        match self {
            Self::AnyStretch | Self::AnyBend | Self::AnyShear | Self::Turn => 0,
            Self::ShearThrice => 2,
            Self::StretchThrice => 4,
            Self::StretchCoupling | Self::RootShear | Self::RootTwiceShear => 5,
            Self::Compression
            | Self::StretchRoot
            | Self::StretchBend
            | Self::StretchTwiceRoot
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

    /// The functions whose product it is, but for compression.
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
        }
    }

    /// The term without its polynomial and derivatives: what [`jet`](Self::jet) has as its value, to the last bit.
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

    /// The term without its polynomial.
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

/// [`Term::Compression`].
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
    /// Times a function of one of the invariants.
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
