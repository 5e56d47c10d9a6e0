"""Reflectances for other programs: shaders with the textures they read, and pages for browsers."""

from ..callable_module import make_callable
from ..shaders import LANGUAGES
from .dispatch import Exported, export, format_of

__all__ = ["LANGUAGES", "Exported", "export", "format_of"]

make_callable(__name__, export)
