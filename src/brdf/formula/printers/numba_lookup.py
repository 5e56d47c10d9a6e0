"""The loop of a generated kernel that looks a texture up: see `textures.lookup` for the definition."""

from __future__ import annotations

import itertools

from ..graph import Graph, TextureRef
from ..textures import REACH, weights
from .numba_dialect import VARYING
from .statements import Statements

INDENT = "    "


def lookup_loop(texture: TextureRef, coordinates: list[str], channels: list[str]) -> list[str]:
    """Lines that read `coordinates`, rows of the work array for each axis, and write `channels`, rows as well."""
    axes = range(texture.dimensions)
    lines = [f"size{axis} = {texture.name}.shape[{axis}]" for axis in axes]
    lines += [f"texels = {texture.name}.reshape(-1)", "for i in range(count):"]
    inner = []
    for axis, u in zip(axes, coordinates, strict=True):
        step = " * ".join([f"size{later}" for later in axes[axis + 1 :]] + [str(texture.channels)])
        inner += [f"step{axis} = {step}", *_taps(texture.filter, axis, u)]
    inner += _linear_sums(texture) if texture.filter == "linear" else _nested_sums(texture)
    inner += [f"{row} = s{channel}" for channel, row in enumerate(channels)]
    return lines + [f"    {line}" for line in inner]


def _taps(filter: str, axis: int, u: str) -> list[str]:
    """Weight w{axis}_{tap} and offset o{axis}_{tap} of the texels along one axis."""
    lines = [
        f"x{axis} = {u} * real(size{axis}) - real(0.5)",
        f"x{axis} = minimum(where(x{axis} > ZERO, x{axis}, ZERO), real(size{axis} - 1))",
    ]
    if filter == "nearest":
        return [*lines, f"o{axis}_0 = int(x{axis} + real(0.5)) * step{axis}", f"w{axis}_0 = ONE"]
    lines += [
        f"i{axis} = min(int(x{axis}), max(size{axis} - 2, 0))",
        f"f{axis} = x{axis} - real(i{axis})",
    ]
    graph = Graph()
    x = graph.symbol("x")
    shares = [graph.constant(share) for share in weights(filter, x)]
    statements = Statements(VARYING, {share: f"w{axis}_{tap}" for tap, share in enumerate(shares)}, {x: f"f{axis}"})
    statements.add(shares)
    lines += [f"{name} = {text}" for name, text in statements.lines]
    lines += [
        f"w{axis}_{tap} = {statements.text(share)}"
        for tap, share in enumerate(shares)
        if statements.text(share) != f"w{axis}_{tap}"
    ]
    above = f"min(i{axis} + 1, size{axis} - 1)"
    mirrored = [f"min(max(i{axis} - 1, 1 - i{axis}), size{axis} - 1)", f"i{axis}", above]
    mirrored.append(f"max(min(i{axis} + 2, 2 * size{axis} - 4 - i{axis}), 0)")
    places = [f"i{axis}", above] if filter == "linear" else mirrored
    return [*lines, *(f"o{axis}_{tap} = ({place}) * step{axis}" for tap, place in enumerate(places))]


def _linear_sums(texture: TextureRef) -> list[str]:
    """Each channel as one sum over the corners, whose weights the channels share."""
    corners = list(itertools.product((0, 1), repeat=texture.dimensions))
    lines = []
    for number, corner in enumerate(corners):
        lines += [
            f"w{number} = " + " * ".join(f"w{axis}_{tap}" for axis, tap in enumerate(corner)),
            f"o{number} = " + " + ".join(f"o{axis}_{tap}" for axis, tap in enumerate(corner)),
        ]
    for channel in range(texture.channels):
        terms = [f"w{number} * texels[o{number} + {channel}]" for number in range(len(corners))]
        lines.append(f"s{channel} = " + " + ".join(terms))
    return lines


def _nested_sums(texture: TextureRef) -> list[str]:
    """A loop over the texels of each axis but the last, whose sum stands in one line."""
    taps, last = range(REACH[texture.filter]), texture.dimensions - 1
    lines = [f"s{channel} = ZERO" for channel in range(texture.channels)]
    weight, base = "ONE", "0"
    for axis in range(last):
        pairs = ", ".join(f"(w{axis}_{tap}, o{axis}_{tap})" for tap in taps)
        lines += [
            f"{INDENT * axis}for w{axis}, o{axis} in ({pairs},):",
            f"{INDENT * (axis + 1)}weight{axis}, base{axis} = {weight} * w{axis}, {base} + o{axis}",
        ]
        weight, base = f"weight{axis}", f"base{axis}"
    for channel in range(texture.channels):
        terms = [f"w{last}_{tap} * texels[{base} + o{last}_{tap} + {channel}]" for tap in taps]
        lines.append(f"{INDENT * last}s{channel} += {weight} * ({' + '.join(terms)})")
    return lines
