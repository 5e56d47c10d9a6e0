"""The renderer for graphics cards, and for OpenGL's software driver where there is none."""

from .card import Card, card
from .per_vertex import draw_per_vertex
from .renderer import Renderer, draw, stages_of

__all__ = ["Card", "Renderer", "card", "draw", "draw_per_vertex", "stages_of"]
