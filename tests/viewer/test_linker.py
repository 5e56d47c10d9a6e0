"""Modules joined to one script do what they do apart; what cannot be joined is refused."""

from __future__ import annotations

import posixpath
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from brdf.viewer.linker import linked, sources
from brdf.viewer.minified import minified

MODULES = {
    "main.js": """\
import { twice, Counter } from "./parts/twice.js";
import {
    LIMIT,
    start,
} from "./parts/limit.js";

// A comment that goes, whose text is no import { a } from "./b.js";
const mine = 1;

/** @type {(text: string) => void} */
const say = (text) => console.log(/** @type {any} */ (text));

say(`${twice(LIMIT)} ${new Counter().next()} ${mine} "// kept" ${"/* kept */"}`);
start().then((done) => say(done));
export default { mine };
""",
    "parts/twice.js": """\
import { LIMIT } from "./limit.js";
const factor = 2;
export function twice(x) { return x * factor; }
export class Counter { next() { return LIMIT + factor; } }
""",
    "parts/limit.js": "export const LIMIT = 20;\nexport async function start() { return 'started'; }\n",
    "parts/grammar.js": """\
const helper = { class: "a", of: 2, get twice() { return this.of * 2; }, async later(helper) { return helper; } };
const words = ["x", "y"];
let [first, second = 3] = [1];
export class Base {
    kept = 1;
    static made = 0;
    #secret = 5;
    get secret() { return this.#secret; }
    set secret(value) { this.#secret = value; }
    constructor(value = words.length, { of: also, twice } = helper) {
        Object.assign(this, { value, also, twice });
        Base.made++;
    }
}
class Derived extends Base {
    constructor() { super(); }
    kind(given) {
        switch (given) {
            case "block": {
                const words = `in ${given === "block" ? `nested ${words2(given)} {}` : "none"} }`;
                return words;
            }
            case first: return "first";
            default: return given ? "some" : "none";
        }
    }
}
function words2(text) {
    return text.replace(/[/"'`{]|c/g, "$&$&").split("").map((word) => word + word).join("");
}
export function grammar() {
    const made = new Derived();
    made.secret = made.secret / 5 / 2;
    const found = [made.kind("block"), made.kind(1), made.kind(0), made.value, made.also, made.twice, made.secret];
    outer: for (const [index, word] of words.entries()) {
        for (let i = 0; i < 3; ++i) {
            if (i > index) continue outer;
            found.push(word + i)
            ++made.kept
        }
    }
    try {
        throw new Error("caught");
    } catch {
        found.push(typeof missing, second, made.kept, made?.none?.(first) ?? "absent", first ? .5 : 1)
    }
    const { kept: first2, ...rest } = made, spread = [...words, ...Object.keys(rest)];
    const sum = async (...numbers) => numbers.reduce((total, number) => total + number, first2);
    return { found, spread, sum, words: (() => { const words = "own"; return { words }; })() };
}
""",
}
MODULES["main.js"] = 'import { grammar } from "./parts/grammar.js";\n' + MODULES["main.js"].replace(
    "export default", "grammar().sum(1, 2).then((sum) => say(JSON.stringify([sum, grammar()])));\nexport default"
)


def node() -> str:
    found = shutil.which("node")
    if found is None:
        pytest.skip("no Node.js; the extra brdf[test] brings it")
    return found


def run(script: Path) -> str:
    return subprocess.run([node(), str(script)], capture_output=True, text=True, check=True, timeout=60).stdout


def test_the_script_does_what_the_modules_do(tmp_path: Path) -> None:
    for name, text in MODULES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, "utf-8")
    (tmp_path / "package.json").write_text('{"type": "module"}', "utf-8")
    apart = run(tmp_path / "main.js")
    assert sorted(apart.splitlines())[:1] == ['40 22 1 "// kept" /* kept */']
    assert "in nested bblloocccckk {} }" in apart
    (tmp_path / "joined.mjs").write_text(linked("main.js", MODULES), "utf-8")
    assert run(tmp_path / "joined.mjs") == apart
    (tmp_path / "import.mjs").write_text('import joined from "./joined.mjs";\nconsole.log(joined.mine);\n', "utf-8")
    assert run(tmp_path / "import.mjs").splitlines()[1] == "1"


def test_comments_are_left_out() -> None:
    script = linked("main.js", MODULES)
    assert "A comment" not in script
    assert "@type" not in script
    assert "import" not in script


@pytest.mark.parametrize(
    ("modules", "message"),
    [
        ({"main.js": 'import { a } from "./a.js";\n'}, "main.js imports a.js, which does not exist"),
        ({}, "the page imports main.js, which does not exist"),
        (
            {"main.js": 'import { a } from "./a.js";\n', "a.js": 'import { b } from "./main.js";\n'},
            "in a circle: main.js -> a.js -> main.js",
        ),
        ({"main.js": 'import a from "./a.js";\n'}, 'main.js: cannot be linked: import a from "./a.js";'),
        (
            {"main.js": 'import { a as b } from "./a.js";\n'},
            'main.js: cannot be linked: import { a as b } from "./a.js";',
        ),
        (
            {"main.js": 'import { a } from "./a.js";\n', "a.js": "const a = 1;\n"},
            "main.js imports a, which a.js does not export",
        ),
        (
            {
                "main.js": 'import { a } from "./a.js";\nconst [b] = [a];\n',
                "a.js": "export const a = 1, b = 2;\nlet b;\n",
            },
            "a.js and main.js both declare b",
        ),
        ({"main.js": "export { a };\n"}, "main.js: cannot be linked: export { a };"),
    ],
)
def test_what_cannot_be_linked(modules: dict[str, str], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        linked("main.js", modules)


def test_every_module_of_the_viewer_links_and_is_used_by_an_entry() -> None:
    modules = {path for path in sources() if path.endswith(".js")}
    seen = set()
    for path in modules:
        assert linked(path).startswith('"use strict";')
    for entry in ("boot.js", "main.js", "widget.js"):
        seen |= reached(entry)
    assert modules == seen


def reached(entry: str) -> set[str]:
    """A module and all that it imports."""
    found: set[str] = set()
    open_ = [entry]
    while open_:
        path = open_.pop()
        found.add(path)
        for target in re.findall(r'^import \{[^}]*\} from "([^"]+)";', sources()[path], re.M):
            place = posixpath.normpath(posixpath.join(posixpath.dirname(path), target))
            if place not in found:
                open_.append(place)
    return found


def test_shaders_in_scripts_lose_their_comments() -> None:
    text = "const a = /* glsl */ `\n// why\nuniform vec2 place;  // of the picture\n    x = a - -b;`, b = `// kept`;\n"
    assert minified(text, "application/javascript") == "const a=`\nuniform vec2 place;\nx = a - -b;`,b=`// kept`"


def test_without_the_library_the_text_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "minify", None)
    assert minified("a  =  1", "application/javascript") == "a  =  1"
