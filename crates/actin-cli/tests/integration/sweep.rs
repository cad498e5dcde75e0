//! `actin sweep`: tables, interruption, mistakes.

use crate::common::{Workplace, assert_has, code, pushed, signal, stderr};
use std::fs;
use std::process::Child;
use std::time::{Duration, Instant};

const SWEEP: &str = "Sweep(
    scene: \"scene.ron\",
    set: [Set(key: \"filament.rod.law\", value: Fitted)],
    vary: [
        List(key: \"loads[0].force_pn[2]\", values: [0.0, -1.5, inf]),
        Rows(keys: [\"filament.sections[1].to_nm\"], rows: [[30.0], [35.5]]),
    ],
    samples: Samples(number: 3, of: [Bonds]),
    results: [\"tip_displacement_nm[0]\", \"energy_pn_nm.total\", \"counts.segments\"],
)";

fn place(sweep: &str) -> Workplace {
    let place = Workplace::with(&pushed(2.0));
    place.write("sweep.ron", sweep);
    place
}

#[test]
fn a_sweep_becomes_a_table() {
    let place = place(SWEEP);
    assert_eq!(
        place.succeed(&["sweep", "sweep.ron", "--out", "a"]),
        "18 run(s), 6 failed (reasons in runs.csv); written to a/table.csv\n"
    );
    let runs: Vec<String> = place
        .read("a/runs.csv")
        .lines()
        .map(str::to_owned)
        .collect();
    assert_eq!(
        runs[0],
        "run,point,loads[0].force_pn[2],filament.sections[1].to_nm,seed,status,tip_displacement_nm[0],\
         energy_pn_nm.total,counts.segments,failure,warnings"
    );
    let begins = |row: usize, start: &str| assert!(runs[row].starts_with(start), "{}", runs[row]);
    begins(8, "7,2,-1.5,30.0,2,completed,-");
    begins(13, "12,4,inf,30.0,1,failed,,,,\"loads[0].force_pn[2]=inf: ");
    let table: Vec<Vec<String>> = place
        .read("a/table.csv")
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect();
    assert_eq!(table.len(), 7);
    let tips: Vec<f64> = runs[7..10]
        .iter()
        .map(|r| r.split(',').nth(6).unwrap().parse().unwrap())
        .collect();
    let mean = tips.iter().sum::<f64>() / 3.0;
    let variance = tips.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / 2.0;
    assert!(variance > 0.0, "samples differ");
    let [found, error] = [5, 6].map(|column| table[3][column].parse::<f64>().unwrap());
    assert!(
        (found / mean - 1.0).abs() < 1e-14 && (error / (variance / 3.0).sqrt() - 1.0).abs() < 1e-12
    );
    assert_eq!(table[5][3..7], ["3", "3", "", ""].map(str::to_owned));
}

#[test]
fn a_run_of_a_sweep_is_a_run() {
    let place = place(SWEEP);
    place.succeed(&["sweep", "sweep.ron", "--out", "a", "--only", "7"]);
    let alone = "run scene.ron --set filament.rod.law=Fitted --set loads[0].force_pn[2]=-1.5 --seed 2 --out alone";
    place.succeed(&alone.split(' ').collect::<Vec<_>>());
    let names = ["scene.ron", "energies.csv", "profile.csv"];
    place.assert_same(["alone", "a/runs/7"], &names);
}

#[test]
fn tables_do_not_depend_on_how_they_were_made() {
    let place = place(SWEEP);
    place.succeed(&["sweep", "sweep.ron", "--jobs", "1"]);
    place.succeed(&["sweep", "sweep.ron", "--out", "b", "--jobs", "2"]);
    for runs in ["12-17,3", "0-2,3"] {
        place.succeed(&["sweep", "sweep.ron", "--out", "c", "--only", runs]);
        assert!(!place.path("c/table.csv").exists());
    }
    place.succeed(&["sweep", "sweep.ron", "--out", "c", "--resume"]);
    place.succeed(&["sweep", "c/sweep.ron", "--out", "d", "--resume"]);
    let names = ["table.csv", "runs.csv", "parameters.csv", "sweep.ron"];
    for out in ["b", "c", "d"] {
        place.assert_same(["sweeps/sweep", out], &names);
    }
    // Another result column needs no new runs.
    fs::remove_file(place.path("d/runs/4/energies.csv")).unwrap();
    let more = SWEEP.replace("\"energy_pn_nm.total\"", "\"work.steps\"");
    place.write("more.ron", more);
    place.succeed(&["sweep", "more.ron", "--out", "d", "--resume"]);
    assert!(place.read("d/table.csv").contains("work.steps error"));
    assert!(!place.path("d/runs/4/energies.csv").exists());
}

fn begin(place: &Workplace, out: &str) -> Child {
    let line = format!("sweep sweep.ron --out {out} --resume --checkpoint-every 0.02");
    let arguments: Vec<&str> = line.split(' ').collect();
    place.command(&arguments).spawn().unwrap()
}

/// A sweep that is killed repeatedly has the tables of an undisturbed sweep. The time between kills grows, so that
/// the test ends on any machine.
#[test]
fn a_killed_sweep_resumes_to_the_same_tables() {
    let sweep = SWEEP.replace("-1.5, inf", "-1.5");
    let place = place(&sweep);
    let longer = pushed(40.0);
    place.write("scene.ron", longer);
    place.succeed(&["sweep", "sweep.ron", "--out", "whole"]);
    let mut kills = 0;
    loop {
        let mut child = begin(&place, "parts");
        let patience = Duration::from_millis(60 + 20 * kills);
        let started = Instant::now();
        while child.try_wait().unwrap().is_none() && started.elapsed() < patience {
            std::thread::sleep(Duration::from_millis(2));
        }
        if child.try_wait().unwrap().is_some() {
            let output = child.wait_with_output().unwrap();
            assert_eq!(code(&output), 0, "{}", stderr(&output));
            break;
        }
        child.kill().unwrap();
        child.wait().unwrap();
        kills += 1;
        assert!(kills < 500, "it never ends");
    }
    println!("{kills} kills");
    assert!(kills > 1, "it was never interrupted");
    place.assert_same(["parts", "whole"], &["table.csv", "runs.csv"]);
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_checkpoints() {
    let place = place(&SWEEP.replace("-1.5, inf", "-1.5"));
    let longer = pushed(4000.0);
    place.write("scene.ron", longer);
    let child = begin(&place, "a");
    while !place.path("a/runs/0/checkpoint.bin").exists() {
        std::thread::sleep(Duration::from_millis(2));
    }
    signal(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    let message = "interrupted: 0 of 12 runs have ended and are in runs.csv and table.csv; other started runs \
                   have checkpoints; to continue: actin sweep sweep.ron --out a --resume\n";
    assert_eq!(stderr(&output), message);
    // Both tables exist and list unfinished runs.
    let runs = place.read("a/runs.csv");
    assert_eq!(runs.matches(",unfinished,").count(), 12, "{runs}");
    let table = place.read("a/table.csv");
    let counts: Vec<&str> = table
        .lines()
        .skip(1)
        .filter_map(|row| row.split(',').nth(3))
        .collect();
    assert_eq!(counts, ["0"; 4], "{table}");
}

#[test]
fn a_sweep_of_which_every_run_fails_is_a_failure() {
    let place = place(&SWEEP.replace("0.0, -1.5, inf", "inf"));
    let output = place.fail(3, &["sweep", "sweep.ron", "--out", "a"]);
    assert_eq!(
        output,
        "error: all 6 run(s) failed: the reasons are in a/runs.csv\n"
    );
    assert!(place.read("a/runs.csv").contains("must be finite"));
}

/// Text to replace, its replacement, and the expected message.
const MISTAKES: &str = r#"
vary: => varies: => sweep.ron:4:5: unknown key `varies` in Sweep: expected one of title, scene, results
[1].to_nm => [1].to_um => sweep.ron:6:60: vary[1].rows[0][0] = 30.0: filament.sections[1].to_um=30.0: unknown key
sections[1] => sections[3] => sweep.ron:6:60: vary[1].rows[0][0] = 30.0: filament.sections[3].to_nm=30.0: filament.sections has 2
-1.5, inf => -1.5, high => sweep.ron:5:63: vary[0].values[2] = high: loads[0].force_pn[2]=high:
[35.5] => [35.5, 1] => sweep.ron:6:67: vary[1].rows[1] = 2 values: a row must have a value for each of the 1 keys
counts.segments => counts.segment => sweep.ron:9:63: results[2] = counts.segment: summary.json has no segment there: expected one of
number: 3 => number: 0 => sweep.ron:8:22: samples.number = 0: must be at least 1
of: [Bonds] => of: [Noise] => sweep.ron:8:5: samples: the scene has nothing random
filament.sections[1].to_nm => loads[0].force_pn => sweep.ron:6:9: vary[1] = loads[0].force_pn: is varied already, as loads[0].force_pn[2]
filament.rod.law => loads[0].force_pn[2] => sweep.ron:5:9: vary[0] = loads[0].force_pn[2]: would replace set[0], which sets loads[0].force_pn[2]
filament.rod.law", value: Fitted => filaments[0].sections[1].to_nm", value: 30.0 => sweep.ron:6:9: vary[1] = filament.sections[1].to_nm: would replace set[0], which sets filaments[0]
filament.rod.law", value: Fitted => filament.monomers.seed", value: 5 => sweep.ron:3:11: set[0] = filament.monomers.seed: has no effect, because
scene.ron => absent.ron => absent.ron:
"#;

#[test]
fn mistakes_of_a_sweep_have_their_place() {
    for line in MISTAKES.trim().lines() {
        let parts: Vec<&str> = line.split(" => ").collect();
        let place = place(&SWEEP.replacen(parts[0], parts[1], 1));
        for flag in ["--check", "--resume"] {
            let found = place.fail(2, &["sweep", "sweep.ron", flag]);
            assert!(
                found.starts_with(&format!("error: {}", parts[2])),
                "{found}"
            );
        }
        assert!(!place.path("sweeps").exists());
    }
}

#[test]
fn all_mistakes_of_a_sweep_are_reported() {
    let unread = SWEEP
        .replace("vary:", "varies:")
        .replace("number: 3", "number: 0");
    let rules = SWEEP
        .replace("-1.5, inf", "-1.5, high")
        .replace("counts.segments", "counts.segment")
        .replace("energy_pn_nm.total", "energy_pn_nm.sum");
    for (sweep, lines) in [
        (
            unread,
            &[
                "4:5: unknown key `varies`",
                "8:22: samples.number = 0: must",
            ][..],
        ),
        (
            rules,
            &[
                "5:63: vary[0].values[2] = high",
                "9:41: results[1] = energy_pn_nm.sum: summary.json has no sum there",
                "9:61: results[2] = counts.segment: summary.json has no segment there",
            ],
        ),
    ] {
        let found = place(&sweep).fail(2, &["sweep", "sweep.ron", "--check"]);
        let told: Vec<&str> = found.split("error: ").skip(1).collect();
        assert_eq!(told.len(), lines.len(), "{found}");
        for (told, line) in told.iter().zip(lines) {
            assert!(told.starts_with(&format!("sweep.ron:{line}")), "{told}");
            assert_has(told, &["^^^"]);
        }
    }
}

const HEATED: &str = "Scene(
        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 30.0)]),
        clamps: [Clamp(end: Start)],
        observe: [Tip(), TangentCorrelation(over_nm: 12.5)],
        output: (vtk: false, states: false),
        task: Dynamics(
            duration_ns: 4.0, record_every_ns: 0.02,
            drag: (translational_per_ns: 5.0, rotational_per_ns: 5.0),
            thermal: (temperature_k: 298.0, seed: 1),
        ),
    )";

#[test]
fn observables_are_results() {
    let place = place("");
    place.write("scene.ron", HEATED);
    let columns = [
        "observables.tip[0]_z_nm.mean",
        "observables.tip[0]_z_nm.error",
        "observables.tangent_correlation[0]_over_12.5nm.persistence_length_nm",
    ];
    let sweep = |result: &str| {
        format!(
            "Sweep(scene: \"scene.ron\", samples: Samples(number: 2),
             results: [\"{}\", \"{}\", \"{}\", \"{result}\"])",
            columns[0], columns[1], columns[2]
        )
    };
    place.write("sweep.ron", sweep("work.steps"));
    place.succeed(&["sweep", "sweep.ron", "--out", "a"]);
    let runs = place.read("a/runs.csv");
    for row in runs.lines().skip(1) {
        let number = |k: usize| row.split(',').nth(k).unwrap().parse::<f64>();
        let [tip, error, length] = [4, 5, 6].map(|k| number(k).unwrap());
        assert!(
            tip > 29.0 && tip < 30.5 && error > 0.0 && error < 0.1,
            "{row}"
        );
        assert!(length > 1000.0, "{row}");
    }
    assert!(!place.path("a/runs/0/states.npz").exists());
    place.write("sweep.ron", sweep("observables.tip[1]_z_nm.mean"));
    let output = place.actin(&["sweep", "sweep.ron", "--out", "b"]);
    assert!(
        stderr(&output).contains("summary.json has no tip there"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_missing_result_is_reported() {
    let place = place("");
    place.write(
        "sweep.ron",
        "Sweep(scene: \"scene.ron\", results: [\"work.steps\", \"filaments[1].tip_nm[0]\"])",
    );
    let told = place.fail(3, &["sweep", "sweep.ron", "--out", "out"]);
    assert!(told.starts_with("error: all 1 run(s) failed"), "{told}");
    let reason = "its summary has no value of filaments[1].tip_nm[0]";
    for table in ["out/runs.csv", "out/table.csv"] {
        let text = place.read(table);
        assert!(text.lines().nth(1).unwrap().contains(reason), "{text}");
    }
}

#[test]
fn other_directories_are_unchanged() {
    let place = place(SWEEP);
    let refused = |arguments: &[&str]| {
        let output = place.fail(2, &[&["sweep"], arguments].concat());
        output.clone()
    };
    assert!(refused(&["sweep.ron", "--out", "."]).contains("is not empty and holds no sweep"));
    place.succeed(&["sweep", "sweep.ron", "--out", "a", "--only", "12"]);
    assert!(refused(&["sweep.ron", "--out", "a"]).contains("--resume continues it"));
    place.write("other.ron", SWEEP.replace("35.5", "36.5"));
    let message = refused(&["other.ron", "--out", "a", "--resume"]);
    assert_has(&message, &["line 5 of parameters.csv is"]);
    assert!(refused(&["sweep.ron", "--out", "a", "--only", "18"]).contains("there is no run 18"));
}

#[test]
fn a_sweep_can_be_checked() {
    let place = place(SWEEP);
    let said = place.succeed(&["sweep", "sweep.ron", "--check"]);
    assert_has(
        &said,
        &[
            "18 runs: 6 point(s), 3 run(s) of each\n  loads[0].force_pn[2]: 0.0, -1.5, inf\n",
            "  seeds 1 to 3\n",
            "a run of point 1, the largest of 4 built: ",
            "all 18 runs, each as long as this one: ",
            "2 point(s) will fail:\n  point 4: loads[0].force_pn[2]=inf: loads[0].force_pn = [-2.0, 0.0, inf]",
        ],
    );
    assert!(!place.path("sweeps").exists());
}
