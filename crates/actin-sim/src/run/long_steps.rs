//! How long steps of rods and quasi-harmonic monomers in thermal overdamped motion may be: what sets them is what is
//! looked at and what changes, not how fast stretch and shear relax.

use crate::Assembly;
use crate::assembly::COARSEST;
use crate::scene::{Brownian as Task, Filament, Resultant, SceneProblem, Setting};

/// Steps in the time that a stage, a ramp, a period or an interval of a table takes: what follows half a step late is late by
/// half a hundredth of it.
const PER_CHANGE: f64 = 100.0;

/// By how much (relative) loads may leave too little slack.
const TOO_COLD: f64 = 0.01;

/// Lengths of filament whose bending is followed where monomers are finer, in one filament.
const FOLLOWED: f64 = 5.0;

/// The longest of them (nm).
const LONGEST_FOLLOWED_NM: f64 = 40.0;

/// Steps between two records of a motion without heat. The first record has the largest error, 5.4e-5 of the displacement
/// with a hundred records and below 1e-3 with ten (`docs/measured/motion.md`).
const PER_RECORD: f64 = 20.0;

/// Records of a motion whose scene does not say how many.
const RECORDS: f64 = 100.0;

/// The longest step (ns) of rods and monomers at a temperature that shows bending to 1 % (`actin_brownian::Brownian`) and
/// whatever changes, or without heat that shows displacements to 0.1 %; none of contact, or of bonds in heat.
pub(super) fn longest(assembly: &Assembly, task: &Task) -> Result<Option<f64>, SceneProblem> {
    let is_athermal = task.temperature_k == 0.0;
    let has_bonds = assembly.counts().bonds > 0;
    if assembly.scene.repulsion.is_some() || (has_bonds && !is_athermal) {
        return Ok(None);
    }
    let motion = task.as_motion();
    let records = motion
        .record_every_ns
        .unwrap_or(motion.duration_ns / RECORDS);
    let mut longest = records.min(task.flow.longest_step());
    if is_athermal {
        longest /= PER_RECORD;
    }
    let changes = of_changes(assembly).into_iter();
    let changes = changes.map(|time| time / PER_CHANGE);
    longest = changes.chain(of_rates(assembly)).fold(longest, f64::min);
    if is_athermal {
        return Ok(Some(longest));
    }
    for rod in &assembly.rods {
        let lengths = rod.layout.segment_lengths().iter().copied();
        let shortest = lengths.fold(f64::INFINITY, f64::min);
        longest = longest.min(of_length(assembly, task, (rod.section, shortest))?);
    }
    let sections = assembly.sections.iter().enumerate();
    for (section, _) in sections.filter(|(_, span)| span.is_ellipsoids()) {
        let filament = assembly
            .scene
            .filament_at(assembly.filament_of_section(section));
        let whole = filament.map_or(f64::INFINITY, Filament::length_nm);
        let followed = (whole / FOLLOWED).min(LONGEST_FOLLOWED_NM);
        longest = longest.min(of_length(assembly, task, (section, followed))?);
    }
    Ok(Some(longest))
}

/// `zeta l^4/B`, the time in which friction `zeta` of a `length` `l` of a section bends it. A tension `F` has no random
/// stress: in steps of `h` waves are too cold under it, and slack is too small by `h F^(3/2)/(zeta l B^(1/2))`, or less where that
/// is more than a tenth (measured beside the exact chain in `actin-brownian`, `tests/chain.rs`).
fn of_length(
    assembly: &Assembly,
    task: &Task,
    (section, length): (usize, f64),
) -> Result<f64, SceneProblem> {
    let filament = assembly.filament_of_section(section);
    let across = assembly.cylinder(&task.drag, filament)?.across();
    let first = assembly.filaments[filament].sections.start;
    let written = assembly.scene.filament_at(filament);
    let Some(model) = written.map(|f| f.sections[section - first].rod_model(&f.rod)) else {
        return Ok(f64::INFINITY);
    };
    let bend = model.material.rigidities().bend;
    let bend = bend.x.min(bend.y);
    let force = tension(assembly, filament, length);
    let of_loads = TOO_COLD * across * length * bend.sqrt() / force.powf(1.5);
    Ok(of_loads.min(across * length.powi(4) / bend))
}

/// At most what loads pull a filament with (pN); couples pull segments of `length` aside.
fn tension(assembly: &Assembly, filament: usize, length: f64) -> f64 {
    let scene = &assembly.scene;
    let loads = scene.loads.iter().enumerate();
    let of_filament = loads.filter(|(_, load)| load.filament() == filament);
    of_filament
        .map(|(i, load)| {
            let force = match load.resultant(scene) {
                Resultant::Force(force) => force.norm(),
                Resultant::Couple(couple) => couple.norm() / length,
            };
            let settings = scene.path.iter().flat_map(|stage| &stage.set);
            let factors = settings.filter_map(|setting| match *setting {
                Setting::LoadFactor { load, factor } if load == i => Some(factor.abs()),
                _ => None,
            });
            let of_path = factors.reduce(f64::max).unwrap_or(1.0);
            force * of_path * load.factor().largest()
        })
        .sum()
}

/// Times in which stages and loads change (ns).
fn of_changes(assembly: &Assembly) -> Vec<f64> {
    let scene = &assembly.scene;
    let stages = scene.path.iter().filter_map(|stage| stage.duration_ns);
    let loads = scene
        .loads
        .iter()
        .filter_map(|load| load.factor().shortest());
    stages.chain(loads).collect()
}

/// What rates allow (ns).
fn of_rates(assembly: &Assembly) -> Vec<f64> {
    let linkers = assembly.scene.linkers.iter();
    let rates = linkers.filter_map(|linker| Some(linker.kinetics.as_ref()?.rates()));
    rates.flatten().map(|(_, rate)| COARSEST / rate).collect()
}
