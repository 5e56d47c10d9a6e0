"""A reflectance's formula as the text of a shader, with the numbers and textures that it reads."""

from .shader import LANGUAGES, Shader, shader_of

__all__ = ["LANGUAGES", "Shader", "shader_of"]
