"""Writes the frames of the example shot into a folder: python3 frames.py FOLDER, with pyopenvdb."""

import sys
from itertools import product
from pathlib import Path

import pyopenvdb as vdb

VOXEL_SIZE = 0.25
FRAMES = range(1, 9)


def puff(frame: int) -> vdb.FloatGrid:
    """A ball of smoke that rises and grows; all of it lies in one leaf, which keeps files small."""
    density = vdb.FloatGrid()
    density.name = "density"
    density.gridClass = vdb.GridClass.FOG_VOLUME
    density.transform = vdb.createLinearTransform(voxelSize=VOXEL_SIZE)
    voxels = density.getAccessor()
    radius = 1.2 + 0.25 * frame
    centre = (3.5, 1.0 + 0.4 * frame, 3.5)
    for voxel in product(range(8), repeat=3):
        distance = sum((a - b) ** 2 for a, b in zip(voxel, centre, strict=True)) ** 0.5
        if distance < radius:
            voxels.setValueOn(voxel, round(1.0 - distance / radius, 3))
    return density


def main(folder: Path) -> None:
    for frame in FRAMES:
        density = puff(frame)
        density.addStatsMetadata()
        temperature = density.copy()  # shares its voxels, in the file too
        temperature.name = "temperature"
        vdb.write(str(folder / f"puff.{frame:04d}.vdb"), [density, temperature])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
