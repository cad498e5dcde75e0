//! The studies of the book: shortened scenes and sweeps run, and scripts plot the results.

use crate::common::{Workplace, code, python, stderr, stdout};
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

struct Study {
    name: &'static str,
    shorter: &'static [(&'static str, &'static str)],
    points: usize,
    set: &'static [&'static str],
}

const STUDIES: [Study; 8] = [
    Study {
        name: "flicker",
        shorter: &[("duration_ms: 1000.0", "duration_ms: 8.0")],
        points: 1,
        set: &["task.duration_ms=0.5"],
    },
    Study {
        name: "extension",
        shorter: &[
            (
                "values: [0.2, 1.0, 4.0, 12.0, 30.0, 60.0]",
                "values: [1.0, 12.0]",
            ),
            ("number: 4", "number: 2"),
            ("duration_ns: 2000.0", "duration_ns: 3.0"),
            ("record_every_ns: 8.0", "record_every_ns: 0.05"),
            ("burn_in_ns: 100.0", "burn_in_ns: 0.5"),
        ],
        points: 4,
        set: &[
            "task.duration_ns=0.5",
            "task.record_every_ns=0.1",
            "burn_in_ns=0.1",
        ],
    },
    Study {
        name: "compression",
        shorter: &[
            ("duration_ns: 1500.0", "duration_ns: 3.0"),
            ("record_every_ns: 15.0", "record_every_ns: 0.5"),
            ("-150.0", "-0.3"),
        ],
        points: 6,
        set: &[
            "path[0].duration_ns=0.5",
            "path[0].set[0].shift_nm[2]=-0.05",
            "task.duration_ns=0.5",
            "task.record_every_ns=0.1",
        ],
    },
    Study {
        name: "subcell",
        shorter: &[
            ("duration_ns: 300.0", "duration_ns: 0.5"),
            ("duration_ns: 1500.0", "duration_ns: 1.0"),
            ("duration_ns: 1800.0", "duration_ns: 1.5"),
            ("record_every_ns: 15.0", "record_every_ns: 0.25"),
            ("-150.0", "-0.1"),
            ("[0.0, 360.0]", "[0.0, 1.0]"),
        ],
        points: 14,
        set: &[
            "path[0].duration_ns=0.1",
            "path[1].duration_ns=0.4",
            "path[1].set[0].shift_nm[2]=-0.05",
            "task.duration_ns=0.5",
            "task.record_every_ns=0.1",
        ],
    },
    Study {
        name: "softened",
        shorter: &[
            (
                "(0.0, 10.0, 0.0), (0.0, 30.0, 0.0), (0.0, 60.0, 0.0),",
                "(0.0, 10.0, 0.0), (0.0, 30.0, 0.0),",
            ),
            (
                "(0.0, 0.0, 60.0), (0.0, 0.0, 90.0), (0.0, 0.0, 120.0), (0.0, 0.0, 180.0), (0.0, 0.0, 240.0),",
                "(0.0, 0.0, 60.0),",
            ),
            (
                "(0.0, 0.0, -60.0), (0.0, 0.0, -90.0), (0.0, 0.0, -120.0), (0.0, 0.0, -180.0), (0.0, 0.0, -240.0),",
                "(0.0, 0.0, -60.0),",
            ),
        ],
        points: 30,
        set: &["path[0].set[0].turn_deg[1]=5.0"],
    },
    Study {
        name: "sine",
        shorter: &[
            (
                "Sine(period_ns: 5.0), Sine(period_ns: 7.0), Sine(period_ns: 9.0), Sine(period_ns: 11.0), Sine(period_ns: 13.0),",
                "",
            ),
            (
                "Sine(period_ns: 14.5), Sine(period_ns: 16.0), Sine(period_ns: 19.0), Sine(period_ns: 25.0), Sine(period_ns: 40.0),",
                "Sine(period_ns: 14.5),",
            ),
            ("duration_ns: 400.0", "duration_ns: 4.0"),
            ("record_every_ns: 4.0", "record_every_ns: 0.1"),
        ],
        points: 48,
        set: &["task.duration_ns=1.0", "task.record_every_ns=0.1"],
    },
    Study {
        name: "network-shear",
        shorter: &[
            ("count: 75", "count: 12"),
            ("(700.0, 700.0, 700.0)", "(400.0, 400.0, 400.0)"),
            ("values: [14.0, 11.0, 9.0]", "values: [9.0]"),
            ("[[1, 1], [2, 2], [3, 3]]", "[[1, 1]]"),
        ],
        points: 3,
        set: &["periodic.strain=0.001"],
    },
    Study {
        name: "bundle",
        shorter: &[],
        points: 10,
        set: &["loads[0].force_pn[0]=0.01"],
    },
];

/// Scenes of measurements without a script, with changes for short runs.
const MEASURED: [(&str, &[&str]); 9] = [
    ("cofilin-heat", &["task.duration_ns=6.0"]),
    ("contraction-network", &["task.duration_ms=0.02"]),
    ("crossed-pair", &["task.duration_ms=0.1"]),
    ("fine-network", &[]),
    ("fine-network-heat", &["task.duration_ms=0.01"]),
    ("free-filaments", &["task.duration_ms=0.1"]),
    (
        "long-network",
        &["task.duration_ms=0.02", "task.record_every_ns=2e3"],
    ),
    ("network-heat", &["task.duration_ms=0.1"]),
    ("warm", &["task.duration_ns=1.0"]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/studies")
}

fn place(study: &Study) -> Workplace {
    let place = Workplace::with("");
    for entry in fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            fs::copy(
                &path,
                place.path(path.file_name().unwrap().to_str().unwrap()),
            )
            .unwrap();
        }
    }
    for (from, to) in study.shorter {
        let files = [
            format!("{}.ron", study.name),
            format!("{}-sweep.ron", study.name),
        ];
        let texts = files.map(|file| (fs::read_to_string(place.path(&file)).unwrap(), file));
        assert!(texts.iter().any(|(text, _)| text.contains(from)), "{from}");
        for (text, file) in texts {
            fs::write(place.path(&file), text.replace(from, to)).unwrap();
        }
    }
    place
}

#[test]
fn scenes_run() {
    for study in STUDIES {
        let place = place(&study);
        run_short(&place, &format!("{}.ron", study.name), study.set);
    }
    let place = Workplace::with("");
    for (name, set) in MEASURED {
        let file = folder().join(format!("{name}.ron"));
        run_short(&place, file.to_str().unwrap(), set);
    }
}

fn run_short(place: &Workplace, file: &str, set: &[&str]) {
    let out = Path::new(file).file_stem().unwrap().to_str().unwrap();
    let mut arguments = vec!["run", file, "--out", out];
    arguments.extend(set.iter().flat_map(|key| ["--set", key]));
    place.succeed(&arguments);
}

/// Each shortened sweep, whose script writes a figure and the table of its page. Without matplotlib the test is
/// skipped, or fails if `ACTIN_REQUIRE_MATPLOTLIB` is set, as in `.ci/run`.
#[test]
fn sweeps_run_and_scripts_draw_them() {
    let what = "the scripts of the studies are";
    let python = python("numpy, matplotlib", "ACTIN_REQUIRE_MATPLOTLIB", what);
    for study in STUDIES {
        let (place, name) = (place(&study), study.name);
        let sweep = format!("{name}-sweep");
        place.succeed(&["sweep", &format!("{sweep}.ron")]);
        let table = fs::read_to_string(place.path(&format!("sweeps/{sweep}/table.csv"))).unwrap();
        assert!(
            table.matches('\n').count() > study.points,
            "{name}: {table}"
        );
        if name == "bundle" {
            place.succeed(&["sweep", "bundle-push-sweep.ron"]);
        }
        let Some(python) = &python else { continue };
        let page = "page.md";
        let block = |name: &str| format!("<!-- generated: {name} -->\n\n<!-- end -->\n\n");
        let empty = block(name) + &block("bundle-push");
        fs::write(place.path(page), empty).unwrap();
        let output = Command::new(python)
            .args([&format!("{name}.py"), "--page", page])
            .current_dir(place.path("."))
            .output()
            .unwrap();
        assert_eq!(
            code(&output),
            0,
            "{name}: {}{}",
            stdout(&output),
            stderr(&output)
        );
        let svg = fs::read_to_string(place.path(&format!("{name}.svg"))).unwrap();
        assert!(svg.len() < 100_000 && svg.contains("</svg>"), "{name}");
        let page = fs::read_to_string(place.path(page)).unwrap();
        assert!(page.lines().count() > 5, "{name}: {page}");
        assert!(!page.contains("nan"), "{name}: {page}");
    }
}

#[test]
fn the_bundle_is_what_its_script_writes() {
    let place = Workplace::with("");
    let script = folder().join("make_bundle.py");
    let Ok(output) = Command::new("python3")
        .arg(script)
        .arg(place.path("."))
        .output()
    else {
        return eprintln!("no python3: the scene of the bundle is NOT TESTED");
    };
    assert!(output.status.success(), "{}", stderr(&output));
    for name in ["bundle.ron", "bundle-sweep.ron", "bundle-push-sweep.ron"] {
        let written = fs::read_to_string(place.path(name)).unwrap();
        assert!(
            written == fs::read_to_string(folder().join(name)).unwrap(),
            "{name}"
        );
    }
}
