//! Scenes that grow in one way each: what takes the square of a size shows in its exponent.

use std::fmt::Write as _;

/// A way to grow, and the sizes that are measured, a decade apart.
pub(super) struct Family {
    /// Its name.
    pub(super) name: &'static str,
    /// What is counted by its size.
    pub(super) counted: &'static str,
    /// Sizes; those beyond the largest that is asked for are left out.
    pub(super) sizes: &'static [usize],
    scene: fn(usize) -> Parts,
}

impl Family {
    /// The text of its scene of a size.
    pub(super) fn text(&self, size: usize) -> String {
        (self.scene)(size).text()
    }
}

/// All families.
pub(super) const FAMILIES: [Family; 15] = [
    family(
        "rod-motion",
        "segments",
        &[10_000, 100_000, 1_000_000],
        |n| cantilever(&rod(n), "Constant", MOTION),
    ),
    family("rod-law-motion", "segments", &[10_000, 100_000], |n| {
        cantilever(&rod(n), "Fitted", MOTION)
    }),
    family("rod-statics", "segments", &[1_000, 10_000, 100_000], |n| {
        pulled(&rod(n))
    }),
    family("rod-bent-statics", "segments", &[100, 1_000, 3_000], |n| {
        cantilever(&rod(n), "Constant", STATICS)
    }),
    family("monomers-motion", "monomers", &[300, 3_000, 30_000], |n| {
        cantilever(&monomers(n), "Constant", MOTION)
    }),
    family("monomers-statics", "monomers", &[60, 600, 5_842], |n| {
        cantilever(&monomers(n), "Constant", STATICS)
    }),
    family("rods-motion", "filaments", &[100, 1_000, 10_000], |n| {
        many(n, SHORT_ROD, true, MOTION)
    }),
    family("rods-statics", "filaments", &[100, 1_000, 10_000], |n| {
        many(n, SHORT_ROD, true, STATICS)
    }),
    family("pairs-motion", "filaments", &[100, 1_000], |n| {
        many(n, SHORT_PAIR, true, MOTION)
    }),
    family("pairs-statics", "filaments", &[100, 1_000], |n| {
        many(n, SHORT_PAIR, true, STATICS)
    }),
    family("turned-statics", "filaments", &[100, 1_000], turned),
    family("linkers-statics", "linkers", &[1_000, 10_000], linkers),
    family("ladder-statics", "filaments", &[300, 3_000], ladder),
    family("stages-motion", "stages", &[1_000, 10_000], |n| {
        stages(
            n,
            &format!(
                "Dynamics(duration_ns: {:?}, record_every_ns: 1e3)",
                n as f64 * 1.01e-4
            ),
        )
    }),
    family("stages-statics", "stages", &[100, 1_000], |n| {
        stages(n, STATICS)
    }),
];

const fn family(
    name: &'static str,
    counted: &'static str,
    sizes: &'static [usize],
    scene: fn(usize) -> Parts,
) -> Family {
    Family {
        name,
        counted,
        sizes,
        scene,
    }
}

/// Some hundred steps, recorded at both ends.
const MOTION: &str = "Dynamics(duration_ns: 0.05, record_every_ns: 0.05)";
const STATICS: &str = "Equilibrium()";
const SHORT_ROD: &str = "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)";
const SHORT_PAIR: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 20.0), Rod(from_nm: 20.0, to_nm: 60.0, segments: 4)";
/// Rise of a monomer (nm).
const RISE_NM: f64 = 71.2 / 26.0;

/// What a scene is written of.
#[derive(Default)]
struct Parts {
    filaments: String,
    clamps: String,
    loads: String,
    linkers: String,
    path: String,
    task: String,
}

impl Parts {
    fn text(&self) -> String {
        let Self {
            filaments,
            clamps,
            loads,
            linkers,
            path,
            task,
        } = self;
        format!(
            "Scene(filaments: [{filaments}], clamps: [{clamps}], loads: [{loads}], \
             linkers: [{linkers}], path: [{path}], task: {task})"
        )
    }

    /// Appends a filament of these sections at a place of its own.
    fn push(&mut self, i: usize, sections: &str) {
        let (x, y) = (20 * (i / 100), 20 * (i % 100));
        writeln!(
            self.filaments,
            "Filament(sections: [{sections}], at_nm: ({x}.0, {y}.0, 0.0), rod: RodModel(law: Constant)),"
        )
        .expect("a String takes any text");
    }

    /// Clamps an end of a filament.
    fn clamp(&mut self, i: usize, end: &str) {
        write!(self.clamps, "Clamp(filament: {i}, {end}), ").expect("a String takes any text");
    }
}

fn rod(segments: usize) -> (f64, String) {
    let length = 10.0 * segments as f64;
    let rod = format!("Rod(from_nm: 0.0, to_nm: {length:?}, segments: {segments})");
    (length, rod)
}

fn monomers(count: usize) -> (f64, String) {
    // A section of monomers ends half a rise beyond the last.
    let length = RISE_NM * (count as f64 - 0.5);
    (
        length,
        format!("Ellipsoids(from_nm: 0.0, to_nm: {length:?})"),
    )
}

/// On a wall, bent by the same angle whatever its length (2 pN across the tip of 160 nm).
fn cantilever((length, section): &(f64, String), law: &str, task: &str) -> Parts {
    let force = 2.0 * (160.0 / length).powi(2);
    Parts {
        filaments: format!("Filament(sections: [{section}], rod: RodModel(law: {law}))"),
        clamps: "Clamp(end: Start)".into(),
        loads: format!("EndForce(end: End, force_pn: ({force:?}, 0.0, 0.0))"),
        task: task.into(),
        ..Parts::default()
    }
}

/// On a wall and pulled along its axis: of any length the forces are larger than their rounding.
fn pulled((_, section): &(f64, String)) -> Parts {
    Parts {
        filaments: format!("Filament(sections: [{section}], rod: RodModel(law: Constant))"),
        clamps: "Clamp(end: Start)".into(),
        loads: "EndForce(end: End, force_pn: (0.0, 0.0, 1.0))".into(),
        task: STATICS.into(),
        ..Parts::default()
    }
}

/// Many filaments on a wall, each under a force across its tip if `loaded`.
fn many(count: usize, sections: &str, loaded: bool, task: &str) -> Parts {
    let mut parts = Parts {
        task: task.into(),
        ..Parts::default()
    };
    for i in 0..count {
        parts.push(i, sections);
        parts.clamp(i, "end: Start");
        if loaded {
            write!(
                parts.loads,
                "EndForce(filament: {i}, end: End, force_pn: (0.5, 0.0, 0.0)), "
            )
            .expect("a String takes any text");
        }
    }
    parts
}

/// Many filaments held at both ends and twisted.
fn turned(count: usize) -> Parts {
    let mut parts = many(count, SHORT_ROD, false, STATICS);
    let mut set = String::new();
    for i in 0..count {
        parts.clamp(i, "end: End, slides: AlongAxis");
        write!(
            set,
            "Turn(filament: {i}, end: End, turn_deg: (0.0, 0.0, 20.0)), "
        )
        .expect("a String takes any text");
    }
    parts.path = format!("Stage(set: [{set}])");
    parts
}

/// A linker to every segment of a rod.
fn linkers(count: usize) -> Parts {
    let (_, section) = rod(count);
    let mut parts = Parts {
        filaments: format!("Filament(sections: [{section}], rod: RodModel(law: Constant))"),
        clamps: "Clamp(end: Start)".into(),
        task: STATICS.into(),
        ..Parts::default()
    };
    for i in 0..count {
        let at = 10.0 * i as f64 + 5.0;
        writeln!(
            parts.linkers,
            "Linker(at_nm: {at:?}, displaced_nm: (0.0, 1.0, 0.0), stiffness_pn_per_nm: 1.0),"
        )
        .expect("a String takes any text");
    }
    parts
}

/// Filaments on a wall, each linked to the next.
fn ladder(count: usize) -> Parts {
    let mut parts = many(count, SHORT_ROD, false, STATICS);
    for i in 1..count {
        let before = i - 1;
        writeln!(
            parts.linkers,
            "Linker(filament: {before}, at_nm: 25.0, to: Site(filament: {i}, at_nm: 25.0), \
             stiffness_pn_per_nm: 1.0, rest_length_nm: 19.0),"
        )
        .expect("a String takes any text");
    }
    parts
}

/// A short rod whose load goes up and down.
fn stages(count: usize, task: &str) -> Parts {
    let mut parts = many(1, SHORT_ROD, true, task);
    for i in 0..count {
        let factor = (i % 7) as f64 / 7.0 + 0.1;
        writeln!(
            parts.path,
            "Stage(set: [LoadFactor(load: 0, factor: {factor:?})], duration_ns: 0.0001),"
        )
        .expect("a String takes any text");
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_sim::{Assembly, Scene};

    /// Each family is a scene of as many of what it counts as its size says.
    #[test]
    fn families_grow_by_what_they_count() {
        for family in &FAMILIES {
            for size in [3, 6] {
                let scene = Scene::from_ron(&family.text(size));
                let scene = scene.unwrap_or_else(|error| panic!("{}: {error}", family.name));
                let assembly = Assembly::build(&scene).unwrap();
                let counts = assembly.counts();
                let found = match family.counted {
                    "segments" => counts.segments,
                    // The outer held monomer is outside of the filament's length.
                    "monomers" => counts.monomers - 2,
                    "filaments" => assembly.filaments.len(),
                    "linkers" => assembly.linkers.len(),
                    _ => assembly.drive.stages(),
                };
                assert_eq!(found, size, "{}", family.name);
            }
        }
    }
}
