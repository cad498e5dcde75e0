"""Runs the notebook and the Python blocks of pages about this package."""

import os
import re
import subprocess
import sys
from pathlib import Path

import actin_filaments as af
import pytest
from actin_filaments import scenes

PAGES = ["crates/actin-python/README.md", "docs/how-to/python.md"]
EXAMPLES = sorted((Path(__file__).parents[3] / "scenarios/gallery").glob("*.py"))
# Runs an example and compares its scene with the scene file of the same name.
EXAMPLE = """
import pathlib, runpy, sys
import actin_filaments as af
file = pathlib.Path(sys.argv[1])
made = runpy.run_path(str(file))
text = file.with_suffix(".ron")
assert not text.exists() or made["scene"] == af.Scene.from_file(text), "the scenes differ"
"""


@pytest.mark.parametrize("page", PAGES)
def test_blocks_of_a_page_run(root, tmp_path, page):
    pytest.importorskip("matplotlib")
    text = (root / page).read_text()
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert blocks
    code = "import matplotlib\nmatplotlib.use('Agg')\n" + "\n".join(blocks)
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=True)
    figures = re.findall(r'savefig\("(.*?)"\)', text)
    assert all((tmp_path / figure).stat().st_size > 1000 for figure in figures)


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_an_example_of_the_gallery_prints_its_line(root, tmp_path, file):
    """Numbers are within 20 % of the page: thermal motion depends on rounding, and other numbers change far less."""
    pytest.importorskip("matplotlib")
    pytest.importorskip("pandas")
    page = (root / "docs/gallery.md").read_text()
    section = next(one for one in page.split("\n## ") if f"gallery/{file.name})" in one)
    (line,) = re.findall(r"^```text\n(.*)\n```", section, flags=re.MULTILINE)
    (picture,) = re.findall(r"\]\((gallery/.*)\)", section)[:1]
    environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONWARNINGS": "ignore"}
    command = [sys.executable, "-c", EXAMPLE, file]
    made = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    number = re.compile(r"-?\d+(?:\.\d+)?")
    printed = made.stdout.splitlines()[-1]
    assert number.sub("#", printed) == number.sub("#", line)
    assert [*map(float, number.findall(printed))] == pytest.approx([*map(float, number.findall(line))], rel=0.2)
    assert (tmp_path / Path(picture).name).stat().st_size > 5000 and (root / "docs" / picture).exists()


def test_the_gallery_lists_every_example(root):
    page = (root / "docs/gallery.md").read_text()
    assert sorted(re.findall(r"gallery/(\w+)\.py\)", page)) == [file.stem for file in EXAMPLES]


def test_the_reference_is_up_to_date(root):
    """`python crates/actin-python/stubs.py --reference` writes the page."""
    command = [sys.executable, root / "crates/actin-python/stubs.py", "--reference"]
    made = subprocess.run(command, capture_output=True, text=True, check=True)
    assert made.stdout == (root / "docs/reference/python.md").read_text()


def test_the_reference_lists_every_public_name(root):
    text = (root / "docs/reference/python.md").read_text()
    names = [name for name in [*af.__all__, *scenes.__all__] if not name.startswith("_")]
    assert not [name for name in names if not re.search(rf"(^## |`){name}\b", text, flags=re.MULTILINE)]


def test_the_notebook_runs(root, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    notebook = nbformat.read(root / "docs/python.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": tmp_path}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    figures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(figures) == 5
    # The stored notebook has no outputs that could be outdated.
    kept = nbformat.read(root / "docs/python.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in kept.cells)
