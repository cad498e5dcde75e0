//! A load case of one filament: its scene, the certified equilibria along its path, and what is read of them.

use super::case::{Case, Kind, TURNED_NM};
use super::filament::{Made, RISE_NM};
use crate::figures::linked::centre_line::CentreLine;
use crate::measure::{Specimen, far_end_shift, follow, reaction, twist};
use crate::run::{clamp, run_to_end, scenario};
use actin_mechanics::{State, Vector3};
use actin_sim::shape::Ribbon;
use actin_sim::{
    Assembly, End, Equilibrium, Hold, Load, Output, Part, Scene, Setting, Slides, Stage, Task,
};
use serde::{Deserialize, Serialize};

/// Turns of a free filament about its axis from which equilibria are sought (deg).
const STARTS_DEG: [f64; 4] = [0.0, 90.0, 180.0, 270.0];
/// Most iterations for one equilibrium of a rod, and the smallest step along its path.
const ROD_ITERATIONS: usize = 300;
const ROD_STEP: f64 = 0.01;
/// How far each end of a buckled filament is pushed in (nm).
const PUSHED_NM: f64 = 7.5;
/// Length of a buckled filament: 301.2 nm.
pub(super) const BUCKLED: u32 = 110;

/// What a filament does under the loads of a case.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct Found {
    /// What is compared, by name.
    pub values: Vec<(String, f64)>,
    /// Centre line, where shapes are compared.
    pub line: Option<CentreLine>,
    /// Numbers that tell one equilibrium from another: writhe in turns.
    pub writhe: Option<f64>,
    /// Equilibria that are not minima beyond doubt.
    pub doubtful: usize,
    /// Saddles that were left, and sudden jumps.
    pub saddles_left: usize,
    pub jumps: usize,
    /// Values that were not reached, and why.
    pub unreached: Vec<String>,
}

impl Found {
    /// The value of a quantity.
    pub(super) fn value(&self, name: &str) -> Option<f64> {
        let found = self.values.iter().find(|(own, _)| own == name);
        found.map(|(_, value)| *value)
    }
}

/// Solves a case.
///
/// # Errors
/// A scene that is refused, one without an equilibrium, and a number that is not finite.
pub(super) fn solve(case: &Case, made: &Made) -> Result<Found, String> {
    let found = match &case.kind {
        Kind::Linked { figure } => linked(*figure, made),
        Kind::Buckled { turn_deg } => buckled(*turn_deg, made),
        Kind::Twisted { rises, turns_deg } => twisted(length(*rises), turns_deg, made),
        _ => loaded(&case.kind, made),
    };
    let found = found.map_err(|e| format!("{}, {}: {e}", case.name, made.name()))?;
    match found.values.iter().find(|(_, value)| !value.is_finite()) {
        Some((name, value)) => Err(format!("{}, {}: {name} is {value}", case.name, made.name())),
        None => Ok(found),
    }
}

fn length(rises: u32) -> f64 {
    f64::from(rises) * RISE_NM
}

fn force(force_pn: [f64; 3]) -> Load {
    Load::EndForce {
        filament: 0,
        end: End::End,
        force_pn,
    }
}

fn turn(end: End, turn_deg: f64) -> Setting {
    Setting::Turn {
        filament: 0,
        end,
        turn_deg: [0.0, 0.0, turn_deg],
    }
}

/// Settings of a path that tries each stage at once. What a rod does not reach in a few hundred iterations and
/// steps of a hundredth it does not reach in thousands, which monomers with their soft directions may need.
fn solver(made: &Made) -> Equilibrium {
    let default = Equilibrium::default();
    let (iterations, smallest_step) = if matches!(made, Made::Rod(_)) {
        (ROD_ITERATIONS, ROD_STEP)
    } else {
        (default.iterations, default.smallest_step)
    };
    Equilibrium {
        iterations,
        smallest_step,
        largest_step: 1.0,
        accept_jumps: true,
        ..default
    }
}

/// A path of stages that set one load each: first those that are not read, then the last load at each value.
pub(super) struct Course<'a> {
    /// Unit forces on the end. Each is set by a stage.
    directions: &'static [[f64; 3]],
    before: Vec<Setting>,
    forces_pn: &'a [f64],
    far_end: Option<Slides>,
    length_nm: f64,
    /// Direction along which displacements are read.
    along: Vector3,
    /// Name and value of a quantity from force (pN) and displacement (nm).
    read: fn(f64, f64, f64) -> (String, f64),
}

pub(super) fn course(kind: &Kind) -> Course<'_> {
    match kind {
        Kind::Cantilever {
            rises,
            tension_pn,
            forces_pn,
        } => Course {
            far_end: None,
            length_nm: length(*rises) + 0.5 * RISE_NM,
            read: |force, moved, _| (format!("tip at {force} pN (nm)"), moved),
            ..across(*tension_pn, forces_pn)
        },
        Kind::Guided {
            rises,
            tension_pn,
            forces_pn,
        } => Course {
            length_nm: length(*rises),
            ..across(*tension_pn, forces_pn)
        },
        Kind::Stretched {
            rises,
            turn_deg,
            forces_pn,
        } => along(length(*rises), *turn_deg, forces_pn),
        _ => unreachable!("other cases have paths of their own"),
    }
}

/// Pulled along, then pushed across at an end that slides; the length is the caller's.
fn across(tension_pn: f64, forces_pn: &[f64]) -> Course<'_> {
    let tension = Setting::LoadFactor {
        load: 0,
        factor: tension_pn,
    };
    let is_pulled = tension_pn != 0.0;
    Course {
        directions: if is_pulled {
            &[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
        } else {
            &[[1.0, 0.0, 0.0]]
        },
        before: is_pulled.then_some(tension).into_iter().collect(),
        forces_pn,
        far_end: Some(Slides::Freely),
        length_nm: 0.0,
        along: Vector3::x(),
        read: |force, moved, _| (format!("nm/pN at {force} pN"), moved / force),
    }
}

/// Turned by so much per length of Tables 3 and 5, then pulled along.
fn along(length_nm: f64, turn_deg: f64, forces_pn: &[f64]) -> Course<'_> {
    let turned = turn(End::End, turn_deg * length_nm / TURNED_NM);
    Course {
        directions: &[[0.0, 0.0, 1.0]],
        before: (turn_deg != 0.0).then_some(turned).into_iter().collect(),
        forces_pn,
        far_end: Some(Slides::AlongAxis),
        length_nm,
        along: Vector3::z(),
        read: |force, moved, length| (format!("S3 at {force} pN (pN)"), force * length / moved),
    }
}

/// A filament that is loaded step by step, read at each.
fn loaded(kind: &Kind, made: &Made) -> Result<Found, String> {
    let course = course(kind);
    let before = course.before.len();
    let ends = follow(&course.scene(made)).map_err(|e| e.to_string())?;
    let assembly = &ends.assembly;
    let place = |state: &State| match course.far_end {
        Some(_) => far_end_shift(assembly, state),
        None => assembly.tip_nm(state, End::End),
    };
    // From where what acts before has brought it.
    let start = match before {
        0 => place(&assembly.rest),
        _ => ends
            .stops
            .get(before - 1)
            .map_or(Vector3::repeat(f64::NAN), |stop| place(&stop.state)),
    };
    let mut found = Found::default();
    for stop in &ends.stops {
        found.doubtful += usize::from(!stop.evidence.is_stable());
        found.saddles_left += stop.evidence.saddles_left;
        found.jumps += stop.evidence.jumps;
    }
    let stops = ends.stops.iter().skip(before);
    for (&force, stop) in course.forces_pn.iter().zip(stops) {
        let moved = (place(&stop.state) - start).dot(&course.along);
        let length = assembly.length_nm();
        found.values.push((course.read)(force, moved, length));
    }
    found.unreached = ends.ended.map(|e| e.to_string()).into_iter().collect();
    Ok(found)
}

impl Course<'_> {
    pub(super) fn scene(&self, made: &Made) -> Scene {
        let stage = |setting: Setting| Stage {
            set: vec![setting],
            duration_ns: None,
            pace: actin_sim::Pace::Smooth,
        };
        let at = |&factor: &f64| Setting::LoadFactor {
            load: self.directions.len() - 1,
            factor,
        };
        let settings = self.before.iter().copied();
        let path = settings.chain(self.forces_pn.iter().map(at)).map(stage);
        let mut clamps = vec![clamp(End::Start, Slides::Nowhere)];
        clamps.extend(self.far_end.map(|slides| clamp(End::End, slides)));
        Scene {
            title: "Load case".to_owned(),
            filament: made.filament(self.length_nm),
            further: Vec::new(),
            clamps,
            loads: self.directions.iter().copied().map(force).collect(),
            linkers: Vec::new(),
            repulsion: None,
            path: path.collect(),
            observe: Vec::new(),
            burn_in_ns: None,
            output: Output::default(),
            task: Task::Equilibrium(solver(made)),
        }
    }
}

/// Twist by the protocol of Tables 3 and 5.
fn twisted(length_nm: f64, turns_deg: &[f64], made: &Made) -> Result<Found, String> {
    let specimen = Specimen {
        solver: solver(made),
        ..Specimen::new(made.filament(length_nm))
    };
    let turns: Vec<f64> = turns_deg
        .iter()
        .map(|turn| turn * length_nm / TURNED_NM)
        .collect();
    let curve = twist(&specimen, &turns).map_err(|e| e.to_string())?;
    let mut found = Found::default();
    for point in &curve.points {
        let name = point.turn_deg * TURNED_NM / length_nm;
        let value = |what: &str, unit: &str| format!("{what} at {name:+.0} deg{unit}");
        let length = point.relative_length_change;
        found
            .values
            .push((value("B3", " (pN nm^2)"), point.rigidity_pn_nm2));
        found.values.push((value("dL/L", ""), length));
        found.doubtful += usize::from(!point.evidence.is_stable());
        found.saddles_left += point.evidence.saddles_left;
        found.jumps += point.evidence.jumps;
    }
    let unreached = curve.unreached.into_iter();
    found.unreached = unreached
        .map(|u| format!("{:+} deg: {}", u.value, u.reason))
        .collect();
    Ok(found)
}

/// A free filament on linkers: of the equilibria from several turns the lowest.
fn linked(figure: u32, made: &Made) -> Result<Found, String> {
    let mut scene = scenario(&format!("figure-{figure}/linkers.ron"))?;
    let length = scene.filament.sections.last().map(|s| s.span_nm().1);
    scene.filament = made.filament(length.ok_or("a filament without sections")?);
    scene.task = Task::Equilibrium(Equilibrium {
        largest_step: Equilibrium::default().largest_step,
        accept_jumps: false,
        ..solver(made)
    });
    let mut lowest: Option<(f64, Found)> = None;
    for start in STARTS_DEG {
        let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
        assembly.roll(start.to_radians());
        let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| e.to_string())?;
        let last = trajectory.records.last().ok_or("no record")?;
        let energy = last.potential_pn_nm();
        let certificate = report.equilibrium.ok_or("no certificate")?.certificate;
        if lowest.as_ref().is_some_and(|(low, _)| energy >= *low) {
            continue;
        }
        let found = Found {
            values: vec![("energy (pN nm)".to_owned(), energy)],
            line: Some(CentreLine::of(&assembly, &last.state)),
            doubtful: usize::from(certificate.negative + certificate.unresolved > 0),
            ..Found::default()
        };
        lowest = Some((energy, found));
    }
    lowest
        .map(|(_, found)| found)
        .ok_or_else(|| "no start".to_owned())
}

/// Holds every clamped end by a wall.
fn hold_by_walls(scene: &mut Scene) {
    for clamp in &mut scene.clamps {
        clamp.hold = Hold::Wall;
    }
}

/// A filament whose ends are turned and pushed together, in both orders: the lower equilibrium.
fn buckled(turn_deg: f64, made: &Made) -> Result<Found, String> {
    let mut scene = scenario("figure-8/rod-140.ron")?;
    let length_nm = length(BUCKLED);
    scene.filament = made.filament(length_nm);
    if let (Task::Equilibrium(task), Made::Rod(_)) = (&mut scene.task, made) {
        (task.iterations, task.smallest_step) = (ROD_ITERATIONS, ROD_STEP);
    }
    hold_by_walls(&mut scene);
    for linker in &mut scene.linkers {
        linker.at_nm = 0.5 * length_nm;
    }
    let pushed = |end, by: f64| Setting::Shift {
        filament: 0,
        end,
        shift_nm: [0.0, 0.0, by],
    };
    let (duration_ns, pace) = (None, actin_sim::Pace::Smooth);
    let stage = |set: [Setting; 2]| Stage {
        set: set.into(),
        duration_ns,
        pace,
    };
    let stages = [
        stage([turn(End::Start, -turn_deg), turn(End::End, turn_deg)]),
        stage([pushed(End::Start, PUSHED_NM), pushed(End::End, -PUSHED_NM)]),
    ];
    let mut failures = Vec::new();
    let mut lowest: Option<(f64, Found)> = None;
    for order in [[0, 1], [1, 0]] {
        scene.path = order.map(|k| stages[k].clone()).into();
        match buckled_along(&scene, turn_deg) {
            Ok(found) if lowest.as_ref().is_none_or(|low| found.0 < low.0) => lowest = Some(found),
            Ok(_) => {}
            Err(error) => failures.push(error),
        }
    }
    let (_, found) = lowest.ok_or_else(|| failures.join("; "))?;
    Ok(Found {
        unreached: failures,
        ..found
    })
}

/// Energy and shape at the end of one path.
fn buckled_along(scene: &Scene, turn_deg: f64) -> Result<(f64, Found), String> {
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
    let found = Found {
        values: values.map(|(name, value)| (name.to_owned(), value)).into(),
        writhe: ribbon.writhe(),
        doubtful: usize::from(!stop.evidence.is_stable()),
        saddles_left: stop.evidence.saddles_left,
        jumps: stop.evidence.jumps,
        ..Found::default()
    };
    Ok((energy, found))
}

/// Energy of the filament alone (pN nm).
fn elastic(assembly: &Assembly) -> f64 {
    let terms = assembly.terms.iter().zip(assembly.system.energies());
    let own = terms.filter(|(term, _)| !matches!(term.part, Part::Load(_) | Part::Linker(_)));
    own.map(|(_, energy)| energy).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_cases::bound::Group;
    use crate::load_cases::case::guided;
    use crate::load_cases::filament::Rod;
    use actin_sim::RodLaw;

    /// A case of tension 0 has no load along the axis, one of 5 pN a load of which a stage sets 5 times 1 pN.
    #[test]
    fn tension_is_what_the_case_says() {
        let made = Made::Rod(Rod::coarse(&RodLaw::Constant));
        for (tension, along) in [(0.0, 0.0), (5.0, 5.0)] {
            let scene = course(&guided(Group::Guided, 22, tension).kind).scene(&made);
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
