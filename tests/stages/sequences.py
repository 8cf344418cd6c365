"""Sequences of files: as time samples, and in value clips."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping, Sequence
from random import Random

from .files import FRAME, FRAMES, Source, original
from .model import Attribute, File, Layer, Line, Prim
from .subjects import Choice, VolumeSubject

PATTERNS = ("plain", "held", "looped", "blocked", "blinking", "rest frame", "every file twice")
"""How a sequence of its own goes through its files."""
_VERSIONS = (("_v{:03}", 1), ("_lod.{:04}", 1), (".take{:04}", 1), (".{:04}", 64))
_ITEM = ("_{:04}", 1)
"""How files are numbered, and in which steps."""


def add_sequence(subject: VolumeSubject, choice: Choice, rng: Random) -> None:
    """Time samples: shared files as they are, or own ones of any length, number and step."""
    is_own = choice.files == "own sequence"
    frames = _own_frames(subject, rng) if is_own else _shared_frames(rng)
    start, step = rng.choice((1, 1, 0, -5, 1001, 0.5)), rng.choice((1, 1, 1, 2, 0.5, 0.25))
    ordered = _ordered(frames, choice.pattern if is_own else "plain")
    samples = {start + number * step: frame for number, frame in enumerate(ordered)}
    if is_own and choice.pattern == "rest frame":
        samples[start - 50 * step] = frames[0]
    for part in subject.fields:
        part.prim.properties["filePath"] = Attribute("asset", samples=dict(samples))
        part.prim.properties.pop("fieldClass", None)
        part.prim.attribute("fieldDataType").value = "float"


def _ordered(frames: list[File], pattern: str) -> Sequence[File | None]:
    """The frames in the order in which samples name them."""
    if pattern == "held":
        return [*frames[:3], frames[2], *frames[3:]]
    if pattern == "looped":
        return frames * 2
    if pattern == "blocked":
        return [*frames[:-1], None]
    if pattern == "blinking":
        return [each for frame in frames for each in (frame, None)]
    if pattern == "every file twice":
        return [frame for frame in frames for _ in range(2)]
    return frames


def _shared_frames(rng: Random) -> list[File]:
    frames = [File(source.path) for source in rng.choice(FRAMES)]
    return frames[::-1] if rng.random() < 0.2 else frames


def _own_frames(subject: VolumeSubject, rng: Random) -> list[File]:
    first, pace = rng.choice((1, 1, 0, 95, 1001)), rng.choice((1, 1, 2))
    digits = rng.choice((1, 4, 4, 6))
    separator = rng.choice(("._", ".", "_"))
    folder = posixpath.dirname(subject.layer.path)
    stem = posixpath.join(folder, rng.choice(("", "vdb/", "sim v2/")) + subject.prim.name)
    numbers = range(first, first + pace * rng.randint(7, 12), pace)
    paths = [f"{stem}{separator}{number:0{digits}}.vdb" for number in numbers]
    subject.content.files.update(dict.fromkeys(paths, original(FRAME.path).read_bytes()))
    return list(map(File, paths))


def version_of(subject: VolumeSubject, source: Source, rng: Random) -> File:
    """One of several files that are numbered, but not by frames; of a library with its layer."""
    stem = posixpath.join(posixpath.dirname(subject.layer.path), subject.prim.name)
    words, step = rng.choice((*_VERSIONS, _ITEM))
    paths = [f"{stem}{words.format(step * number)}" for number in range(1, 6)]
    data = original(source.path).read_bytes()
    subject.content.files.update((f"{path}.vdb", data) for path in paths)
    chosen = rng.choice(paths)
    if words == _ITEM[0]:
        subject.layer.path = chosen + posixpath.splitext(subject.layer.path)[1]
    return File(f"{chosen}.vdb")


def add_clips(subject: VolumeSubject, choice: Choice, rng: Random) -> None:
    """One value clip for every few frames, or by a template for each frame.

    Without a manifest USD makes one itself.
    """
    each = 1 if choice.files == "template clips" else rng.randint(1, 3)
    frames = list(enumerate(_own_frames(subject, rng), start=1))
    folder = posixpath.dirname(subject.layer.path)
    stem = posixpath.join(folder, f"{subject.prim.name}_clip")
    clips = [
        _clip(subject, f"{stem}.{1 + first // each:03}.usda", dict(frames[first : first + each]))
        for first in range(0, len(frames), each)
    ]
    manifests = []
    if choice.files == "template clips" or rng.random() < 0.7:
        manifests.append(_clip(subject, f"{stem}.manifest.usda", {}))
    subject.content.layers += [*clips, *manifests]
    left_out = _left_out() if rng.random() < 0.3 else []
    bearer = subject.root if choice.place == "beside" else subject.prim
    bearer.metadata += [
        ("clips = {",),
        ("    dictionary default = {",),
        (f'        string primPath = "{subject.find(bearer)}"',),
        *_clip_set(choice, clips, each, len(frames)),
        *(("        asset manifestAssetPath = ", File(each.path)) for each in manifests),
        ("    }",),
        *left_out,
        ("}",),
        *([('clipSets = ["default"]',)] if left_out else []),
    ]
    for part in subject.fields:
        part.prim.properties.pop("fieldClass", None)
        part.prim.attribute("fieldDataType").value = "float"


def _left_out() -> list[Line]:
    """A set that USD would not use if `clipSets` did not leave it out anyway."""
    return [
        ("    dictionary old = {",),
        ('        asset[] assetPaths = ["./old.usda"]'.replace('"', "@"),),
        ('        string primPath = "/old"',),
        ("    }",),
    ]


def _clip_set(choice: Choice, clips: list[Layer], each: int, count: int) -> list[Line]:
    if choice.files == "template clips":
        name = posixpath.basename(clips[0].path)
        template = name.replace("001", "###")
        return [
            (f'        string templateAssetPath = "./{template}"',),
            ("        double templateStartTime = 1",),
            (f"        double templateEndTime = {len(clips)}",),
            ("        double templateStride = 1",),
        ]
    paths: list[str | File] = []
    for clip in clips:
        paths += [", " if paths else "", File(clip.path)]
    active = ", ".join(f"({1 + number * each}, {number})" for number in range(len(clips)))
    return [
        ("        asset[] assetPaths = [", *paths, "]"),
        (f"        double2[] active = [{active}]",),
        (f"        double2[] times = [(1, 1), ({count}, {count})]",),
    ]


def _clip(subject: VolumeSubject, path: str, samples: Mapping[int, File]) -> Layer:
    """A layer of overs down to the fields; without samples it declares the attribute alone."""
    layer = Layer(path)
    for part in subject.fields:
        prims = layer.prims
        prim = Prim("")
        for name in part.path[1:].split("/"):
            known = [each for each in prims if each.name == name]
            prim = known[0] if known else Prim(name, specifier="over")
            prims += [] if known else [prim]
            prims = prim.children
        prim.properties["filePath"] = Attribute("asset", samples=dict(samples.items()))
        if samples:
            part.clips.append(prim.attribute("filePath"))
    return layer
