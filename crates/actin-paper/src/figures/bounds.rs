//! The one rule for bounds: how far a number may be from what is expected of it, in all figures and
//! tables alike. It looks at what is expected, not at what comes out.

/// What notes say of an earlier calculation.
pub(super) const CROSS_CHECK: &str =
    "cross-check: an earlier calculation that shares this code's modelling decisions";

/// What the page says of it, before any verdict.
pub(super) const RULE: [(&str, &str); 6] = [
    (
        "A number that the paper prints",
        "half a unit of its last digit (zeros at the end of 120, 330 or 700 are no digits, those of 10 \
         and 40 are), and, where bonds are drawn, twice the standard deviation of a single filament: the \
         paper shows one and does not say which. Entries of Tables 3 and 5 may also be off by what half a \
         digit of their printed curvature makes, numbers from thermal motion by twice their standard error, \
         and a fit to printed rows by what half a digit of those rows makes",
    ),
    (
        "Shapes that the paper calls alike without a number",
        "1.8 nm, the radius of the helix on which the centres of monomers lie",
    ),
    (
        "Numbers that the paper calls alike or close",
        "10 %, what it calls a difference itself (Figure 7)",
    ),
    (
        "Statements of order (larger, easier, better)",
        "the sign decides, without a margin",
    ),
    ("Theorems", "1e-8, the round-off of an equilibrium"),
    (
        "An earlier calculation",
        "half a unit of its last digit; only rods are compared, since its monomers had other bonds",
    ),
];

/// Distance of monomers' centres from the axis (nm).
pub(super) const SHAPE_NM: f64 = 1.8;
/// Share by which two numbers differ where the paper itself speaks of a difference.
pub(super) const A_DIFFERENCE: f64 = 0.1;
/// Round-off of what holds exactly.
pub(super) const ROUND_OFF: f64 = 1e-8;
