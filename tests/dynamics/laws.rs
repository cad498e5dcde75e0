//! Motion of rods under nonconstant laws: order and energy. Every state is twisted and
//! stretched.

use super::filaments::{
    Filament, MIXED, ROD, ROD_AT_BOTH_ENDS, assemble_of, distances, fly_off, orders, state_after,
    steps_of_one_radian,
};
use super::record::EnergyRecord;
use actin_integrate::{PEFRL, largest_frequency, stable_step};
use actin_mechanics::System;

const LAWS: [&str; 4] = [
    "PublishedExtension",
    "CouplingEnergy",
    "Fitted",
    "Homogenised",
];

#[derive(Clone, Copy, Debug)]
struct Case {
    filament: Filament,
    law: &'static str,
    kappa: [f64; 3],
    extension: f64,
}

impl Case {
    /// Every law on a rod, over- and under-twisted, and on mixed filaments with one sense of twist
    /// each. Rods are stretched as by 100 pN.
    ///
    /// Mixed filaments are deformed less, since their junctions have bending elements of 0.7 nm. A
    /// rotation of 0.03 rad there exceeds the range of a published law, and 0.002 rad is half of
    /// the rise of `Fitted`'s bending.
    fn all() -> Vec<Self> {
        let filaments = [
            (ROD, [6e-3, -3e-3, 1.5e-2], 3e-3),
            (ROD, [6e-3, -3e-3, -1.5e-2], 3e-3),
            (MIXED, [1.2e-3, -6e-4, 1e-2], 1e-3),
            (ROD_AT_BOTH_ENDS, [1.2e-3, -6e-4, -1e-2], 1e-3),
        ];
        let mut all = Vec::new();
        for (filament, kappa, extension) in filaments {
            all.extend(LAWS.map(|law| Self {
                filament,
                law,
                kappa,
                extension,
            }));
        }
        all
    }

    fn in_flight(self) -> System {
        let assembly = assemble_of(self.filament, &format!("law: {}", self.law));
        fly_off(assembly, self.kappa.into(), self.extension, 0.1)
    }

    /// Largest frequency (rad/ns), at least the frequency of a rod with the shear rigidity of Table
    /// 4. `Fitted` has no shear stiffness at rest; half of its limit there is unstable in motion.
    fn frequency(self) -> f64 {
        largest_frequency(&self.in_flight()).unwrap().max(490.0)
    }

    fn step(self, share: f64) -> f64 {
        stable_step(&PEFRL, self.frequency(), share).unwrap()
    }

    fn name(self) -> String {
        let [_, _, twist] = self.kappa;
        format!("{}, {}, {twist:+} rad/nm", self.filament.0, self.law)
    }
}

/// A discontinuous load would have order 1 to 2.
///
/// `Homogenised` is excluded: it softens in compression within a strain of 7e-5 and has orders of 2
/// to 3.2 at these steps.
#[test]
fn every_law_moves_with_order_four() {
    let is_smooth = |case: &Case| case.law != "Homogenised";
    for case in Case::all().into_iter().filter(is_smooth) {
        let steps = steps_of_one_radian(case.frequency());
        let after = |n: u32| state_after(case.in_flight(), &PEFRL, n * steps);
        let reference = after(64);
        let error = |n: u32| distances(&after(n), &reference);
        let orders = orders(error(4), error(8));
        let name = case.name();
        // The next term of the error is of relative order (omega h)^2, as in `order.rs`.
        assert!(orders.iter().all(|o| (o - 4.0).abs() < 0.05), "{name}");
    }
}

#[test]
fn every_law_keeps_its_energy() {
    for case in Case::all() {
        let [coarse, fine] = [(0.25, 6000), (0.125, 12_000)].map(|(share, steps)| {
            EnergyRecord::new(&mut case.in_flight(), case.step(share), steps, |_| ())
        });
        let (name, ratio) = (case.name(), coarse.early() / fine.early());
        // Over the first three tenths, before chaotic divergence: 6 or more (measured), 1 for a
        // wrong gradient. The onset of compression limits `Homogenised`.
        assert!(ratio > 3.0 || case.law == "Homogenised", "{name}: {ratio}");
        // (omega h)^4 of the fastest modes by participation: up to 2.5e-6 (measured). Chaotic
        // motions differ by tens of 1e-6 between orders of summation.
        assert!(coarse.early() < 2e-5, "{name}");
        let resists_shear = !["Fitted", "Homogenised"].contains(&case.law);
        if case.filament == ROD && resists_shear {
            assert!(coarse.trend().abs() < 0.1 * coarse.early(), "{name}");
        }
    }
}
