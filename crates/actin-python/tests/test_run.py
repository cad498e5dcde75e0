"""Runs: arrays, certificates, directories, failures, interrupts, progress, sweeps."""

import os
import shutil
import signal
import subprocess
import threading
import time
import warnings

import actin_filaments as af
import numpy as np
import pytest


def test_equilibrium_with_certificate(scene):
    found = af.equilibrium(scene, lowest_eigenvalue=True)
    assert found.certificate.stable and found.certificate.negative_eigenvalues == 0
    assert found.certificate.residual_force < 1e-7 and found.certificate.iterations > 3
    assert found.lowest_eigenvalue > found.certificate.resolution
    assert found.position_nm.shape == (25, 3) and found.quaternion.shape == (26, 4)
    assert np.allclose(found.tip_nm, found.position_nm[-1])
    assert np.linalg.norm(found.quaternion, axis=1) == pytest.approx(1.0)
    # The work of a constant force is twice the elastic energy of a linear beam, and less than that of a stiffening
    # beam.
    assert 0.0 < found.elastic_pn_nm < -found.energy_pn_nm


def test_a_motion_is_solved_for_its_equilibrium(scene, motion):
    direct, instead = af.equilibrium(scene), af.equilibrium(motion)
    assert np.array_equal(direct.position_nm, instead.position_nm)


def test_arrays_are_read_only_and_not_copied(motion):
    run = af.run(motion)
    assert run.position_nm is run.position_nm
    with pytest.raises(ValueError, match="read-only"):
        run.position_nm[0, 0, 0] = 1.0
    # A view of the Rust buffer.
    assert run.position_nm.base is not None and not run.position_nm.flags.owndata
    assert run.position_nm.strides == (25 * 3 * 8, 3 * 8, 8)
    assert run.position_nm.shape == run.velocity_nm_per_ns.shape == run.centre_line_nm.shape == (11, 25, 3)
    assert run.quaternion.shape == (11, 26, 4) and run.angular_momentum.shape == (11, 26, 3)
    assert run.s_nm.shape == run.kind.shape == run.filament.shape == (25,)
    assert run.kind_names[run.kind[0]] == "monomer" and run.kind_names[run.kind[-1]] == "node"


def test_energy_of_a_motion_is_kept(motion):
    run = af.run(motion)
    total = sum(run.energies_pn_nm.values()) + run.kinetic_pn_nm
    assert run.kinetic_pn_nm.max() > 0.1
    assert np.abs(total - total[0]).max() < 1e-4 * run.kinetic_pn_nm.max()
    assert np.allclose(run.time_ns, np.arange(11) * 0.1)
    with pytest.raises(AttributeError, match="no path"):
        run.path


def test_observables_have_columns(motion):
    run = af.run(motion.set("observe", [{"Tip": {}}]))
    assert list(run.observables) == ["tip[0]_x_nm", "tip[0]_y_nm", "tip[0]_z_nm"]
    last = [column[-1] for column in run.observables.values()]
    assert last == pytest.approx(run.tip_nm)
    assert all(column.shape == run.time_ns.shape for column in run.observables.values())


def test_a_directory_is_written_and_read_back(motion, tmp_path):
    out = tmp_path / "run"
    run = af.run(motion.set("observe", [{"Tip": {}}]), out)
    back = af.load(out)
    assert {"summary.json", "states.npz", "energies.csv", "scene.ron"} <= set(os.listdir(out))
    assert back.summary == run.summary and back.scene == run.scene
    for name in ("position_nm", "quaternion", "centre_line_nm", "time_ns", "kinetic_pn_nm", "frame_s_nm", "filament"):
        assert np.array_equal(getattr(back, name), getattr(run, name)), name
    assert back.observables.keys() == run.observables.keys()
    with pytest.raises(OSError, match="not empty"):
        af.run(motion, out)
    again = af.run(motion, out, overwrite=True)
    assert np.array_equal(again.position_nm, run.position_nm)
    finished = af.run(motion, out, resume=True)
    assert np.array_equal(finished.position_nm, run.position_nm)
    with pytest.raises(OSError):
        af.load(tmp_path / "none")


def test_a_failed_run_reports_its_location(motion):
    wild = motion.set("task.time_step_ns", 1.0).set("task.allow_unstable_step", True)
    with pytest.raises(af.RunFailed) as caught:
        af.run(wild)
    error = caught.value
    assert error.step is not None and error.step > 0 and error.time_ns > 0.0
    assert "nm" in error.body and error.term in {"bonds", "rod", "junction"}
    assert error.run.status == "failed" and len(error.run) >= 1
    assert isinstance(error, ArithmeticError)


def test_a_problem_of_a_plan_has_its_line(text):
    spoilt = text.replace("Equilibrium()", "Dynamics(duration_ns: 1.0,\n        time_step_ns: 1.0)")
    with pytest.raises(af.SceneError, match="stability limit") as caught:
        af.run(af.Scene.from_ron(spoilt))
    assert (caught.value.key, caught.value.line) == ("task.time_step_ns", 12)


def interrupt_soon(seconds: float) -> None:
    threading.Timer(seconds, lambda: os.kill(os.getpid(), signal.SIGINT)).start()


def test_ctrl_c_ends_a_run_that_keeps_its_records(long_motion, tmp_path):
    interrupt_soon(0.5)
    started = time.monotonic()
    with pytest.raises(af.Interrupted) as caught:
        af.run(long_motion)
    assert time.monotonic() - started < 5.0
    assert isinstance(caught.value, KeyboardInterrupt)
    assert caught.value.run.status == "interrupted" and len(caught.value.run) > 1


def test_an_interrupted_run_is_resumed_to_the_same_bits(scene, tmp_path):
    task = {"Dynamics": {"duration_ns": 300.0, "record_every_ns": 25.0}}
    motion, out = scene.set("task", task), tmp_path / "run"
    whole = af.run(motion)

    def stop_half_way(progress: af.Progress) -> None:
        if progress.share > 0.4:
            raise KeyboardInterrupt

    with pytest.raises(af.Interrupted):
        af.run(motion, out, progress=stop_half_way)
    resumed = af.run(motion, out, resume=True)
    assert resumed.status == "completed"
    assert np.array_equal(resumed.position_nm, whole.position_nm)


def test_a_completed_motion_is_extended_to_the_same_bits(scene, tmp_path):
    def motion(duration_ns: float) -> af.Scene:
        return scene.set("task", {"Dynamics": {"duration_ns": duration_ns, "record_every_ns": 0.5}})

    out = tmp_path / "run"
    af.run(motion(1.0), out)
    extended = af.run(motion(2.0), out, resume=True)
    assert np.array_equal(extended.position_nm, af.run(motion(2.0)).position_nm)
    with pytest.raises(ValueError, match="belongs to another scene"):
        af.run(motion(1.0), out, resume=True)
    summary = out / "summary.json"
    summary.write_text(summary.read_text().replace('"format": 1', '"format": 2'))
    with pytest.raises(ValueError, match="format version 2"):
        af.load(out)


def test_other_threads_run_during_a_run(scene):
    """The interpreter lock is released."""
    ticks = []
    ended = threading.Event()

    def tick() -> None:
        while not ended.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    started = time.monotonic()
    af.run(scene.set("task", {"Dynamics": {"duration_ns": 100.0, "record_every_ns": 100.0}}))
    seconds = time.monotonic() - started
    ended.set()
    thread.join()
    assert len(ticks) > 10 * seconds


def test_progress_is_reported_and_can_end_a_run(scene, long_motion):
    seen = []
    af.run(scene.set("task", {"Dynamics": {"duration_ns": 5.0, "record_every_ns": 0.01}}), progress=seen.append)
    assert seen[-1].share == 1.0 and seen[-1].unit == "ns" and seen[-1].end == 5.0
    assert all(a.share <= b.share for a, b in zip(seen, seen[1:]))

    def refuse(progress: af.Progress) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        af.run(long_motion, progress=refuse)
    with pytest.raises(TypeError, match="progress must be"):
        af.run(scene, progress=3)


def test_the_bar_is_drawn_and_taken_away(motion, capsys):
    af.run(motion, progress=True)
    shown = capsys.readouterr().err
    assert "100 %" in shown and "of 1 ns" in shown and shown.endswith("\r")
    af.run(motion)
    assert capsys.readouterr().err == ""


def test_sweep(scene, tmp_path):
    forces = [-0.5, -1.0, -2.0]
    table = af.sweep(scene, {"loads[0].force_pn[0]": forces}, ["tip_displacement_nm[0]"], jobs=2)
    assert len(table) == 3 and table.failed == 0
    assert np.array_equal(table["loads[0].force_pn[0]"], forces)
    alone = af.equilibrium(scene.set("loads[0].force_pn[0]", -1.0))
    assert table["tip_displacement_nm[0]"][1] == pytest.approx(alone.tip_displacement_nm[0], rel=1e-12)

    together = {("loads[0].force_pn", "filament.rod.law"): [((0.0, -1.0, 0.0), "Constant"), ((0.0, -2.0, 0.0), "Fitted")]}
    kept = af.sweep(scene, together, ["tip_displacement_nm[1]"], out=tmp_path / "sweep")
    assert (tmp_path / "sweep" / "runs" / "1" / "summary.json").exists()
    assert kept["tip_displacement_nm[1]"][1] < kept["tip_displacement_nm[1]"][0] < 0.0
    with pytest.raises(ValueError, match="resume"):
        af.sweep(scene, together, ["tip_displacement_nm[1]"], out=tmp_path / "sweep")
    af.sweep(scene, together, ["tip_displacement_nm[1]"], out=tmp_path / "sweep", resume=True)


def test_sweeps_report_mistakes(scene):
    with pytest.raises(af.SceneError) as caught:
        af.sweep(scene, {"loads[0].forse_pn": [(0.0, 0.0, 1.0)]}, ["tip_nm[0]"])
    assert caught.value.key == "vary[0].rows[0][0]" and "force_pn" in caught.value.rule
    with pytest.raises(af.SceneError) as caught:
        af.sweep(scene, {}, ["tip_nm[7]"])
    assert caught.value.key == "results[0]"
    failing = af.sweep(scene, {"loads[0].force_pn[0]": [-1.0, 1e9]}, ["tip_nm[0]"])
    assert failing.failed == 1 and np.isnan(failing["tip_nm[0]"][1]) and failing["failure"][1]


def test_a_sweep_is_a_mapping_from_values_to_runs(scene):
    pytest.importorskip("pandas")
    forces, laws = np.linspace(-2.0, -1.0, 2), ["Fitted", "Constant"]
    table = af.sweep(scene, {"loads[0].force_pn[0]": forces, "filament.rod.law": laws}, ["energy_pn_nm.total"], jobs=2)
    assert list(table) == [(-2.0, "Fitted"), (-2.0, "Constant"), (-1.0, "Fitted"), (-1.0, "Constant")]
    run = table[forces[1], "Fitted"]
    assert run.scene.to_dict()["loads"][0]["EndForce"]["force_pn"][0] == -1.0
    alone = af.equilibrium(scene.set("loads[0].force_pn[0]", -1.0))
    assert np.allclose(run.position_nm[-1], alone.position_nm, rtol=1e-12)
    assert (-1.0, "Fitted") in table and (-3.0, "Fitted") not in table
    with pytest.raises(KeyError, match="no run and no column"):
        table[-3.0, "Fitted"]
    frame = table.to_dataframe()
    assert list(frame["filament.rod.law"]) == [law for _, law in table] and set(frame["status"]) == {"converged"}
    assert frame.index.dtype == frame["point"].dtype == np.int64 and "seed" not in frame
    assert set(frame["failure"]) == {""}


def test_a_latin_hypercube_fills_each_interval(scene):
    pytest.importorskip("scipy")
    bounds = {"loads[0].force_pn[0]": (-2.0, -1.0), "loads[0].force_pn[1]": (0.0, 1.0)}
    drawn = af.latin_hypercube(bounds, 4, seed=3)
    ((keys, rows),) = drawn.items()
    assert keys == tuple(bounds)
    for column, (low, high) in zip(np.transpose(rows), bounds.values()):
        assert sorted(np.floor(4 * (column - low) / (high - low))) == [0, 1, 2, 3]
    table = af.sweep(scene, drawn, ["tip_nm[1]"])
    assert list(table) == rows and np.all(table["tip_nm[1]"] > 0.0)
    assert table[rows[2]].tip_nm[1] == table["tip_nm[1]"][2]


def test_ctrl_c_ends_a_sweep_that_can_be_resumed(scene, tmp_path):
    short = {"Dynamics": {"duration_ns": 30.0, "record_every_ns": 10.0}}
    vary, results = {"loads[0].force_pn[0]": [-0.5, -1.0, -1.5, -2.0]}, ["tip_nm[0]"]
    interrupt_soon(0.2)
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        af.sweep(scene.set("task", {"Dynamics": {"duration_ns": 1e5}}), vary, results, jobs=2)
    assert time.monotonic() - started < 10.0

    def stop(progress: af.Progress) -> None:
        if progress.at >= 1:
            raise KeyboardInterrupt

    out = tmp_path / "sweep"
    with pytest.raises(KeyboardInterrupt):
        af.sweep(scene.set("task", short), vary, results, jobs=1, out=out, progress=stop)
    resumed = af.sweep(scene.set("task", short), vary, results, jobs=1, out=out, resume=True)
    whole = af.sweep(scene.set("task", short), vary, results, jobs=2)
    assert np.array_equal(resumed["tip_nm[0]"], whole["tip_nm[0]"])


def test_representations(scene, motion):
    found = af.equilibrium(scene)
    assert repr(found).startswith("Equilibrium(stable, energy -")
    assert "certificate" in found._repr_html_() and "stable" in found._repr_html_()
    assert repr(af.run(motion)) == "Run(completed, 11 records, 16 monomers, 8 segments)"


def test_pyvista_gets_lines_and_ellipsoids(scene):
    pytest.importorskip("pyvista")
    found = af.equilibrium(scene)
    blocks = found.to_pyvista()
    assert blocks["rod"].n_points == 9 and blocks["rod"].n_cells == 1
    monomers = blocks["monomers"]
    axes = scene.to_dict()["filament"]["monomers"]["semi_axes_nm"]
    each = monomers.volume / 16
    # The facets have slightly less volume than the ellipsoid.
    assert 0.93 < each / (4 / 3 * np.pi * np.prod(axes)) < 1.0


def test_warnings_are_reported_everywhere(tmp_path):
    """A twist of 0.0698 rad/nm exceeds the range of the rod law, 0.0472; half of it does not."""

    def turned(angle):
        return af.Scene(
            filament={"sections": [{"Rod": {"from_nm": 0.0, "to_nm": 75.0}}], "rod": {"law": "Fitted"}},
            clamps=[{"end": "Start"}, {"end": "End", "slides": "AlongAxis"}],
            path=[{"set": [{"Turn": {"end": "End", "turn_deg": [0.0, 0.0, angle]}}]}],
            task={"Equilibrium": {}},
        )

    message = "twist 0.0698 rad/nm"
    with pytest.warns(af.RunWarning, match=rf"{message}.*\[law-range\]") as caught:
        run = af.run(turned(300.0), tmp_path / "run")
    assert caught[0].filename == __file__
    (found,) = (each["message"] for each in run.warnings if each["code"] == "law-range")
    assert found.startswith(message) and found in run.notes and found in run._repr_html_()
    assert af.load(tmp_path / "run").warnings == run.warnings
    with pytest.warns(af.RunWarning, match=message):
        af.equilibrium(turned(300.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert af.run(turned(150.0)).warnings == []


def test_a_sweep_is_a_workflow(scene, tmp_path):
    """The workflow has a job for each run; the sweep continues in its directory."""
    vary, results = {"loads[0].force_pn[0]": [-1.0, -2.0]}, ["tip_nm[0]"]
    assert af.snakemake(scene, vary, results, tmp_path / "flow") == 2
    assert "rule table" in (tmp_path / "flow" / "Snakefile").read_text()
    table = af.sweep(scene, vary, results, out=tmp_path / "flow", resume=True)
    assert len(table) == 2 and table.failed == 0


def test_snakemake_makes_the_runs_of_a_workflow(root, scene, tmp_path):
    program = shutil.which(os.environ.get("SNAKEMAKE", "snakemake"))
    if program is None or not (root / "target/debug/actin").exists():
        assert "ACTIN_REQUIRE_SNAKEMAKE" not in os.environ
        pytest.skip("Snakemake or the program actin is missing")
    vary, results, flow = {"loads[0].force_pn[0]": [-1.0, -2.0]}, ["tip_nm[0]"], tmp_path / "flow"
    af.snakemake(scene, vary, results, flow)
    environment = os.environ | {
        "PATH": f"{root / 'target/debug'}{os.pathsep}{os.environ['PATH']}", "XDG_CACHE_HOME": str(tmp_path)
    }
    subprocess.run([program, "--cores", "2", "--quiet", "all"], cwd=flow, env=environment, check=True)
    with (flow / "table.csv").open() as rows:
        assert len(rows.readlines()) == 3
    table = af.sweep(scene, vary, results, out=flow, resume=True)
    assert table["tip_nm[0]"][1] == pytest.approx(af.equilibrium(scene).tip_nm[0], rel=1e-9)
