"""The lab: experiments, a material, errors, Ctrl-C."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from specula_render import lab
from specula_render.lab.process import call
from specula_render.lab import process

QUICK = "tokuyoshi24-fig5"
COLUMNS = [
    "alpha",
    "theta_i [deg]",
    "single scattering [1/sr]",
    "Turquin [1/sr]",
    "Kulla-Conty [1/sr]",
    "cap pdf [1/sr]",
    "bounded pdf [1/sr]",
    "exact pdf [1/sr]",
]


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> lab.Result:
    return lab.run(QUICK, output=tmp_path_factory.mktemp("lab"), seed=7, progress=False)


def test_experiments_have_names_papers_and_figures() -> None:
    found = {experiment.name: experiment for experiment in lab.experiments()}
    assert len(found) >= 30
    assert found[QUICK].figure == "fig. 5"
    assert found[QUICK].paper == "Tokuyoshi and Eto 2024"
    assert found[QUICK].title == "lobes and densities over the angle of reflection"
    assert all(e.title and e.statement and e.figure for e in found.values())


def test_a_result_has_its_verdict_and_claims(quick: lab.Result) -> None:
    assert (quick.name, quick.verdict, quick.seed) == (QUICK, "reproduced", 7)
    assert quick.summary.startswith("Largest weight")
    assert [claim.holds for claim in quick.claims] == ["yes"] * 4
    assert QUICK in str(quick)


def test_a_table_has_its_columns_as_arrays(quick: lab.Result) -> None:
    (table,) = quick.tables.values()
    assert (table.name, list(table)) == ("lobes", COLUMNS)
    assert table.rows == 543
    assert all(v.dtype == np.float64 and np.isfinite(v).all() for v in table.values())
    assert set(table["alpha"]) == {0.4, 0.7, 1.0}
    # What the experiment claims: the cap's density can be below the compensated lobe.
    cap, turquin = table["cap pdf [1/sr]"], table["Turquin [1/sr]"]
    assert 3.0 < np.max(turquin / cap) < 3.5
    assert (table["bounded pdf [1/sr]"] >= cap).all()
    with pytest.raises(KeyError, match="no column 'albedo'"):
        table["albedo"]


def test_a_table_reads_well(quick: lab.Result) -> None:
    lines = repr(quick.tables["lobes"]).splitlines()
    assert lines[0].endswith("[543 rows]")
    assert len(lines) == 3 + 11
    assert len({len(line) for line in lines[1:]}) == 1
    assert quick.tables["lobes"]._repr_html_().count("<tr>") == 1 + 11


def test_words_and_gaps_in_a_table() -> None:
    table = lab.Table.of_rows("t", "c", ["word", "number"], [["<a>", 1.0], [None, None]])
    assert table["word"].tolist() == ["<a>", ""]
    assert np.isnan(table["number"][1])
    assert "&lt;a&gt;" in table._repr_html_()
    assert lab.Table.of_rows("t", "c", ["word"], []).rows == 0
    with pytest.raises(ValueError, match="columns of one length"):
        lab.Table("t", "c", {"a": [1.0], "b": [1.0, 2.0]})


def test_a_table_becomes_a_data_frame(quick: lab.Result) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = quick.tables["lobes"].to_pandas()
    assert list(frame.columns) == COLUMNS
    assert len(frame) == 543


def test_without_pandas_the_error_says_what_to_install(
    quick: lab.Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pip install pandas"):
        quick.tables["lobes"].to_pandas()


def test_figures_are_paths_that_jupyter_shows(quick: lab.Result) -> None:
    figure = quick.figures["lobes"]
    assert Path(figure) == quick.folder / "lobes.png"
    assert Path(figure).read_bytes() == figure._repr_png_()
    assert figure._repr_png_().startswith(b"\x89PNG")
    assert figure.svg is not None
    assert "<svg" in figure.svg.read_text(encoding="utf-8")
    shown = quick._repr_html_()
    assert "data:image/png;base64," in shown
    assert "reproduced" in shown


def test_a_folder_can_be_read_again(quick: lab.Result) -> None:
    again = lab.Result.read(quick.folder)
    assert again.claims == quick.claims
    np.testing.assert_array_equal(again.tables["lobes"]["alpha"], quick.tables["lobes"]["alpha"])
    assert (quick.folder.parent / "report.html").is_file()


def test_a_material_is_measured() -> None:
    result = lab.material("conductor Au alpha 0.5", threads=1, progress=False)
    assert result.verdict == "holds"
    assert {"albedo", "samplers", "chi-square"} <= result.tables.keys()
    samplers = result.tables["samplers"]
    assert np.isfinite(samplers["variance of the weight"]).all()
    assert (samplers["rejected [%]"][samplers["sampler"] == "exact"] == 0.0).all()
    assert {"lobes", "albedo", "densities"} <= result.figures.keys()


def test_a_measured_material_is_fitted(tmp_path: Path) -> None:
    file = tmp_path / "gold.bsdf"
    command = ["tabulate", "conductor Au alpha 0.3", "--views", "8", "--colours", "12"]
    call([*command, "-o", str(file)], progress=False)
    result = lab.fit(file, distributions=["ggx"], bounces=["single"], threads=1, progress=False)
    fits = result.tables["fits"]
    assert len(fits["alpha x"]) == 1
    assert fits["alpha x"][0] == pytest.approx(0.3, rel=0.02)
    texts = result.tables["text"]
    assert "pbrt-v4" in texts["for"]
    # The text is a lobe of the library.
    assert "conductor_eta" in fits["lobe"][0]
    with pytest.raises(ValueError, match="tensor_file"):
        lab.fit(__file__, output=tmp_path / "none", progress=False)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("tokuyoshi24-fig55", "no experiment is called .*nearest: tokuyoshi24-fig5"),
        ("--help", "no experiment is called '--help'"),
        ("eto23-*", "one experiment expected"),
        ("", "one experiment expected"),
    ],
)
def test_an_unknown_name_is_an_error_that_names_near_ones(name: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        lab.run(name, progress=False)


def test_wrong_arguments_are_told_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"no metal 'Zz' \(there are Ag, Al") as found:
        lab.material("conductor Zz", output=tmp_path)
    assert "│" not in str(found.value)
    with pytest.raises(ValueError, match=r"none\.pbrt cannot be read"):
        lab.compare(tmp_path / "none.pbrt", output=tmp_path)
    with pytest.raises(ValueError, match="a width and a height"):
        lab.compare(resolution=(0, 1), output=tmp_path)
    with pytest.raises(ValueError, match="a folder expected"):
        lab.material("diffuse 1 1 1", output=tmp_path / "page.html")
    assert not list(tmp_path.iterdir())


def test_a_failure_is_a_runtime_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    with pytest.raises(RuntimeError, match="cannot make the folder"):
        lab.run(QUICK, output=tmp_path / "file" / "lab", progress=False)


def test_options_reach_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[list[str]] = []

    def record(arguments: list[str], *, progress: bool) -> str:
        calls.append(arguments)
        raise RuntimeError

    monkeypatch.setattr("specula_render.lab.commands.call", record)
    with pytest.raises(RuntimeError):
        lab.compare(
            "a.xml",
            samplers=("cap", "exact"),
            energy=("none", "turquin"),
            time="2m",
            resolution=(64, 32),
            crop=(0, 8, 0, 4),
            exposure=-1.0,
            values={"alpha": 0.3},
            threads=-1,
            output="lab",
        )
    text = " ".join(calls[0])
    for part in (
        "compare --samplers cap,exact --energy none,turquin --time 2m --exposure=-1.0",
        "--resolution 64x32 --crop 0,8,0,4 -D alpha=0.3 --seed=1 --threads=-1 -o lab -- a.xml",
    ):
        assert part in text


@pytest.mark.skipif(sys.platform == "win32", reason="sends a POSIX signal to one thread")
def test_ctrl_c_ends_the_process_and_then_raises(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[subprocess.Popen[str]] = []
    start = process._start

    def recorded(*arguments: Any) -> subprocess.Popen[str]:
        started.append(start(*arguments))
        return started[0]

    monkeypatch.setattr(process, "_start", recorded)
    main = threading.main_thread().ident
    assert main is not None
    timer = threading.Timer(2.0, signal.pthread_kill, (main, signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        lab.run("tokuyoshi24-fig4", quality="paper", threads=1, output=tmp_path, progress=False)
    timer.join()
    assert started[0].poll() is not None
    assert not (tmp_path / "tokuyoshi24-fig4" / "result.json").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="the script stands in for a process by a shell")
def test_progress_is_shown_and_errors_are_not(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    script = "echo ' 50 %  cap' >&2; echo 'warning: dim' >&2; echo '  × it broke' >&2; exit 1"

    def fake(arguments: Any, output: Any) -> subprocess.Popen[str]:
        return subprocess.Popen(
            ["sh", "-c", script], stdout=output, stderr=subprocess.PIPE, encoding="utf-8"
        )

    monkeypatch.setattr(process, "_start", fake)
    with pytest.raises(RuntimeError, match="^it broke$"):
        process.call([], progress=True)
    shown = capsys.readouterr().err
    assert "\r 50 %  cap" in shown
    assert "warning: dim\n" in shown
    assert "broke" not in shown
    with pytest.raises(RuntimeError):
        process.call([], progress=False)
    assert capsys.readouterr().err == ""
