"""HTML representations for notebooks."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape


def of_scene(title: str, ron: str) -> str:
    """Title of a scene, and its collapsed text."""
    return f"<details><summary><code>{escape(title)}</code></summary><pre>{escape(ron)}</pre></details>"


def table(caption: str, rows: Iterable[tuple[str, str]]) -> str:
    """Table of names and values."""
    cells = (f"<tr><th style='text-align:left'>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f"<table><caption>{escape(caption)}</caption>{''.join(cells)}</table>"
