//! Scenes of the schematics, solved.

use crate::run::run_to_end;
use crate::workspace_root;
use actin_draw::report::Row;
use actin_sim::{Assembly, BodyKind, Scene};

/// A scene in its equilibrium.
#[derive(Debug)]
pub(super) struct Solved {
    /// Its file under `scenarios/`, without its ending.
    pub name: &'static str,
    /// The system stands in the equilibrium.
    pub assembly: Assembly,
    residual_pn: f64,
    residual_pn_nm: f64,
    stable: bool,
}

impl Solved {
    /// Reads a scene and finds its equilibrium.
    pub(super) fn new(name: &'static str) -> Result<Self, String> {
        let path = workspace_root().join("scenarios").join(name);
        let path = path.with_extension("ron");
        let fail = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = std::fs::read_to_string(&path).map_err(|e| fail(&e))?;
        let scene =
            Scene::from_ron(&text).map_err(|error| format!("{}:{error}", path.display()))?;
        let mut assembly = Assembly::build(&scene).map_err(|e| fail(&e))?;
        let (trajectory, report) = run_to_end(&mut assembly).map_err(|e| fail(&e))?;
        let last = trajectory.records.last();
        let last = last.ok_or_else(|| fail(&"no record"))?;
        let report = report.equilibrium;
        let counts = report.ok_or_else(|| fail(&"no certificate"))?.certificate;
        Ok(Self {
            name,
            residual_pn: last.residual_force_pn,
            residual_pn_nm: last.residual_torque_pn_nm,
            stable: counts.negative + counts.unresolved == 0,
            assembly,
        })
    }

    /// Radius and rise of the helix in the present state, taken as if it were straight.
    ///
    /// With `a` the distance from i to i + 1 and `b` from i to i + 2 of a helix of radius `R`, rise
    /// `z` and turn `t`, `a^2 = z^2 + 4 R^2 sin^2(t/2)` and `b^2 = 4 z^2 + 4 R^2 sin^2 t`;
    /// both squares are means over the monomers.
    pub(super) fn radius_and_rise_nm(&self) -> (f64, f64) {
        let state = self.assembly.system.state();
        let points = self.assembly.points.iter().enumerate();
        let monomers = points.filter(|(_, info)| info.kind == BodyKind::Monomer);
        let centres: Vec<_> = monomers
            .map(|(i, _)| state.points.position.get(i))
            .collect();
        let mean_square = |step: usize| {
            let pairs = centres.iter().zip(&centres[step..]);
            let sum: f64 = pairs.map(|(p, q)| (q - p).norm_squared()).sum();
            sum / (centres.len() - step) as f64
        };
        let turn = self.assembly.scene.filament.monomers.turn_deg.to_radians();
        let across = |angle: f64| 4.0 * (0.5 * angle).sin().powi(2);
        let (one, two) = (across(turn), across(2.0 * turn));
        let (a, b) = (mean_square(1), mean_square(2));
        let radius_square = (4.0 * a - b) / (4.0 * one - two);
        let rise_square = a - one * radius_square;
        (radius_square.sqrt(), rise_square.sqrt())
    }

    /// Numbers of what is drawn.
    pub(super) fn counts(&self, id: &'static str) -> Vec<Row> {
        let counts = self.assembly.counts();
        let name = self.name.rsplit('/').next().unwrap_or(self.name);
        let row = |quantity: &str, number: usize| {
            let note = "in the scene that is drawn";
            Row::measured(id, format!("{name}/{quantity}"), "", number as f64, note)
        };
        vec![
            row("monomers", counts.monomers),
            row("bonds", counts.bonds),
            row("segments", counts.segments),
            row("junctions", counts.junctions),
        ]
    }
}

/// Seeds of the bonds that the scenes name.
fn seeds(solved: &[Solved]) -> String {
    let seeds = solved
        .iter()
        .map(|s| s.assembly.scene.filament.monomers.seed);
    let unique: std::collections::BTreeSet<u64> = seeds.collect();
    let words: Vec<String> = unique.iter().map(u64::to_string).collect();
    words.join(", ")
}

/// How a figure's states were found.
pub(super) fn settings(solved: &[Solved]) -> String {
    let names: Vec<String> = solved.iter().map(|s| format!("{}.ron", s.name)).collect();
    let worst = |pick: fn(&Solved) -> f64| solved.iter().map(pick).fold(0.0, f64::max);
    let stable = solved.iter().filter(|s| s.stable).count();
    format!(
        "Scenes scenarios/: {}. Each is drawn in its equilibrium: every force below {:.1e} pN, every \
         torque below {:.1e} pN nm, {stable} of {} certified stable. Places, orientations, semi-axes \
         and ends of bonds are those of the state; the scale bar holds at the middle of the scene. \
         Seed of the bonds: {}.",
        names.join(", "),
        worst(|s| s.residual_pn),
        worst(|s| s.residual_pn_nm),
        solved.len(),
        seeds(solved),
    )
}
