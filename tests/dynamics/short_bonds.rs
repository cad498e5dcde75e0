//! Very short bonds, which limit the energy conservation of monomers at room temperature.

use super::filaments::{ELLIPSOIDS, assemble, heat};
use super::record::EnergyRecord;
use actin_ellipsoid::{Bonds, EllipsoidModel, EllipsoidParameters, Placement};
use actin_integrate::{PEFRL, largest_frequency, stable_step};
use actin_mechanics::{Interaction, State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, ForceLaw};

/// Bonds of the filament of ellipsoids, built again to access their ends.
fn bonds_of(assembly: &Assembly) -> Bonds {
    let parameters = EllipsoidParameters::with_sampled_bonds(16, 1);
    let placement = Placement {
        rotation: UnitQuaternion::identity(),
        translation: Vector3::zeros(),
    };
    let model = EllipsoidModel::new(parameters).unwrap();
    let count = assembly.counts().monomers;
    let monomers = model
        .build(&mut State::default(), &placement, 0, count)
        .unwrap();
    model.bonds(&monomers).unwrap()
}

fn shortest(bonds: &Bonds, state: &State) -> f64 {
    let pairs = bonds.pairs().iter();
    let lengths = pairs.flat_map(|pair| bonds.ends_of(pair, state).map(|[a, b]| (b - a).norm()));
    lengths.fold(f64::INFINITY, f64::min)
}

/// At a hundredth of room temperature every bond keeps 0.7 of its length. At room temperature some
/// bonds pass zero length, where the force reverses. The shortest length depends on rounding.
#[test]
fn bonds_lose_their_length_at_room_temperature() {
    for (level, share_left) in [(0.01, 0.7..1.0), (1.0, 0.0..0.7)] {
        let mut assembly = assemble(ELLIPSOIDS, ForceLaw::EnergyGradient);
        let bonds = bonds_of(&assembly);
        let system = &mut assembly.system;
        let at_rest = shortest(&bonds, system.state());
        // The bonds equal those of the assembly: their energy is zero as built.
        assert!(bonds.energy(system.state()) < 1e-20);
        let frequency = largest_frequency(system).unwrap();
        heat(system.state_mut(), level, 1);
        let h = stable_step(&PEFRL, frequency, 0.25).unwrap();
        let mut least = at_rest;
        // Long enough for a shortest bond independent of round-off.
        EnergyRecord::new(system, h, 80_000, |state| {
            least = least.min(shortest(&bonds, state));
        });
        println!("level {level}: shortest bond {at_rest:.3} nm at rest, {least:.3} nm in motion");
        assert!(share_left.contains(&(least / at_rest)), "{least}");
    }
}
