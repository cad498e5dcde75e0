//! Stiffness at room temperature: free filaments in a heat bath, and how much cross-sections turn
//! against each other.
//!
//! `next` takes neighbours; `far` takes the slopes between 1/5 and 3/5 of the length, which the wobble of
//! single monomers does not enter.

use super::Effort;
use super::page::Listing;
use super::study::bar;
use super::variant::{Variant, compared};
use crate::measure::{Turns, jackknife, steps_in};
use actin_integrate::{Bath, Composition, Drag, POSITION_VERLET, advance_in};
use actin_integrate::{largest_frequency, stable_step};
use actin_sim::{
    Assembly, BOLTZMANN_PN_NM_PER_K, Equilibrium, Filament as Description, Monomers, Output, Scene,
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
            altered: None,
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
            repulsion: None,
            path: Vec::new(),
            observe: Vec::new(),
            burn_in_ns: None,
            output: Output::default(),
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
        advance_in(
            system,
            scheme,
            step,
            steps_in(WARM_UP_NS, step),
            &self.bath,
            0,
        );
        Ok(step)
    }
}

/// Means over one replica.
struct Sums {
    turns: Turns,
    /// Potential energy per degree of freedom (kT).
    energy: f64,
}

impl Sums {
    fn of(variant: &Variant, replica: u64, samples: usize) -> Result<Self, String> {
        let mut filament = Filament::new(variant, LENGTH_NM, replica)?;
        let step = filament.warm_up(&POSITION_VERLET, SHARE)?;
        let rest = filament.assembly.rest.clone();
        let mut sums = Self {
            turns: Turns::new(rest.frames.len()),
            energy: 0.0,
        };
        let (warm_up, apart) = (steps_in(WARM_UP_NS, step), steps_in(APART_NS, step));
        for sample in 0..samples as u64 {
            let system = &mut filament.assembly.system;
            let first = warm_up + sample * apart;
            advance_in(system, &POSITION_VERLET, step, apart, &filament.bath, first);
            sums.turns.add(&rest, system.state(), samples);
            let kts = filament.kt * filament.dofs * samples as f64;
            sums.energy += system.potential_energy() / kts;
        }
        Ok(sums)
    }
}

/// What is compared, and replicas of each.
fn variants() -> Vec<(Variant, u64)> {
    let replicas = |variant: &Variant| match variant.monomers.lateral_bonds {
        0..=64 => REPLICAS,
        _ => REPLICAS_OF_MANY,
    };
    compared()
        .into_iter()
        .map(|variant| {
            let replicas = replicas(&variant);
            (variant, replicas)
        })
        .collect()
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
        let tilt = rigidity(sums, separation, |s, k| s.turns.cosine[k], true, rise_nm);
        let twist = rigidity(sums, separation, |s, k| s.turns.twist[k], false, rise_nm);
        row.extend([tilt, twist].map(shown));
    }
    row.push(format!("{:.4} +- {:.4}", energy.0, energy.1));
    row
}

/// Separations (frames) between which slopes are taken.
fn far(sums: &[Sums]) -> [usize; 2] {
    let count = sums[0].turns.cosine.len();
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
    let tilt = |s: &Sums, k: usize| s.turns.cosine[k];
    let (rigidity, error) = rigidity(&sums, far(&sums), tilt, true, monomers.rise_nm);
    let um = 1e-3 / (BOLTZMANN_PN_NM_PER_K * ROOM);
    Ok((um * rigidity, um * error))
}
