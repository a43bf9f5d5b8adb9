# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 4 of the paper: hours for a million steps of each model, one thread."""

import json

import pandas
from common import options

from flexpm.bench import timing as bench

MODELS = ("rigid", "refined", "inner", "inner-un")

chosen = options(__doc__)
folder = chosen.out / "table4"
folder.mkdir(parents=True, exist_ok=True)
timing = folder / "bench.json"
if not chosen.dry:
    bench.run(bench.Plan(), timing)
found = json.loads(timing.read_text(encoding="utf-8"))
tests = {"uniaxial": found["models"], "brazilian": found["brazilian"]["models"]}
hours = pandas.DataFrame(
    {
        test: {name: models[name]["step_time"] * 1e6 / 3600.0 for name in MODELS if name in models}
        for test, models in tests.items()
    }
)
hours.to_csv(chosen.out / "table4.csv", index_label="model")
print(hours.round(3))
