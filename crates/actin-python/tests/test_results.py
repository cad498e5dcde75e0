"""Results as tables, frames, plots, pages and files of other programs."""

import io
import json
import shutil
import sys
import warnings

import actin_filaments as af
import numpy as np
import pytest


@pytest.fixture(scope="module")
def run() -> af.Run:
    from conftest import KEYS

    task = {"Dynamics": {"duration_ns": 1.0, "record_every_ns": 0.1}}
    return af.run(af.Scene(**{**KEYS, "task": task, "observe": [{"Tip": {}}]}))


def test_frames_are_the_records(run):
    assert [frame.index for frame in run] == list(range(11)) and run[-1].index == 10
    assert [frame.time_ns for frame in run[::5]] == pytest.approx([0.0, 0.5, 1.0])
    last = run[-1]
    assert np.shares_memory(last.position_nm, run.position_nm) and np.array_equal(last.position_nm, run.position_nm[-1])
    assert last.observables["tip[0]_x_nm"] == pytest.approx(run.tip_nm[0])
    assert sum(last.energies_pn_nm.values()) + last.kinetic_pn_nm == pytest.approx(run.summary["energy_pn_nm"]["total"])
    with pytest.raises(IndexError):
        run[11]


def test_a_table_has_a_row_for_each_record(run):
    pytest.importorskip("pandas")
    table = run.to_dataframe()
    assert len(table) == 11 and table["time_ns"].iloc[-1] == pytest.approx(1.0)
    assert np.array_equal(table["tip[0]_x_nm"], run.observables["tip[0]_x_nm"])
    assert {"bonds_pn_nm", "kinetic_pn_nm", "residual_force_pn"} <= set(table.columns)


def test_a_data_set_has_coordinates(run):
    pytest.importorskip("xarray")
    data = run.to_xarray()
    tip = data["centre_line_nm"].isel(point=-1).sel(axis="x").sel(time_ns=1.0, method="nearest")
    assert float(tip) == run.centre_line_nm[-1, -1, 0]
    assert data.sizes["point"] == 25 and data.sizes["frame"] == 26
    assert float(data["s_nm"][-1]) == 160.0


@pytest.mark.parametrize(("module", "method"), [("pandas", "to_dataframe"), ("xarray", "to_xarray"), ("MDAnalysis", "to_mdanalysis")])
def test_a_missing_package_is_named_with_its_command(run, monkeypatch, module, method):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=f"Run.{method} needs {module}: pip install {module}"):
        getattr(run, method)()


def test_plots(run):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    ax = run.plot()
    energies, observed = ax.figure.axes
    assert "kinetic" in [line.get_label() for line in energies.get_lines()]
    assert [line.get_label() for line in observed.get_lines()] == list(run.observables)
    assert energies.get_lines()[0].get_ydata().shape == (11,)
    profile = run.plot_profile("curvature")
    (line,) = profile.get_lines()
    assert profile.get_ylabel() == "curvature (rad/nm)" and line.get_xdata()[-1] == pytest.approx(160.0)
    with pytest.raises(ValueError, match="field = 'colour' is not one of curvature, twist, energy"):
        run.plot_profile("colour")


def test_the_profile_of_a_cantilever_falls_to_the_tip(scene, tmp_path):
    """The moment of a force at the tip is proportional to the distance from it."""
    found = af.equilibrium(scene)
    profile = found.run.profile()
    curvature, s = profile["curvature_rad_per_nm"], profile["s_nm"]
    middle = (s > 60.0) & (s < 140.0)
    assert np.all(np.diff(curvature[middle]) < 0.0) and curvature[middle][0] > 3.0 * curvature[middle][-1] > 0.0
    in_directory = af.run(scene, tmp_path / "run").profile()
    assert np.allclose(in_directory["curvature_rad_per_nm"], curvature, atol=1e-12)


def test_pages(run, scene, tmp_path):
    for page in (run.view(), af.equilibrium(scene).view(), scene.view()):
        assert page.text.startswith("<!DOCTYPE html>") and "srcdoc=" in page._repr_html_()
    # The scene has one record, and the run all.
    assert len(run.view().text) > len(scene.view().text)
    assert scene.view().save(tmp_path / "scene.html").stat().st_size > 10_000


def test_exports(run, scene, tmp_path):
    (gsd_file,) = run.to_gsd(tmp_path / "run.gsd")
    files = run.to_simularium(tmp_path / "run.simularium")
    assert len(json.loads(files[0].read_text())["spatialData"]["bundleData"]) == 11
    pictures = run.to_vtk(tmp_path / "vtk")
    assert len(pictures) == 12 and pictures[-1].name == "run.pvd"
    with pytest.raises(OSError, match="exist"):
        run.to_vtk(tmp_path / "vtk")
    with pytest.raises(OSError, match="exist"):
        run.to_gsd(gsd_file)
    assert run.to_gsd(gsd_file, overwrite=True) == [gsd_file]
    without = scene.set("output.states", False)
    with pytest.raises(ValueError, match="the run has no states"):
        af.load(af.run(without, tmp_path / "run").directory).to_gsd(tmp_path / "none.gsd")
    hoomd = pytest.importorskip("gsd.hoomd")
    with hoomd.open(gsd_file) as frames:
        assert len(frames) == 11
        # GSD has single precision and its own origin.
        moved = frames[10].particles.position[:25] - frames[0].particles.position[:25]
        assert np.allclose(moved, run.position_nm[10] - run.position_nm[0], atol=1e-3)


def test_vtk_files_are_read(run, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    *_, collection = run.to_vtk(tmp_path)
    records = pyvista.get_reader(collection)
    assert records.time_values == pytest.approx(run.time_ns)
    records.set_active_time_point(10)
    (points,) = records.read()
    assert points.n_points == 25 and np.array_equal(points["s_nm"], run.s_nm)
    assert np.allclose(points.points, run.position_nm[10], rtol=1e-6)


def test_files_of_switching_linkers_need_a_directory(tmp_path):
    scene = af.Scene.from_ron(
        """Scene(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
            clamps: [Clamp(end: Start)],
            linkers: [Linker(at_nm: 50.0, displaced_nm: (1.0, 0.0, 0.0), stiffness_pn_per_nm: 1.0,
                kinetics: Kinetics(seed: 1, breaks: Breaking(rate_per_ns: 1e-3)))],
            task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
        )"""
    )
    with pytest.raises(ValueError, match="events of its linkers"):
        af.run(scene).to_gsd(tmp_path / "run.gsd")
    assert af.run(scene, out=tmp_path / "run").to_gsd(tmp_path / "run.gsd")


def test_mdanalysis(run):
    pytest.importorskip("MDAnalysis")
    universe = run.to_mdanalysis()
    assert universe.trajectory.n_frames == 11 and len(universe.atoms) == 25
    universe.trajectory[-1]
    assert np.allclose(universe.atoms.positions, 10.0 * run.position_nm[-1], atol=1e-2)
    assert universe.trajectory.time == pytest.approx(1000.0)


def test_an_unfinished_run_has_the_records_of_its_checkpoint(scene, tmp_path):
    motion = scene.set("task", {"Dynamics": {"duration_ns": 300.0, "record_every_ns": 5.0}})
    out, kept = tmp_path / "run", tmp_path / "kept"

    def copy(progress: af.Progress) -> None:
        if progress.share > 0.4 and (out / "checkpoint.bin").exists() and not kept.exists():
            shutil.copytree(out, kept)
            raise KeyboardInterrupt

    with pytest.raises(af.Interrupted) as caught:
        af.run(motion, out, checkpoint_every_s=0.05, progress=copy)
    left = af.Run.open(kept)
    assert left.status == "unfinished" and 1 < len(left) <= len(caught.value.run)
    assert np.array_equal(left.position_nm, caught.value.run.position_nm[: len(left)])
    assert left.tip_nm == pytest.approx(left.centre_line_nm[-1, -1])
    assert "unfinished" in left._repr_html_() and left.view().text


def test_errors_have_codes(motion):
    wild = motion.set("task.time_step_ns", 1.0).set("task.allow_unstable_step", True)
    with pytest.raises(af.RunFailed) as caught:
        af.run(wild)
    assert (caught.value.code, caught.value.key, caught.value.value) == ("diverged", "", "")
    with pytest.raises(af.SceneError) as refused:
        motion.set("filament.sections[0].to_nm", -1.0)
    assert (refused.value.code, refused.value.key, float(refused.value.value)) == (
        "invalid-scene", "filament.sections[0].to_nm", -1.0,
    )


def test_the_former_name_warns(scene):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        import actin
        from actin.results import Run
    assert [one.category for one in caught] == [DeprecationWarning] and "import actin_filaments" in str(caught[0].message)
    assert actin.Scene is af.Scene and Run is af.Run and actin.__version__ == af.__version__


def test_a_package_of_the_former_name_comes_first(tmp_path):
    """The package `actin` of PyPI is a folder in the same place, which Python prefers to a module."""
    import subprocess
    from pathlib import Path

    own = Path(af.__file__).parents[1] / "actin.py"
    shutil.copy(own, tmp_path)
    (tmp_path / "actin").mkdir()
    (tmp_path / "actin" / "__init__.py").write_text("other = True\n")
    code = "import sys; sys.path.insert(0, sys.argv[1]); import actin; assert actin.other"
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=True)


def test_a_bar_in_a_notebook_is_one_output(monkeypatch, motion):
    pytest.importorskip("IPython")
    import IPython.display
    from actin_filaments import _progress

    shown = io.StringIO()

    class Handle:
        def update(self, html):
            shown.write(html.data + "\n")

    monkeypatch.setattr(_progress, "is_notebook", lambda: True)
    monkeypatch.setattr(IPython.display, "display", lambda html, display_id: Handle().update(html) or Handle())
    af.run(motion.set("task.duration_ns", 20.0))
    assert "remaining" in shown.getvalue() and shown.getvalue().endswith("\n\n")
