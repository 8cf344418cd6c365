"""What stops the whole run is told in one line: broken packs, no USD."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from badinput import RULE, STUDIO_ONLY, pack, troubles
from process import ROOT, environment, run, volume, write


@pytest.mark.parametrize(
    ("modules", "said"),
    [
        ({"a": "def ("}, r".*a\.py: SyntaxError: .*\(a\.py, line 1\)"),
        ({"a": "import gone"}, r".*a\.py: ModuleNotFoundError: No module named 'gone'"),
        ({"a": "raise ValueError('two\\nlines')"}, r".*a\.py: ValueError: two lines"),
        ({"a": "import sys; sys.exit()"}, r".*a\.py: SystemExit:"),
        (
            {"a": "x = 1", "_b": "import gone"},
            r"rule pack '.*' holds no rule: no module in it has a function with @rule",
        ),
        ({}, r"rule pack '.*' holds no rule: no module in it has a function with @rule"),
        (
            {"a": RULE.format(code="ABC01", name="a")},
            r"rule pack '.*': a code is three capitals and three digits, not 'ABC01' \(a\)",
        ),
        (
            {"a": RULE.format(code="ABC001", name="a"), "b": RULE.format(code="ABC001", name="b")},
            r"rule pack '.*': ABC001 \(b\) takes the code or name of another rule, ABC001 \(a\)",
        ),
        (
            {"a": RULE.format(code="ABC001", name="a"), "b": RULE.format(code="ABC002", name="a")},
            r"rule pack '.*': ABC002 \(a\) takes the code or name of another rule, ABC001 \(a\)",
        ),
        (
            {"a": RULE.format(code="LNT001", name="a")},
            r"rule pack '.*': LNT001 \(a\) takes the code or name of another rule, "
            r"LNT001 \(stage-unreadable\)",
        ),
    ],
)
def test_a_broken_pack(modules: dict[str, str], said: str, tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    pack(tmp_path / "pack", **modules)
    ran = run("--isolated", "--pack", "pack", ".", cwd=tmp_path)
    assert (ran.code, ran.out) == (2, "")
    assert re.fullmatch(f"usdvol-lint: error: --pack: {said}\n", ran.err), ran.err


def test_a_pack_that_prints_does_not_garble_the_report(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    pack(tmp_path / "pack", a="print('hello')\n" + RULE.format(code="ABC001", name="a"))
    ran = run(*STUDIO_ONLY, "--pack", "pack", ".", cwd=tmp_path)
    assert set(troubles(ran)) == {"fog.usda"}
    assert ran.err == "hello\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "raise ImportError('no libusd.so,\\n reinstall')",
            "USD can't be imported (no libusd.so, reinstall): install usd-core, or put the folder "
            "with the pxr of another USD on PYTHONPATH",
        ),
        (
            "raise RuntimeError('boom')",
            "the process that loads USD does not start (exit code 1): RuntimeError: boom",
        ),
        (
            "import os; os._exit(7)",
            "the process that loads USD does not start (exit code 7): it said nothing",
        ),
    ],
)
def test_usd_can_not_be_imported(text: str, said: str, tmp_path: Path) -> None:
    fake = tmp_path / "fake" / "pxr"
    fake.mkdir(parents=True)
    (fake / "__init__.py").write_text(text)
    write(tmp_path, fog=volume("fog"))
    env = environment(PYTHONPATH=os.pathsep.join([str(ROOT), str(fake.parent)]))
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path, env=env)
    assert (ran.code, ran.err) == (2, f"usdvol-lint: error: {said}\n")
    assert (ran.json["failure"], ran.json["stages"]) == (said, [])
