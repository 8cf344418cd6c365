"""Why a relationship has no target, by the opinions of several layers."""

from __future__ import annotations

from typing import Any

import pytest
from pxr import Sdf, Usd

from usdvol_lint.facts.volumes.emptiness import Reason, why_empty
from usdvol_lint.facts.volumes.states import Emptiness

BARE = "rel field:density"
BLOCK = "rel field:density = None"
NAMED = "rel field:density = </outside/density>"
OTHER = "add rel field:density = </elsewhere/density>"
DELETE = "delete rel field:density = </outside/density>"


def layer(text: str) -> Sdf.Layer:
    made = Sdf.Layer.CreateAnonymous(".usda")
    assert made.ImportFromString(f"#usda 1.0\n{text}\n")
    return made


@pytest.mark.parametrize(
    ("opinions", "emptiness", "lost"),
    [
        ([BARE], Emptiness.UNAUTHORED, []),
        ([BLOCK], Emptiness.BLOCKED, []),
        ([BARE, BLOCK], Emptiness.BLOCKED, []),
        ([DELETE], Emptiness.UNAUTHORED, []),
        ([DELETE, BLOCK], Emptiness.BLOCKED, []),
        ([DELETE, NAMED], Emptiness.DELETED, []),
        ([DELETE, NAMED, OTHER], Emptiness.DELETED, []),
        ([BLOCK, NAMED], Emptiness.BLOCKED, []),
        ([NAMED], Emptiness.LOST, [0]),
        ([BARE, NAMED], Emptiness.LOST, [1]),
        ([NAMED, OTHER], Emptiness.LOST, [0]),
        ([OTHER, NAMED], Emptiness.LOST, [0, 1]),
        ([OTHER, BLOCK], Emptiness.LOST, [0]),
        ([OTHER, DELETE, NAMED], Emptiness.LOST, [0]),
    ],
)
def test_opinions_strongest_first(
    opinions: list[str], emptiness: Emptiness, lost: list[int]
) -> None:
    """Targets outside what a reference brings are lost; a strong opinion may hide that."""
    layers = [layer(f'over "asset" {{\n over "cloud" {{\n{each}\n}}\n}}') for each in opinions]
    asset = layer("")
    asset.subLayerPaths = [each.identifier for each in layers]
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/a").GetReferences().AddReference(asset.identifier, "/asset")
    relationship = stage.GetRelationshipAtPath("/a/cloud.field:density")
    assert not relationship.GetTargets()
    found, specs = why_empty(relationship, {})
    assert found is emptiness
    assert [spec.layer for spec in specs] == [layers[index] for index in lost]


@pytest.mark.parametrize(
    ("last", "emptiness"),
    [
        ("</v.field:n7>", Emptiness.CIRCULAR),
        ("</v.field:gone>", Emptiness.UNAUTHORED),
        ("None", Emptiness.BLOCKED),
    ],
)
def test_many_that_lead_into_one_chain(last: str, emptiness: Emptiness) -> None:
    """A ring, or what ends nowhere or with nothing: USD is asked once for each of them."""
    links = 30
    chain = "".join(f"rel field:n{n} = </v.field:n{n + 1}>\n" for n in range(links - 1))
    stage = Usd.Stage.Open(layer(f'def "v"\n{{\n{chain}rel field:n{links - 1} = {last}\n}}'))
    known: dict[Any, Reason] = {}
    for number in range(links):
        relationship = stage.GetRelationshipAtPath(f"/v.field:n{number}")
        assert why_empty(relationship, known) == (emptiness, ())
        assert len(known) == links
