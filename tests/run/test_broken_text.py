"""Crates whose strings are no text: one finding says so, and no rule fails for it."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from process import run
from pxr import Sdf

LAYER = """\
#usda 1.0
(
    defaultPrim = "Ugwhkqqbvd"
)
def Xform "Ugwhkqqbvd" (
    prepend apiSchemas = ["CollectionAPI:Xbrmkqqtsy"]
    prepend variantSets = "Lofjdqqvca"
    variants = {
        string Lofjdqqvca = "Yicknqqzwe"
    }
    clips = {
        dictionary Ogvtsqqdnr = {
            asset[] assetPaths = [@./Eayxwqqfmk.usda@]
            string primPath = "/Hsnbuqqlip"
            double2[] active = [(0, 0)]
        }
    }
)
{
    def Volume "Pkezyqqrdo"
    {
        rel field:Wtahcqqnjm = </Ugwhkqqbvd/Pkezyqqrdo/Dvouiqqgxl>
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        uniform token[] xformOpOrder = ["xformOp:translate:Jmwfpqqkes"]
        custom string Rblgzqqhya = "Nyqdtqquoc" (
            customData = {
                string Szvpeqqwiu = "Igxbrqqmfj"
            }
        )

        def OpenVDBAsset "Dvouiqqgxl"
        {
            asset filePath.timeSamples = {
                1: @./Cjlnoqqaeg.vdb@,
                2: @./Fwysvqqtbz.vdb@,
            }
            token fieldName = "Kuedmqqpxr"
        }
    }

    def Bohxtqqiyl "Tnrzfqqsgw"
    {
    }

    def ParticleField3DGaussianSplat "Vcampqqjud" (
        prepend apiSchemas = ["Qwkeiqqobh"]
    )
    {
        point3f[] positions = [(0, 0, 0)]
    }
    variantSet "Lofjdqqvca" = {
        "Yicknqqzwe" {
            def Volume "Gzhruqqlvx"
            {
            }
        }
        "Malqbqqfdt" {
            def Volume "Apsynqqecw"
            {
            }
        }
    }
}
"""
"""Its words are unlike each other, so that a crate's compression leaves them as they are."""


def test_broken_text_is_one_finding(tmp_path: Path) -> None:
    (tmp_path / "whole.usda").write_text(LAYER, encoding="utf-8")
    Sdf.Layer.FindOrOpen(str(tmp_path / "whole.usda")).Export(str(tmp_path / "whole.usdc"))
    crate = (tmp_path / "whole.usdc").read_bytes()
    words = {word.decode() for word in re.findall(rb"[A-Z][a-z]{4}qq[a-z]{3}", crate)}
    assert {"Bohxtqqiyl", "Fwysvqqtbz", "Lofjdqqvca", "Malqbqqfdt"} <= words
    for word in words:
        broken = word.encode().replace(b"qq", b"\xff\xe9")
        (tmp_path / f"{word}.usdc").write_bytes(crate.replace(word.encode(), broken))
    options = ("--isolated", "--variants", "all", "--statistics", "--output-format", "json")
    ran = run(*options, ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    stages = {stage["path"].partition(".")[0]: stage for stage in ran.stages}
    assert {stage["status"] for stage in stages.values()} == {"checked", "unreadable"}
    codes = {
        name: Counter(finding["code"] for finding in stage["findings"])
        for name, stage in stages.items()
    }
    assert [name for name in codes if codes[name]["LNT002"] or codes[name]["LNT001"] > 1] == []
    (said,) = [each for each in stages["Bohxtqqiyl"]["findings"] if each["code"] == "LNT001"]
    assert said["message"] == (
        r"USD can't read what is here: text that is not UTF-8: 'Bohxt\xff\xe9iyl'"
    )
    assert said["suggestion"] == "the layer is probably corrupt: copy or export it again"
    whole = codes["whole"]
    assert codes["Bohxtqqiyl"] - Counter(["LNT001"]) == whole, "a type keeps nothing else back"
