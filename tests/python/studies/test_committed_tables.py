# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of runs in the repository: the key of each row follows from its inputs."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path

import pandas
import pytest

from flexpm.runs.input_names import OPTIONS
from flexpm.runs.loading_rate import quasistatic_ratio
from flexpm.studies import jobs, study

SCRIPTS = Path(__file__).parents[3] / "scripts"
TABLES = [
    path
    for path in sorted([*SCRIPTS.glob("paper/results/*.csv"), *SCRIPTS.glob("studies/*.csv")])
    if path.read_text().startswith("key,")
]


def study_of(path: Path) -> Path:
    """The study file of a table; that of readings has none, as its script makes the runs."""
    folder = SCRIPTS / "paper" if path.parent.name == "results" else path.parent
    return folder / f"{path.stem}.toml"


STUDIES = [path for path in TABLES if study_of(path).exists()]


def inputs_of(rows: pandas.DataFrame) -> list[dict]:
    """What each row's run was asked for: the cells that are not empty."""
    names = ["test", "material", *OPTIONS, *(name for name in rows if name.startswith("set."))]
    present = rows[[name for name in names if name in rows]].astype(object)
    return [row.dropna().to_dict() for _, row in present.iterrows()]


def test_the_tables_of_all_studies_are_there():
    assert len(STUDIES) == 10
    assert [path.stem for path in TABLES if path not in STUDIES] == ["readings"]


@pytest.mark.parametrize("path", TABLES, ids=lambda path: path.stem)
def test_each_rows_key_follows_from_its_inputs(path):
    rows = pandas.read_csv(path)
    assert rows["key"].is_unique
    for key, inputs in zip(rows["key"], inputs_of(rows), strict=True):
        job = jobs.make(inputs, path.parent)
        assert key in (job.key, *job.spec.older_keys())


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_a_study_finds_all_its_runs_in_its_table(path):
    wanted = study.read(study_of(path)).jobs
    found = set(pandas.read_csv(path)["key"])
    waiting = [job for job in wanted if job.key not in found]
    # results of an older number are run again, and said so
    assert bool(waiting) == bool(jobs.outdated(waiting, found.__contains__))
    assert len(found) == len(wanted)


def test_the_table_of_trends_has_all_its_runs_under_keys_of_old_or_new_results():
    spec = importlib.util.spec_from_file_location("trends", SCRIPTS / "studies" / "trends.py")
    trends = sys.modules["trends"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(trends)
    rows = trends.read(SCRIPTS / "studies" / "trends.csv")
    assert list(rows) == list(trends.plan())
    for arguments, row in rows.items():
        run = trends.spec_of(*arguments)
        assert row[-1] in (run.key(), *run.older_keys())


def test_halving_the_rates_of_solids_moves_no_mean_peak_by_three_per_cent():
    rows = pandas.read_csv(SCRIPTS / "studies" / "solid_rates.csv")
    sets = rows.groupby(["test", "shape", "model", "material"])
    assert len(sets) == 12
    for (test, _, model, material), runs in sets:
        assert (runs.groupby("rate").seed.nunique() == 5).all()
        peaks = runs.groupby("rate").peak_stress.mean()
        for rate in peaks.index[peaks.index <= 1.0]:
            assert abs(peaks[rate] / peaks[2.0 * rate] - 1.0) < 0.03
        in_use = runs[runs.rate == 1.0]
        assert in_use.youngs_modulus.notna().all()
        brittle = material.endswith("brittle")
        limit = quasistatic_ratio(test, model, waiting=True, brittle=brittle, solid=True)
        assert in_use.under_way.max() < limit


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_the_law_whose_runs_are_in_present_opening_can_still_be_made_from_that_in_use():
    patch = SCRIPTS / "paper" / "present_opening.patch"
    fits = ["git", "apply", "--check", patch]
    told = subprocess.run(fits, cwd=SCRIPTS.parent, capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stderr
