"""Classes of scenes, their types, tables and changes."""

import pickle
import subprocess
import sys
from pathlib import Path

import actin_filaments as af
import numpy as np
import pytest
from actin_filaments import scenes
from actin_filaments.scenes import Clamp, Ellipsoids, EndForce, Equilibrium, Filament, Linker, Ramp, Rod, RodModel


@pytest.fixture
def typed() -> af.Scene:
    return af.Scene(
        filament=Filament(
            sections=[Ellipsoids(from_nm=0.0, to_nm=40.0), Rod(from_nm=40.0, to_nm=160.0, segments=8)],
            rod=RodModel(law="Fitted"),
        ),
        clamps=[Clamp(end="Start")],
        loads=[EndForce(end="End", force_pn=np.array([-2.0, 0.0, 0.0]))],
        task=Equilibrium(),
    )


def test_classes_and_dictionaries_give_one_scene(typed, keys):
    assert typed == af.Scene(**keys)
    part = Rod(from_nm=np.float32(0.0), to_nm=np.int64(40))
    assert part == {"Rod": {"from_nm": 0.0, "to_nm": 40}} and pickle.loads(pickle.dumps(part)) == part
    assert repr(part).startswith("Rod(from_nm=")


@pytest.mark.parametrize(
    ("make", "key", "meant"),
    [
        (lambda: Rod(from_nm=0.0, to=1.0), "Rod.to", "to_nm"),
        (lambda: Rod(from_nm=0.0), "Rod.to_nm", None),
        (lambda: Clamp(end="Strat"), "Clamp.end", "Start"),
        (lambda: RodModel(law="Fited"), "RodModel.law", "Fitted"),
    ],
)
def test_a_wrong_key_fails_at_once(make, key, meant):
    with pytest.raises(af.SceneError, match=key.replace(".", r"\.")) as caught:
        make()
    assert (caught.value.key, caught.value.meant, caught.value.code) == (key, meant, "invalid-scene")


def test_positional_arguments_are_refused():
    with pytest.raises(TypeError, match=r"write Rod\(from_nm=0.0, to_nm=40.0\)"):
        Rod(0.0, 40.0)


def test_every_class_has_documented_arguments():
    assert len(scenes.__all__) > 80
    for name in scenes.__all__:
        part = getattr(scenes, name)
        assert part.__doc__.strip() and all(f"`{key}`" in part.__doc__ for key in part._schema.get("properties", {})), name


def test_a_keyword_of_python_has_a_suffix():
    assert Ramp(from_=0.5, duration_ns=1.0) == {"Ramp": {"from": 0.5, "duration_ns": 1.0}}


def test_stubs_are_up_to_date(root):
    """`python crates/actin-python/stubs.py` writes the types."""
    made = subprocess.run([sys.executable, root / "crates/actin-python/stubs.py"], capture_output=True, text=True, check=True)
    assert made.stdout == (root / "crates/actin-python/python/actin_filaments/scenes.pyi").read_text()


def test_a_typed_program_runs(root, tmp_path):
    """`test.sh` checks its types."""
    subprocess.run([sys.executable, root / "crates/actin-python/tests/typed.py"], cwd=tmp_path, check=True)
    assert (tmp_path / "typed.gsd").stat().st_size > 1000


def test_several_values_are_changed_at_once(typed):
    linkers = [Linker(at_nm=s, displaced_nm=[10.0, 0.0, 0.0], stiffness_pn_per_nm=1.0) for s in np.linspace(50.0, 90.0, 3)]
    scene = typed.set("linkers", linkers).with_({"linkers[*].stiffness_pn_per_nm": 2.0}, title="stiff")
    assert [linker["stiffness_pn_per_nm"] for linker in scene.to_dict()["linkers"]] == [2.0] * 3 and scene.title == "stiff"
    loads = [EndForce(end="End", force_pn=[-float(k), 0.0, 0.0]) for k in (1, 2)]
    scene = typed.set("loads", loads).with_({"loads[*].force_pn[1]": 0.5})
    assert [load["EndForce"]["force_pn"] for load in scene.to_dict()["loads"]] == [[-1.0, 0.5, 0.0], [-2.0, 0.5, 0.0]]
    with pytest.raises(af.SceneError, match="selects nothing") as caught:
        typed.with_({"linkers[*].stiffness_pn_per_nm": 1.0})
    assert caught.value.key == "linkers[*].stiffness_pn_per_nm"


def test_a_scene_is_printed_as_a_table(typed):
    lines = str(typed).splitlines()
    assert lines[0] == "filament 0  Ellipsoids 0 to 40 nm; Rod 40 to 160 nm in 8 segments; law Fitted"
    assert [line.split()[0] for line in lines] == ["filament", "clamps[0]", "loads[0]", "task"]
    html = typed._repr_html_()
    assert "<iframe" in html and "<table>" in html and "scene.ron" in html


def test_all_scenes_of_the_repository_are_printed(root):
    for file in Path(root).glob("scenarios/*.ron"):
        if "Scene(" in file.read_text():
            assert len(str(af.Scene.from_file(file)).splitlines()) > 1, file
