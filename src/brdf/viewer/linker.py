"""The viewer's ES modules as one script: no tools, for their syntax is kept plain.

A module imports by `import { a, b } from "./x.js";` and exports by `export function|class|const|let`, or `export
default`, each at the start of a line. So they can stand one behind the other: what a module declares outside of
functions has a name that no other module gives.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from functools import cache
from importlib import resources

from .minified import minified

IMPORT = re.compile(r'^import \{((?:\s*\w+\s*,)*(?:\s*\w+)?\s*)\} from "([^"]+)";\n', re.M)
EXPORT = re.compile(r"^export (?=(?:async )?(?:function|class|const|let) )", re.M)
DECLARATION = re.compile(r"^(export )?(?:async )?(?:function\*?|class|const|let) (\w+|\[[^\]]*\]|\{[^}]*\})", re.M)
UNKNOWN = re.compile(r"^\s*(?:import\b(?! *\()|export\b).*", re.M)


@cache
def sources() -> Mapping[str, str]:
    """All files of `web/` by their path in it."""
    folder = resources.files(__package__).joinpath("web")
    found: dict[str, str] = {}

    def collect(place: resources.abc.Traversable, prefix: str) -> None:
        for item in place.iterdir():
            if item.is_dir():
                collect(item, f"{prefix}{item.name}/")
            elif item.name.endswith((".js", ".css", ".html")):
                found[f"{prefix}{item.name}"] = item.read_text("utf-8")

    collect(folder, "")
    return found


def linked(entry: str, modules: Mapping[str, str] | None = None) -> str:
    """`entry` and what it imports as one script; what it exports by default, the script does. `modules`: texts by
    path, by default the viewer's own.

    Raises ValueError for a module or a name that is missing, for a circle of imports, for a name that two modules
    declare, for syntax beside the plain one.
    """
    texts = sources() if modules is None else modules
    order: list[str] = []
    _visit(entry, texts, order, [])
    _require_unique({path: _declared(texts[path]) for path in order})
    body = "".join(_plain(path, texts, is_entry=path == entry) for path in order)
    if "\nexport default " not in body:
        body = f"{{\n{body}}}\n"  # a script's names are those of the whole page, but for a block's
    return minified('"use strict";\n' + body, "application/javascript")


def _visit(path: str, texts: Mapping[str, str], order: list[str], open_: list[str]) -> None:
    if path in open_:
        raise ValueError(f"modules import each other in a circle: {' -> '.join([*open_, path])}")
    if path in order:
        return
    if path not in texts:
        raise ValueError(f"{open_[-1] if open_ else 'the page'} imports {path}, which does not exist")
    for _, target in IMPORT.findall(texts[path]):
        _visit(_resolved(path, target), texts, order, [*open_, path])
    order.append(path)


def _resolved(path: str, target: str) -> str:
    return posixpath.normpath(posixpath.join(posixpath.dirname(path), target))


def _declared(text: str) -> dict[str, bool]:
    """The names a module declares outside of functions, and whether it exports them."""
    found = DECLARATION.findall(text)
    return {name: bool(exported) for exported, pattern in found for name in re.findall(r"\w+", pattern)}


def _require_unique(declared: Mapping[str, Mapping[str, bool]]) -> None:
    owners: dict[str, str] = {}
    for path, names in declared.items():
        for name in names:
            if name in owners:
                raise ValueError(f"{owners[name]} and {path} both declare {name}")
            owners[name] = path


def _plain(path: str, texts: Mapping[str, str], is_entry: bool) -> str:
    """A module without what imports and exports."""
    for names, target in IMPORT.findall(texts[path]):
        exports = _declared(texts[_resolved(path, target)])
        for name in re.findall(r"\w+", names):
            if not exports.get(name):
                raise ValueError(f"{path} imports {name}, which {_resolved(path, target)} does not export")
    body = EXPORT.sub("", IMPORT.sub("", texts[path]))
    rest = UNKNOWN.search(re.sub(r"^export default ", "", body, count=1, flags=re.M) if is_entry else body)
    if rest:
        raise ValueError(f"{path}: cannot be linked: {rest[0].strip()}")
    return body
