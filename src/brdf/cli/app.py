"""The parser: one command, or one group of commands, a module of `verbs`. The folder is the list."""

from __future__ import annotations

import importlib
import pkgutil

import typer

from . import verbs

# Plain help starts four times faster than boxed help: what draws the boxes is not imported.
app = typer.Typer(
    name="brdf",
    help="Read, evaluate, compact, check and render material reflectance.",
    epilog="MATERIAL is a name (`brdf list materials`), NAME@FIT, a file, or MODEL:alpha=0.2,F0=1/.78/.34; "
    "lobes add up with +, factors multiply with *.",
    rich_markup_mode=None,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _version(asked: bool) -> None:
    if asked:
        from .. import __version__

        typer.echo(f"brdf {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: bool = typer.Option(False, "--version", callback=_version, is_eager=True, help="Print the version."),
) -> None:
    return None


for _found in pkgutil.iter_modules(verbs.__path__):
    _verb = importlib.import_module(f"{verbs.__name__}.{_found.name}")
    if hasattr(_verb, "group"):
        app.add_typer(_verb.group, name=_found.name)
    else:
        app.command(_found.name)(_verb.command)
