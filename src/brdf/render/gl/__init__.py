"""The renderer for graphics cards, and for OpenGL's software driver where there is none."""

from .card import Card, card
from .renderer import Renderer, draw, shaders_of

__all__ = ["Card", "Renderer", "card", "draw", "shaders_of"]
