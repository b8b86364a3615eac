"""Mechanisms made at random: construction, vector loops and exact differences agree."""

import pytest

from tests.chance.checking import case, checked

SEEN = {
    78: "two closures less than a degree apart, between a chain's dead points",
    112: "two pins so close together that rounding turns a link",
    119: "two links tried at once, with no dyad that closes in two ways",
    122: "a block that keeps a wheel seems to hold the wheel's track, too, where nothing is closed",
    251: "a link that turns far more quickly than the driver: a trial must not be too small",
    302: "a small wheel on a long track, in the 43rd of 44 closures",
    359: "a block that closes with one group and is a guide's way in another",
    684: "so near a singular position that the loops refuse it",
    690: "guides that lead a plate farther than its bars reach",
    695: "kilometres beside radians in one system of equations",
    766: "a wheel driven against a block, whose angles add up to more than half a turn",
    798: "a wheel on a block of a driven crank that has gone more than half round",
    1187: "a sun driven against a block that pins alone turn",
    1263: "a closure close beside the end of where the chain can be drawn",
    1495: "a wheel driven against a link turned half round, but for rounding",
    1856: "an acceleration a hundred million times the driver's",
    2536: "a wheel on a bar driven against a block, whose guides add up to more than half a turn",
}
"""Seeds of a longer run at which a route once erred, and what is special there."""


@pytest.mark.parametrize("seed", [*range(60), *sorted(SEEN.keys() - set(range(60)))])
def test_three_routes_agree(seed):
    made = case(seed)
    if made is None:
        return
    found = checked(made)
    assert found.agrees, (found.loops, found.where_loops, found.exact, found.where_exact)
