//! Numbers of the rod model, each with its source.

/// Shearing, shearing and stretching rigidity (pN). Source: arXiv 2203.01284, Table 4.
pub const TABLE_4_SHEAR: [f64; 3] = [1.6e4, 1.6e4, 3.4e4];

/// Bending, bending and twisting rigidity (pN nm^2). Source: arXiv 2203.01284, Table 4, with the
/// constant B3 of Appendix B.
pub const TABLE_4_BEND: [f64; 3] = [3.9e4, 3.9e4, 1.3e4];

/// Young's modulus (pN/nm^2). Source: arXiv 2203.01284, Table 2.
pub const PRECEDING_PAPER_YOUNG_MODULUS: f64 = 2000.0;

/// Poisson's ratio. Source: arXiv 2203.01284, Table 2.
pub const PRECEDING_PAPER_POISSON_RATIO: f64 = 0.4;

/// Area of the cross-section (nm^2). Source: arXiv 2203.01284, Appendix B.
pub const CROSS_SECTION_AREA: f64 = 38.5;

/// Mass per length (pN ns^2/nm^2): 42 kDa per rise of 71.2/26 nm, the same as that of a filament
/// of monomers.
pub const LINEAR_DENSITY: f64 = 0.0697 / (71.2 / 26.0);
