"""Progress bar on a terminal or in a notebook."""

from __future__ import annotations

import sys
from collections.abc import Callable
from html import escape
from typing import TYPE_CHECKING, Any

from actin_filaments._optional import required

if TYPE_CHECKING:
    from actin_filaments._actin import Progress

WIDTH = 32


class Bar:
    """A line on standard error that is rewritten with each update."""

    def __init__(self) -> None:
        self.shown = 0

    def __call__(self, progress: Progress | str) -> None:
        line = progress if isinstance(progress, str) else self.line(progress)
        sys.stderr.write("\r" + line.ljust(self.shown))
        sys.stderr.flush()
        self.shown = len(line)

    @staticmethod
    def line(progress: Progress) -> str:
        """Formats bar, numbers and remaining time."""
        full = int(WIDTH * progress.share)
        left = progress.seconds * (1.0 - progress.share) / progress.share if progress.share > 0.0 else 0.0
        numbers = f"{progress.at:.2f} of {progress.end:.0f} {progress.unit}"
        if progress.unit != "runs" and progress.seconds > 0.0:
            rate = progress.steps / progress.seconds
            numbers += f", {rate:.0f} steps/s, residual {progress.residual_force_pn:.1e} pN"
        return f"{'█' * full}{'░' * (WIDTH - full)} {100.0 * progress.share:3.0f} %  {numbers}  remaining {left:.0f} s"

    def finish(self) -> None:
        """Removes the line."""
        if self.shown:
            sys.stderr.write("\r" + " " * self.shown + "\r")
            sys.stderr.flush()
            self.shown = 0


class NotebookBar(Bar):
    """The same line as an output of a notebook cell."""

    def __init__(self) -> None:
        super().__init__()
        self.handle: Any = None

    def __call__(self, progress: Progress | str) -> None:
        self.show(f"<pre>{escape(progress if isinstance(progress, str) else self.line(progress))}</pre>")

    def show(self, html: str) -> None:
        """Sets the output."""
        notebook: Any = required("IPython.display", "The progress bar")
        if self.handle is None:
            self.handle = notebook.display(notebook.HTML(html), display_id=True)
        else:
            self.handle.update(notebook.HTML(html))

    def finish(self) -> None:
        """Empties the output."""
        if self.handle is not None:
            self.show("")
            self.handle = None


def is_notebook() -> bool:
    """Returns whether an IPython kernel runs this process."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return type(shell).__name__ == "ZMQInteractiveShell"


def callback(progress: Callable[[Any], object] | bool | None) -> Callable[[Any], object] | None:
    """Returns the progress callback: a bar for `True`, and for `None` in a notebook or on a terminal."""
    if progress is None:
        progress = is_notebook() or (sys.stderr is not None and sys.stderr.isatty())
    if progress is True:
        return NotebookBar() if is_notebook() else Bar()
    if progress is False:
        return None
    if not callable(progress):
        raise TypeError(f"progress must be True, False, None or a function, not {progress!r}")
    return progress


def finish(progress: object) -> None:
    """Removes a bar; ignores other callbacks."""
    if isinstance(progress, Bar):
        progress.finish()
