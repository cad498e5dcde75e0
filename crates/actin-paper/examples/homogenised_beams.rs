//! What a rod would do that had the periodic cells' own response at every place, beside one under `Homogenised`.
//!
//! `cargo run --release -p actin-paper --example homogenised_beams`
//!
//! Where the two differ, the law does not follow its cells; where the cells' rod differs from filaments of monomers
//! (`docs/tables/load-cases.md`), ends do what no law of local strains can. The rods are integrated from the wall by the
//! midpoint rule, a step for each monomer; the couple at the wall is found by Newton's method. Neither has end shear.

use actin_cosserat::Homogenised;
use actin_mechanics::{Matrix3, UnitQuaternion, Vector3, rotation};
use actin_sim::ellipsoid::{
    Cell, CellResponse, Control, EllipsoidModel, EllipsoidParameters, Hold, SixMatrix, SixVector,
};
use rayon::prelude::*;

/// Rise per monomer (nm).
const RISE: f64 = 71.2 / 26.0;
/// Forces across (pN), and shares in which they are raised.
const ACROSS: [f64; 2] = [0.1, 0.5];
const SHARES: [f64; 3] = [0.25, 0.5, 1.0];
/// Residual of the far end's couple (pN nm), or of its turn times 100 pN nm.
const TOLERANCE: f64 = 1e-3;

fn main() -> Result<(), String> {
    let model = EllipsoidModel::new(EllipsoidParameters::default()).map_err(|e| e.to_string())?;
    let cell = Cell::new(&model, 13, Hold::Means).map_err(|e| e.to_string())?;
    let pulled = [1.0, 5.0, 10.0, 40.0].map(|tension| (false, 58.5, tension));
    let guided = [22.0, 33.0, 55.0].into_iter();
    let guided = guided.flat_map(|rises| [0.0, 5.0, 10.0].map(|tension| (true, rises, tension)));
    let beams = pulled.into_iter().chain(guided);
    let beams = beams.flat_map(|(is_guided, steps, tension)| {
        ACROSS.map(|across| Beam {
            is_guided,
            steps,
            force: Vector3::new(across, 0.0, tension),
        })
    });
    let beams: Vec<Beam> = beams.collect();
    println!("beam               tension  across (pN)   of cells  under the law (nm, nm/pN)");
    let lines = beams.par_iter().map(|beam| beam.line(&cell));
    for line in lines.collect::<Result<Vec<String>, String>>()? {
        println!("{line}");
    }
    Ok(())
}

/// What answers loads with strains, close to those of the call before.
trait Section {
    /// From rest again.
    fn reset(&mut self);
    /// The strains (rad/nm and 1) under a couple (pN nm) and a force (pN).
    fn strain(&mut self, loads: &SixVector) -> Result<SixVector, String>;
}

/// A cell of the mean filament.
struct OfCells<'a> {
    cell: &'a Cell,
    reached: Option<CellResponse>,
    loads: SixVector,
}

impl Section for OfCells<'_> {
    fn reset(&mut self) {
        (self.reached, self.loads) = (None, SixVector::zeros());
    }

    fn strain(&mut self, loads: &SixVector) -> Result<SixVector, String> {
        let (from, mut done, mut step) = (self.loads, 0.0, 1.0);
        while done < 1.0 {
            let next = f64::min(1.0, done + step);
            let now = from + (loads - from) * next;
            let controls: [Control; 6] = std::array::from_fn(|k| Control::Load(now[k]));
            match self.cell.relax_under(&controls, self.reached.as_ref()) {
                Ok(response) => {
                    (self.reached, done) = (Some(response), next);
                    step *= 2.0;
                }
                Err(error) if step < 1e-3 => return Err(format!("a cell under {now}: {error}")),
                Err(_) => step *= 0.5,
            }
        }
        self.loads = *loads;
        let strain = self.reached.as_ref().map(|response| response.strain);
        strain.ok_or_else(|| "no state".to_owned())
    }
}

/// The law, whose energy less the work of the loads is made least.
struct UnderLaw<'a> {
    law: &'a Homogenised,
    strain: SixVector,
}

impl Section for UnderLaw<'_> {
    fn reset(&mut self) {
        self.strain = SixVector::zeros();
    }

    fn strain(&mut self, loads: &SixVector) -> Result<SixVector, String> {
        let objective = |x: &SixVector| self.law.energy_density(x) - loads.dot(x);
        // In these units the strains have about the same stiffness.
        let units = SixVector::new(0.05, 0.05, 2.0, 1.0, 1.0, 1.0);
        let scale = SixMatrix::from_diagonal(&units);
        let mut x = self.strain;
        for _ in 0..400 {
            let jet = self.law.jet(&x);
            let slope = scale * (jet.loads - loads);
            if slope.amax() < 1e-9 {
                break;
            }
            let eigen = (scale * jet.tangent * scale).symmetric_eigen();
            let along = eigen.eigenvectors.tr_mul(&slope);
            let along = along.zip_map(&eigen.eigenvalues, |x, stiffness| {
                x / stiffness.abs().max(1e-3)
            });
            let step = scale * eigen.eigenvectors * along;
            let now = objective(&x) + 1e-14;
            let shares = (0..20).map(|k| 0.5_f64.powi(k));
            let Some(share) = shares
                .into_iter()
                .find(|share| objective(&(x - step * *share)) <= now)
            else {
                break;
            };
            x -= step * share;
        }
        self.strain = x;
        Ok(x)
    }
}

/// A straight rod along z from a wall, whose far end bears a force (pN) and is free or kept from turning.
struct Beam {
    is_guided: bool,
    /// Its length in rises.
    steps: f64,
    force: Vector3,
}

/// Place (nm), turn and couple (pN nm) of the far end.
type FarEnd = (Vector3, UnitQuaternion, Vector3);

impl Beam {
    /// What is printed of it.
    fn line(&self, cell: &Cell) -> Result<String, String> {
        let mut of_cells = OfCells {
            cell,
            reached: None,
            loads: SixVector::zeros(),
        };
        let mut under_law = UnderLaw {
            law: Homogenised::mean_filament(),
            strain: SixVector::zeros(),
        };
        let (across, tension) = (self.force.x, self.force.z);
        let (name, over) = if self.is_guided {
            ("guided", across)
        } else {
            ("cantilever", 1.0)
        };
        let (nm, a) = (self.steps * RISE, self.moved(&mut of_cells)? / over);
        let b = self.moved(&mut under_law)? / over;
        Ok(format!(
            "{name:10} {nm:4.0} nm {tension:8} {across:12} {a:10.4} {b:10.4} {:+6.1} %",
            100.0 * (b / a - 1.0)
        ))
    }

    /// How far the far end goes across (nm).
    fn moved(&self, section: &mut dyn Section) -> Result<f64, String> {
        let reach = if self.is_guided { 0.5 } else { 0.95 };
        let mut couple =
            Vector3::new(0.0, reach * self.steps * RISE * self.force.x, 0.0) * SHARES[0];
        let (mut moved, mut before) = (f64::NAN, SHARES[0]);
        for share in SHARES {
            couple *= share / before;
            before = share;
            let force = Vector3::new(share * self.force.x, 0.0, self.force.z);
            moved = self.solve(section, force, &mut couple)?;
        }
        Ok(moved)
    }

    /// Newton's method for the couple at the wall, from a guess.
    fn solve(
        &self,
        section: &mut dyn Section,
        force: Vector3,
        couple: &mut Vector3,
    ) -> Result<f64, String> {
        let mut off = |couple: Vector3| -> Result<(Vector3, Vector3), String> {
            let (place, turn, left) = self.integrate(section, force, couple)?;
            let off = if self.is_guided {
                100.0 * rotation::log(turn)
            } else {
                left
            };
            Ok((off, place))
        };
        for _ in 0..30 {
            let (now, place) = off(*couple)?;
            if now.norm() < TOLERANCE {
                return Ok(place.x);
            }
            let small = f64::max(0.01, 1e-4 * couple.norm());
            let mut slopes = Matrix3::zeros();
            for k in 0..3 {
                let (other, _) = off(*couple + Vector3::ith(k, small))?;
                slopes.set_column(k, &((other - now) / small));
            }
            let step = slopes.try_inverse().ok_or("no slope")? * now;
            let mut share = 1.0;
            while share > 0.05 && off(*couple - step * share)?.0.norm() >= now.norm() {
                share *= 0.5;
            }
            *couple -= step * share;
        }
        Err(format!(
            "no couple at the wall holds the beam under {force}"
        ))
    }

    fn integrate(
        &self,
        section: &mut dyn Section,
        force: Vector3,
        couple: Vector3,
    ) -> Result<FarEnd, String> {
        section.reset();
        let steps = self.steps.floor();
        let step = self.steps * RISE / steps;
        let (mut place, mut turn) = (Vector3::zeros(), UnitQuaternion::identity());
        let mut slopes = |place: Vector3, turn: UnitQuaternion| -> Result<[Vector3; 2], String> {
            let back = turn.inverse();
            let (m, n) = (back * (couple - place.cross(&force)), back * force);
            let loads = SixVector::new(m.x, m.y, m.z, n.x, n.y, n.z);
            let [k1, k2, k3, s1, s2, s3]: [f64; 6] = section.strain(&loads)?.into();
            Ok([
                Vector3::new(k1, k2, k3),
                turn * Vector3::new(s1, s2, 1.0 + s3),
            ])
        };
        let mut done = 0.0;
        while done < steps {
            let [bent, along] = slopes(place, turn)?;
            let middle = turn * rotation::exp(bent * (0.5 * step));
            let [bent, along] = slopes(place + along * (0.5 * step), middle)?;
            place += along * step;
            turn *= rotation::exp(bent * step);
            done += 1.0;
        }
        Ok((place, turn, couple - place.cross(&force)))
    }
}
