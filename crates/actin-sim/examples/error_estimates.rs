//! Estimated errors beside true ones: scenes of the trade study and others in several resolutions, each against the
//! same filament with every monomer resolved; then resolutions that are chosen for a wanted error.
//!
//! `cargo run --release -p actin-sim --example error_estimates [name of a case]`
//!
//! Errors in per cent of the value with every monomer. The last column is the time of the estimate over that of the
//! equilibrium of all monomers.

use actin_sim::adapt::estimate;
use actin_sim::{Adaptive, Assembly, Plan, Quantity, RodLaw, Scene, Section, Want};
use std::time::Instant;

/// A scene of which a number is wanted, and the stretches of monomers that it is tried with (nm).
struct Case {
    name: &'static str,
    scene: Scene,
    quantity: Quantity,
    stretches: Vec<Vec<[f64; 2]>>,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wanted = std::env::args().nth(1);
    println!(
        "| case | resolution | true | estimated | law | segments | junctions | walls | time |"
    );
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    for case in cases()?
        .into_iter()
        .filter(|c| wanted.as_ref().is_none_or(|w| w == c.name))
    {
        let length = length_of(&case.scene);
        let (fine, seconds) = solved(&case.scene)?;
        let truth = value(&fine, case.quantity)?;
        for law in [RodLaw::Homogenised, RodLaw::Fitted, RodLaw::Constant] {
            compare(&case, (&law, &[]), length, (truth, seconds))?;
        }
        for stretches in &case.stretches {
            compare(
                &case,
                (&RodLaw::Homogenised, stretches),
                length,
                (truth, seconds),
            )?;
        }
        for error in [0.05, 0.02, 0.01] {
            choose(&case, (error, None), length, (truth, seconds))?;
        }
        for most in [26, 104] {
            choose(&case, (0.001, Some(most)), length, (truth, seconds))?;
        }
    }
    Ok(())
}

/// One row: a resolution, its true and its estimated error.
fn compare(
    case: &Case,
    (law, stretches): (&RodLaw, &[[f64; 2]]),
    length: f64,
    (truth, seconds): (f64, f64),
) -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = case.scene.clone();
    scene.filament.sections = sections(length, stretches).into();
    scene.filament.rod.law = law.clone();
    let (assembly, _) = solved(&scene)?;
    let start = Instant::now();
    let found = estimate(&assembly, assembly.system.state(), case.quantity)?;
    let took = start.elapsed().as_secs_f64() / seconds;
    let percent = |part: f64| format!("{:.2}", 100.0 * part / truth);
    println!(
        "| {} | {}, `{law:?}` | {} | {} | {} | {} | {} | {} | {took:.1} |",
        case.name,
        words(stretches),
        percent(truth - found.value),
        percent(found.error),
        percent(found.law),
        percent(found.segments),
        percent(found.junctions),
        percent(found.walls),
    );
    Ok(())
}

/// One row: the resolution that is chosen for an error, and what it is off by.
fn choose(
    case: &Case,
    (error, monomers): (f64, Option<usize>),
    length: f64,
    (truth, seconds): (f64, f64),
) -> Result<(), Box<dyn std::error::Error>> {
    let want = match case.quantity {
        Quantity::Tip => Want::Tip { error },
        Quantity::Height => Want::Height { error },
        Quantity::EndForce => Want::EndForce { error },
        Quantity::EndCouple => Want::EndCouple { error },
        Quantity::Energy => Want::Energy { error },
        Quantity::LinkerForce { linker } => Want::LinkerForce { linker, error },
    };
    let mut scene = case.scene.clone();
    scene.filament.sections = Adaptive {
        length_nm: length,
        want,
        monomers,
    }
    .into();
    let assembly = Assembly::build(&scene)?;
    let chosen = assembly.chosen.clone().ok_or("nothing was chosen")?;
    let (assembly, own) = solved(&assembly.scene)?;
    let off = 100.0 * (truth - value(&assembly, case.quantity)?) / truth;
    let estimated = chosen.estimate.map_or(0.0, |e| 100.0 * e.error / truth);
    let stretches = chosen.monomers_nm.iter();
    let share = stretches.fold(0.0, |sum, [from, to]| sum + to - from);
    let limit = monomers.map_or_else(String::new, |most| format!(", {most} monomers"));
    println!(
        "| {} | **{} %{limit}**: {}, {:.0} % monomers, segments of {:.0} nm, {} tried | {off:.2} | {estimated:.2} | | | | | {:.1} |",
        case.name,
        100.0 * error,
        words(&chosen.monomers_nm),
        100.0 * share / length,
        chosen.segment_nm,
        chosen.tried.len(),
        (chosen.wall_s + own) / seconds,
    );
    Ok(())
}

fn solved(scene: &Scene) -> Result<(Assembly, f64), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let mut assembly = Assembly::build(scene)?;
    let (trajectory, _) = Plan::new(&assembly)?.run()?;
    let last = trajectory.records.last().ok_or("no record")?;
    *assembly.system.state_mut() = last.state.clone();
    Ok((assembly, start.elapsed().as_secs_f64()))
}

fn value(assembly: &Assembly, quantity: Quantity) -> Result<f64, Box<dyn std::error::Error>> {
    Ok(estimate(assembly, assembly.system.state(), quantity)?.value)
}

fn length_of(scene: &Scene) -> f64 {
    let sections = scene.filament.sections.last();
    sections.map_or(0.0, |section| section.span_nm().1)
}

/// Monomers in these stretches, the rest rods of 10 nm segments.
fn sections(length: f64, stretches: &[[f64; 2]]) -> Vec<Section> {
    let mut all = Vec::new();
    let mut at = 0.0;
    for &[from_nm, to_nm] in stretches.iter().chain(&[[length, length]]) {
        if from_nm > at {
            all.push(Section::rod(at, from_nm, None));
        }
        if to_nm > from_nm {
            all.push(Section::Ellipsoids {
                from_nm,
                to_nm,
                altered: None,
            });
        }
        at = to_nm;
    }
    all
}

fn words(stretches: &[[f64; 2]]) -> String {
    let one = |[from, to]: &[f64; 2]| format!("{from:.0} to {to:.0} nm");
    match stretches {
        [] => "rod".to_owned(),
        all => all.iter().map(one).collect::<Vec<_>>().join(", "),
    }
}

/// Rise per monomer (nm).
const RISE_NM: f64 = 71.2 / 26.0;

/// Stretches of monomers that a scene is tried with (nm); none for the rod alone.
type Stretches = &'static [[f64; 2]];

/// Scenes of the trade study, by file.
const MEASURED: [(&str, &str, Quantity, &[Stretches]); 15] = {
    use Quantity::{EndCouple, EndForce, Energy, Height, LinkerForce, Tip};
    [
        (
            "tip, 160 nm",
            "cantilever-160",
            Tip,
            &[&[[0.0, 40.0]], &[[60.0, 100.0]]],
        ),
        (
            "tip, 1600 nm",
            "cantilever-1600",
            Tip,
            &[&[[0.0, 40.0]], &[[800.0, 1000.0]]],
        ),
        ("couple of a twist", "twist", EndCouple, &[]),
        (
            "force, linker in the middle",
            "mid-linker",
            EndForce,
            &[&[[67.0, 107.0]]],
        ),
        (
            "height, buckled over",
            "buckling-over",
            Height,
            &[&[[100.0, 200.0]]],
        ),
        (
            "couple, buckled over",
            "buckling-over",
            EndCouple,
            &[&[[100.0, 200.0]]],
        ),
        (
            "force, buckled over",
            "buckling-over",
            EndForce,
            &[&[[100.0, 200.0]]],
        ),
        ("height, buckled under", "buckling-under", Height, &[]),
        ("couple, buckled under", "buckling-under", EndCouple, &[]),
        ("force, buckled under", "buckling-under", EndForce, &[]),
        (
            "energy, 160 nm",
            "cantilever-160",
            Energy,
            &[&[[0.0, 40.0]], &[[60.0, 100.0]]],
        ),
        (
            "energy, 1600 nm",
            "cantilever-1600",
            Energy,
            &[&[[0.0, 40.0]]],
        ),
        ("energy of a twist", "twist", Energy, &[]),
        (
            "energy, buckled over",
            "buckling-over",
            Energy,
            &[&[[100.0, 200.0]]],
        ),
        (
            "pull of the linker in the middle",
            "mid-linker",
            LinkerForce { linker: 0 },
            &[&[[67.0, 107.0]]],
        ),
    ]
};

/// Held at its start, and pulled aside near its end and halfway.
const TWO_LINKERS: &str = "clamps: [Clamp(end: Start)],
    linkers: [
        Linker(at_nm: 150.0, displaced_nm: (30.0, 0.0, 0.0), stiffness_pn_per_nm: 0.1),
        Linker(at_nm: 80.0, displaced_nm: (-10.0, 0.0, 0.0), stiffness_pn_per_nm: 0.1),
    ]";

/// Others: the length in rises, and what holds and loads it.
const OTHERS: [(&str, f64, &str, Quantity); 9] = {
    use Quantity::{EndCouple, EndForce, Energy, LinkerForce, Tip};
    [
        (
            "tip under tension, 300 nm",
            109.5,
            "clamps: [Clamp(end: Start)], loads: [EndForce(end: End, force_pn: (-0.5, 0.0, 5.0))]",
            Tip,
        ),
        (
            "tip under weight, 800 nm",
            291.5,
            "clamps: [Clamp(end: Start)],
            loads: [ForcePerLength(to_nm: 790.0, force_pn_per_nm: (0.0002, 0.0, 0.0))]",
            Tip,
        ),
        (
            "couple of a clamped beam, 250 nm",
            91.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Turn(end: End, turn_deg: (20.0, 0.0, 45.0))])]",
            EndCouple,
        ),
        (
            "force of a stretch, 200 nm",
            73.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Shift(end: End, shift_nm: (5.0, 0.0, 0.5))])]",
            EndForce,
        ),
        (
            "tip, 16000 nm",
            5842.5,
            "clamps: [Clamp(end: Start)], loads: [EndForce(end: End, force_pn: (-0.0002, 0.0, 0.0))]",
            Tip,
        ),
        (
            "energy of a stretch, 200 nm",
            73.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            path: [Stage(set: [Shift(end: End, shift_nm: (5.0, 0.0, 0.5))])]",
            Energy,
        ),
        (
            "pull near the end, 160 nm",
            58.5,
            TWO_LINKERS,
            LinkerForce { linker: 0 },
        ),
        (
            "pull halfway, 160 nm",
            58.5,
            TWO_LINKERS,
            LinkerForce { linker: 1 },
        ),
        (
            "pull between two ends, 200 nm",
            73.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            linkers: [Linker(at_nm: 99.9, displaced_nm: (10.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)]",
            LinkerForce { linker: 0 },
        ),
    ]
};

fn cases() -> Result<Vec<Case>, Box<dyn std::error::Error>> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/advice/scenes");
    let mut cases = Vec::new();
    for (name, file, quantity, stretches) in MEASURED {
        let text = std::fs::read_to_string(format!("{folder}/{file}.ron"))?;
        cases.push(Case {
            name,
            scene: Scene::from_ron(&text)?,
            quantity,
            stretches: stretches.iter().map(|s| s.to_vec()).collect(),
        });
    }
    for (name, rises, rest, quantity) in OTHERS {
        let sections = format!("[Ellipsoids(from_nm: 0.0, to_nm: {:?})]", rises * RISE_NM);
        let text =
            format!("Scene(filament: Filament(sections: {sections}), {rest}, task: Equilibrium())");
        cases.push(Case {
            name,
            scene: Scene::from_ron(&text)?,
            quantity,
            stretches: Vec::new(),
        });
    }
    Ok(cases)
}
