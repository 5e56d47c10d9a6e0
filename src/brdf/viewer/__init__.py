"""The page that shows materials in a browser: exported to one file, served to this machine, or in a notebook."""

from .opening import view

__all__ = ["view"]
