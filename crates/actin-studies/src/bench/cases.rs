//! The cases: what runs, and how fast it should be on one core at 3 GHz, or on two against one.

/// One case.
pub(super) struct Case {
    /// Its name.
    pub(super) name: &'static str,
    pub(super) work: Work,
    /// The rate that was aimed at (elements per second, or times one thread), where one was set.
    pub(super) target: Option<f64>,
}

/// Work of a case.
#[derive(Clone, Copy)]
pub(super) enum Work {
    /// Whole time steps.
    Motion(Motion),
    /// From the straight state, every monomer resolved, to the equilibrium under a tip force.
    Equilibrium {
        /// Length of the filament (nm).
        length_nm: f64,
    },
    /// Replicas of a scene on two threads, against one.
    Ensemble(Replicated),
}

/// Replicated scene: a filament of 160 nm on a wall.
#[derive(Clone, Copy)]
pub(super) enum Replicated {
    /// A rod of 64 segments in a heat bath.
    Rod,
    /// Monomers in a heat bath.
    Monomers,
    /// 40 nm of monomers at the wall and 12 segments of rod, in a heat bath.
    Mixed,
    /// Equilibria of monomers with drawn bonds under a tip force.
    Equilibria,
}

/// Undamped motion of clamped filaments, straight at first, under a force across the tip.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    pub(super) filament: Filament,
    /// Number of filaments. Independent filaments are scenes of their own: one after the other
    /// makes the steps of a batch.
    pub(super) copies: usize,
    /// The scene's integrator.
    pub(super) integrator: &'static str,
}

/// Composition of a filament.
#[derive(Clone, Copy)]
pub(super) enum Filament {
    /// A rod of 160 nm under a law; an element is a segment.
    Rod { segments: usize, law: &'static str },
    /// Monomers with 10 bonds per interface; an element is a bond.
    Monomers { count: usize },
    /// 1600 nm, of which 40 at the wall are monomers and the rest is a rod of segments of 20 nm under
    /// the law `Fitted`; segments and bonds are elements.
    Mixed,
}

const fn rod(segments: usize, copies: usize, integrator: &'static str) -> Work {
    Work::Motion(Motion {
        filament: Filament::Rod {
            segments,
            law: "Constant",
        },
        copies,
        integrator,
    })
}

const fn rod_of(law: &'static str, segments: usize) -> Work {
    Work::Motion(Motion {
        filament: Filament::Rod { segments, law },
        copies: 1,
        integrator: VERLET,
    })
}

const fn monomers(count: usize) -> Work {
    Work::Motion(Motion {
        filament: Filament::Monomers { count },
        copies: 1,
        integrator: VERLET,
    })
}

const MIXED: Work = Work::Motion(Motion {
    filament: Filament::Mixed,
    copies: 1,
    integrator: VERLET,
});

const VERLET: &str = "PositionVerlet";

const fn case(name: &'static str, work: Work, target: Option<f64>) -> Case {
    Case { name, work, target }
}

/// 0.95 of as many cores as there are threads.
const fn ensemble(name: &'static str, of: Replicated) -> Case {
    case(name, Work::Ensemble(of), Some(1.9))
}

const fn equilibrium(name: &'static str, length_nm: f64) -> Case {
    case(name, Work::Equilibrium { length_nm }, None)
}

/// All cases.
pub(super) const CASES: [Case; 22] = [
    case("rod-pv-16", rod(16, 1, VERLET), None),
    case("rod-pv-64", rod(64, 1, VERLET), Some(50e6)),
    case("rod-pv-256", rod(256, 1, VERLET), Some(50e6)),
    case("rod-pv-1024", rod(1024, 1, VERLET), Some(45e6)),
    case("rod-pv-64x64", rod(64, 64, VERLET), Some(60e6)),
    case("rod-pefrl-64", rod(64, 1, "Pefrl"), None),
    case("rod-fitted-pv-16", rod_of("Fitted", 16), None),
    case("rod-fitted-pv-64", rod_of("Fitted", 64), None),
    case("rod-fitted-pv-1024", rod_of("Fitted", 1024), None),
    case(
        "rod-homogenised-pv-64",
        rod_of("Homogenised", 64),
        Some(35e6),
    ),
    case("rod-homogenised-pv-1024", rod_of("Homogenised", 1024), None),
    case(
        "rod-published-pv-64",
        rod_of("PublishedExtension", 64),
        None,
    ),
    case("mixed-fitted-pv-1600nm", MIXED, None),
    case("ellipsoid-pv-60", monomers(60), Some(300e6)),
    case("ellipsoid-pv-1000", monomers(1000), Some(300e6)),
    equilibrium("equilibrium-ellipsoid-160nm", 160.0),
    equilibrium("equilibrium-ellipsoid-1600nm", 1600.0),
    equilibrium("equilibrium-ellipsoid-16000nm", 16_000.0),
    ensemble("ensemble-rod-64", Replicated::Rod),
    ensemble("ensemble-ellipsoid-160nm", Replicated::Monomers),
    ensemble("ensemble-mixed-160nm", Replicated::Mixed),
    ensemble("ensemble-equilibria-160nm", Replicated::Equilibria),
];

impl Case {
    /// Unit of what is measured.
    pub(super) fn unit(&self) -> &'static str {
        match self.work {
            Work::Motion(Motion {
                filament: Filament::Rod { .. },
                ..
            }) => "element-steps/s",
            Work::Motion(Motion {
                filament: Filament::Mixed,
                ..
            }) => "elements and bonds/s",
            Work::Motion(_) => "bonds/s",
            Work::Equilibrium { .. } => "s",
            Work::Ensemble(_) => "times one thread",
        }
    }
}
