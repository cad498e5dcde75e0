"""HTML representations for notebooks."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape


def details(title: str, text: str) -> str:
    """Collapsed text."""
    return f"<details><summary><code>{escape(title)}</code></summary><pre>{escape(text)}</pre></details>"


def paragraph(text: str) -> str:
    """Paragraph of text."""
    return f"<p>{escape(text)}</p>"


def frame(page: str, height: int) -> str:
    """A whole page inside another one."""
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe srcdoc="{escape(page)}" style="{style}" sandbox="allow-scripts"></iframe>'


def table(caption: str, rows: Iterable[tuple[str, str]]) -> str:
    """Table of names and values."""
    cells = (f"<tr><th style='text-align:left'>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f"<table><caption>{escape(caption)}</caption>{''.join(cells)}</table>"
