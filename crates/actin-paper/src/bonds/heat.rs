//! Stiffness at room temperature: free filaments in a heat bath, and how much cross-sections turn
//! against each other.
//!
//! At distance `s`, `<cos theta> = exp(-s / lp)` and `<phi^2> = s kT / C`, where `theta` tilts the axis
//! and `phi` goes about it. `next` takes neighbours; `far` takes the slopes between 1/5 and 3/5 of the
//! length, which the wobble of single monomers does not enter.

use super::Effort;
use super::page::Listing;
use super::study::bar;
use super::variant::Variant;
use actin_integrate::{Bath, Composition, Drag, POSITION_VERLET, advance_in};
use actin_integrate::{largest_frequency, stable_step};
use actin_mechanics::{State, UnitQuaternion, rotation};
use actin_sim::{
    Assembly, BOLTZMANN_PN_NM_PER_K, Equilibrium, Filament as Description, Monomers, Scene,
    Section, Task,
};
use rayon::prelude::*;

/// Temperature (K).
const ROOM: f64 = 298.0;
/// Drag rate (1/ns): near critical for the slowest bending.
const DRAG: f64 = 5.0;
/// Motion before the first sample (ns), ten times the slowest relaxation.
const WARM_UP_NS: f64 = 5.0;
/// Time between samples (ns).
const APART_NS: f64 = 0.25;
/// Samples of one replica.
const SAMPLES: usize = 400;
/// Replicas, each of other noise and another sampling; fewer where bonds are many.
const REPLICAS: u64 = 64;
const REPLICAS_OF_MANY: u64 = 16;
/// Time step as a share of the stability limit of position Verlet.
const SHARE: f64 = 0.4;
/// Length (nm).
const LENGTH_NM: f64 = 110.0;

/// A free filament in a heat bath.
#[derive(Debug)]
pub(super) struct Filament {
    pub assembly: Assembly,
    bath: Bath,
    /// Thermal energy (pN nm).
    pub kt: f64,
    /// Degrees of freedom.
    pub dofs: f64,
    /// Largest frequency at rest (rad/ns).
    pub frequency: f64,
}

impl Filament {
    /// The filament as built; replicas differ in noise and, of drawn bonds, in the sampling.
    pub(super) fn new(variant: &Variant, length_nm: f64, replica: u64) -> Result<Self, String> {
        let section = Section::Ellipsoids {
            from_nm: 0.0,
            to_nm: length_nm,
        };
        let seed = if variant.is_drawn() { replica } else { 0 };
        let scene = Scene {
            title: variant.bonds(),
            filament: Description {
                monomers: variant.sampling(seed),
                ..Description::new(vec![section])
            },
            further: Vec::new(),
            clamps: Vec::new(),
            loads: Vec::new(),
            linkers: Vec::new(),
            path: Vec::new(),
            task: Task::Equilibrium(Equilibrium::default()),
        };
        let assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
        let frequency = largest_frequency(&assembly.system).map_err(|e| e.to_string())?;
        let kt = BOLTZMANN_PN_NM_PER_K * ROOM;
        let drag = Drag::new(DRAG, DRAG).map_err(|e| e.to_string())?;
        let bath = Bath::new(drag, kt, replica + 1).map_err(|e| e.to_string())?;
        let state = assembly.system.state();
        let dofs = 3.0 * (state.points.len() + state.frames.len()) as f64;
        Ok(Self {
            assembly,
            bath,
            kt,
            dofs,
            frequency,
        })
    }

    /// Brings it to temperature; the time step (ns), at a share of the stability limit at rest.
    pub(super) fn warm_up(&mut self, scheme: &Composition, share: f64) -> Result<f64, String> {
        let step = stable_step(scheme, self.frequency, share).map_err(|e| e.to_string())?;
        let system = &mut self.assembly.system;
        advance_in(system, scheme, step, steps(WARM_UP_NS, step), &self.bath, 0);
        Ok(step)
    }
}

/// Steps of `h` in a duration.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "some ns in steps of a thousandth"
)]
pub(super) fn steps(duration: f64, h: f64) -> u64 {
    (duration / h).ceil() as u64
}

/// Means over one replica, by separation of frames.
struct Sums {
    /// `<cos theta>`.
    cosine: Vec<f64>,
    /// `<phi^2>` (rad^2).
    twist: Vec<f64>,
    /// Potential energy per degree of freedom (kT).
    energy: f64,
}

impl Sums {
    fn of(variant: &Variant, replica: u64, samples: usize) -> Result<Self, String> {
        let mut filament = Filament::new(variant, LENGTH_NM, replica)?;
        let step = filament.warm_up(&POSITION_VERLET, SHARE)?;
        let rest = filament.assembly.rest.clone();
        let count = rest.frames.len();
        let mut sums = Self {
            cosine: vec![0.0; count],
            twist: vec![0.0; count],
            energy: 0.0,
        };
        let (warm_up, apart) = (steps(WARM_UP_NS, step), steps(APART_NS, step));
        for sample in 0..samples as u64 {
            let system = &mut filament.assembly.system;
            let first = warm_up + sample * apart;
            advance_in(system, &POSITION_VERLET, step, apart, &filament.bath, first);
            sums.add(&rest, system.state(), samples);
            let kts = filament.kt * filament.dofs * samples as f64;
            sums.energy += system.potential_energy() / kts;
        }
        Ok(sums)
    }

    /// Adds a sample: the mean over all pairs of frames at each separation.
    fn add(&mut self, rest: &State, state: &State, samples: usize) {
        let (q0, q) = (&rest.frames.orientation, &state.frames.orientation);
        // Turns from rest, in the axes of the filament at rest: z is its axis.
        let turns: Vec<UnitQuaternion> = (0..q.len())
            .map(|i| q.get(i) * q0.get(i).inverse())
            .collect();
        for k in 0..turns.len() {
            let pairs = turns.iter().zip(&turns[k..]);
            let weight = 1.0 / (pairs.len() * samples) as f64;
            for (a, b) in pairs {
                let relative = a.inverse() * b;
                let (x, y) = (relative.i, relative.j);
                // Of a rotation, the element (3, 3) of its matrix.
                self.cosine[k] += weight * (1.0 - 2.0 * (x * x + y * y));
                self.twist[k] += weight * rotation::log(relative).z.powi(2);
            }
        }
    }
}

/// What is compared, and replicas of each.
fn variants() -> Vec<(Variant, u64)> {
    vec![
        (Variant::drawn(1024, 0.2), REPLICAS_OF_MANY),
        (Variant::drawn(64, 0.2), REPLICAS),
        (Variant::drawn(64, 0.0), REPLICAS),
        (Variant::weighted(8, 0.2), REPLICAS),
        (Variant::weighted(12, 0.2), REPLICAS),
        (Variant::weighted(16, 0.2), REPLICAS),
        (Variant::weighted(24, 0.2), REPLICAS),
    ]
}

/// Rigidities at room temperature of all variants.
pub(super) fn table(effort: Effort) -> Result<Listing, String> {
    let samples = SAMPLES / effort.fraction as usize;
    let variants = variants();
    let replicas = variants.iter().map(|(_, replicas)| *replicas).sum::<u64>();
    let bar = bar(usize::try_from(replicas).unwrap_or(0));
    let mut rows = Vec::new();
    for (variant, replicas) in &variants {
        let sums: Vec<Sums> = (0..*replicas)
            .into_par_iter()
            .map(|replica| {
                let sums = Sums::of(variant, replica, samples);
                bar.inc(1);
                sums
            })
            .collect::<Result<_, _>>()?;
        let name = format!(
            "{}, {:.1} nm",
            variant.bonds(),
            variant.monomers.min_bond_nm
        );
        rows.push(row(name, &sums, variant.monomers.rise_nm));
    }
    bar.finish_and_clear();
    let header = vec![
        "bonds, shortest",
        "kT lp next (pN nm^2)",
        "C next (pN nm^2)",
        "kT lp far (pN nm^2)",
        "C far (pN nm^2)",
        "U per degree of freedom (kT)",
    ];
    Ok(Listing { header, rows })
}

fn row(name: String, sums: &[Sums], rise_nm: f64) -> Vec<String> {
    let next = [0, 1];
    let energy = jackknife(sums, |chosen| {
        chosen.iter().map(|s| s.energy).sum::<f64>() / chosen.len() as f64
    });
    let shown = |(value, error): (f64, f64)| format!("{value:.0} +- {error:.0}");
    let mut row = vec![name];
    for separation in [next, far(sums)] {
        let tilt = rigidity(sums, separation, |s, k| s.cosine[k], true, rise_nm);
        let twist = rigidity(sums, separation, |s, k| s.twist[k], false, rise_nm);
        row.extend([tilt, twist].map(shown));
    }
    row.push(format!("{:.4} +- {:.4}", energy.0, energy.1));
    row
}

/// Separations (frames) between which slopes are taken.
fn far(sums: &[Sums]) -> [usize; 2] {
    let count = sums[0].cosine.len();
    [count / 5, 3 * count / 5]
}

/// Rigidity (pN nm^2) from the slope between two separations, with its standard error: `kT lp` if `of` is a
/// cosine of tilt, else `C`.
fn rigidity(
    sums: &[Sums],
    [a, b]: [usize; 2],
    of: fn(&Sums, usize) -> f64,
    tilts: bool,
    rise_nm: f64,
) -> (f64, f64) {
    let kt = BOLTZMANN_PN_NM_PER_K * ROOM;
    jackknife(sums, |chosen| {
        let at = |k: usize| {
            let mean = chosen.iter().map(|s| of(s, k)).sum::<f64>() / chosen.len() as f64;
            if tilts { -mean.ln() } else { mean }
        };
        kt * (b - a) as f64 * rise_nm / (at(b) - at(a))
    })
}

/// Persistence length (um) of monomers at 298 K with its standard error, from so many free filaments of 110
/// nm, each of other noise and, of drawn bonds, another sampling.
///
/// # Errors
/// A filament that cannot be built or moved.
pub(crate) fn persistence_length_um(
    monomers: &Monomers,
    replicas: u64,
    done: impl Fn() + Sync,
) -> Result<(f64, f64), String> {
    let variant = Variant {
        monomers: monomers.clone(),
    };
    let sums: Vec<Sums> = (0..replicas)
        .into_par_iter()
        .map(|replica| Sums::of(&variant, replica, SAMPLES))
        .inspect(|_| done())
        .collect::<Result<_, _>>()?;
    let tilt = |s: &Sums, k: usize| s.cosine[k];
    let (rigidity, error) = rigidity(&sums, far(&sums), tilt, true, monomers.rise_nm);
    let um = 1e-3 / (BOLTZMANN_PN_NM_PER_K * ROOM);
    Ok((um * rigidity, um * error))
}

/// An estimate from all replicas, with its standard error.
fn jackknife(sums: &[Sums], estimate: impl Fn(&[&Sums]) -> f64) -> (f64, f64) {
    let all: Vec<&Sums> = sums.iter().collect();
    let whole = estimate(&all);
    let n = all.len() as f64;
    let squares = (0..all.len()).map(|leave| {
        let rest: Vec<&Sums> = all[..leave]
            .iter()
            .chain(&all[leave + 1..])
            .copied()
            .collect();
        (estimate(&rest) - whole).powi(2)
    });
    let square: f64 = squares.sum();
    (whole, (square * (n - 1.0) / n).sqrt())
}
