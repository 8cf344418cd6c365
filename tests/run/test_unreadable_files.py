"""Files that can not be opened as stages are told in a line, and all others are reported."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from badinput import GOOD, STUDIO_ONLY, crate, statuses, troubles
from process import run, volume, write
from pxr import Sdf, Usd

ZIP_WRITER: Any = getattr(Sdf, "ZipFileWriter", None) or Usd.ZipFileWriter
"""Where USD's own writer of packages is depends on its version."""


KINDS = "USD files end in .usd, .usda, .usdc, .usdz"
KNOWN_TO_REFUSE_OLD = (0, 26, 11)
"""A version of USD that says of a crate that it is too old; 24.11 takes one for corrupt."""
AGAIN = "copy or export it again"
CORRECT = "correct the text there, or export the layer again"
NO_DIRECTORY = (
    "a truncated or corrupt package: the directory of its files, which ends it, is missing"
)

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
    "garbage.usda": ("not a USD file: it begins with b'garbage\\n'", None, None, AGAIN),
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
    "bracket.usda": ("parse error: unexpected '}' in </a.extent>", 4, 32, CORRECT),
    "word.usda": (
        "parse error: Error parsing simple value: Failed to parse value "
        "(at sub-part 0 if there are multiple parts) at 'x' in </a.b>",
        4,
        16,
        CORRECT,
    ),
    "twice.usda": ("parse error: Duplicate prim 'a' at '\"a\"' in </a>", 5, 5, CORRECT),
    "cut.usda": ("parse error: Expected } at '' in </a>", 4, 1, CORRECT),
    "zeros.usda": (f"not a USD file: it begins with {bytes(12)!r}", None, None, AGAIN),
}


def test_files_that_are_no_stages(tmp_path: Path) -> None:
    for name, text in TEXTS.items():
        (tmp_path / name).write_text(text, encoding="utf-8", newline="\n")
    ran = run(*STUDIO_ONLY, *TEXTS, cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert troubles(ran) == TEXT_TROUBLES
    expected = dict.fromkeys(TEXTS, "unreadable")
    assert statuses(ran) == {**expected, "fog.usda": "checked"}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such names")
def test_names_with_blanks_are_told_as_they_are(tmp_path: Path) -> None:
    for name in ("a\nb.usda", "a  b.usda"):
        (tmp_path / name).write_text("#usda 1.0\ndef", encoding="utf-8", newline="\n")
    ran = run("--isolated", "--output-format", "concise", ".", cwd=tmp_path)
    places = [line.partition(": LNT001")[0] for line in ran.out.splitlines()]
    assert sorted(places) == ["a  b.usda:2:1", r"a\x0ab.usda:2:1"]


def test_bytes_that_are_no_text(tmp_path: Path) -> None:
    (tmp_path / "latin.usda").write_bytes(b'#usda 1.0\ndef "a"\n{\n    asset b = @\xff\xfe@\n}\n')
    write(tmp_path, fog=volume("fog"))
    ran = run(*STUDIO_ONLY, ".", cwd=tmp_path)
    assert troubles(ran) == {
        "fog.usda": (GOOD, 2, 1, None),
        "latin.usda": (r"parse error: unexpected '\xff\xfe@' in </a.b>", 4, 16, CORRECT),
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


def test_crates_of_other_versions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    data = crate()
    for version in ((0, 3, 0), (0, 99, 0)):
        name = ".".join(map(str, version))
        (tmp_path / f"{name}.usdc").write_bytes(data[:8] + bytes(version) + data[11:])
    said = troubles(run(*STUDIO_ONLY, ".", cwd=tmp_path))
    message, advice = said["0.99.0.usdc"][0], said["0.99.0.usdc"][3]
    assert message.startswith("a crate file of version 0.99.0; this USD reads none newer than 0.1")
    assert advice == "convert it to .usda with a newer USD, or lint with that"
    if Usd.GetVersion() < KNOWN_TO_REFUSE_OLD:
        return
    message, advice = said["0.3.0.usdc"][0], said["0.3.0.usdc"][3]
    assert message == "a crate file of version 0.3.0; this USD reads 0.4.0 and newer"
    assert advice == "convert it to .usda with an older USD"


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
