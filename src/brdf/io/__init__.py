"""Files of other programs and of this package: one format a file, chosen by content. The folder is the list."""

from __future__ import annotations

from .registry import Format, FormatInfo, files_with, format_of, formats, members, read, write

__all__ = ["Format", "FormatInfo", "files_with", "format_of", "formats", "members", "read", "write"]
