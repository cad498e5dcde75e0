//! Solution of a load case for one filament: scene, certified equilibria, and compared quantities.

use super::case::{Case, Loading, TURNED_NM};
use super::filament::FilamentModel;
use crate::centre_line::CentreLine;
use crate::measure::{Evidence, Specimen, far_end_shift, follow, reaction, twist};
use crate::run::{doubtful, rolled, scenario, shift};
use actin_mechanics::{State, Vector3};
use actin_sim::shape::Ribbon;
use actin_sim::{
    Assembly, Clamp, End, Equilibrium, FreeTranslation, Hold, Load, Part, Scene, Setting, Solution,
    Stage, Task,
};
use serde::{Deserialize, Serialize};

/// Iteration limit of a rod equilibrium, and the smallest step along its path. Monomers have soft
/// modes and may need thousands of iterations; rods that exceed the limit fail.
const ROD_ITERATIONS: usize = 300;
const ROD_STEP: f64 = 0.01;
const ALONG: [f64; 3] = [0.0, 0.0, 1.0];
const ACROSS: [f64; 3] = [1.0, 0.0, 0.0];
/// Displacement of each end of a buckled filament (nm).
const PUSHED_NM: f64 = 7.5;

/// Results of a filament under the loads of a case.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct CaseSolution {
    /// Compared quantities by name.
    pub values: Vec<(String, f64)>,
    /// Centre line, if shapes are compared.
    pub line: Option<CentreLine>,
    /// Writhe (turns), which distinguishes equilibria.
    pub writhe: Option<f64>,
    /// Number of equilibria that are not certified as minima.
    pub doubtful: usize,
    /// Number of jumps.
    pub jumps: usize,
    /// Values without an equilibrium, with the reason.
    pub unreached: Vec<String>,
}

impl CaseSolution {
    pub(super) fn value(&self, name: &str) -> Option<f64> {
        let found = self.values.iter().find(|(own, _)| own == name);
        found.map(|(_, value)| *value)
    }

    fn count(&mut self, evidence: &Evidence) {
        self.doubtful += usize::from(!evidence.is_stable());
        self.jumps += evidence.jumps;
    }
}

/// Solves a case.
///
/// # Errors
/// An invalid scene, a scene without an equilibrium, or a value that is not finite.
pub(super) fn solve(case: &Case, made: &FilamentModel) -> Result<CaseSolution, String> {
    let found = match &case.loading {
        Loading::Linked { figure } => linked(*figure, made),
        Loading::Buckled { turn_deg } => buckled(case.length_nm(), *turn_deg, made),
        Loading::Twisted { turns_deg } => twisted(case.length_nm(), turns_deg, made),
        Loading::Forces {
            far_end, forces_pn, ..
        } => loaded(case, (*far_end, forces_pn), made),
    };
    let named = |e: String| format!("{}, {}: {e}", case.name, made.name);
    let found = found.map_err(named)?;
    match found.values.iter().find(|(_, value)| !value.is_finite()) {
        Some((name, value)) => Err(named(format!("{name} is {value}"))),
        None => Ok(found),
    }
}

/// Settings of a path that tries each stage in one step.
fn solver(made: &FilamentModel) -> Equilibrium {
    let mut solver = Equilibrium {
        largest_step: 1.0,
        accept_jumps: true,
        ..Equilibrium::default()
    };
    if made.is_rod() {
        (solver.iterations, solver.smallest_step) = (ROD_ITERATIONS, ROD_STEP);
    }
    solver
}

/// The scene of a case of forces, and the number of stages before those of the forces.
pub(super) fn scene(case: &Case, made: &FilamentModel) -> (Scene, usize) {
    let Loading::Forces {
        far_end,
        turn_deg,
        tension_pn,
        forces_pn,
    } = &case.loading
    else {
        unreachable!("other cases do not use this scene")
    };
    let factor = |load, factor| Setting::LoadFactor { load, factor };
    let mut before = Vec::new();
    if *turn_deg != 0.0 {
        let turn_deg = turn_deg * case.length_nm() / TURNED_NM;
        before.push(Setting::turn(End::End, [0.0, 0.0, turn_deg]));
    }
    // Unit forces on the end; the last one is scaled to each value.
    let is_along = *far_end == Some(FreeTranslation::AlongAxis);
    let mut directions = vec![if is_along { ALONG } else { ACROSS }];
    if *tension_pn != 0.0 {
        directions.insert(0, ALONG);
        before.push(factor(0, *tension_pn));
    }
    let last = directions.len() - 1;
    let count = before.len();
    let forces = forces_pn.iter().map(|&force| factor(last, force));
    let path = before.into_iter().chain(forces);
    let mut clamps = vec![Clamp::new(End::Start)];
    clamps.extend(far_end.map(|slides| Clamp::new(End::End).sliding(slides)));
    let scene = Scene {
        clamps,
        loads: directions
            .into_iter()
            .map(|force| Load::end_force(End::End, force))
            .collect(),
        path: path.map(|setting| Stage::new([setting])).collect(),
        ..Scene::new(made.filament(case.length_nm()), solver(made))
    };
    (scene, count)
}

/// A filament loaded step by step, with a value at each step.
fn loaded(
    case: &Case,
    (far_end, forces_pn): (Option<FreeTranslation>, &[f64]),
    made: &FilamentModel,
) -> Result<CaseSolution, String> {
    let (scene, before) = scene(case, made);
    let ends = follow(&scene).map_err(|e| e.to_string())?;
    let assembly = &ends.assembly;
    let place = |state: &State| match far_end {
        Some(_) => far_end_shift(assembly, state),
        None => assembly.tip_nm(state, End::End),
    };
    // Displacements refer to the state under the previous loads.
    let start = match before {
        0 => place(&assembly.rest),
        _ => ends
            .stops
            .get(before - 1)
            .map_or(Vector3::repeat(f64::NAN), |stop| place(&stop.state)),
    };
    let mut found = CaseSolution::default();
    for stop in &ends.stops {
        found.count(&stop.evidence);
    }
    let length = assembly.length_nm();
    for (&force, stop) in forces_pn.iter().zip(ends.stops.iter().skip(before)) {
        let moved = place(&stop.state) - start;
        found.values.push(match far_end {
            None => (format!("tip at {force} pN (nm)"), moved.x),
            Some(FreeTranslation::AlongAxis) => {
                (format!("S3 at {force} pN (pN)"), force * length / moved.z)
            }
            Some(_) => (format!("nm/pN at {force} pN"), moved.x / force),
        });
    }
    found.unreached = ends.ended.map(|e| e.to_string()).into_iter().collect();
    Ok(found)
}

/// Twist with the protocol of Tables 3 and 5.
fn twisted(
    length_nm: f64,
    turns_deg: &[f64],
    made: &FilamentModel,
) -> Result<CaseSolution, String> {
    let specimen = Specimen {
        solver: solver(made),
        ..Specimen::new(made.filament(length_nm))
    };
    let turns: Vec<f64> = turns_deg
        .iter()
        .map(|turn| turn * length_nm / TURNED_NM)
        .collect();
    let curve = twist(&specimen, &turns).map_err(|e| e.to_string())?;
    let mut found = CaseSolution::default();
    for point in &curve.points {
        let name = point.turn_deg * TURNED_NM / length_nm;
        let value = |what: &str, unit: &str| format!("{what} at {name:+.0} deg{unit}");
        let length = point.relative_length_change;
        found
            .values
            .push((value("B3", " (pN nm^2)"), point.rigidity_pn_nm2));
        found.values.push((value("dL/L", ""), length));
        found.count(&point.evidence);
    }
    let unreached = curve.unreached.into_iter();
    found.unreached = unreached
        .map(|u| format!("{:+} deg: {}", u.value, u.reason))
        .collect();
    Ok(found)
}

/// A free filament on linkers: the equilibrium of lowest energy from several initial rotations.
fn linked(figure: u32, made: &FilamentModel) -> Result<CaseSolution, String> {
    let mut scene = scenario(&format!("figure-{figure}/linkers.ron"))?;
    let length = scene.filament.sections.last().map(|s| s.span_nm().1);
    scene.filament = made.filament(length.ok_or("a filament without sections")?);
    scene.task = Task::Equilibrium(Equilibrium {
        largest_step: Equilibrium::default().largest_step,
        accept_jumps: false,
        ..solver(made)
    });
    let solved = rolled(&scene)?;
    let energy = |solved: &Solution| solved.last().potential_pn_nm();
    let lowest = solved.iter().min_by(|a, b| energy(a).total_cmp(&energy(b)));
    let lowest = lowest.ok_or("no start")?;
    Ok(CaseSolution {
        values: vec![("energy (pN nm)".to_owned(), energy(lowest))],
        line: Some(CentreLine::new(&lowest.assembly, lowest.state())),
        doubtful: usize::from(doubtful(lowest) != Some([0, 0])),
        ..CaseSolution::default()
    })
}

/// A filament whose ends are turned and pushed in, in both orders; the equilibrium of lower energy.
fn buckled(length_nm: f64, turn_deg: f64, made: &FilamentModel) -> Result<CaseSolution, String> {
    let mut scene = scenario("figure-8/rod-140.ron")?;
    scene.filament = made.filament(length_nm);
    if let (Task::Equilibrium(task), true) = (&mut scene.task, made.is_rod()) {
        (task.iterations, task.smallest_step) = (ROD_ITERATIONS, ROD_STEP);
    }
    for clamp in &mut scene.clamps {
        clamp.hold = Hold::Wall;
    }
    for linker in &mut scene.linkers {
        linker.at_nm = 0.5 * length_nm;
    }
    let turned = |end, turn_deg: f64| Setting::turn(end, [0.0, 0.0, turn_deg]);
    let stages = [
        Stage::new([turned(End::Start, -turn_deg), turned(End::End, turn_deg)]),
        Stage::new([shift(End::Start, PUSHED_NM), shift(End::End, -PUSHED_NM)]),
    ];
    let mut failures = Vec::new();
    let mut lowest: Option<(f64, CaseSolution)> = None;
    for order in [[0, 1], [1, 0]] {
        scene.path = order.map(|k| stages[k].clone()).into();
        match buckled_along(&scene, turn_deg) {
            Ok(found) if lowest.as_ref().is_none_or(|low| found.0 < low.0) => lowest = Some(found),
            Ok(_) => {}
            Err(error) => failures.push(error),
        }
    }
    let (_, found) = lowest.ok_or_else(|| failures.join("; "))?;
    Ok(CaseSolution {
        unreached: failures,
        ..found
    })
}

/// Energy and shape at the end of one path.
fn buckled_along(scene: &Scene, turn_deg: f64) -> Result<(f64, CaseSolution), String> {
    let mut ends = follow(scene).map_err(|e| e.to_string())?;
    if let Some(ended) = ends.ended {
        return Err(ended.to_string());
    }
    let stop = ends.stops.pop().ok_or("no equilibrium")?;
    let assembly = &mut ends.assembly;
    *assembly.system.state_mut() = stop.state;
    let energy = elastic(assembly);
    let state = assembly.system.state();
    let ribbon = Ribbon::new(assembly, state);
    let end = reaction(assembly, state, End::End);
    let values = [
        ("height (nm)", ribbon.largest_distance_nm()),
        ("couple (pN nm)", end.torque_pn_nm.z * turn_deg.signum()),
        ("thrust (pN)", -end.force_pn.z),
    ];
    let mut found = CaseSolution {
        values: values.map(|(name, value)| (name.to_owned(), value)).into(),
        writhe: ribbon.writhe(),
        ..CaseSolution::default()
    };
    found.count(&stop.evidence);
    Ok((energy, found))
}

/// Energy of the filament without linkers and loads (pN nm).
fn elastic(assembly: &Assembly) -> f64 {
    let terms = assembly.terms.iter().zip(assembly.system.energies());
    let own = terms.filter(|(term, _)| !matches!(term.part, Part::Load(_) | Part::Linker(_)));
    own.map(|(_, energy)| energy).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_cases::case::Group;
    use actin_sim::{Load, RodLaw};

    /// A case of tension 0 has no axial load. A tension of 5 pN scales a unit load by 5.
    #[test]
    fn the_axial_load_equals_the_tension_of_the_case() {
        let made = FilamentModel::coarse(&RodLaw::Constant);
        for (tension, along) in [(0.0, 0.0), (5.0, 5.0)] {
            let (scene, _) = scene(&Case::guided(Group::Guided, 22.0, tension), &made);
            scene.validate().unwrap();
            let factor = |load: usize| {
                let mut settings = scene.path.iter().flat_map(|stage| &stage.set);
                settings.find_map(|setting| match *setting {
                    Setting::LoadFactor { load: l, factor } if l == load => Some(factor),
                    _ => None,
                })
            };
            let loads = scene.loads.iter().enumerate();
            let tensions = loads.map(|(i, load)| match load {
                Load::EndForce { force_pn, .. } => force_pn[2] * factor(i).unwrap(),
                _ => f64::NAN,
            });
            let sum: f64 = tensions.sum();
            assert!((sum - along).abs() <= f64::EPSILON * along.abs(), "{sum}");
        }
    }
}
