"""Runs the notebook and the Python blocks of pages about this package."""

import re
import subprocess
import sys

import actin_filaments as af
import pytest
from actin_filaments import scenes

PAGES = ["crates/actin-python/README.md", "docs/how-to/python.md"]


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
