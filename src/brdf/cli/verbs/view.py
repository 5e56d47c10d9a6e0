"""`brdf view`: materials in the browser, to be turned and lit."""

from __future__ import annotations

import signal
import sys
from typing import Annotated

import typer

from .. import arguments, output, scene


def command(
    materials: Annotated[
        list[str], typer.Argument(metavar="MATERIAL...", help="One, or several to compare; each as for other verbs.")
    ],
    mesh: scene.Mesh = "teapot",
    light: scene.Light = None,
    env: scene.Env = None,
    exposure: scene.Exposure = 0.0,
    tone: scene.Tone = "filmic",
    no_shadows: scene.NoShadows = False,
    port: Annotated[int, typer.Option(help="Of this machine. [any free one]")] = 0,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address, open nothing.")] = False,
    json: arguments.AsJson = False,
) -> None:
    """Show materials in the browser.

    Serves one page to this machine alone, at an address that nobody can guess, until Ctrl-C. When a file changes, the
    page shows it anew. `brdf export MATERIAL page.html` writes the same page to send to others.

    \b
    Examples:
      brdf view gold-metallic-paint
      brdf view measured.binary baked.safetensors --mesh sphere --light directional:theta=40
      brdf view GGX:alpha=0.2 --no-browser --port 8765
    """
    from ...viewer.opening import run, serve
    from ...viewer.payload import View

    start = scene.given(mesh, light, env, exposure, tone, no_shadows)
    server = serve(materials, View(**start), port)
    if json:
        output.print_json({"address": server.address, "port": server.port})
    else:
        print(server.address)
        output.note("press Ctrl-C to end")
    sys.stdout.flush()
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)  # a browser that hangs up ends its answer, not the server
    run(server, browser=not no_browser)
