//! Construction of the bodies and interactions of a scene, filament by filament.

mod bend;
mod holds;
mod interactions;
mod linkers;
mod loads;
mod repulsion;
mod sampled;
mod size;
mod spans;
mod strand;

use super::{
    Assembly, Clamped, Drive, FilamentSpan, FrameInfo, InterfaceSampling, Kinetics, Part,
    PointInfo, RepulsionModel, Rod, SectionSpan, SiteTable, Term, energy_balance, imperfection,
};
use crate::cells::Cells;
use crate::scene::{ClampedEnds, End, Filament, Load, Scene, SceneProblem, Section};
use actin_coupling::{Linker, PeriodicCell, Site};
use actin_mechanics::{ControlId, Interaction, State, System};

use sampled::Sampling;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;
use std::time::Instant;
use strand::{Body, Strand};

impl Assembly {
    /// Builds the bodies (in filament order), interactions, held ends and loads of a scene.
    ///
    /// Filaments with an imperfection start displaced from their axis. The displacement and its
    /// slope vanish at both ends and do not depend on the resolution:
    ///
    /// ```text
    /// u(s) = A sum_{k=1..4} sin(pi x) sin(k pi x) d_k / k^2
    /// x    = s / L    arc length over the length of the filament
    /// d_k             random directions across the axis
    /// A    (nm)       factor such that max |u| is the amplitude
    /// ```
    ///
    /// Automatic sections are chosen first. Sections that follow a motion
    /// start as rods.
    ///
    /// # Errors
    /// As [`Scene::validate`]; if a section is too short for its bodies, an interface finds no bonds, or the bodies exceed
    /// the memory of this machine.
    pub fn build(scene: &Scene) -> Result<Self, SceneProblem> {
        let began = Instant::now();
        // Scenes written in Rust have passed no reader.
        scene.validate()?;
        let mut built = Self::resolve_and_build(scene)?;
        built.build_s = began.elapsed().as_secs_f64();
        Ok(built)
    }

    fn resolve_and_build(scene: &Scene) -> Result<Self, SceneProblem> {
        let mut filaments = scene.filaments();
        if let Some(filament) = filaments.position(|one| one.sections.adaptive().is_some()) {
            let key = format!("{}.sections", scene.filament_key(filament));
            let rule = "must be chosen before the scene is built: use `actin_sim::build`";
            return Err(SceneProblem::new(key, "Adaptive(..)", rule));
        }
        if let Some(following) = scene.filament.sections.following() {
            let cells = Cells::new(scene, following)?;
            let rod = vec![false; cells.count()];
            let mut built = Self::build(&cells.scene(scene, &rod))?;
            let sections = &mut built.scene.filament.sections;
            *sections = std::mem::take(sections).with_following(following.clone());
            return Ok(built);
        }
        let mut builder = Builder::new(scene)?;
        builder.push_filaments()?;
        builder.hold_ends()?;
        builder.push_loads()?;
        builder.push_linkers()?;
        builder.push_beads()?;
        builder.push_repulsion()?;
        let assembly = builder.finish();
        assembly.check_repulsion()?;
        Ok(assembly)
    }
}

#[derive(Default)]
struct SceneParts {
    state: State,
    points: Vec<PointInfo>,
    frames: Vec<FrameInfo>,
    sections: Vec<SectionSpan>,
    interactions: Vec<Box<dyn Interaction>>,
    terms: Vec<Term>,
    rods: Vec<Rod>,
}

impl SceneParts {
    fn push_term(&mut self, interaction: Box<dyn Interaction>, part: Part) {
        let name = interaction.term();
        self.terms.push(Term { name, part });
        self.interactions.push(interaction);
    }
}

struct Builder<'a> {
    scene: &'a Scene,
    /// Estimated memory.
    bytes: f64,
    held: ClampedEnds,
    strands: Vec<Strand<'a>>,
    filaments: Vec<FilamentSpan>,
    stock: SceneParts,
    clamps: Vec<Clamped>,
    loads: Vec<ControlId>,
    cell: Option<PeriodicCell>,
    linkers: Vec<Linker>,
    beads: Vec<(Site, f64)>,
    kinetics: Option<Kinetics>,
    /// Tables of roaming linkers by the distance of sites and the direction of steps.
    site_tables: HashMap<(u64, bool, u64), SiteTable>,
    repelled: Option<RepulsionModel>,
    sampled: Vec<InterfaceSampling>,
}

impl<'a> Builder<'a> {
    fn new(scene: &'a Scene) -> Result<Self, SceneProblem> {
        let held = ClampedEnds::new(scene);
        let bath_k = scene.thermal().map(|thermal| thermal.temperature_k);
        let mut first_section = 0;
        let mut couples = couples_nm(scene);
        let mut strands = Vec::new();
        for (i, filament) in scene.filaments().enumerate() {
            let clamps = [End::Start, End::End].map(|end| {
                let clamp = held.clamp_at(i, end)?;
                Some(&scene.clamps[clamp])
            });
            let ends = (clamps, couples.remove(&i).unwrap_or_default());
            let strand = Strand::new((i, filament), ends, first_section, bath_k);
            strands.push(strand.map_err(|p| p.with_filament(&scene.filament_key(i)))?);
            first_section += filament.sections.len();
        }
        let bytes = size::check(scene, &strands)?;
        Ok(Self {
            scene,
            bytes,
            held,
            strands,
            filaments: Vec::new(),
            stock: SceneParts::default(),
            clamps: Vec::new(),
            loads: Vec::new(),
            cell: None,
            linkers: Vec::new(),
            beads: Vec::new(),
            kinetics: None,
            site_tables: HashMap::new(),
            repelled: None,
            sampled: Vec::new(),
        })
    }

    /// Pushes straight, unstrained bodies of all filaments and their interactions; then bends
    /// curved filaments.
    fn push_filaments(&mut self) -> Result<(), SceneProblem> {
        let scene = self.scene;
        for (i, strand) in self.strands.iter_mut().enumerate() {
            let span = strand.push_bodies(&mut self.stock);
            let span = span.map_err(|p| p.with_filament(&scene.filament_key(i)))?;
            self.filaments.push(span);
        }
        for (i, strand) in self.strands.iter().enumerate() {
            let first = self.stock.terms.len();
            let chains = match Sampling::from_task(&scene.task) {
                Some(sampling) => strand.sample(sampling).map(|(chains, sampled)| {
                    self.sampled.extend(sampled);
                    chains
                }),
                None => Ok(Vec::new()),
            };
            let chains = chains.map_err(|p| p.with_filament(&scene.filament_key(i)))?;
            let pushed = strand.push_interactions(&chains, &mut self.stock);
            pushed.map_err(|p| p.with_filament(&scene.filament_key(i)))?;
            self.filaments[i].terms = first..self.stock.terms.len();
        }
        for (strand, span) in self.strands.iter_mut().zip(&mut self.filaments) {
            let bent = strand.bend(span.frames.clone(), &mut self.stock);
            let key = scene.filament_key(strand.index);
            bent.map_err(|p| p.with_filament(&key))?;
            span.shape.clone_from(&strand.built);
        }
        Ok(())
    }

    fn finish(mut self) -> Assembly {
        let scene = self.resolved_scene();
        let spans = self.spans();
        let drive = self.drive(&scene);
        drive.place(&mut self.stock.state, 0.0);
        let energy_balance = energy_balance::of_motion(&scene.task, &mut self.stock.state);
        let mut stock = self.stock;
        let rest = stock.state.clone();
        let bodies = (stock.points.as_slice(), stock.frames.as_slice());
        imperfection::displace(&scene, &self.filaments, bodies, &mut stock.state);
        Assembly {
            drive,
            scene,
            bytes: self.bytes,
            rest,
            system: System::new(stock.state, stock.interactions),
            terms: stock.terms,
            points: stock.points,
            frames: stock.frames,
            sections: stock.sections,
            filaments: self.filaments,
            rods: stock.rods,
            clamps: self.clamps,
            held: self.held,
            loads: self.loads,
            cell: self.cell,
            linkers: self.linkers,
            beads: self.beads,
            kinetics: self.kinetics.map(Arc::new),
            energy_balance,
            repelled: self.repelled,
            sampled: self.sampled,
            spans,
            chosen: None,
            is_started: false,
            build_s: 0.0,
        }
    }

    fn drive(&self, scene: &Scene) -> Drive {
        let strain = self.cell.map(|cell| cell.factor);
        Drive::new(
            scene,
            (&self.held, &self.clamps),
            (&self.loads, strain, &self.linkers),
            &self.stock.state,
        )
    }

    fn resolved_scene(&self) -> Scene {
        let mut scene = self.scene.clone();
        let sections = scene.filaments_mut().flat_map(|f| f.sections.iter_mut());
        for (section, span) in sections.zip(&self.stock.sections) {
            if let Section::Rod { segments, .. } = section {
                *segments = Some(span.frames.len());
            }
        }
        scene
    }
}

fn couples_nm(scene: &Scene) -> BTreeMap<usize, Vec<f64>> {
    let mut all: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for load in &scene.loads {
        let Load::Couple(couple) = load else { continue };
        let length = |filament: &Filament| filament.length_nm();
        let place = match couple.end {
            Some(End::Start) => Some(0.0),
            Some(End::End) => scene.filament_at(couple.filament).map(length),
            None => couple.at_nm,
        };
        all.entry(couple.filament).or_default().extend(place);
    }
    all
}
