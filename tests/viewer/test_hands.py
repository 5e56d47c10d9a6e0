"""Hands on the page: mouse, touch and keys turn, shift and light the object."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from tests.viewer.pages import Opened, address, opened

import brdf
from brdf.models import GGX, Lambertian

if TYPE_CHECKING:
    from playwright.sync_api import Browser

DEGREES = 0.4
"""That a pixel turns."""


@pytest.fixture(scope="module")
def viewer(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    path = tmp_path_factory.mktemp("page") / "ball.html"
    ball = 0.5 * Lambertian(albedo=0.8) + GGX(alpha=0.2)
    brdf.export(ball.named("ball"), path, mesh="sphere", lights="directional:theta=40,phi=20")
    with opened(browser, has_touch=True) as page:
        yield page.open(address(path))


@pytest.fixture
def ball(viewer: Opened) -> Opened:
    """The page as it was opened."""
    viewer.home()
    return viewer


def test_the_mouse_turns_shifts_and_zooms(ball: Opened) -> None:
    before, (x, y) = ball.state, ball.middle()
    ball.drag((x, y), (x + 50, y + 25))
    assert ball.state["phi"] == pytest.approx(before["phi"] - 50 * DEGREES, abs=1e-3)
    assert ball.state["theta"] == pytest.approx(before["theta"] - 25 * DEGREES, abs=1e-3)
    ball.drag((x - 60, y + 80), (x - 10, y + 80), button="right")
    assert ball.state["pan"][0] != 0
    assert ball.state["phi"] == pytest.approx(before["phi"] - 50 * DEGREES, abs=1e-3)
    ball.page.mouse.wheel(0, -300)
    ball.until("viewer.state.zoom > 1.2")
    ball.page.mouse.dblclick(x - 60, y + 80)
    assert {key: ball.state[key] for key in ("theta", "phi", "zoom", "pan")} == {
        key: before[key] for key in ("theta", "phi", "zoom", "pan")
    }


def test_one_finger_turns_and_two_zoom_and_shift(ball: Opened) -> None:
    before, (x, y) = ball.state, ball.middle()
    ball.touch("touchStart", (x, y))
    ball.touch("touchMove", (x + 20, y))
    ball.touch("touchMove", (x + 40, y))
    ball.touch("touchEnd")
    assert ball.state["phi"] == pytest.approx(before["phi"] - 40 * DEGREES, abs=1e-3)
    assert ball.state["zoom"] == before["zoom"]
    y += 100  # away from the light's handle
    ball.touch("touchStart", (x - 40, y), (x + 40, y))
    ball.touch("touchMove", (x - 60, y), (x + 60, y))
    ball.touch("touchMove", (x - 80, y), (x + 80, y))
    ball.touch("touchEnd")
    assert ball.state["zoom"] == pytest.approx(2, rel=0.05)
    ball.touch("touchStart", (x - 40, y), (x + 40, y))
    ball.touch("touchMove", (x - 40, y - 60), (x + 40, y - 60))
    ball.touch("touchEnd")
    assert ball.state["pan"][1] != 0


def test_keys_turn_zoom_and_bring_back(ball: Opened) -> None:
    before = ball.state
    ball.canvas.focus()
    for key in ("ArrowLeft", "ArrowLeft", "ArrowDown", "+"):
        ball.page.keyboard.press(key)
    after = ball.state
    assert after["phi"] != before["phi"]
    assert after["theta"] != before["theta"]
    assert after["zoom"] > 1
    ball.page.keyboard.press("-")
    assert ball.state["zoom"] == pytest.approx(1)
    ball.page.keyboard.press("0")
    assert (ball.state["theta"], ball.state["phi"]) == (before["theta"], before["phi"])


def test_keys_change_comparison_exposure_and_panel(ball: Opened) -> None:
    ball.canvas.focus()
    ball.page.keyboard.press("]")
    assert ball.state["exposure"] == 0.25
    ball.page.keyboard.press("[")
    assert ball.state["exposure"] == 0
    for number, name in enumerate(["first", "second", "split", "side", "difference"], start=1):
        ball.page.keyboard.press(str(number))
        assert ball.state["compare"] == name
    panel = ball.page.get_by_role("complementary", name="Settings")
    ball.page.keyboard.press("p")
    assert not panel.is_visible()
    ball.page.keyboard.press("p")
    assert panel.is_visible()
    ball.page.keyboard.press("g")
    assert ball.state["mesh"] == "teapot"


@pytest.mark.parametrize("how", ["shift", "tool", "handle"])
def test_the_light_is_dragged_on_the_object(ball: Opened, how: str) -> None:
    """The highlight, and so the light's handle, comes to where the hand is."""
    before = ball.state
    handle = ball.page.get_by_role("button", name="Light 1: drag, or turn it with the arrow keys")
    box = handle.bounding_box()
    assert box is not None
    start = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    end = start[0] - 60, start[1] + 50
    if how == "shift":
        ball.page.keyboard.down("Shift")
        ball.drag((start[0] + 30, start[1] + 30), end)
        ball.page.keyboard.up("Shift")
    else:
        if how == "tool":
            ball.page.get_by_role("button", name="Move the light").click()
        ball.drag(start if how == "handle" else (start[0] + 30, start[1] + 30), end)
    moved = handle.bounding_box()
    assert moved is not None
    assert moved["x"] + moved["width"] / 2 == pytest.approx(end[0], abs=3)
    assert moved["y"] + moved["height"] / 2 == pytest.approx(end[1], abs=3)
    after = ball.state
    assert after["lights"] != before["lights"]
    assert (after["theta"], after["phi"]) == (before["theta"], before["phi"])


def test_the_light_is_moved_by_keys_and_by_touch(ball: Opened) -> None:
    ball.canvas.focus()
    before = ball.state["lights"][0]
    ball.page.keyboard.press("Shift+ArrowLeft")
    assert ball.state["lights"][0]["phi"] < before["phi"]
    ball.page.get_by_role("button", name="Light 1: drag").focus()
    ball.page.keyboard.press("ArrowDown")
    assert ball.state["lights"][0]["theta"] == pytest.approx(before["theta"] + 5)
    ball.page.get_by_role("button", name="Move the light").click()
    before, (x, y) = ball.state["lights"][0], ball.middle()
    ball.touch("touchStart", (x, y))
    ball.touch("touchMove", (x + 20, y + 10))
    ball.touch("touchEnd")
    assert ball.state["lights"][0] != before


def test_help_opens_and_closes(ball: Opened) -> None:
    ball.canvas.focus()
    ball.page.keyboard.press("?")
    dialog = ball.page.get_by_role("dialog", name="Hands and keys")
    assert dialog.is_visible()
    ball.page.keyboard.press("Escape")
    assert not dialog.is_visible()
    ball.page.get_by_role("button", name="Help (?)").click()
    assert dialog.is_visible()
    dialog.get_by_role("button", name="Close").click()
    assert not dialog.is_visible()


@pytest.mark.parametrize("distance", [1.1, 1.5, 3])
def test_the_ring_of_a_near_light_stays_under_the_hand(ball: Opened, distance: float) -> None:
    ball.set(lights=[{"kind": "point", "position": [0, 0, distance], "power": [1, 1, 1]}])
    x, y = ball.middle()
    ring = ball.page.get_by_role("button", name="drag, or turn it")
    for across, down in ((40, -30), (-25, 20), (0, 60)):
        ball.page.evaluate("place => viewer.moveLight(0, place)", [x + across, y + down])
        box = ring.bounding_box()
        assert box is not None
        assert box["x"] + box["width"] / 2 == pytest.approx(x + across, abs=1)
        assert box["y"] + box["height"] / 2 == pytest.approx(y + down, abs=1)
