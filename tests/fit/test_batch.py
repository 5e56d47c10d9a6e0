"""Many fits: what is kept, what goes on, what is written."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brdf
import fit_tasks
from brdf.errors import BrdfError, FileError, MissingExtraError, ParameterError, UnknownFormatError
from brdf.fit import Data, data_of, fit_many
from brdf.fit import batch as batch_module
from brdf.fit.table import write_table
from brdf.fit.workers import outcomes
from fit_tasks import die, die_once, square

DATA = ["Lambertian:albedo=.2 + Ward:ks=.3,alpha=.15", "Lambertian:albedo=.4 + Ward:ks=.1,alpha=.3"]
OPTIONS = {"budget": 1, "grazing": 70.0}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("fits") / "fits"
    fit_many(DATA, ["Ward", "Lambertian"], made, **OPTIONS)
    return made


def test_every_fit_is_a_material_with_its_numbers(folder: Path) -> None:
    materials = sorted(folder.glob("*.safetensors"))
    assert len(materials) == 4
    for path in materials:
        known = json.loads(path.with_suffix(".json").read_text("utf-8"))
        assert known["fit"]["file"] == path.name
        assert known["task"]["data"] in DATA
        assert "albedo" in str(brdf.load(str(path)).values)


def test_finished_fits_are_kept(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def never(task: object) -> None:
        raise AssertionError("fitted again")

    monkeypatch.setattr(batch_module, "make", never)
    again = fit_many(DATA, ["Ward", "Lambertian"], folder, **OPTIONS)
    assert again.kept == len(again.fits) == 4
    assert [(one["data"], one["model"]) for one in again.fits] == [(d, m) for d in DATA for m in ("Ward", "Lambertian")]


def test_other_options_or_a_damaged_file_are_fitted_again(folder: Path) -> None:
    whole = fit_many(DATA[:1], ["Ward"], folder, **OPTIONS)
    assert whole.kept == 1
    assert fit_many(DATA[:1], ["Ward"], folder, budget=1, grazing=65.0).kept == 0
    fit_many(DATA[:1], ["Ward"], folder, **OPTIONS)
    material = folder / whole.fits[0]["file"]
    material.write_bytes(material.read_bytes()[:100])
    assert fit_many(DATA[:1], ["Ward"], folder, **OPTIONS).kept == 0
    material.with_suffix(".json").write_text("{")
    assert fit_many(DATA[:1], ["Ward"], folder, **OPTIONS).kept == 0


def test_options_may_be_numbers_of_numpy(tmp_path: Path) -> None:
    given = {"lobes": np.int64(1), "budget": np.int64(1), "seed": np.int64(3), "grazing": np.float32(70)}
    made = fit_many(DATA[:1], ["Ward"], tmp_path / "fits", diffuse=np.bool_(True), **given)
    assert (made.kept, made.failures) == (0, {})
    same = {"lobes": 1, "budget": 1, "seed": 3, "grazing": 70.0}
    assert fit_many(DATA[:1], ["Ward"], tmp_path / "fits", diffuse=True, **same).fits == made.fits


def test_a_changed_file_is_fitted_again(tmp_path: Path) -> None:
    path = tmp_path / "x.safetensors"
    for number, albedo in enumerate((0.2, 0.3, 0.3)):
        brdf.models.Lambertian(albedo=albedo).save(path)
        done = fit_many([str(path)], ["Lambertian"], tmp_path / "fits", **OPTIONS)
        assert done.kept == (1 if number == 2 else 0)
        assert done.fits[0]["parameters"]["albedo_r"]["value"] == pytest.approx(albedo)


@pytest.mark.parametrize(
    "spec", ["x.safetensors + Lambertian:albedo=.1", "2*x.safetensors", "Lambertian:albedo=.1 + .5 * ./x.safetensors"]
)
def test_a_changed_file_in_a_sum_is_fitted_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spec: str) -> None:
    fits = []
    for sub, albedo, kept in (("a", 0.2, 0), ("a", 0.3, 0), ("a", 0.3, 1), ("b", 0.3, 0)):
        (tmp_path / sub).mkdir(exist_ok=True)
        monkeypatch.chdir(tmp_path / sub)
        brdf.models.Lambertian(albedo=albedo).save("x.safetensors")
        done = fit_many([spec], ["Lambertian"], tmp_path / "fits", **OPTIONS)
        assert (done.kept, done.failures) == (kept, {})
        assert str(tmp_path / sub / "x.safetensors") in done.fits[0]["path"]
        assert float(brdf.load(done.fits[0]["path"]).albedo([0, 0, 1.0])[0]) == pytest.approx(
            done.fits[0]["parameters"]["albedo_r"]["value"], rel=1e-3
        )
        fits.append(done.fits[0])
    assert fits[0]["file"] == fits[1]["file"] != fits[3]["file"]
    assert "x.safetensors" in fits[0]["file"]
    assert tmp_path.name not in fits[0]["file"]


def test_a_sum_in_a_folder_with_a_plus_stays_readable(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "c++").mkdir()
    monkeypatch.chdir(tmp_path / "c++")
    brdf.models.Lambertian(albedo=0.2).save("x.safetensors")
    done = fit_many(["2*x.safetensors", "x.safetensors"], ["Lambertian"], tmp_path / "fits", **OPTIONS)
    assert [one["path"] for one in done.fits] == ["2*x.safetensors", str(tmp_path / "c++" / "x.safetensors")]


def test_files_are_fitted_again_when_those_beside_them_have_changed(tmp_path: Path) -> None:
    pictures = tmp_path / "pictures"
    pictures.mkdir()
    (pictures / "sphere-images.json").write_text("{}")
    for name in ("fc1", "b3"):
        (tmp_path / f"paint_{name}.npy").touch()
    data = [
        str(pictures / "sphere-images.json"),
        str(tmp_path / "paint_fc1.npy"),
        str(tmp_path / "paint_fc1.npy@paint"),
    ]
    for content, kept in (("a", 0), ("a", 3), ("b", 0)):
        (pictures / "picture").write_text(content)
        (tmp_path / "paint_b3.npy").write_text(content)
        done = fit_many(data, ["Lambertian"], tmp_path / "fits", read=grey, **OPTIONS)
        assert (done.kept, done.failures) == (kept, {})


def test_a_changed_model_is_fitted_again(tmp_path: Path) -> None:
    path = tmp_path / "m.safetensors"
    for alpha, kept in ((0.1, 0), (0.1, 1), (0.4, 0)):
        brdf.models.Ward(alpha=alpha).save(path)
        done = fit_many(DATA[:1], [str(path)], tmp_path / "fits", fixed=["lobe2_alpha"], **OPTIONS)
        assert (done.kept, done.failures) == (kept, {})
        assert done.fits[0]["parameters"]["lobe2_alpha"]["value"] == pytest.approx(alpha)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are of POSIX")
def test_a_pipe_is_read_by_the_fit_alone(tmp_path: Path) -> None:
    """Whoever opened it before would wait for a writer, or take what the fit needs."""
    os.mkfifo(tmp_path / "pipe")
    assert len(fit_many([str(tmp_path / "pipe")], ["Lambertian"], tmp_path / "fits", read=grey, **OPTIONS).fits) == 1


def test_an_interrupted_run_goes_on(tmp_path: Path) -> None:
    def stop(done: int, total: int, what: str) -> None:
        if done == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fit_many(DATA, ["Ward"], tmp_path / "fits", progress=stop, **OPTIONS)
    assert fit_many(DATA, ["Ward"], tmp_path / "fits", **OPTIONS).kept == 1


def test_what_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    (tmp_path / "empty.binary").touch()
    done = fit_many([str(tmp_path / "empty.binary"), DATA[0]], ["Ward"], tmp_path / "fits", **OPTIONS)
    assert len(done.fits) == 1
    (failure,) = done.failures.values()
    assert "empty.binary" in failure
    assert sorted(p.suffix for p in (tmp_path / "fits").iterdir()) == [".json", ".safetensors"]


def test_files_of_one_name_do_not_overwrite_each_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for sub, albedo in (("a", 0.2), ("b", 0.5)):
        (tmp_path / sub).mkdir()
        brdf.models.Lambertian(albedo=albedo).save(tmp_path / sub / "x.safetensors")
    specs = [str(tmp_path / sub / "x.safetensors") for sub in "ab"]
    done = fit_many(specs, ["Lambertian"], tmp_path / "fits", **OPTIONS)
    assert [one["parameters"]["albedo_r"]["value"] for one in done.fits] == pytest.approx([0.2, 0.5])
    assert [one["path"] for one in done.fits] == specs
    assert len({one["file"] for one in done.fits}) == 2
    for sub, one in zip("ab", done.fits, strict=True):  # what a fit is called depends on nothing else in the command
        monkeypatch.chdir(tmp_path / sub)
        again = fit_many(["x.safetensors"], ["Lambertian"], tmp_path / "fits", **OPTIONS)
        assert (again.kept, again.fits) == (1, [one])


def test_a_changed_folder_is_fitted_again(tmp_path: Path) -> None:
    folder = tmp_path / "pictures"
    folder.mkdir()
    for content, kept in (("a", 0), ("a", 1), ("b", 0)):
        (folder / "picture").write_text(content)
        assert fit_many([str(folder)], ["Lambertian"], tmp_path / "fits", read=grey, **OPTIONS).kept == kept


def grey(spec: str, grazing: float) -> Data:
    return data_of(DATA[0], grazing)


def test_a_folder_of_other_things_is_left_alone(tmp_path: Path) -> None:
    for name in ("probe.json", "index.html"):
        (tmp_path / name).write_text("mine")
    with pytest.raises(FileError, match=r"holds other files \(index.html\) and no fit; give a new or an empty folder"):
        fit_many(DATA[:1], ["Ward"], tmp_path, **OPTIONS)
    made = tmp_path / "fits"
    fit_many(DATA[:1], ["Ward"], made, **OPTIONS)
    (made / "probe.json").write_text("mine")
    assert fit_many(DATA[:1], ["Ward"], made, **OPTIONS).kept == 1
    assert {(p / "probe.json").read_text() for p in (tmp_path, made)} == {"mine"}


def test_what_fails_unexpectedly_does_not_stop_the_others(tmp_path: Path) -> None:
    def read(spec: str, grazing: float) -> Data:
        if spec == DATA[0]:
            raise IndexError("out of\nrange")
        return data_of(spec, grazing)

    done = fit_many(DATA, ["Ward"], tmp_path / "fits", read=read, **OPTIONS)
    assert [one["data"] for one in done.fits] == DATA[1:]
    ((what, why),) = done.failures.items()
    assert what == f"{DATA[0]}, Ward"
    assert why.startswith("unexpected IndexError: out of range; please report it")


def test_failures_are_in_the_order_of_the_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batch_module, "outcomes", lambda make, tasks, *rest: [(t, "no") for t in reversed(tasks)])
    done = fit_many(DATA, ["Ward", "GGX"], tmp_path / "fits", **OPTIONS)
    assert list(done.failures) == [f"{d}, {m}" for d in DATA for m in ("Ward", "GGX")]


@pytest.mark.parametrize(
    ("models", "options", "message"),
    [
        ([], {}, "no model is named"),
        (["Ward", "Foo"], {}, "unknown model 'Foo'"),
        (["Ward"], {"metric": "foo"}, "unknown metric 'foo'"),
        (["Ward"], {"robust": "foo"}, "unknown robust loss 'foo'"),
        (["Ward"], {"robust": "huber", "metric": "image"}, "the image metric has no robust form"),
        (["Ward"], {"lobes": 9}, "a fit has 1 to 3 lobes, got 9"),
        (["Ward"], {"lobes": "2"}, "lobes must be 1 to 3 or \"auto\", got '2'"),
        (["Ward"], {"fixed": ["lobe2_alpha", "lobe2_alfa"]}, "unknown parameter of Ward 'lobe2_alfa'"),
        (["Ward"], {"budget": 0}, "a fit begins 1 to 4096 searches, got 0"),
        (["Ward"], {"seed": -1}, "a seed is a whole number from 0 on, got -1"),
        (["Ward"], {"grazing": 91.0}, r"the grazing angle must lie in \(0, 90\] degrees, got 91"),
    ],
)
def test_wrong_options_are_told_before_anything_is_read(
    tmp_path: Path, models: list[str], options: dict[str, Any], message: str
) -> None:
    def never(spec: str, grazing: float) -> Data:
        raise AssertionError("read")

    with pytest.raises(BrdfError, match=message):
        fit_many(DATA, models, tmp_path / "fits", read=never, **options)
    assert not (tmp_path / "fits").exists()


def test_processes_share_the_work() -> None:
    assert dict(outcomes(square, [1, 2, 3, 4], 2, None, 1)) == {1: 1, 2: 4, 3: 9, 4: 16}


def test_a_killed_process_loses_its_own_task_only_and_that_is_begun_again(tmp_path: Path) -> None:
    paths = [str(tmp_path / name) for name in "abc"]
    for innocent in paths[1:]:
        Path(innocent).touch()
    assert dict(outcomes(die_once, paths, 2, None, 1)) == dict.fromkeys(paths, "done")
    found = dict(outcomes(die, [1, 2], 2, None, 1))
    assert all("its process died, twice" in str(v) for v in found.values())


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="processes are looked up in /proc, which Linux has")
def test_no_process_outlives_the_one_that_is_killed(tmp_path: Path) -> None:
    paths = [tmp_path / name for name in "ab"]
    script = tmp_path / "many.py"
    script.write_text(
        f"import sys\nsys.path.insert(0, {str(Path(fit_tasks.__file__).parent)!r})\n"
        "from brdf.fit.workers import outcomes\nfrom fit_tasks import sleep_long\n"
        f"if __name__ == '__main__':\n    list(outcomes(sleep_long, {[*map(str, paths)]}, 2, None, 1))\n"
    )
    with subprocess.Popen([sys.executable, str(script)]) as parent:
        until(lambda: all(path.exists() and path.read_text() for path in paths))
        parent.kill()
    until(lambda: not any(Path("/proc", path.read_text()).exists() for path in paths))


def until(holds: Callable[[], bool]) -> None:
    end = time.monotonic() + 60
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_a_cluster_gives_the_same_fits(folder: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None, worker_dashboard_address=None
    ) as cluster:
        done = fit_many(DATA, ["Ward"], tmp_path / "fits", scheduler=cluster.scheduler_address, **OPTIONS)
    here = fit_many(DATA, ["Ward"], folder, **OPTIONS)
    for one, other in zip(done.fits, here.fits, strict=True):
        assert one["parameters"] == other["parameters"]


def test_a_scheduler_that_does_not_answer_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr("brdf.fit.workers.CONNECTING", 0.5)
    made = []

    class Kept(distributed.Client):
        def __init__(self, *given: Any, **options: Any) -> None:
            made.append(self)
            super().__init__(*given, **options)

    monkeypatch.setattr(distributed, "Client", Kept)
    with pytest.raises(ParameterError, match="no Dask scheduler answers at nonsense"):
        fit_many(DATA, ["Ward"], tmp_path / "fits", scheduler="nonsense", **OPTIONS)
    assert not (tmp_path / "fits").exists()
    # one left open would wait and complain at the interpreter's end
    assert [client.status for client in made] == ["closed"]


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_the_table_has_a_line_a_fit(folder: Path, tmp_path: Path, kind: str) -> None:
    fits = fit_many(DATA, ["Ward", "Lambertian"], folder, **OPTIONS).fits
    path = tmp_path / f"fits.{kind}"
    write_table(fits, path)
    if kind == "csv":
        rows = list(csv.DictReader(path.read_text("utf-8").splitlines()))
    else:
        rows = pytest.importorskip("pyarrow.parquet").read_table(path).to_pylist()
    assert [row["model"] for row in rows] == ["Ward", "Lambertian"] * 2
    assert float(rows[0]["lobe2_alpha"]) == pytest.approx(0.15, rel=1e-3)
    assert rows[1]["lobe2_alpha"] in ("", None)
    assert float(rows[3]["error cube root"]) > 0


def test_mistakes_are_explained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ParameterError, match="jobs must be at least 1, got 0"):
        fit_many(DATA, ["Ward"], tmp_path, jobs=0)
    (tmp_path / "file").touch()
    with pytest.raises(FileError, match="is a file; give a folder"):
        fit_many(DATA, ["Ward"], tmp_path / "file")
    with pytest.raises(UnknownFormatError, match=r"written as \.csv or \.parquet"):
        write_table([], tmp_path / "x.xlsx")
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'brdf\[cluster\]'"):
        fit_many(DATA, ["Ward"], tmp_path / "fits", scheduler="tcp://localhost:1", **OPTIONS)
