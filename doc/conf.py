# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx settings. The class reference is read from the built plugin; no network is needed."""

import os
import re
import subprocess
import sys
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive

PACKAGE = Path(__file__).resolve().parent.parent / "py"

BUILD = PACKAGE.parent / os.environ.get("FLEXPM_BUILD_DIR", "build")
DOC = Path(__file__).resolve().parent
sys.path[:0] = [str(DOC / "extensions"), str(DOC / "figures"), str(BUILD / "python")]

project = "flexpm"
author = "The flexpm developers"
copyright = author
release = re.search(r'__version__ = "(.*)"', (PACKAGE / "flexpm" / "_version.py").read_text())[1]
extensions = [
    *(
        "availability",
        "gallery",
        "result_schema",
        "rooms",
        "scorecards",
        "test_pages",
        "yade_classes",
    ),
    *("sphinx.ext.autodoc", "sphinx.ext.napoleon", "matplotlib.sphinxext.plot_directive"),
]
# sketches of doc/figures, which a build plots
plot_formats = ["svg"]
plot_html_show_formats = plot_html_show_source_link = False
plot_pre_code = "import setups"
plot_apply_rcparams = True
plot_rcparams = {"savefig.bbox": "tight", "svg.hashsalt": "flexpm"}
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings say more than types
graphviz_output_format = "svg"
# what YADE's docstrings call an attribute that the engine writes
rst_epilog = ".. |yupdate| replace:: (written by the engine)"
exclude_patterns = ["_build"]
html_theme = "alabaster"
html_theme_options = {"page_width": "62em", "body_max_width": "48em", "fixed_sidebar": True}
html_static_path = ["static"]  # custom.css, which the theme looks for
html_show_sourcelink = False
man_pages = [("command", "flexpm", "flexible particle model of rock for YADE", "", 1)]
nitpicky = True
# types of Python and numpy are not in these pages
nitpick_ignore_regex = [("py:(class|exc|obj)", ".*")]


class CommandHelp(Directive):
    """The help texts of the command and of those within it, as they print them."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Run each of the commands, which commas part, and quote its output."""
        return [self._help(command.split()[1:]) for command in self.arguments[0].split(",")]

    @staticmethod
    def _help(command: list[str]) -> nodes.Node:
        text = subprocess.run(
            [sys.executable, "-P", "-m", "flexpm", *command, "--help"],
            env={**os.environ, "PYTHONPATH": str(PACKAGE), "FLEXPM_DEFER": "1", "COLUMNS": "80"},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        return nodes.literal_block(text, text, language="none")


class PresetTable(Directive):
    """The presets as their files stand, one after the other."""

    def run(self) -> list[nodes.Node]:
        """Quote the presets without their licence lines."""
        found = []
        for path in sorted((PACKAGE / "flexpm" / "materials" / "presets").glob("*.toml")):
            text = "\n".join(path.read_text().splitlines()[1:])
            found.append(nodes.literal_block(text, text, language="toml"))
        return found


class LoadingRates(Directive):
    """Rates and limits of all tests, as their descriptions in the package have them."""

    def run(self) -> list[nodes.Node]:
        """Return a table: test and model, rates, limits of the unbalanced-force ratio."""
        from flexpm.kinds.registry import KINDS

        rows = [
            [
                "test, model",
                "k constant",
                "largest k waiting",
                "limit constant",
                "waiting, softening; brittle",
            ]
        ]
        for name, kind in KINDS.items():
            for model, one in kind.rates.items():
                waits = one.running_share is not None
                limits = one.waiting_ratios or ()
                rows.append(
                    [
                        f"{name}, {model}",
                        f"{one.constant:g}",
                        f"{one.waiting_constant:g}" if waits else "",
                        "" if one.quasistatic is None else f"{one.quasistatic:g}",
                        "; ".join(f"{limit:g}" for limit in limits),
                    ]
                )
        group = nodes.tgroup(cols=5)
        group += [nodes.colspec(colwidth=width) for width in (28, 14, 18, 16, 24)]
        head, body = nodes.thead(), nodes.tbody()
        for number, row in enumerate(rows):
            line = nodes.row()
            for text in row:
                line += nodes.entry("", nodes.paragraph("", text))
            (body if number else head).append(line)
        group += [head, body]
        table = nodes.table("", classes=["colwidths-given"])
        table += group
        return [table]


def setup(app: object) -> None:
    """Register the directives of this documentation."""
    app.add_directive("command-help", CommandHelp)
    app.add_directive("presets", PresetTable)
    app.add_directive("loading-rates", LoadingRates)
