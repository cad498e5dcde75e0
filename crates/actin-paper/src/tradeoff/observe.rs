//! What is read off a state, and how far two of them are apart.

use super::study::{Displacement, Field, Reaction, Study};
use actin_mechanics::{Loads, State, Vector3};
use actin_sim::shape::{ProfilePoint, Ribbon, profile};
use actin_sim::{Assembly, Clamped, End, Part};

/// Distance of the places at which centre lines and fields are compared: a rise (nm).
const STEP_NM: f64 = 71.2 / 26.0;

/// What is compared of a state; every entry is a list of components in the same order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Observed {
    /// Displacements (nm): one, or many of which the largest difference counts.
    pub displacement: Vec<Vector3>,
    /// Elastic energy, that of linkers included (pN nm).
    pub energy: f64,
    /// Forces (pN); empty where they are given.
    pub force: Vec<f64>,
    /// Torques (pN nm).
    pub torque: Vec<f64>,
    /// Curvature or twist (rad/nm).
    pub local: Vec<f64>,
}

/// Relative distances from a reference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    pub displacement: Option<f64>,
    pub energy: Option<f64>,
    pub force: Option<f64>,
    pub torque: Option<f64>,
    pub local: Option<f64>,
}

impl Observed {
    /// Reads off the state that `assembly` is in.
    pub(super) fn of(study: &Study, assembly: &mut Assembly) -> Self {
        let loads = assembly.system.loads().clone();
        let assembly = &*assembly;
        let state = assembly.system.state();
        let profile = profile(assembly, state);
        let (force, torque) = reactions(study.reaction, assembly, &loads, &profile);
        let field = |point: &ProfilePoint| match study.field {
            Field::Curvature => point.curvature_rad_per_nm,
            Field::Twist => point.twist_rad_per_nm,
        };
        let places = places(study.window);
        Self {
            displacement: displacement(study, assembly, &profile),
            energy: elastic(assembly),
            force,
            torque,
            local: places.map(|s| interpolated(&profile, s, field)).collect(),
        }
    }

    /// Relative errors against `reference`: norm of the difference over norm of the reference; of
    /// many displacements, the largest of either.
    pub(super) fn errors(&self, reference: &Self) -> Errors {
        Errors {
            displacement: relative(
                largest(
                    self.displacement
                        .iter()
                        .zip(&reference.displacement)
                        .map(|(a, b)| a - b),
                ),
                largest(reference.displacement.iter().copied()),
            ),
            energy: relative(
                (self.energy - reference.energy).abs(),
                reference.energy.abs(),
            ),
            force: of_list(&self.force, &reference.force),
            torque: of_list(&self.torque, &reference.torque),
            local: of_list(&self.local, &reference.local),
        }
    }

    /// Relative difference of sizes, with its sign.
    pub(super) fn biases(&self, reference: &Self) -> Errors {
        let size = |list: &[f64]| norm(list.iter().copied());
        let signed = |a: f64, b: f64| (b > 0.0).then(|| a / b - 1.0);
        Errors {
            displacement: signed(
                largest(self.displacement.iter().copied()),
                largest(reference.displacement.iter().copied()),
            ),
            energy: signed(self.energy, reference.energy),
            force: signed(size(&self.force), size(&reference.force)),
            torque: signed(size(&self.torque), size(&reference.torque)),
            local: signed(size(&self.local), size(&reference.local)),
        }
    }
}

impl Errors {
    /// Each entry of some errors put together by `combine`; none where none has it.
    pub(super) fn combined(all: &[Self], combine: fn(&[f64]) -> f64) -> Self {
        let of = |pick: fn(&Self) -> Option<f64>| {
            let values: Vec<f64> = all.iter().filter_map(pick).collect();
            (!values.is_empty()).then(|| combine(&values))
        };
        Self {
            displacement: of(|e| e.displacement),
            energy: of(|e| e.energy),
            force: of(|e| e.force),
            torque: of(|e| e.torque),
            local: of(|e| e.local),
        }
    }
}

fn relative(difference: f64, size: f64) -> Option<f64> {
    (size > 0.0).then(|| difference / size)
}

fn of_list(list: &[f64], reference: &[f64]) -> Option<f64> {
    let difference = norm(list.iter().zip(reference).map(|(a, b)| a - b));
    relative(difference, norm(reference.iter().copied()))
}

fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

fn largest(vectors: impl Iterator<Item = Vector3>) -> f64 {
    vectors.map(|v| v.norm()).fold(0.0, f64::max)
}

/// Places of a window, a rise apart (nm).
fn places([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0_u32..)
        .map(move |k| from + f64::from(k) * STEP_NM)
        .take_while(move |s| *s <= to)
}

/// A field between the two vertices about `s_nm`.
fn interpolated(profile: &[ProfilePoint], s_nm: f64, field: impl Fn(&ProfilePoint) -> f64) -> f64 {
    let after = profile.partition_point(|p| p.s_nm < s_nm);
    let after = after.clamp(1, profile.len() - 1);
    let (a, b) = (&profile[after - 1], &profile[after]);
    let t = ((s_nm - a.s_nm) / (b.s_nm - a.s_nm)).clamp(0.0, 1.0);
    field(a) + t * (field(b) - field(a))
}

/// The centre line at `s_nm` (nm).
fn place(profile: &[ProfilePoint], s_nm: f64) -> Vector3 {
    let component = |k: usize| interpolated(profile, s_nm, |p| p.position_nm[k]);
    Vector3::new(component(0), component(1), component(2))
}

fn displacement(study: &Study, assembly: &Assembly, profile: &[ProfilePoint]) -> Vec<Vector3> {
    let state = assembly.system.state();
    let from_rest = |at: fn(&Assembly, &State) -> Vector3| {
        vec![at(assembly, state) - at(assembly, &assembly.rest)]
    };
    match study.displacement {
        Displacement::Tip => from_rest(|assembly, state| assembly.tip_nm(state, End::End)),
        Displacement::Axial => {
            let along = from_rest(|assembly, state| assembly.tip_nm(state, End::End))[0].z;
            vec![Vector3::z() * along]
        }
        Displacement::Height => {
            let height = Ribbon::new(assembly, state).largest_distance_nm();
            vec![Vector3::x() * height]
        }
        Displacement::CentreLine => {
            // Beyond the outermost vertices of either model nothing can be compared.
            let inside = [2.0 * STEP_NM, assembly.length_nm() - 2.0 * STEP_NM];
            let along = places(inside).map(|s| place(profile, s) - Vector3::z() * s);
            along.collect()
        }
    }
}

/// Energy of all but loads (pN nm).
fn elastic(assembly: &Assembly) -> f64 {
    let terms = assembly.terms.iter().zip(assembly.system.energies());
    terms
        .filter(|(term, _)| !matches!(term.part, Part::Load(_)))
        .map(|(_, energy)| energy)
        .sum()
}

fn reactions(
    which: Reaction,
    assembly: &Assembly,
    loads: &Loads,
    profile: &[ProfilePoint],
) -> (Vec<f64>, Vec<f64>) {
    let state = assembly.system.state();
    let at = |end: End| {
        let is_it = |clamp: &&Clamped| clamp.end == end;
        assembly
            .clamps
            .iter()
            .find(is_it)
            .map(|c| c.reaction(state, loads))
    };
    let end = at(End::End).map_or([f64::NAN; 2], |r| [r.force_pn.z, r.torque_pn_nm.z]);
    match which {
        Reaction::WallTorque => {
            let torque = at(End::Start).map(|r| r.torque_pn_nm).unwrap_or_default();
            (Vec::new(), torque.iter().copied().collect())
        }
        Reaction::EndAxial => (vec![end[0]], vec![end[1]]),
        Reaction::EndCouple => (Vec::new(), vec![end[1]]),
        Reaction::LinkerForces => (linkers(assembly, profile).0, Vec::new()),
        Reaction::Linkers => linkers(assembly, profile),
    }
}

/// Forces of the linkers, and their moments about the centre line beside their sites.
fn linkers(assembly: &Assembly, profile: &[ProfilePoint]) -> (Vec<f64>, Vec<f64>) {
    let state = assembly.system.state();
    let (mut forces, mut moments) = (Vec::new(), Vec::new());
    for (linker, written) in assembly.linkers.iter().zip(&assembly.scene.linkers) {
        let force = linker.force(state);
        let arm = linker.site().position(state) - place(profile, written.at_nm);
        forces.extend(force.iter().copied());
        moments.extend(arm.cross(&force).iter().copied());
    }
    (forces, moments)
}
