"""Comparisons of two, rankings of several."""

from __future__ import annotations

import math

import numpy as np
import pytest

import brdf
from brdf import metrics
from brdf.errors import ParameterError
from brdf.models import GGX, Lambertian


def test_identical_reflectances_agree_perfectly():
    m = GGX(alpha=0.3)
    comparison = metrics.compare(m, GGX(alpha=0.3), size=24)
    assert comparison.psnr == math.inf
    assert comparison.relative_rmse == 0
    assert comparison.albedo_difference == 0
    assert set(comparison.metrics.values()) == {0.0}


def test_comparison_prints_every_number():
    comparison = metrics.compare(Lambertian(albedo=0.8).named("a"), Lambertian(albedo=0.3).named("b"), size=16)
    text = comparison.table()
    assert text.startswith("a -> b\n")
    for name in ("PSNR", "relative RMSE", "albedo difference", "bytes", *metrics.METRICS):
        assert name in text
    assert comparison.albedo_difference == pytest.approx(0.5, rel=0.01)
    assert comparison.bytes == (12, 12)


def test_a_comparison_holds_what_the_metrics_give_one_by_one():
    a, b = GGX(alpha=0.3) + Lambertian(albedo=0.2), GGX(alpha=0.35) + Lambertian(albedo=(0.2, 0.25, 0.2))
    c = brdf.compare(a, b, size=24)
    assert c.psnr == pytest.approx(metrics.psnr(a, b, 24))
    assert c.relative_rmse == pytest.approx(metrics.relative_rmse(a, b, 24))
    assert c.delta_e == pytest.approx(metrics.delta_e(a, b, 24))
    np.testing.assert_allclose(c.psnr_by_angle, metrics.psnr_by_angle(a, b, 24))
    assert c.psnr_min == c.psnr_by_angle.min() < c.psnr_mean == c.psnr_by_angle.mean()
    pixels = np.bincount(metrics.sphere_lights(24), minlength=len(metrics.LIGHT_ANGLES))
    assert c.delta_e.mean == pytest.approx(c.delta_e_by_angle @ pixels / pixels.sum(), rel=1e-5)
    assert c.metrics == pytest.approx(metrics.direction_metrics(a, b))
    assert c.pair == (a, b)


def test_ranking_puts_the_nearest_first():
    reference = Lambertian(albedo=0.5)
    others = [Lambertian(albedo=albedo).named(str(albedo)) for albedo in (0.9, 0.5, 0.45, 0.7)]
    ranked = metrics.rank(reference, others, size=16)
    assert [c.other for c in ranked] == ["0.5", "0.45", "0.7", "0.9"]
    assert ranked[0].psnr == math.inf
    alone = metrics.compare(reference, others[3], size=16)
    assert ranked[2].psnr == alone.psnr
    assert ranked[2].metrics == alone.metrics


def test_ranking_of_nothing_is_refused():
    with pytest.raises(ParameterError, match="at least one more"):
        metrics.rank(Lambertian(), [])


def test_a_comparison_draws_itself():
    figure = brdf.compare(Lambertian(albedo=0.5), Lambertian(albedo=0.4), size=16).plot()
    assert "Lambertian" in figure.get_suptitle()
