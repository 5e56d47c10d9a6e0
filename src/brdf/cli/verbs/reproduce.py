"""`brdf reproduce`: the results of a source document, made again."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from .. import arguments, output

if TYPE_CHECKING:
    from ...reproduce import Report


def command(
    name: Annotated[str | None, typer.Argument(metavar="NAME", help="The document, see --list.")] = None,
    out: Annotated[Path | None, typer.Option("-o", "--output", help="Folder. [NAME-results]")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Fewer materials, smaller pictures, about a minute.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace the folder of an earlier run.")] = False,
    list_: Annotated[bool, typer.Option("--list", help="The documents by name.")] = False,
    json: arguments.AsJson = False,
) -> None:
    """Make a document's results again.

    Figures, tables with the document's numbers beside ours, and a verdict on each of its claims, in a folder:
    index.html to read, results.json with every number, results.md, and the pictures.

    \b
    Examples:
      brdf reproduce --list
      brdf reproduce images --quick
      brdf reproduce images -o results --json
    """
    from ...errors import ParameterError
    from ...reproduce import names, reproduce, title

    if list_:
        titles = {document: title(document) for document in names()}
        if json:
            output.print_json(list(titles))
        else:
            output.print_table(("name", "document"), list(titles.items()))
        return
    if name is None:
        raise ParameterError(f"give the document to reproduce: {', '.join(names())}")
    report = reproduce(name, out, quick, force)
    assert report.folder is not None
    if json:
        output.print_json(report.results() | {"folder": str(report.folder)})
        return
    _print(report)
    print((report.folder / "index.html").resolve())


def _print(report: Report) -> None:
    for table in report.tables:
        print(f"\n{table.caption}")
        if table.is_long:
            print(f"{len(table.rows)} rows, see index.html")
        else:
            output.print_table(table.flat_headings(), table.texts())
        if table.verdict:
            print(table.verdict)
    print()
    for claim in report.claims:
        print(f"“{claim.statement}”: {claim.verdict}")
        for text, held in claim.checks.items():
            print(f"  {'yes' if held else 'no '}  {text}")
    print()
