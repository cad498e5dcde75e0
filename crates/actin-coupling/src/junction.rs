//! The junction as an interaction. What one bond does is in `bond.rs`.

use crate::JunctionError;
use crate::bond::Bond;
use crate::build::{check_count, check_distance};
use actin_cosserat::{BendingElement, JoinedElement, RodEnd, RodLayout, RodMaterial, ShearElement};
use actin_mechanics::{
    Interaction, Loads, RandomStress, SecondOrder, State, Stiffness, Vector3, rotation,
};
use std::ops::Range;

/// Largest angle (rad) between frames that count as parallel: far above the round-off of any
/// construction, far below any strain of interest.
const PARALLEL: f64 = 1e-9;

/// How strongly each bond of a junction acts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum JunctionWeight {
    /// The bonds share the rod's rigidity: each has 1 over their number.
    #[default]
    Shared,
    /// Every bond has the rod's full rigidity, as the paper's text has it.
    Full,
}

/// Which section comes first along the filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JunctionSide {
    /// Monomers, then the rod: they are attached to its start.
    MonomersFirst,
    /// The rod, then monomers: they are attached to its end.
    RodFirst,
}

/// A monomer that is attached to a rod.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AttachedMonomer {
    /// The point at its centre.
    pub point: usize,
    /// Its frame.
    pub frame: usize,
}

/// What a junction is made of.
#[derive(Clone, Debug)]
pub struct JunctionParts<'a> {
    /// Which section comes first.
    pub side: JunctionSide,
    /// How strongly each bond acts.
    pub weight: JunctionWeight,
    /// One or two monomers, in filament order: attached to the start of the rod, or, if the rod
    /// comes first, to its end.
    pub monomers: &'a [AttachedMonomer],
    /// Their junction frames, from [`push_junction_frames`](crate::push_junction_frames).
    pub frames: Range<usize>,
    /// The rod.
    pub rod: &'a RodLayout,
    /// Its material.
    pub material: RodMaterial,
}

/// The junction of one or two monomers with a rod's end: term `junction`, one element per bond.
///
/// With `r` the rod's end, `R` the monomer's centre, `Q_m`, `Q_J`, `Q_r` the frames of monomer,
/// junction and rod, and hats for the state in which the junction was made, the energy of a bond
/// is
///
/// `E = w [ W(sigma) |lhat| + U(kappa_E) D_E + U(kappa_C) D_C ]`,
///
/// with the rod material's energies per length `W`, `U`, the weight `w`, and
///
/// - `sigma = Q_J^T l / |lhat| - d`, `l = r - R`, `d = Qhat_J^T lhat / |lhat|`;
/// - `kappa_E = log(G^T Q_J) / D_E`, `G = Q_m Qhat_m^T Qhat_J`, `D_E = |lhat . d3| / 2`;
/// - `kappa_C = log(Q_J^T Q_r) / D_C`, `D_C` half the rest length of the rod's end segment plus
///   `D_E`.
///
/// A rod that is bent at rest bends the part of `D_C` that is rod: `kappa_C` is counted from its curvature
/// at rest times the share of half the end segment in `D_C`.
///
/// Where the rod comes first, `l = R - r` and both logarithms are of the inverse rotation. Loads
/// are minus the gradient, so linear and angular momentum balance. It is the same beside either
/// force law of the rod; the printed balance has factors `1/e` and `1/E^3` here too, and signs
/// that do not balance.
///
/// # Source
/// arXiv 2203.01284, Section 3, with its signs derived from this energy.
#[derive(Clone, Debug)]
pub struct Junction {
    pub(crate) bonds: Vec<Bond>,
    pub(crate) weight: f64,
    pub(crate) material: RodMaterial,
    /// Half the rest length of the rod's end segment (nm).
    pub(crate) half_segment: f64,
    /// Whether the random stress of the rod covers this half beyond the segment's frame.
    pub(crate) is_covered: bool,
}

impl Junction {
    /// The junction of these parts that is at rest in `state`.
    ///
    /// # Errors
    /// Other than one or two monomers, not as many frames, a monomer that is not on its side of
    /// the rod's end, or a junction frame that is not parallel to the rod's end segment.
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
            weight: weight.of(bonds.len()),
            bonds,
            material,
            half_segment: 0.5 * rod.end_length(side.rod_end()),
            is_covered: false,
        })
    }

    /// The same beside a rod whose strain knows of its curvature, that of the
    /// [joined elements](Self::joined_elements) included: its [random stress](actin_mechanics::RandomStress) covers a
    /// part of these.
    #[must_use]
    pub fn beside_extended_rod(self) -> Self {
        Self {
            is_covered: true,
            ..self
        }
    }

    /// The junction frames.
    pub fn frames(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.bonds.iter().map(Bond::junction)
    }

    /// The bending elements that join the rod's end segment to the junction frames: with the
    /// rod's own they give the mean curvature around that segment.
    pub fn joined_elements(&self) -> Vec<JoinedElement> {
        self.bonds.iter().map(Bond::joined).collect()
    }

    /// Curvatures (rad/nm) of each bond's two bending elements, in filament order on either side:
    /// `kappa_E, kappa_C` before a rod, `kappa_C, kappa_E` after one. The third components are
    /// positive for right-handed twist.
    pub fn curvatures<'a>(
        &'a self,
        state: &'a State,
    ) -> impl ExactSizeIterator<Item = [Vector3; 2]> + 'a {
        self.bonds.iter().map(|bond| bond.curvatures(state))
    }
}

impl JunctionWeight {
    /// The weight of each of `bonds` bonds.
    ///
    /// ```
    /// use actin_coupling::JunctionWeight::{Full, Shared};
    /// assert_eq!((Shared.of(1), Shared.of(2), Full.of(2)), (1.0, 0.5, 1.0));
    /// ```
    pub fn of(self, bonds: usize) -> f64 {
        match self {
            Self::Shared => 1.0 / bonds as f64,
            Self::Full => 1.0,
        }
    }
}

impl JunctionSide {
    /// The end of the rod that the monomers are attached to.
    pub fn rod_end(self) -> RodEnd {
        match self {
            Self::MonomersFirst => RodEnd::Start,
            Self::RodFirst => RodEnd::End,
        }
    }
}

/// The bond of attached monomer `k` that is at rest in `state`.
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
        lacking: material.rest_curvature() - beside_rod.rest_curvature(),
        materials,
    })
}

/// Refuses a junction frame that is not parallel to the rod's.
fn check_parallel(state: &State, [frame, rod]: [usize; 2]) -> Result<(), JunctionError> {
    let q = &state.frames.orientation;
    let angle = rotation::log(q.get(frame).inverse() * q.get(rod)).norm();
    if angle > PARALLEL || angle.is_nan() {
        return Err(JunctionError::NotParallel { frame, angle });
    }
    Ok(())
}

/// The bending elements of a bond in filament order, with their materials; `axial` is the distance of the monomer
/// from the rod's end along the axis, `segment` the length of its end segment (nm).
fn bends_at_rest(
    side: JunctionSide,
    [axial, segment]: [f64; 2],
    material: RodMaterial,
) -> ([BendingElement; 2], [RodMaterial; 2]) {
    let distances = [0.5 * axial, 0.5 * (segment + axial)];
    let mut bending = distances.map(|rest_distance| BendingElement { rest_distance });
    // Only the part that is rod is bent at rest.
    let shares = [0.0, 0.5 * segment / distances[1]];
    let mut materials = shares.map(|share| {
        let own = material.with_rest_curvature(material.rest_curvature() * share);
        own.expect("a share of a finite curvature is finite")
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
