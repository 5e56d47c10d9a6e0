"""What verbs that show a lit shape take, declared once."""

from __future__ import annotations

from typing import Annotated, Any

import typer

Mesh = Annotated[str, typer.Option(help="A name (`brdf list meshes`) or a mesh file.")]
Light = Annotated[
    list[str] | None,
    typer.Option(metavar="LIGHT", help="directional:theta=30,phi=45,power=3 or point:1/2/3,power=2; repeatable."),
]
Env = Annotated[str | None, typer.Option(help="Light all around: studio, an .hdr or .exr file, a number.")]
Exposure = Annotated[float, typer.Option(help="Stops.")]
Tone = Annotated[str, typer.Option(help="Tone curve: filmic, neutral, reinhard, clip or linear.")]
NoShadows = Annotated[bool, typer.Option("--no-shadows", help="The mesh does not shadow itself.")]

DEFAULTS = {"mesh": "teapot", "lights": None, "env": None, "exposure": 0.0, "tone": "filmic", "shadows": True}


def given(
    mesh: str, light: list[str] | None, env: str | None, exposure: float, tone: str, no_shadows: bool
) -> dict[str, Any]:
    """Those that are not at their defaults, as `brdf.render` and `brdf.viewer.payload.View` call them."""
    options = {"mesh": mesh, "lights": light or None, "env": number_or_text(env), "exposure": exposure, "tone": tone}
    options["shadows"] = not no_shadows
    return {name: value for name, value in options.items() if value != DEFAULTS[name]}


def number_or_text(text: str | None) -> Any:
    """A number where it is one."""
    try:
        return None if text is None else float(text)
    except ValueError:
        return text
