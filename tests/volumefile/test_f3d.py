"""The Field3D readers against files of the library's own, in both containers."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from typing import Any

import pytest
from attempts import Reader, refusal, refusal_of_file
from process import SAMPLES

from usdvol_lint.volumefile import Grid, read_volume_file

OGAWA = SAMPLES / "f3d_ogawa.f3d"
HDF5 = SAMPLES / "f3d_hdf5.f3d"
HAS_H5PY = importlib.util.find_spec("h5py") is not None
needs_h5py = pytest.mark.skipif(not HAS_H5PY, reason="h5py is not installed")


def summary(grids: tuple[Grid, ...]) -> list[tuple[Any, ...]]:
    return sorted(
        (grid.purpose, grid.name, grid.tree_type, grid.value_type, grid.index_bounds)
        for grid in grids
    )


WINDOW = ((0, 1, 2), (5, 6, 7))
LAYERS = [
    ("cloud", "density", "DenseField", "float", WINDOW),
    ("cloud", "density", "SparseField", "float", WINDOW),
    ("cloud", "heat", "DenseField", "double", WINDOW),
    ("cloud", "temperature", "SparseField", "half", WINDOW),
    ("smoke", "v", "DenseField", "vec3s", WINDOW),
    ("smoke", "vd", "DenseField", "vec3d", WINDOW),
    ("smoke", "vh", "SparseField", "vec3h", WINDOW),
]


@pytest.mark.parametrize("path", [OGAWA, pytest.param(HDF5, marks=needs_h5py)])
def test_samples(path: Path) -> None:
    file = read_volume_file(str(path))
    assert (file.format, file.version, file.version_number) == ("field3d", "1.7.3", 10703)
    assert (file.grid_count, file.complete, file.newer) == (7, True, None)
    assert summary(file.grids) == LAYERS
    namesakes = [grid.tree_type for grid in file.grids if grid.name == "density"]
    assert namesakes == ["DenseField", "SparseField"]  # in the order of the file
    for grid in file.grids:
        assert grid.metadata["note"].value == "hello"
        assert grid.metadata["n"].value == 3
        assert grid.metadata["x"].value == 1.5
        assert grid.transform is not None
        assert (grid.transform.map_type, grid.transform.linear) == ("MatrixFieldMapping", True)
        # The matrix scales the unit cube, which spans all voxels of the extents, by 2, 3, 4.
        move = 10 if (grid.name, grid.tree_type) == ("density", "SparseField") else 0
        low, high = grid.transform.bounds((-2.5, -0.5, 0.5), (9.5, 7.5, 12.5))
        assert low == pytest.approx((move, 0, 0), abs=1e-12)
        assert high == pytest.approx((move + 2, 3, 4), abs=1e-12)


@needs_h5py
def test_both_containers_say_the_same() -> None:
    ogawa, hdf5 = read_volume_file(str(OGAWA)), read_volume_file(str(HDF5))
    assert summary(ogawa.grids) == summary(hdf5.grids)
    by_name = {(grid.purpose, grid.name, grid.tree_type): grid for grid in hdf5.grids}
    for grid in ogawa.grids:
        other = by_name[grid.purpose, grid.name, grid.tree_type]
        assert grid.transform == other.transform
        assert grid.world_bounds(0.5) == other.world_bounds(0.5)


def test_hdf5_without_h5py(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "h5py", None)
    assert refusal_of_file(HDF5).code == "needs-h5py"
    assert refusal_of_file(HDF5, 0, HDF5.stat().st_size - 1).code == "truncated"


@needs_h5py
def test_hdf5_of_another_kind(tmp_path: Path) -> None:
    import h5py

    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.attrs["note"] = "hello"
    assert refusal_of_file(tmp_path / "other.h5").code == "not-a-volume-file"


@needs_h5py
def test_hdf5_links_lead_nowhere(tmp_path: Path) -> None:
    import h5py

    with h5py.File(tmp_path / "links.f3d", "w") as file:
        file.attrs["version_number"] = [1, 7, 3]
        file["cloud.0"] = h5py.ExternalLink(str(HDF5), "/cloud.0")
        file["loop"] = file["/"]
        file["soft"] = h5py.SoftLink("/loop")
    assert read_volume_file(str(tmp_path / "links.f3d")).grids == ()


@needs_h5py
def test_hdf5_values_too_large_to_matter(tmp_path: Path) -> None:
    import h5py
    import numpy as np

    with h5py.File(tmp_path / "large.f3d", "w", libver="latest") as file:
        file.attrs["version_number"] = [1, 7, 3]
        layer = file.create_group("p.0/a")
        file["p.0"].attrs["is_field3d_partition"] = "1"
        layer.attrs["class_type"] = np.bytes_(b"field3d_layer")
        layer.attrs["large"] = np.zeros(1 << 18)
        layer.attrs["words"] = ["two", "words"]
    (grid,) = read_volume_file(str(tmp_path / "large.f3d")).grids
    assert (grid.purpose, grid.name, grid.transform) == ("p", "a", None)
    assert (grid.metadata["large"].value, grid.metadata["words"].value) == (None, None)


@needs_h5py
def test_hdf5_of_endless_groups(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from usdvol_lint.volumefile import hdf5

    monkeypatch.setattr(hdf5, "MOST", 20)
    assert refusal_of_file(HDF5).code == "not-a-volume-file"


@needs_h5py
def test_hdf5_with_garbage_inside(read: Reader) -> None:
    content = HDF5.read_bytes()
    assert refusal(read, content[:96] + b"\xff" * (len(content) - 96)).code == "not-a-volume-file"


def test_every_cut_is_noticed() -> None:
    for path in (OGAWA, HDF5):
        for cut in [*range(1, 700), *range(701, path.stat().st_size, 97)]:
            assert refusal_of_file(path, 0, cut).code == "truncated", (path, cut)
