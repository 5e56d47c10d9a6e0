"""Reflectances as shaders for other programs: GLSL and WGSL text, with the textures it reads."""

from ..callable_module import make_callable
from ..shaders import LANGUAGES
from .shaders import Exported, export, language_of

__all__ = ["LANGUAGES", "Exported", "export", "language_of"]

make_callable(__name__, export)
