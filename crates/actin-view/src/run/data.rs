//! Data for the script of the page.
//!
//! Arrays are little-endian, in base64. Each record contains:
//!
//! | data | type |
//! |---|---|
//! | positions of all points (nm) | f32 |
//! | orientations of all frames (w, x, y, z), in units of 1/32767 | i16 |
//! | linkers, clamps and forces | f32 |
//! | fields at all points, scaled to their range over all records | u16 |

use super::{Curve, Run};
use crate::outlines;
use crate::pose::{Bonds, PLATE_NM, bodies, share};
use actin_sim::mechanics::{Loads, State, Vector3};
use actin_sim::shape::ProfilePoint;
use actin_sim::{Assembly, At, Part};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

const FIELDS: usize = 6;
/// Largest number of monomers with bonds on the page; each takes 500 bytes.
const MOST_WITH_BONDS: usize = 1000;

pub(super) fn bytes_per_record(assembly: &Assembly) -> usize {
    let besides =
        8 * assembly.linkers.len() + 12 * assembly.clamps.len() + 6 * assembly.scene.loads.len();
    (12 + 2 * FIELDS) * assembly.points.len() + 8 * assembly.frames.len() + 4 * besides + 1
}

impl Run {
    pub(super) fn data(&self) -> Value {
        let Self {
            assembly, states, ..
        } = self;
        let unit = match self.at.first() {
            Some(At::Time(_)) => "ns",
            _ => "",
        };
        let (strands, rods, bonds) = sections(assembly);
        json!({
            "unit": unit,
            "at": self.at.iter().map(|at| at.value()).collect::<Vec<_>>(),
            "record": self.which,
            "records": self.records,
            "points": assembly.points.len(),
            "frames": assembly.frames.len(),
            "filaments": assembly.filaments.len(),
            "spans": assembly.filaments.iter().map(|f| &f.points).collect::<Vec<_>>(),
            "arcs": floats(assembly.points.iter().map(|p| p.s_nm)),
            "strands": strands,
            "rods": rods,
            "bonds": bonds,
            "junctions": assembly.junction_bonds().iter().map(|b| [b.monomer, b.node]).collect::<Vec<_>>(),
            "places": floats(states.iter().flat_map(|s| flat(s.points.position.iter()))),
            "turns": turns(states),
            "linkers": floats(states.iter().flat_map(|s| linkers(assembly, s))),
            "anchored": (0..assembly.linkers.len()).map(|i| assembly.linked_to(i).is_none()).collect::<Vec<_>>(),
            "clamps": floats(states.iter().flat_map(|s| {
                bodies::plates(assembly, s, PLATE_NM).into_iter().flatten().flat_map(|v| [v.x, v.y, v.z])
            })),
            "held": assembly.clamps.len(),
            "forces": states.iter().map(|s| forces(assembly, s)).collect::<Vec<_>>(),
            "walls": outlines::walls(assembly).into_iter().map(rounded).collect::<Vec<_>>(),
            "box": states.iter().map(|s| rounded(outlines::periodic_box(assembly, s))).collect::<Vec<_>>(),
            "beads": states.iter().map(|s| beads(assembly, s)).collect::<Vec<_>>(),
            "fields": fields(self),
            "curves": self.curves.iter().map(curve).collect::<Vec<_>>(),
        })
    }
}

fn sections(assembly: &Assembly) -> (Vec<Value>, Vec<Value>, Vec<Bonds>) {
    let (mut strands, mut rods, mut bonds) = (Vec::new(), Vec::new(), Vec::new());
    let with_bonds = assembly.counts().monomers <= MOST_WITH_BONDS;
    for (i, section) in assembly.sections.iter().enumerate() {
        let filament = assembly.filament_of_section(i);
        let own = (&section.points, &section.frames);
        let Some((first, per_interface, drawn)) = Bonds::from_section(assembly, i) else {
            rods.push(json!({
                "radius": bodies::rod_radius_nm(), "points": own.0, "frames": own.1, "filament": filament,
            }));
            continue;
        };
        strands.push(json!({
            "lengths": assembly.monomers_of(filament).semi_axes_nm, "points": own.0, "frames": own.1,
            "filament": filament, "first": first, "per_interface": per_interface,
            "bonds": with_bonds.then(|| share(&mut bonds, drawn)),
        }));
    }
    (strands, rods, bonds)
}

fn flat(vectors: impl Iterator<Item = Vector3>) -> impl Iterator<Item = f64> {
    vectors.flat_map(|v| [v.x, v.y, v.z])
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "single precision is sufficient for display"
)]
fn floats(values: impl Iterator<Item = f64>) -> String {
    let bytes: Vec<u8> = values.flat_map(|x| (x as f32).to_le_bytes()).collect();
    STANDARD.encode(bytes)
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "components of unit quaternions"
)]
fn turns(states: &[State]) -> String {
    let all = states.iter().flat_map(|s| s.frames.orientation.iter());
    let components = all.flat_map(|q| [q.w, q.i, q.j, q.k]);
    let bytes = components.flat_map(|x| ((x * 32767.0).round() as i16).to_le_bytes());
    STANDARD.encode(bytes.collect::<Vec<u8>>())
}

/// Returns both ends, the state and the tension (pN) of each linker.
fn linkers(assembly: &Assembly, state: &State) -> Vec<f64> {
    let all = 0..assembly.linkers.len();
    all.flat_map(|i| {
        let ([a, b], holds) = assembly.linker_ends(i, state);
        let pull = assembly.linker_pull_pn(i, state);
        let holds = f64::from(u8::from(holds));
        [a.x, a.y, a.z, b.x, b.y, b.z, holds, pull]
    })
    .collect()
}

fn forces(assembly: &Assembly, state: &State) -> Vec<[f64; 6]> {
    let all = bodies::forces(assembly, state).into_iter();
    all.map(|(p, f)| [p.x, p.y, p.z, f.x, f.y, f.z].map(|x| (x * 1e4).round() / 1e4))
        .collect()
}

/// Returns the corners of a line (nm).
fn rounded(line: Vec<Vector3>) -> Vec<[f64; 3]> {
    line.into_iter()
        .map(|p| [p.x, p.y, p.z].map(|x| (x * 1e2).round() / 1e2))
        .collect()
}

/// Returns the centre and the radius of each bead (nm).
fn beads(assembly: &Assembly, state: &State) -> Vec<[f64; 4]> {
    let all = assembly.beads_in(state).into_iter();
    all.map(|(p, radius)| [p.x, p.y, p.z, radius].map(|x| (x * 1e2).round() / 1e2))
        .collect()
}

struct Field {
    name: &'static str,
    unit: &'static str,
    /// True for a colour scale centred at zero.
    is_signed: bool,
    values: Vec<f64>,
}

fn fields(run: &Run) -> Vec<Value> {
    let field = |name, unit, is_signed| Field {
        name,
        unit,
        is_signed,
        values: Vec::new(),
    };
    let mut all = [
        field("curvature", "rad/µm", false),
        field("excess twist", "rad/µm", true),
        field("elastic energy per length", "pN", false),
        field("tension", "pN", true),
        field("shear force", "pN", false),
        field("bending moment", "pN nm", false),
        field("torque", "pN nm", true),
        field("displacement from the first record", "nm", false),
        field("force of loads, linkers and contacts", "pN", false),
        field("force of contacts", "pN", false),
    ];
    for state in &run.states {
        let moved = moved(&run.assembly, &run.states[0], state);
        let forces = external_forces(&run.assembly, state);
        let local = local(&run.assembly, state).into_iter();
        for ((local, moved), forces) in local.zip(moved).zip(forces) {
            for (field, value) in all
                .iter_mut()
                .zip(local.into_iter().chain([moved]).chain(forces))
            {
                field.values.push(value);
            }
        }
    }
    all.into_iter().filter_map(Field::encoded).collect()
}

/// Returns curvature and excess twist (rad/µm), energy per length (pN), tension, shear force (pN), bending moment and
/// torque (pN nm) at each point.
fn local(assembly: &Assembly, state: &State) -> Vec<[f64; 7]> {
    let mut all = Vec::with_capacity(assembly.points.len());
    for (i, span) in assembly.filaments.iter().enumerate() {
        let profile = actin_sim::shape::profile_of(assembly, i, state);
        for point in &assembly.points[span.points.clone()] {
            let next = profile.partition_point(|p| p.s_nm < point.s_nm);
            let next = next.clamp(1, profile.len() - 1);
            let [a, b] = [&profile[next - 1], &profile[next]];
            let share = ((point.s_nm - a.s_nm) / (b.s_nm - a.s_nm)).clamp(0.0, 1.0);
            let mix = |value: fn(&ProfilePoint) -> f64| value(a) + share * (value(b) - value(a));
            all.push([
                1e3 * mix(|p| p.curvature_rad_per_nm),
                1e3 * mix(|p| p.twist_rad_per_nm),
                mix(|p| p.energy_per_length_pn),
                mix(|p| p.load.tension_pn()),
                mix(|p| p.load.shear_pn()),
                mix(|p| p.load.bending_moment_pn_nm()),
                mix(|p| p.load.torque_pn_nm()),
            ]);
        }
    }
    all
}

/// Returns the norms of the force of loads, linkers and contacts, and of the force of contacts alone (pN), at each point.
fn external_forces(assembly: &Assembly, state: &State) -> Vec<[f64; 2]> {
    let (mut all, mut contacts) = (Loads::zeros(state), Loads::zeros(state));
    for (term, interaction) in assembly.terms.iter().zip(assembly.system.interactions()) {
        match term.part {
            Part::Load(_) | Part::Linker(_) => interaction.add_loads(state, &mut all),
            Part::Contacts | Part::Wall(_) => {
                interaction.add_loads(state, &mut all);
                interaction.add_loads(state, &mut contacts);
            }
            Part::Section(_) | Part::Junction(_) | Part::Clamp(_) => {}
        }
    }
    let both = all.force.iter().zip(contacts.force.iter());
    both.map(|(all, contacts)| [all.norm(), contacts.norm()])
        .collect()
}

fn moved<'a>(
    assembly: &'a Assembly,
    first: &'a State,
    state: &'a State,
) -> impl Iterator<Item = f64> + 'a {
    let points = 0..assembly.points.len();
    points.map(|i| (state.points.position.get(i) - first.points.position.get(i)).norm())
}

impl Field {
    /// Returns the field as JSON; `None` if it is zero up to round-off.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and 65535"
    )]
    fn encoded(self) -> Option<Value> {
        let high = self
            .values
            .iter()
            .fold(0.0, |most: f64, v| most.max(v.abs()));
        if high < 1e-9 {
            return None;
        }
        let low = if self.is_signed { -high } else { 0.0 };
        let step = |v: &f64| (65535.0 * (v - low) / (high - low)).round() as u16;
        let bytes: Vec<u8> = self
            .values
            .iter()
            .flat_map(|v| step(v).to_le_bytes())
            .collect();
        Some(json!({
            "name": self.name, "unit": self.unit, "low": low, "high": high, "signed": self.is_signed,
            "values": STANDARD.encode(bytes),
        }))
    }
}

fn curve(curve: &Curve) -> Value {
    json!({
        "name": curve.name,
        "at": floats(curve.at.iter().copied()),
        "values": floats(curve.values.iter().copied()),
    })
}
