"""A seed and a number become a scene, and what must be found of it."""

from __future__ import annotations

from random import Random
from typing import Any, NamedTuple

from .arcs import ARCS, say_rates
from .defects import DEFECTS
from .defects.declaration import Defect
from .model import Expected, File, Layer, Prim, Scene
from .neighbours import NEIGHBOURS
from .particles import LOOKS, particles
from .placing import Arc, Placed, place
from .sequences import PATTERNS
from .subjects import Subject
from .volumes import FILES, MOVEMENTS, PLACES, volume


class Generated(NamedTuple):
    """A scene; `features` are the kinds that went into it, `defect` is the name of its defect."""

    scene: Scene
    expected: Expected
    features: frozenset[str]
    defect: str | None

    @property
    def story(self) -> str:
        return f"{self.defect or 'valid'}; {', '.join(sorted(self.features))}"


FEATURES = frozenset(
    {
        *(f"arc {arc.name}" for arc in ARCS),
        *(f"files {name}" for name in FILES),
        *(f"fields {name}" for name in PLACES),
        "fields shared",
        *(f"particles {name}" for name in LOOKS),
        *(f"sequence {name}" for name in PATTERNS),
        *(f"movement {name}" for name in MOVEMENTS),
        *(f"beside {each.name}" for each in NEIGHBOURS),
        *("particles float", "particles half", "particles animated", "particles changing"),
        *(f"degree {degree}" for degree in range(4)),
    }
)
"""Every kind of what is right."""


def generate(seed: int, number: int) -> Generated:
    """Even numbers are valid, odd ones have a defect; each kind has its turn."""
    rng = Random(f"{seed}/{number}")
    turn = number // 2
    if number % 2 == 0:
        return _Making(rng).valid(turn)
    return _Making(rng).defective(DEFECTS[turn % len(DEFECTS)])


class _Making:
    """One scene in the making."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.scene = Scene()
        self.features: set[str] = set()

    def valid(self, turn: int) -> Generated:
        """One to three subjects, in arcs of every kind."""
        first = ARCS[turn % len(ARCS)]
        round_, number = divmod(turn, len(FILES))
        # Moved on by one after all patterns: else some of them would never meet a Volume.
        pattern = (round_ + round_ // len(PATTERNS)) % len(PATTERNS)
        needs = {"files": FILES[number], "pattern": PATTERNS[pattern]}
        placed = []
        for index in range(self.rng.choice((1, 1, 2, 3))):
            is_volume = turn % 5 if index == 0 else self.rng.random() < 0.5
            subject = self._subject("volume" if is_volume else "particles", index, needs)
            placed.append(self._arranged(subject, index, [first, *self._arcs(2)]))
            first, needs = self.rng.choice(ARCS), {}
        self._combine(placed)
        return self._result(Expected(), None)

    def defective(self, defect: Defect) -> Generated:
        """One subject with the defect, and perhaps another that is right."""
        is_on_scene = defect.on == "scene"
        kind = self.rng.choice(("volume", "particles")) if is_on_scene else defect.on
        needs = {"pattern": "plain", "twin": False, "look": "plain"} | {
            name: self.rng.choice(wanted) if isinstance(wanted, tuple) else wanted
            for name, wanted in defect.needs.items()
        }
        subject = self._subject(kind, 0, needs)
        made = [] if is_on_scene else defect.make(subject, self.rng) or subject.prim
        paths = [subject.find(each) for each in (made if isinstance(made, list) else [made])]
        arcs = [arc for arc in ARCS if arc.name == defect.within]
        arcs += [arc for arc in self._arcs(3) if arc.name not in defect.without]
        placed = [self._arranged(subject, 0, arcs)]
        shown = [placed[0].shown(path) for path in paths]
        if self.rng.random() < 0.3:
            other = self._subject(self.rng.choice(("volume", "particles")), 1, {})
            placed.append(self._arranged(other, 1, self._arcs(2)))
        root = self._combine(placed, is_on_scene, subject.time_range)
        if is_on_scene and root:
            prim = defect.make(self.scene, root, self.rng)
            shown = [f"/{prim.name}"] if isinstance(prim, Prim) else []
        levels = (defect.also, defect.perhaps, defect.is_info)
        expected = Expected(defect.code, next(iter(shown), None), *levels, tuple(shown[1:]))
        return self._result(expected, defect.name)

    def _result(self, expected: Expected, defect: str | None) -> Generated:
        self._say_rates()
        return Generated(self.scene, expected, frozenset(self.features), defect)

    def _say_rates(self) -> None:
        package = self.scene.packages.get(self.scene.root)
        root = package.layers[0].path if package else self.scene.root
        say_rates([self.scene, *self.scene.packages.values()], root)

    def _arcs(self, most: int) -> list[Arc]:
        return [self.rng.choice(ARCS) for _ in range(self.rng.randint(0, most))]

    def _subject(self, kind: str, index: int, needs: dict[str, Any]) -> Subject:
        name = f"{'abc'[index]}{self.rng.choice(('sset', 'set', 'shot'))}"
        if kind == "volume":
            made = volume(self.rng, name, needs)
            files, place, _, pattern, movement, _ = made.choice
            self.features |= {f"files {files}", f"fields {place}", f"movement {movement}"}
            self.features |= {f"sequence {pattern}"} if files == "own sequence" else set()
            has_twin = any(each.name.endswith("_twin") for each in made.root.children)
            self.features |= {"fields shared"} if has_twin else set()
            return made
        splat = particles(self.rng, name, needs)
        self.features.add(f"particles {splat.look}")
        positions = splat.name_of("positions")
        self.features |= {f"particles {'half' if positions.endswith('h') else 'float'}"}
        self.features |= {f"degree {splat.degree}"} if splat.degree < 4 else set()
        if splat.prim.attribute(positions).samples:
            self.features.add("particles changing" if splat.is_changing else "particles animated")
        return splat

    def _arranged(self, subject: Subject, index: int, arcs: list[Arc]) -> Placed:
        """The subject in its arcs, from the inside out, its content added to the scene."""
        own = Scene(subject.content.layers, subject.content.files)
        placed = place(subject)
        for number, arc in enumerate(arcs):
            placed = arc.wrap(own, placed, f"{subject.root.name}_{index}{number}", self.rng)
            self.features.add(f"arc {arc.name}")
        self.scene.layers += own.layers
        self.scene.files |= own.files
        self.scene.packages |= own.packages
        return placed

    def _combine(
        self,
        placed: list[Placed],
        needs_layer: bool = False,
        time_range: tuple[float, float] | None = None,
    ) -> Layer | None:
        """The root layer: that of the only subject, or a new one that brings all together."""
        needs_layer |= time_range is not None
        if len(placed) == 1 and not needs_layer and self.rng.random() < 0.5:
            self.scene.root = placed[0].layer_path
            return placed[0].layer
        layer = Layer(f"shot.{self.rng.choice(('usda', 'usda', 'usda', 'usdc', 'usd'))}")
        sublayers: list[str | File] = []
        for each in placed:
            if each.layer:
                sublayers += [", " if sublayers else "", File(each.layer_path)]
            else:
                line = ("prepend references = ", File(each.layer_path), f"<{each.root}>")
                layer.prims.append(Prim(each.root[1:], metadata=[line]))
        if sublayers:
            layer.metadata.append(("subLayers = [", *sublayers, "]"))
        self._add_neighbours(layer)
        if self.rng.random() < 0.3:
            time_range = time_range or (-20_000, 90_000)
        if time_range:
            start, end = time_range
            layer.metadata += [(f"startTimeCode = {start}",), (f"endTimeCode = {end}",)]
        self.scene.layers.append(layer)
        self.scene.root = layer.path
        return layer

    def _add_neighbours(self, layer: Layer) -> None:
        for each in self.rng.sample(NEIGHBOURS, self.rng.randint(0, 3)):
            layer.prims.append(each.make(self.rng))
            self.features.add(f"beside {each.name}")
