"""The value clips that reach a prim: its own and those of its ancestors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from pxr import Sdf, Usd


@dataclass(frozen=True, slots=True)
class ClipSet:
    """One clip set as authored on `prim`: asset paths are as USD resolved them."""

    prim: Any
    name: str
    prim_path: str
    clips: tuple[Any, ...]
    manifest: Any | None

    def layer_path(self, prim: Any) -> Any:
        """Where the values of `prim`, this one or one below it, lie in the clip layers."""
        return prim.GetPath().ReplacePrefix(self.prim.GetPath(), Sdf.Path(self.prim_path))


def clip_sets_on(prim: Any) -> tuple[ClipSet, ...]:
    """The clip sets authored on this very prim."""
    if not prim.HasAuthoredMetadata("clips"):
        return ()
    api = Usd.ClipsAPI(prim)
    found = []
    for name in sorted(api.GetClips() or ()):
        prim_path = api.GetClipPrimPath(name)
        if prim_path and Sdf.Path.IsValidPathString(prim_path):
            manifest = api.GetClipManifestAssetPath(name)
            paths = tuple(api.ComputeClipAssetPaths(name) or ())
            named = manifest is not None and bool(manifest.path)
            found.append(ClipSet(prim, name, prim_path, paths, manifest if named else None))
    return tuple(found)


class Clips:
    """Clip sets by prim, each ancestor looked at once."""

    def __init__(self) -> None:
        self._reaching: dict[Any, tuple[ClipSet, ...]] = {}

    def reaching(self, prim: Any) -> tuple[ClipSet, ...]:
        """The clip sets on the prim and its ancestors, nearest first."""
        if prim.IsPseudoRoot():
            return ()
        path = prim.GetPath()
        if path not in self._reaching:
            self._reaching[path] = clip_sets_on(prim) + self.reaching(prim.GetParent())
        return self._reaching[path]
