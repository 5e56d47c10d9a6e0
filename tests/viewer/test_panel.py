"""The page's panel: every control changes the state, the picture follows, and the address carries it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.viewer.pages import Opened, address, opened

import brdf
from brdf.models import GGX, Lambertian

if TYPE_CHECKING:
    from playwright.sync_api import Browser

PAIR = [GGX(alpha=0.3, F0=(1, 0.78, 0.34)).named("gold"), Lambertian(albedo=(0.2, 0.4, 0.7)).named("blue")]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "pair.html"
    brdf.export(PAIR, path, mesh="sphere", lights="directional:theta=40,phi=20")
    return path


@pytest.fixture(scope="module")
def viewer(browser: Browser, file: Path) -> Iterator[Opened]:
    with opened(browser, viewport={"width": 660, "height": 360}) as page:
        page.open(address(file))
        for summary in page.page.get_by_role("complementary").locator("details:not([open]) > summary").all():
            summary.click()
        yield page


@pytest.fixture
def pair(viewer: Opened) -> Opened:
    viewer.home()
    return viewer


def pick(viewer: Opened, group: str, name: str) -> None:
    viewer.page.get_by_role("radiogroup", name=group).get_by_role("radio", name=name, exact=True).click()


def test_shapes_surroundings_and_shadows(pair: Opened) -> None:
    before = pair.picture()
    pick(pair, "Shape", "Plane")
    assert pair.state["mesh"] == "plane"
    assert np.abs(pair.picture().astype(int) - before).mean() > 2
    pick(pair, "Shape", "Sphere")
    pair.page.get_by_label("Surroundings").select_option("Constant 1")
    assert pair.state["environment"] == "constant 1"
    strength = pair.page.get_by_role("textbox", name="Strength, value")
    strength.fill("2.5")
    strength.press("Enter")
    assert pair.state["strength"] == 2.5
    turned = pair.page.get_by_role("slider", name="Turned")
    turned.fill("250")
    assert pair.state["turn"] == pytest.approx(180)
    pair.page.get_by_label("Surroundings").select_option("None")
    assert pair.state["environment"] is None
    assert not turned.is_visible()
    pair.page.get_by_role("switch", name="Shadows").click()
    assert pair.state["shadows"] is False


def test_up_to_eight_lights_of_two_kinds_with_colour_and_power(pair: Opened) -> None:
    add = pair.page.get_by_role("button", name="Add a light")
    while add.is_enabled():
        add.click()
    assert len(pair.state["lights"]) == 8
    assert pair.page.get_by_role("button", name="drag, or turn it").count() == 8
    while pair.page.get_by_role("button", name="Remove light 2").count():
        pair.page.get_by_role("button", name="Remove light 2").click()
    assert len(pair.state["lights"]) == 1
    light = pair.page.get_by_role("group", name="Light 1")
    light.get_by_label("Kind of light 1").select_option("Point")
    assert pair.state["lights"][0]["kind"] == "point"
    assert len(pair.state["lights"][0]["position"]) == 3
    light.get_by_label("Kind of light 1").select_option("Parallel")
    assert pair.state["lights"][0]["theta"] == pytest.approx(40, abs=1e-3)
    light.get_by_label("Colour of light 1").fill("#ff8000")
    red, green, blue = pair.state["lights"][0]["power"]
    assert red == 1
    assert green == pytest.approx(0.216, abs=2e-3)  # sRGB 128 is linear 0.216
    assert blue == 0
    power = light.get_by_role("textbox", name="Power, value")
    power.fill("3")
    power.press("Enter")
    assert pair.state["lights"][0]["power"][0] == pytest.approx(3)


def test_keys_stay_where_a_control_changes_the_panel(pair: Opened) -> None:
    kind = pair.page.get_by_label("Kind of light 1")
    kind.focus()
    pair.page.keyboard.press("ArrowDown")
    assert pair.state["lights"][0]["kind"] == "point"
    assert kind.evaluate("list => list === document.activeElement")
    pair.page.keyboard.press("ArrowUp")
    assert pair.state["lights"][0]["kind"] == "directional"
    pair.page.get_by_role("button", name="Remove light 1").press("Enter")
    assert pair.canvas.evaluate("canvas => canvas === document.activeElement")
    pair.set(parameters=[{"alpha": 0.7}, {}])
    pair.page.get_by_role("button", name="Reset the parameters").press("Enter")
    assert pair.canvas.evaluate("canvas => canvas === document.activeElement")


def test_lights_far_away_keep_their_power(pair: Opened) -> None:
    light = {"kind": "point", "position": [2e4, 2e4, 2e4], "power": [1e9, 1e9, 1e9]}
    pair.set(lights=[light])
    assert pair.state["lights"] == [light]


def test_what_is_shown_may_change_while_another_picture_is_begun(pair: Opened) -> None:
    pair.set(compare="first")
    pair.finished()
    pair.page.evaluate("viewer.set({ compare: 'split' }); viewer.set({ exposure: 1 }); viewer.png()")
    pair.set(phi=40)
    pair.finished()
    assert not pair.page.locator(".message.wrong").is_visible()


def test_the_difference_keeps_its_label(pair: Opened) -> None:
    pair.set(compare="difference")
    label = pair.page.locator(".name").first
    before = label.inner_text()
    assert before.startswith("|A − B|")
    pair.page.keyboard.press("l")
    pair.page.evaluate("viewer.frame.refresh(); viewer.themed()")
    assert label.inner_text() == before


def test_exposure_tone_and_backdrop(pair: Opened) -> None:
    dark = pair.picture()
    exposure = pair.page.get_by_role("textbox", name="Exposure, value")
    exposure.fill("1")
    exposure.press("Enter")
    assert pair.state["exposure"] == 1
    assert pair.picture().mean() > 1.2 * dark.mean()
    for name in ("Clip", "Reinhard", "Filmic"):
        pick(pair, "Tone", name)
        assert pair.state["tone"] == name.lower()
    pick(pair, "Backdrop", "Plain")
    plain = pair.picture()
    assert (plain[:20, :20] == plain[0, 0]).all()


def test_two_materials_side_by_side_split_and_their_difference(pair: Opened) -> None:
    number = pair.page.get_by_text("PSNR ")
    expected = brdf.metrics.psnr(*PAIR)
    assert f"{expected:.1f} dB" in number.inner_text()
    split = pair.picture()
    line = pair.page.get_by_role("slider", name="Divider between A and B")
    box = line.bounding_box()
    assert box is not None
    start = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    pair.drag(start, (start[0] - 80, start[1]))
    assert pair.state["divider"] < 0.45
    assert (pair.picture() != split).any()
    line.focus()
    moved = pair.state["divider"]
    pair.page.keyboard.press("ArrowRight")
    assert pair.state["divider"] == pytest.approx(moved + 0.02)
    pick(pair, "Comparison", "A − B")
    times = pair.page.get_by_role("textbox", name="Times, value")
    times.fill("1")
    times.press("Enter")
    once = pair.picture()
    times.fill("16")
    times.press("Enter")
    assert pair.picture().mean() > once.mean()
    pick(pair, "Comparison", "Side")
    side = pair.picture()
    assert pair.page.get_by_text("B  blue", exact=True).first.is_visible()
    pick(pair, "Comparison", "B")
    alone = pair.picture()
    assert (alone != side).any()
    assert alone.reshape(-1, 3).mean(0).argmax() == 2  # blue


def test_sliders_come_from_the_parameters_and_are_reset(pair: Opened) -> None:
    pick(pair, "Comparison", "A")
    before = pair.picture()
    reset = pair.page.get_by_role("button", name="Reset the parameters")
    assert not reset.is_visible()
    alpha = pair.page.get_by_role("textbox", name="alpha, value")
    assert alpha.input_value() == "0.3"
    alpha.fill("0.05")
    alpha.press("Enter")
    assert pair.state["parameters"][0] == {"alpha": 0.05}
    assert (pair.picture() != before).any()
    alpha.fill("7")
    alpha.press("Tab")
    assert alpha.input_value() == "1"  # its bound
    pair.page.get_by_label("F0", exact=True).fill("#0000ff")
    assert pair.state["parameters"][0]["F0"] == [0, 0, 1]
    reset.click()
    assert pair.state["parameters"][0] == {}
    np.testing.assert_array_equal(pair.picture(), before)


@pytest.mark.parametrize("typed", ["abc", "0.3 foo 5", "", " ", "--1", "Infinity"])
def test_what_is_no_number_is_refused(pair: Opened, typed: str) -> None:
    pick(pair, "Comparison", "A")
    alpha = pair.page.get_by_role("textbox", name="alpha, value")
    before = pair.state
    alpha.fill(typed)
    alpha.press("Enter")
    assert alpha.input_value() == "0.3"
    assert pair.state == before


def test_a_number_out_of_bounds_becomes_the_bound_everywhere(pair: Opened) -> None:
    pick(pair, "Comparison", "A")
    for name, typed, shown in (("alpha", "99", "1"), ("Exposure", "-1e3", "-10 EV")):
        field = pair.page.get_by_role("textbox", name=f"{name}, value")
        field.fill(typed)
        field.press("Enter")
        assert field.input_value() == shown
    assert (pair.state["parameters"][0], pair.state["exposure"]) == ({"alpha": 1}, -10)
    pair.page.get_by_label("Surroundings").select_option("Constant 1")
    turned = pair.page.get_by_role("textbox", name="Turned, value")
    for typed in ("12,5", "12.5°", " 12.5 ° "):
        turned.fill(typed)
        turned.press("Enter")
        assert turned.input_value() == "12.5°"
        assert pair.state["turn"] == 12.5


def test_the_address_carries_the_view(pair: Opened, browser: Browser, file: Path) -> None:
    pair.set(theta=80, phi=-30, mesh="plane", exposure=0.5, tone="clip", compare="difference", gain=4, shadows=False)
    pair.set(lights=[{"kind": "point", "position": [1, 2, 3], "power": [5, 4, 3]}], parameters=[{"alpha": 0.1}, {}])
    pair.until("location.hash.includes('gain=4')")
    state, here = pair.state, pair.page.url
    with opened(browser) as other:
        other.open(here)
        assert other.state == state
        other.page.evaluate("location.hash = ''")
        other.until("viewer.state.gain === 8")
        other.page.evaluate("location.hash = 'zoom=3'")
        other.until("viewer.state.zoom === 3")
        other.page.evaluate("location.hash = 'gain=2&zoom=%22big%22'")
        other.until("viewer.state.gain === 2")
        assert other.state["zoom"] == 1  # as it was opened, not as it was
    with opened(browser) as broken:
        broken.open(address(file, "theta=1e999&lights=[{&mesh=%22nothing%22&zoom=%22big%22&exposure=99&%E0%A4%A"))
        assert (broken.state["theta"], broken.state["mesh"], broken.state["zoom"]) == (68, "sphere", 1)
        assert broken.state["exposure"] == 10  # its bound


def test_the_picture_is_saved(pair: Opened, tmp_path: Path) -> None:
    pair.finished()
    with pair.page.expect_download() as saving:
        pair.page.get_by_role("button", name="Save a PNG").click()
    saved = tmp_path / "saved.png"
    saving.value.save_as(saved)
    assert saving.value.suggested_filename == "gold-blue.png"
    from PIL import Image

    np.testing.assert_array_equal(np.asarray(Image.open(saved).convert("RGB")), pair.picture())


def test_every_plot_opens_and_says_what_it_shows(pair: Opened) -> None:
    drawer = pair.page.get_by_role("region", name="Plot")
    buttons = pair.page.locator(".views button")
    assert buttons.count() >= 5
    for button in buttons.all():
        button.click()
        assert drawer.is_visible()
        assert drawer.get_by_role("heading").inner_text() == button.inner_text()
        assert pair.state["view"] == button.get_attribute("value")
        pair.until("(document.querySelector('.drawer [role=img]')?.getAttribute('aria-label') ?? '').length > 20")
    pair.page.get_by_role("button", name="Close the plot").click()
    assert not drawer.is_visible()
