//! The change of a scene that saves most, out of those whose error was measured.

use super::like::length;
use super::{AT_MOST, FilamentSetting, Measured, scenes, table};
use crate::cost::Cost;
use crate::run::estimate_at;
use crate::scene::{
    DragModel, Dynamics, Equilibrium, Integrator, RodLaw, Scene, SceneProblem, Section, Task,
};
use crate::{Assembly, Estimate, Plan};
use actin_integrate::SAFETY;
use std::fmt;

/// Places along a filament closer than this (nm) are one: boundaries move to the lattice.
const SAME_NM: f64 = 1.5;

/// A change of a scene and what it would bring.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What to do, in words.
    pub what: String,
    /// The scene after it, accepted by every rule.
    pub scene: Scene,
    /// Estimated time before over that after.
    pub times_cheaper: f64,
    /// What to expect of the result.
    pub expected: Expected,
}

/// What a change does to the result.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// Errors, relative, against all monomers: the row of the table that they are from.
    Errors(Box<Measured>),
    /// A stable state at rest: where there are several, not that in which the motion would end.
    AtRest,
    /// The error of slow motion was [`SLOW_MOTION`] where it was measured; of the fastest modes nothing is said.
    SlowMotion,
}

/// Error of the tip of a filament of monomers and rod that is let go, over 20 ns, with position Verlet
/// at its default step: 8e-6 without drag (`cargo xtask tradeoff vibration`), at most 1.6e-5 under drag
/// up to 1e4 per ns (`position_verlet_follows_slow_motion_under_drag` in `tests/dynamics`).
pub const SLOW_MOTION: f64 = 2e-5;

/// Largest drag under which that was measured (1/ns).
const MOST_DRAG: f64 = 1e4;

/// The change that saves most, if any saves at all, of a scene that was built and estimated; `like`
/// names the measured scene that this one is like and how long that is (nm).
pub(super) fn best(
    scene: &Scene,
    known: (&Assembly, Option<&Estimate>),
    like: Option<(&str, f64)>,
) -> Option<Change> {
    let (assembly, estimate) = known;
    let before = Cost::of(assembly, estimate).seconds.total();
    let resolved = like.into_iter().flat_map(|(name, at)| {
        let measured = table::measured().into_iter();
        let rows = measured.filter(move |row| row.scene == name && is_small(row.displacement));
        rows.filter_map(move |row| resolved(scene, &row, length(scene) / at))
    });
    // What is refused is no advice.
    let built = resolved.chain(at_rest(scene)).filter_map(|candidate| {
        let seconds = seconds(&candidate.1).ok()?;
        Some((candidate, seconds))
    });
    let all = built.chain(estimate.and_then(|estimate| verlet(scene, assembly, estimate)));
    let timed = all.map(|((what, changed, expected), seconds)| Change {
        what,
        scene: changed,
        times_cheaper: before / seconds,
        expected,
    });
    let saving = timed.filter(|change| change.times_cheaper > 1.0);
    saving.max_by(|a, b| a.times_cheaper.total_cmp(&b.times_cheaper))
}

/// What to do, the changed scene, and the errors it brings.
type Candidate = (String, Scene, Expected);

fn is_small(error: Option<f64>) -> bool {
    error.is_some_and(|error| error <= AT_MOST)
}

fn seconds(scene: &Scene) -> Result<f64, SceneProblem> {
    scene.validate()?;
    Ok(Plan::new(&Assembly::build(scene)?)?.cost().seconds.total())
}

/// The scene resolved as `row` says, if that is one change and no finer anywhere; places of the row
/// are stretched by `scale`.
fn resolved(scene: &Scene, row: &Measured, scale: f64) -> Option<Candidate> {
    let mut to = row.setting()?;
    to.monomers.iter_mut().flatten().for_each(|s| *s *= scale);
    let from = present(scene)?;
    let gone = without(&from.monomers, &to.monomers)?;
    let same_model = (from.weight, from.attached) == (to.weight, to.attached);
    let what = if same_model && from.bonds == to.bonds && !gone.is_empty() {
        let all = to.monomers.is_empty();
        let from = if all {
            "all monomers".into()
        } else {
            stretches(&gone)
        };
        format!(
            "replace {from} by a rod{} with law {}",
            segments(row),
            row.law
        )
    } else if same_model && gone.is_empty() && to.bonds < from.bonds && same_rods(scene, &from, &to)
    {
        format!("take {} bonds per interface", to.bonds)
    } else {
        return None;
    };
    let expected = Expected::Errors(Box::new(row.clone()));
    Some((what, to.apply(scene), expected))
}

/// The length of segments, where it is not that of a scene that leaves it out.
fn segments(row: &Measured) -> String {
    let default = FilamentSetting::of(Vec::new(), RodLaw::default()).segment_nm;
    if (row.segment_nm - default).abs() < 1e-9 {
        return String::new();
    }
    format!(" of {} nm segments", row.segment_nm)
}

fn stretches(gone: &[[f64; 2]]) -> String {
    let each: Vec<String> = gone
        .iter()
        .map(|[a, b]| format!("{a:.0}..{b:.0} nm"))
        .collect();
    format!("the monomers of {}", each.join(" and "))
}

/// Whether rods, if there are any, stay what they are.
fn same_rods(scene: &Scene, from: &FilamentSetting, to: &FilamentSetting) -> bool {
    let is_rod = |section: &Section| matches!(section, Section::Rod { .. });
    !scene.filament.sections.iter().any(is_rod) || from.law == to.law
}

/// How a scene is resolved; `None` if not as a setting can say.
fn present(scene: &Scene) -> Option<FilamentSetting> {
    let filament = &scene.filament;
    let monomers = filament
        .sections
        .iter()
        .filter_map(|section| match *section {
            Section::Ellipsoids { from_nm, to_nm, .. } => Some([from_nm, to_nm]),
            Section::Rod { .. } => None,
        });
    let bonds = filament.monomers.lateral_bonds;
    (filament.monomers.longitudinal_bonds == bonds).then(|| FilamentSetting {
        bonds,
        weight: filament.junction.weight,
        attached: filament.junction.attached_monomers,
        ..FilamentSetting::of(monomers.collect(), filament.rod.law.without_bath())
    })
}

/// What is left of stretches without others that lie inside of them; `None` if some do not.
fn without(stretches: &[[f64; 2]], others: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let is_inside = |[a, b]: &[f64; 2]| {
        stretches
            .iter()
            .any(|[from, to]| *a >= from - SAME_NM && *b <= to + SAME_NM)
    };
    if !others.iter().all(is_inside) {
        return None;
    }
    let mut left = Vec::new();
    for &[from, to] in stretches {
        let mut at = from;
        for &[a, b] in others.iter().filter(|[a, b]| *b > from && *a < to) {
            left.push([at, a]);
            at = b;
        }
        left.push([at, to]);
    }
    left.retain(|[a, b]| b - a > SAME_NM);
    Some(left)
}

/// The equilibrium instead of a damped motion that stops at it.
fn at_rest(scene: &Scene) -> Option<Candidate> {
    let Task::Dynamics(dynamics) = &scene.task else {
        return None;
    };
    if dynamics.stop.is_none() || dynamics.drag == DragModel::default() {
        return None;
    }
    let mut changed = scene.clone();
    changed.task = Task::Equilibrium(Equilibrium::default());
    let what = "ask for Equilibrium if only the state at rest is wanted".into();
    Some((what, changed, Expected::AtRest))
}

/// Whether a motion has the step that a scene gets which leaves it out, written out or not.
fn has_default_step(
    assembly: &Assembly,
    dynamics: &Dynamics,
    Estimate {
        largest_frequency_rad_per_ns,
        ..
    }: &Estimate,
) -> bool {
    let Some(step) = dynamics.time_step_ns else {
        return true;
    };
    let open = Dynamics {
        time_step_ns: None,
        ..dynamics.clone()
    };
    let estimate = estimate_at(assembly, &open, *largest_frequency_rad_per_ns);
    // Printed scenes hold the step to all digits.
    estimate.is_ok_and(|e| (e.time_step_ns / step - 1.0).abs() < 1e-9)
}

/// Position Verlet for a motion that is wanted for itself, where the scene leaves the step to the
/// method, and its time (s). In a heat bath its fastest modes are too cold by a quarter at half its
/// limit, so not there.
fn verlet(scene: &Scene, assembly: &Assembly, estimate: &Estimate) -> Option<(Candidate, f64)> {
    let Task::Dynamics(dynamics) = &scene.task else {
        return None;
    };
    let drag = dynamics.drag.rates();
    let is_weak = dynamics.drag.fluid().is_none()
        && drag.translational_per_ns.max(drag.rotational_per_ns) <= MOST_DRAG;
    let is_motion = dynamics.stop.is_none() && dynamics.thermal.is_none() && is_weak;
    let has_step = || has_default_step(assembly, dynamics, estimate);
    if !(is_motion && dynamics.step_safety <= SAFETY && has_step()) {
        return None;
    }
    let with_verlet = Dynamics {
        integrator: Integrator::PositionVerlet,
        time_step_ns: None,
        ..dynamics.clone()
    };
    let frequency = estimate.largest_frequency_rad_per_ns;
    let estimate = estimate_at(assembly, &with_verlet, frequency).ok()?;
    let seconds = Cost::of(assembly, Some(&estimate)).seconds.total();
    let mut changed = scene.clone();
    changed.task = Task::Dynamics(with_verlet);
    let what = "take integrator PositionVerlet at its default step".into();
    Some(((what, changed, Expected::SlowMotion), seconds))
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {:.1} times cheaper, {}",
            self.what, self.times_cheaper, self.expected
        )
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Errors(row) => write_errors(row, f),
            Self::AtRest => f.write_str("a stable state at rest, the same where there is only one"),
            Self::SlowMotion => write!(
                f,
                "expected error of slow motion {SLOW_MOTION:.0e}, and more of what is fast (measured over \
                 20 ns on the tip of 80 nm of monomers and 80 nm of rod let go)"
            ),
        }
    }
}

fn write_errors(row: &Measured, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    let (displacement, site) = scenes::observed(&row.scene);
    let errors = [
        (displacement, row.displacement),
        ("energy", row.energy),
        ("force", row.force),
        ("torque", row.torque),
        (site, row.local),
    ];
    let known = errors
        .into_iter()
        .filter_map(|(what, error)| Some((what, error?)));
    let each: Vec<String> = known
        .map(|(what, e)| format!("{what} {:.1} %", 100.0 * e))
        .collect();
    write!(f, "expected errors: {}", each.join(", "))?;
    if let Some(scatter) = row.scatter {
        write!(
            f,
            " (filaments of 64 drawn bonds scatter by {:.1} %",
            100.0 * scatter
        )?;
        write!(f, "; measured on {})", row.scene)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_is_what_is_not_kept() {
        let left = |from: &[[f64; 2]], kept: &[[f64; 2]]| without(from, kept);
        assert_eq!(left(&[[0.0, 160.0]], &[]), Some(vec![[0.0, 160.0]]));
        assert_eq!(
            left(&[[0.0, 160.0]], &[[0.0, 40.0]]),
            Some(vec![[40.0, 160.0]])
        );
        assert_eq!(
            left(&[[0.0, 160.0]], &[[60.0, 100.0]]),
            Some(vec![[0.0, 60.0], [100.0, 160.0]])
        );
        // Nothing goes within the lattice's own width; what is finer than before is no saving.
        assert_eq!(left(&[[0.0, 41.0]], &[[0.0, 40.0]]), Some(vec![]));
        assert_eq!(left(&[[0.0, 40.0]], &[[0.0, 80.0]]), None);
    }
}
