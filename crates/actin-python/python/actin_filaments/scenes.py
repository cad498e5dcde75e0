"""Parts of scenes as classes: `Filament`, `Rod`, `Ellipsoids`, `EndForce`, `Equilibrium`, ...

The classes are created from the JSON schema of scenes. Arguments are keyword-only and named as in scene files, with
units. Instances are dictionaries, which `Scene` accepts together with plain ones. Invalid keys and choices raise
`SceneError` with the intended name.
"""

from __future__ import annotations

import difflib
import inspect
import json
import keyword
from collections.abc import Iterable
from typing import Any

from actin_filaments._actin import scene_schema
from actin_filaments.errors import SceneError

_SCHEMA: dict[str, Any] = json.loads(scene_schema())
_DEFINITIONS: dict[str, Any] = _SCHEMA["$defs"]


def definition(schema: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Returns name and contents of the definition that a property refers to; an empty name without one."""
    for option in [schema, *schema.get("anyOf", [])]:
        if "$ref" in option:
            name = option["$ref"].rpartition("/")[2]
            return name, _DEFINITIONS[name]
    return "", schema


def argument(key: str) -> str:
    """Returns the argument for a key: `from_` for `from`, which is a keyword of Python."""
    return f"{key}_" if keyword.iskeyword(key) else key


def choices(schema: dict[str, Any]) -> list[str]:
    """Returns the names of the choices without keys."""
    return [option["const"] for option in schema.get("oneOf", []) if "const" in option]


def mistake(key: str, value: object, rule: str, wrong: str, names: Iterable[str]) -> SceneError:
    """Creates the error of an unknown name, with the most similar valid one."""
    names = list(names)
    similar = difflib.get_close_matches(wrong, names, n=1, cutoff=0.5)
    hint = f": did you mean `{similar[0]}`?" if similar else f": one of {', '.join(names)}"
    error = SceneError(f"`{key}` {rule}{hint}")
    error.key, error.value, error.rule = key, str(value), rule
    error.meant = similar[0] if similar else None
    return error


class Part(dict[str, Any]):
    """Part of a scene: a dictionary with checked keys."""

    _choice: str | None = None
    _schema: dict[str, Any] = {}

    def __init__(self, *values: Any, **keys: Any) -> None:
        properties, name = self._schema.get("properties", {}), type(self).__name__
        if values:
            named = zip(self._schema.get("required") or properties, values)
            hint = ", ".join(f"{argument(key)}={value!r}" for key, value in named)
            raise TypeError(f"{name} has keyword arguments only: write {name}({hint})")
        keys = {key.removesuffix("_"): value for key, value in keys.items()}
        for key, value in keys.items():
            if key not in properties:
                raise mistake(f"{name}.{key}", value, f"is not a key of {name}", key, properties)
            self._check(f"{name}.{key}", properties[key], value)
        for key in self._schema.get("required", []):
            if key not in keys:
                error = SceneError(f"`{name}.{key}` is missing")
                error.key, error.rule = f"{name}.{key}", "is missing"
                raise error
        super().__init__(keys if self._choice is None else {self._choice: keys})

    @staticmethod
    def _check(key: str, schema: dict[str, Any], value: object) -> None:
        """Checks the name of a choice without keys."""
        _, options = definition(schema)
        names = choices(options)
        if isinstance(value, str) and names and value not in names:
            raise mistake(key, value, f"= {value!r} is not a choice", value, names)

    def __repr__(self) -> str:
        keys = self if self._choice is None else self[self._choice]
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in keys.items())})"


def _document(schema: dict[str, Any], description: str) -> str:
    """Returns the docstring: the description and a line for each argument."""
    lines = [description, ""]
    for key, of in schema.get("properties", {}).items():
        default = f" Default: {of['default']!r}." if "default" in of else ""
        lines.append(f"- `{key}`: {of.get('description', '')}{default}")
    return "\n".join(lines)


def _signature(schema: dict[str, Any]) -> inspect.Signature:
    kind, required = inspect.Parameter.KEYWORD_ONLY, schema.get("required", [])

    def parameter(key: str, of: dict[str, Any]) -> inspect.Parameter:
        default = inspect.Parameter.empty if key in required else of.get("default")
        return inspect.Parameter(argument(key), kind, default=default)

    return inspect.Signature([parameter(key, of) for key, of in schema.get("properties", {}).items()])


def _class(name: str, choice: str | None, schema: dict[str, Any], description: str) -> type[Part]:
    members = {
        "__doc__": _document(schema, description),
        "__module__": __name__,
        "__signature__": _signature(schema),
        "_choice": choice,
        "_schema": schema,
    }
    return type(name, (Part,), members)


def variants() -> dict[tuple[str, str], str]:
    """Returns the class names of choices with keys, by enumeration and choice.

    A name that several have belongs to a structure, a load or an observable; others begin with their enumeration.
    """
    taken = {name for name, of in _DEFINITIONS.items() if "properties" in of and name not in _payloads()}
    names: dict[tuple[str, str], str] = {}
    order = sorted(_DEFINITIONS, key=lambda name: (name not in ("Load", "Observable"), name != "Load", name))
    for name in order:
        for option in _DEFINITIONS[name].get("oneOf", []):
            for choice in option.get("properties", {}):
                own = name + choice if choice in taken else choice
                taken.add(own)
                names[name, choice] = own
    return names


def _payloads() -> set[str]:
    """Returns the structures that are contents of a choice."""
    options = [option for of in _DEFINITIONS.values() for option in of.get("oneOf", [])]
    contents = [content for option in options for content in option.get("properties", {}).values()]
    return {definition(content)[0] for content in contents if "$ref" in content}


def _classes() -> dict[str, type[Part]]:
    made: dict[str, type[Part]] = {}
    for name, of in _DEFINITIONS.items():
        if "properties" in of and name not in _payloads():
            made[name] = _class(name, None, of, of["description"])
    for (name, choice), own in variants().items():
        options = _DEFINITIONS[name]["oneOf"]
        option = next(option for option in options if choice in option.get("properties", {}))
        content = definition(option["properties"][choice])[1]
        description = content.get("description") or option.get("description", "")
        made[own] = _class(own, choice, content, description)
    return made


globals().update(_classes())
__all__ = sorted(_classes())
