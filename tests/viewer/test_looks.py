"""The page as it is seen: sizes from a phone to a desk, dark and light, contrast, no WebGL2."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from tests.viewer.pages import Opened, address, opened

import brdf
from brdf.models import GGX, Lambertian

if TYPE_CHECKING:
    from playwright.sync_api import Browser

BALL = 0.5 * Lambertian(albedo=0.8) + GGX(alpha=0.2)

PHONE, TABLET, DESK = ({"width": w, "height": h} for w, h in ((360, 640), (1024, 768), (1440, 900)))

CLIPPED = """() => {
    const out = [];
    for (const node of document.querySelectorAll("button, input, select, h1, h2, summary")) {
        if (!node.checkVisibility() || node.closest(".handles")) continue;
        const scroller = node.closest(".panel, .drawer, dialog");
        const box = node.getBoundingClientRect();
        const within = scroller?.getBoundingClientRect() ?? new DOMRect(0, 0, innerWidth, innerHeight);
        const sideways = box.left < within.left - 0.5 || box.right > within.right + 0.5;
        const upright = !scroller && (box.top < within.top - 0.5 || box.bottom > within.bottom + 0.5);
        if (box.width && (sideways || upright)) out.push(node.outerHTML.slice(0, 120));
    }
    const { scrollWidth, clientWidth } = document.documentElement;
    if (scrollWidth > clientWidth) out.push(`the page is ${scrollWidth} wide`);
    return out;
}"""

NAMELESS = """() => [...document.querySelectorAll("button, input, select, canvas, [role=slider], dialog, [tabindex]")]
    .filter((node) => !(node.getAttribute("aria-label") || node.getAttribute("aria-labelledby") ||
        node.textContent.trim() || node.labels?.length)).map((node) => node.outerHTML.slice(0, 120))"""

CONTRASTS = """() => {
    const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const parsed = (text) => {
        canvas.clearRect(0, 0, 1, 1);
        canvas.fillStyle = text;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
        return [r / 255, g / 255, b / 255, a / 255];
    };
    const under = (node, floor) => {
        const layers = [];
        for (let at = node; at; at = at.parentElement) layers.push(parsed(getComputedStyle(at).backgroundColor));
        return layers.reverse().reduce((below, [r, g, b, a]) =>
            [r, g, b].map((c, i) => c * a + below[i] * (1 - a)), floor);
    };
    const luminance = (rgb) => rgb.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const found = [];
    for (const node of document.querySelectorAll("body *")) {
        const own = [...node.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
        if (!(own || node.matches("input:not([type=range]):not([type=color]):not([type=checkbox]), select"))) continue;
        if (!node.checkVisibility({ opacityProperty: true }) || node.closest(".unseen, option, script")) continue;
        if (node.disabled || getComputedStyle(node).visibility === "hidden") continue;
        const ink = parsed(getComputedStyle(node).color);
        for (const floor of [[0, 0, 0], [1, 1, 1]]) {  // whatever the picture behind is
            const paper = under(node, floor);
            const shown = ink.slice(0, 3).map((c, i) => c * ink[3] + paper[i] * (1 - ink[3]));
            const [high, low] = [luminance(shown), luminance(paper)].sort((a, b) => b - a);
            const what = node.textContent.trim().slice(0, 40) || node.outerHTML.slice(0, 60);
            found.push([what, (high + 0.05) / (low + 0.05)]);
        }
    }
    return found;
}"""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "ball.html"
    pair = [BALL.named("ball"), Lambertian().named("a name that is much longer than any label has room for")]
    brdf.export(pair, path, mesh="sphere", lights="directional:theta=40,phi=20")
    return path


@pytest.fixture(scope="module")
def viewer(browser: Browser, file: Path) -> Iterator[Opened]:
    with opened(browser, viewport=DESK) as page:
        yield page.open(address(file))


@pytest.mark.parametrize("size", [PHONE, TABLET, DESK], ids=["phone", "tablet", "desk"])
def test_nothing_is_cut_off_at_any_size(viewer: Opened, size: Any) -> None:
    viewer.home()
    viewer.page.set_viewport_size(size)
    viewer.settle()
    panel = viewer.page.get_by_role("complementary", name="Settings")
    fold = viewer.page.get_by_role("button", name="Panel (p)")
    for _ in range(2):
        assert viewer.page.evaluate(CLIPPED) == []
        assert fold.get_attribute("aria-expanded") == str(panel.is_visible()).lower()
        fold.click()
        viewer.settle()


def test_names_of_choices_are_whole(viewer: Opened) -> None:
    viewer.home()
    viewer.page.set_viewport_size(DESK)
    viewer.page.locator("summary", has_text="Picture").evaluate("summary => { summary.parentElement.open = true; }")
    names = viewer.page.get_by_role("radiogroup", name="Tone").get_by_role("radio")
    assert names.first.is_visible()
    assert names.evaluate_all("all => all.map((one) => one.scrollWidth > one.clientWidth)") == [False] * 5


def test_between_a_plot_and_the_panel_the_picture_is_seen(viewer: Opened) -> None:
    viewer.home()
    for width in (660, 800, 940, 960):
        viewer.page.set_viewport_size({"width": width, "height": 600})
        viewer.set(compare="first", view="polar")
        viewer.settle()
        free = viewer.page.evaluate("viewer.panes[0].free")
        assert min(free["width"], free["height"]) > 180
        for cover in (".panel", ".drawer"):
            box = viewer.page.locator(cover).bounding_box()
            assert box is not None
            beside = box["x"] >= free["x"] + free["width"] - 1 or box["x"] + box["width"] <= free["x"] + 1
            assert beside or box["y"] >= free["y"] + free["height"] - 1
    viewer.home()


def test_a_plot_on_a_phone_moves_the_picture_and_its_light_together(viewer: Opened) -> None:
    viewer.home()
    viewer.page.set_viewport_size(PHONE)
    viewer.set(compare="first", view="polar")
    viewer.settle()
    before = viewer.page.evaluate("viewer.panes[0].free.height")
    assert before < 0.8 * PHONE["height"]
    brightness = viewer.picture().astype(float).sum(-1)
    row, column = (float(places.mean()) for places in np.nonzero(brightness > brightness.max() - 3))
    box = viewer.page.get_by_role("button", name="Light 1: drag").bounding_box()
    assert box is not None
    assert box["x"] + box["width"] / 2 == pytest.approx(column, abs=8)
    assert box["y"] + box["height"] / 2 == pytest.approx(row, abs=8)
    viewer.home()
    viewer.page.get_by_role("button", name="Panel (p)").click()  # on a phone the plot took its place


def test_everything_has_a_name_and_the_focus_is_seen(viewer: Opened) -> None:
    assert viewer.page.evaluate(NAMELESS) == []
    viewer.canvas.focus()
    for _ in range(6):
        viewer.page.keyboard.press("Tab")
        seen = viewer.page.evaluate(
            """() => {
                const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(document.activeElement);
                return (outlineStyle !== "none" && parseFloat(outlineWidth) >= 1) || boxShadow !== "none";
            }"""
        )
        assert seen, viewer.page.evaluate("document.activeElement.outerHTML.slice(0, 120)")


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_contrast_is_aa_and_the_theme_follows_the_system_and_the_switch(viewer: Opened, scheme: Any) -> None:
    viewer.page.set_viewport_size(DESK)
    viewer.page.evaluate("delete document.querySelector('#viewer').dataset.theme")
    viewer.page.emulate_media(color_scheme=scheme)
    viewer.settle()
    assert viewer.page.evaluate("viewer.theme()") == scheme
    found = viewer.page.evaluate(CONTRASTS)
    assert len(found) > 40
    assert [(text, round(ratio, 2)) for text, ratio in found if ratio < 4.5] == []
    viewer.page.get_by_role("button", name="Dark or light (d)").click()
    other = {"dark": "light", "light": "dark"}[scheme]
    assert viewer.page.evaluate("viewer.theme()") == other
    assert [(text, round(ratio, 2)) for text, ratio in viewer.page.evaluate(CONTRASTS) if ratio < 4.5] == []


def test_without_webgl2_there_is_a_message_and_the_picture(browser: Browser, file: Path) -> None:
    with opened(browser) as page:
        page.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null;")
        page.page.goto(address(file))
        page.page.get_by_text("no WebGL2").wait_for()
        assert seen_picture(page)


def test_without_javascript_there_is_the_picture(browser: Browser, file: Path) -> None:
    with opened(browser, java_script_enabled=False) as page:
        page.page.goto(address(file))
        assert page.page.get_by_text("Without JavaScript this picture cannot be turned.").is_visible()
        box = page.page.locator("#picture img").bounding_box()
        assert box is not None
        assert box["width"] > 300


def seen_picture(page: Opened) -> bool:
    return bool(page.page.evaluate("document.querySelector('#picture img').naturalWidth === 560"))
