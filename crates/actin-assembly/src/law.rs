//! Interactions of rods from the rod laws of a scene.

use super::{Ranges, TwistWatch};
use crate::scene::{
    Filament, ForceLaw, Material, Monomers, RodChanges, RodLaw, RodLaws, RodModel, SceneProblem,
    Section, fitted_laws,
};
use actin_cosserat::{
    EndShear, EnergyGradient, Homogenised, JoinedElement, PaperBalance, RodLayout, RodMaterial,
    RodParameterError, SegmentCurvature, SegmentLaw, TanhTwist, TwistLaw, TwistStretch, constants,
};
use actin_mechanics::Interaction;

#[derive(Debug)]
pub(super) struct EndConditions {
    /// Elements that join the start and the end of the rod to monomers.
    pub(super) joined: [Vec<JoinedElement>; 2],
    /// Shear conditions at the start and end of the chain of rods that contains this rod.
    pub(super) ends: [EndShear; 2],
    /// Distances from the ends of this rod to the ends of the chain (nm).
    pub(super) beyond_nm: [f64; 2],
}

pub(super) struct Law {
    balance: ForceLaw,
    pub(super) material: RodMaterial,
    twist_stretch: Option<TwistStretch>,
}

impl Law {
    /// Law of section `i` of a filament. `heated` is `None` without a heat bath and for monomers.
    pub(super) fn of_section(
        (i, section): (usize, &Section),
        filament: &Filament,
        heated: Option<HeatedSegments>,
    ) -> Result<Self, SceneProblem> {
        let rod = &filament.rod;
        let potential = |law: &RodLaw| {
            let potential = potential(law, &filament.monomers, heated);
            potential.map_err(|segment_nm| too_short((i, section), segment_nm))
        };
        let Some(altered) = section.altered_rod() else {
            return Self::new(rod, potential);
        };
        let key = format!("filament.sections[{i}].altered");
        let named = |problem: SceneProblem| match problem.key.strip_prefix("filament.rod") {
            Some(rest) if rest != ".force_law" => SceneProblem {
                key: format!("{key}{rest}"),
                ..problem
            },
            _ => problem,
        };
        let model = section.rod_model(rod);
        let law = Self::new(&model, potential).map_err(named)?;
        law.altered(altered, &key)
    }

    /// Applies factors of rigidities and a rest shape.
    fn altered(self, altered: &RodChanges, key: &str) -> Result<Self, SceneProblem> {
        let softened = self.material.softened(&altered.factors());
        let material =
            softened.and_then(|material| material.with_rest_curvature(altered.rest_curvature()));
        let material = material.map_err(|error| {
            SceneProblem::new(key, error.value, format!("must be {}", error.rule))
        })?;
        Ok(Self { material, ..self })
    }

    fn new(
        rod: &RodModel,
        potential: impl Fn(&RodLaw) -> Result<&'static Homogenised, SceneProblem>,
    ) -> Result<Self, SceneProblem> {
        check_beside_law(rod)?;
        let rigidities = rod.material.rigidities();
        let material = RodMaterial::new(rigidities).map_err(refused("material"))?;
        let (material, twist_stretch) = match &rod.law {
            RodLaw::Constant => (material, None),
            RodLaw::PublishedExtension => published(material, TwistStretch::published())?,
            RodLaw::CouplingEnergy => {
                let law = TwistStretch::linear(constants::C3, rigidities.shear.z);
                published(material, law)?
            }
            RodLaw::Fitted => with_laws(material, &fitted_laws())?,
            law @ (RodLaw::Homogenised
            | RodLaw::HomogenisedAthermal
            | RodLaw::HomogenisedAt298K) => (RodMaterial::homogenised(potential(law)?), None),
            RodLaw::Laws(laws) => with_laws(material, laws)?,
        };
        Ok(Self {
            balance: rod.force_law,
            material,
            twist_stretch,
        })
    }

    /// Coupling of the strains to the curvature; `None` if they are independent.
    fn coupling(&self) -> Option<SegmentLaw> {
        SegmentLaw::from_material(&self.material, self.twist_stretch)
    }

    pub(super) fn ranges(&self) -> Ranges {
        Ranges::new(&self.material, self.twist_stretch.as_ref())
    }

    /// Returns the monitor of twist stability; `None` if no axial force can destabilise the twist,
    /// or if the loads have no energy.
    pub(super) fn twist_watch(
        &self,
        layout: &RodLayout,
        around: &EndConditions,
    ) -> Option<TwistWatch> {
        if self.balance != ForceLaw::EnergyGradient {
            return None;
        }
        if self.twist_stretch.is_none() && self.material.potential().is_none() {
            return None;
        }
        Some(TwistWatch {
            law: self.coupling()?,
            curvature: self.curvature(layout, around),
        })
    }

    /// Mean curvatures around segments and, for a potential, the end conditions of shear and twist.
    fn curvature(&self, layout: &RodLayout, around: &EndConditions) -> SegmentCurvature {
        let [start, end] = &around.joined;
        let curvature = SegmentCurvature::new(layout, start, end);
        if self.material.potential().is_none() {
            return curvature;
        }
        curvature.with_ends(layout, around.ends, around.beyond_nm)
    }

    /// Returns `true` if the strains are coupled to the curvature.
    pub(super) fn is_extended(&self) -> bool {
        self.coupling().is_some()
    }

    pub(super) fn interaction(
        &self,
        layout: &RodLayout,
        around: &EndConditions,
    ) -> Box<dyn Interaction> {
        let curvature = || self.curvature(layout, around);
        let (own, material) = (layout.clone(), self.material);
        match self.balance {
            ForceLaw::EnergyGradient => {
                let rod = EnergyGradient::new(own, material);
                match self.coupling() {
                    Some(law) => Box::new(rod.with_extension(law, curvature())),
                    None => Box::new(rod),
                }
            }
            ForceLaw::PaperBalance => {
                let rod = PaperBalance::new(own, material)
                    .expect("the printed balance was refused for a potential");
                match self.twist_stretch {
                    Some(law) => Box::new(rod.with_extension(law, curvature())),
                    None => Box::new(rod),
                }
            }
        }
    }
}

fn check_beside_law(rod: &RodModel) -> Result<(), SceneProblem> {
    let extends = !matches!(rod.law, RodLaw::Constant | RodLaw::PublishedExtension);
    if rod.force_law == ForceLaw::PaperBalance && extends {
        return Err(SceneProblem::new(
            "filament.rod.force_law",
            "PaperBalance",
            "PaperBalance takes the laws Constant and PublishedExtension only: write one of these",
        ));
    }
    if let Some(name) = rod
        .law
        .whole()
        .filter(|_| rod.material != Material::default())
    {
        return Err(SceneProblem::new(
            "filament.rod.material",
            format!("{:?}", rod.material),
            format!(
                "the law {name} has a law for every deformation: omit the material, or write law: Constant"
            ),
        ));
    }
    Ok(())
}

fn refused(part: &'static str) -> impl Fn(RodParameterError) -> SceneProblem {
    move |error| {
        let key = format!("filament.rod.{part}.{}", error.key);
        let value = format!("{:?}", error.value);
        SceneProblem::new(key, value, format!("must be {}", error.rule))
    }
}

type Parts = (RodMaterial, Option<TwistStretch>);

/// Segments of a rod in a heat bath.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeatedSegments {
    pub(crate) segment_nm: f64,
    pub(crate) temperature_k: f64,
}

/// Potential of a law `Homogenised`. Without a bath, the law at 298 K is the free energy of the cells,
/// which contains all fluctuations up to 36 nm. Beyond the temperatures of the law
/// (`Homogenised::HEATED_RANGE_K`), the law at the nearest of them is used.
///
/// # Errors
/// The length of the segments, if it is too short.
pub(crate) fn potential(
    law: &RodLaw,
    monomers: &Monomers,
    heated: Option<HeatedSegments>,
) -> Result<&'static Homogenised, f64> {
    match (law, heated) {
        (RodLaw::HomogenisedAthermal, _) | (RodLaw::Homogenised, None) => {
            let bonds = monomers.sampled_bonds();
            Ok(bonds.map_or_else(Homogenised::mean_filament, Homogenised::sampled_filament))
        }
        (_, None) => Ok(Homogenised::mean_filament_at_298_k()),
        (law, Some(heated)) => {
            let [lowest, highest] = Homogenised::HEATED_RANGE_K;
            let temperature_k = if *law == RodLaw::HomogenisedAt298K {
                Homogenised::HEATED_K
            } else {
                heated.temperature_k.clamp(lowest, highest)
            };
            let potential = Homogenised::heated_rod(heated.segment_nm, temperature_k);
            potential.map_err(|error| error.value)
        }
    }
}

/// Rule for segments in a heat bath, without the remedy.
pub(crate) const TOO_SHORT: &str = "rods under the law Homogenised in a heat bath need segments of at least 5 nm: the monomers are 2.7 nm apart, \
    and the free energy of shorter segments is not convex";

fn too_short((i, section): (usize, &Section), segment_nm: f64) -> SceneProblem {
    let written = match section {
        Section::Rod { segments, .. } => segments.unwrap_or(1),
        Section::Ellipsoids { .. } => 1,
    };
    let length_nm = segment_nm * written as f64;
    let most = (length_nm / Homogenised::SHORTEST_HEATED_NM).floor();
    let (key, remedy) = if most >= 1.0 {
        (".segments", format!("write segments: {most} or fewer"))
    } else {
        ("", "make this section longer".to_owned())
    };
    SceneProblem::new(
        format!("filament.sections[{i}]{key}"),
        format!("segments of {segment_nm:.2} nm"),
        format!("{TOO_SHORT}; {remedy}, resolve monomers, or write law: HomogenisedAthermal"),
    )
}

fn published(material: RodMaterial, law: TwistStretch) -> Result<Parts, SceneProblem> {
    let twist = TwistLaw::Tanh(TanhTwist::published());
    let material = material.with_twist(twist).map_err(refused("law"))?;
    Ok((material, Some(law)))
}

fn with_laws(mut material: RodMaterial, laws: &RodLaws) -> Result<Parts, SceneProblem> {
    if let Some(bend) = laws.bend {
        material = (material.with_bend(bend.into())).map_err(refused("law.bend"))?;
    }
    if let Some(twist) = laws.twist {
        material = (material.with_twist(twist.into())).map_err(refused("law.twist"))?;
    }
    if let Some(stretch) = laws.stretch {
        material = (material.with_stretch(stretch)).map_err(refused("law.stretch"))?;
    }
    if let Some(shear) = laws.shear {
        material = (material.with_shear(shear.into())).map_err(refused("law.shear"))?;
    }
    let twist_stretch = laws.twist_stretch;
    if let Some(law) = &twist_stretch {
        law.validate().map_err(refused("law.twist_stretch"))?;
    }
    Ok((material, twist_stretch))
}

#[cfg(test)]
mod tests {
    use crate::Assembly;
    use crate::scene::Scene;

    fn build(segments: u32, law: &str, task: &str) -> Result<Assembly, String> {
        let sections = format!("[Rod(from_nm: 0.0, to_nm: 60.0, segments: {segments})]");
        build_sections(&sections, law, task)
    }

    fn build_sections(sections: &str, law: &str, task: &str) -> Result<Assembly, String> {
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: {sections},
                    rod: RodModel(law: {law}),
                ),
                task: {task},
            )"
        );
        let scene = Scene::from_ron(&text).map_err(|error| error.to_string())?;
        Assembly::build(&scene).map_err(|error| error.to_string())
    }

    const BATH: &str = "Dynamics(duration_ns: 1.0,
        drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
        thermal: (temperature_k: 298.0, seed: 1))";

    /// Tension of a straight rod of the length as built (pN).
    fn tension(assembly: &mut Assembly) -> f64 {
        -assembly.system.loads().force.get(0).z
    }

    #[test]
    fn short_segments_are_refused_in_a_bath() {
        for law in ["Homogenised", "HomogenisedAt298K"] {
            let error = build(24, law, BATH).unwrap_err();
            let begins = "filament.sections[0].segments = segments of 2.50 nm: rods under the law Homogenised in a heat bath \
                need segments of at least 5 nm";
            let remedy = "; write segments: 12 or fewer, resolve monomers, or write law: HomogenisedAthermal";
            assert!(error.contains(begins) && error.ends_with(remedy), "{error}");
            assert!(build(12, law, BATH).is_ok());
            assert!(build(24, law, "Equilibrium()").is_ok());
        }
        assert!(build(24, "HomogenisedAthermal", BATH).is_ok());
    }

    /// The remedies name the key that the user has written.
    #[test]
    fn remedies_are_possible() {
        let short = "[Rod(from_nm: 0.0, to_nm: 4.0), Rod(from_nm: 4.0, to_nm: 60.0)]";
        let error = build_sections(short, "Homogenised", BATH).unwrap_err();
        let begins = "filament.sections[0] = segments of 4.00 nm: rods under";
        assert!(error.contains(begins) && error.contains("; make this section longer, "));
        let follow = |segments: usize| {
            let sections = format!(
                "Following(length_nm: 200.0, segments: {segments}, monomers_where: [Curvature(above_per_nm: 0.01, below_per_nm: 0.005)])"
            );
            build_sections(&sections, "Homogenised", BATH)
        };
        let error = follow(8).unwrap_err();
        let begins = "filament.sections.segments = 8: in cells of";
        let (_, remedy) = error.split_once("; write segments: ").expect(&error);
        assert!(error.contains(begins), "{error}");
        let (most, _) = remedy.split_once(" or fewer").expect(remedy);
        assert!(follow(most.parse().unwrap()).is_ok(), "{error}");
    }

    /// Entropy shortens filaments: natural stretch of cells -4.40e-3, -4.67e-3, -4.92e-3 at 273, 298, 323 K
    /// (`cargo xtask homogenise heat --temperature T`), and a rigidity of 2.37e4 pN without twist.
    #[test]
    fn the_tension_grows_with_temperature() {
        let at = |kelvin: f64| {
            let bath = BATH.replace("298.0", &format!("{kelvin:?}"));
            tension(&mut build(2, "Homogenised", &bath).unwrap()).abs()
        };
        let [cold, room, warm] = [273.0, 298.0, 323.0].map(at);
        let slope = (warm - cold) / 50.0;
        assert!((slope / 0.244 - 1.0).abs() < 0.1, "{slope} pN/K");
        assert!((room - 0.5 * (cold + warm)).abs() < 1e-3 * room, "{room}");
        assert!((at(250.0) - cold).abs() < 1e-9 * cold);
    }

    /// Fluctuations of shorter segments supply a part of the tension.
    #[test]
    fn the_law_in_a_bath_depends_on_the_segments() {
        let [short, long] = [12, 2]
            .map(|segments| tension(&mut build(segments, "Homogenised", BATH).unwrap()).abs());
        assert!(short < 0.5 * long, "{short} {long}");
        let [a, b] = [12, 2].map(|segments| {
            tension(&mut build(segments, "HomogenisedAt298K", "Equilibrium()").unwrap())
        });
        assert!((a - b).abs() < 1e-9 * a.abs(), "{a} {b}");
    }
}
