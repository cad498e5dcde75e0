//! Writing of `states.npz`.

use crate::names::STATES;
use crate::{RunDirectoryError, clock};
use actin_sim::mechanics::{State, Vector3};
use actin_sim::{Assembly, BodyKind, Records};
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

impl<W> Silent<W> {
    /// Applies an operation; `discarded` is its result after an error.
    fn apply<T>(
        &mut self,
        discarded: T,
        operation: impl FnOnce(&mut W) -> io::Result<T>,
    ) -> io::Result<T> {
        if self.has_failed {
            return Ok(discarded);
        }
        let done = operation(&mut self.out);
        self.has_failed = done.is_err();
        done
    }
}

impl<W: Write> Write for Silent<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.apply(bytes.len(), |out| out.write(bytes))?;
        self.place += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.apply((), W::flush)
    }
}

impl<W: Seek> Seek for Silent<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let discarded = match to {
            SeekFrom::Start(place) => place,
            SeekFrom::Current(by) | SeekFrom::End(by) => self.place.saturating_add_signed(by),
        };
        self.place = self.apply(discarded, |out| out.seek(to))?;
        Ok(self.place)
    }
}

/// An array of `states.npz` with values of every point or every frame in a record.
#[derive(Clone, Copy, Debug)]
pub struct StateArray {
    /// Name.
    pub name: &'static str,
    is_of_frames: bool,
    components: usize,
    values: fn(&Assembly, &State) -> Vec<f64>,
}

pub(super) const POSITION: StateArray = StateArray::new("position_nm", false, 3, |_, s| {
    flat(s.points.position.iter())
});
pub(super) const VELOCITY: StateArray = StateArray::new("velocity_nm_per_ns", false, 3, |_, s| {
    flat(s.points.velocity.iter())
});
pub(super) const QUATERNION: StateArray = StateArray::new("quaternion", true, 4, |_, s| {
    let turns = s.frames.orientation.iter();
    turns.flat_map(|q| [q.w, q.i, q.j, q.k]).collect()
});
pub(super) const ANGULAR_MOMENTUM: StateArray =
    StateArray::new("angular_momentum", true, 3, |_, s| {
        flat(s.frames.angular_momentum.iter())
    });
const CENTRE_LINE: StateArray = StateArray::new("centre_line_nm", false, 3, |assembly, s| {
    let points = 0..assembly.points.len();
    flat(points.map(|i| assembly.centre_line_nm(s, i)))
});

impl StateArray {
    /// All arrays in the order of the file.
    pub const ALL: [Self; 5] = [
        POSITION,
        VELOCITY,
        QUATERNION,
        ANGULAR_MOMENTUM,
        CENTRE_LINE,
    ];

    const fn new(
        name: &'static str,
        is_of_frames: bool,
        components: usize,
        values: fn(&Assembly, &State) -> Vec<f64>,
    ) -> Self {
        Self {
            name,
            is_of_frames,
            components,
            values,
        }
    }

    /// Returns the numbers of bodies and components.
    pub fn shape(&self, assembly: &Assembly) -> [usize; 2] {
        let bodies = if self.is_of_frames {
            assembly.frames.len()
        } else {
            assembly.points.len()
        };
        [bodies, self.components]
    }

    /// Returns the values in a state, with the component index fastest.
    pub fn values(&self, assembly: &Assembly, state: &State) -> Vec<f64> {
        (self.values)(assembly, state)
    }
}

fn flat(vectors: impl Iterator<Item = Vector3>) -> Vec<f64> {
    vectors.flat_map(|v| [v.x, v.y, v.z]).collect()
}

/// Writes `records` with their states, with one pass over them for each array.
pub(crate) fn write(
    assembly: &Assembly,
    records: &dyn Records,
    out: &mut (impl Write + Seek),
) -> io::Result<()> {
    let mut archive = ZipWriter::new(Silent {
        out,
        place: 0,
        has_failed: false,
    });
    write_arrays(assembly, records, &mut archive)?;
    archive.finish().map(drop).map_err(io::Error::from)
}

fn write_arrays<W: Write + Seek>(
    assembly: &Assembly,
    records: &dyn Records,
    archive: &mut ZipWriter<W>,
) -> io::Result<()> {
    let Assembly { points, frames, .. } = assembly;
    let times = records.iter().map(|record| Ok(record?.row.at.value()));
    let times = times.collect::<io::Result<Vec<f64>>>()?;
    write_array(archive, clock(assembly), times)?;
    write_array(archive, "s_nm", points.iter().map(|p| p.s_nm).collect())?;
    write_array(
        archive,
        "frame_s_nm",
        frames.iter().map(|f| f.s_nm).collect(),
    )?;
    let kinds = points.iter().map(|p| p.kind as u8);
    write_array(archive, "kind", kinds.collect())?;
    let kinds = frames.iter().map(|f| f.kind as u8);
    write_array(archive, "frame_kind", kinds.collect())?;
    let of_points = (0..points.len()).map(|i| assembly.filament_of_point(i) as u64);
    let of_frames = (0..frames.len()).map(|i| assembly.filament_of_frame(i) as u64);
    write_array(archive, "filament", of_points.collect())?;
    write_array(archive, "frame_filament", of_frames.collect())?;
    write_texts(archive, "kind_names", &BodyKind::ALL.map(BodyKind::name))?;
    for array in StateArray::ALL {
        let [bodies, components] = array.shape(assembly);
        let shape = [records.count(), bodies, components];
        let mut writer = begin_array(archive, array.name, &shape)?;
        for (i, record) in records.iter().enumerate() {
            let state = record?.state;
            let values = state.iter().flat_map(|state| array.values(assembly, state));
            for (k, value) in values.enumerate() {
                let index = [i, k / components, k % components];
                RunDirectoryError::ensure_finite(STATES, array.name, &index, value)?;
                writer.push(&value)?;
            }
        }
        writer.finish()?;
    }
    Ok(())
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
        write(assembly, trajectory, &mut file).unwrap();
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
