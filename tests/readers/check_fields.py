#!/usr/bin/python3
"""Reads density.vdb (OpenVDB) and density.vti (VTK, where it is installed) and compares both with density.npy.

    apt-get install python3-openvdb python3-numpy      # python3-vtk9 too, for the VTI
    /usr/bin/python3 check_fields.py FOLDER            # exits 1, with one line, where a bit differs

The array is C-ordered [z][y][x]; cells of which any bit is set are the active voxels of the VDB.
"""
import sys
from pathlib import Path

import numpy

try:
    import pyopenvdb as openvdb  # Debian 12
except ImportError:
    import openvdb


def fail(message):
    print(message)
    sys.exit(1)


def same(what, found, expected):
    """Both are indexed [z][y][x]."""
    if found.shape != expected.shape:
        fail(f"{what}: {found.shape} cells, not {expected.shape}")
    found = numpy.ascontiguousarray(found, dtype="<f4")
    different = numpy.argwhere(found.view("<u4") != expected.view("<u4"))
    if len(different):
        z, y, x = different[0]
        first = f"first x={x} y={y} z={z}: {found[z, y, x]}, not {expected[z, y, x]}"
        fail(f"{what}: {len(different)} cells differ, {first}")


def check_vdb(path, expected):
    """Returns where the centre of the first cell is, and the size of a cell."""
    grids, _ = openvdb.readAll(str(path))
    if len(grids) != 1:
        fail(f"{path}: {len(grids)} grids, not 1")
    grid = grids[0]
    for what, found, wanted in [
        ("type", grid.valueTypeName, "float"),
        ("class", grid.gridClass, openvdb.GridClass.FOG_VOLUME),
        ("background", grid.background, 0.0),
        ("active voxels", grid.activeVoxelCount(), numpy.count_nonzero(expected.view("<u4"))),
        ("voxels by its metadata", grid["file_voxel_count"], grid.activeVoxelCount()),
        ("name", grid["name"], grid.name),
    ]:
        if found != wanted:
            fail(f"{path}: {what} is {found}, not {wanted}")
    if grid.activeVoxelCount():
        at = numpy.argwhere(expected.view("<u4"))[:, ::-1]
        box = (tuple(at.min(axis=0)), tuple(at.max(axis=0)))
        for what, found in [
            ("voxels", grid.evalActiveVoxelBoundingBox()),
            ("metadata", (grid["file_bbox_min"], grid["file_bbox_max"])),
        ]:
            if found != box:
                fail(f"{path}: the box of its {what} is {found}, not {box}")
    values = numpy.full(expected.shape[::-1], -1, dtype="<f4")
    grid.copyToArray(values)
    same(path, values.transpose(), expected)
    first = grid.transform.indexToWorld((0, 0, 0))
    size = grid.transform.voxelSize()
    steps = [grid.transform.indexToWorld(step) for step in [(1, 0, 0), (0, 1, 0), (0, 0, 1)]]
    for axis, step in enumerate(steps):
        moved = tuple(along + (size[axis] if k == axis else 0) for k, along in enumerate(first))
        if not numpy.allclose(step, moved, rtol=1e-12, atol=1e-12 * size[axis]):
            fail(f"{path}: a step along axis {axis} leads to {step}, not {moved}")
    return first, size


def check_vti(path, expected, first, size):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    vtkObject.GlobalWarningDisplayOff()  # what is wrong is said in one line, below
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    array = image.GetCellData().GetScalars()
    if array is None or array.GetDataTypeAsString() != "float":
        fail(f"{path}: no floats in its cells")
    counts = tuple(points - 1 for points in image.GetDimensions())
    same(path, vtk_to_numpy(array).reshape(counts[::-1]), expected)
    if image.GetSpacing() != tuple(size):
        fail(f"{path}: its spacing is {image.GetSpacing()}, the VDB's {tuple(size)}")
    # VTK itself says where the first cell lies.
    bounds = image.GetCell(0).GetBounds()
    centre = [0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]) for axis in range(3)]
    if not numpy.allclose(centre, first, rtol=1e-12, atol=1e-12 * size[0]):
        fail(f"{path}: its first cell is centred in {centre}, the VDB's in {first}")


def main():
    if len(sys.argv) != 2:
        print("usage: check_fields.py FOLDER")
        sys.exit(2)
    folder = Path(sys.argv[1])
    try:
        expected = numpy.load(folder / "density.npy")
        if expected.dtype != numpy.dtype("<f4") or expected.ndim != 3 or not expected.flags.c_contiguous:
            fail(f"{folder}/density.npy: not a C-ordered [z][y][x] array of 32-bit floats")
        first, size = check_vdb(folder / "density.vdb", expected)
        checked = "vdb"
        try:
            import vtkmodules  # noqa: F401
        except ImportError:
            checked += " (vtk is not installed: vti not read)"
        else:
            check_vti(folder / "density.vti", expected, first, size)
            checked += " and vti"
    except Exception as error:  # a reader's own refusal
        fail(f"{folder}: {error!r}")
    cells = f"{expected.shape[::-1]} cells of {size[0]} m, first centred in {first}"
    print(f"{folder}: {checked} equal to the last bit, {cells}")


main()
