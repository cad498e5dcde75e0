//! Writing the results of a run into its directory: what is checked, and in which order.

use super::directory::{
    COLLECTION, ENERGIES, PICTURES, PROFILE, RunDirectory, SCENE, STATES, SUMMARY, remove_if_there,
};
use super::energies::EnergyTable;
use super::states::States;
use super::vtk::{Drawing, collection};
use super::{RunDirectoryError, Summary, ThermalSummary, profile};
use crate::shape;
use crate::{Assembly, Record, RunReport, Scene, Trajectory};
use std::fs;
use std::io::Write;

impl RunDirectory {
    /// Writes the scene as resolved, which a run does before it starts.
    ///
    /// # Errors
    /// A refusal of the file system.
    pub fn write_scene(&self, scene: &Scene) -> Result<(), RunDirectoryError> {
        self.write_file(SCENE, |out| out.write_all(scene.to_ron().as_bytes()))
    }

    /// Writes every file of a run and returns what its summary says.
    ///
    /// Everything but the pictures is checked before the first file is written.
    ///
    /// # Errors
    /// No record, records of another assembly, numbers that are not finite, or a refusal of the
    /// file system.
    pub fn write(
        &self,
        assembly: &Assembly,
        trajectory: &Trajectory,
        report: &RunReport,
    ) -> Result<Summary, RunDirectoryError> {
        let records = &trajectory.records;
        let last = records.last().ok_or(RunDirectoryError::NoRecord)?;
        ensure_same_bodies(assembly, records)?;
        let states = records.iter().map(|record| &record.state);
        let summary = Summary {
            beyond_range: assembly.beyond_range_over(states.clone()),
            unstable_twist: assembly.unstable_twist_over(states),
            thermal: ThermalSummary::new(assembly, records),
            ..Summary::new(assembly, last, report)
        };
        let table = EnergyTable::new(assembly, records);
        let states = States::new(assembly, records);
        let filaments = 0..assembly.filaments.len();
        let along: Vec<_> = filaments
            .map(|filament| shape::profile_of(assembly, filament, &last.state))
            .collect();
        summary.ensure_finite(SUMMARY)?;
        table.ensure_finite(ENERGIES)?;
        states.ensure_finite(STATES)?;
        profile::ensure_all_finite(&along, PROFILE)?;

        remove_if_there(&self.path.join(SUMMARY))?;
        self.write_scene(&assembly.scene)?;
        self.write_file(ENERGIES, |out| table.write(out))?;
        self.write_file(STATES, |out| states.write(out))?;
        self.write_file(PROFILE, |out| profile::write(&along, out))?;
        self.write_pictures(assembly, records)?;
        self.write_file(SUMMARY, |out| {
            serde_json::to_writer_pretty(&mut *out, &summary)?;
            writeln!(out)
        })?;
        Ok(summary)
    }

    fn write_pictures(
        &self,
        assembly: &Assembly,
        records: &[Record],
    ) -> Result<(), RunDirectoryError> {
        self.remove_pictures()?;
        let folder = self.path.join(PICTURES);
        fs::create_dir_all(&folder).map_err(RunDirectoryError::io(&folder))?;
        let names: Vec<String> = (0..records.len())
            .map(|i| format!("{PICTURES}/{i:04}.vtp"))
            .collect();
        let drawing = Drawing::new(assembly);
        for (record, name) in records.iter().zip(&names) {
            let picture = drawing.picture(record.time_ns, &record.state);
            picture.ensure_finite(name)?;
            self.write_file(name, |out| picture.write(out))?;
        }
        let times = records.iter().map(|record| record.time_ns);
        let pictures = times.zip(names.iter().map(String::as_str));
        let text = collection(&assembly.scene.title, pictures);
        self.write_file(COLLECTION, |out| out.write_all(text.as_bytes()))
    }
}

/// Refuses records with other bodies or terms than those of the assembly.
fn ensure_same_bodies(assembly: &Assembly, records: &[Record]) -> Result<(), RunDirectoryError> {
    for (i, record) in records.iter().enumerate() {
        let Record {
            state,
            energies_pn_nm,
            ..
        } = record;
        for (quantity, found, expected) in [
            ("points", state.points.len(), assembly.points.len()),
            ("frames", state.frames.len(), assembly.frames.len()),
            ("energies", energies_pn_nm.len(), assembly.terms.len()),
        ] {
            if found != expected {
                return Err(RunDirectoryError::Mismatch {
                    record: i,
                    quantity,
                    found,
                    expected,
                });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::fixture;
    use actin_mechanics::State;
    use tempfile::TempDir;

    /// Makes one number of a state useless.
    type Spoil = fn(&mut State);

    fn empty() -> (TempDir, RunDirectory) {
        let folder = tempfile::tempdir().unwrap();
        let directory = RunDirectory::create(folder.path(), false).unwrap();
        (folder, directory)
    }

    #[test]
    fn all_files_of_a_run_are_there() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        let trajectory = fixture::trajectory(&assembly);
        let summary = directory
            .write(&assembly, &trajectory, &fixture::report())
            .unwrap();
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&read(SUMMARY)).unwrap();
        assert_eq!(json["scene"], summary.scene.as_str());
        assert_eq!(json["work"]["steps"], 12);
        assert_eq!(Scene::from_ron(&read(SCENE)).unwrap(), assembly.scene);
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
            all_names(folder.path()),
            [
                ENERGIES, PROFILE, COLLECTION, SCENE, STATES, SUMMARY, PICTURES
            ]
        );
        assert_eq!(all_names(&folder.path().join(PICTURES)).len(), 3);
    }

    /// Pictures of the longer run before are gone, or the shorter one would seem to go on.
    #[test]
    fn a_shorter_run_leaves_no_pictures_of_a_longer_one() {
        let (folder, directory) = empty();
        let assembly = fixture::clamped_start();
        let mut trajectory = fixture::trajectory(&assembly);
        let report = fixture::report();
        directory.write(&assembly, &trajectory, &report).unwrap();
        trajectory.records.truncate(1);
        directory.write(&assembly, &trajectory, &report).unwrap();
        assert_eq!(all_names(&folder.path().join(PICTURES)), ["0000.vtp"]);
    }

    /// Each kind of number is caught before any file is written, and named where it stands.
    #[test]
    fn nothing_is_written_if_a_number_is_not_finite() {
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
        trajectory.records[2].time_ns = f64::INFINITY;
        assert_refused(&assembly, &trajectory, "summary.json: time_ns is inf");
    }

    #[test]
    fn a_trajectory_that_does_not_fit_is_refused() {
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
            .write(assembly, trajectory, &fixture::report())
            .unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
        assert!(all_names(folder.path()).is_empty());
    }

    fn all_names(path: &std::path::Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}
