"""The repository keeps its own rules: what is promised in one file holds in the others."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
CI = (ROOT / ".ci" / "run").read_text("utf-8")


def test_the_lock_file_names_public_registries_only() -> None:
    hosts = set(re.findall(r"https?://([^/\"]+)", (ROOT / "uv.lock").read_text("utf-8")))
    assert hosts == {"pypi.org", "files.pythonhosted.org"}


def test_ci_runs_the_commands_of_the_readme() -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    for command in ("uv run brdf render gold-metallic-paint", "uv run --all-extras pytest"):
        assert command in CI
        assert f"pip install uv && {command}" in readme


def test_versions_agree() -> None:
    import brdf

    assert brdf.__version__ == PROJECT["project"]["version"]
    assert f"## {brdf.__version__}" in (ROOT / "CHANGELOG.md").read_text("utf-8")


def test_every_module_has_its_layer() -> None:
    (contract,) = PROJECT["tool"]["importlinter"]["contracts"]
    layers = {name.strip() for layer in contract["layers"] for name in layer.split(":")}
    modules = {path.stem for path in (ROOT / "src" / "brdf").iterdir() if path.suffix in ("", ".py")}
    assert modules - {"__init__", "__pycache__", "py"} <= layers


def _tracked() -> list[Path]:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode:
        return [p for folder in ("src", "tests", "docs") for p in (ROOT / folder).rglob("*.py")]
    return [ROOT / line for line in listed.stdout.splitlines()]


@pytest.mark.parametrize("pattern", [r"/(?:work|root|home)/[a-z]", r"\bTO" r"DO\b|\bFIX" r"ME\b"])
def test_no_file_holds_a_path_of_a_machine_or_a_reminder(pattern: str) -> None:
    found = []
    for path in _tracked():
        if path.suffix in (".py", ".md", ".toml", ".bib", "") and path.is_file() and path != Path(__file__):
            text = path.read_text("utf-8", errors="ignore")
            found += [f"{path.relative_to(ROOT)}: {match[0]}" for match in re.finditer(pattern, text)]
    assert found == []


def test_modules_stay_readable() -> None:
    long = {str(p): n for p in (ROOT / "src").rglob("*.py") if (n := len(p.read_text("utf-8").splitlines())) > 400}
    assert long == {}


def test_the_python_of_the_readme_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text("utf-8"), re.S)
    exec(compile(code, "README.md", "exec"), {})
    assert {path.name for path in tmp_path.iterdir()} == {"teapot.png", "gold.safetensors"}


def test_every_citation_is_in_the_bibliography() -> None:
    known = set(re.findall(r"@\w+\{(\w+),", (ROOT / "docs" / "references.bib").read_text("utf-8")))
    cited = {
        key
        for path in (ROOT / "src").rglob("*.py")
        for sentence in re.findall(r"References?: ([^\n]*(?:\n    [A-Z]\w+\d{4}[^\n]*)*)", path.read_text("utf-8"))
        for key in re.findall(r"\b[A-Z][A-Za-z]+\d{4}\b", sentence)
    }
    assert cited - known == set()
    assert len(cited) > 10
