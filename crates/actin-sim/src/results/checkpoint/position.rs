//! States, records and positions of a run as bytes.

use super::Damage;
use super::bytes::{Reader, Writer};
use crate::run::{Arrival, At, MotionPosition, PathPosition, Record, RunPosition, SaddlePush};
use actin_equilibrium::{Certificate, SolverWork, Waypoint};
use actin_integrate::{Checkpoint, Mark};
use actin_mechanics::{Motion, State};

const MOTION: u64 = 1;
const PATH: u64 = 2;

/// Bytes of a push.
const PUSH: usize = 48;

/// What moves, array by array.
fn arrays(motion: &Motion) -> [&[f64]; 15] {
    let (x, v) = (&motion.position, &motion.velocity);
    let (q, l) = (&motion.orientation, &motion.angular_momentum);
    let time = std::slice::from_ref(&motion.time);
    let controls = &motion.controls;
    [
        &x.x, &x.y, &x.z, &v.x, &v.y, &v.z, &q.w, &q.x, &q.y, &q.z, &l.x, &l.y, &l.z, time,
        controls,
    ]
}

fn arrays_mut(motion: &mut Motion) -> [&mut [f64]; 15] {
    let (x, v) = (&mut motion.position, &mut motion.velocity);
    let (q, l) = (&mut motion.orientation, &mut motion.angular_momentum);
    let time = std::slice::from_mut(&mut motion.time);
    let controls = &mut motion.controls;
    [
        &mut x.x, &mut x.y, &mut x.z, &mut v.x, &mut v.y, &mut v.z, &mut q.w, &mut q.x, &mut q.y,
        &mut q.z, &mut l.x, &mut l.y, &mut l.z, time, controls,
    ]
}

fn write_motion(writer: &mut Writer, motion: &Motion) {
    for array in arrays(motion) {
        writer.numbers(array);
    }
}

/// Reads a motion of as many bodies as in `like`.
fn read_motion(reader: &mut Reader<'_>, like: &State) -> Result<Motion, Damage> {
    let mut motion = like.motion();
    for array in arrays_mut(&mut motion) {
        reader.numbers(array)?;
    }
    Ok(motion)
}

/// Bytes of a record of a run with `terms` energies.
pub(super) fn record_length(like: &State, terms: usize) -> usize {
    let motion: usize = arrays(&like.motion()).iter().map(|array| array.len()).sum();
    1 + 8 * (4 + terms + motion)
}

pub(super) fn write_record(writer: &mut Writer, record: &Record) {
    let Record {
        at,
        state,
        energies_pn_nm,
        kinetic_pn_nm,
        residual_force_pn,
        residual_torque_pn_nm,
    } = record;
    writer.flag(at.path().is_some());
    writer.numbers(&[
        at.value(),
        *kinetic_pn_nm,
        *residual_force_pn,
        *residual_torque_pn_nm,
    ]);
    writer.numbers(energies_pn_nm);
    write_motion(writer, &state.motion());
}

pub(super) fn read_record(
    reader: &mut Reader<'_>,
    like: &State,
    terms: usize,
) -> Result<Record, Damage> {
    let at = if reader.flag()? { At::Path } else { At::Time };
    let mut numbers = [0.0; 4];
    reader.numbers(&mut numbers)?;
    let [
        value,
        kinetic_pn_nm,
        residual_force_pn,
        residual_torque_pn_nm,
    ] = numbers;
    let mut energies_pn_nm = vec![0.0; terms];
    reader.numbers(&mut energies_pn_nm)?;
    Ok(Record {
        at: at(value),
        state: like.in_motion(read_motion(reader, like)?),
        energies_pn_nm,
        kinetic_pn_nm,
        residual_force_pn,
        residual_torque_pn_nm,
    })
}

pub(super) fn write_position(writer: &mut Writer, position: &RunPosition) {
    match position {
        RunPosition::Motion(position) => {
            let MotionPosition { checkpoint, pushes } = position.as_ref();
            writer.count(MOTION);
            write_mark(writer, &checkpoint.here);
            write_mark(writer, &checkpoint.last_good);
            writer.count(checkpoint.evaluations_before);
            writer.size(pushes.len());
            for push in pushes {
                write_push(writer, push);
            }
        }
        RunPosition::Path(position) => {
            writer.count(PATH);
            write_path(writer, position);
        }
    }
}

pub(super) fn read_position(reader: &mut Reader<'_>, like: &State) -> Result<RunPosition, Damage> {
    match reader.count()? {
        MOTION => Ok(RunPosition::Motion(Box::new(MotionPosition {
            checkpoint: Checkpoint {
                here: read_mark(reader, like)?,
                last_good: read_mark(reader, like)?,
                evaluations_before: reader.count()?,
            },
            pushes: reader.list(PUSH, read_push)?,
        }))),
        PATH => read_path(reader, like).map(|position| RunPosition::Path(Box::new(position))),
        other => Err(Damage::Contents(format!("a task of kind {other}"))),
    }
}

fn write_push(writer: &mut Writer, push: &SaddlePush) {
    writer.numbers(&[push.time_ns, push.energy_pn_nm]);
    writer.size(push.negative_eigenvalues);
    writer.numbers(&[push.lowest_eigenvalue, push.displacement_nm, push.turn_rad]);
}

fn read_push(reader: &mut Reader<'_>) -> Result<SaddlePush, Damage> {
    Ok(SaddlePush {
        time_ns: reader.number()?,
        energy_pn_nm: reader.number()?,
        negative_eigenvalues: reader.size()?,
        lowest_eigenvalue: reader.number()?,
        displacement_nm: reader.number()?,
        turn_rad: reader.number()?,
    })
}

fn write_mark(writer: &mut Writer, mark: &Mark) {
    writer.count(mark.step);
    write_motion(writer, &mark.motion);
    writer.flag(mark.loads_are_current);
    writer.count(mark.force_evaluations);
    writer.number(mark.largest_kinetic);
}

fn read_mark(reader: &mut Reader<'_>, like: &State) -> Result<Mark, Damage> {
    Ok(Mark {
        step: reader.count()?,
        motion: read_motion(reader, like)?,
        loads_are_current: reader.flag()?,
        force_evaluations: reader.count()?,
        largest_kinetic: reader.number()?,
    })
}

fn write_path(writer: &mut Writer, position: &PathPosition) {
    writer.size(position.stage);
    writer.optional(position.waypoint.as_ref(), write_waypoint);
    write_motion(writer, &position.motion);
    writer.size(position.points);
    writer.size(position.saddles_left);
    writer.size(position.jumps);
    writer.optional(position.last.as_ref(), write_arrival);
    let work = &position.work;
    for count in [
        work.iterations,
        work.evaluations,
        work.assemblies,
        work.factorizations,
        work.symbolic_factorizations,
        work.factor_entries,
    ] {
        writer.count(count);
    }
}

fn read_path(reader: &mut Reader<'_>, like: &State) -> Result<PathPosition, Damage> {
    Ok(PathPosition {
        stage: reader.size()?,
        waypoint: reader.optional(|reader| read_waypoint(reader, like))?,
        motion: read_motion(reader, like)?,
        points: reader.size()?,
        saddles_left: reader.size()?,
        jumps: reader.size()?,
        last: reader.optional(read_arrival)?,
        work: SolverWork {
            iterations: reader.count()?,
            evaluations: reader.count()?,
            assemblies: reader.count()?,
            factorizations: reader.count()?,
            symbolic_factorizations: reader.count()?,
            factor_entries: reader.count()?,
        },
    })
}

fn write_waypoint(writer: &mut Writer, waypoint: &Waypoint) {
    writer.number(waypoint.parameter);
    writer.number(waypoint.step);
    writer.optional(waypoint.previous.as_ref(), |writer, (motion, parameter)| {
        write_motion(writer, motion);
        writer.number(*parameter);
    });
    writer.optional(waypoint.rate, Writer::number);
    writer.size(waypoint.points);
    writer.size(waypoint.refused);
}

fn read_waypoint(reader: &mut Reader<'_>, like: &State) -> Result<Waypoint, Damage> {
    Ok(Waypoint {
        parameter: reader.number()?,
        step: reader.number()?,
        previous: reader.optional(|reader| Ok((read_motion(reader, like)?, reader.number()?)))?,
        rate: reader.optional(Reader::number)?,
        points: reader.size()?,
        refused: reader.size()?,
    })
}

fn write_arrival(writer: &mut Writer, arrival: &Arrival) {
    writer.optional(arrival.certificate, |writer, certificate| {
        writer.size(certificate.negative);
        writer.size(certificate.unresolved);
        writer.number(certificate.resolution);
        writer.size(certificate.negative_pivots);
    });
    writer.optional(arrival.floor, |writer, (force, torque)| {
        writer.numbers(&[force, torque]);
    });
    writer.size(arrival.history.len());
    for &(force, torque) in &arrival.history {
        writer.numbers(&[force, torque]);
    }
}

fn read_arrival(reader: &mut Reader<'_>) -> Result<Arrival, Damage> {
    let certificate = reader.optional(|reader| {
        Ok(Certificate {
            negative: reader.size()?,
            unresolved: reader.size()?,
            resolution: reader.number()?,
            negative_pivots: reader.size()?,
        })
    })?;
    let floor = reader.optional(|reader| Ok((reader.number()?, reader.number()?)))?;
    let history = reader.list(16, |reader| Ok((reader.number()?, reader.number()?)))?;
    Ok(Arrival {
        certificate,
        floor,
        history,
    })
}
