//! What a scene observes as records are taken, what it writes of them, and the rules of both.

use super::rules::{non_negative, positive, show};
use super::{End, HeldEnds, Linker, Scene, SceneProblem, Section};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;

/// Share of a motion that means leave out by default.
const BURN_IN: f64 = 0.2;

/// Something that is computed of every record and written to `observables.csv`.
///
/// Names of its columns begin with what it is and the index of the filament (of the linker), and end with
/// their unit: `tip[0]_x_nm`. Components are in the lab frame unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub enum Observable {
    /// Place of an end: `tip[0]_x_nm`, of the other end `start[0]_x_nm`. That of monomers is the mean of the
    /// outermost two.
    Tip {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end.
        #[serde(default = "last")]
        end: End,
    },
    /// Force and torque of a clamp on the filament, the torque about the clamped point:
    /// `reaction[0]_start_force_x_pn`, `reaction[0]_start_torque_x_pn_nm`. Along directions in which the end slides the
    /// force is zero: what loads the end there is its own inertia and drag.
    EndReaction {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which end. It must be clamped.
        end: End,
    },
    /// What a linker does: its force on the filament at the site, `linker[0]_force_x_pn`, its tension,
    /// `linker[0]_tension_pn`, negative where it pushes, and its length, `linker[0]_length_nm`.
    Linker {
        /// Index of the linker in `linkers`, from 0.
        linker: usize,
    },
    /// Curvature at an arc length, about the axes of the cross-section as built and in size:
    /// `curvature[0]_at_80nm_x_rad_per_nm`, `curvature[0]_at_80nm_rad_per_nm`. As in `profile.csv`, straight
    /// lines between its places. In a heat bath such a mean of two values fluctuates less than either, on a rod
    /// midway with half of the variance: for fluctuations ask at a place of `profile.csv`.
    Curvature {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Twist beyond that of the helix at an arc length, positive for over-twist:
    /// `twist[0]_at_80nm_rad_per_nm`. As in `profile.csv`, straight lines between its places, with the
    /// variance of a mean midway between two, as under `Curvature`.
    Twist {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Strain of the centre line at an arc length, along the axes of the cross-section as built: shear
    /// `strain[0]_at_80nm_x`, `strain[0]_at_80nm_y`, stretch `strain[0]_at_80nm_z`. Straight lines between
    /// the middles of segments, with the variance of a mean midway between two, as under `Curvature`.
    Strain {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Arc length; from 0 to the length of the filament.
        at_nm: f64,
    },
    /// Vector from the start to the end, and its length: `end_to_end[0]_x_nm`, `end_to_end[0]_nm`.
    EndToEnd {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
    },
    /// The centre line as a whole: `contour[0]_length_nm`, `contour[0]_gyration_radius_nm`,
    /// `contour[0]_largest_distance_nm` and `contour[0]_twist_turns`. The distance is that from the axis as built; of a
    /// filament with a `shape` it is that from the straight line through `at_nm` along `direction`, to which the
    /// curve is a tangent at its start, and not from the curve.
    Contour {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
    },
    /// How far, how evenly and how flat the filament has buckled, from points at equal lengths along its centre line:
    /// `buckling[0]_50_points_contour_nm`, `_mean_distance_nm` from the line through the ends, `_peak_asymmetry`,
    /// `_non_coplanarity`, `_bend`, `_normals_rad_per_nm`, `_supertwist_deg`. Defined at
    /// `actin_sim::shape::Buckle`.
    Buckling {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Number of points; from 4 to 10,000.
        #[serde(default = "fifty")]
        points: usize,
    },
    /// Energies of all: `energy_potential_pn_nm`, `energy_kinetic_pn_nm`; and of each section and junction:
    /// `energy_section_0_pn_nm`.
    Energies,
    /// Properties of all filaments together, with edges of centre lines weighted by length:
    /// `network_order_parameter` (largest eigenvalue of `(3 <t t^T> - 1) / 2` with tangents `t`; 1 for parallel and
    /// antiparallel filaments), `network_polarity` (length of the mean tangent), `network_gyration_radius_nm`; of
    /// bound linkers: `network_bound_linkers`, `network_clusters` (sets of joined filaments),
    /// `network_largest_cluster` (number of its filaments), `network_linker_tension_mean_pn`, `_rms_pn`, `_smallest_pn`,
    /// `_largest_pn`; `network_virial_xx_pn_nm` and `_yy`, `_zz`, `_xy`, `_xz`, `_yz`: `-sum r f^T` over points with the forces
    /// of filaments, linkers between sites and contacts. The virial divided by the volume is the stress without the
    /// thermal part, positive in tension.
    Network,
    /// Square of the displacement of a point since the first record,
    /// `squared_displacement[0]_tip_nm2`; with `lag_ns` over that time,
    /// `squared_displacement[0]_tip_over_5ns_nm2`, whose mean over a run is the mean squared displacement.
    SquaredDisplacement {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Which point.
        of: Point,
        /// Time over which; positive, a multiple of the time between records, below the duration. In
        /// `Dynamics` and `Brownian`.
        #[serde(default)]
        lag_ns: Option<f64>,
    },
    /// Mean cosine of the angle between cross-sections a distance apart, over all such pairs of the filament:
    /// `tangent_correlation[0]_over_20nm`. In a heat bath `summary.json` has the persistence length that
    /// follows, `-distance / ln(mean)`, unless something else than heat bends or straightens the filament: loads,
    /// linkers, walls, a second held end, a `shape`, curvature at rest.
    TangentCorrelation {
        /// Index of the filament.
        #[serde(default)]
        filament: usize,
        /// Distance along the filament; positive, at most that of the outermost segments or monomers.
        over_nm: f64,
    },
}

/// A point that moves with a filament.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Point {
    /// Its end.
    Tip,
    /// The centre of its centre line.
    Centre,
}

fn fifty() -> usize {
    50
}

fn last() -> End {
    End::End
}

/// Which of the larger files a run writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Whether pictures are written: `vtk` and `run.pvd`.
    pub vtk: bool,
    /// Whether `states.npz` is written. Without it and without pictures, states of records are kept nowhere.
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
    /// Whether the states of records are needed once they were taken.
    pub fn needs_states(self) -> bool {
        self.vtk || self.states
    }
}

impl Observable {
    /// The filament that it is of; none of what is of no single one.
    fn filament(self) -> Option<usize> {
        match self {
            Self::Tip { filament, .. }
            | Self::EndReaction { filament, .. }
            | Self::Curvature { filament, .. }
            | Self::Twist { filament, .. }
            | Self::Strain { filament, .. }
            | Self::EndToEnd { filament }
            | Self::Contour { filament }
            | Self::Buckling { filament, .. }
            | Self::SquaredDisplacement { filament, .. }
            | Self::TangentCorrelation { filament, .. } => Some(filament),
            Self::Linker { .. } | Self::Energies | Self::Network => None,
        }
    }

    /// Refuses observable `i` of a scene where it makes no sense.
    fn check(self, i: usize, (scene, held): (&Scene, &HeldEnds)) -> Result<(), SceneProblem> {
        let key = format!("observe[{i}]");
        let length = match self.filament() {
            None => 0.0,
            Some(index) => {
                let filament = scene.named_filament(&format!("{key}.filament"), index)?;
                filament.length_nm()
            }
        };
        self.check_own(&|name| format!("{key}.{name}"), (scene, held), length)
    }

    /// The same of its own keys, on a filament of this length (nm).
    fn check_own(
        self,
        key: &dyn Fn(&str) -> String,
        (scene, held): (&Scene, &HeldEnds),
        length: f64,
    ) -> Result<(), SceneProblem> {
        match self {
            Self::EndReaction { filament, end } if !held.is_held(filament, end) => {
                let rule = "this end is free: nothing holds it";
                Err(SceneProblem::new(key("end"), show(end), rule))
            }
            Self::Buckling { points, .. } if !(4..=10_000).contains(&points) => {
                let rule = "must be from 4 to 10000";
                Err(SceneProblem::new(key("points"), points, rule))
            }
            Self::Linker { linker } => check_linker(scene, &key("linker"), linker),
            Self::Curvature { at_nm, .. }
            | Self::Twist { at_nm, .. }
            | Self::Strain { at_nm, .. }
                if !(0.0..=length).contains(&at_nm) =>
            {
                let rule = format!("must lie on the filament, from 0 to {length:?}");
                Err(SceneProblem::new(key("at_nm"), show(at_nm), rule))
            }
            Self::SquaredDisplacement {
                lag_ns: Some(lag), ..
            } => check_lag(scene, &key("lag_ns"), lag),
            Self::TangentCorrelation { over_nm, .. } => {
                positive(&key("over_nm"), over_nm)?;
                let rule = || format!("must be below the length of the filament, {length:?}");
                let refused = || SceneProblem::new(key("over_nm"), show(over_nm), rule());
                (over_nm < length).then_some(()).ok_or_else(refused)
            }
            _ => Ok(()),
        }
    }
}

/// Whether a scene has a linker of this index.
pub(super) fn check_linker(scene: &Scene, key: &str, linker: usize) -> Result<(), SceneProblem> {
    let rule = match scene.linkers.len() {
        count if linker < count => return Ok(()),
        0 => "the scene has no linkers".to_owned(),
        1 => "there is one linker, which is 0".to_owned(),
        count => format!("there are {count} linkers, counted from 0"),
    };
    Err(SceneProblem::new(key, linker, rule))
}

fn check_lag(scene: &Scene, key: &str, lag_ns: f64) -> Result<(), SceneProblem> {
    positive(key, lag_ns)?;
    let rule = match scene.task.motion() {
        None => "Equilibrium is time-independent: leave it out".to_owned(),
        Some(motion) if lag_ns >= motion.duration_ns => {
            format!("must be below the duration, {:?} ns", motion.duration_ns)
        }
        Some(_) => return Ok(()),
    };
    Err(SceneProblem::new(key, show(lag_ns), rule))
}

/// Checks all that is observed, and what means leave out.
pub(super) fn check_all(
    scene: &Scene,
    held: &HeldEnds,
    note: &mut impl FnMut(Result<(), SceneProblem>),
) {
    let mut before = HashSet::new();
    for (i, one) in scene.observe.iter().enumerate() {
        if before.insert(show(one)) {
            note(one.check(i, (scene, held)));
        } else {
            let rule = "is in the list already";
            note(Err(SceneProblem::new(format!("observe[{i}]"), "", rule)));
        }
    }
    note(check_burn_in(scene));
}

/// Checks what means leave out.
fn check_burn_in(scene: &Scene) -> Result<(), SceneProblem> {
    let Some(burn_in) = scene.burn_in_ns else {
        return Ok(());
    };
    non_negative("burn_in_ns", burn_in)?;
    let rule = match scene.task.motion() {
        Some(motion) if motion.thermal.is_none() => {
            "means are of thermal motion: leave it out, or write thermal".to_owned()
        }
        Some(motion) if burn_in >= motion.duration_ns => {
            format!("must be below the duration, {:?} ns", motion.duration_ns)
        }
        Some(_) => return Ok(()),
        None => "Equilibrium has no means: leave it out".to_owned(),
    };
    Err(SceneProblem::new("burn_in_ns", show(burn_in), rule))
}

impl Scene {
    /// What bends or straightens a filament besides heat, so that its tangents do not tell its persistence length.
    pub fn bends_besides_heat(&self, filament: usize) -> Option<&'static str> {
        let written = self.filament_at(filament)?;
        let is_curved = |section: &Section| match section {
            Section::Rod { altered, .. } => altered
                .as_ref()
                .is_some_and(|altered| altered.rest_curvature_per_nm.iter().any(|k| k.abs() > 0.0)),
            Section::Ellipsoids { .. } => false,
        };
        let held = self.clamps.iter().filter(|c| c.filament == filament);
        let joins = |linker: &Linker| {
            let to = linker.to.map(|site| site.filament);
            linker.filament == filament || to == Some(filament)
        };
        let reasons = [
            (
                self.loads.iter().any(|load| load.filament() == filament),
                "loads act on it",
            ),
            (held.count() > 1, "both its ends are held"),
            (written.shape.is_some(), "it has a shape"),
            (
                written.sections.iter().any(is_curved),
                "it is curved at rest",
            ),
            (self.linkers.iter().any(joins), "linkers hold it"),
            (self.has_walls(), "walls repel it"),
        ];
        let mut true_ones = reasons.into_iter().filter(|(is_so, _)| *is_so);
        true_ones.next().map(|(_, reason)| reason)
    }

    /// Time that means leave out (ns): as written, or a fifth of the duration; none without thermal noise.
    pub fn burn_in(&self) -> Option<f64> {
        let motion = self.task.motion()?;
        let default = BURN_IN * motion.duration_ns;
        motion.thermal.map(|_| self.burn_in_ns.unwrap_or(default))
    }
}
