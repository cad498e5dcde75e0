//! Warnings on the validity and accuracy of rod laws.

use crate::scene::{Filament, Material, Monomers, RodChanges, RodLaw, RodModel};
use actin_cosserat::{Homogenised, RigidityFactors};

/// Persistence length (um) and twisting rigidity (pN nm^2) of free filaments of 110 nm at 298 K,
/// from rotations between cross-sections 22 to 66 nm apart. Standard errors are 0.1 um and 50 pN
/// nm^2; for monomers with default bonds 0.06 um and 30 pN nm^2.
///
/// # Source
/// `docs/measured/heat.md`, "Persistence length".
type InBath = (f64, f64);

const MONOMERS: InBath = (11.6, 8.0e3);

/// Returns the name of a law fitted to equilibria at zero temperature, with the values of its rods
/// in the bath.
fn fitted_without_heat(law: &RodLaw) -> Option<(&'static str, InBath)> {
    match law {
        RodLaw::Constant => Some(("Constant", (9.5, 1.30e4))),
        RodLaw::PublishedExtension => Some(("PublishedExtension", (9.5, 5.2e3))),
        RodLaw::CouplingEnergy => Some(("CouplingEnergy", (9.5, 5.2e3))),
        RodLaw::Fitted => Some(("Fitted", (9.7, 5.2e3))),
        RodLaw::HomogenisedAthermal => Some(("HomogenisedAthermal", (10.5, 8.8e3))),
        _ => None,
    }
}

/// Warnings on the laws of a filament's rods, in a heat bath of temperature `bath_k` (K) or without
/// a bath.
pub(super) fn notes(filament: &Filament, bath_k: Option<f64>) -> Vec<String> {
    let of_rod = |rod: RodModel| {
        let law = match bath_k {
            Some(temperature_k) => law_in_bath(&rod, temperature_k),
            None => law_at_rest(&rod),
        };
        let bonds = drawn_bonds(&rod, &filament.monomers, bath_k.is_some());
        let others = is_of_others(&rod, &filament.monomers).then(|| OF_OTHERS.to_owned());
        law.into_iter().chain(bonds).chain(others)
    };
    let of_altered =
        (bath_k.is_some() && is_softened(filament)).then(|| SOFTENED_IN_BATH.to_owned());
    filament
        .rod_models()
        .flat_map(of_rod)
        .chain(of_altered)
        .collect()
}

/// Returns `true` if a section multiplies the rigidities of a free energy.
fn is_softened(filament: &Filament) -> bool {
    let mut sections = filament.sections.iter();
    sections.any(|section| {
        let is_altered = |altered: &RodChanges| altered.factors() != RigidityFactors::default();
        let law = section.rod_model(&filament.rod).law;
        section.altered_rod().is_some_and(is_altered)
            && matches!(law, RodLaw::Homogenised | RodLaw::HomogenisedAt298K)
    })
}

const SOFTENED_IN_BATH: &str = "rods with the law Homogenised in a heat bath and factors of rigidities: the factors multiply the free energy of \
    unaltered monomers. Its thermal part would not become smaller with softer bonds: resolve the section as monomers to check";

/// Largest difference (K) between the temperatures of the free energy and of the bath without a
/// warning. The thermal part of the free energy is then wrong by 1 %.
const NEAR_K: f64 = 3.0;

fn far_from(law: &RodLaw, temperature_k: f64) -> Option<String> {
    let (own, remedy) = if *law == RodLaw::HomogenisedAt298K {
        (Homogenised::HEATED_K, "write law: Homogenised")
    } else {
        let [lowest, highest] = Homogenised::HEATED_RANGE_K;
        let nearest = temperature_k.clamp(lowest, highest);
        (nearest, "resolve monomers, or set 273 to 323 K")
    };
    let error = 100.0 * (own / temperature_k - 1.0).abs();
    ((temperature_k - own).abs() > NEAR_K).then(|| {
        format!(
            "rods with the law Homogenised in a heat bath of {temperature_k} K: their free energy is the one at \
             {own} K. Its thermal part, such as the tension of a filament held at its length as built, is wrong by \
             about {error:.0} %: {remedy}"
        )
    })
}

/// Warning on a rod's law without a heat bath; `None` for user-defined constant rigidities.
fn law_at_rest(rod: &RodModel) -> Option<String> {
    let note = match rod.law {
        RodLaw::HomogenisedAt298K => HEATED,
        RodLaw::Constant if rod.material == Material::Table4 => CONSTANT,
        _ => return None,
    };
    Some(note.to_owned())
}

/// Returns `true` if the potential of a rod was derived from other monomers.
fn is_of_others(rod: &RodModel, monomers: &Monomers) -> bool {
    let same = Monomers {
        seed: monomers.seed,
        anchors: monomers.anchors,
        lateral_bonds: monomers.lateral_bonds,
        longitudinal_bonds: monomers.longitudinal_bonds,
        azimuth_deg: monomers.azimuth_deg,
        mass_ag: monomers.mass_ag,
        ..Monomers::default()
    };
    rod.law.is_homogenised() && *monomers != same
}

const OF_OTHERS: &str = "rods with the law Homogenised: the law was derived from monomers of the default shape, lattice and bonds, but \
    the monomers of this scene differ; resolve the rods as monomers, or write law: Constant with suitable rigidities";

fn drawn_bonds(rod: &RodModel, monomers: &Monomers, in_bath: bool) -> Option<String> {
    let bonds = monomers
        .sampled_bonds()
        .filter(|_| rod.law.is_homogenised())?;
    let is_heated = match rod.law {
        RodLaw::Homogenised => in_bath,
        _ => rod.law == RodLaw::HomogenisedAt298K,
    };
    let fewest = Homogenised::SAMPLED_BONDS;
    if is_heated {
        Some(DRAWN_IN_BATH.to_owned())
    } else {
        (bonds < fewest).then(|| {
            format!(
                "rods with the law Homogenised with {bonds} sampled bonds per interface: the law uses the \
                 stiffness of filaments with {fewest} bonds, its smallest number"
            )
        })
    }
}

const DRAWN_IN_BATH: &str = "rods with the law Homogenised at 298 K: they represent the mean filament, although this scene has sampled \
    bonds. The persistence length is 11.2 um with 64 sampled bonds per interface, and 11.5 um for the mean filament \
    (docs/measured/heat.md)";

/// Warning on the published rigidities, with the numbers of bounds met
/// (`docs/tables/load-cases.md`).
const CONSTANT: &str = "rods with the law Constant, the published rigidities: this law reproduces 12 of 94 measured \
    quantities of monomer filaments within the required tolerance, Homogenised 84 (docs/tables/load-cases.md)";

const HEATED: &str = "rods with the law HomogenisedAt298K without a heat bath: their free energy at 298 K is minimal at a \
    length 0.46 % below the initial length, so a rod held at both ends is under tension. Without heat, Homogenised \
    is the energy of monomers at zero temperature";

/// Warning on a rod's law in a heat bath; `None` for user-defined constant rigidities, which can
/// include thermal effects.
fn law_in_bath(rod: &RodModel, temperature_k: f64) -> Option<String> {
    if rod.law == RodLaw::Constant && rod.material != Material::Table4 {
        return None;
    }
    if matches!(rod.law, RodLaw::Homogenised | RodLaw::HomogenisedAt298K) {
        return far_from(&rod.law, temperature_k);
    }
    let Some((name, (persistence, twist))) = fitted_without_heat(&rod.law) else {
        let note = "rods with the law Laws in a heat bath: laws fitted to equilibria at zero temperature are not \
                    free energies, so the fluctuations of rods differ from those of the fitted \
                    filaments";
        return Some(note.to_owned());
    };
    let (of_monomers, twist_of_monomers) = MONOMERS;
    Some(format!(
        "rods with the law {name} in a heat bath: its parameters come from equilibria of monomers \
         at zero temperature, so the law is not a free energy. At 298 K free filaments of 110 nm have, with \
         these rods, a persistence length of {persistence:.1} um and a twisting rigidity of \
         {twist:.1e} pN nm^2, with monomers {of_monomers:.1} um and {twist_of_monomers:.1e} pN nm^2 \
         (docs/measured/heat.md)"
    ))
}
#[cfg(test)]
mod tests {
    use super::super::tests::notes;
    use super::*;

    const BATH: &str = "drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
        thermal: (temperature_k: 298.0, seed: 1)";

    fn rod(model: &str, x: f64) -> String {
        format!(
            "Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)], rod: RodModel({model}),
                at_nm: ({x:?}, 0.0, 0.0)),"
        )
    }

    #[test]
    fn laws_of_sections_are_noted() {
        let filament = "Filament(sections: [
            Rod(from_nm: 0.0, to_nm: 80.0),
            Rod(from_nm: 80.0, to_nm: 160.0, altered: (law: HomogenisedAt298K)),
        ], rod: RodModel(law: Fitted))";
        let found = notes(filament, "");
        assert_eq!(found, [HEATED]);
        let heated = notes(filament, BATH);
        assert_eq!(heated.len(), 1, "{heated:?}");
        assert!(heated[0].starts_with("rods with the law Fitted in a heat bath"));
    }

    #[test]
    fn factors_of_a_free_energy_are_noted() {
        let filament = "Filament(sections: [
            Rod(from_nm: 0.0, to_nm: 80.0),
            Rod(from_nm: 80.0, to_nm: 160.0, altered: (twist_rigidity_factor: 0.1)),
        ])";
        assert_eq!(notes(filament, BATH)[1..], [SOFTENED_IN_BATH]);
        assert_eq!(notes(filament, "").len(), 1);
    }

    #[test]
    fn other_temperatures_are_noted() {
        #[rustfmt::skip]
        let cases = [
            ("HomogenisedAt298K", "310.0", Some("about 4 %: write law: Homogenised")),
            ("HomogenisedAt298K", "300.0", None),
            ("Homogenised", "310.0", None),
            ("Homogenised", "250.0", Some("about 9 %: resolve monomers, or set 273 to 323 K")),
        ];
        for (law, kelvin, expected) in cases {
            let all = notes(
                &rod(&format!("law: {law}"), 0.0),
                &BATH.replace("298.0", kelvin),
            );
            let found = all
                .iter()
                .find(|note| note.contains("their free energy is"));
            let is_expected = match (found, expected) {
                (Some(note), Some(expected)) => note.contains(expected),
                (found, expected) => found.is_none() && expected.is_none(),
            };
            assert!(is_expected, "{law}, {kelvin} K: {found:?}");
        }
    }

    /// Each law gives one warning, for any number of filaments.
    #[test]
    fn laws_are_noted_where_heat_meets_them() {
        let filaments = [
            rod("law: Fitted", 0.0),
            rod("law: Constant", 20.0),
            rod("law: Fitted", 40.0),
            rod(
                "law: Laws(twist: Sided(rest_pn_nm2: 300.0,
                under: (rise_pn_nm2: 1e4, half_per_nm: 0.01, slow_per_nm: 0.01),
                over: (rise_pn_nm2: 1e4, half_per_nm: 0.01, slow_per_nm: 0.01),
                range_per_nm: 0.05))",
                60.0,
            ),
            rod("law: Constant, material: PrecedingPaper", 80.0),
            rod("law: HomogenisedAthermal", 120.0),
            "Filament(sections: [Ellipsoids(from_nm: 0.0, to_nm: 12.0)],
                rod: RodModel(law: CouplingEnergy), at_nm: (100.0, 0.0, 0.0))"
                .to_owned(),
        ]
        .concat();
        let found = notes(&filaments, BATH);
        let begin: Vec<&str> = found
            .iter()
            .map(|note| note.split(':').next().unwrap())
            .collect();
        assert_eq!(
            begin,
            [
                "a rod of 30.0 nm with the law Homogenised",
                "rods with the law Fitted in a heat bath",
                "rods with the law Constant in a heat bath",
                "rods with the law Laws in a heat bath",
                "rods with the law HomogenisedAthermal in a heat bath",
            ]
        );
        assert!(found.iter().all(|note| !note.contains("cargo")));
        let at_rest = notes(&filaments, "");
        assert_eq!(at_rest.len(), 2, "{at_rest:?}");
        assert_eq!(at_rest[1], CONSTANT);
    }

    #[test]
    fn numbers_of_met_bounds_agree_with_the_table() {
        let table = include_str!("../../../../docs/tables/load-cases.md");
        let met = |law: &str| -> [u32; 2] {
            let rows = table.lines().map(|line| line.split('|').map(str::trim));
            let rows = rows.map(Iterator::collect::<Vec<_>>);
            let counts = rows.filter(|cells| cells.len() == 8 && cells[2] == law);
            counts.fold([0; 2], |[met, all], cells| {
                let (own, of) = cells[3].split_once(" of ").unwrap();
                [
                    met + own.parse::<u32>().unwrap(),
                    all + of.parse::<u32>().unwrap(),
                ]
            })
        };
        let [[constant, all], [homogenised, _]] = ["Constant", "Homogenised"].map(met);
        let said = format!("{constant} of {all} measured quantities");
        assert!(CONSTANT.contains(&said), "{said}");
        let said = format!("required tolerance, Homogenised {homogenised} (");
        assert!(CONSTANT.contains(&said), "{said}");
    }

    #[test]
    fn other_monomers_are_noted() {
        let notes = |monomers: &str, law: &str| {
            let rod = "sections: [Rod(from_nm: 0.0, to_nm: 160.0)], rod: RodModel";
            notes(
                &format!("Filament({rod}({law}), monomers: Monomers({monomers}))"),
                "",
            )
        };
        assert_eq!(notes("lateral_rigidity_pn_per_nm: 500.0", ""), [OF_OTHERS]);
        assert_eq!(notes("azimuth_deg: 20.0, lateral_bonds: 16", ""), [""; 0]);
        assert_eq!(notes("turn_deg: -160.0", "law: Constant"), [CONSTANT]);
    }

    #[test]
    fn bonds_that_the_law_does_not_know_are_noted() {
        let notes = |monomers: &str, task: &str| {
            let filament = format!(
                "Filament(sections: [Rod(from_nm: 0.0, to_nm: 160.0)], rod: RodModel(law: Homogenised),
                    monomers: Monomers({monomers}))"
            );
            notes(&filament, task)
        };
        assert_eq!(notes("anchors: Independent", ""), [""; 0]);
        let few = "anchors: Independent, lateral_bonds: 10, longitudinal_bonds: 10";
        let found = notes(few, "");
        let said = "with 10 sampled bonds per interface: the law uses the stiffness of filaments with 64 bonds";
        assert!(found[0].contains(said), "{found:?}");
        assert_eq!(notes("anchors: Independent", BATH), [DRAWN_IN_BATH]);
        assert_eq!(notes("", BATH), [""; 0]);
    }
}
