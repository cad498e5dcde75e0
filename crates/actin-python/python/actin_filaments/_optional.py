"""Optional dependencies."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def required(module: str, user: str) -> Any:
    """Imports an optional dependency. Raises `ImportError` with the command that installs it."""
    try:
        return import_module(module)
    except ImportError as missing:
        package = module.partition(".")[0]
        raise ImportError(f"{user} needs {package}: pip install {package}") from missing
