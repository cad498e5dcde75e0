//! Strains of the grid.

/// Grid values of each strain. A slice has one twist and one extension.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axes {
    pub(super) twist: Vec<f64>,
    /// Stretch `sigma_3` relative to the free filament of the same twist with its
    /// [shortening](actin_paper::cells::shortening).
    pub(super) extension: Vec<f64>,
    /// Angle between curvature and shear (deg). Opposite angles are equivalent by end-for-end symmetry.
    pub(super) angle_deg: Vec<f64>,
    pub(super) curvature: Vec<f64>,
    pub(super) shear: Vec<f64>,
}

impl Axes {
    pub(super) fn new(quick: bool) -> Self {
        if quick {
            return Self {
                twist: vec![-0.018, 0.0, 0.018],
                extension: vec![0.0, 6e-4],
                angle_deg: vec![0.0, 90.0, 180.0],
                curvature: vec![0.0, 2.5e-3, 1e-2],
                shear: vec![0.0, 3e-3, 0.015],
            };
        }
        let sided = |half: &[f64]| {
            let negative = half.iter().rev().map(|x| -x);
            negative.chain([0.0]).chain(half.iter().copied()).collect()
        };
        Self {
            twist: sided(&[1e-3, 3e-3, 6e-3, 0.01, 0.015, 0.021, 0.029, 0.038, 0.048]),
            extension: vec![-2e-3, -5e-4, 0.0, 2e-4, 6e-4, 1.5e-3, 3e-3, 6e-3],
            angle_deg: vec![0.0, 45.0, 90.0, 135.0, 180.0],
            curvature: vec![0.0, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 2e-2],
            shear: vec![0.0, 1e-3, 3e-3, 7e-3, 0.015, 0.03],
        }
    }

    pub(super) fn points(&self) -> usize {
        let bent = self.curvature.iter().filter(|&&k| k > 0.0).count();
        let sheared = self.shear.iter().filter(|&&g| g > 0.0).count();
        bent * sheared * self.angle_deg.len() + self.curvature.len() + sheared
    }
}
