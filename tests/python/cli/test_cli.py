# SPDX-License-Identifier: GPL-3.0-or-later
"""The command: exit codes, one line for each error, nothing heavy loaded for wrong input."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from processes import captured

import flexpm
from flexpm.cli import main as cli
from flexpm.materials.keys import ELASTIC_SET, UNITS
from flexpm.report import tables

PACKAGE = str(Path(flexpm.__file__).parent.parent)
# as scripts/flexpm has it
ENVIRONMENT = {
    **os.environ,
    "PYTHONPATH": PACKAGE,
    "OMP_NUM_THREADS": "1",
    "FLEXPM_DEFER": "1",
}
SMALL = ["--width", "0.02", "--height", "0.04", "--thickness", "0.01"]


@pytest.fixture(autouse=True)
def handlers():
    """Give back the signal handlers of the test runner."""
    saved = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield
    for number, handler in saved.items():
        signal.signal(number, handler)


def refused(capsys, *arguments, code=2):
    """Run the command in this process and return its single line on stderr."""
    assert cli.main(arguments) == code
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.startswith("flexpm: ")
    assert errors.count("\n") == 1
    assert errors.endswith("\n")
    return errors


def started(*arguments, **options):
    command = [sys.executable, "-P", *options.pop("interpreter", []), "-m", "flexpm", *arguments]
    pipe = subprocess.PIPE
    return subprocess.Popen(
        command, env=ENVIRONMENT, stdout=pipe, stderr=pipe, text=True, **options
    )


def finished(*arguments, **options):
    process = started(*arguments, **options)
    output, errors = process.communicate(timeout=600)
    return process.returncode, output, errors


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("rnu", "did you mean run"),
        ("specimen triangle", "did you mean rectangle"),
        ("run", "TEST"),
        ("run uniaxal", "did you mean uniaxial"),
        ("run uniaxial more", "unexpected extra argument"),
        ("run uniaxial --widht 0.1", "did you mean --width"),
        ("run uniaxial --width", "requires an argument"),
        ("run uniaxial --width wide", "width = wide m, must be a number"),
        ("run uniaxial --width nan", "width = nan m, must be finite"),
        ("run uniaxial --height 0", "height = 0 m, must be > 0"),
        ("run uniaxial --thickness -0.08", "thickness = -0.08 m, must be > 0"),
        ("run uniaxial --diameters 3e-3", "must be two lengths; write DMIN,DMAX"),
        ("run uniaxial --diameters 4e-3,2e-3", "DMIN must not exceed DMAX"),
        ("run uniaxial --diameters 0,2e-3", "must be > 0"),
        ("run uniaxial --porosity 1", "porosity = 1, must be < 1"),
        ("run uniaxial --porosity -0.1", "porosity = -0.1, must be >= 0"),
        ("run uniaxial --seed -1", "seed = -1, must be >= 0"),
        ("run uniaxial --seed 1.5", "must be a whole number"),
        ("run uniaxial --seeds 3-1", "seeds = 3-1, must have increasing ranges"),
        ("run uniaxial --seeds 1-2 --seed 1", "seed = 1, must not be given with seeds"),
        ("compare uniaxial --seeds 1-2 --seed 3", "seed = 3, must not be given with seeds"),
        ("run uniaxial --workers 2", "workers = 2, needs seeds; give them, or leave it out"),
        ("run uniaxial --confinement -1", "confinement = -1 Pa, must be >= 0"),
        ("run uniaxial --rate 0", "rate = 0, must be > 0"),
        ("run uniaxial --max-strain inf", "max-strain = inf, must be finite"),
        ("run uniaxial --threads 0", "threads = 0, must be >= 1"),
        ("run uniaxial --points 4", "points = '4'"),
        ("run uniaxial --mesh fann", "did you mean fan"),
        ("run uniaxial --model flexibel", "did you mean flexible"),
        ("run uniaxial --material augig-tabel7", "did you mean augig-table7"),
        ("run uniaxial --material missing.toml", "cannot be read"),
        ("run uniaxial --set yuong=1e9", "did you mean young"),
        ("run uniaxial --set tensile_fracture_energy=0.1", "smallest allowed value is"),
        ("run uniaxial --out /proc/flexpm", "must be a folder that can be written to"),
        ("elastic --set poisson=0.5", "poisson = 0.5"),
        ("specimen rectangle --out /dev/null/x", "must be a folder that can be written to"),
        ("run shear --max-strain 1e-9", "max_strain = 1e-09, must not be given for shear"),
        ("run shear --stop-ratio 0.5", "stop_ratio = 0.5, must not be given for shear"),
        ("run uniaxial --length 0.5", "length = 0.5 m, must not be given for uniaxial"),
        ("run scb --length 0.5", "length = 0.5 m, must not be given for scb"),
        ("run bending --width 0.09", "width = 0.09 m, must not be given for bending"),
        ("run sonic --dynamic", "dynamic = True, must not be given for sonic"),
        ("compare shear --max-strain 1e-4", "max_strain = 0.0001, must not be given for shear"),
        ("compare shear --confinements 0,1e6", "give normal_stress, a run for each"),
        ("compare tension --confinements 1e6", "use biaxial"),
        ("bench --steps 0", "steps = 0, must be >= 1"),
        ("doctor --quick", "option = '--quick', unknown"),
    ],
)
def test_wrong_input_is_one_line_and_exit_code_2(capsys, arguments, message):
    assert message in refused(capsys, *arguments.split())


@pytest.mark.parametrize(
    ("model", "change"),
    [
        ("rigid", "young=60e9"),
        ("inner", "plane=strain"),
        ("jcfpm", "shear_fracture_energy=1"),
        ("cohfrict", "softening=brittle"),
    ],
)
def test_a_change_without_effect_is_said_once_and_refuses_nothing(
    capsys, monkeypatch, model, change
):
    monkeypatch.setattr(cli.inputs, "load_yade", lambda: 1 / 0)  # nothing runs
    assert cli.main(["run", "uniaxial", "--model", model, "--set", change, "--quiet"]) == 3
    key = change.partition("=")[0]
    told = f"warning: set {key} has no effect, model {model} does not use it"
    assert capsys.readouterr().out.splitlines().count(told) == 1


def test_a_word_like_no_command_gets_no_guess(capsys):
    assert "did you mean" not in refused(capsys, "nosuch")


@pytest.mark.parametrize("key", [key for key, unit in UNITS.items() if unit is not None])
def test_each_key_of_a_material_out_of_range(capsys, tmp_path, key):
    for value in ("nan", "-1"):
        change = f"{key}={value}"
        line = refused(capsys, "run", "uniaxial", "--set", change, "--out", str(tmp_path))
        assert f"{key} = {value}" in line or f"{key} = {float(value)}" in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments",
    [
        "uniaxial --width 10000 --height 10000",
        "brazilian --diameter 100000",
        "scb --diameter 100000 --notch 10000",
        "bending --length 100000 --height 10000",
        "uniaxial --shape box --width 10 --depth 10 --height 10",
        "triaxial --diameter 10 --height 10",
        "brazilian --diameter 10 --depth 10",
        "scb --diameter 10 --depth 10 --notch 1",
    ],
)
def test_all_shapes_are_asked_for_their_memory_before_they_are_packed(
    capsys, monkeypatch, tmp_path, arguments
):
    monkeypatch.setattr(cli.inputs, "load_yade", lambda: 1 / 0)  # nothing is packed
    out = tmp_path / "out"
    line = refused(capsys, "run", *arguments.split(), "--out", str(out))
    assert "grains = " in line and "GB of memory, must be at most" in line
    assert not out.exists()


def test_discs_that_do_not_fit(capsys, tmp_path):
    folder = str(tmp_path)
    for arguments in (["--width", "0.005"], ["--diameters", "0.05,0.06"]):
        assert "m, must be" in refused(
            capsys, "specimen", "rectangle", "--quiet", "--out", folder, *arguments
        )


@pytest.mark.parametrize("arguments", [["--help"], ["run", "uniaxial", "--set", "young=-1"]])
def test_help_and_wrong_input_load_nothing_heavy(arguments):
    code, _, errors = finished(*arguments, interpreter=["-X", "importtime"])
    assert code == (0 if arguments == ["--help"] else 2)
    loaded = {line.split("|")[-1].strip() for line in errors.splitlines() if "|" in line}
    assert "flexpm.cli.main" in loaded
    assert loaded.isdisjoint({"yade", "numpy", "matplotlib", "scipy", "vtkmodules"})


def test_help_lists_the_commands():
    code, output, errors = finished("--help")
    assert (code, errors) == (0, "")
    for name in ("run", "elastic", "specimen", "bench", "doctor"):
        assert f"\n  {name}" in output


def test_version(capsys):
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out == f"flexpm {flexpm.__version__}\n"


@pytest.mark.parametrize("mesh", [[], ["--mesh", "refined"]])
def test_specimen_writes_its_picture_and_statistics(capsys, tmp_path, mesh):
    folder = tmp_path / "out"
    arguments = ["specimen", "rectangle", *SMALL, *mesh, "--out", str(folder)]
    assert cli.main(arguments) == 0
    found = json.loads((folder / "specimen.json").read_text())
    # N = A (1 - n) / (pi R^2) with the mean radius of 1.5 mm
    assert found["grains"] == round(0.02 * 0.04 * 0.9 / (3.141592653589793 * 1.5e-3**2))
    assert found["cell_area"] == pytest.approx(0.02 * 0.04, rel=1e-12)
    assert sorted(file.name for file in folder.iterdir()) == ["specimen.json", "specimen.png"]
    output, errors = capsys.readouterr()
    assert f"{found['contacts']}" in output
    for figure in ("area of all grains", "contact length, median", "smallest angle, fan"):
        (line,) = (one for one in output.splitlines() if one.strip().startswith(figure))
        assert line.split()[-1] in ("mm", "mm2", "degrees")
    assert errors == ""  # no progress bar: stderr is no terminal


def test_disc_specimen(capsys, tmp_path):
    arguments = ["specimen", "disc", "--diameter", "0.03", "--quiet", "--out", str(tmp_path)]
    assert cli.main(arguments) == 0
    found = json.loads((tmp_path / "specimen.json").read_text())
    assert found["grains"] == round(0.9 * (0.015 / 1.5e-3) ** 2)


#: The command; it signals itself when its packing reports progress for the second time.
SIGNALLED = """
import os, sys
from flexpm.cli import terminal
number, told = int(sys.argv.pop(1)), []

def tell(progress, done, expected, text=""):
    told.extend([done] if text == "packing" else [])
    if len(told) == 2:
        os.kill(os.getpid(), number)

terminal.Progress.__call__ = tell
import flexpm.__main__  # does the command
"""


@pytest.mark.long
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_signals_end_the_command_with_one_line(tmp_path, number, code):
    command = [sys.executable, "-P", "-c", SIGNALLED, str(int(number)), "specimen", "rectangle"]
    done = captured([*command, "--out", str(tmp_path)], env=ENVIRONMENT, timeout=600)
    assert (done.returncode, done.stdout) == (code, "")
    assert done.stderr.startswith("flexpm: ")
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_doctor_finds_this_installation_sound():
    code, output, errors = finished("doctor")
    assert (code, errors) == (0, "")
    assert all(line.startswith("ok ") for line in output.splitlines())
    assert len(output.splitlines()) > 3


def test_numbers_in_tables():
    assert tables.scaled(24.31234e9, 1e-9, "GPa") == "24.31 GPa"
    assert tables.scaled(100e6, 1e-6, "MPa") == "100.0 MPa"
    assert tables.scaled(1e-5, 1.0, "", 2) == "1.0e-05"
    assert tables.scaled(1234567.0, 1.0, "") == "1.235e+06"
    assert tables.scaled(None, 1.0, "Pa") == "-"
    assert tables.scaled(0.0, 1.0, "Pa") == "0.000 Pa"


def test_models_of_the_command_are_those_of_the_materials(capsys):
    assert ", ".join(ELASTIC_SET) in refused(capsys, "elastic", "--model", "none")


def test_a_size_beside_a_specimen_is_refused(capsys):
    told = refused(capsys, "run", "bending", "--specimen", "beam.json", "--length", "0.1")
    assert "length = 0.1, must not be given with specimen" in told


def test_the_help_tells_how_far_apart_frames_are(capsys):
    assert cli.main(["run", "--help"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "up to the strain of the reference strength" in told
    assert "fewer if the test ends before or has fewer rows" in told


def test_a_comparison_gives_each_model_the_keys_that_it_uses(capsys, tmp_path):
    compare = [
        "compare",
        "uniaxial",
        "--width",
        "0.01",
        "--height",
        "0.012",
        "--max-strain",
        "1e-5",
    ]
    compare += ["--rate", "50", "--quiet", "--no-report", "--set", "young=6e10"]
    assert cli.main([*compare, "--out", str(tmp_path)]) == 3  # no peak within the strain
    found = {
        model: json.loads((tmp_path / model / "result.json").read_text())["material"]
        for model in ("flexible", "rigid")
    }
    assert (found["flexible"]["young"], found["rigid"]["young"]) == (6e10, None)
    assert "has no effect" not in capsys.readouterr().out
    idle = [*compare, "--models", "rigid,jcfpm", "--out", str(tmp_path / "idle")]
    assert cli.main(idle) == 3
    told = "warning: set young has no effect, none of rigid, jcfpm uses it"
    assert capsys.readouterr().out.splitlines().count(told) == 1


@pytest.mark.long
def test_packings_give_each_model_the_keys_that_it_uses(tmp_path):
    compare = ["compare", "uniaxial", "--width", "0.01", "--height", "0.012", "--rate", "50"]
    compare += ["--quiet", "--no-report", "--set", "young=6e10", "--seeds", "1", "--workers", "1"]
    cli.main([*compare, "--out", str(tmp_path)])
    for model in ("flexible", "rigid"):
        assert (tmp_path / model / "seed-1" / "result.json").is_file(), model
