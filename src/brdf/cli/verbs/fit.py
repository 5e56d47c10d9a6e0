"""`brdf fit`: models fitted to measurements."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .. import arguments, output

if TYPE_CHECKING:
    from ...fit import Data, FitResult


def command(
    data: Annotated[
        list[str], typer.Argument(metavar="DATA", help="A file, a folder of photographs of a ball, or any material.")
    ],
    model: Annotated[
        str, typer.Option("--model", metavar="NAME[,NAME]", help="Models, by name or as `Lambertian + Ward`.")
    ],
    lobes: Annotated[str, typer.Option(metavar="N", help="Lobes of the model, 1 to 3, or auto.")] = "1",
    metric: Annotated[
        str, typer.Option(metavar="NAME", help="Made small: l2, log, log-relative, cube-root or image.")
    ] = "l2",
    diffuse: Annotated[
        bool | None,
        typer.Option("--diffuse/--no-diffuse", help="Add a Lambertian part. [where the model has none]"),
    ] = None,
    fix: Annotated[list[str] | None, typer.Option("--fix", metavar="PARAMETER", help="Keep it, by full name.")] = None,
    grazing: Annotated[
        float, typer.Option(metavar="DEGREES", help="From the normal; nothing beyond is fitted.")
    ] = 80.0,
    robust: Annotated[
        str | None, typer.Option(metavar="LOSS", help="Count outliers less: soft_l1, huber or cauchy.")
    ] = None,
    budget: Annotated[
        str, typer.Option(metavar="EFFORT", help="quick, normal or thorough (4, 16, 64 starts), or a number of starts.")
    ] = "normal",
    seed: Annotated[int, typer.Option(metavar="N", help="Of the starts.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="PATH", help="The fitted material. [NAME-MODEL.safetensors]"),
    ] = None,
    report: Annotated[
        Path | None, typer.Option("--report", metavar="FILE", help="A figure of the fit: .html, .png, .svg, .pdf.")
    ] = None,
    json: arguments.AsJson = False,
) -> None:
    """Fit a model to measurements.

    Prints every parameter with its standard error, the distance from the data in every metric, and what the data do
    not determine; saves the fitted material.

    \b
    Examples:
      brdf fit measured.binary --model GGX --lobes 2 --report fit.html
      brdf fit paint.brdf --model CookTorrance --metric cube-root --robust soft_l1
      brdf fit measured.binary --model "Lambertian + Ward" --fix lobe1_albedo
      brdf fit photographs/ --model GGX -o ball.safetensors
    """
    options: dict[str, Any] = {
        "lobes": _lobes(lobes), "metric": metric, "diffuse": diffuse, "fixed": fix or (), "robust": robust,
        "budget": int(budget) if budget.isdigit() else budget, "seed": seed,
    }  # fmt: skip
    _fit_one(data[0], model, grazing, options, out, report, json)


def _lobes(text: str) -> int | str:
    from ...errors import ParameterError

    if text != "auto" and not text.isdigit():
        raise ParameterError(f"--lobes must be 1 to 3 or auto, got {text!r}")
    return text if text == "auto" else int(text)


def _read(spec: str, grazing: float) -> Data:
    """A material, or photographs of a ball: a folder with a list of lights."""
    from ...fit import Data, data_of

    if Path(spec).is_dir() and any(Path(spec).glob("light*.txt")):
        from ...capture import sphere_samples

        return Data(sphere_samples(spec, grazing=grazing), None)
    return data_of(spec, grazing)


def _fit_one(
    spec: str, model: str, grazing: float, options: dict[str, Any], out: Path | None, report: Path | None, json: bool
) -> None:
    from ...fit import fit

    with output.working(f"reading {Path(spec).name}") as say:
        data = _read(spec, grazing)
        path = out or arguments.named_file(f"{data.samples.name}-{model}", ".safetensors")
        output.require_writable(path)
        if report is not None:
            output.require_writable(report)
        result: FitResult = fit(data, model, say=say, **options)
        result.save(path)
        if report is not None:
            from ...plot import fitted, save

            say("drawing")
            save(fitted(result, data.reflectance), report)
    if json:
        files = {"file": str(path)} | ({"report": str(report)} if report else {})
        output.print_json(result.numbers() | files)
        return
    _print(result)
    for written in filter(None, (path, report)):
        print(Path(written).resolve())


def _print(result: FitResult) -> None:
    output.print_table((f"{result.data} by {result.model}", "", "standard error"), result.rows())
    print()
    shown = [(name, f"{value:.4g}") for name, value in result.errors.items()]
    output.print_table(("distance", ""), [*shown, ("BIC", f"{result.bic:.6g}")])
    print(
        f"\n{result.samples:,} pairs within {result.grazing:g}° of the normal, {result.left_out:,} left out; "
        f"{result.agreeing} of {result.starts} starts agree, seed {result.seed}, {result.seconds:.1f} s"
    )
    for warning in result.warnings:
        output.note(warning)
