//! Bodies of a run as particles and bonds.

use actin_sim::mechanics::{State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, BodyKind, rod_constants::cross_section_radius};
use std::ops::Range;

/// Radius of ends of linkers (nm), for display only.
pub(crate) const LINKER_RADIUS_NM: f64 = 0.5;

/// Shape of a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    /// Semi-axes (nm) along the axes of the body frame.
    Ellipsoid([f64; 3]),
    /// Radius (nm).
    Sphere(f64),
}

impl Shape {
    /// Returns the largest distance of the surface from the centre (nm).
    pub(crate) fn radius_nm(self) -> f64 {
        match self {
            Self::Ellipsoid(semi_axes) => semi_axes.into_iter().fold(0.0, f64::max),
            Self::Sphere(radius) => radius,
        }
    }
}

/// Particles with the same name and shape.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Species {
    /// Name: `monomer`, `node` of a rod, or `linker` for ends of linkers. Further shapes of monomers are `monomer_1`
    /// etc.
    pub name: String,
    /// Shape.
    pub shape: Shape,
}

/// Kind of a bond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BondKind {
    /// Monomers i and i + 1.
    Lateral,
    /// Monomers i and i + 2.
    Longitudinal,
    /// Neighbouring nodes of a rod.
    Segment,
    /// A monomer and the end of a rod.
    Junction,
    /// The ends of a linker.
    Linker,
}

impl BondKind {
    /// All kinds.
    pub(crate) const ALL: [Self; 5] = [
        Self::Lateral,
        Self::Longitudinal,
        Self::Segment,
        Self::Junction,
        Self::Linker,
    ];

    /// Returns the name in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Lateral => "lateral",
            Self::Longitudinal => "longitudinal",
            Self::Segment => "segment",
            Self::Junction => "junction",
            Self::Linker => "linker",
        }
    }
}

/// A bond between two particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bond {
    /// Kind of the bond.
    pub kind: BondKind,
    /// Indices of the particles.
    pub between: [usize; 2],
}

/// Particles of a run: monomers and nodes in the order of points, then both ends of each linker.
///
/// Linkers with `kinetics` are not included, since they bind and unbind.
#[derive(Debug)]
pub(crate) struct Particles<'a> {
    assembly: &'a Assembly,
    /// Species of particles.
    pub species: Vec<Species>,
    /// Index of the species of each particle.
    pub sort: Vec<usize>,
    /// Bonds between particles.
    pub bonds: Vec<Bond>,
    /// Index of the frame of each point, if any.
    frame: Vec<Option<usize>>,
    /// Indices of the included linkers.
    pub(crate) linkers: Vec<usize>,
}

impl<'a> Particles<'a> {
    /// Creates the particles of an assembly.
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        let linkers = assembly.scene.linkers.iter().enumerate();
        let lasting = linkers.filter(|(_, linker)| linker.kinetics.is_none());
        let points = 0..assembly.points.len();
        let mut particles = Self {
            assembly,
            species: Vec::new(),
            sort: Vec::new(),
            bonds: bonds(assembly),
            frame: points.map(|i| assembly.frame_of_point(i)).collect(),
            linkers: lasting.map(|(i, _)| i).collect(),
        };
        for i in 0..assembly.points.len() {
            let (name, shape) = particles.of_point(i);
            particles.push(name, shape);
        }
        for _ in 0..particles.linkers.len() {
            let first = particles.sort.len();
            particles.bonds.push(Bond {
                kind: BondKind::Linker,
                between: [first, first + 1],
            });
            particles.push("linker", Shape::Sphere(LINKER_RADIUS_NM));
            particles.push("linker", Shape::Sphere(LINKER_RADIUS_NM));
        }
        particles
    }

    /// Returns the number of particles.
    pub(crate) fn count(&self) -> usize {
        self.sort.len()
    }

    /// Returns the assembly.
    pub(crate) fn assembly(&self) -> &'a Assembly {
        self.assembly
    }

    fn of_point(&self, i: usize) -> (&'static str, Shape) {
        match self.assembly.points[i].kind {
            BodyKind::Monomer => {
                let filament = self.assembly.filament_of_point(i);
                let semi_axes = self.assembly.monomers_of(filament).semi_axes_nm;
                ("monomer", Shape::Ellipsoid(semi_axes))
            }
            _ => ("node", Shape::Sphere(cross_section_radius())),
        }
    }

    fn push(&mut self, name: &str, shape: Shape) {
        let alike = |s: &Species| s.shape == shape && s.name.starts_with(name);
        let found = self.species.iter().position(alike);
        let sort = found.unwrap_or_else(|| {
            let namesakes = self.species.iter().filter(|s| s.name.starts_with(name));
            let name = match namesakes.count() {
                0 => name.to_owned(),
                others => format!("{name}_{others}"),
            };
            self.species.push(Species { name, shape });
            self.species.len() - 1
        });
        self.sort.push(sort);
    }

    /// Returns the positions of all particles (nm, lab frame).
    pub(crate) fn places(&self, state: &State) -> Vec<Vector3> {
        let mut places: Vec<Vector3> = state.points.position.iter().collect();
        for &i in &self.linkers {
            places.extend(self.linker(i, state));
        }
        places
    }

    /// Returns the positions of both ends of a linker (nm, lab frame).
    pub(crate) fn linker(&self, i: usize, state: &State) -> [Vector3; 2] {
        let linker = &self.assembly.linkers[i];
        [linker.site().position(state), linker.end_position(state)]
    }

    /// Returns the orientations of all particles, body to lab; the identity for points without a frame.
    pub(crate) fn turns(&self, state: &State) -> Vec<UnitQuaternion> {
        let turn = |frame: &Option<usize>| {
            frame.map_or_else(UnitQuaternion::identity, |f| {
                state.frames.orientation.get(f)
            })
        };
        let mut turns: Vec<_> = self.frame.iter().map(turn).collect();
        turns.resize(self.count(), UnitQuaternion::identity());
        turns
    }

    /// Returns the velocities of all particles (nm/ns, lab frame); zero for ends of linkers.
    pub(crate) fn velocities(&self, state: &State) -> Vec<Vector3> {
        let mut velocities: Vec<Vector3> = state.points.velocity.iter().collect();
        velocities.resize(self.count(), Vector3::zeros());
        velocities
    }

    /// Returns the masses of all particles (ag), including clamped ones; zero for ends of linkers.
    pub(crate) fn masses_ag(&self) -> Vec<f64> {
        let points = &self.assembly.rest.points;
        let mut masses: Vec<f64> = (0..points.len()).map(|i| points.mass(i)).collect();
        masses.resize(self.count(), 0.0);
        masses
    }

    /// Returns the principal moments of inertia of all particles (ag nm^2, body frame); zero for nodes and ends of
    /// linkers.
    pub(crate) fn moments_of_inertia_ag_nm2(&self) -> Vec<Vector3> {
        let frames = &self.assembly.rest.frames;
        let points = self.assembly.points.iter();
        let moments = points.map(|point| {
            let inverse = point.frame.map(|frame| frames.inverse_moments(frame));
            inverse.map_or_else(Vector3::zeros, |inverse| inverse.map(f64::recip))
        });
        let mut all: Vec<_> = moments.collect();
        all.resize(self.count(), Vector3::zeros());
        all
    }
}

/// Returns ranges of points: connected monomers, also across sections, and rods.
pub(crate) fn runs(assembly: &Assembly) -> Vec<(BodyKind, Range<usize>)> {
    let mut runs: Vec<(BodyKind, Range<usize>)> = Vec::new();
    for filament in &assembly.filaments {
        let first = runs.len();
        for section in &assembly.sections[filament.sections.clone()] {
            let points = section.points.clone();
            let bonded = runs[first..].last_mut().filter(|(kind, run)| {
                *kind == BodyKind::Monomer && section.is_ellipsoids() && run.end == points.start
            });
            match bonded {
                Some((_, run)) => run.end = points.end,
                None if section.is_ellipsoids() => runs.push((BodyKind::Monomer, points)),
                None => runs.push((BodyKind::Node, points)),
            }
        }
    }
    runs
}

fn bonds(assembly: &Assembly) -> Vec<Bond> {
    let mut bonds = Vec::new();
    let mut join = |kind, points: &Range<usize>, reach: usize| {
        let firsts = points.start..points.end.saturating_sub(reach);
        bonds.extend(firsts.map(|i| Bond {
            kind,
            between: [i, i + reach],
        }));
    };
    for (kind, points) in runs(assembly) {
        if kind == BodyKind::Monomer {
            join(BondKind::Lateral, &points, 1);
            join(BondKind::Longitudinal, &points, 2);
        } else {
            join(BondKind::Segment, &points, 1);
        }
    }
    bonds.extend(assembly.junction_bonds().iter().map(|bond| Bond {
        kind: BondKind::Junction,
        between: [bond.monomer, bond.node],
    }));
    bonds
}
