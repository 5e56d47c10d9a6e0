"""`brdf view` as a process: it says where, serves, and ends on Ctrl-C."""

from __future__ import annotations

import json
import signal
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Callable

Refused = Callable[..., str]


def test_it_serves_until_it_is_interrupted() -> None:
    command = [sys.executable, "-m", "brdf.cli", "view", "GGX:alpha=0.2", "--mesh", "sphere", "--no-browser", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        found = json.loads("".join(iter(process.stdout.readline, "}\n")) + "}")
        with urllib.request.urlopen(found["address"], timeout=60) as answer:
            assert b"<title>GGX:alpha=0.2</title>" in answer.read()
        with urllib.request.urlopen(found["address"] + "payload", timeout=60) as answer:
            assert answer.status == 200
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0
        assert process.stderr is not None
        assert process.stderr.read() == ""


def test_mistakes_are_one_line(refused: Refused) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert f"port {port} cannot be used (Address already in use)" in refused("view", "GGX", "--port", port)
    assert "a port lies between 1 and 65535, or is 0 for any free one; got -1" in refused("view", "GGX", "--port", -1)
    assert "did you mean 'GGX'" in refused("view", "GXG")
    assert "unknown mesh 'teapott'" in refused("view", "GGX", "--mesh", "teapott")
    for exposure in ("nan", "inf", "1e9", "-101"):
        said = f"exposure must lie in [-100, 100] stops, got {float(exposure)!r}"
        assert said in refused("view", "GGX", "--exposure", exposure)
    assert "missing argument" in refused("view")
