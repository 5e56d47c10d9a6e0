"""The widget's script in a page, held as notebooks hold it: state goes both ways."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

import numpy as np
import pytest
from tests.viewer.pages import opened

from brdf.models import GGX
from brdf.viewer.payload import View
from brdf.viewer.widget import widget

if TYPE_CHECKING:
    from playwright.sync_api import Browser

HOST = """async ([script, style, payload]) => {
    const sheet = document.createElement("style");
    sheet.textContent = style;
    document.head.append(sheet);
    const bytes = Uint8Array.from(atob(payload), (c) => c.charCodeAt(0));
    const values = { payload: new DataView(bytes.buffer), state: {}, height: 300 };
    const listeners = {};
    window.saved = 0;
    window.model = {
        get: (name) => values[name],
        set: (name, value) => {
            values[name] = value;
            (listeners[`change:${name}`] ?? []).forEach((then) => then());
        },
        save_changes: () => window.saved++,
        on: (event, then) => (listeners[event] ??= []).push(then),
        off: (event, then) => (listeners[event] = listeners[event].filter((other) => other !== then)),
    };
    window.listening = () => Object.values(listeners).flat().length;
    const { default: made } = await import(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
    const el = document.createElement("div");
    document.body.append(el);
    window.ended = made.render({ model: window.model, el });
}"""


def test_the_state_goes_both_ways(browser: Browser) -> None:
    made = widget([GGX(alpha=0.3)], View(mesh="sphere", lights="directional:theta=40"))
    payload = base64.b64encode(made.payload).decode()
    with opened(browser) as page:
        page.page.set_content("<!doctype html><title>notebook</title><link rel=icon href=data:,>")
        page.page.evaluate(HOST, [made._esm, made._css, payload])
        canvas = page.page.get_by_role("img", name="GGX on a sphere")
        page.until("document.querySelector('[data-state]')?.dataset.state === 'done'")
        box = canvas.bounding_box()
        assert box is not None
        assert box["height"] == pytest.approx(300, abs=2)
        x, y = box["x"] + 40, box["y"] + 250
        page.drag((x, y), (x + 50, y))
        told = page.page.evaluate("model.get('state')")
        assert told["phi"] == pytest.approx(20 - 50 * 0.4, abs=1e-3)
        assert page.page.evaluate("saved") > 0
        page.page.evaluate("model.set('state', { ...model.get('state'), mesh: 'plane', exposure: 1 })")
        page.page.get_by_role("img", name="GGX on a plane").wait_for()
        page.page.evaluate("model.set('state', { ...model.get('state'), mesh: 'nope' })")
        assert page.page.evaluate("model.get('state').mesh") == "plane"
        page.page.evaluate("model.set('payload', model.get('payload'))")
        page.page.get_by_role("img", name="GGX on a plane").wait_for()
        page.page.evaluate("model.set('height', 200)")
        page.settle()
        box = page.page.get_by_role("img", name="GGX on a plane").bounding_box()
        assert box is not None
        assert box["height"] == pytest.approx(200, abs=2)
        assert page.page.evaluate("location.hash") == ""  # the notebook's address is not ours
        page.page.evaluate("ended()")
        assert page.page.evaluate("listening()") == 0
        assert page.page.locator("canvas").count() == 0
    assert np.frombuffer(made.payload[:4], "<u4")[0] > 1000
