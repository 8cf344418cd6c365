"""The files that fields name."""

from __future__ import annotations

import posixpath
from random import Random
from typing import Any

from ..files import FRAME, original, shared
from ..model import SCENE, Attribute, File, Prim
from ..subjects import FieldPart
from .declaration import A_RUN, ONE_FILE, VolumeSubject, any_field, extent_for_all, on_volume

_IN_LAYER = {"files": ("static", "several", "sequence", "own sequence", "field3d")}


def _named(subject: VolumeSubject, rng: Random, value: Any) -> Prim:
    prim = any_field(subject, rng).prim
    prim.properties["filePath"] = Attribute("asset", value)
    return prim


def _own_file(subject: VolumeSubject, name: str, data: bytes) -> File:
    """A file beside the layer of the subject."""
    file = File(posixpath.join(posixpath.dirname(subject.layer.path), name))
    subject.content.files[file.path] = data
    return file


@on_volume("AST001", needs=_IN_LAYER)
def no_path(subject: VolumeSubject, rng: Random) -> Prim:
    prim = any_field(subject, rng).prim
    del prim.properties["filePath"]
    return prim


@on_volume("AST001", needs=_IN_LAYER)
def path_empty(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "")


@on_volume("AST001", needs=_IN_LAYER)
def path_blocked(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, None)


@on_volume("AST002", needs=ONE_FILE)
def file_missing(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, rng.choice(("./gone.vdb", "./not/there.vdb", "gone.vdb")))


@on_volume("AST002", needs={"files": ("own sequence", "clips", "template clips"), "fields": 1})
def frame_missing(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    attribute = rng.choice(part.file_paths)
    del subject.content.files[rng.choice(list(attribute.samples.values())).path]
    return part.prim


@on_volume("AST002", needs={"files": "field3d"})
def field3d_missing(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "./gone.f3d")


@on_volume("AST003", needs=ONE_FILE)
def placeholder(subject: VolumeSubject, rng: Random) -> Prim:
    patterns = ("$F4", "####", "%04d", "<UDIM>", "<f>", "$F", "@@@@")
    pattern = rng.choice(patterns[:-1])
    return _named(subject, rng, f"./smoke.{pattern}.vdb")


@on_volume("AST004", needs=ONE_FILE)
def expression_broken(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, '`"./${TAKE.vdb"`')


@on_volume("AST004", needs=ONE_FILE)
def variable_unset(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, '`"./${TAKE}.vdb"`')


@on_volume("AST005", needs=ONE_FILE)
def no_bytes(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, _own_file(subject, "nothing.vdb", b""))


@on_volume("AST005", needs=ONE_FILE, without=("package",))
def git_lfs_pointer(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, File(shared("pointer.vdb")))


@on_volume("AST005", needs=ONE_FILE, without=("package",))
def folder(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, File(shared("folder")))


@on_volume("AST005", needs=A_RUN)
def frame_of_no_bytes(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    broken = rng.choice(list(part.prim.attribute("filePath").samples.values()))
    subject.content.files[broken.path] = b""
    return _alone(subject, part)


def _alone(subject: VolumeSubject, part: FieldPart) -> Prim:
    """The field, with the others gone that name the same files."""
    for other in subject.fields:
        if other is not part:
            del subject.prim.properties[other.relationship]
            del other.prim.properties["filePath"]
            other.prim.type = "Scope"
    return part.prim


@on_volume("AST006", needs=ONE_FILE)
def extension_of_another(subject: VolumeSubject, rng: Random) -> Prim:
    extent_for_all(subject)
    data = original(shared("grids/half.vdb")).read_bytes()
    name = rng.choice(("cloud.bin", "cloud.vdb.bak", "cloud"))
    prim = _named(subject, rng, _own_file(subject, name, data))
    prim.properties["fieldName"] = Attribute("token", "density")
    for said in ("fieldDataType", "fieldClass", "vectorDataRoleHint"):
        prim.properties.pop(said, None)
    return prim


@on_volume("AST006", needs=ONE_FILE)
def nanovdb(subject: VolumeSubject, rng: Random) -> Prim:
    extent_for_all(subject)
    prim = _named(subject, rng, File(shared("puff/puff.nvdb")))
    prim.properties["fieldName"] = Attribute("token", "f")
    prim.properties["fieldDataType"] = Attribute("token", "float")
    for said in ("fieldClass", "vectorDataRoleHint"):
        prim.properties.pop(said, None)
    return prim


@on_volume("AST002", needs=ONE_FILE, without=("package",))
def absolute_and_missing(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "/mnt/there/is/no/such/folder/cloud.vdb")


@on_volume("AST007", needs={"files": "static", "fields": 1}, without=("package",), is_info=True)
def absolute(subject: VolumeSubject, rng: Random) -> Prim:
    named = any_field(subject, rng).prim.attribute("filePath").value
    return _named(subject, rng, f"{SCENE}/{named.path}")


@on_volume("AST008", needs=ONE_FILE)
def drive_letter(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "Q:/sim/cloud.vdb")


@on_volume("AST008", needs=ONE_FILE)
def backslashes(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, ".\\sim\\cloud.vdb")


@on_volume("AST008", needs=ONE_FILE)
def home(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "~/sim/cloud.vdb")


@on_volume("AST009", needs=A_RUN, without=("package",))
def case_of_another(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    samples = part.prim.attribute("filePath").samples
    time = rng.choice(list(samples))
    head, name = posixpath.split(samples[time].path)
    samples[time] = File(posixpath.join(head, name.replace("cloud", "Cloud")))
    return part.prim


@on_volume("AST010", needs=ONE_FILE)
def houdini_session(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "op:/obj/pyro/out.vdb")


@on_volume("AST010", needs=ONE_FILE, is_info=True)
def uri(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "https://example.com/cloud.vdb")


@on_volume("AST011", needs=A_RUN)
def gap(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    samples = part.prim.attribute("filePath").samples
    del samples[rng.choice(sorted(samples)[2:-2])]
    return part.prim


@on_volume("AST012", needs={**A_RUN, "fields": 1}, perhaps=("AST012",))
def range_elsewhere(subject: VolumeSubject, rng: Random) -> Prim:
    subject.time_range = (1_000_000, 1_000_100)
    return any_field(subject, rng).prim


@on_volume("AST013", needs=A_RUN)
def frame_out_of_order(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    samples = part.prim.attribute("filePath").samples
    times = sorted(samples)
    samples[times[3]] = samples[times[1]]
    return part.prim


@on_volume("AST014", needs={"files": "template clips", "fields": 1})
def manifest_without_path(subject: VolumeSubject, rng: Random) -> Prim:
    [part] = subject.fields
    manifest = next(each for each in subject.content.layers if "manifest" in each.path)
    prim = manifest.prims[0]
    while prim.children:
        prim = prim.children[0]
    del prim.properties["filePath"]
    return part.prim


@on_volume("AST015", needs={**ONE_FILE, "fields": 1}, within="package")
def outside_package(subject: VolumeSubject, rng: Random) -> Prim:
    return _named(subject, rng, "../../../../elsewhere/cloud.vdb")


@on_volume("AST018", needs=A_RUN)
def hole(subject: VolumeSubject, rng: Random) -> Prim:
    part = any_field(subject, rng)
    samples = part.prim.attribute("filePath").samples
    times = sorted(samples)
    first = rng.randrange(1, len(times) - 3)
    for time in times[first : first + rng.randint(1, 2)]:
        samples[time] = rng.choice((None, ""))
    return part.prim


def _numbered(subject: VolumeSubject, count: int) -> list[File]:
    """A sequence of its own, which lies on disk and of which the field may show what it likes."""
    data = original(FRAME.path).read_bytes()
    return [_own_file(subject, f"plume.{number:04}.vdb", data) for number in range(1, count + 1)]


@on_volume("AST017", needs={**A_RUN, "fields": 1}, without=("package",), perhaps=("AST012",))
def frame_at_all_times(subject: VolumeSubject, rng: Random) -> Prim:
    [part] = subject.fields
    frames = _numbered(subject, 8)
    held = rng.choice(frames)
    value = rng.choice((Attribute("asset", held), Attribute("asset", samples={3: held})))
    part.prim.properties["filePath"] = value
    subject.time_range = (1, 8)
    return part.prim


@on_volume("AST017", needs={**A_RUN, "fields": 1}, without=("package",))
def same_frame_in_all_samples(subject: VolumeSubject, rng: Random) -> Prim:
    [part] = subject.fields
    frames = _numbered(subject, 8)
    samples = dict.fromkeys(range(1, 8), rng.choice(frames))
    part.prim.properties["filePath"] = Attribute("asset", samples=samples)
    return part.prim


@on_volume("AST017", needs={**A_RUN, "fields": 1}, without=("package",))
def number_lost(subject: VolumeSubject, rng: Random) -> Prim:
    [part] = subject.fields
    file = _own_file(subject, "plume..vdb", original(FRAME.path).read_bytes())
    part.prim.properties["filePath"] = Attribute("asset", samples={1: file, 2: file})
    return part.prim
