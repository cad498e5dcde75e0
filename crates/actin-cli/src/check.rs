//! `actin check`: the resolved scene, its cost, and its run time estimated from its first steps.

use crate::SceneArguments;
use crate::failure::{BuiltScene, Failure};
use actin_sim::{Assembly, Estimate, RelaxationTimes, Resolution, SectionSpan, Task};

/// Validates a scene and prints it with all defaults, its counts and its cost.
///
/// Additional information is printed as RON comments, so that the output is a valid scene.
pub(crate) fn check(source: &SceneArguments) -> Result<(), Failure> {
    let opened = BuiltScene::open(source)?;
    let plan = opened.plan()?;
    let assembly = plan.assembly();
    println!("{}", plan.scene().to_ron());
    print_sections(assembly);
    print_counts(assembly);
    print_linkers(assembly);
    print_thermal(assembly, plan.estimate());
    if let Some(estimate) = plan.estimate() {
        match plan.relaxation_times() {
            Some(Ok(times)) => print_relaxation(&times),
            Some(Err(problem)) => println!("// {problem}"),
            None => {}
        }
        print_step(estimate);
    }
    for note in opened.notes(&plan) {
        println!("// {note}");
    }
    println!("// cost: {}", plan.cost());
    if let Some(timing) = plan.timing() {
        println!("// time: {timing}");
    }
    Ok(())
}

fn print_sections(assembly: &Assembly) {
    println!("// sections, on the lattice of monomers:");
    for filament in 0..assembly.filaments.len() {
        if assembly.filaments.len() > 1 {
            let span = &assembly.filaments[filament];
            let (from, along) = (place(span.origin_nm.into()), place(span.axis().into()));
            println!("//   filament {filament} from {from} nm along {along}:");
        }
        for section in assembly.sections_of(filament) {
            print_section(section);
        }
    }
}

fn print_section(section: &SectionSpan) {
    let what = match section.resolution {
        Resolution::Ellipsoids { bonds, .. } => {
            format!("{} monomers, {bonds} bonds", section.points.len())
        }
        Resolution::Rod { segment_nm } => {
            format!("{} segments of {segment_nm:.4} nm", section.frames.len())
        }
    };
    println!(
        "//   {:9.4} to {:9.4} nm: {what}",
        section.from_nm, section.to_nm
    );
}

fn place([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4})")
}

fn print_linkers(assembly: &Assembly) {
    let roams = |i: usize| assembly.scene.linkers[i].roams();
    let roaming = (0..assembly.linkers.len()).filter(|&i| roams(i)).count();
    if roaming > 0 {
        println!("// {roaming} crosslinkers, initially free");
    }
    let fixed = assembly
        .linkers
        .iter()
        .enumerate()
        .filter(|(i, _)| !roams(*i));
    for (i, linker) in fixed {
        let other = assembly.linked_to(i);
        println!(
            "// linker {i}: from {} nm on {} to {} nm{}",
            place(linker.site().position(&assembly.rest).into()),
            assembly.linked(i),
            place(linker.end_position(&assembly.rest).into()),
            other.map_or_else(String::new, |body| format!(" on {body}")),
        );
    }
}

fn print_counts(assembly: &Assembly) {
    let counts = assembly.counts();
    println!(
        "// counts: {} monomers, {} bonds, {} segments, {} junctions, {} degrees of freedom",
        counts.monomers, counts.bonds, counts.segments, counts.junctions, counts.dofs
    );
}

fn print_thermal(assembly: &Assembly, estimate: Option<&Estimate>) {
    let (Task::Dynamics(dynamics), Some(estimate)) = (&assembly.scene.task, estimate) else {
        return;
    };
    if let Some(thermal) = &dynamics.thermal {
        let energy = thermal.energy_pn_nm();
        println!(
            "// thermal energy {energy:.4} pN nm at {} K, mean kinetic energy {:.2} pN nm",
            thermal.temperature_k,
            0.5 * energy * assembly.counts().dofs as f64
        );
        println!(
            "// at this time step the positional temperature of the fastest mode is {:.4} times the set \
             temperature; slower modes deviate less",
            estimate.fastest_mode_temperature_ratio(dynamics)
        );
    }
}

fn print_step(estimate: &Estimate) {
    if estimate.stability_limit_ns.is_infinite() {
        let (step, steps, every) = (
            estimate.time_step_ns,
            estimate.steps,
            estimate.record_every_ns,
        );
        println!("// time step {step:.4e} ns, {steps} steps, a record every {every:.6} ns");
        return;
    }
    println!(
        "// largest frequency {:.2} rad/ns, stability limit {:.4e} ns, time step {:.4e} ns, at most \
         {} steps, a record every {:.6} ns",
        estimate.largest_frequency_rad_per_ns,
        estimate.stability_limit_ns,
        estimate.time_step_ns,
        estimate.steps,
        estimate.record_every_ns
    );
}

fn print_relaxation(times: &RelaxationTimes) {
    let slowest = times.slowest_ns.iter().take(5);
    let slowest: Vec<String> = slowest.map(|time| format!("{time:.4e}")).collect();
    let slowest = if slowest.is_empty() {
        "the slowest modes have zero stiffness".to_owned()
    } else {
        let (slowest, unresisted) = (slowest.join(", "), times.unresisted);
        format!("slowest {slowest} ns; {unresisted} zero-stiffness modes")
    };
    println!(
        "// relaxation times of small displacements from the initial state: fastest {:.4e} ns, {slowest}",
        times.fastest_ns
    );
}
