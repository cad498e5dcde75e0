//! Default steps of thermal overdamped motion of rods and quasi-harmonic monomers. Records and
//! changes in time limit the step, not the relaxation of stretch and shear.

use super::spins;
use crate::scene::{Brownian as Task, Resultant, RodLaw, SceneProblem, Setting};
use crate::{Assembly, Resolution};
use actin_assembly::{COARSE_IN_HEAT, COARSEST};

/// Steps per stage, ramp, period or table interval. Driven motion is delayed by half a step, 0.5 %
/// of that time.
const PER_CHANGE: f64 = 100.0;

/// Largest relative error of slack under loads.
const TOO_COLD: f64 = 0.01;

/// Mean overshoot of a random walk over a distant threshold, in units of the standard deviation of its steps.
const OVERSHOOT: f64 = 0.582_6;

/// Number of wavelengths per filament whose bending is resolved, for monomers.
const FOLLOWED: f64 = 5.0;

/// Longest resolved wavelength (nm).
const LONGEST_FOLLOWED_NM: f64 = 40.0;

/// Steps between two records of a motion without heat. The first record has the largest error:
/// 5.4e-5 of the displacement with a hundred records and below 1e-3 with ten
/// (`docs/measured/motion.md`).
const PER_RECORD: f64 = 20.0;

const RECORDS: f64 = 100.0;

/// Default step (ns). At finite temperature it resolves bending to 1 % (`actin_brownian::Brownian`)
/// and all prescribed changes; without heat it resolves displacements to 0.1 %. `None` with
/// contact, or for bonds with heat.
pub(super) fn longest(assembly: &Assembly, task: &Task) -> Result<Option<f64>, SceneProblem> {
    let is_athermal = task.temperature_k == 0.0;
    let has_bonds = assembly.counts().bonds > 0;
    let has_contacts = assembly.scene.repulsion.is_some();
    if (has_contacts && is_athermal) || (has_bonds && !is_athermal) {
        return Ok(None);
    }
    let motion = task.to_dynamics();
    let records = motion
        .record_every_ns
        .unwrap_or(motion.duration_ns / RECORDS);
    let mut longest = records.min(task.flow.longest_step());
    if is_athermal {
        longest /= PER_RECORD;
    }
    let changes = assembly.scene.times_of_change();
    let changes = changes.map(|time| time / PER_CHANGE);
    longest = changes.chain(of_rates(assembly)).fold(longest, f64::min);
    let Some(thermal) = motion.thermal else {
        return Ok(Some(longest));
    };
    let kt = thermal.energy_pn_nm();
    longest = longest.min(spins::longest_step(assembly, task, kt)?);
    for (section, span) in assembly.sections.iter().enumerate() {
        let followed = match span.resolution {
            Resolution::Rod { segment_nm } => segment_nm,
            Resolution::Ellipsoids { .. } => {
                let filament = assembly.filament_of_section(section);
                let whole = assembly.written(filament).length_nm();
                (whole / FOLLOWED).min(LONGEST_FOLLOWED_NM)
            }
        };
        longest = longest.min(of_length((assembly, task), (section, followed), kt)?);
    }
    Ok(Some(longest))
}

/// Relaxation time of bending over a length, limited by the tension.
///
/// ```text
/// h <= zeta l^4 / B                        zeta (pN ns/nm^2) transverse friction per length, l (nm), B (pN nm^2)
/// relative error of slack = h F^(3/2) / (zeta l B^(1/2)),   F (pN) tension
/// ```
///
/// Tension has no random stress, so that steps leave waves under tension too cold. The error was
/// measured against the exact chain in `actin-brownian`, `tests/chain.rs`. It is smaller than the
/// formula above a tenth.
///
/// Segments above [`COARSE_IN_HEAT`] bend so far that iterations for laws that couple strains fail: of 12 segments at ratios
/// of 0.04 and 0.1 in 3 and 50 % of the steps, in 0.1 and 0.2 % of steps shorter by the square of the ratio.
fn of_length(
    (assembly, task): (&Assembly, &Task),
    (section, length): (usize, f64),
    kt: f64,
) -> Result<f64, SceneProblem> {
    let filament = assembly.filament_of_section(section);
    let across = assembly.cylinder(&task.drag, filament)?.across();
    let model = assembly.rod_model_of(section);
    let bend = model.material.rigidities().bend;
    let bend = bend.x.min(bend.y);
    let force = tension(assembly, filament, length);
    let of_loads = TOO_COLD * across * length * bend.sqrt() / force.powf(1.5);
    let mut of_bending = across * length.powi(4) / bend;
    if model.law != RodLaw::Constant {
        let ratio = assembly.segment_over_persistence_length(section, kt);
        let excess = ratio.map_or(1.0, |ratio| (ratio / COARSE_IN_HEAT).max(1.0));
        of_bending /= excess.powi(2);
    }
    Ok(of_loads.min(of_bending))
}

/// Upper bound of the tension of a filament (pN). Couples act through a lever arm of `length`.
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

/// Distance (nm) by which walls act as if they were farther away in steps of `h` (ns); `None` without contacts or heat.
///
/// Contacts have no random stress. A step towards a wall therefore ends at the wall, as in a random walk that stops there.
/// Its positions have the distribution for a wall farther away, by 0.58 standard deviations of a step. A piece that is stiff
/// within a step moves with this standard deviation, less at its middle and more at its ends. Relative motion of two
/// filaments has a factor of `sqrt(2)`.
///
/// Measured: a free filament of 200 nm in two segments between walls 300 nm apart, from the mean square position of its
/// centre; and two that cross, held together by a linker, from the time in contact (45 % in steps of 5 us):
///
/// | | step (us) | measured (nm) | this formula |
/// | --- | --- | --- | --- |
/// | walls | 1 | 2.5 +- 1.0 | 3.2 |
/// | | 2.5 | 7.0 +- 1.2 | 5.1 |
/// | | 6.8 | 9.9 +- 0.9 | 8.4 |
/// | filaments | 0.05 | 0.9 | 1.8 |
/// | | 0.5 | 4.9 | 4.5 |
/// | | 5 | 12.5 | 10.6 |
///
/// # Source
/// D. Siegmund, Adv. Appl. Probab. 11 (1979) 701.
pub(super) fn approach_of_contacts(
    assembly: &Assembly,
    task: &Task,
    h: f64,
) -> Result<Option<f64>, SceneProblem> {
    let Some(thermal) = task
        .thermal()
        .filter(|_| assembly.scene.repulsion.is_some())
    else {
        return Ok(None);
    };
    let mut largest = 0.0_f64;
    for (filament, spans) in assembly.filaments.iter().enumerate() {
        let across = assembly.cylinder(&task.drag, filament)?.across();
        let rigidities = assembly
            .rod_model_of(spans.sections.start)
            .material
            .rigidities();
        let bend = rigidities.bend.x.min(rigidities.bend.y);
        let stiff = 2.0 * (bend * h / across).powf(0.25);
        let friction = across * stiff.min(assembly.length_of(filament));
        largest = largest.max((4.0 * thermal.energy_pn_nm() * h / friction).sqrt());
    }
    Ok(Some(OVERSHOOT * largest))
}

/// Largest steps that rates allow (ns).
fn of_rates(assembly: &Assembly) -> Vec<f64> {
    let linkers = assembly.scene.linkers.iter();
    let rates = linkers.filter_map(|linker| Some(linker.kinetics.as_ref()?.rates()));
    rates.flatten().map(|(_, rate)| COARSEST / rate).collect()
}
