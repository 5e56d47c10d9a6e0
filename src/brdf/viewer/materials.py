"""Reflectances as a page takes them: their shader's text and texels, and what is worth saying about them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..reflectance import Reflectance
from ..render.stand_in import stand_in
from ..representations.tables.table import Table
from ..shaders import shader_of, stages
from .blob import Blob


def described(m: Reflectance, blob: Blob) -> dict[str, Any]:
    """A reflectance's part of a page's description; its texels go into the blob.

    Raises ReflectanceError as `shader_of`, or what baking raises.
    """
    shown, note = (m, "") if m.has_formula else baked(m)
    shader = shader_of(shown)
    alpha, share = stand_in(shown)
    about: dict[str, Any] = {
        "shader": shader.description,
        "text": stages.material(shader),
        "texels": blob.add(shader.texels) if shader.texels else None,
        "nbytes": m.nbytes,
        "isotropic": m.isotropic,
        "kind": type(m).__name__,
        "note": note or _warning(m),
        "lobe": {"alpha": round(alpha, 4), "share": round(share, 4)},
    }
    if isinstance(shown, Table) and not shown.measured.all():
        about["mask"] = blob.add(np.packbits(shown.measured, bitorder="little").tobytes())
        about["mask_shape"] = list(shown.measured.shape)
    return about


def baked(m: Reflectance) -> tuple[Reflectance, str]:
    """What stands in for a reflectance without a formula, and the sentence that says so, with the error."""
    from ..conversion import bake
    from ..metrics import psnr

    small = bake(m, "slice-stack", **({} if m.isotropic else {"anisotropic": True}))
    kilobytes = small.nbytes / 1024
    note = f"Shown by its {kilobytes:,.0f} KB slice stack, PSNR {psnr(m, small):.1f} dB: it has no formula itself."
    return small.named(m.name, m.source), note


def _warning(m: Reflectance) -> str:
    return "Its mirror part, a delta distribution, is not shown." if m.has_delta else ""
