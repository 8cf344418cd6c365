"""The walk over the nodes of a prim index."""

from __future__ import annotations

from pxr import Sdf, Usd

from usdvol_lint.facts.usd.nodes import nodes_of

LAYER = """#usda 1.0
def "a" (
    references = [</b>, </c>]
)
{
}

def "b" (
    references = </d>
)
{
}

def "c"
{
}

def "d"
{
}
"""


def test_nodes_come_in_the_order_of_strength() -> None:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(LAYER)
    stage = Usd.Stage.Open(layer)
    prim = stage.GetPrimAtPath("/a")
    strongest = [spec.path for spec in prim.GetPrimStack()]
    assert [str(path) for path in strongest] == ["/a", "/b", "/d", "/c"]
    assert [node.path for node in nodes_of(prim.GetPrimIndex())] == strongest
    assert [node.path for node in nodes_of(prim.ComputeExpandedPrimIndex())] == strongest
