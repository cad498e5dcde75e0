//! Construction of scenes in Rust: constructors with the required parts, and additions by value.

use super::{
    Brownian, Clamp, DragModel, DragRates, Dynamics, End, Equilibrium, FreeTranslation, Load,
    Scene, Section, Setting, Stage, Task, TimeCourse,
};

impl Scene {
    /// Adds a clamped end.
    #[must_use]
    pub fn clamp(mut self, clamp: Clamp) -> Self {
        self.clamps.push(clamp);
        self
    }

    /// Adds a load.
    #[must_use]
    pub fn load(mut self, load: Load) -> Self {
        self.loads.push(load);
        self
    }
}

impl Section {
    /// Creates monomers with the parameters of their filament.
    pub fn ellipsoids(from_nm: f64, to_nm: f64) -> Self {
        Self::Ellipsoids {
            from_nm,
            to_nm,
            altered: None,
        }
    }

    /// Creates a rod with the parameters of its filament, with the default segments if `segments` is `None`.
    pub fn rod(from_nm: f64, to_nm: f64, segments: Option<usize>) -> Self {
        Self::Rod {
            from_nm,
            to_nm,
            segments,
            altered: None,
        }
    }
}

impl Clamp {
    /// Creates a wall at an end of filament 0.
    pub fn new(end: End) -> Self {
        Self {
            filament: 0,
            end,
            hold: super::Hold::default(),
            hinge: None,
            slides: FreeTranslation::default(),
        }
    }

    /// Returns the clamp with these free directions.
    #[must_use]
    pub fn sliding(self, slides: FreeTranslation) -> Self {
        Self { slides, ..self }
    }
}

impl Load {
    /// Creates a constant force (pN, lab frame) on an end of filament 0.
    pub fn end_force(end: End, force_pn: impl Into<[f64; 3]>) -> Self {
        Self::EndForce {
            filament: 0,
            end,
            force_pn: force_pn.into(),
        }
    }
}

impl Setting {
    /// Displacement (nm, lab frame) of an end of filament 0.
    pub fn shift(end: End, shift_nm: impl Into<[f64; 3]>) -> Self {
        Self::Shift {
            filament: 0,
            end,
            shift_nm: shift_nm.into(),
        }
    }

    /// Rotation vector (deg, lab frame) of an end of filament 0.
    pub fn turn(end: End, turn_deg: impl Into<[f64; 3]>) -> Self {
        Self::Turn {
            filament: 0,
            end,
            turn_deg: turn_deg.into(),
        }
    }
}

impl Stage {
    /// Creates a stage of a path of equilibria.
    pub fn new(set: impl Into<Vec<Setting>>) -> Self {
        Self {
            set: set.into(),
            duration_ns: None,
            pace: TimeCourse::default(),
        }
    }
}

impl DragModel {
    /// Creates a numerical damping from the rates (1/ns) of velocities and of angular momenta.
    pub fn rates_per_ns([translational_per_ns, rotational_per_ns]: [f64; 2]) -> Self {
        Self::Rates(DragRates {
            translational_per_ns,
            rotational_per_ns,
        })
    }
}

impl From<Equilibrium> for Task {
    fn from(task: Equilibrium) -> Self {
        Self::Equilibrium(task)
    }
}

impl From<Dynamics> for Task {
    fn from(task: Dynamics) -> Self {
        Self::Dynamics(task)
    }
}

impl From<Brownian> for Task {
    fn from(task: Brownian) -> Self {
        Self::Brownian(task)
    }
}
