//! Constants of the rod model with their sources.

use std::f64::consts::PI;

/// Rigidities of shear (two) and stretch (pN). Source: arXiv 2203.01284, Table 4.
pub const TABLE_4_SHEAR: [f64; 3] = [1.6e4, 1.6e4, 3.4e4];

/// Rigidities of bending (two) and twist (pN nm^2). Source: arXiv 2203.01284, Table 4, and Appendix
/// B for B3.
pub(crate) const TABLE_4_BEND: [f64; 3] = [3.9e4, 3.9e4, 1.3e4];

/// Young's modulus (pN/nm^2). Source: arXiv 2203.01284, Table 2.
pub const PRECEDING_PAPER_YOUNG_MODULUS: f64 = 2000.0;

/// Poisson's ratio. Source: arXiv 2203.01284, Table 2.
pub const PRECEDING_PAPER_POISSON_RATIO: f64 = 0.4;

/// Area of the cross-section (nm^2). Source: arXiv 2203.01284, Appendix B.
pub const CROSS_SECTION_AREA: f64 = 38.5;

/// Radius of a circular cross-section of area [`CROSS_SECTION_AREA`] (nm).
pub fn cross_section_radius() -> f64 {
    (CROSS_SECTION_AREA / PI).sqrt()
}

/// Mass per length (pN ns^2/nm^2): 42 kDa per rise of 71.2/26 nm, as for filaments of monomers.
pub(crate) const LINEAR_DENSITY: f64 = 0.0697 / (71.2 / 26.0);

/// Limit of the twist rigidity in over-twist (pN nm^2). Source: arXiv 2203.01284, Appendix B.
pub(crate) const B3_PLUS: f64 = 1.6e4;

/// Limit of the twist rigidity in under-twist (pN nm^2). Source: arXiv 2203.01284, Appendix B.
pub(crate) const B3_MINUS: f64 = 9.6e3;

/// Parameters `lambda_1` to `lambda_7` of the twist rigidity (rad/nm; `lambda_3` dimensionless).
/// Source: arXiv 2203.01284, Appendix B.
pub(crate) const B3_LAMBDA: [f64; 7] = [
    1.5928e-2, 7.2455e-3, 4.5982, 1.0e-6, 1.8196e-2, 4.5935e-3, 1.7203e-2,
];

/// Coefficients `p_0` to `p_6` of `xi - 1` (nm^i/rad^i). Source: arXiv 2203.01284, Appendix B,
/// where they are attributed to `xi`, although they fit `xi - 1` of Table 5.
pub const XI_COEFFICIENTS: [f64; 7] = [
    -5.0666e-4, -3.2416e-1, -20.508, 79.376, 1.0660e4, -2.4927e4, -2.6662e6,
];

/// Largest twist (rad/nm) of the fitted rows of Tables 3 and 5: 200 degrees over 75.5 nm. Source:
/// arXiv 2203.01284, Appendix B.
pub(crate) const TWIST_RANGE: f64 = 0.0462;

/// Coupling `C3` of stretch and twist (pN nm): slope -0.2831 nm of length against twist times S3 =
/// 3.4e4 pN.
///
/// Source: the slope `R0^2 sin(-166.154 deg) / 2.7385 nm` of a helix of radius 1.8 nm with constant
/// distances between neighbours; `docs/validation.md`.
pub const C3: f64 = 9.63e3;
