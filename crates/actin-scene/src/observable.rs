//! Observables and output files of a scene, and their validation.

use super::problem::Problems;
use super::rules::{check_index, check_on_filament, show};
use super::{
    ClampedEnds, End, Flow, Linker, PeriodicBox, Scene, SceneProblem, Section, Setting, Task,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;

const BURN_IN: f64 = 0.2;

/// Quantity computed for every record and written to `observables.csv`.
///
/// Names of columns begin with the quantity and the index of the filament or linker, and end with the unit:
/// `tip[0]_x_nm`. Components are in the lab frame unless stated otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Observable {
    /// Position of an end: `tip[0]_x_nm`, for the other end `start[0]_x_nm`. For monomers it is the mean of the
    /// outermost two.
    Tip {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// End of the filament.
        #[serde(default = "last")]
        end: End,
    },
    /// Reaction force and torque of a clamp on the filament: `reaction[0]_start_force_x_pn`,
    /// `reaction[0]_start_torque_x_pn_nm`. The torque is about the clamped point. Forces along free directions
    /// are zero. Drag and inertia of the held bodies are not included, here and in the work.
    EndReaction {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// End of the filament; it must be clamped.
        end: End,
    },
    /// Force of a linker on the filament at its site, `linker[0]_force_x_pn`, tension, `linker[0]_tension_pn`
    /// (negative in compression), and length, `linker[0]_length_nm`.
    Linker {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
    },
    /// Curvature at an arc length, as components along the axes of the cross-section as built and as magnitude:
    /// `curvature[0]_at_80nm_x_rad_per_nm`, `curvature[0]_at_80nm_rad_per_nm`. Values are interpolated linearly
    /// between the positions of `profile.csv`. Interpolation reduces the variance in a heat bath, by up to a
    /// half midway between two positions of a rod. For fluctuations, use a position of `profile.csv`.
    Curvature {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Twist relative to the helix at an arc length, positive for over-twist: `twist[0]_at_80nm_rad_per_nm`.
    /// Values are interpolated as for `Curvature`.
    Twist {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Strain of the centre line at an arc length along the axes of the cross-section as built: shear
    /// `strain[0]_at_80nm_x`, `strain[0]_at_80nm_y`, stretch `strain[0]_at_80nm_z`. Values are interpolated
    /// between midpoints of segments, as for `Curvature`.
    Strain {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Internal load: force and moment that the part of the filament after a cross-section exerts on the part
    /// before it, in the axes of the cross-section. At an arc length: `internal_load[0]_at_80nm_shear_x_pn`,
    /// `_shear_y_pn`, `_tension_pn` (negative in compression), `_moment_x_pn_nm`, `_moment_y_pn_nm` (bending),
    /// `_torque_pn_nm`. Without `at_nm`, extreme values along the filament and their arc lengths, such as
    /// `internal_load[0]_largest_tension_pn` and `internal_load[0]_largest_tension_at_nm`: `largest_tension`,
    /// `smallest_tension`, `largest_shear`, `largest_moment` (magnitudes), `largest_torque` (largest magnitude, with
    /// sign). Cross-sections between held bodies have the load of the clamp, those between the last two monomers of
    /// a free end the load before them.
    InternalLoad {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament. By default extreme values are reported.
        #[serde(default)]
        at_nm: Option<f64>,
    },
    /// Vector from the start to the end and its length: `end_to_end[0]_x_nm`, `end_to_end[0]_nm`.
    EndToEnd {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
    },
    /// Properties of the centre line: between the ends `contour[0]_length_nm`, `contour[0]_gyration_radius_nm`,
    /// `contour[0]_largest_distance_nm` and `contour[0]_twist_turns`. The distance is measured from the axis as
    /// built. With a `shape` it is measured from the straight line through `at_nm` along `direction`.
    Contour {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
    },
    /// Shape of a buckled filament, from points at equal distances along its centre line:
    /// `buckling[0]_50_points_contour_nm`, `_mean_distance_nm` (from the line through the ends),
    /// `_peak_asymmetry`, `_non_coplanarity`, `_bend`, `_normals_rad_per_nm`, `_supertwist_deg`. Defined at
    /// `actin_sim::shape::Buckle`. The centre line is straight between nodes or monomers, or a cubic spline if
    /// they are not more than the points.
    Buckling {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Number of points; from 4 to 10,000.
        #[serde(default = "fifty")]
        points: usize,
    },
    /// Total energies, `energy_potential_pn_nm` and `energy_kinetic_pn_nm`, and the energy of each section and
    /// junction, `energy_section_0_pn_nm`.
    Energies,
    /// Properties of all filaments and bound linkers.
    ///
    /// Of filaments, weighted by length: `network_order_parameter` (largest eigenvalue of `(3 <t t^T> - 1) / 2`
    /// with tangents `t`; 1 for parallel and antiparallel filaments), `network_polarity` (magnitude of the mean
    /// tangent), `network_gyration_radius_nm`.
    ///
    /// `network_mesh_size_nm` is `sqrt(3 V / L)` for the total length `L` and the volume `V` of the periodic box, or of
    /// the ellipsoid with the same gyration tensor.
    ///
    /// Of linkers: `network_bound_linkers`, `network_clusters` (groups of joined filaments),
    /// `network_largest_cluster` (number of its filaments), `network_linker_tension_mean_pn`, `_rms_pn`,
    /// `_smallest_pn`, `_largest_pn`, and quantiles from `_p05_pn` to `_p95_pn`.
    ///
    /// Virial: `network_virial_xx_pn_nm` and `_yy`, `_zz`, `_xy`, `_xz`, `_yz`. It is `-sum r f^T` over points
    /// with the forces of filaments, linkers between sites and contacts. Divided by the volume it is the stress
    /// without the thermal part, positive in tension.
    Network,
    /// Squared displacement of a point since the first record, `squared_displacement[0]_tip_nm2`. With `lag_ns`
    /// it is the squared displacement over that time, `squared_displacement[0]_tip_over_5ns_nm2`; its mean is
    /// the mean squared displacement.
    SquaredDisplacement {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Point of the filament.
        of: Point,
        /// Time lag; positive, a multiple of the time between records, below the duration. Only in `Dynamics`
        /// and `Brownian`.
        #[serde(default)]
        lag_ns: Option<f64>,
    },
    /// Mean cosine of the angle between cross-sections at a given distance, over all such pairs of the
    /// filament: `tangent_correlation[0]_over_20nm`. In a heat bath `summary.json` contains the persistence
    /// length, `-distance / ln(mean)`. It is omitted if more than heat bends the filament, such as loads, linkers,
    /// walls or a flow, or if its sections are `altered` differently. Monomers turn relative to the axis, which shortens it
    /// at small distances. From the means `m_a` and `m_b` over two distances `a < b` it is `(b - a) / ln(m_a / m_b)`.
    TangentCorrelation {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Distance along the filament; positive, at most the distance between the outermost segments or
        /// monomers.
        over_nm: f64,
    },
}

/// Point that moves with a filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Point {
    /// End of the filament.
    Tip,
    /// Centre of the centre line.
    Centre,
}

fn fifty() -> usize {
    50
}

fn last() -> End {
    End::End
}

/// Optional output files of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Output {
    /// True if pictures are written: `vtk` and `run.pvd`.
    pub vtk: bool,
    /// True if `states.npz` is written. The states of records are saved only there and in pictures.
    pub states: bool,
}

impl Default for Output {
    fn default() -> Self {
        Self {
            vtk: true,
            states: true,
        }
    }
}

impl Output {
    /// Returns whether states are needed after they were recorded.
    pub fn needs_states(self) -> bool {
        self.vtk || self.states
    }
}

impl Observable {
    /// Returns the filament of the quantity, if it refers to one.
    fn filament(self) -> Option<usize> {
        match self {
            Self::Tip { filament, .. }
            | Self::EndReaction { filament, .. }
            | Self::Curvature { filament, .. }
            | Self::Twist { filament, .. }
            | Self::Strain { filament, .. }
            | Self::InternalLoad { filament, .. }
            | Self::EndToEnd { filament }
            | Self::Contour { filament }
            | Self::Buckling { filament, .. }
            | Self::SquaredDisplacement { filament, .. }
            | Self::TangentCorrelation { filament, .. } => Some(filament),
            Self::Linker { .. } | Self::Energies | Self::Network => None,
        }
    }

    fn check(self, key: &str, scene: &Scene, held: &ClampedEnds) -> Result<(), SceneProblem> {
        let length = match self.filament() {
            None => 0.0,
            Some(index) => {
                let filament = scene.named_filament(&format!("{key}.filament"), index)?;
                filament.length_nm()
            }
        };
        self.check_own(&|name| format!("{key}.{name}"), (scene, held), length)
    }

    fn check_own(
        self,
        key: &dyn Fn(&str) -> String,
        (scene, held): (&Scene, &ClampedEnds),
        length: f64,
    ) -> Result<(), SceneProblem> {
        match self {
            Self::EndReaction { filament, end } if !held.is_clamped(filament, end) => {
                let rule = "this end is free: clamp it, or omit the observable";
                Err(SceneProblem::new(key("end"), show(end), rule))
            }
            Self::Buckling { points, .. } if !(4..=10_000).contains(&points) => {
                let rule = "must be from 4 to 10000";
                Err(SceneProblem::new(key("points"), points, rule))
            }
            Self::Linker { linker } => {
                check_index(&key("linker"), "linker", linker, scene.linkers.len())
            }
            Self::Curvature { at_nm, .. }
            | Self::Twist { at_nm, .. }
            | Self::Strain { at_nm, .. }
            | Self::InternalLoad {
                at_nm: Some(at_nm), ..
            } => check_on_filament(&key("at_nm"), at_nm, length),
            Self::SquaredDisplacement {
                lag_ns: Some(lag), ..
            } => check_lag(scene, &key("lag_ns"), lag),
            Self::TangentCorrelation { over_nm, .. } => {
                let rule = || format!("must be below the length of the filament, {length:?}");
                let refused = || SceneProblem::new(key("over_nm"), show(over_nm), rule());
                (over_nm < length).then_some(()).ok_or_else(refused)
            }
            _ => Ok(()),
        }
    }
}

fn check_lag(scene: &Scene, key: &str, lag_ns: f64) -> Result<(), SceneProblem> {
    let rule = match scene.task.motion() {
        None => "Equilibrium is time-independent: omit this key".to_owned(),
        Some(motion) if lag_ns >= motion.duration_ns => {
            format!("must be below the duration, {:?} ns", motion.duration_ns)
        }
        Some(_) => return Ok(()),
    };
    Err(SceneProblem::new(key, show(lag_ns), rule))
}

pub(super) fn check_all(scene: &Scene, held: &ClampedEnds, problems: &mut Problems) {
    let mut before = HashSet::new();
    for (i, one) in scene.observe.iter().enumerate() {
        let key = format!("observe[{i}]");
        let is_new = before.insert(show(one));
        problems.check(&key, || {
            if is_new {
                return one.check(&key, scene, held);
            }
            let rule = "is in the list already";
            Err(SceneProblem::new(&key, "", rule))
        });
    }
    problems.check("burn_in_ns", || check_burn_in(scene));
}

fn check_burn_in(scene: &Scene) -> Result<(), SceneProblem> {
    let Some(burn_in) = scene.burn_in_ns else {
        return Ok(());
    };
    let rule = match scene.task.motion() {
        Some(motion) if motion.thermal.is_none() && !scene.oscillates() => {
            "means require a temperature or an oscillating periodic box: omit this key".to_owned()
        }
        Some(motion) if burn_in >= motion.duration_ns => {
            format!("must be below the duration, {:?} ns", motion.duration_ns)
        }
        Some(_) => return Ok(()),
        None => "Equilibrium has no means over time: omit this key".to_owned(),
    };
    Err(SceneProblem::new("burn_in_ns", show(burn_in), rule))
}

impl Scene {
    /// Returns the reason why the correlation of tangents does not determine the persistence length of a filament:
    /// more than heat bends it, or its rigidity is not uniform.
    pub fn persistence_length_obstacle(&self, filament: usize) -> Option<&'static str> {
        let written = self.filament_at(filament)?;
        let sections: Vec<_> = written.sections.iter().collect();
        let held = self.clamps.iter().filter(|c| c.filament == filament);
        let mut settings = self.path.iter().flat_map(|stage| &stage.set);
        let is_strained = self
            .periodic
            .as_ref()
            .is_some_and(|one| one.strain.abs() > 0.0);
        let reasons = [
            (
                self.loads.iter().any(|load| load.filament() == filament),
                "loads act on it",
            ),
            (held.count() > 1, "both its ends are held"),
            (written.shape.is_some(), "it has a shape"),
            (
                sections.iter().any(|section| section.is_curved()),
                "it is curved at rest",
            ),
            (
                self.linkers.iter().any(|linker| linker.may_join(filament)),
                "linkers hold it",
            ),
            (self.has_walls(), "walls repel it"),
            (
                settings.any(|setting| setting.moves_end_of(filament)),
                "a clamped end is moved",
            ),
            (self.task.has_flow(), "the fluid flows"),
            (is_strained, "its periodic box is strained"),
            (
                !sections
                    .windows(2)
                    .all(|pair| pair[0].is_altered_like(pair[1])),
                "its sections are altered differently",
            ),
        ];
        reasons
            .into_iter()
            .find_map(|(is_so, reason)| is_so.then_some(reason))
    }

    /// Returns the initial time (ns) that means exclude: as written, or a fifth of the duration; `None` without
    /// thermal noise or an oscillating periodic box.
    pub fn burn_in(&self) -> Option<f64> {
        let motion = self.task.motion()?;
        let default = BURN_IN * motion.duration_ns;
        let has_means = motion.thermal.is_some() || self.oscillates();
        has_means.then(|| self.burn_in_ns.unwrap_or(default))
    }

    fn oscillates(&self) -> bool {
        self.periodic.as_ref().is_some_and(PeriodicBox::oscillates)
    }
}

impl Section {
    fn is_curved(&self) -> bool {
        let altered = self.altered_rod();
        altered.is_some_and(|altered| altered.rest_curvature_per_nm.iter().any(|k| k.abs() > 0.0))
    }

    fn is_altered_like(&self, other: &Self) -> bool {
        (self.altered(), self.altered_rod()) == (other.altered(), other.altered_rod())
    }
}

impl Task {
    fn has_flow(&self) -> bool {
        matches!(self, Self::Brownian(brownian) if brownian.flow != Flow::AtRest)
    }
}

impl Linker {
    /// Returns whether a hand of the linker is on the filament or may bind to it.
    fn may_join(&self, filament: usize) -> bool {
        let roams = self
            .kinetics
            .is_some_and(|kinetics| kinetics.roams.is_some());
        roams || self.filament == filament || self.to.is_some_and(|site| site.filament == filament)
    }
}

impl Setting {
    fn moves_end_of(&self, filament: usize) -> bool {
        match *self {
            Self::Shift { filament: one, .. } | Self::Turn { filament: one, .. } => one == filament,
            Self::LoadFactor { .. } | Self::Shear { .. } | Self::Anchor { .. } => false,
        }
    }
}
