use crate::JunctionError;
use crate::bond::Bond;
use crate::build::{check_count, check_distance};
use actin_cosserat::{BendingElement, End, JoinedElement, RodLayout, RodMaterial, ShearElement};
use actin_mechanics::{
    Interaction, Loads, RandomStress, SecondOrder, State, Stiffness, Vector3, rotation,
};
use std::ops::Range;

/// Largest angle (rad) between parallel frames.
const PARALLEL: f64 = 1e-9;

/// Weight of each bond of a junction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum JunctionWeight {
    /// The bonds of a junction share the rigidity of the rod.
    #[default]
    Shared,
    /// Every bond has the full rigidity of the rod, as in the text of the paper.
    Full,
}

/// Order of the sections along the filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JunctionSide {
    /// Monomers before the start of the rod.
    MonomersFirst,
    /// Monomers after the end of the rod.
    RodFirst,
}

/// Monomer attached to a rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AttachedMonomer {
    /// Index of the point at its centre.
    pub point: usize,
    /// Index of its frame.
    pub frame: usize,
}

/// Components of a junction.
#[derive(Clone, Debug)]
pub struct JunctionParts<'a> {
    /// Order of the sections.
    pub side: JunctionSide,
    /// Weight of each bond.
    pub weight: JunctionWeight,
    /// One or two attached monomers, in filament order.
    pub monomers: &'a [AttachedMonomer],
    /// Junction frames from [`push_junction_frames`](crate::push_junction_frames).
    pub frames: Range<usize>,
    /// The rod.
    pub rod: &'a RodLayout,
    /// Material of the rod.
    pub material: RodMaterial,
}

/// Junction of one or two monomers with the end of a rod: term `junction`, one element per bond.
///
/// ```text
/// E = w [ W(sigma) |lhat| + U(kappa_E) D_E + U(kappa_C) D_C ]
///
/// sigma   = Q_J^T l / |lhat| - d,   l = r - R,   d = Qhat_J^T lhat / |lhat|
/// kappa_E = log(G^T Q_J) / D_E,     G = Q_m Qhat_m^T Qhat_J,   D_E = |lhat . d3| / 2
/// kappa_C = log(Q_J^T Q_r) / D_C,   D_C = D_E + half the rest length of the end segment
/// ```
///
/// `E` is the energy of a bond (pN nm), `w` its weight, and `W`, `U` are the energies per length of
/// the rod material (pN). `r` is the end of the rod and `R` the centre of the monomer (nm, lab
/// frame). `Q_m`, `Q_J` and `Q_r` are the frames of monomer, junction and rod, and hats mark the
/// rest state. For a rod before monomers `l = R - r`, and the rotations in both logarithms are
/// inverted.
///
/// The element of length `D_C` has the rest curvature of the rod times the fraction of `D_C` inside
/// the rod. Monomers can be [twisted](Self::with_monomer_twist) at rest. Loads are the negative
/// gradient of `E`, so linear and angular momentum are conserved.
///
/// # Source
/// arXiv 2203.01284, Section 3, with signs and factors derived from this energy. The printed
/// balance equations do not conserve momentum.
#[derive(Clone, Debug)]
pub struct Junction {
    pub(crate) bonds: Vec<Bond>,
    pub(crate) weight: f64,
    pub(crate) material: RodMaterial,
    /// Half the rest length of the end segment (nm).
    pub(crate) half_segment: f64,
    /// `true` if the random stress of the rod includes the half segment beyond the last frame.
    pub(crate) is_covered: bool,
}

impl Junction {
    /// Creates a junction that is at rest in `state`.
    ///
    /// # Errors
    /// If the number of monomers is not 1 or 2, or differs from the number of frames. Also if a
    /// monomer is on the wrong side of the end of the rod, or a junction frame is not parallel to
    /// the end segment.
    pub fn new(state: &State, parts: JunctionParts<'_>) -> Result<Self, JunctionError> {
        let JunctionParts {
            side,
            weight,
            monomers,
            frames,
            rod,
            material,
        } = parts;
        check_count(monomers.len())?;
        if frames.len() != monomers.len() {
            return Err(JunctionError::JunctionFrames {
                frames: frames.len(),
                monomers: monomers.len(),
            });
        }
        let bonds = monomers
            .iter()
            .zip(frames)
            .enumerate()
            .map(|(k, (monomer, frame))| {
                bond_at_rest(state, side, (k, monomer), frame, (rod, material))
            })
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            weight: weight.per_bond(bonds.len()),
            bonds,
            material,
            half_segment: 0.5 * rod.end_length(side.rod_end()),
            is_covered: false,
        })
    }

    /// Adapts the [random stress](actin_mechanics::RandomStress) to a rod whose law couples strain
    /// and curvature. The curvature of the rod must include the [joined
    /// elements](Self::joined_elements).
    #[must_use]
    pub fn with_extended_rod(self) -> Self {
        Self {
            is_covered: true,
            ..self
        }
    }

    /// Adapts the rest state to monomers that are twisted at rest (rad/nm) relative to the state in
    /// which the junction was created.
    #[must_use]
    pub fn with_monomer_twist(mut self, twist: f64) -> Self {
        for bond in &mut self.bonds {
            bond.twist_at_rest(twist);
        }
        self
    }

    /// Bending elements between the end segment and the junction frames. The mean curvature of the
    /// end segment includes them.
    pub fn joined_elements(&self) -> Vec<JoinedElement> {
        self.bonds.iter().map(Bond::joined).collect()
    }

    /// Curvatures (rad/nm) of the two bending elements of each bond, in filament order:
    /// `kappa_E, kappa_C` before a rod and `kappa_C, kappa_E` after it. Positive third components
    /// are right-handed twist.
    pub fn curvatures<'a>(
        &'a self,
        state: &'a State,
    ) -> impl ExactSizeIterator<Item = [Vector3; 2]> + 'a {
        self.bonds.iter().map(|bond| bond.curvatures(state))
    }
}

impl JunctionWeight {
    /// Weight of each bond.
    ///
    /// ```
    /// use actin_coupling::JunctionWeight::{Full, Shared};
    /// assert_eq!((Shared.per_bond(1), Shared.per_bond(2), Full.per_bond(2)), (1.0, 0.5, 1.0));
    /// ```
    pub fn per_bond(self, bonds: usize) -> f64 {
        match self {
            Self::Shared => 1.0 / bonds as f64,
            Self::Full => 1.0,
        }
    }
}

impl JunctionSide {
    /// End of the rod with the attached monomers.
    pub fn rod_end(self) -> End {
        match self {
            Self::MonomersFirst => End::Start,
            Self::RodFirst => End::End,
        }
    }
}

/// Bond of attached monomer `k`, at rest in `state`.
fn bond_at_rest(
    state: &State,
    side: JunctionSide,
    (k, monomer): (usize, &AttachedMonomer),
    junction: usize,
    (layout, material): (&RodLayout, RodMaterial),
) -> Result<Bond, JunctionError> {
    let end = side.rod_end();
    let rod = layout.end_frame(end);
    let q = &state.frames.orientation;
    check_parallel(state, [junction, rod])?;
    let end_point = layout.end_point(end);
    let (points, frames, monomer_at) = match side {
        JunctionSide::MonomersFirst => (
            [monomer.point, end_point],
            [monomer.frame, junction, rod],
            0,
        ),
        JunctionSide::RodFirst => (
            [end_point, monomer.point],
            [rod, junction, monomer.frame],
            2,
        ),
    };
    let x = &state.points.position;
    let l = q.get(junction).inverse() * (x.get(points[1]) - x.get(points[0]));
    check_distance(k, l.z)?;
    let (bending, materials) = bends_at_rest(side, [l.z, layout.end_length(end)], material);
    let beside_rod = &materials[usize::from(monomer_at == 0)];
    Ok(Bond {
        points,
        frames,
        monomer: monomer_at,
        offset: q.get(monomer.frame).inverse() * q.get(junction),
        shear: ShearElement {
            rest_length: l.norm(),
            rest_direction: l.normalize(),
        },
        bending,
        curvature_difference: material.rest_curvature() - beside_rod.rest_curvature(),
        materials,
    })
}

fn check_parallel(state: &State, [frame, rod]: [usize; 2]) -> Result<(), JunctionError> {
    let q = &state.frames.orientation;
    let angle = rotation::log(q.get(frame).inverse() * q.get(rod)).norm();
    if angle > PARALLEL || angle.is_nan() {
        return Err(JunctionError::NotParallel { frame, angle });
    }
    Ok(())
}

/// Bending elements of a bond and their materials, in filament order. `axial` is the axial distance
/// of the monomer from the end of the rod and `segment` the length of the end segment (nm).
fn bends_at_rest(
    side: JunctionSide,
    [axial, segment]: [f64; 2],
    material: RodMaterial,
) -> ([BendingElement; 2], [RodMaterial; 2]) {
    let distances = [0.5 * axial, 0.5 * (segment + axial)];
    let mut bending = distances.map(|rest_distance| BendingElement { rest_distance });
    let shares = [0.0, 0.5 * segment / distances[1]];
    let mut materials = shares.map(|share| {
        let own = material.with_rest_curvature(material.rest_curvature() * share);
        own.expect("fractions of a finite curvature are finite")
    });
    if side == JunctionSide::RodFirst {
        bending.reverse();
        materials.reverse();
    }
    (bending, materials)
}

impl Interaction for Junction {
    fn term(&self) -> &'static str {
        "junction"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        for bond in &self.bonds {
            bond.add_loads(self.weight, &self.material, state, loads);
        }
    }

    fn elements(&self) -> usize {
        self.bonds.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.bonds.len(), "one energy per bond");
        for (energy, bond) in energies.iter_mut().zip(&self.bonds) {
            *energy = self.weight * bond.energy(&self.material, state);
        }
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn random_stress(&self) -> Option<&dyn RandomStress> {
        Some(self)
    }
}

impl SecondOrder for Junction {
    fn add_stiffness(&self, state: &State, stiffness: &mut Stiffness) {
        for bond in &self.bonds {
            bond.add_stiffness(self.weight, &self.material, state, stiffness);
        }
    }
}
