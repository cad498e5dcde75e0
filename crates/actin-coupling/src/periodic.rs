use actin_mechanics::{ControlId, State, Vector3};

/// Periodic box with a shear of x along z. Its images are displaced by
///
/// ```text
/// r_n = (n_x L_x + c g n_z L_z, n_y L_y, n_z L_z)
/// ```
///
/// `n` are integers, `L` the edges (nm), `g` is the strain, and `c` its factor, a control of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicCell {
    /// Edges `L` (nm).
    pub size: Vector3,
    /// Strain `g`.
    pub strain: f64,
    /// Factor `c`.
    pub factor: ControlId,
}

/// Periodic image of a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicImage {
    /// Periodic box.
    pub cell: PeriodicCell,
    /// Index `n` of the image, or `None` for the nearest image.
    pub index: Option<[i32; 3]>,
}

impl PeriodicCell {
    /// Displacement of an image (nm, lab frame).
    pub fn displacement(&self, index: [i32; 3], state: &State) -> Vector3 {
        self.shift(index.map(f64::from).into(), state)
    }

    /// Position in the box, with fractions of the edges from 0 to 1 (nm, lab frame).
    pub fn wrap(&self, place: Vector3, state: &State) -> Vector3 {
        place - self.shift(self.fractions(place, state).map(f64::floor), state)
    }

    /// Displacement of the image for which `d` plus the displacement is shortest, for vectors `d` (nm, lab frame) to
    /// images closer than half an edge.
    pub fn to_nearest(&self, d: Vector3, state: &State) -> Vector3 {
        -self.shift(self.fractions(d, state).map(f64::round), state)
    }

    fn shift(&self, index: Vector3, state: &State) -> Vector3 {
        let unstrained = index.component_mul(&self.size);
        let strain = self.strain * state.controls[self.factor];
        unstrained + Vector3::x() * (strain * unstrained.z)
    }

    fn fractions(&self, place: Vector3, state: &State) -> Vector3 {
        let strain = self.strain * state.controls[self.factor];
        (place - Vector3::x() * (strain * place.z)).component_div(&self.size)
    }
}

impl PeriodicImage {
    /// Displacement of the image of a site at the vector `d` from another site (nm, lab frame).
    pub(crate) fn displacement(&self, d: Vector3, state: &State) -> Vector3 {
        match self.index {
            Some(index) => self.cell.displacement(index, state),
            None => self.cell.to_nearest(d, state),
        }
    }
}
