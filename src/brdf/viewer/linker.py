"""The viewer's ES modules as one script: no tools, for their syntax is kept plain.

A module imports by `import { a, b as c } from "./x.js";` and exports by `export function|class|const|let`, or
`export default`, each at the start of a line. Each becomes a block of its own, so that names need not be unique.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from functools import cache
from importlib import resources

from .compact import compacted
from .renaming import renamed

IMPORT = re.compile(r'^import \{([^}]*)\} from "([^"]+)";\n', re.M)
EXPORT = re.compile(r"^export (?:async )?(?:function\*?|class|const|let) (\w+)", re.M)
UNKNOWN = re.compile(r"^\s*(?:import\b(?! *\()|export\b).*", re.M)

DEFAULT = "entry_default"


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


def linked(entry: str, modules: Mapping[str, str] | None = None, small: bool = True) -> str:
    """`entry` and what it imports as one script; what it exports by default, the script does. `modules`: texts by
    path, by default the viewer's own. Unless `small`, names and space stay as they are, which takes no time.

    Raises ValueError for a module that is missing, for a circle of imports, for syntax beside the plain one.
    """
    texts = sources() if modules is None else modules
    order: list[str] = []
    _visit(entry, texts, order, [])
    numbers = {path: number for number, path in enumerate(order)}
    exports = {path: EXPORT.findall(texts[path]) for path in order}
    parts = [_wrapped(path, texts[path], numbers, exports) for path in order]
    body = f"let {', '.join(map(_module, numbers.values()))};\n" + "".join(parts)
    if "export default" in texts[entry]:
        body += f"export default {_module(numbers[entry])}[{len(exports[entry])}];\n"
    else:
        body = f"{{\n{body}}}\n"  # a script's names are those of the whole page, but for a block's
    return '"use strict";\n' + (compacted(renamed(body)) if small else body)


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


def _module(number: int) -> str:
    return f"module_{number}"


def _wrapped(path: str, text: str, numbers: Mapping[str, int], exports: Mapping[str, list[str]]) -> str:
    """A module as a block that leaves behind what it exports, in a list: names would take room."""

    def bound(match: re.Match[str]) -> str:
        target = _resolved(path, match[2])
        places = [""] * len(exports[target])
        for name in filter(None, map(str.strip, match[1].split(","))):
            given, *renamed_to = re.split(r"\s+as\s+", name)
            if given not in exports[target]:
                raise ValueError(f"{path} imports {given}, which {target} does not export")
            places[exports[target].index(given)] = renamed_to[0] if renamed_to else given
        return f"const [{', '.join(places).rstrip(', ')}] = {_module(numbers[target])};\n"

    body = IMPORT.sub(bound, text)
    exported = list(exports[path])
    body = re.sub(r"^export (?=(?:async )?(?:function|class|const|let) )", "", body, flags=re.M)
    if re.search(r"^export default ", body, re.M):
        body = re.sub(r"^export default ", f"const {DEFAULT} = ", body, count=1, flags=re.M)
        exported.append(DEFAULT)
    rest = UNKNOWN.search(body)
    if rest:
        raise ValueError(f"{path}: cannot be linked: {rest[0].strip()}")
    return f"{{\n{body}{_module(numbers[path])} = [{', '.join(exported)}];\n}}\n"
