"""Scenes: construction, and errors that name their keys."""

import pickle

import actin_filaments as af
import numpy as np
import pytest


def test_keywords_dictionary_and_text_are_one_scene(keys, text):
    scene = af.Scene(**keys)
    assert scene == af.Scene.from_dict(keys) == af.Scene.from_ron(text)
    assert af.Scene.from_dict(scene.to_dict()) == scene
    assert af.Scene.from_ron(scene.to_ron()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    keys["loads"][0]["EndForce"]["force_pn"] = np.array([-2, 0, 0])
    keys["filament"]["sections"][1]["Rod"]["segments"] = np.int32(8)
    assert af.Scene(**keys) == scene


def test_scenes_of_the_repository_are_read(root):
    files = [file for file in root.glob("scenarios/*.ron") if "Scene(" in file.read_text()]
    assert len(files) > 5
    for file in files:
        scene = af.Scene.from_file(file)
        assert af.Scene.from_dict(scene.to_dict(), folder=file.parent) == scene, file


def test_files_of_points_are_looked_for_in_the_folder(keys, tmp_path):
    (tmp_path / "trace.csv").write_text("0,0,0\n0,10,80\n0,0,170\n")
    keys["filament"]["shape"] = {"Points": {"file": "trace.csv"}}
    scene = af.Scene.from_dict(keys, folder=tmp_path)
    assert scene.to_dict()["filament"]["shape"]["Points"]["nm"][1] == [0.0, 10.0, 80.0]
    with pytest.raises(af.SceneError, match="cannot be read") as caught:
        af.Scene.from_dict(keys, folder=tmp_path / "elsewhere")
    assert caught.value.key == "filament.shape.file"


@pytest.mark.parametrize(
    ("old", "new", "key", "meant"),
    [
        ("to_nm: 40.0", "to: 40.0", "filament.sections[0].to", "to_nm"),
        ("segments: 8", "segmens: 8", "filament.sections[1].segmens", "segments"),
        ("to_nm: 160.0", "to_nm: -160.0", "filament.sections[1].to_nm", None),
        ("end: Start", "end: Begin", "clamps[0].end", None),
        ("(-2.0, 0.0, 0.0)", "(-2.0, 0.0)", "loads[0].force_pn", None),
    ],
)
def test_mistakes_of_a_text_name_key_line_and_column(text, old, new, key, meant):
    spoilt = text.replace(old, new)
    line = next(i for i, row in enumerate(spoilt.splitlines(), 1) if new in row)
    with pytest.raises(af.SceneError) as caught:
        af.Scene.from_ron(spoilt)
    error = caught.value
    # A value without a key is reported at its parent.
    assert error.key.startswith(key)
    assert (error.line, error.meant) == (line, meant)
    assert error.column and spoilt.splitlines()[line - 1][: error.column - 1].count("(") <= 3
    assert error.mistakes[0].key == error.key


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError, match="none.ron"):
        af.Scene.from_file(tmp_path / "none.ron")
    (tmp_path / "latin.ron").write_bytes(b"Scene(\n    title: \"\xe9\")")
    with pytest.raises(af.SceneError, match="not UTF-8") as caught:
        af.Scene.from_file(tmp_path / "latin.ron")
    assert (caught.value.line, caught.value.column) == (2, 13)


def test_errors_of_a_file_begin_with_its_path(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bent.ron").write_text(text.replace("to_nm: 160.0", "to: 160.0"))
    with pytest.raises(af.SceneError, match=r"^bent\.ron:5:32: unknown key `to`") as caught:
        af.Scene.from_file("bent.ron")
    assert str(caught.value.mistakes[0]) == str(caught.value)
    for solve in (af.equilibrium, af.run):
        with pytest.raises(TypeError, match="Scene"):
            solve("bent.ron")


def test_all_mistakes_of_a_text_are_reported(text):
    with pytest.raises(af.SceneError) as caught:
        af.Scene.from_ron(text.replace("segments", "segmens").replace("end: Start", "end: Begin"))
    assert [mistake.line for mistake in caught.value.mistakes] == [5, 9]


@pytest.mark.parametrize(
    ("path", "value", "key"),
    [
        ("filament.sections[1].segmens", 3, "filament.sections[1].segmens"),
        ("filament.sections[1].segments", 3.5, "filament.sections[1].segments"),
        ("filament.sections[1].segments", -3, "filament.sections[1].segments"),
        ("filament.sections[0].to_nm", 50.0, "filament.sections[1].from_nm"),
        ("loads[0].force_pn[1]", float("nan"), "loads[0].force_pn"),
        ("loads[1].force_pn", 1.0, "loads[1].force_pn"),
        ("task", "Dynamics", "task"),
        ("filament.rod.law", "Fited", "filament.rod.law"),
    ],
)
def test_mistakes_of_a_dictionary_name_the_key(scene, path, value, key):
    with pytest.raises(af.SceneError) as caught:
        scene.set(path, value)
    assert caught.value.key == key
    assert caught.value.line is None and caught.value.rule
    assert isinstance(caught.value, ValueError)


def test_set_gives_another_scene(scene):
    other = scene.set("loads[0].force_pn[0]", -1.0).set("filament.sections[1].segments", 4)
    assert other.to_dict()["loads"][0]["EndForce"]["force_pn"] == [-1.0, 0.0, 0.0]
    assert scene.to_dict()["loads"][0]["EndForce"]["force_pn"] == [-2.0, 0.0, 0.0]
    assert other.check()["counts"]["segments"] == 4


def test_objects_that_are_no_values_are_refused(scene):
    with pytest.raises(TypeError, match="a scene holds no"):
        scene.set("title", object())
    with pytest.raises(TypeError, match="keys of a scene are strings"):
        af.Scene.from_dict({1: 2})
    with pytest.raises(TypeError):
        hash(scene)


def test_seeds(scene):
    independent = scene.set("filament.monomers.anchors", "Independent")
    assert independent.reseed(7).to_dict()["filament"]["monomers"]["seed"] == 7
    rod = {"sections": [{"Rod": {"from_nm": 0.0, "to_nm": 40.0}}]}
    with pytest.raises(af.SceneError, match="nothing random"):
        af.Scene(filament=rod, clamps=[{"end": "Start"}], task={"Equilibrium": {}}).reseed(7)


def test_check_resolves_the_scene(scene, motion):
    assert scene.check()["counts"] == {"monomers": 16, "bonds": 348, "segments": 8, "junctions": 1, "dofs": 141}
    found = motion.check()
    assert found["scene"].to_dict()["task"]["Dynamics"]["time_step_ns"] == found["time_step_ns"]
    assert found["steps"] * found["time_step_ns"] == pytest.approx(1.0)
    assert found["seconds"] > 0.0 and "evaluations" in found["cost"]


def test_representations(scene):
    assert repr(scene) == "Scene(1 filament, Equilibrium)"
    assert repr(scene.set("title", "<b>")) == 'Scene("<b>", 1 filament, Equilibrium)'
    html = scene.set("title", "<b>")._repr_html_()
    assert "&lt;b&gt;" in html and "<b>" not in html


def test_arrangements_and_sets_of_linkers_are_made_again(root):
    scene = af.Scene.from_file(root / "scenarios/random-network.ron")
    fewer = scene.set("linker_sets[0].per_filament", 1.0).set("arrangements[0].count", 80)
    assert len(fewer.to_dict()["filaments"]) == 80
    assert len(fewer.to_dict()["linkers"]) == 80
    one = scene.set("linkers[3].rest_length_nm", 7.0).to_dict()["linkers"]
    assert len(one) == 250
    assert one[3]["rest_length_nm"] == 7.0
    assert one[4] == scene.to_dict()["linkers"][4]


def test_files_of_points_beside_an_arrangement_are_found_again(keys, tmp_path):
    (tmp_path / "trace.csv").write_text("0,0,0\n0,10,80\n0,0,170\n")
    keys["arrangements"] = [{"Copies": {"filament": dict(keys["filament"]), "count": 2, "shift_nm": [50.0, 0.0, 0.0]}}]
    keys["filament"]["shape"] = {"Points": {"file": "trace.csv"}}
    scene = af.Scene.from_dict(keys, folder=tmp_path)
    more = scene.set("arrangements[0].count", 3)
    assert len(more.to_dict()["filaments"]) == 4
