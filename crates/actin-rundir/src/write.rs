//! Writing of results: validation, staging and publication.

use crate::directory::RunDirectory;
use crate::finite::ensure_finite;
use crate::manifest::Manifest;
use crate::names::{
    COLLECTION, ENERGIES, EVENTS, MACRO, OBSERVABLES, OTHER_STATES, PICTURES, PROFILE, SCENE,
    STATES, SUMMARY, picture_name,
};
use crate::review::{Review, Tables};
use crate::staged::Staged;
use crate::{RunDirectoryError, atomic, events, profile};
use actin_export::{PARAVIEW_SCRIPT, VtkPictures, write_collection};
use actin_sim::shape::{self, ProfilePoint};
use actin_sim::{
    Assembly, At, LinkerEvent, Outcome, Plan, Record, Records, RecordsError, Scene, Status,
    Summary, Trajectory,
};
use std::fs;
use std::io::{self, Write};

impl RunDirectory {
    /// Writes the resolved scene before the run starts.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn write_scene(&self, scene: &Scene) -> Result<(), RunDirectoryError> {
        let (path, text) = (self.path.join(SCENE), scene.to_ron());
        // The checksum comes first, so that edits after a kill are detected.
        let mut manifest = Manifest::read(&self.path)?.unwrap_or_else(Manifest::new);
        manifest.add([SCENE]);
        manifest.note_scene(&text);
        manifest.write(&self.path)?;
        let written = atomic::replace(&path, |out| out.write_all(text.as_bytes()));
        written.map_err(RunDirectoryError::io(&path))
    }

    /// Writes all results of a run and returns its summary.
    ///
    /// The records are read one at a time, in several passes. Everything except the pictures is
    /// validated before writing starts. Files of an earlier part of the run are replaced after all
    /// new files are complete and on the disk.
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
        self.announce(&results)?;
        let mut staged = Staged::new(&self.path);
        results.stage(&mut staged)?;
        staged.publish()?;
        Ok(results.summary)
    }

    /// Writes the summary of a run that failed before its first record: scene title, status and
    /// reason.
    ///
    /// # Errors
    /// An unlisted file has the name of a result, or the file system refuses an operation.
    pub fn write_failure(&self, title: &str, why: &str) -> Result<(), RunDirectoryError> {
        let mut manifest = Manifest::read(&self.path)?.unwrap_or_else(Manifest::new);
        manifest.ensure_own(&self.path)?;
        manifest.add([SUMMARY]);
        manifest.write(&self.path)?;
        let path = self.path.join(SUMMARY);
        let summary =
            serde_json::json!({ "scene": title, "status": Status::Failed, "failure": why });
        let written = atomic::replace_durably(&path, |out| {
            serde_json::to_writer_pretty(&mut *out, &summary)?;
            writeln!(out)
        });
        written.map_err(RunDirectoryError::io(&path))
    }

    /// Reads the summary of the run in this directory.
    ///
    /// # Errors
    /// The file is missing, unreadable or not a summary.
    pub fn summary(&self) -> Result<Summary, RunDirectoryError> {
        let path = self.path.join(SUMMARY);
        let read = fs::read_to_string(&path);
        let summary = read.and_then(|text| Ok(serde_json::from_str(&text)?));
        summary.map_err(RunDirectoryError::io(&path))
    }

    /// Lists the results in the manifest, after checking that unlisted files have other names.
    fn announce(&self, results: &Results<'_>) -> Result<(), RunDirectoryError> {
        let mut manifest = Manifest::read(&self.path)?.unwrap_or_else(Manifest::new);
        manifest.ensure_own(&self.path)?;
        manifest.note_scene(&results.scene);
        manifest.add([SCENE, ENERGIES, PROFILE, SUMMARY]);
        let output = results.assembly.scene.output;
        if !results.tables.observables.is_empty() {
            manifest.add([OBSERVABLES]);
        }
        if output.states {
            manifest.add([STATES]);
        }
        manifest.add(results.others.as_ref().map(|_| OTHER_STATES));
        if output.vtk {
            manifest.add([COLLECTION, MACRO]);
            manifest.add((0..results.records.count()).map(picture_name));
        }
        manifest.add(results.events.as_ref().map(|_| EVENTS));
        manifest.write(&self.path)
    }
}

struct Results<'a> {
    assembly: &'a Assembly,
    records: &'a dyn Records,
    scene: String,
    tables: Tables<'a>,
    along: Vec<Vec<ProfilePoint>>,
    summary: Summary,
    /// `None` if the scene has no linker kinetics.
    events: Option<Vec<LinkerEvent>>,
    /// Stable states of a search; `None` without a search.
    others: Option<Trajectory>,
}

/// Stable states found by the run, sorted by energy.
fn others(outcome: &Outcome) -> Option<Trajectory> {
    let states = outcome.equilibrium.as_ref()?.states.as_ref()?;
    let states = states.states.iter().enumerate();
    let records = states.map(|(i, state)| Record {
        at: At::Path(i as f64),
        ..state.record.clone()
    });
    Some(Trajectory {
        records: records.collect(),
    })
}

impl<'a> Results<'a> {
    fn new(
        plan: &Plan<'a>,
        records: &'a dyn Records,
        outcome: &Outcome,
    ) -> Result<Self, RunDirectoryError> {
        let assembly = plan.assembly();
        let tables = Tables::new(assembly);
        let review = Review::new(assembly, records, &tables)?;
        let last = review.last;
        let summary = review.statistics.summary(&last, outcome);
        for (key, value) in summary.numbers() {
            ensure_finite(SUMMARY, &key, &[], [value])?;
        }
        review.are_finite?;
        let filaments = 0..assembly.filaments.len();
        let along: Vec<_> = filaments
            .map(|filament| shape::profile_of(assembly, filament, &last.state))
            .collect();
        profile::ensure_all_finite(&along, PROFILE)?;
        events::ensure_all_finite(&outcome.events)?;
        Ok(Self {
            assembly,
            records,
            scene: plan.scene().to_ron(),
            tables,
            along,
            summary,
            events: assembly.has_events().then(|| outcome.events.clone()),
            others: others(outcome),
        })
    }

    fn stage(&self, staged: &mut Staged<'_>) -> Result<(), RunDirectoryError> {
        staged.file(SCENE, |out| out.write_all(self.scene.as_bytes()))?;
        let (tables, output) = (&self.tables, self.assembly.scene.output);
        staged.file(ENERGIES, |out| tables.energies.write(self.records, out))?;
        if !tables.observables.is_empty() {
            staged.file(OBSERVABLES, |out| {
                tables.observables.write(self.records, out)
            })?;
        }
        if output.states {
            staged.file(STATES, |out| tables.states.write(self.records, out))?;
        }
        if let Some(others) = &self.others {
            staged.file(OTHER_STATES, |out| tables.states.write(others, out))?;
        }
        staged.file(PROFILE, |out| profile::write(&self.along, out))?;
        if let Some(happened) = &self.events {
            staged.file(EVENTS, |out| events::write(happened, out))?;
        }
        if output.vtk {
            self.stage_pictures(staged)?;
            staged.file(COLLECTION, |out| self.write_collection(out))?;
            staged.file(MACRO, |out| out.write_all(PARAVIEW_SCRIPT.as_bytes()))?;
        }
        staged.file(SUMMARY, |out| {
            serde_json::to_writer_pretty(&mut *out, &self.summary)?;
            writeln!(out)
        })
    }

    fn stage_pictures(&self, staged: &mut Staged<'_>) -> Result<(), RunDirectoryError> {
        let folder = staged.folder.join(PICTURES);
        fs::create_dir_all(&folder).map_err(RunDirectoryError::io(&folder))?;
        let pictures = VtkPictures::new(self.assembly);
        for record in self.records.iter() {
            let record = record.map_err(RecordsError::Unreadable)?;
            staged.picture(|out| pictures.write(record.at, &record.state, out))?;
        }
        Ok(())
    }

    fn write_collection(&self, out: &mut impl Write) -> io::Result<()> {
        let times = self
            .records
            .iter()
            .map(|r| r.map(|record| record.at.value()));
        let pictures = times.enumerate().map(|(i, t)| Ok((t?, picture_name(i))));
        write_collection(&self.assembly.scene.title, pictures, out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{self, names};
    use crate::lock::LOCK;
    use crate::names::MANIFEST;
    use actin_sim::mechanics::State;
    use actin_sim::{At, Trajectory};
    use std::path::{Path, PathBuf};
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
                      energy_per_length_pn,section,filament";
        assert_eq!(profile.lines().next(), Some(header));
        assert!(profile.contains(",ellipsoids,0\n") && profile.contains(",rod,0\n"));
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

    #[test]
    fn edited_scene_of_a_killed_run_is_not_overwritten() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        directory.write_scene(&assembly.scene).unwrap();
        assert!(RunDirectory::create(folder.path(), true).is_ok());
        directory.write_scene(&assembly.scene).unwrap();
        fs::write(folder.path().join(SCENE), "mine").unwrap();
        let error = RunDirectory::create(folder.path(), true).unwrap_err();
        assert!(
            matches!(error, RunDirectoryError::Changed { .. }),
            "{error}"
        );
        assert_eq!(fs::read(folder.path().join(SCENE)).unwrap(), b"mine");
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
        for name in [STATES, "vtk/0002.vtp", SUMMARY] {
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
        // An interrupted run writes its results again after it is resumed.
        write().unwrap();
        directory.reopen().unwrap();
        write().unwrap();
        for name in [ENERGIES, PROFILE, SCENE] {
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
        let tables = Tables::new(&assembly);
        let written = |room| {
            let mut full = Full(io::Cursor::default(), room);
            let written = tables.states.write(&trajectory, &mut full);
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
    fn values_that_are_not_finite_are_refused_before_writing() {
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
        trajectory.records[1].residual_force_pn = f64::NAN;
        assert_refused(
            &assembly,
            &trajectory,
            "energies.csv: residual_force_pn[1] is NaN",
        );
        trajectory.records[2].at = At::Time(f64::INFINITY);
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
        trajectory.records[1].energies_pn_nm.pop();
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

    fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
        let folders = [folder.to_owned(), folder.join(PICTURES)];
        let entries = folders.iter().flat_map(|f| fs::read_dir(f).unwrap());
        let paths = entries.map(|entry| entry.unwrap().path());
        let mut all: Vec<_> = paths
            .filter(|path| path.is_file())
            .map(|path| (path.clone(), fs::read(path).unwrap()))
            .collect();
        all.sort();
        all
    }
}
