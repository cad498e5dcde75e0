//! The terms of the law: products of functions of the four invariants of extension, bending and shear.

/// Curvature (rad/nm) at which bending begins to pull: below it the shift of the neutral axis grows.
const BENT: f64 = 2.5e-3;
/// Extension over which tension gives way to compression.
const SLACK: f64 = 2e-4;

/// One term: a product of functions of the extension `e`, of `a = kappa_1^2 + kappa_2^2`, of
/// `g = sigma_1^2 + sigma_2^2` and of `c = kappa_1 sigma_1 + kappa_2 sigma_2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// `1`: what twist alone stores.
    Twist,
    /// `e^2`: stretch.
    Stretch,
    /// `min(e, 0)^2`, smooth: compression, which the filament resists less.
    Compression,
    /// `a`: bending.
    Bend,
    /// `r = sqrt(a + a_0) - sqrt(a_0)`: bending that tends to a constant couple.
    BendRoot,
    /// `e r`: bending lengthens, as the compressed side gives way more.
    StretchBend,
    /// `max(e, 0) r`, smooth: the same in tension alone.
    TensionBend,
    /// `e^2 r`.
    StretchTwiceBend,
    /// `g`: shear, resisted by what twist has tightened.
    Shear,
    /// `e g`: shear shortens, and tension resists it.
    StretchShear,
    /// `max(e, 0) g`, smooth: the same in tension alone.
    TensionShear,
    /// `g^2`.
    ShearTwice,
    /// `c`: bending turns into shear along its axis, which is chiral.
    Coupling,
    /// `a g`.
    BendShear,
    /// `a c`.
    BendCoupling,
    /// `g c`.
    ShearCoupling,
}

/// A function of one variable with its first and second derivative.
type Jet = [f64; 3];

/// A term with its derivatives by `e`, `a`, `g`, `c`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct TermJet {
    pub(super) value: f64,
    pub(super) first: [f64; 4],
    pub(super) second: [[f64; 4]; 4],
}

const ONE: Jet = [1.0, 0.0, 0.0];

fn linear(x: f64) -> Jet {
    [x, 1.0, 0.0]
}

fn square(x: f64) -> Jet {
    [x * x, 2.0 * x, 2.0]
}

/// `sqrt(a + a_0) - sqrt(a_0)`.
fn root(a: f64) -> Jet {
    let r = (a + BENT * BENT).sqrt();
    // Without the cancellation of the difference.
    [a / (r + BENT), 0.5 / r, -0.25 / (r * r * r)]
}

/// `(e + sqrt(e^2 + e_0^2)) / 2`.
fn tension(e: f64) -> Jet {
    let r = e.hypot(SLACK);
    [
        0.5 * (e + r),
        0.5 * (1.0 + e / r),
        0.5 * SLACK * SLACK / (r * r * r),
    ]
}

/// The square of `(e - sqrt(e^2 + e_0^2)) / 2`.
fn compression(e: f64) -> Jet {
    let r = e.hypot(SLACK);
    let (v, d) = (0.5 * (e - r), 0.5 * (1.0 - e / r));
    let bend = -0.5 * SLACK * SLACK / (r * r * r);
    [v * v, 2.0 * v * d, 2.0 * (d * d + v * bend)]
}

impl Term {
    /// All terms, in the order of the coefficients of a law.
    pub const ALL: [Self; 16] = [
        Self::Twist,
        Self::Stretch,
        Self::Compression,
        Self::Bend,
        Self::BendRoot,
        Self::StretchBend,
        Self::TensionBend,
        Self::StretchTwiceBend,
        Self::Shear,
        Self::StretchShear,
        Self::TensionShear,
        Self::ShearTwice,
        Self::Coupling,
        Self::BendShear,
        Self::BendCoupling,
        Self::ShearCoupling,
    ];

    /// The functions whose product it is.
    fn factors(self, [e, a, g, c]: [f64; 4]) -> [Jet; 4] {
        match self {
            Self::Twist => [ONE; 4],
            Self::Stretch => [square(e), ONE, ONE, ONE],
            Self::Compression => [compression(e), ONE, ONE, ONE],
            Self::Bend => [ONE, linear(a), ONE, ONE],
            Self::BendRoot => [ONE, root(a), ONE, ONE],
            Self::StretchBend => [linear(e), root(a), ONE, ONE],
            Self::TensionBend => [tension(e), root(a), ONE, ONE],
            Self::StretchTwiceBend => [square(e), root(a), ONE, ONE],
            Self::Shear => [ONE, ONE, linear(g), ONE],
            Self::StretchShear => [linear(e), ONE, linear(g), ONE],
            Self::TensionShear => [tension(e), ONE, linear(g), ONE],
            Self::ShearTwice => [ONE, ONE, square(g), ONE],
            Self::Coupling => [ONE, ONE, ONE, linear(c)],
            Self::BendShear => [ONE, linear(a), linear(g), ONE],
            Self::BendCoupling => [ONE, linear(a), ONE, linear(c)],
            Self::ShearCoupling => [ONE, ONE, linear(g), linear(c)],
        }
    }

    /// The term at the four invariants.
    pub(super) fn jet(self, invariants: [f64; 4]) -> TermJet {
        let factors = self.factors(invariants);
        // The product with the factors `i` and `j` differentiated.
        let product = |orders: [usize; 4]| -> f64 {
            factors
                .iter()
                .zip(orders)
                .map(|(jet, order)| jet[order])
                .product()
        };
        let mut jet = TermJet {
            value: product([0; 4]),
            ..TermJet::default()
        };
        for i in 0..4 {
            let mut orders = [0; 4];
            orders[i] += 1;
            jet.first[i] = product(orders);
            for j in 0..4 {
                let mut twice = orders;
                twice[j] += 1;
                jet.second[i][j] = product(twice);
            }
        }
        jet
    }
}
