# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of users are text in pictures and on the terminal, whatever they hold."""

from __future__ import annotations

import warnings

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import cbook
from matplotlib.image import imread

from flexpm.report.style import drawing
from flexpm.text import LONGEST, label_of, name_of, printable, words_of


@given(st.text())
def test_a_name_is_one_short_line_without_control_characters(text):
    name = name_of(text)
    assert len(name) <= LONGEST
    assert len(name.splitlines()) <= 1
    assert not {"\x1b", "\x07", "\u202e", "\x9b"} & set(name)
    assert "\x1b" not in printable(text)


@given(st.text("$\\x^_{ \n"))
def test_a_label_is_never_a_formula(text):
    label = label_of(text)
    assert not cbook.is_math_text(label)
    assert label.replace(r"\$", "$") == name_of(text)


@pytest.mark.parametrize(
    "name", [r"$\foo$", "$a^$", "a$b", "x" * 5000, "漢字", "\x1b[31mred", "\\$\\$"]
)
def test_any_name_can_be_drawn(tmp_path, name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with drawing(tmp_path / "it.png") as axes:
            axes.plot([0, 1], [0, 1], label=label_of(name))
            axes.set_title(label_of(name))
            axes.legend()
    assert imread(tmp_path / "it.png").shape[0] > 300


def test_quantities_are_called_as_people_call_them():
    assert words_of("youngs_modulus") == "Young's modulus"
    assert words_of("poissons_ratio") == "Poisson's ratio"
    assert words_of("peak_stress") == "peak stress"
