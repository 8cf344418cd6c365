"""What rules ask of contents is the same for all of one class: it is asked of the first.

`contents(key)` and `grouped(key)` take functions of a content: `ContentClass` answers them once.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Hashable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import pytest
from process import ROOT

from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.grids.contents import Content, ContentClass
from usdvol_lint.facts.grids.reader import ContentReader
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.packs.examples import STAGE, cases, pages
from usdvol_lint.rule import Rule
from usdvol_lint.run.testing import write_example
from usdvol_lint.volumefile.cache import layout_of
from usdvol_lint.volumefile.model import Grid, Metadatum, VolumeFile
from usdvol_lint.volumefile.transform import Transform, scale_translate

Key: TypeAlias = Callable[[Content], Hashable | None]
RULES = ROOT / "rules"
SAMPLES = [path for path in sorted((ROOT / "tests" / "samples").iterdir()) if path.stem != "README"]
NAMES = ("", "density", "nope")
CLAIMS = ("", "float", "fogVolume", "Point", "1", "cloud")


class Met(NamedTuple):
    """The keys that rules asked for, and the contents of each class."""

    keys: dict[Key, None]
    classes: dict[ContentClass, list[Content]]


@pytest.fixture(scope="module")
def met(engine: Engine, assets: Path, tmp_path_factory: pytest.TempPathFactory) -> Met:
    """Those of all examples that name files, and of all samples, whole, cut and of any version."""
    met = Met({}, {})
    answer, find = ContentClass.answer, ContentReader._class_of

    def noting_answer(asked: ContentClass, key: Key) -> Any:
        met.keys[key] = None
        return answer(asked, key)

    def noting_class(reader: ContentReader, content: Content) -> ContentClass:
        found = find(reader, content)
        met.classes.setdefault(found, []).append(content)
        return found

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ContentClass, "answer", noting_answer)
        patch.setattr(ContentReader, "_class_of", noting_class)
        for stage in stages(tmp_path_factory.mktemp("contents"), assets):
            assert engine.lint(str(stage)).status == "checked"
    return met


def stages(folder: Path, assets: Path) -> Iterator[Path]:
    examples = [case for page in pages(RULES) for case in cases(page)]
    naming_files = [case for case in examples if "filePath" in "".join(case.texts.values())]
    for number, case in enumerate(naming_files):
        write_example(case, folder / str(number), assets)
        yield folder / str(number) / STAGE
    yield samples(folder / "samples")


def samples(folder: Path) -> Path:
    """A stage whose fields name all files and say of them whatever they may say."""
    folder.mkdir()
    names = [name for sample in SAMPLES for name in write_sample(sample, folder)]
    frames = ", ".join(f"{frame}: @./{name}@" for frame, name in enumerate(names))
    fields = [
        f'def {kind} "{kind}{n}"\n{{\nasset filePath.timeSamples = {{ {frames} }}\n{claims}\n}}\n'
        for kind in ("OpenVDBAsset", "Field3DAsset")
        for n, claims in enumerate(every_claim())
    ]
    (folder / STAGE).write_text("#usda 1.0\n" + "".join(fields), encoding="utf-8")
    return folder / STAGE


def write_sample(sample: Path, folder: Path) -> Iterator[str]:
    """A sample as it is and cut in several places; if it is OpenVDB, in other versions too."""
    data = sample.read_bytes()
    versions = [data]
    if sample.suffix == ".vdb":
        versions += [data[:8] + bytes([number]) + data[9:] for number in (100, 221, 226)]
    for version, text in enumerate(versions):
        for length in (len(data), len(data) - 10, len(data) - 20, 40):
            name = f"{sample.stem}_{version}_{length}{sample.suffix}"
            (folder / name).write_bytes(text[:length])
            yield name


def every_claim() -> Iterator[str]:
    for name in NAMES:
        for claim in CLAIMS:
            yield "\n".join(
                [
                    f'token fieldName = "{name}"' if name else "",
                    f'token fieldDataType = "{claim}"' if claim else "",
                    f'token fieldClass = "{claim}"' if claim else "",
                    f'token vectorDataRoleHint = "{claim}"' if claim else "",
                    f'token fieldPurpose = "{claim}"' if claim == "cloud" else "",
                    f"int fieldIndex = {claim}" if claim.isdigit() else "",
                ]
            )


def test_all_keys_were_met(met: Met, catalog: Catalog) -> None:
    """Those of every rule that goes by contents and has one, and there is something to compare."""

    def module(rule: Rule) -> str:
        return inspect.getmodule(rule.check).__name__  # type: ignore[union-attr]

    rules = [rule for rule in catalog.rules.values() if rule.when]
    by_contents = {module(rule) for rule in rules if rule.when.keys is Grids.content_classes}
    without_key = {module(catalog.rules["GRD013"])}  # it counts classes
    by_other_keys = {module(catalog.rules[code]) for code in ("AST006", "FLD001")}
    assert (by_contents | by_other_keys) - without_key == {
        key.__module__ for key in met.keys if ".rules." in key.__module__
    }
    assert len(by_contents) > 10
    assert sum(len(contents) > 1 for contents in met.classes.values()) > 100


def test_contents_of_one_class_have_the_same_answers(met: Met) -> None:
    for contents in met.classes.values():
        for key in met.keys:
            first, *others = contents
            for other in others:
                assert key(other) == key(first), said(key, first, other)


def test_what_classes_do_not_go_by_changes_no_answer(met: Met) -> None:
    """Each part of a file that may differ among contents of one class, one by one."""
    changed: set[str] = set()
    for content in {str(identity(each)): each.content for each in met.classes}.values():
        for name, other in others_of_its_class(content):
            changed.add(name)
            for key in met.keys:
                assert key(other) == key(content), f"{name}: {said(key, content, other)}"
    assert {"index_bounds", "transform", "metadata", "time"} <= changed


def identity(content_class: ContentClass) -> tuple[Any, ...]:
    """What tells classes of several stages apart."""
    _, claim, reading, wanted = content_class.content
    return (
        layout_of(reading.file, reading.fault),
        claim,
        wanted,
        content_class.content.unexpected_format,
        content_class.content.swapped_format,
    )


# What a reader makes of other parts, such as `registered` of the type, differs only with these.
OTHER = {
    "library": "11.0",
    "uuid": "another",
    "metadata": {"another": Metadatum("string", "value", 5)},
    "streamed": True,
    "index_bounds": ((-7, -7, -7), (7, 7, 7)),
    "transform": Transform("UniformScaleMap", scale_translate((2, 3, 4), (5, 6, 7))),
}


def others_of_its_class(content: Content) -> Iterator[tuple[str, Content]]:
    """Contents with another value in one place, and the name of that place."""
    sample, file = content.sample, content.reading.file
    yield "time", content._replace(sample=sample._replace(time=4711.0))
    yield "authored", content._replace(sample=sample._replace(authored="@./another@"))
    if file is not None:
        for name, changed in changes(file):
            if layout_of(changed, content.reading.fault) == layout_of(file, content.reading.fault):
                yield name, content._replace(reading=content.reading._replace(file=changed))


def changes(file: VolumeFile) -> Iterator[tuple[str, VolumeFile]]:
    for name in OTHER.keys() & set(VolumeFile._fields):
        yield name, file._replace(**{name: OTHER[name]})
    for name in OTHER.keys() & set(Grid._fields):
        grids = tuple(grid._replace(**{name: OTHER[name]}) for grid in file.grids)
        yield name, file._replace(grids=grids)


def said(key: Key, *contents: Content) -> str:
    files = ", ".join(f"{content.sample.path} ({content.claim})" for content in contents)
    return f"{key} tells apart {files}"
