"""Every table that errors are measured of: what it is made of, and how large it may be at so many bytes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

from ....reflectance import Reflectance
from ....representations.baking.alpha_search import measured_alphas, with_alpha
from ....representations.baking.bake import bake_points
from ....representations.baking.slice_stack import SliceStack
from ....representations.tables.layout import Layout
from ....representations.tables.layouts import named_layout
from .settings import FIXED

Alphas = tuple[float, ...]

WORD, HALF = "rgb9e5", "half"

IDENTITY, UNIFORM = "identity", "uniform"
BEZIER = f"Bézier, α {FIXED[0]:g}, {FIXED[1]:g}"
INTENSE = "Bézier, α by total intensity"
MEASURED = "Bézier, α by measured error"
HALF_LOG = "half vector, ln f (ours)"
HALF_CUBIC = "half vector, ln f, Catmull-Rom (ours)"
STACK = "slice stack (ours)"

SEARCHED_AT = 64
"""KB of the table for which the measured alphas are chosen, once a material."""


class Recipe(NamedTuple):
    """A layout but for its size: names as of `named_layout`, and the alphas' origin."""

    basis: str
    warp: str
    storage: str
    encoding: str | None = None
    filter: str = "linear"
    alpha: str = ""


RECIPES: dict[str, Recipe] = {
    IDENTITY: Recipe("normal", "identity", WORD),
    UNIFORM: Recipe("normal", "uniform", WORD),
    BEZIER: Recipe("normal", "bezier", WORD),
    INTENSE: Recipe("normal", "bezier", WORD, alpha="intensity"),
    MEASURED: Recipe("normal", "bezier", WORD, alpha="measured"),
    f"{MEASURED}, Catmull-Rom": Recipe("normal", "bezier", WORD, filter="catmull-rom", alpha="measured"),
    f"{BEZIER}, ln f": Recipe("normal", "bezier", HALF, "log"),
    "half vector, MERL's axes": Recipe("half", "merl", WORD, "f"),
    "half vector, Bézier": Recipe("half", "bezier", WORD, "f"),
    HALF_LOG: Recipe("half", "bezier", "10-10-10"),
    HALF_CUBIC: Recipe("half", "bezier", "10-10-10", filter="catmull-rom"),
    f"{HALF_LOG}, 16 bits": Recipe("half", "bezier", HALF),
    "sheared, ln f": Recipe("sheared", "bezier", HALF),
    "Marschner": Recipe("marschner", "bezier", WORD),
    "Stark, ln f": Recipe("stark", "bezier", HALF),
}
"""Tables of three axes by name. The paper's: normal basis, f as RGB with a shared exponent."""

BYTES = {WORD: 4, "10-10-10": 4, HALF: 6}

PROPORTIONS = {"half": (2.0, 2.0, 0.5), "stark": (2.0, 2.0, 0.5)}
"""Of the numbers of nodes; N x N x 2N for the others, as in the paper."""


def sized(recipe: Recipe, kilobytes: float) -> Layout:
    """The layout of a recipe with as many nodes as fit."""
    proportions = PROPORTIONS.get(recipe.basis, (1.0, 1.0, 2.0))
    scale = (kilobytes * 1024 / BYTES[recipe.storage] / math.prod(proportions)) ** (1 / 3)
    shape = tuple(max(2, int(scale * p + 1e-9)) for p in proportions)
    return named_layout(recipe.basis, recipe.warp, shape, recipe.storage, recipe.filter, None, recipe.encoding)


def measured_alphas_of(m: Reflectance) -> Alphas:
    """The alphas of the least measured error."""
    return measured_alphas(m, sized(RECIPES[MEASURED], SEARCHED_AT))


def tables(
    m: Reflectance, kilobytes: float, alphas: dict[str, Alphas]
) -> Iterator[tuple[str, Callable[[], Reflectance]]]:
    """Every option of that size by name, baked on demand."""
    for name, recipe in RECIPES.items():
        layout = sized(recipe, kilobytes)
        if recipe.alpha:
            layout = with_alpha(m, layout, alphas[recipe.alpha])
        yield name, partial(bake_points, m, layout)
    yield STACK, partial(SliceStack.bake, m, int(kilobytes * 1024), "points")
