"""The page's plots: the numbers they draw are Python's, and they can be read, heard and used."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import brdf
from brdf.color import luminance
from brdf.geometry.directions import from_half_difference, from_spherical
from brdf.models import GGX, Lambertian, OrenNayar
from brdf.viewer.payload import stage_texts
from helpers import relative_error
from page_sources import source

if TYPE_CHECKING:
    from playwright.sync_api import Page

    from brdf.reflectance import Reflectance

SHOW = """async ([sources, stages, width]) => {
    const { Material } = await import("./material.js");
    const { Evaluator } = await import("./evaluate.js");
    const { VIEWS } = await import("./views/all.js");
    const style = Object.assign(document.createElement("link"), { rel: "stylesheet", href: "style.css" });
    const loaded = new Promise((done) => style.addEventListener("load", done));
    document.head.append(style);
    await loaded;
    const gl = document.createElement("canvas").getContext("webgl2");
    const bytes = (text) => text && Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const materials = sources.map((s) => new Material(gl, { ...s, texels: bytes(s.texels), mask: bytes(s.mask) }));
    const evaluator = new Evaluator(gl, stages);
    const root = Object.assign(document.createElement("div"), { className: "brdf" });
    root.dataset.embedded = "true";
    Object.assign(root.style, { width: `${width}px`, height: "auto", background: "var(--panel)" });
    document.body.replaceChildren(root);
    globalThis.shown = materials;
    globalThis.drawn = {};
    for (const view of VIEWS) {
        const place = Object.assign(document.createElement("section"), { className: "view", id: view.id });
        root.append(place);
        drawn[view.id] = view.create(place, { evaluator, materials: () => shown, theme: () => "light" });
        drawn[view.id].update();
    }
    await new Promise((done) => setTimeout(done, 100));
    return VIEWS.map(({ id, title }) => [id, title]);
}"""

CURVES = (
    "(id) => drawn[id].data().map(({ name, angle, x, y }) => ({ name, angle, x: Array.from(x), y: Array.from(y) }))"
)

FLOOR = 1e-4
"""Values below count as this much in relative errors."""


def show(page: Page, *materials: Reflectance, width: int = 420, **more: Any) -> None:
    """Every view of one or two materials; `more` goes into the first one's source."""
    sources = [source(m) for m in materials]
    sources[0] |= more
    page.evaluate(SHOW, [sources, stage_texts(), width])


def in_plane(m: Reflectance, angle: float, views: Any) -> Any:
    return m(from_spherical(np.radians(-angle), 0.0), from_spherical(np.radians(views), 0.0))


def test_one_material(modules: Page) -> None:
    """Polar lobes, slices, albedo, solid."""
    m = brdf.SliceStack.bake(brdf.load("gold-metallic-paint"), method="points")
    show(modules, m)
    for curve in modules.evaluate(CURVES, "polar"):
        expected = luminance(in_plane(m, curve["angle"], curve["x"]))
        assert relative_error(curve["y"], expected, FLOOR).max() < 1e-3
        assert curve["name"] == f"{curve['angle']}°"
    assert [curve["angle"] for curve in modules.evaluate(CURVES, "polar")] == [0, 30, 60, 80]
    for channel, curve in enumerate(modules.evaluate(CURVES, "slices")):
        expected = in_plane(m, 45, curve["x"])[:, channel]
        assert relative_error(curve["y"], expected, FLOOR).max() < 1e-3
    wo = from_spherical(np.radians(modules.evaluate(CURVES, "albedo")[0]["x"]), 0.0)
    expected = m.albedo(wo, 16384)
    for channel, curve in enumerate(modules.evaluate(CURVES, "albedo")):
        np.testing.assert_allclose(curve["y"], expected[:, channel], atol=2e-3)
    (lobe,) = modules.evaluate("drawn.lobe.data().map((l) => ({ ...l, values: Array.from(l.values) }))")
    directions = np.array(lobe["directions"])
    expected = luminance(m(from_spherical(np.radians(45), np.pi), directions))
    assert relative_error(lobe["values"], expected, FLOOR).max() < 1e-3
    assert directions[:, 2].min() > 0
    assert lobe["largest"] == pytest.approx(expected.max(), rel=1e-3)


ALBEDOS = {
    "sharp": lambda: GGX(alpha=0.01, F0=(0.9, 0.5, 0.2)),
    "broad": lambda: Lambertian(albedo=(0.2, 0.5, 0.8)) + GGX(alpha=0.4),
    "rough": lambda: OrenNayar(sigma=0.6),
    "anisotropic": lambda: GGX(alpha_x=0.08, alpha_y=0.5, F0=(0.9, 0.9, 0.9)),
}


@pytest.mark.parametrize("name", ALBEDOS)
def test_albedo_is_that_of_python(modules: Page, name: str) -> None:
    m = ALBEDOS[name]()
    show(modules, m)
    curves = modules.evaluate(CURVES, "albedo")
    wo = from_spherical(np.radians(curves[0]["x"]), 0.0)
    found = np.stack([curve["y"] for curve in curves], -1)
    np.testing.assert_allclose(found, m.albedo(wo, 16384), atol=5e-3)


def test_two_materials_are_laid_over_each_other(modules: Page) -> None:
    a, b = GGX(alpha=0.1).named("sharp"), GGX(alpha=0.3).named("broad")
    show(modules, a, b)
    names = ["A sharp", "B broad"]
    polar = modules.evaluate(CURVES, "polar")
    assert [(curve["name"], curve["angle"]) for curve in polar] == [(n, angle) for n in names for angle in (30, 70)]
    for curve in polar:
        m = (a, b)[names.index(curve["name"])]
        expected = luminance(in_plane(m, curve["angle"], curve["x"]))
        assert relative_error(curve["y"], expected, FLOOR).max() < 1e-3
    for m, curve in zip((a, b), modules.evaluate(CURVES, "slices"), strict=True):
        assert relative_error(curve["y"], luminance(in_plane(m, 45, curve["x"])), FLOOR).max() < 1e-3
    assert len(modules.evaluate(CURVES, "albedo")) == 2
    for view in ("polar", "slices", "albedo", "lobe"):
        assert modules.locator(f"#{view} .legend li").all_inner_texts() == names
    assert modules.locator("#image figure").count() == 2
    modules.evaluate("shown.pop(); drawn.image.update()")
    assert modules.locator("#image figure").count() == 1


def test_image_slice(modules: Page) -> None:
    m = GGX(alpha=0.2, F0=(0.9, 0.5, 0.2))
    measured = np.random.default_rng(1).random((90, 90, 181)) < 0.7
    mask = base64.b64encode(np.packbits(measured, bitorder="little").tobytes()).decode()
    show(modules, m, mask=mask, mask_shape=[90, 90, 181])
    for root, azimuth in ((True, 90), (False, 20)):
        modules.evaluate("(o) => { Object.assign(drawn.image.options, o); drawn.image.update(); }",
                         {"root": root, "azimuth": azimuth})  # fmt: skip
        (found,) = modules.evaluate(
            "drawn.image.data().map((s) => ({ values: Array.from(s.values), above: Array.from(s.above), "
            "measured: Array.from(s.measured) }))"
        )
        above = np.array(found["above"], bool)
        size = round(len(above) ** 0.5)
        share = (np.arange(size) + 0.5) / size
        theta_h, theta_d = np.meshgrid((share**2 if root else share) * np.pi / 2, share * np.pi / 2)
        wi, wo = from_half_difference(theta_h, 0.0, theta_d, np.radians(azimuth))
        clear = np.minimum(np.abs(wi[..., 2]), np.abs(wo[..., 2])).ravel() > 1e-5
        np.testing.assert_array_equal(above[clear], ((wi[..., 2] > 0) & (wo[..., 2] > 0)).ravel()[clear])
        values = np.array(found["values"]).reshape(-1, 4)[:, :3]
        assert relative_error(values, m(wi, wo).reshape(-1, 3), FLOOR)[clear].max() < 1e-3
        i = np.minimum(np.rint(90 * np.sqrt(theta_h / (np.pi / 2))).astype(int), 89)
        j = np.minimum(np.rint(np.degrees(theta_d)).astype(int), 89)
        same = np.array(found["measured"], bool) == measured[i, j, azimuth].ravel()
        assert same.mean() > 0.99  # an angle halfway between two nodes may be rounded either way
        label = modules.locator("#image [role=img]").get_attribute("aria-label") or ""
        assert f"at φd = {azimuth}°" in label
        assert f"{100 * (1 - np.array(found['measured'], bool)[above].mean()):.0f} % of it was not measured." in label


def test_choices_change_what_is_drawn_and_last(modules: Page) -> None:
    show(modules, GGX(alpha=0.2))
    picture = {view: f"document.querySelector('#{view} figure svg').innerHTML" for view in ("polar", "slices", "image")}
    before = {view: modules.evaluate(script) for view, script in picture.items()}
    for view in ("polar", "slices"):
        modules.locator(f"#{view}").get_by_role("switch", name="Logarithmic").uncheck()
        assert modules.evaluate(picture[view]) != before[view]
    modules.locator("#slices").get_by_role("slider", name="Light").fill("100")
    assert "light at 17°" in (modules.locator("#slices [role=img]").get_attribute("aria-label") or "")
    modules.locator("#image").get_by_role("switch", name="√ θh").uncheck()
    assert modules.evaluate(picture["image"]) != before["image"]
    modules.locator("#image").get_by_role("radio", name="Luminance").click()
    assert modules.locator("#image").get_by_text("f [1/sr]").count() == 1
    canvas = modules.locator("#lobe canvas")
    image = "document.querySelector('#lobe canvas').toDataURL()"
    still = modules.evaluate(image)
    canvas.press("ArrowLeft")
    turned = modules.evaluate(image)
    assert turned != still
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box() or {}
    modules.mouse.move(box["x"] + 100, box["y"] + 60)
    modules.mouse.down()
    modules.mouse.move(box["x"] + 160, box["y"] + 80)
    modules.mouse.up()
    assert modules.evaluate(image) != turned


@pytest.mark.parametrize("width", [328, 388])
def test_nothing_is_cut_off_and_everything_is_described(modules: Page, width: int) -> None:
    show(modules, brdf.load("gold-metallic-paint"), GGX(alpha=0.02), width=width)
    outside = modules.evaluate("""() => {
        const wrong = [];
        for (const text of document.querySelectorAll(".view figure svg text")) {
            const [box, frame] = [text, text.ownerSVGElement.closest("figure")].map((e) => e.getBoundingClientRect());
            if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1) {
                wrong.push(text.textContent);
            }
        }
        return wrong;
    }""")
    assert outside == []
    for picture in modules.locator("[role=img]").all():
        label = picture.get_attribute("aria-label") or ""
        assert any(character.isdigit() for character in label), label


def test_curves_stand_out_from_the_page(modules: Page) -> None:
    """3 : 1 at least, as WCAG asks of graphics, in both themes."""
    show(modules, GGX(alpha=0.2))
    found = modules.evaluate("""async () => {
        const { COLOURS, PAIR } = await import("./views/plot.js");
        const canvas = document.createElement("canvas").getContext("2d");
        const opaque = (colour) => {
            canvas.fillStyle = "#808080";
            canvas.fillRect(0, 0, 1, 1);
            canvas.fillStyle = colour;
            canvas.fillRect(0, 0, 1, 1);
            return Array.from(canvas.getImageData(0, 0, 1, 1).data.slice(0, 3));
        };
        const root = document.querySelector(".brdf");
        return ["light", "dark"].map((theme) => {
            root.dataset.theme = theme;
            const value = (name) => getComputedStyle(root).getPropertyValue(name).trim();
            const pair = PAIR.map(({ colour }) => value(colour.slice(4, -1)));
            return { panel: opaque(value("--panel")), curves: [...COLOURS, ...pair].map(opaque) };
        });
    }""")

    def brightness(colour: list[int]) -> float:
        return float(luminance(brdf.color.srgb_decode(np.array(colour) / 255)))

    for theme in found:
        for curve in theme["curves"]:
            dark, light = sorted((brightness(curve), brightness(theme["panel"])))
            assert (light + 0.05) / (dark + 0.05) >= 3, (theme["panel"], curve)
