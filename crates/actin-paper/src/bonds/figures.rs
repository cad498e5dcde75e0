//! The paper's figures for drawn and for weighted bonds: all monomers the cantilever of Figure 4, the
//! filaments on linkers of Figures 5 and 6, the turned one of Figure 7 and the buckled one of Figure 8;
//! with 140 nm of rod the buckled one of Figure 10. Figure 9 draws Tables 3 and 5 (`study.rs`).

use super::Effort;
use super::page::Listing;
use super::study::bar;
use super::tables::spread;
use super::variant::{Variant, compared};
use crate::run::{run_to_end, scenario};
use actin_mechanics::State;
use actin_sim::shape::profile;
use actin_sim::{
    Assembly, Equilibrium, Hold, Load, Record, Scene, Section, Setting, Summary, Task,
};
use rayon::prelude::*;

/// Samplings of drawn bonds at most: buckling takes seconds.
const SAMPLINGS: u64 = 8;
/// Force at the tip of Figure 4, and a small one (pN).
const TIP_PN: [f64; 2] = [2.0, 0.1];
/// Length of the buckled filament (nm), which clamps on monomers shorten by 10 nm.
const BUCKLED_NM: f64 = 290.0;

/// One filament of one sampling: an observable of each scene.
type Observed = Vec<f64>;

const HEADER: [&str; 16] = [
    "bonds, shortest",
    "fig4 tip at 2 pN (nm)",
    "fig4 tip at 0.1 pN (nm)",
    "fig5 energy (pN nm)",
    "fig5 middle (nm)",
    "fig6 energy (pN nm)",
    "fig7 ratio of halves",
    "fig7 energy (pN nm)",
    "fig8 +180 height (nm)",
    "fig8 +180 couple (pN nm)",
    "fig8 -180 height (nm)",
    "fig8 -180 couple (pN nm)",
    "fig10 +180 height (nm)",
    "fig10 +180 couple (pN nm)",
    "fig10 -180 height (nm)",
    "fig10 -180 couple (pN nm)",
];

/// The observables of all variants, mean and standard deviation over samplings.
pub(super) fn table(effort: Effort) -> Result<Listing, String> {
    let variants = compared();
    let samplings = |variant: &Variant| {
        let few = if variant.monomers.lateral_bonds > 64 {
            2
        } else {
            SAMPLINGS
        };
        variant.seeds(few.min(effort.samplings))
    };
    let bar = bar(variants.iter().map(|v| samplings(v).len()).sum());
    let mut rows = Vec::new();
    for variant in &variants {
        let all: Vec<Observed> = samplings(variant)
            .into_par_iter()
            .map(|seed| {
                let observed = observe(variant, seed);
                bar.inc(1);
                observed.map_err(|e| format!("{}, seed {seed}: {e}", variant.bonds()))
            })
            .collect::<Result<_, _>>()?;
        let shortest = variant.monomers.min_bond_nm;
        let mut row = vec![format!("{}, {shortest:.1} nm", variant.bonds())];
        row.extend((0..HEADER.len() - 1).map(|i| {
            let (mean, sd) = spread(all.iter().map(|observed| observed[i]));
            let digits = if mean < 10.0 { 3 } else { 2 };
            if all.len() > 1 {
                format!("{mean:.digits$} (sd {sd:.digits$})")
            } else {
                format!("{mean:.digits$}")
            }
        }));
        rows.push(row);
    }
    bar.finish_and_clear();
    let header = HEADER.to_vec();
    Ok(Listing { header, rows })
}

fn observe(variant: &Variant, seed: u64) -> Result<Observed, String> {
    let mut observed = Vec::new();
    for force in TIP_PN {
        observed.push(tip(variant, seed, force)?);
    }
    let planar = on_linkers("figure-5/linkers.ron", 160.0, variant, seed)?;
    observed.extend(planar);
    let [energy, _] = on_linkers("figure-6/linkers.ron", 210.0, variant, seed)?;
    observed.push(energy);
    observed.extend(halves(variant, seed)?);
    for sense in [1.0, -1.0] {
        observed.extend(buckled(all_monomers(variant, seed)?, sense)?);
    }
    for sense in [1.0, -1.0] {
        let scene = scene("figure-10/rod-140.ron", variant, seed)?;
        observed.extend(buckled(scene, sense)?);
    }
    Ok(observed)
}

/// A scene of the paper with the monomers of a sampling.
fn scene(file: &str, variant: &Variant, seed: u64) -> Result<Scene, String> {
    let mut scene = scenario(file)?;
    scene.filament.monomers = variant.sampling(seed);
    Ok(scene)
}

/// What a run ends with.
fn solved(assembly: &mut Assembly) -> Result<(Summary, Record), String> {
    let (mut trajectory, report) = run_to_end(assembly).map_err(|e| e.to_string())?;
    let last = trajectory.records.pop().ok_or("no record")?;
    Ok((Summary::new(assembly, &last, &report), last))
}

/// Deflection of the cantilever (nm).
fn tip(variant: &Variant, seed: u64, force: f64) -> Result<f64, String> {
    let mut scene = scene("figure-4/ellipsoids.ron", variant, seed)?;
    for load in &mut scene.loads {
        let Load::EndForce { force_pn, .. } = load else {
            continue;
        };
        let size = force_pn.iter().map(|f| f * f).sum::<f64>().sqrt();
        *force_pn = force_pn.map(|f| f * force / size);
    }
    scene.task = Task::Equilibrium(Equilibrium::default());
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let (summary, _) = solved(&mut assembly)?;
    let [x, y, _] = summary.tip_displacement_nm;
    Ok(x.hypot(y))
}

/// Ratio and sum of the energies of both halves (over-twisted over under-twisted; pN nm).
fn halves(variant: &Variant, seed: u64) -> Result<[f64; 2], String> {
    let scene = scene("figure-7/ellipsoids.ron", variant, seed)?;
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let (_, last) = solved(&mut assembly)?;
    let points = profile(&assembly, &last.state);
    let middle = 0.5 * assembly.length_nm();
    let mut energies = [0.0; 2];
    for point in &points {
        energies[usize::from(point.s_nm > middle)] += point.energy_per_length_pn;
    }
    // The linker pulls the middle against the turn of the helix: the first half is over-twisted.
    let [over, under] = energies;
    let energy = (over + under) * variant.monomers.rise_nm;
    Ok([over / under, energy])
}

/// Energy of a free filament and its linkers (pN nm), the least of those from four turns about the
/// axis, and how far its middle has moved (nm).
fn on_linkers(
    file: &str,
    length_nm: f64,
    variant: &Variant,
    seed: u64,
) -> Result<[f64; 2], String> {
    let mut scene = scene(file, variant, seed)?;
    scene.filament.sections = vec![Section::Ellipsoids {
        from_nm: 0.0,
        to_nm: length_nm,
        altered: None,
    }]
    .into();
    scene.task = Task::Equilibrium(Equilibrium::default());
    let mut found = Vec::new();
    for turn in [0.0_f64, 90.0, 180.0, 270.0] {
        let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
        assembly.roll(turn.to_radians());
        let (summary, record) = solved(&mut assembly)?;
        let middle = assembly.points.len() / 2;
        let position = |state: &State| state.points.position.get(middle);
        let moved = position(&record.state) - position(&assembly.rest);
        found.push([summary.energy_pn_nm.total, moved.norm()]);
    }
    let least = found.into_iter().min_by(|a, b| a[0].total_cmp(&b[0]));
    least.ok_or_else(|| "no start".into())
}

/// The filament of Figure 8, all monomers.
fn all_monomers(variant: &Variant, seed: u64) -> Result<Scene, String> {
    let mut scene = scene("figure-8/rod-140.ron", variant, seed)?;
    scene.filament.sections = vec![Section::Ellipsoids {
        from_nm: 0.0,
        to_nm: BUCKLED_NM,
        altered: None,
    }]
    .into();
    for clamp in &mut scene.clamps {
        clamp.hold = Hold::Wall;
    }
    for linker in &mut scene.linkers {
        linker.at_nm = 0.5 * BUCKLED_NM;
    }
    Ok(scene)
}

/// Largest distance from the axis (nm) and couple at the end (pN nm).
fn buckled(mut scene: Scene, sense: f64) -> Result<[f64; 2], String> {
    for setting in scene.path.iter_mut().flat_map(|stage| &mut stage.set) {
        if let Setting::Turn { turn_deg, .. } = setting {
            *turn_deg = turn_deg.map(|angle| sense * angle);
        }
    }
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let (summary, _) = solved(&mut assembly)?;
    let couple = summary
        .end_reactions
        .end
        .map_or(f64::NAN, |r| r.torque_pn_nm[2]);
    Ok([summary.shape.largest_distance_nm, couple.abs()])
}
