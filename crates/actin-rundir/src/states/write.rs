//! Writing of `states.npz`.

use crate::finite::ensure_finite_in;
use crate::names::STATES;
use crate::{RunDirectoryError, clock};
use actin_sim::mechanics::State;
use actin_sim::{Assembly, BodyKind, FilamentSpan, Record, Records};
use npyz::{NpyWriter, WriterBuilder};
use std::io::{self, Seek, SeekFrom, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// A writer that reports its first error only and discards later output.
///
/// A dropped `ZipWriter` writes its directory and would print a second error to standard error.
struct Silent<W> {
    out: W,
    place: u64,
    has_failed: bool,
}

impl<W: Write + Seek> Silent<W> {
    fn new(out: W) -> Self {
        Self {
            out,
            place: 0,
            has_failed: false,
        }
    }

    fn check<T>(&mut self, done: io::Result<T>) -> io::Result<T> {
        self.has_failed |= done.is_err();
        done
    }
}

impl<W: Write + Seek> Write for Silent<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = if self.has_failed {
            bytes.len()
        } else {
            let written = self.out.write(bytes);
            self.check(written)?
        };
        self.place += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.has_failed {
            return Ok(());
        }
        let flushed = self.out.flush();
        self.check(flushed)
    }
}

impl<W: Write + Seek> Seek for Silent<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.place = match (self.has_failed, to) {
            (false, to) => {
                let sought = self.out.seek(to);
                self.check(sought)?
            }
            (true, SeekFrom::Start(place)) => place,
            (true, SeekFrom::Current(by) | SeekFrom::End(by)) => {
                self.place.saturating_add_signed(by)
            }
        };
        Ok(self.place)
    }
}

/// One component of a state vector, for all bodies.
type Component = fn(&State) -> &[f64];

struct Field {
    name: &'static str,
    bodies: usize,
    components: &'static [Component],
}

impl Field {
    /// Values in one state, with the component index fastest.
    fn values<'a>(&'a self, state: &'a State) -> impl Iterator<Item = f64> + 'a {
        let bodies = 0..self.bodies;
        bodies.flat_map(move |i| self.components.iter().map(move |c| c(state)[i]))
    }
}

pub(crate) struct States<'a> {
    assembly: &'a Assembly,
}

impl<'a> States<'a> {
    pub(crate) fn new(assembly: &'a Assembly) -> Self {
        Self { assembly }
    }

    fn fields(&self) -> [Field; 4] {
        let points = self.assembly.points.len();
        let frames = self.assembly.frames.len();
        let field = |name, bodies, components| Field {
            name,
            bodies,
            components,
        };
        [
            field("position_nm", points, &POSITION),
            field("velocity_nm_per_ns", points, &VELOCITY),
            field("quaternion", frames, &QUATERNION),
            field("angular_momentum", frames, &ANGULAR_MOMENTUM),
        ]
    }

    /// Points on the centre line (nm, lab frame).
    fn centre_line(&self, state: &State) -> Vec<f64> {
        let points = 0..self.assembly.points.len();
        let places = points.map(|i| self.assembly.centre_line_nm(state, i));
        places
            .flat_map(|place| [place.x, place.y, place.z])
            .collect()
    }

    fn columns(&self) -> [(&'static str, Vec<f64>); 2] {
        let Assembly { points, frames, .. } = self.assembly;
        [
            ("s_nm", points.iter().map(|p| p.s_nm).collect()),
            ("frame_s_nm", frames.iter().map(|f| f.s_nm).collect()),
        ]
    }

    fn kinds(&self) -> [(&'static str, Vec<u8>); 2] {
        let Assembly { points, frames, .. } = self.assembly;
        [
            ("kind", points.iter().map(|p| p.kind as u8).collect()),
            ("frame_kind", frames.iter().map(|f| f.kind as u8).collect()),
        ]
    }

    fn filaments(&self) -> [(&'static str, Vec<u64>); 2] {
        let spans = &self.assembly.filaments;
        let indices = |count_of: fn(&FilamentSpan) -> usize| {
            let counts = spans.iter().map(count_of).enumerate();
            counts
                .flat_map(|(i, count)| vec![i as u64; count])
                .collect()
        };
        [
            ("filament", indices(|span| span.points.len())),
            ("frame_filament", indices(|span| span.frames.len())),
        ]
    }

    pub(crate) fn ensure_finite(&self, i: usize, record: &Record) -> Result<(), RunDirectoryError> {
        let of = |name| (STATES, name);
        ensure_finite_in(of(clock(self.assembly)), i, &[], [record.at.value()])?;
        for field in self.fields() {
            let shape = [field.bodies, field.components.len()];
            ensure_finite_in(of(field.name), i, &shape, field.values(&record.state))?;
        }
        Ok(())
    }

    /// Writes the archive, with one pass over `records` for each array.
    pub(crate) fn write(
        &self,
        records: &dyn Records,
        out: &mut (impl Write + Seek),
    ) -> io::Result<()> {
        let mut archive = ZipWriter::new(Silent::new(out));
        self.write_arrays(records, &mut archive)?;
        archive.finish().map(drop).map_err(io::Error::from)
    }

    fn write_arrays<W: Write + Seek>(
        &self,
        records: &dyn Records,
        archive: &mut ZipWriter<W>,
    ) -> io::Result<()> {
        let time = |record: &Record| [record.at.value()];
        let count = records.count();
        write_records(archive, clock(self.assembly), &[count], records, time)?;
        for (name, values) in self.columns() {
            write_array(archive, name, values)?;
        }
        for (name, values) in self.kinds() {
            write_array(archive, name, values)?;
        }
        for (name, values) in self.filaments() {
            write_array(archive, name, values)?;
        }
        write_texts(archive, "kind_names", &BodyKind::ALL.map(BodyKind::name))?;
        let line = |record: &Record| self.centre_line(&record.state);
        let shape = [count, self.assembly.points.len(), 3];
        write_records(archive, "centre_line_nm", &shape, records, line)?;
        for field in self.fields() {
            let shape = [count, field.bodies, field.components.len()];
            let values = |record: &Record| field.values(&record.state).collect::<Vec<_>>();
            write_records(archive, field.name, &shape, records, values)?;
        }
        Ok(())
    }
}

fn write_array<W: Write + Seek, T: npyz::AutoSerialize>(
    archive: &mut ZipWriter<W>,
    name: &str,
    values: Vec<T>,
) -> io::Result<()> {
    let mut writer = begin_array(archive, name, &[values.len()])?;
    writer.extend(values)?;
    writer.finish()
}

fn write_texts<W: Write + Seek>(
    archive: &mut ZipWriter<W>,
    name: &str,
    texts: &[&str],
) -> io::Result<()> {
    let longest = texts.iter().map(|text| text.chars().count()).max();
    let kind = format!("<U{}", longest.unwrap_or(1));
    let kind = kind.parse().expect("a valid numpy type name");
    begin_entry(archive, name)?;
    let mut writer = npyz::WriteOptions::<str>::new()
        .dtype(npyz::DType::Plain(kind))
        .shape(&[texts.len() as u64])
        .writer(archive)
        .begin_nd()?;
    for text in texts {
        writer.push(text)?;
    }
    writer.finish()
}

fn write_records<W: Write + Seek, V: IntoIterator<Item = f64>>(
    archive: &mut ZipWriter<W>,
    name: &str,
    shape: &[usize],
    records: &dyn Records,
    of: impl Fn(&Record) -> V,
) -> io::Result<()> {
    let mut writer = begin_array(archive, name, shape)?;
    for record in records.iter() {
        writer.extend(of(&*record?))?;
    }
    writer.finish()
}

/// Begins an uncompressed array that may exceed 4 GiB. Trajectories compress by about 4 % only. The
/// fixed modification time keeps files of equal runs identical.
fn begin_array<'a, W: Write + Seek, T: npyz::AutoSerialize>(
    archive: &'a mut ZipWriter<W>,
    name: &str,
    shape: &[usize],
) -> io::Result<NpyWriter<T, &'a mut ZipWriter<W>>> {
    begin_entry(archive, name)?;
    let shape: Vec<u64> = shape.iter().map(|&n| n as u64).collect();
    let builder = npyz::WriteOptions::new().default_dtype().shape(&shape);
    builder.writer(archive).begin_nd()
}

fn begin_entry<W: Write + Seek>(archive: &mut ZipWriter<W>, name: &str) -> io::Result<()> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .large_file(true);
    Ok(archive.start_file(format!("{name}.npy"), options)?)
}

const POSITION: [Component; 3] = [
    |s| &s.points.position.x,
    |s| &s.points.position.y,
    |s| &s.points.position.z,
];

const VELOCITY: [Component; 3] = [
    |s| &s.points.velocity.x,
    |s| &s.points.velocity.y,
    |s| &s.points.velocity.z,
];

const QUATERNION: [Component; 4] = [
    |s| &s.frames.orientation.w,
    |s| &s.frames.orientation.x,
    |s| &s.frames.orientation.y,
    |s| &s.frames.orientation.z,
];

const ANGULAR_MOMENTUM: [Component; 3] = [
    |s| &s.frames.angular_momentum.x,
    |s| &s.frames.angular_momentum.y,
    |s| &s.frames.angular_momentum.z,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;
    use actin_sim::Trajectory;
    use actin_sim::mechanics::Vectors;
    use std::io::{Cursor, Read};
    use zip::ZipArchive;

    type Quantity = fn(&State) -> &Vectors;

    fn archive(assembly: &Assembly, trajectory: &Trajectory) -> ZipArchive<Cursor<Vec<u8>>> {
        let mut file = Cursor::new(Vec::new());
        States::new(assembly).write(trajectory, &mut file).unwrap();
        ZipArchive::new(file).unwrap()
    }

    fn read<T: npyz::Deserialize>(
        archive: &mut ZipArchive<Cursor<Vec<u8>>>,
        name: &str,
    ) -> (Vec<u64>, Vec<T>) {
        let mut bytes = Vec::new();
        let mut entry = archive.by_name(&format!("{name}.npy")).unwrap();
        entry.read_to_end(&mut bytes).unwrap();
        let array = npyz::NpyFile::new(&bytes[..]).unwrap();
        (array.shape().to_vec(), array.into_vec().unwrap())
    }

    /// Values are compared bit for bit; a transposed array would fail.
    #[test]
    fn vector_arrays_have_record_body_component_order() {
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let mut archive = archive(&assembly, &trajectory);
        let count = trajectory.records.len();
        let quantities: [(&str, Quantity); 3] = [
            ("position_nm", |s| &s.points.position),
            ("velocity_nm_per_ns", |s| &s.points.velocity),
            ("angular_momentum", |s| &s.frames.angular_momentum),
        ];
        for (name, of) in quantities {
            let (shape, values) = read::<f64>(&mut archive, name);
            let bodies = of(&assembly.rest).len();
            assert_eq!(shape, [count as u64, bodies as u64, 3], "{name}");
            for (t, record) in trajectory.records.iter().enumerate() {
                for i in 0..bodies {
                    let at = 3 * (t * bodies + i);
                    let expected = of(&record.state).get(i);
                    assert_eq!(values[at..at + 3], *expected.as_slice(), "{name} {t} {i}");
                }
            }
        }
    }

    /// nalgebra stores the scalar part last.
    #[test]
    fn quaternions_are_w_x_y_z() {
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let (shape, values) = read::<f64>(&mut archive(&assembly, &trajectory), "quaternion");
        let frames = assembly.frames.len();
        assert_eq!(shape, [3, frames as u64, 4]);
        let last = trajectory.records[2]
            .state
            .frames
            .orientation
            .get(frames - 1);
        let expected = [last.w, last.i, last.j, last.k];
        assert_eq!(values[values.len() - 4..], expected);
    }

    #[test]
    fn arrays_describe_bodies() {
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let mut archive = archive(&assembly, &trajectory);
        let (shape, times) = read::<f64>(&mut archive, "time_ns");
        assert_eq!(shape, [3]);
        assert_eq!(times, [0.0, 0.1, 1.0 / 3.0]);
        let s_nm: Vec<f64> = assembly.points.iter().map(|p| p.s_nm).collect();
        assert_eq!(read::<f64>(&mut archive, "s_nm").1, s_nm);
        let frame_s_nm: Vec<f64> = assembly.frames.iter().map(|f| f.s_nm).collect();
        assert_eq!(read::<f64>(&mut archive, "frame_s_nm").1, frame_s_nm);
        let (_, kinds) = read::<u8>(&mut archive, "kind");
        // Monomers (0) at the start, rod nodes (1) at the end.
        assert_eq!((kinds[0], kinds[kinds.len() - 1]), (0, 1));
        assert_eq!(kinds.len(), assembly.points.len());
        let (_, frame_kinds) = read::<u8>(&mut archive, "frame_kind");
        assert!(frame_kinds.contains(&0) && frame_kinds.contains(&2) && frame_kinds.contains(&3));
        let (_, filaments) = read::<u64>(&mut archive, "filament");
        assert_eq!(filaments, vec![0; assembly.points.len()]);
        let (_, names) = read::<String>(&mut archive, "kind_names");
        assert_eq!(
            names,
            ["monomer", "node", "segment", "junction", "wall", "joint"]
        );
        assert_eq!(names[usize::from(kinds[0])], "monomer");
        assert_eq!(archive.len(), 13);
    }

    /// At rest, the centre line coincides with the axis.
    #[test]
    fn the_centre_line_runs_through_monomers_and_nodes() {
        let assembly = fixture::clamped_start();
        let mut trajectory = fixture::trajectory(&assembly);
        trajectory.records[0].state = assembly.rest.clone();
        let mut archive = archive(&assembly, &trajectory);
        let (shape, line) = read::<f64>(&mut archive, "centre_line_nm");
        let points = assembly.points.len();
        assert_eq!(shape, [3, points as u64, 3]);
        for (point, place) in assembly.points.iter().zip(line.chunks(3)) {
            // Round-off of coordinates of about 42 nm.
            assert!(place[0].hypot(place[1]) < 1e-13 && (place[2] - point.s_nm).abs() < 1e-12);
        }
        let (_, positions) = read::<f64>(&mut archive, "position_nm");
        let last = 3 * (3 * points - 1);
        assert_eq!(line[last..], positions[last..]);
    }

    #[test]
    fn filament_indices_match_the_bodies() {
        let assembly = fixture::pair();
        let mut archive = archive(&assembly, &fixture::trajectory(&assembly));
        for (name, count) in [
            ("filament", assembly.points.len()),
            ("frame_filament", assembly.frames.len()),
        ] {
            let (_, filaments) = read::<u64>(&mut archive, name);
            // The clamped first filament has one extra monomer beyond its length.
            let first = filaments.iter().filter(|f| **f == 0).count();
            assert_eq!((filaments.len(), first), (count, count.div_ceil(2)));
            assert!(filaments.is_sorted());
        }
    }
}
