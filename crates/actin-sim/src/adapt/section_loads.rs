//! What the cross-sections of a filament carry, and how its rods are strained.

use crate::assembly::{BodyKind, Part};
use crate::shape::Ribbon;
use crate::shape::axis::{Axis, CrossSection};
use crate::{Assembly, SectionSpan};
use actin_cosserat::FarFromEnds;
use actin_ellipsoid::SixVector;
use actin_mechanics::{Interaction, Loads, State, Vector3};
use std::ops::Range;

/// Couple and force (or curvature and shear strain) as six numbers.
pub(super) fn six(rotational: Vector3, linear: Vector3) -> SixVector {
    let (r, l) = (rotational, linear);
    SixVector::new(r.x, r.y, r.z, l.x, l.y, l.z)
}

/// The first three of six numbers: couple, curvature or turn.
pub(super) fn rotational(v: &SixVector) -> Vector3 {
    Vector3::new(v[0], v[1], v[2])
}

/// The last three: force, shear strain or displacement.
pub(super) fn linear(v: &SixVector) -> Vector3 {
    Vector3::new(v[3], v[4], v[5])
}

/// What is elastic of a filament: its sections and junctions.
pub(super) fn elastic(assembly: &Assembly) -> impl Iterator<Item = &dyn Interaction> {
    let all = assembly.system.interactions().iter().zip(&assembly.terms);
    all.filter(|(_, term)| matches!(term.part, Part::Section(_) | Part::Junction(_)))
        .map(|(interaction, _)| &**interaction)
}

/// The energy of what is elastic (pN nm).
pub(super) fn elastic_energy(assembly: &Assembly, state: &State) -> f64 {
    elastic(assembly).map(|part| part.energy(state)).sum()
}

/// What it exerts on every body.
pub(super) fn elastic_loads(assembly: &Assembly, state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    elastic(assembly).for_each(|part| part.add_loads(state, &mut loads));
    loads
}

/// A body's arc length (nm), the force on it and the moment of what acts on it about the lab origin.
type BodyLoad = (f64, Vector3, Vector3);

/// The loads through every cross-section of filament 0 in one state, by balance: what is before a
/// cross-section exerts on what is behind it all that sections and junctions exert there.
#[derive(Debug)]
pub(super) struct SectionLoads {
    /// Bodies from the end on, each with the sums up to it.
    sums: Vec<BodyLoad>,
    axis: Axis,
}

impl SectionLoads {
    pub(super) fn of(assembly: &Assembly, state: &State) -> Self {
        let loads = elastic_loads(assembly, state);
        let points = assembly.filaments[0].points.clone().map(|i| {
            let force = loads.force.get(i);
            let moment = state.points.position.get(i).cross(&force);
            (assembly.points[i].s_nm, force, moment)
        });
        let frames = assembly.filaments[0].frames.clone().map(|i| {
            let torque = state.frames.orientation.get(i) * loads.torque.get(i);
            (assembly.frames[i].s_nm, Vector3::zeros(), torque)
        });
        let mut sums: Vec<BodyLoad> = points.chain(frames).collect();
        sums.sort_by(|a, b| b.0.total_cmp(&a.0));
        for k in 1..sums.len() {
            let (_, force, moment) = sums[k - 1];
            sums[k].1 += force;
            sums[k].2 += moment;
        }
        Self {
            sums,
            axis: Axis::of(assembly, state),
        }
    }

    /// The cross-section at an arc length (nm).
    pub(super) fn cross_section(&self, s_nm: f64) -> CrossSection {
        self.axis.at(s_nm)
    }

    /// Couple (pN nm) and force (pN) that what is behind a cross-section exerts on what is before it, body axes.
    pub(super) fn at(&self, s_nm: f64) -> SixVector {
        self.through(s_nm, s_nm)
    }

    /// The same through a cut at an arc length (nm), about another cross-section and in its axes.
    pub(super) fn through(&self, cut_nm: f64, s_nm: f64) -> SixVector {
        let behind = self.sums.partition_point(|b| b.0 > cut_nm);
        let (_, force, moment) = match behind {
            0 => BodyLoad::default(),
            n => self.sums[n - 1],
        };
        let (place, axes) = self.axis.at(s_nm);
        let body = axes.inverse();
        -six(body * (moment - place.cross(&force)), body * force)
    }
}

/// A segment of a rod of filament 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    /// Arc length of its middle (nm).
    pub s_nm: f64,
    /// Its length (nm).
    pub length_nm: f64,
    /// Curvature (mean of those at its nodes) and shear strain, body axes.
    pub strain: SixVector,
    /// The strain that it would have under its loads far from the ends of its rod.
    pub far: SixVector,
    /// Its energy per length (pN), where an end makes it another than that of the law at its strain.
    pub stored: Option<f64>,
}

impl Segment {
    /// Where it begins and ends (nm).
    pub(super) fn span_nm(&self) -> [f64; 2] {
        let half = 0.5 * self.length_nm;
        [self.s_nm - half, self.s_nm + half]
    }

    /// The middles of its halves (nm).
    pub(super) fn halves_nm(&self) -> [f64; 2] {
        let quarter = 0.25 * self.length_nm;
        [self.s_nm - quarter, self.s_nm + quarter]
    }
}

/// The segments of a section that is a rod.
pub(super) fn segments(assembly: &Assembly, state: &State, rod: &SectionSpan) -> Vec<Segment> {
    let ribbon = Ribbon::new(assembly, state);
    let curvatures = ribbon.curvatures();
    let curvature = |s_nm: f64| {
        let vertex = ribbon.s_nm.partition_point(|&s| s < s_nm - 1e-9);
        curvatures[vertex.min(curvatures.len() - 1)]
    };
    let frames = rod.frames.clone();
    let frames = frames.filter(|&f| assembly.frames[f].kind == BodyKind::Segment);
    let nodes: Range<usize> = rod.points.clone();
    frames
        .zip(nodes.clone().zip(nodes.skip(1)))
        .map(|(frame, (a, b))| {
            let (s_a, s_b) = (assembly.points[a].s_nm, assembly.points[b].s_nm);
            let edge = state.points.position.get(b) - state.points.position.get(a);
            let along = state.frames.orientation.get(frame).inverse() * edge;
            let shear = along / (s_b - s_a) - Vector3::z();
            let strain = six(0.5 * (curvature(s_a) + curvature(s_b)), shear);
            let far = far_from_ends(assembly, state, frame);
            Segment {
                s_nm: 0.5 * (s_a + s_b),
                length_nm: s_b - s_a,
                strain,
                far: far.map_or(strain, |far| six(far.curvature, far.strain)),
                stored: far.map(|far| far.energy),
            }
        })
        .collect()
}

/// The segment of a rod that has a frame as it would be far from ends, if ends change it.
fn far_from_ends(assembly: &Assembly, state: &State, frame: usize) -> Option<FarFromEnds> {
    let mut rods = assembly.rods.iter();
    let rod = rods.find(|rod| rod.layout.frames().contains(&frame))?;
    let curvature = &rod.twist_watch.as_ref()?.curvature;
    let (material, law) = &rod.law;
    let k = frame - rod.layout.frames().start;
    curvature.far_from_ends((&rod.layout, material, law), k, state)
}
