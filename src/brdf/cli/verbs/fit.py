"""`brdf fit`: models fitted to measurements."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .. import arguments, output
from ..fitting import fit_folder, read_data

if TYPE_CHECKING:
    from ...fit import FitResult


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
    seed: Annotated[int, typer.Option(min=0, metavar="N", help="Of the starts.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="The fitted material, or the folder of many. [NAME-MODEL.safetensors, fits]",
        ),
    ] = None,
    report: Annotated[
        Path | None, typer.Option("--report", metavar="FILE", help="A figure of the fit: .html, .png, .svg, .pdf.")
    ] = None,
    jobs: Annotated[int, typer.Option(min=1, metavar="N", help="Processes that share many fits.")] = 1,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="A Dask scheduler whose workers fit, as tcp://host:8786.")
    ] = None,
    table: Annotated[
        Path | None, typer.Option("--table", metavar="FILE", help="Of many: .csv or .parquet. [fits.csv in the folder]")
    ] = None,
    json: arguments.AsJson = False,
) -> None:
    """Fit models to measurements.

    Prints every parameter with its standard error, the distance from the data in every metric, and what the data do
    not determine; saves the fitted material. Of several data or models, makes a folder: every fit, one table, one page
    of pictures. Run again, it goes on where it was stopped: finished fits are kept.

    \b
    Examples:
      brdf fit measured.binary --model GGX --lobes 2 --report fit.html
      brdf fit paint.brdf --model CookTorrance --metric cube-root --robust soft_l1
      brdf fit measured.binary --model "Lambertian + Ward" --fix lobe1_albedo
      brdf fit photographs/ --model GGX -o ball.safetensors
      brdf fit merl/*.binary --model GGX,Ward,SGD --jobs 2 -o fits
      brdf fit merl/*.binary --model GGX --scheduler tcp://head:8786 --table fits.parquet
    """
    from ...errors import ParameterError

    options: dict[str, Any] = {
        "lobes": _lobes(lobes), "metric": metric, "diffuse": diffuse, "fixed": fix or (), "robust": robust,
        "budget": int(budget) if re.fullmatch(r"\d{1,9}", budget) else budget, "seed": seed,
    }  # fmt: skip
    models = [name.strip() for name in model.split(",") if name.strip()]
    if len(data) == len(models) == 1 and scheduler is None and table is None:
        _fit_one(data[0], models[0], grazing, options, out, report, json)
        return
    if report is not None:
        raise ParameterError("--report is of one fit; many have a page of their own, index.html in their folder")
    fit_folder(data, models, options | {"grazing": grazing}, out or Path("fits"), jobs, scheduler, table, json)


def _lobes(text: str) -> int | str:
    from ...errors import ParameterError

    if text not in ("1", "2", "3", "auto"):
        raise ParameterError(f"--lobes must be 1 to 3 or auto, got {text!r}")
    return text if text == "auto" else int(text)


def _fit_one(
    spec: str, model: str, grazing: float, options: dict[str, Any], out: Path | None, report: Path | None, json: bool
) -> None:
    from ...errors import UnknownFormatError
    from ...fit import fit

    if out is not None and out.suffix.lower() != ".safetensors":
        raise UnknownFormatError(out, "fits are written as .safetensors; `brdf convert` makes other formats of those.")
    if report is not None:
        from ...plot import figure_format

        figure_format(report)
    with output.working(f"reading {Path(spec).name}") as say:
        data = read_data(spec, grazing)
        lobes = "" if options["lobes"] == 1 else f"-{options['lobes']}-lobes"
        path = out or arguments.named_file(f"{arguments.given_name(spec, data.samples)}-{model}{lobes}", ".safetensors")
        for place in filter(None, (path, report)):
            output.require_writable(place)
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
