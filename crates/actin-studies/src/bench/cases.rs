//! Benchmark cases, with target rates on one core at 3 GHz or target speed-ups of two threads.

pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) work: Work,
    /// Target rate (elements per second, or speed-up over one thread), if set.
    pub(super) target: Option<f64>,
}

#[derive(Clone, Copy)]
pub(super) enum Work {
    Motion(Motion),
    /// Equilibrium of an all-monomer filament under a tip force, from the straight state.
    Equilibrium {
        /// Length of the filament (nm).
        length_nm: f64,
    },
    Ensemble(Replicated),
    Network(Network),
}

/// Random network of rods of 1 um with 10 segments in water.
#[derive(Clone, Copy)]
pub(super) struct Network {
    pub(super) filaments: usize,
    pub(super) law: &'static str,
    pub(super) couplings: Couplings,
    pub(super) step_ns: f64,
}

/// Steps (ns) below the default of 4941 ns.
const NETWORK: Network = Network {
    filaments: 100,
    law: "Constant",
    couplings: Couplings::Linkers,
    step_ns: 4500.0,
};

#[derive(Clone, Copy)]
pub(super) enum Couplings {
    /// 2.5 permanent linkers per filament.
    Linkers,
    LinkersAndContacts,
    /// 2.5 crosslinkers per filament that bind and unbind.
    Crosslinkers,
}

#[derive(Clone, Copy)]
pub(super) enum Replicated {
    /// A rod of 64 segments in a heat bath.
    Rod,
    Monomers,
    /// 40 nm of monomers at the wall and 12 segments of rod, in a heat bath.
    Mixed,
    /// Equilibria of monomers with sampled bonds under a tip force.
    Equilibria,
}

/// Undamped motion of clamped, initially straight filaments under a transverse tip force.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    pub(super) filament: Filament,
    /// Number of filaments. Each is a separate scene, and the batches of steps alternate between scenes.
    pub(super) copies: usize,
    pub(super) integrator: &'static str,
}

#[derive(Clone, Copy)]
pub(super) enum Filament {
    /// A rod of 160 nm. Segments are counted as elements.
    Rod { segments: usize, law: &'static str },
    /// Monomers with 10 bonds per interface. Bonds are counted as elements.
    Monomers { count: usize },
    /// 40 nm of monomers at the clamp and 1560 nm of rod with segments of 20 nm and the law `Fitted`. Segments and
    /// bonds are counted as elements.
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

const fn network(name: &'static str, of: Network) -> Case {
    case(name, Work::Network(of), None)
}

const fn ensemble(name: &'static str, of: Replicated) -> Case {
    case(name, Work::Ensemble(of), Some(1.9))
}

const fn equilibrium(name: &'static str, length_nm: f64) -> Case {
    case(name, Work::Equilibrium { length_nm }, None)
}

pub(super) const CASES: [Case; 30] = [
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
    network(
        "network-20",
        Network {
            filaments: 20,
            ..NETWORK
        },
    ),
    network("network-100", NETWORK),
    network(
        "network-500",
        Network {
            filaments: 500,
            ..NETWORK
        },
    ),
    network(
        "network-2000",
        Network {
            filaments: 2000,
            ..NETWORK
        },
    ),
    network(
        "network-500-1us",
        Network {
            filaments: 500,
            step_ns: 1000.0,
            ..NETWORK
        },
    ),
    network(
        "network-100-repulsion",
        Network {
            couplings: Couplings::LinkersAndContacts,
            ..NETWORK
        },
    ),
    network(
        "network-100-crosslinkers",
        Network {
            couplings: Couplings::Crosslinkers,
            ..NETWORK
        },
    ),
    network(
        "network-100-homogenised",
        Network {
            law: "Homogenised",
            ..NETWORK
        },
    ),
];

impl Case {
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
            Work::Network(_) => "s per ms",
        }
    }
}
