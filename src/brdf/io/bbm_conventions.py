"""What the rows of each published table mean: the reflectance that a row of parameters stands for.

Every fit is a Lambertian part kd / pi plus one lobe. The tables of Ngan2005 are in the raw units of the MERL files:
green and blue lack the factors 1.15 and 1.66 that the measurements are scaled by (the diffuse albedos of Low2012 are
larger by 1.00, 1.16 and 1.68 in the median), which is made good here. Their Blinn-Phong lobe is (n + 2) / (2 pi) cos^n
of the half vector's angle, their He-Torrance lengths are in wavelengths; both follow from comparison with networks
fitted to the same measurements (see the tests). Where He-Torrance's index is printed as 1.00 its lobe, and with it a
scale of up to 2e9, is lost: those four rows are diffuse alone.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..combinators import add, scaled
from ..models import get as model
from ..reflectance import Reflectance

Row = dict[str, Any]
"""One material's parameters as published: numbers and lists of three."""

MERL_CHANNELS = (1.0, 1.15, 1.66)
"""Red, green and blue of MERL measurements over their raw numbers, up to a common factor. Reference: Matusik2003."""


def sgd(row: Row) -> Reflectance:
    """Both Fresnel coefficients are in `eta`, c is taken to its logarithm."""
    F0, F1 = row["eta"]
    same = {name: row[name] for name in ("kd", "alpha", "p", "K", "Lambda", "k", "theta0")}
    return model("SGD")(**same, ks=row["albedo"], F0=F0, F1=F1, log_c=np.log(row["c"]))


def low_smooth(row: Row) -> Reflectance:
    lobe = model("LowSmooth")(A=row["A"], B=row["B"], C=row["C"], eta=row["eta"])
    return add(_diffuse(row["kd"]), lobe)


def low_microfacet(row: Row) -> Reflectance:
    """The table divides by pi cos_i cos_o, the paper by cos_i cos_o."""
    A = np.asarray(row["A"]) / math.pi
    return add(_diffuse(row["kd"]), model("LowMicrofacet")(A=A, B=row["B"], C=row["C"], eta=row["eta"]))


def low_cook_torrance(row: Row) -> Reflectance:
    """D lacks its 1 / pi."""
    lobe = model("CookTorrance")(m=row["roughness"], **_refraction(row["eta"]))
    return _sum(row, lobe, math.pi)


def low_ashikhmin_shirley(row: Row) -> Reflectance:
    """`fresnelReflectance` is a refractive index."""
    return _sum(row, model("AshikhminShirley")(n=row["sharpness"], **_refraction(row["fresnelReflectance"])))


def ngan_ashikhmin_shirley(row: Row) -> Reflectance:
    return _sum(
        row, model("AshikhminShirley")(n=row["sharpness"], F0=row["fresnelReflectance"]), channels=MERL_CHANNELS
    )


def ngan_cook_torrance(row: Row) -> Reflectance:
    """`eta` is Schlick's reflectance at normal incidence."""
    return _sum(row, model("CookTorrance")(m=row["roughness"], F0=row["eta"]), channels=MERL_CHANNELS)


def ngan_ward(row: Row) -> Reflectance:
    return _sum(row, model("Ward")(ks=1.0, alpha=row["roughness"]), channels=MERL_CHANNELS)


def ngan_ward_duer(row: Row) -> Reflectance:
    return _sum(row, model("WardDuer")(ks=1.0, alpha=row["roughness"]), channels=MERL_CHANNELS)


def ngan_blinn_phong(row: Row) -> Reflectance:
    """(n + 2) / (2 pi) normalises the lobe about the mirror direction, but stands before one of half vectors."""
    n = row["sharpness"]
    scale = 4.0 * (2.0 ** (-n / 2.0) + n) / (n + 4.0)  # over the normalisation of BlinnPhong
    return _sum(row, model("BlinnPhong")(ks=1.0, n=n), scale, MERL_CHANNELS)


def ngan_lafortune(row: Row) -> Reflectance:
    """C is scaled to a largest weight of 1, before which (n + 2) / (2 pi) stands."""
    largest = max(abs(row["Cxy"]), abs(row["Cz"]))
    weights = {"Cxy": row["Cxy"] / largest, "Cz": row["Cz"] / largest}
    return _sum(row, model("Lafortune")(ks=1.0, n=row["sharpness"], **weights), channels=MERL_CHANNELS)


def ngan_he(row: Row) -> Reflectance:
    if row["eta"] == 1:
        return _diffuse(np.asarray(row["kd"]) * MERL_CHANNELS)
    lobe = model("HeTorrance")(sigma0=row["roughness"], tau=row["autocorrelation"], **_refraction(row["eta"]))
    return _sum(row, lobe, channels=MERL_CHANNELS)


def _diffuse(kd: Any) -> Reflectance:
    return model("Lambertian")(albedo=kd)


def _sum(row: Row, lobe: Reflectance, scale: float = 1.0, channels: Any = (1.0, 1.0, 1.0)) -> Reflectance:
    """channels * (kd / pi + albedo * scale * lobe)."""
    specular = scaled(lobe, np.asarray(row["albedo"]) * channels * scale)
    return add(_diffuse(np.asarray(row["kd"]) * channels), specular)


def _refraction(eta: float) -> Row:
    """A dielectric's Fresnel term; beyond its bounds the same curve by its reflectance at normal incidence."""
    if eta <= 4.0:
        return {"fresnel": "dielectric", "eta": eta}
    return {"fresnel": "cook-torrance", "F0": ((eta - 1.0) / (eta + 1.0)) ** 2}
