# SPDX-License-Identifier: GPL-3.0-or-later
"""Picture of six 3D tests for the gallery of the manual: outside and section of each.

Runs each test by the command `flexpm`, and puts the pictures `outside.png` of its folders together.
Tests whose folder is there are not run again.

    PYTHONPATH=build/python /usr/bin/python3 scripts/studies/solid_gallery.py FOLDER [PICTURE]
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

#: Options of `flexpm run`, by the name of the folder.
TESTS = {
    "tension": "tension --shape box --width 0.012 --depth 0.012 --height 0.024 --model rigid",
    "triaxial": "triaxial --shape cylinder --diameter 0.015 --height 0.03 --confinement 4e6",
    "brazilian": "brazilian --diameter 0.03 --depth 0.015",
    "scb": "scb --diameter 0.03 --depth 0.01",
    "bending": "bending --length 0.06 --height 0.012 --depth 0.012 --notch 0.004",
    "punch": "punch --width 0.036 --depth 0.008 --height 0.02 --notch 0.003 --confinement 2e6 "
    "--model rigid",
}
COLUMNS, WIDTH, COLOURS = 2, 1200, 128


def main() -> None:
    """Run what is missing, and make the picture."""
    from PIL import Image

    folder = Path(sys.argv[1])
    picture = Path(sys.argv[2] if len(sys.argv) > 2 else folder / "solid_tests.png")
    shown = []
    for name, options in TESTS.items():
        out = folder / name
        if not (out / "outside.png").is_file():
            command = [sys.executable, "-P", "-m", "flexpm", "run", *options.split(), "--quiet"]
            subprocess.run([*command, "--out", str(out)], check=False)  # no peak: code 3
        with Image.open(out / "outside.png") as image:
            image.thumbnail((WIDTH // COLUMNS, WIDTH // COLUMNS))
            shown.append(image.convert("RGB"))
    cell = max(image.width for image in shown), max(image.height for image in shown)
    rows = -(-len(shown) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * cell[0], rows * cell[1]), "white")
    for number, image in enumerate(shown):
        row, column = divmod(number, COLUMNS)
        sheet.paste(image, (column * cell[0], row * cell[1]))
    sheet.quantize(COLOURS, kmeans=3).save(picture, optimize=True)


if __name__ == "__main__":
    main()
