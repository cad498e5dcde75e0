"""Tables of scenes, and changes of several values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from actin_filaments import _html
from actin_filaments._actin import Scene
from actin_filaments.errors import SceneError


def with_(scene: Scene, changes: Mapping[str, Any] | None, keys: Mapping[str, Any] | None) -> Scene:
    """Returns the scene with other values; a key may have `[*]` for all elements of a list."""
    for key, value in [*(changes or {}).items(), *(keys or {}).items()]:
        for path in _paths(scene, key):
            scene = scene.set(path, value)
    return scene


def _paths(scene: Scene, key: str) -> Iterator[str]:
    before, star, after = key.partition("[*]")
    if not star:
        yield key
        return
    count = _length(scene.to_dict(), before)
    if count == 0:
        error = SceneError(f"`{key}` selects nothing: `{before}` is not a list with elements")
        error.key, error.rule = key, "selects nothing"
        raise error
    for index in range(count):
        yield from _paths(scene, f"{before}[{index}]{after}")


def _length(value: Any, path: str) -> int:
    """Returns the length of a list in a scene; 0 if there is none. Names of choices are not part of paths."""
    for name in path.replace("[", ".[").split("."):
        if isinstance(value, dict) and name not in value and len(value) == 1:
            (value,) = value.values()
        if name.startswith("["):
            inner = int(name[1:-1]) if name[1:-1].isdecimal() else -1
            value = value[inner] if isinstance(value, list) and 0 <= inner < len(value) else None
        else:
            value = value.get(name) if isinstance(value, dict) else None
    return len(value) if isinstance(value, list) else 0


def _named(value: Any) -> tuple[str, dict[str, Any]]:
    """Returns name and keys of a choice."""
    if isinstance(value, dict) and len(value) == 1:
        ((name, keys),) = value.items()
        return name, keys if isinstance(keys, dict) else {"": keys}
    return (value, {}) if isinstance(value, str) else ("", value)


def _text(keys: Mapping[str, Any], most: int = 6) -> str:
    shown = [f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}" for key, value in keys.items()]
    shown = [one for one in shown if len(one) <= 60]
    return ", ".join(shown[:most]) + (", ..." if len(shown) > most else "")


def rows(keys: dict[str, Any]) -> list[tuple[str, str]]:
    """Returns names and contents of the parts of a scene."""
    found = [("title", keys["title"])] if keys.get("title") else []
    filaments = keys["filaments"] if keys.get("filaments") else [keys["filament"]] if keys.get("filament") else []
    for index, filament in enumerate(filaments[:10]):
        sections = filament["sections"]
        named = [_named(section) for section in sections] if isinstance(sections, list) else [_named(sections)]
        text = "; ".join(f"{name} {_extent(of)}" for name, of in named)
        found.append((f"filament {index}", f"{text}; law {_named(filament['rod']['law'])[0]}"))
    if len(filaments) > 10:
        found.append(("filaments", f"{len(filaments)} in all"))
    for key in ("arrangements", "clamps", "loads", "linkers", "linker_sets", "crosslinkers", "observe", "path"):
        values = keys.get(key) or []
        for index, value in enumerate(values[:5]):
            name, of = _named(value)
            found.append((f"{key}[{index}]", f"{name} {_text(of)}".strip()))
        if len(values) > 5:
            found.append((key, f"{len(values)} in all"))
    name, of = _named(keys["task"])
    return [*found, ("task", f"{name} {_text(of)}".strip())]


def _extent(keys: Mapping[str, Any]) -> str:
    if "from_nm" not in keys:
        return _text(keys)
    segments = f" in {keys['segments']} segments" if keys.get("segments") else ""
    return f"{keys['from_nm']:g} to {keys['to_nm']:g} nm{segments}"


def text(keys: dict[str, Any]) -> str:
    """Returns the table as text."""
    table = rows(keys)
    width = max(len(name) for name, _ in table)
    return "\n".join(f"{name.ljust(width)}  {value}" for name, value in table)


def html(scene: Scene) -> str:
    """Returns picture, table and collapsed text of a scene. A scene that cannot be built has no picture."""
    try:
        picture = scene.view().html(height=560)
    except SceneError as error:
        picture = _html.paragraph(f"no picture: {error}")
    return picture + _html.table(repr(scene), rows(scene.to_dict())) + _html.details("scene.ron", scene.to_ron())
