# SPDX-License-Identifier: GPL-3.0-or-later
"""Fracture networks: how many traces, how long, at which angle; and what cannot be drawn.

Lengths and angles are those of the traces before they are clipped, which makes them shorter.
"""

import math

import numpy as np
import pytest
from refusals import refusal
from scipy import integrate, special, stats

from flexpm.errors import InputError
from flexpm.joints.network import Network
from flexpm.joints.window import Window

SEEDS = range(1, 201)
BOX = Window((0.0, 0.0), (0.05, 0.1))
DISC = Window.circle(0.01, 0.02, 0.04)
CONSTANT = {"law": "constant", "value": 0.012}
LOGNORMAL = {
    "law": "lognormal",
    "mean": 0.01,
    "deviation": 0.006,
    "smallest": 4e-3,
    "largest": 0.02,
}
POWER = {"law": "power", "exponent": 2.4, "smallest": 4e-3, "largest": 0.04}
LEVEL = {"law": "constant", "angle": 30.0}
MISES = {"law": "von-mises", "angle": 60.0, "concentration": 3.0}
FISHER = {
    "law": "fisher",
    "dip": 50.0,
    "dip_direction": 30.0,
    "concentration": 6.0,
    "weight": "sine",
}
#: Chance of a test to fail though the law is right, with other seeds.
CHANCE = 0.01


def network(length=CONSTANT, orientation=LEVEL, intensity=300.0, **more):
    one = {"intensity": intensity, "length": length, "orientation": orientation}
    return Network.of({"set": {"a": one}, **more})


def drawn(one, seeds, window=BOX):
    """Traces of all seeds together, before they are clipped: lengths [m], angles [degree]."""
    ends = np.concatenate([one.with_seed(seed).traces(window)["a"] for seed in seeds])
    way = ends[:, 1] - ends[:, 0]
    return np.hypot(*way.T), np.degrees(np.arctan2(way[:, 1], way[:, 0]))


def length_of(lines):
    return math.fsum(math.dist(*line) for line in lines)


@pytest.mark.parametrize("window", [BOX, DISC], ids=["box", "disc"])
@pytest.mark.parametrize(
    ("length", "orientation"),
    [(CONSTANT, LEVEL), (LOGNORMAL, MISES), (POWER, FISHER)],
    ids=["constant", "lognormal", "power"],
)
def test_the_mean_intensity_is_that_asked_for(window, length, orientation):
    one = network(length, orientation, 1000.0)
    found = [length_of(one.with_seed(seed).lines(window)["a"]) / window.area for seed in SEEDS]
    assert np.mean(found) == pytest.approx(1000.0, rel=0.02)
    assert stats.sem(found) < 6.0  # so that two percent are more than three errors


def test_counts_are_those_of_poisson():
    """A count has the variance of its mean; places are uniform, also beyond the specimen."""
    one = network(intensity=1000.0)
    ends = [one.with_seed(seed).traces(BOX)["a"] for seed in SEEDS]
    counts = [len(each) for each in ends]
    expected = 1000.0 / 0.012 * 0.062 * 0.112
    assert np.mean(counts) == pytest.approx(expected, abs=3.0 * math.sqrt(expected / 200))
    spread = stats.chi2(199).cdf(199 * np.var(counts, ddof=1) / expected)
    assert CHANCE < spread < 1.0 - CHANCE
    places = np.concatenate(ends).mean(axis=1)
    for axis, size in enumerate((0.05, 0.1)):
        law = stats.uniform(-0.006, size + 0.012)
        assert stats.kstest(places[:, axis], law.cdf).pvalue > CHANCE


def truncated(law, low, high):
    """Distribution function of a law between cut-offs."""
    return lambda x: (law.cdf(x) - law.cdf(low)) / (law.cdf(high) - law.cdf(low))


def test_lengths_follow_their_law():
    found, _ = drawn(network(LOGNORMAL), SEEDS)
    spread = math.sqrt(math.log1p(0.6**2))
    law = stats.lognorm(spread, scale=0.01 * math.exp(-0.5 * spread**2))
    assert law.stats() == pytest.approx((0.01, 0.006**2))
    assert stats.kstest(found, truncated(law, 4e-3, 0.02)).pvalue > CHANCE
    assert found.min() >= 4e-3 * (1.0 - 1e-9)
    found, _ = drawn(network(POWER), SEEDS)
    law = stats.pareto(1.4, scale=4e-3)  # its density falls with the power 2.4
    assert stats.kstest(found, truncated(law, 4e-3, 0.04)).pvalue > CHANCE
    found, _ = drawn(network(CONSTANT), range(1, 3))
    np.testing.assert_allclose(found, 0.012, rtol=1e-12)


@pytest.mark.parametrize("table", [LOGNORMAL, POWER, {**POWER, "exponent": 3.0}])
def test_the_mean_length_is_that_between_the_cut_offs(table):
    """The number of traces rests on it: the integral of the law, and the mean of what is drawn."""
    one = network(table)
    found, _ = drawn(one, SEEDS)
    low, high = table["smallest"], table["largest"]
    if table["law"] == "power":
        law = stats.pareto(table["exponent"] - 1.0, scale=low)
    else:
        spread = math.sqrt(math.log1p((table["deviation"] / table["mean"]) ** 2))
        law = stats.lognorm(spread, scale=table["mean"] * math.exp(-0.5 * spread**2))
    whole = law.expect(lb=low, ub=high, conditional=True)
    assert one.sets["a"].length.expected == pytest.approx(whole, rel=1e-6)
    assert abs(found.mean() - whole) < 3.0 * stats.sem(found)


def turned(angles, by):
    """Angles of lines from a mean, from -90 to 90 degrees."""
    return np.mod(angles - by + 90.0, 180.0) - 90.0


@pytest.mark.parametrize("concentration", [0.5, 3.0, 200.0])
def test_angles_of_von_mises(concentration):
    table = {**MISES, "concentration": concentration}
    _, found = drawn(network(orientation=table), SEEDS)
    law = stats.vonmises(concentration)

    def share(angle):
        """Both senses of a trace, from -90 degrees on."""
        x, quarter = np.radians(angle), np.pi / 2
        other = law.cdf(x + np.pi) - law.cdf(quarter)
        return law.cdf(x) - law.cdf(-quarter) + other

    assert stats.kstest(turned(found, 60.0), share).pvalue > CHANCE


def sums(one, start):
    """Distribution function of angles from a start on, from the density of a law."""
    angles = np.linspace(start, start + 180.0, 721)
    heights = one.sets["a"].orientation.density(angles)
    rows = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(angles) * (heights[1:] + heights[:-1]))])
    assert rows[-1] == pytest.approx(1.0, abs=1e-4)
    return lambda angle: np.interp(angle, angles, rows)


@pytest.mark.parametrize("weight", ["sine", "none"])
@pytest.mark.parametrize(
    ("dip", "direction", "concentration"),
    [(50.0, 30.0, 6.0), (80.0, 250.0, 20.0), (90.0, 90.0, 2.0), (20.0, 0.0, 100.0)],
)
def test_angles_of_fisher_cut_by_the_plane(dip, direction, concentration, weight):
    """Drawn in space and cut, against the density that is summed over the poles of a trace."""
    table = {**FISHER, "dip": dip, "dip_direction": direction, "concentration": concentration}
    one = network(orientation={**table, "weight": weight})
    _, found = drawn(one, SEEDS)
    assert stats.kstest(np.mod(found, 180.0), sums(one, 0.0)).pvalue > CHANCE


def test_the_density_of_weighted_fisher_angles_is_that_of_bessel():
    """With the sine as weight the sum over the poles of a trace is one of Bessel functions."""
    angles = np.linspace(-90.0, 90.0, 91)
    for dip, direction, strength in ((50.0, 30.0, 6.0), (85.0, 200.0, 40.0), (0.0, 0.0, 1.0)):
        table = {**FISHER, "dip": dip, "dip_direction": direction, "concentration": strength}
        law = network(orientation=table).sets["a"].orientation
        tilt, turn, trace = np.radians(dip), np.radians(direction), np.radians(angles)
        x, y, z = math.sin(tilt) * math.cos(turn), math.cos(tilt), math.sin(tilt) * math.sin(turn)
        across = y * np.cos(trace) - x * np.sin(trace)
        size = np.hypot(across, z)
        double = (z * z - across * across) / size**2
        crowd = special.ive(0, strength * size) - double * special.ive(2, strength * size)
        crowd *= np.exp(strength * (size - size.max()))
        expected = crowd / integrate.trapezoid(crowd, angles)
        np.testing.assert_allclose(law.density(angles), expected, rtol=1e-4)


def test_dips_of_the_mean_plane():
    """Towards the right a trace falls to the right; out of the section it is level."""
    for direction, expected in ((0.0, -40.0), (180.0, 40.0), (90.0, 0.0)):
        table = {**FISHER, "dip": 40.0, "dip_direction": direction, "concentration": 1e4}
        _, found = drawn(network(orientation=table, intensity=100.0), [1])
        assert found.mean() == pytest.approx(expected, abs=0.3)
        assert np.abs(found - expected).max() < 4.0


def test_the_same_seed_draws_the_same_bits():
    sets = {
        name: {"intensity": 300.0, "length": length, "orientation": orientation}
        for name, length, orientation in [("a", LOGNORMAL, MISES), ("b", POWER, FISHER)]
    }
    both = Network.of({"seed": 7, "set": sets})
    lines = both.lines(BOX)
    assert lines == Network.of(both.to_json()).lines(BOX)
    assert lines != both.with_seed(8).lines(BOX)
    assert lines["a"] != lines["b"]
    alone = Network.of({"seed": 7, "set": {"b": sets["b"]}})  # a set does not move the others
    assert alone.lines(BOX)["b"] == lines["b"]
    first = network(CONSTANT, LEVEL, 100.0, seed=1).traces(BOX)["a"][0]
    drawn = [
        [-0.0047844960003713966, 0.05269168459963111],
        [0.005607808845041867, 0.058691684599631117],
    ]  # by the first version; other versions of numpy and scipy round the last digit otherwise
    np.testing.assert_allclose(first, drawn, rtol=1e-12)


def test_traces_are_clipped_to_the_window():
    """Each piece lies on its trace and within; what lies inside is untouched to the bit."""
    for window in (BOX, DISC):
        ends = network(POWER, MISES).traces(window)["a"]
        kept = window.clipped(ends)
        assert np.all((kept >= window.low) & (kept <= window.high))
        inside = np.all((ends >= window.low) & (ends <= window.high), axis=(1, 2))
        if window.round:
            off = np.hypot(*np.moveaxis(ends - (0.01, 0.02), -1, 0))
            inside = np.all(off < 0.04, axis=1)
            assert np.hypot(*np.moveaxis(kept - (0.01, 0.02), -1, 0)).max() < 0.04 * (1 + 1e-9)
        whole = {one.tobytes() for one in kept}
        assert all(one.tobytes() in whole for one in ends[inside])
        # many points on the traces say the same length
        shares = (np.arange(2000) + 0.5) / 2000
        way = ends[:, 1] - ends[:, 0]
        points = ends[:, None, 0] + shares[:, None] * way[:, None]
        if window.round:
            within = np.hypot(*np.moveaxis(points - (0.01, 0.02), -1, 0)) < 0.04
        else:
            within = np.all((points > window.low) & (points < window.high), axis=-1)
        expected = np.sum(within.mean(axis=1) * np.hypot(*way.T))
        assert length_of(kept.tolist()) == pytest.approx(expected, rel=1e-4)
    along = np.array([[[-1.0, 0.0], [1.0, 0.0]], [[-1.0, -1e-6], [1.0, -1e-6]], [[0.02, -1.0]] * 2])
    along[2, 1] = 0.02, 1.0
    np.testing.assert_array_equal(
        BOX.clipped(along), [[[0.0, 0.0], [0.05, 0.0]], [[0.02, 0.0], [0.02, 0.1]]]
    )


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"intensity": 0.0}, "set a: intensity = 0.0 1/m, must be > 0"),
        ({"intensity": math.nan}, "intensity = nan 1/m, must be finite"),
        ({"intensity": 1e6}, "traces expected = 5.787e.05 in a window .*, must be <= 20000"),
        ({"intensity": 1e9}, "traces expected = .*, must be <= 20000"),
        ({"length": {**POWER, "exponent": 2.0}}, "exponent = 2, must be > 2: .* a mean only"),
        ({"length": {**POWER, "exponent": math.inf}}, "exponent = inf, must be finite"),
        ({"length": {**POWER, "largest": 4e-3}}, "smallest = 0.004 m, must be < largest"),
        ({"length": {**LOGNORMAL, "largest": 1e-3}}, "smallest = 0.004 m, must be < largest"),
        ({"length": {**LOGNORMAL, "mean": 1e3}}, "share between the cut-offs = .*, must be >="),
        ({"length": {**LOGNORMAL, "mean": -1.0}}, "length mean = -1.0 m, must be > 0"),
        ({"length": {**CONSTANT, "value": True}}, "length value = True m, must be a number"),
        ({"length": {"law": "power"}}, "length exponent is missing; give exponent, smallest"),
        ({"length": {**CONSTANT, "men": 1.0}}, "length key = 'men', unknown"),
        ({"length": {"law": "normal"}}, "length law = 'normal', must be one of constant"),
        ({"length": 0.01}, "length = 0.01, must be a table"),
        ({"orientation": {"law": []}}, r"orientation law = \[\], must be one of constant"),
        ({"orientation": {**LEVEL, "angle": math.inf}}, "angle = inf degree, must be finite"),
        ({"orientation": {**MISES, "concentration": 0.0}}, "concentration = 0.0, must be >="),
        ({"orientation": {**FISHER, "weight": "cosine"}}, "weight = 'cosine', must be one of sine"),
        ({"orientation": {**FISHER, "dip": 91.0}}, "dip = 91.0 degree, must be <= 90"),
        ({"spacing": 1.0}, "set a: key = 'spacing', unknown"),
    ],
)
def test_what_cannot_be_drawn(changes, message):
    one = {"intensity": 1000.0, "length": CONSTANT, "orientation": LEVEL, **changes}
    refusal(message, lambda: Network.of({"set": {"a": one}}).lines(BOX))


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({}, r"set = {}, must have a table \[set.NAME\]"),
        ([], "network = .*, must be a table"),
        ({"set": {"a b": {}}}, "network set = 'a b', must be a name without spaces"),
        ({"set": {"a": {"intensity": 1.0}}}, "set a: length is missing"),
        ({"sets": {}}, "key = 'sets', unknown .did you mean set"),
        ({"seed": -1, "set": {"a": {}}}, "set a: intensity is missing"),
    ],
)
def test_what_is_no_network(table, message):
    refusal(message, Network.of, table)


def test_a_network_without_a_trace_is_told():
    with pytest.raises(InputError, match=r"traces in the specimen = 0 \(seed 1\), must be >= 1"):
        network(intensity=1e-3).lines(BOX)
    refusal("network seed = -1, must be >= 0", network, seed=-1)
