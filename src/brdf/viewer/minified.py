"""Scripts and style sheets in fewer characters, for pages that are sent around."""

from __future__ import annotations

import re

SHADER = re.compile(r"/\* glsl \*/ (`[^`]*`)")
"""A template literal whose text is a shader: the marker stands before it."""


def minified(text: str, kind: str) -> str:
    """`text` of the media type `kind` without comments, needless space and long names; as it is where the library that
    does this is not installed."""
    try:
        import minify
    except ImportError:
        return text
    return str(minify.string(kind, SHADER.sub(_without_comments, text)))


def _without_comments(shader: re.Match[str]) -> str:
    return re.sub(r"\s*\n\s*", "\n", re.sub(r"//[^\n]*", "", shader[1]))
