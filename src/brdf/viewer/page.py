"""One self-contained HTML page: the viewer's script and style, the data, and a picture for where neither runs."""

from __future__ import annotations

import base64
import gzip
import hashlib
import html
from collections.abc import Sequence
from functools import cache
from string import Template

from ..reflectance import Reflectance
from .linker import linked, sources
from .minified import minified
from .payload import View, payload, title_of

PICTURE_SIZE = (560, 420)

POLICY = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; img-src data: blob:{images}; "
    "connect-src {network}; base-uri 'none'; form-action 'none'"
)
SERVED, ALONE = {"images": " 'self'", "network": "'self'"}, {"images": "", "network": "'none'"}
"""What a page may do: run the scripts it came with, and ask nothing of anyone but the server it came from."""


def page(shown: Sequence[Reflectance], view: View | None = None) -> str:
    """The page, which opens from disk and asks the network for nothing. Raises as `payload`."""
    from .picture import picture

    view = view or View()
    data = payload(shown, view)
    image = base64.b64encode(picture(shown, view)).decode()
    return document(title_of(shown), f"data:image/webp;base64,{image}", data)


def document(title: str, image: str, data: bytes | None = None) -> str:
    """The page's HTML. `image`: address of the picture. `data`: the container, None where the page asks its server."""
    boot, code = scripts()
    digests = [base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in (boot, code)]
    width, height = PICTURE_SIZE
    tag = f'<img src="{html.escape(image)}" width="{width}" height="{height}" alt="{html.escape(title)}">'
    allowed = {"scripts": " ".join(f"'sha256-{digest}'" for digest in digests)}
    return Template(sources()["page.html"]).substitute(
        title=html.escape(title),
        policy=POLICY.format(**allowed, **(SERVED if data is None else ALONE)),
        style=minified(sources()["style.css"], "text/css"),
        image=f"<noscript>{tag}</noscript>"
        if data is None
        else tag,  # served, it takes seconds to draw: only if needed
        data="" if data is None else f'<script type="text/plain" id="payload">{packed(data)}</script>',
        code=packed(code.encode()),
        boot=boot,
    )


@cache
def scripts() -> tuple[str, str]:
    """The script that unpacks, and the one that is unpacked."""
    return linked("boot.js"), linked("main.js")


def packed(data: bytes) -> str:
    """For a place within HTML: gzip, then base64; the same bytes always give the same text."""
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode()
