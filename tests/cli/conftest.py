"""The command line as tests run it: in this process, in an empty folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from brdf.cli import run


class Outcome(NamedTuple):
    """What a command did."""

    code: int
    out: str
    err: str


Command = Callable[..., Outcome]


@pytest.fixture
def brdf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Runs `brdf ARGUMENTS…` in `tmp_path`."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("BRDF_DEBUG", raising=False)

    def command(*arguments: object) -> Outcome:
        code = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Outcome(code, captured.out, captured.err)

    return command


@pytest.fixture
def refused(brdf: Command) -> Callable[..., str]:
    """Runs a command that must fail as a user's mistake: exit code 2, one line, nothing printed; returns that line."""

    def command(*arguments: object) -> str:
        outcome = brdf(*arguments)
        assert outcome.code == 2, outcome
        assert outcome.err.startswith("brdf: "), outcome
        assert outcome.err.count("\n") == 1, outcome
        assert "Traceback" not in outcome.err
        assert outcome.out == ""
        return outcome.err.strip()

    return command
