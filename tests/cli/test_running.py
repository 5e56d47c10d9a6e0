"""How the command starts, ends, and fails when the fault is not the user's."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import brdf as package
from brdf import cli

Command = Callable[..., Any]

BRDF = [sys.executable, "-m", "brdf.cli"]


def test_help_lists_the_verbs(brdf: Command) -> None:
    for arguments in ((), ("--help",), ("-h",)):
        outcome = brdf(*arguments)
        assert outcome.code == 0
        for verb in ("bake", "check", "convert", "info", "list", "render", "show"):
            assert f"\n  {verb} " in outcome.out


@pytest.mark.parametrize("verb", ["bake", "check", "convert", "info", "list", "render", "show"])
def test_every_verb_has_help_with_examples(brdf: Command, verb: str) -> None:
    outcome = brdf(verb, "--help")
    assert outcome.code == 0
    assert "Examples:" in outcome.out
    assert f"    brdf {verb} " in outcome.out


def test_version(brdf: Command) -> None:
    assert brdf("--version").out == f"brdf {package.__version__}\n"


def test_the_command_as_a_process() -> None:
    done = subprocess.run([*BRDF, "list", "meshes", "--json"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert '"teapot"' in done.stdout
    done = subprocess.run([*BRDF, "info", "nothing"], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("brdf: unknown material 'nothing'")
    assert done.stderr.count("\n") == 1


def test_interrupting_ends_quietly_with_130(tmp_path: Path) -> None:
    command = [*BRDF, "render", "gold-metallic-paint", "--samples", "4096", "--size", "1600x1200", "-o", "x.png"]
    process = subprocess.Popen(
        command,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # a shell starts jobs in the background deaf to interrupts, and children inherit that
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(3)
    process.send_signal(signal.SIGINT)
    try:
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130
    assert (out, err) == ("", "")
    assert os.listdir(tmp_path) == []


@pytest.mark.skipif(not hasattr(signal, "SIGPIPE"), reason="a POSIX convention")
def test_a_reader_that_leaves_ends_the_command_silently() -> None:
    process = subprocess.Popen(
        [*BRDF, "info", "GGX", "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    process.stdout.close()
    assert process.stderr is not None
    assert process.stderr.read() == ""
    process.stderr.close()
    assert process.wait(timeout=60) == -signal.SIGPIPE


def test_a_fault_of_ours_asks_to_be_reported(brdf: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def fault(*_: object) -> int:
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(cli, "_dispatch", fault)
    outcome = brdf("list", "models")
    assert outcome.code == 3
    assert outcome.err == (
        "brdf: unexpected ZeroDivisionError: division by zero; "
        "please report it with the traceback that BRDF_DEBUG=1 shows\n"
    )
    monkeypatch.setenv("BRDF_DEBUG", "1")
    with pytest.raises(ZeroDivisionError):
        cli.run(["list", "models"])
