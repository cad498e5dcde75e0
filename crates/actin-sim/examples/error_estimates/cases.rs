//! Scenes of which a number is wanted: those of the trade study, and others.

use actin_sim::adapt::value;
use actin_sim::{Assembly, Quantity, Scene};

/// A scene of which a number is wanted, and the stretches of monomers that it is tried with (nm).
pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) scene: Scene,
    pub(super) quantity: Quantity,
    pub(super) stretches: Vec<Vec<[f64; 2]>>,
}

impl Case {
    /// Length of its filament (nm).
    pub(super) fn length_nm(&self) -> f64 {
        let sections = self.scene.filament.sections.last();
        sections.map_or(0.0, |section| section.span_nm().1)
    }

    /// What is wanted, of a filament in the state that it is in.
    pub(super) fn value(&self, assembly: &Assembly) -> f64 {
        value(assembly, assembly.system.state(), self.quantity)
    }
}

/// Rise per monomer (nm).
const RISE_NM: f64 = 71.2 / 26.0;

/// Stretches of monomers that a scene is tried with (nm); none for the rod alone.
type Stretches = &'static [[f64; 2]];

/// Scenes of the trade study, by file.
const MEASURED: [(&str, &str, Quantity, &[Stretches]); 17] = {
    use Quantity::{Curvature, EndCouple, EndForce, Energy, Height, LinkerForce, Tip};
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
        (
            "curvature halfway, 160 nm",
            "cantilever-160",
            Curvature { at_nm: 80.0 },
            &[],
        ),
        (
            "curvature of the top, buckled over",
            "buckling-over",
            Curvature { at_nm: 150.0 },
            &[&[[0.0, 75.0]]],
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
const OTHERS: [(&str, f64, &str, Quantity); 12] = {
    use Quantity::{Curvature, EndCouple, EndForce, Energy, Height, LinkerForce, Tip};
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
        (
            "height, buckled, 1600 nm",
            584.5,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            linkers: [Linker(at_nm: 800.3, displaced_nm: (500.0, 0.0, 0.0), stiffness_pn_per_nm: 1e-7)],
            path: [Stage(
                set: [Shift(end: Start, shift_nm: (0.0, 0.0, 40.0)), Shift(end: End, shift_nm: (0.0, 0.0, -40.0))],
                duration_ns: 300.0,
            )]",
            Height,
        ),
        (
            "couple, snapping",
            110.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            linkers: [Linker(at_nm: 150.6, displaced_nm: (100.0, 0.0, 0.0), stiffness_pn_per_nm: 1e-5)],
            path: [
                Stage(set: [Turn(end: End, turn_deg: (0.0, 0.0, -300.0))]),
                Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, -15.0))]),
            ]",
            EndCouple,
        ),
        (
            "curvature at a linker, 200 nm",
            73.0,
            "clamps: [Clamp(end: Start), Clamp(end: End)],
            linkers: [Linker(at_nm: 99.9, displaced_nm: (10.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0)]",
            Curvature { at_nm: 99.9 },
        ),
    ]
};

/// All of them.
pub(super) fn cases() -> Result<Vec<Case>, Box<dyn std::error::Error>> {
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
        let text = format!(
            "Scene(filament: Filament(sections: {sections}), {rest}, task: Equilibrium(leave_saddles: 20, accept_jumps: true))"
        );
        cases.push(Case {
            name,
            scene: Scene::from_ron(&text)?,
            quantity,
            stretches: Vec::new(),
        });
    }
    Ok(cases)
}
