"""The viewer's modules in Node.js: what a function of theirs gives for files."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

import brdf.viewer

WEB = Path(brdf.viewer.__file__).parent / "web"


def node(script: str, *arguments: str | Path, folder: Path) -> dict[str, Any]:
    """What the JSON that a module of JavaScript prints says; `import` of `WEB/…` finds the viewer's modules.

    Without Node.js (Debian: nodejs) the test is skipped.
    """
    program = shutil.which("node")
    if program is None:
        pytest.skip("no Node.js; Debian has it in the package nodejs")
    (folder / "package.json").write_text('{"type": "module"}', "utf-8")
    if not (folder / "web").exists():
        shutil.copytree(WEB, folder / "web")
    module = folder / "module.js"
    module.write_text(script.replace("WEB/", "./web/"), "utf-8")
    done = subprocess.run([program, module, *map(str, arguments)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found
