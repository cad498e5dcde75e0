"""Interactive pages of scenes and runs."""

from __future__ import annotations

import os
from pathlib import Path

from actin_filaments import _html
from actin_filaments._actin import Scene


class Page:
    """Interactive page with the bodies, the curves and the summary. Notebooks show it; `save` writes it to a file."""

    text: str
    """Text of the HTML file."""

    def __init__(self, text: str) -> None:
        self.text = text

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the page to an HTML file, replacing an earlier one, and returns the path."""
        path = Path(path)
        path.write_text(self.text, encoding="utf-8")
        return path

    def html(self, height: int = 600) -> str:
        """Returns the page as a frame of a height in pixels."""
        return _html.frame(self.text, height)

    def _repr_html_(self) -> str:
        return self.html()

    def __repr__(self) -> str:
        return f"Page({1e-6 * len(self.text):.1f} MB)"


def of_scene(scene: Scene) -> Page:
    """Returns the page of the initial state of a scene."""
    return Page(scene._page())
