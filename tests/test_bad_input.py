"""Whatever is wrong with the input is told in a line, and all other stages are still reported."""

from __future__ import annotations

import os
import random
import re
import subprocess
import sys
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from process import ROOT, ROUGH, STUDIO, Ran, environment, run, volume, write
from pxr import Sdf, Usd, UsdVol

from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import UsageError
from usdvol_lint.paths import display
from usdvol_lint.run.discovery import discover
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.supervisor import Worker

ZIP_WRITER: Any = getattr(Sdf, "ZipFileWriter", None) or Usd.ZipFileWriter
"""Where USD's own writer of packages is depends on its version."""

POSIX = os.name == "posix"
STUDIO_ONLY = ("--isolated", "--pack", STUDIO, "--select", "STU001", "--output-format", "json")
ROUGH_ONLY = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--output-format", "json")
GOOD = "name 'fog', wanted smoke, fire"
KINDS = "USD files end in .usd, .usda, .usdc, .usdz"
AGAIN = "copy or export it again"
NO_DIRECTORY = (
    "a truncated or corrupt package: the directory of its files, which ends it, is missing"
)


def crate() -> bytes:
    """A small crate file, the same in every run."""
    layer = Sdf.Layer.CreateAnonymous(".usdc")
    stage = Usd.Stage.Open(layer)
    smoke = UsdVol.Volume.Define(stage, "/smoke")
    smoke.CreateExtentAttr([(0, 0, 0), (1, 1, 1)])
    field = UsdVol.OpenVDBAsset.Define(stage, "/smoke/density")
    for time in range(40):
        field.CreateFilePathAttr().Set(f"./smoke.{time:04}.vdb", time)
    smoke.CreateFieldRelationship("density", field.GetPath())
    path = Path("crate.usdc")
    layer.Export(str(path))
    return path.read_bytes()


def statuses(ran: Ran) -> dict[str, str]:
    return {stage["path"]: stage["status"] for stage in ran.json["stages"]}


def troubles(ran: Ran) -> dict[str, tuple[Any, ...]]:
    """What is said of each stage, with its place and the advice."""
    return {
        stage["path"]: (
            finding["message"],
            finding["line"],
            finding["column"],
            finding["suggestion"],
        )
        for stage in ran.json["stages"]
        for finding in stage["findings"]
    }


# --- what can not be opened -----------------------------------------------------------------------

TEXTS = {
    "fog.usda": volume("fog"),
    "garbage.usda": "garbage\n",
    "empty.usda": "",
    "pointer.usdc": "version https://git-lfs.github.com/spec/v1\noid sha256:0a\nsize 1\n",
    "mark.usda": f"\ufeff{volume('fog')}",
    "text.usdc": volume("fog"),
    "text.usdz": volume("fog"),
    "text.txt": volume("fog"),
    "no_extension": volume("fog"),
    "bracket.usda": '#usda 1.0\ndef Volume "a"\n{\n    float3[] extent = [(0, 0, 0}\n}\n',
    "word.usda": '#usda 1.0\ndef "a"\n{\n    double b = x\n}\n',
    "twice.usda": '#usda 1.0\ndef "a"\n{\n}\ndef "a"\n{\n}\n',
    "cut.usda": '#usda 1.0\ndef Volume "a"\n{\n',
    "zeros.usda": "\0" * 64,
}
TEXT_TROUBLES = {
    "fog.usda": (GOOD, 2, 1, None),
    "garbage.usda": ("not a USD file: it begins with b'garbage\\n'", None, None, None),
    "empty.usda": ("an empty file (0 bytes)", None, None, "export it again"),
    "pointer.usdc": ("a Git-LFS pointer, not the file itself", None, None, "run `git lfs pull`"),
    "mark.usda": (
        "begins with a byte order mark, which USD does not read",
        None,
        None,
        "save it as UTF-8 without one",
    ),
    "text.usdc": ("USD text under the name of a .usdc", None, None, "rename it to .usda or .usd"),
    "text.usdz": ("USD text under the name of a .usdz", None, None, "rename it to .usda or .usd"),
    "text.txt": ("unsupported file type '.txt'", None, None, KINDS),
    "no_extension": ("a file name without an extension", None, None, KINDS),
    "bracket.usda": ("parse error: unexpected '}' in </a.extent>", 4, 32, None),
    "word.usda": (
        "parse error: Error parsing simple value: Failed to parse value "
        "(at sub-part 0 if there are multiple parts) at 'x' in </a.b>",
        4,
        16,
        None,
    ),
    "twice.usda": ("parse error: Duplicate prim 'a' at '\"a\"' in </a>", 5, 5, None),
    "cut.usda": ("parse error: Expected } at '' in </a>", 4, 1, None),
    "zeros.usda": (f"not a USD file: it begins with {bytes(12)!r}", None, None, None),
}


def test_files_that_are_no_stages(tmp_path: Path) -> None:
    for name, text in TEXTS.items():
        (tmp_path / name).write_text(text, encoding="utf-8", newline="\n")
    (tmp_path / "nothing_inside").mkdir()
    (tmp_path / "nothing_inside" / "notes.txt").touch()
    ran = run(*STUDIO_ONLY, *TEXTS, "gone.usda", "gone", "nothing_inside", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert troubles(ran) == {
        **TEXT_TROUBLES,
        "gone.usda": ("no such file or folder", None, None, None),
        "gone": ("no such file or folder", None, None, None),
        "nothing_inside": ("a folder that holds no USD file", None, None, KINDS),
    }
    expected = dict.fromkeys([*TEXTS, "gone.usda", "gone", "nothing_inside"], "unreadable")
    assert statuses(ran) == {**expected, "fog.usda": "checked"}


def test_bytes_that_are_no_text(tmp_path: Path) -> None:
    (tmp_path / "latin.usda").write_bytes(b'#usda 1.0\ndef "a"\n{\n    asset b = @\xff\xfe@\n}\n')
    write(tmp_path, fog=volume("fog"))
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "latin.usda": (r"parse error: unexpected '\xff\xfe@' in </a.b>", 4, 16, None),
    }


def test_crates_and_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    data = crate()
    write(tmp_path, fog=volume("fog"))
    contents = int.from_bytes(data[16:24], "little")
    for size in (4, 50, 88, contents - 1, contents + 8, len(data) - 1):
        (tmp_path / f"cut_{size}.usdc").write_bytes(data[:size])
    (tmp_path / "crate.usda").write_bytes(data)
    (tmp_path / "crate.usd").write_bytes(data)
    (tmp_path / "zip.usd").write_bytes(b"PK\x03\x04" + bytes(60))
    (tmp_path / "zip.usdz").write_bytes(b"PK\x03\x04" + bytes(60))
    with ZipFile(tmp_path / "alien.usdz", "w") as archive:
        archive.writestr("a.txt", "")
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    said = {path: (trouble[0], trouble[3]) for path, trouble in troubles(ran).items()}
    table = "a truncated or corrupt crate file: its table of contents should be at byte "
    for size in (contents + 8, len(data) - 1):  # what is said is USD's own
        message, advice = said.pop(f"cut_{size}.usdc")
        assert message.startswith("a truncated or corrupt crate file: ")
        assert str(tmp_path) not in message
        assert advice == AGAIN
    assert said == {
        "fog.usda": (GOOD, None),
        "cut_4.usdc": ("a truncated crate file: 4 bytes, its header alone takes 88", AGAIN),
        "cut_50.usdc": ("a truncated crate file: 50 bytes, its header alone takes 88", AGAIN),
        "cut_88.usdc": (f"{table}{contents}, the file has 88 bytes", AGAIN),
        f"cut_{contents - 1}.usdc": (
            f"{table}{contents}, the file has {contents - 1} bytes",
            AGAIN,
        ),
        "crate.usda": ("a crate file under the name of a .usda", "rename it to .usdc or .usd"),
        "zip.usd": ("a zip file under the name of a .usd", "rename it to .usdz"),
        "zip.usdz": (NO_DIRECTORY, "copy or package it again"),
        "alien.usdz": ("a package in which USD finds no layer to open", "package it again"),
    }
    assert statuses(ran)["crate.usd"] == "checked"


def packaged(path: Path, comment: bytes = b"", **others: bytes) -> bytes:
    """A package with the fog as its first layer, which USD opens whatever becomes of its end."""
    write(path.parent / "loose", fog=volume("fog"))
    with ZIP_WRITER.CreateNew(str(path)) as writer:
        writer.AddFile(str(path.parent / "loose" / "fog.usda"), "fog.usda")
        for name, data in others.items():
            (path.parent / "loose" / name).write_bytes(data)
            writer.AddFile(str(path.parent / "loose" / name), f"{name}.usdz")
    if comment:
        with ZipFile(path, "a") as archive:
            archive.comment = comment
    return path.read_bytes()


def test_packages_that_are_cut_off(tmp_path: Path) -> None:
    folder = tmp_path / "stages"
    folder.mkdir()
    inner = packaged(tmp_path / "inner.usdz")
    nested = packaged(tmp_path / "nested.usdz", inner=inner)
    empty_record = b"PK\x05\x06" + bytes(18)
    whole = {
        "plain": inner,
        "nested": nested,
        "longest_comment": packaged(tmp_path / "long.usdz", b"x" * 0xFFFF),
        "record_in_comment": packaged(tmp_path / "record.usdz", empty_record + b"PK\x05\x06"),
        "zip64": inner[:-6] + b"\xff" * 4 + inner[-2:],
    }
    directory = int.from_bytes(inner[-6:-2], "little")
    cut = {
        "in_record": inner[:-1],
        "before_record": inner[:-22],
        "before_directory": inner[:directory],
        "after_inner": nested[: nested.index(b"PK\x05\x06") + 22],
        "middle_gone": inner[: directory - 8] + inner[directory:],
    }
    for name, data in (whole | cut).items():
        (folder / f"{name}.usdz").write_bytes(data)
    ran = run(*STUDIO_ONLY, "stages", cwd=tmp_path)
    said = {name: (trouble[0], trouble[3]) for name, trouble in troubles(ran).items()}
    assert said == {
        **{f"stages/{name}.usdz": (GOOD, None) for name in whole},
        **{f"stages/{name}.usdz": (NO_DIRECTORY, "copy or package it again") for name in cut},
    }


def test_a_layer_that_the_stage_names_is_no_reason_not_to_check_it(tmp_path: Path) -> None:
    (tmp_path / "garbage.txt").write_text("garbage")
    (tmp_path / "bracket.txt").write_text("#usda 1.0\n(")
    for arc in ("subLayers", "references"):
        for layer in ("garbage.txt", "bracket.txt", "gone.usda", "."):
            named = f"@./{layer}@"
            head = f"#usda 1.0\n(\n    subLayers = [{named}]\n)\n" if arc == "subLayers" else ""
            text = volume("fog").replace("#usda 1.0\n", head) if head else volume("fog").replace(
                "\n{", f" (\n    references = {named}\n)\n{{"
            )  # fmt: skip
            write(tmp_path / "stages", **{f"{arc}_{layer.partition('.')[0]}": text})
    ran = run(*STUDIO_ONLY, "stages", cwd=tmp_path)
    assert (ran.code, ran.err) == (1, "")
    assert set(statuses(ran).values()) == {"checked"}
    assert len(troubles(ran)) == 8


@pytest.mark.skipif(not POSIX, reason="needs symbolic links")
def test_links(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    (tmp_path / "broken.usda").symlink_to("gone.usda")
    (tmp_path / "loop.usda").symlink_to("loop.usda")
    (tmp_path / "round").mkdir()
    (tmp_path / "round" / "trip").symlink_to(tmp_path, target_is_directory=True)
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    said = troubles(ran)
    assert said.pop("loop.usda")[0].startswith("can't be read: ")
    assert said == {
        "fog.usda": (GOOD, 2, 1, None),
        "broken.usda": (
            "a symbolic link to 'gone.usda', which does not exist",
            None,
            None,
            None,
        ),
    }


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_pipes(tmp_path: Path) -> None:
    """USD waits for a writer for ever."""
    write(
        tmp_path,
        fog=volume("fog"),
        hangs="#usda 1.0\n(\n    subLayers = [@./pipe.usda@]\n)\n",
        zzz=volume("fog"),
    )
    os.mkfifo(tmp_path / "pipe.usda")
    ran = run(*STUDIO_ONLY, "--timeout", "1.5", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {
        "fog.usda": "checked",
        "hangs.usda": "timed_out",
        "pipe.usda": "unreadable",
        "zzz.usda": "checked",
    }
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "hangs.usda": (
            "not done after 1.5 s, ended there",
            None,
            None,
            "look for a layer that is a pipe or a corrupt file, or give it more with --timeout",
        ),
        "pipe.usda": ("not a regular file (a pipe, socket or device)", None, None, None),
        "zzz.usda": (GOOD, 2, 1, None),
    }


def test_no_permission(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"), secret=volume("fog"))
    write(tmp_path / "closed", fog=volume("fog"))
    (tmp_path / "secret.usda").chmod(0)
    (tmp_path / "closed").chmod(0)
    if os.access(tmp_path / "secret.usda", os.R_OK):
        pytest.skip("nothing is forbidden here")
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    (tmp_path / "closed").chmod(0o700)
    denied = ("can't be read: Permission denied", None, None, None)
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "secret.usda": denied,
        "closed": denied,
    }


def test_a_folder_that_can_not_be_listed_is_not_passed_over(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, engine: Engine
) -> None:
    """The same for everybody, root too."""
    write(tmp_path / "closed")
    write(tmp_path / "open", fog=volume("fog"))
    monkeypatch.chdir(tmp_path)

    def deny(true: Any) -> Any:
        def call(folder: Any) -> Any:
            if str(folder).endswith("closed"):
                raise PermissionError(13, "Permission denied", folder)
            return true(folder)

        return call

    monkeypatch.setattr(os, "scandir", deny(os.scandir))
    monkeypatch.setattr(os, "listdir", deny(os.listdir))
    found = discover(["."])
    assert [display(path) for path in found] == ["closed", "open/fog.usda"]
    (finding,) = engine.lint(found[0]).findings
    assert (finding.code, finding.message) == ("LNT001", "can't be read: Permission denied")


def test_names_with_brackets(tmp_path: Path) -> None:
    """They are how USD names layers inside packages, and legal in file names all the same."""
    write(tmp_path / "[1]", **{"[2]": volume("fog"), "a[3]b": volume("fog")})
    ran = run(*STUDIO_ONLY, tmp_path, cwd=tmp_path)
    assert set(troubles(ran)) == {"[1]/[2].usda", "[1]/a[3]b.usda"}
    layers = {f["layer"] for stage in ran.json["stages"] for f in stage["findings"]}
    assert layers == {"[1]/[2].usda", "[1]/a[3]b.usda"}


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere file names are Unicode")
def test_names_that_are_no_text(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    (tmp_path / os.fsdecode(b"\xff.usda")).write_text(volume("fog"))
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    said = "USD opens no file whose path is not UTF-8"
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "\udcff.usda": (said, None, None, "rename the file or folder"),
    }


# --- what happens while USD or a rule is at work --------------------------------------------------

CRASHED = "the file or a layer it names is probably corrupt: open it with usdcat to see which"
KILLED = "give the machine more memory, or let fewer work at once with --jobs"
ENDED = "a bug of usdvol-lint, a rule pack or a USD plugin; --verbose shows what it said"


@pytest.mark.skipif(not POSIX, reason="signals as POSIX has them")
@pytest.mark.parametrize("jobs", ["1", "3"])
def test_crashes_and_hangs(jobs: str, tmp_path: Path) -> None:
    names = ["a", "abort", "exit", "hang", "interrupt", "killed", "leave", "print", "segfault", "z"]
    write(tmp_path / "stages", **{name: volume(name) for name in names})
    ran = run(*ROUGH_ONLY, "--timeout", "1", "-j", jobs, "stages", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    behaved = ("behaved", 2, 1, None)
    crash = "the USD library crashed while reading it"
    end = "the process that checked it ended early"
    outside = "the process that checked it was ended from outside"
    hung = "look for a layer that is a pipe or a corrupt file, or give it more with --timeout"
    assert troubles(ran) == {
        "stages/a.usda": behaved,
        "stages/abort.usda": (f"{crash} (SIGABRT)", None, None, CRASHED),
        "stages/exit.usda": (f"{end} (exit code 3)", None, None, ENDED),
        "stages/hang.usda": ("not done after 1 s, ended there", None, None, hung),
        "stages/interrupt.usda": (f"{end} (SIGINT)", None, None, ENDED),
        "stages/killed.usda": (f"{outside} (SIGKILL)", None, None, KILLED),
        "stages/leave.usda": (f"{end} (exit code 4)", None, None, ENDED),
        "stages/print.usda": behaved,
        "stages/segfault.usda": (f"{crash} (SIGSEGV)", None, None, CRASHED),
        "stages/z.usda": behaved,
    }
    assert ran.json["summary"]["by_status"] == {"checked": 3, "crashed": 6, "timed_out": 1}


@pytest.mark.parametrize("end", ["hang", "exit"])
def test_what_was_found_before_the_end_is_kept(end: str, tmp_path: Path) -> None:
    """Also what the authored selections show, where another selection ends it all."""
    kept = volume("v1") + volume("v2").removeprefix("#usda 1.0\n")
    bad = volume(end).removeprefix("#usda 1.0\n")
    variants = 'variantSet "look" = {\n"good" {\n}\n"bad" {\n' + bad + "}\n}"
    (tmp_path / "late.usda").write_text(kept + bad, encoding="utf-8")
    (tmp_path / "other.usda").write_text(
        f'{kept}def "model" (\nvariants = {{ string look = "good" }}\n'
        f'prepend variantSets = ["look"]\n)\n{{\n{variants}\n}}\n',
        encoding="utf-8",
    )
    ran = run(*ROUGH_ONLY, "--timeout", "1", "--variants", "all", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert set(statuses(ran).values()) == {"timed_out" if end == "hang" else "crashed"}
    found = [
        [(finding["code"], finding["prim"]) for finding in stage["findings"]]
        for stage in ran.json["stages"]
    ]
    assert found == [[("LNT001", None), ("RGH001", "/v1"), ("RGH001", "/v2")]] * 2


def test_of_many_findings_few_are_lost(tmp_path: Path) -> None:
    """To tell of each by itself would take its time."""
    many = "".join(volume(f"v{n}").removeprefix("#usda 1.0\n") for n in range(1000))
    (tmp_path / "many.usda").write_text(volume("v") + many + volume("exit")[10:], encoding="utf-8")
    ran = run(*ROUGH_ONLY, "many.usda", cwd=tmp_path)
    assert statuses(ran) == {"many.usda": "crashed"}
    assert 900 <= len(ran.json["stages"][0]["findings"]) <= 1002


def test_verbose_shows_what_the_process_said(tmp_path: Path) -> None:
    write(tmp_path, exit=volume("exit"))
    only = ("--isolated", "--pack", ROUGH, "--select", "RGH", "exit.usda")
    assert "last words" not in run(*only, cwd=tmp_path).out
    assert "\n    | last words\n" in run(*only, "--verbose", cwd=tmp_path).out


def test_the_limit_is_for_a_stage_not_for_a_new_process(tmp_path: Path) -> None:
    """Which takes longer to start than the limit is, because of a slow pack."""
    write(tmp_path, a=volume("hang"), b=volume("b"))
    pack(tmp_path / "slow", a="import time; time.sleep(1)\n" + RULE.format(code="SLO001", name="a"))
    ran = run(*ROUGH_ONLY, "--pack", "slow", "--timeout", "0.9", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {"a.usda": "timed_out", "b.usda": "checked"}


def test_a_process_that_says_why_it_ends_is_heard() -> None:
    """Even if it has gone before it was asked anything."""
    program = (
        "import pickle, sys; from usdvol_lint.run.protocol import Refusal; "
        "sys.stdout.buffer.write(pickle.dumps(Refusal('not\\ntoday')))"
    )
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    child = subprocess.Popen([sys.executable, "-P", "-c", program], env=environment(), **pipes)
    child.wait()
    worker = Worker(child)
    nothing: Any = [None] * len(Setup._fields)
    with pytest.raises(UsageError, match=r"^not today$"):
        worker.prepare(Setup(*nothing), 60)
    worker.stop()


def test_a_rule_that_raises(tmp_path: Path) -> None:
    stage = "#usda 1.0\n" + "".join(f'def Volume "raise_{n}"\n{{\n}}\n' for n in range(40))
    write(tmp_path, raising=stage + 'def Volume "fine"\n{\n}\n', z=volume("z"))
    ran = run(*ROUGH_ONLY, ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    found = [
        (finding["code"], finding["prim"], finding["line"], finding["message"])
        for stage in ran.json["stages"]
        for finding in stage["findings"]
    ]
    said = (
        "rule RGH001 (behaves) failed here, and on 39 more prims: "
        "ValueError: at /raise_0: second line"
    )
    assert found == [
        ("RGH001", "/fine", 122, "behaved"),
        ("LNT002", "/raise_0", 2, said),
        ("RGH001", "/z", 2, "behaved"),
    ]
    assert statuses(ran) == {"raising.usda": "checked", "z.usda": "checked"}
    only = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--fail-on", "never", ".")
    ran = run(*only, "--verbose", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert "| Traceback (most recent call last):\n" in ran.out
    assert "behaves.py" in ran.out


def test_corrupt_crates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever USD makes of them: it checks some, refuses some, crashes or hangs on others."""
    monkeypatch.chdir(tmp_path)
    data = crate()
    folder = write(tmp_path / "stages", a=volume("fog"), z=volume("fog"))
    for seed in range(24):
        chance = random.Random(seed)
        mutant = bytearray(data)
        for _ in range(1 + seed % 8):
            mutant[chance.randrange(88, len(data))] = chance.randrange(256)
        (folder / f"mutant_{seed:02}.usdc").write_bytes(mutant)
    ran = run(*STUDIO_ONLY, "--timeout", "10", "-j2", "stages", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    found = statuses(ran)
    assert len(found) == 26
    assert set(found.values()) >= {"checked", "unreadable"}
    assert found["stages/a.usda"] == found["stages/z.usda"] == "checked"
    assert {"stages/a.usda", "stages/z.usda"} <= troubles(ran).keys()


def test_usd_fails_while_rules_read_a_stage(tmp_path: Path) -> None:
    """It is not the rules' fault, and said once, however many of them read that value."""
    write(tmp_path, damaged=volume("damaged"), z=volume("z"))
    ran = run(*ROUGH_ONLY, ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert [
        (finding["code"], finding["message"], finding["suggestion"])
        for stage in ran.json["stages"]
        for finding in stage["findings"]
    ] == [
        (
            "LNT001",
            "USD can't read what is here: Python runtime error: "
            "no value in damaged.usda at </damaged>",
            "the layer is probably corrupt: copy or export it again",
        ),
        ("RGH001", "behaved", None),
    ]
    assert statuses(ran) == {"damaged.usda": "checked", "z.usda": "checked"}


# --- what stops the whole run, in one line --------------------------------------------------------


def pack(folder: Path, **modules: str) -> Path:
    folder.mkdir()
    for name, text in modules.items():
        (folder / f"{name}.py").write_text(text, encoding="utf-8")
    return folder


RULE = """\
from usdvol_lint.rule import ERROR, rule


@rule("{code}", on="Volume", severity=ERROR, since="1")
def {name}(volume, facts):
    yield from ()
"""


@pytest.mark.parametrize(
    ("modules", "said"),
    [
        ({"a": "def ("}, r".*a\.py: SyntaxError: .*\(a\.py, line 1\)"),
        ({"a": "import gone"}, r".*a\.py: ModuleNotFoundError: No module named 'gone'"),
        ({"a": "raise ValueError('two\\nlines')"}, r".*a\.py: ValueError: two lines"),
        ({"a": "import sys; sys.exit()"}, r".*a\.py: SystemExit:"),
        ({"a": "x = 1", "_b": "import gone"}, r"rule pack '.*' holds no rule"),
        ({}, r"rule pack '.*' holds no rule"),
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
    assert re.fullmatch(f"usdvol-lint: error: {said}\n", ran.err), ran.err


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
            "USD can't be imported (no libusd.so, reinstall); install usd-core",
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
    assert run(*STUDIO_ONLY, ".", cwd=tmp_path, env=env) == Ran(
        2, "", f"usdvol-lint: error: {said}\n"
    )
