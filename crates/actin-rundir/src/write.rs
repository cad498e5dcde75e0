//! Writing of results: validation, staging and publication.

use crate::directory::RunDirectory;
use crate::json::{read_json, write_json};
use crate::manifest::Manifest;
use crate::names::{
    COLLECTION, ENERGIES, EVENTS, MACRO, OBSERVABLES, OTHER_STATES, PICTURES, PROFILE, SCENE,
    STATES, SUMMARY, picture_name,
};
use crate::staged::Staged;
use crate::{RunDirectoryError, atomic, energies, events, observables, profile, states};
use actin_export::{PARAVIEW_SCRIPT, VtkPictures, write_collection};
use actin_sim::{
    Assembly, At, Outcome, Plan, Record, Records, RecordsError, Scene, Status, Summary, Trajectory,
};
use serde::Deserialize;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

impl RunDirectory {
    /// Writes the resolved scene before the run starts.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn write_scene(&self, scene: &Scene) -> Result<(), RunDirectoryError> {
        let text = scene.to_ron();
        // The checksum comes first, so that edits after a kill are detected.
        let mut manifest = Manifest::own(&self.path)?;
        manifest.note_scene(&text);
        manifest.write(&self.path)?;
        self.replace(SCENE, |out| out.write_all(text.as_bytes()))
    }

    /// Writes all results of a run and returns its summary.
    ///
    /// The records are read one at a time, once for each file and array. Files of an earlier part of
    /// the run are replaced after all new files are complete and on the disk.
    ///
    /// # Errors
    /// - The records are empty or unreadable, or belong to another assembly.
    /// - A value is not finite.
    /// - An unlisted file has the name of a result.
    /// - The file system refuses an operation.
    ///
    /// The old results then stay, unless the file system refuses to rename complete files.
    pub fn write(
        &self,
        plan: &Plan<'_>,
        records: &dyn Records,
        outcome: &Outcome,
    ) -> Result<Summary, RunDirectoryError> {
        let results = Results::new(plan, records, outcome)?;
        let mut manifest = Manifest::own(&self.path)?;
        manifest.note_scene(&results.scene);
        manifest.add(results.files());
        if results.assembly.scene.output.vtk {
            manifest.add((0..records.count()).map(picture_name));
        }
        manifest.write(&self.path)?;
        let mut staged = Staged::new(&self.path);
        for name in results.files() {
            if name == COLLECTION {
                let folder = self.path.join(PICTURES);
                fs::create_dir_all(&folder).map_err(RunDirectoryError::io(&folder))?;
                results.stage_pictures(&mut staged)?;
            }
            staged.file(name, |out| results.write(name, out))?;
        }
        staged.publish(manifest)?;
        Ok(results.summary)
    }

    /// Writes the summary of a run that failed before its first record: scene title, status and
    /// reason.
    ///
    /// # Errors
    /// An unlisted file has the name of a result, or the file system refuses an operation.
    pub fn write_failure(&self, title: &str, why: &str) -> Result<(), RunDirectoryError> {
        let summary = serde_json::json!({ "scene": title, "status": Status::Failed, "failure": why, "format": Summary::FORMAT });
        self.replace(SUMMARY, |out| write_json(&summary, out))
    }

    /// Reads the summary of the run in this directory.
    ///
    /// # Errors
    /// The file is missing, unreadable or not a summary, or the directory has a newer format.
    pub fn summary(&self) -> Result<Summary, RunDirectoryError> {
        self.ensure_known_format()?;
        read_json(&self.path.join(SUMMARY))
    }

    /// Refuses a directory with a newer format.
    pub(crate) fn ensure_known_format(&self) -> Result<(), RunDirectoryError> {
        #[derive(Deserialize)]
        struct Head {
            format: Option<u32>,
        }
        let path = self.path.join(SUMMARY);
        match read_json(&path) {
            Ok(Head {
                format: Some(found),
            }) if found > Summary::FORMAT => Err(RunDirectoryError::NewerFormat { path, found }),
            _ => Ok(()),
        }
    }

    /// Lists a file in the manifest and replaces it durably.
    pub(crate) fn replace(
        &self,
        name: &str,
        fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let mut manifest = Manifest::own(&self.path)?;
        manifest.add([name]);
        manifest.write(&self.path)?;
        let path = self.path.join(name);
        atomic::replace_durably(&path, fill).map_err(RunDirectoryError::io(&path))
    }
}

struct Results<'a> {
    assembly: &'a Assembly,
    records: &'a dyn Records,
    outcome: &'a Outcome,
    scene: String,
    summary: Summary,
    last: Record,
    /// Stable states of a search; `None` without a search.
    others: Option<Trajectory>,
}

/// Stable states found by the run, sorted by energy.
fn others(outcome: &Outcome) -> Option<Trajectory> {
    let states = outcome.equilibrium.as_ref()?.states.as_ref()?;
    let states = states.states.iter().enumerate();
    let records = states.map(|(i, state)| {
        let mut record = state.record.clone();
        record.row.at = At::Path(i as f64);
        record
    });
    Some(Trajectory {
        records: records.collect(),
    })
}

impl<'a> Results<'a> {
    fn new(
        plan: &Plan<'a>,
        records: &'a dyn Records,
        outcome: &'a Outcome,
    ) -> Result<Self, RunDirectoryError> {
        let assembly = plan.assembly();
        let (summary, last) = Summary::with_last_record(assembly, records, outcome)?;
        for (key, value) in summary.numbers() {
            let checked = RunDirectoryError::ensure_finite(SUMMARY, &key, &[], value);
            checked.map_err(RunDirectoryError::io(Path::new(SUMMARY)))?;
        }
        Ok(Self {
            assembly,
            records,
            outcome,
            scene: plan.scene().to_ron(),
            summary,
            last,
            others: others(outcome),
        })
    }

    /// Names of the files in the order of writing, without pictures.
    fn files(&self) -> impl Iterator<Item = &'static str> + use<> {
        let output = self.assembly.scene.output;
        let files = [
            (SCENE, true),
            (ENERGIES, true),
            (OBSERVABLES, !self.assembly.scene.observe.is_empty()),
            (STATES, output.states),
            (OTHER_STATES, self.others.is_some()),
            (PROFILE, true),
            (EVENTS, self.assembly.has_events()),
            (COLLECTION, output.vtk),
            (MACRO, output.vtk),
            (SUMMARY, true),
        ];
        let wanted = files.into_iter().filter(|(_, is_wanted)| *is_wanted);
        wanted.map(|(name, _)| name)
    }

    fn write(&self, name: &str, out: &mut BufWriter<File>) -> io::Result<()> {
        let (assembly, records) = (self.assembly, self.records);
        match name {
            SCENE => out.write_all(self.scene.as_bytes()),
            ENERGIES => energies::write(assembly, records, out),
            OBSERVABLES => observables::write(assembly, records, out),
            STATES => states::write(assembly, records, out),
            OTHER_STATES => {
                let mut others = self.others.iter();
                others.try_for_each(|others| states::write(assembly, others, out))
            }
            PROFILE => profile::write(assembly, &self.last.state, out),
            EVENTS => events::write(&self.outcome.events, out),
            COLLECTION => self.write_collection(out),
            MACRO => out.write_all(PARAVIEW_SCRIPT.as_bytes()),
            SUMMARY => write_json(&self.summary, out),
            _ => unreachable!("{name} is not a result"),
        }
    }

    fn stage_pictures(&self, staged: &mut Staged<'_>) -> Result<(), RunDirectoryError> {
        let pictures = VtkPictures::new(self.assembly);
        for (i, record) in self.records.iter().enumerate() {
            let record = record.map_err(RecordsError::Unreadable)?;
            if let Some(state) = &record.state {
                let picture = |out: &mut _| pictures.write(record.row.at, state, out);
                staged.file(picture_name(i), picture)?;
            }
        }
        Ok(())
    }

    fn write_collection(&self, out: &mut impl Write) -> io::Result<()> {
        let times = self.records.iter();
        let times = times.map(|record| record.map(|record| record.row.at.value()));
        let pictures = times
            .enumerate()
            .map(|(i, time)| Ok((time?, picture_name(i))));
        write_collection(&self.assembly.scene.title, pictures, out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{self, contents, names};
    use crate::lock::LOCK;
    use crate::names::MANIFEST;
    use actin_sim::mechanics::State;
    use actin_sim::{At, Trajectory};
    use tempfile::TempDir;

    type Spoil = fn(&mut State);

    fn plan(assembly: &Assembly) -> Plan<'_> {
        Plan::new(assembly).unwrap()
    }

    fn empty() -> (TempDir, RunDirectory) {
        let folder = tempfile::tempdir().unwrap();
        let directory = RunDirectory::create(folder.path(), false).unwrap();
        (folder, directory)
    }

    #[test]
    fn write_creates_all_files() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let summary = directory
            .write(&plan(&assembly), &trajectory, &fixture::outcome())
            .unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&read(SUMMARY)).unwrap();
        assert_eq!(json["scene"], summary.scene.as_str());
        assert_eq!(json["work"]["steps"], 12);
        assert_eq!(
            &Scene::from_ron(&read(SCENE)).unwrap(),
            plan(&assembly).scene()
        );
        assert_eq!(read(ENERGIES).lines().count(), 1 + trajectory.records.len());
        let profile = read(PROFILE);
        let header = "s_nm,x_nm,y_nm,z_nm,curvature_rad_per_nm,twist_rad_per_nm,\
                      energy_per_length_pn,section,filament,tension_pn,shear_pn,moment_pn_nm,torque_pn_nm";
        assert_eq!(profile.lines().next(), Some(header));
        assert!(profile.contains(",ellipsoids,0,") && profile.contains(",rod,0,"));
        assert_eq!(read(COLLECTION).matches("<DataSet ").count(), 3);
        let states = fs::File::open(folder.path().join(STATES)).unwrap();
        let mut states = zip::ZipArchive::new(states).unwrap();
        assert!(states.by_name("quaternion.npy").is_ok());
        for name in ["vtk/0000.vtp", "vtk/0001.vtp", "vtk/0002.vtp"] {
            assert!(
                vtkio::Vtk::import(folder.path().join(name)).is_ok(),
                "{name}"
            );
        }
        assert_eq!(
            names(folder.path()),
            [
                LOCK, MANIFEST, ENERGIES, MACRO, PROFILE, COLLECTION, SCENE, STATES, SUMMARY,
                PICTURES
            ]
        );
        assert_eq!(names(&folder.path().join(PICTURES)).len(), 3);
    }

    /// Remaining pictures would seem to belong to the shorter run.
    #[test]
    fn a_shorter_run_leaves_no_pictures_of_a_longer_one() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        let mut trajectory = fixture::trajectory(&assembly);
        let outcome = fixture::outcome();
        directory
            .write(&plan(&assembly), &trajectory, &outcome)
            .unwrap();
        trajectory.records.truncate(1);
        directory
            .write(&plan(&assembly), &trajectory, &outcome)
            .unwrap();
        assert_eq!(names(&folder.path().join(PICTURES)), ["0000.vtp"]);
    }

    /// A folder in place of a temporary file makes writing fail; the old results stay unchanged.
    #[test]
    fn results_are_replaced_together_or_not_at_all() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        let mut trajectory = fixture::trajectory(&assembly);
        let outcome = fixture::outcome();
        let longer = trajectory.clone();
        trajectory.records.truncate(2);
        directory
            .write(&plan(&assembly), &trajectory, &outcome)
            .unwrap();
        let before = contents(folder.path());
        for name in [SCENE, STATES, "vtk/0002.vtp", SUMMARY] {
            let obstacle = folder.path().join(format!("{name}.part"));
            fs::create_dir(&obstacle).unwrap();
            let error = directory
                .write(&plan(&assembly), &longer, &outcome)
                .unwrap_err();
            assert!(error.to_string().contains(name), "{error}");
            fs::remove_dir(&obstacle).unwrap();
            let mut after = contents(folder.path());
            // The manifest is written first.
            after.retain(|(path, _)| !path.ends_with(MANIFEST));
            let same = before.iter().filter(|(path, _)| !path.ends_with(MANIFEST));
            assert!(after.iter().eq(same), "{name}");
        }
        directory
            .write(&plan(&assembly), &longer, &outcome)
            .unwrap();
        assert_eq!(names(&folder.path().join(PICTURES)).len(), 3);
    }

    #[test]
    fn edited_texts_are_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        let directory = RunDirectory::create(path, false).unwrap();
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let outcome = fixture::outcome();
        let write = || directory.write(&plan(&assembly), &trajectory, &outcome);
        let check_edited = |name: &str| {
            let file = path.join(name);
            let written = fs::read(&file).unwrap();
            fs::write(&file, "mine").unwrap();
            let both = [
                directory.reopen(),
                RunDirectory::create(path, true).map(drop),
            ];
            for refused in both {
                let message = refused.unwrap_err().to_string();
                let expected = format!("{name} has been changed since the run wrote it");
                assert!(message.contains(&expected), "{message}");
            }
            assert_eq!(fs::read(&file).unwrap(), b"mine");
            fs::write(&file, written).unwrap();
        };
        // A run killed before its first results.
        directory.write_scene(&assembly.scene).unwrap();
        check_edited(SCENE);
        // An interrupted run writes its results again after it is resumed.
        write().unwrap();
        directory.reopen().unwrap();
        write().unwrap();
        for name in [ENERGIES, PROFILE, SCENE] {
            check_edited(name);
        }
        directory.reopen().unwrap();
        RunDirectory::create(path, true).unwrap();
    }

    /// Writing fails at any position, including the directory of the zip archive. Errors of writing
    /// during the drop of the archive are ignored.
    #[test]
    fn full_disk_is_one_error() {
        struct Full(io::Cursor<Vec<u8>>, u64);
        impl Write for Full {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                if self.0.position() + bytes.len() as u64 > self.1 {
                    return Err(io::ErrorKind::StorageFull.into());
                }
                self.0.write(bytes)
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        impl io::Seek for Full {
            fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
                self.0.seek(to)
            }
        }
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let written = |room| {
            let mut full = Full(io::Cursor::default(), room);
            let written = states::write(&assembly, &trajectory, &mut full);
            written.map(|()| full.0.into_inner().len() as u64)
        };
        let whole = written(u64::MAX).unwrap();
        for room in [0, whole / 2, whole - 100, whole - 1] {
            let error = written(room).unwrap_err();
            assert!(error.to_string().contains("no storage space"), "{error}");
        }
    }

    #[test]
    fn unlisted_files_are_not_replaced() {
        for name in [ENERGIES, "vtk/0001.vtp", "vtk/0007.vtp"] {
            let (folder, directory) = empty();
            fs::create_dir(folder.path().join(PICTURES)).unwrap();
            let path = folder.path().join(name);
            fs::write(&path, "mine").unwrap();
            let assembly = fixture::clamped_start();
            let trajectory = fixture::trajectory(&assembly);
            let written = directory.write(&plan(&assembly), &trajectory, &fixture::outcome());
            let message = written.unwrap_err().to_string();
            assert!(message.contains(name), "{message}");
            assert_eq!(fs::read(&path).unwrap(), b"mine");
        }
    }

    #[test]
    fn values_that_are_not_finite_are_refused() {
        let assembly = fixture::clamped_start();
        let spoil: [(&str, Spoil); 4] = [
            ("states.npz: position_nm[1, 4, 2] is", |s| {
                s.points.position.z[4] = f64::NAN;
            }),
            ("states.npz: velocity_nm_per_ns[1, 0, 0] is", |s| {
                s.points.velocity.x[0] = f64::INFINITY;
            }),
            ("states.npz: quaternion[1, 2, 3] is", |s| {
                s.frames.orientation.z[2] = f64::NEG_INFINITY;
            }),
            ("states.npz: angular_momentum[1, 3, 1] is", |s| {
                s.frames.angular_momentum.y[3] = f64::NAN;
            }),
        ];
        for (message, spoil) in spoil {
            let mut trajectory = fixture::trajectory(&assembly);
            spoil(&mut trajectory.records[1].state);
            assert_refused(&assembly, &trajectory, message);
        }
        let mut trajectory = fixture::trajectory(&assembly);
        trajectory.records[1].row.residual_force_pn = f64::NAN;
        assert_refused(
            &assembly,
            &trajectory,
            "energies.csv: residual_force_pn[1] is NaN",
        );
        trajectory.records[2].row.at = At::Time(f64::INFINITY);
        assert_refused(&assembly, &trajectory, "summary.json: time_ns is inf");
    }

    #[test]
    fn records_of_another_assembly_are_refused() {
        let assembly = fixture::clamped_start();
        assert_refused(
            &assembly,
            &Trajectory::default(),
            "the trajectory holds no record",
        );
        let mut trajectory = fixture::trajectory(&assembly);
        trajectory.records[1].row.energies_pn_nm.pop();
        let terms = assembly.terms.len();
        let message = format!(
            "record 1 holds {} energies where the assembly has {terms}",
            terms - 1
        );
        assert_refused(&assembly, &trajectory, &message);
    }

    fn assert_refused(assembly: &Assembly, trajectory: &Trajectory, message: &str) {
        let (folder, directory) = empty();
        let error = directory
            .write(&plan(assembly), trajectory, &fixture::outcome())
            .unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
        assert_eq!(names(folder.path()), [LOCK, MANIFEST]);
    }
}
