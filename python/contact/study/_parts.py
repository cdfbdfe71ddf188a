"""Writing results part by part to netCDF, Zarr and Parquet, without holding all of them in memory."""
from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable

import numpy as np
import xarray
from numpy.typing import NDArray

from ..errors import ContactError
from ._dataset import Request, assemble, chunks_of, coordinates_of, frames_of, survey
from ._failures import Tally
from ._space import Axis, Space, Values
from ._store import Keys, Store

#: Range of a part: a slice for each axis
Place = tuple[slice, ...]


def places(shape: tuple[int, ...], most: int) -> Iterator[Place]:
    """Consecutive parts of a grid of points: all of the last axes, a range of the axis before them, one value of the first axes.

    Parameters
    ----------
    shape
        Lengths of the axes.
    most
        Maximum number of points of a part; less than 1 counts as 1.
    """
    whole, inner = len(shape), 1
    while whole > 0 and inner * shape[whole - 1] <= most:
        whole -= 1
        inner *= shape[whole]
    if whole == 0:
        yield tuple(slice(0, length) for length in shape)
        return
    step = max(1, most // inner)
    for outer in np.ndindex(*shape[:whole - 1]):
        for first in range(0, shape[whole - 1], step):
            yield (*(slice(k, k + 1) for k in outer), slice(first, min(first + step, shape[whole - 1])),
                   *(slice(0, length) for length in shape[whole:]))


def part_of(space: Space, place: Place) -> Space:
    """The axes, restricted to a part."""
    return Space([Axis(axis.name, {path: values[stretch] for path, values in axis.columns.items()})
                  for axis, stretch in zip(space.axes, place)], space.rules, space.where)


def numbers_of(shape: tuple[int, ...], place: Place) -> slice:
    """The indices of the points of a part, which are consecutive."""
    if not shape:
        return slice(0, 1)
    first = int(np.ravel_multi_index([stretch.start for stretch in place], shape))
    return slice(first, first + int(np.prod([stretch.stop - stretch.start for stretch in place])))


class Writer:
    """Writes parts into a file, which appears under its name only when it is complete.

    Parameters
    ----------
    file
        Its path: .nc, .zarr or .parquet.
    coordinates
        Coordinates of the whole dataset.
    sizes
        Lengths of the axes of the whole dataset.
    """

    def __init__(self, file: str | os.PathLike[str], coordinates: xarray.Dataset, sizes: dict[str, int]) -> None:
        self._path, self._coordinates, self._sizes = Path(file), coordinates, sizes
        kinds: dict[str, Callable[[xarray.Dataset, Place], None]] = {".nc": self._netcdf, ".zarr": self._zarr,
                                                                     ".parquet": self._parquet}
        if self._path.suffix not in kinds:
            raise ContactError(f"{self._path}: results are written as .nc, .zarr or .parquet")
        self._add = kinds[self._path.suffix]
        self._beside = self._path.with_name(self._path.name + ".new")
        self._target: Any = None

    def add(self, part: xarray.Dataset, place: Place) -> None:
        """Write a part."""
        self._add(part.drop_vars("reasons"), place)

    def close(self, reasons: xarray.DataArray) -> None:
        """Write the texts of reasons, and rename the file to its final name."""
        suffix = self._path.suffix
        last = reasons.to_dataset(name="reasons").assign_attrs(self._coordinates.attrs)
        if suffix == ".nc":
            self._target.close()
            last.to_netcdf(self._beside, mode="a", engine="netcdf4")
        elif suffix == ".zarr":
            last.to_zarr(self._beside, mode="a", consolidated=False)
            if self._path.exists():
                shutil.rmtree(self._path)
        elif self._target is not None:
            self._target.close()
        self._target = None
        os.replace(self._beside, self._path)

    def abandon(self) -> None:
        """Remove the incomplete file."""
        if self._target is not None and self._path.suffix != ".zarr":
            self._target.close()
        if self._beside.is_dir():
            shutil.rmtree(self._beside)
        elif self._beside.exists():
            self._beside.unlink()

    def _shape(self, values: xarray.DataArray) -> tuple[int, ...]:
        """Shape of a variable in the whole dataset"""
        return tuple(self._sizes.get(str(name), length) for name, length in zip(values.dims, values.shape))

    def _stretch(self, values: xarray.DataArray, place: Place) -> tuple[slice, ...]:
        """Slices of the values of a part in the whole dataset"""
        stretches = dict(zip(self._sizes, place))
        return tuple(stretches.get(str(name), slice(None)) for name in values.dims)

    def _netcdf(self, part: xarray.Dataset, place: Place) -> None:
        import netCDF4
        if self._target is None:
            self._coordinates.to_netcdf(self._beside, engine="netcdf4")
            self._target = netCDF4.Dataset(self._beside, "a")
            for name, length in part.sizes.items():
                if name not in self._target.dimensions:
                    self._target.createDimension(str(name), self._sizes.get(str(name), length))
            for name, values in part.data_vars.items():
                made = self._target.createVariable(
                    str(name), values.dtype, values.dims, zlib=values.ndim > 0, complevel=1,
                    chunksizes=chunks_of(self._shape(values)) or None, fill_value=np.nan if values.dtype.kind == "f" else None)
                made.setncatts(values.attrs)
        for name, values in part.data_vars.items():
            self._target[str(name)][self._stretch(values, place)] = values.values

    def _zarr(self, part: xarray.Dataset, place: Place) -> None:
        if self._target is None:
            self._target = True
            import dask.array
            lazy = {name: (values.dims, dask.array.zeros(self._shape(values), dtype=values.dtype), values.attrs)
                    for name, values in part.data_vars.items()}
            encoding = {name: {"chunks": chunks_of(self._shape(values))} for name, values in part.data_vars.items() if values.ndim}
            self._coordinates.assign(lazy).to_zarr(self._beside, mode="w", compute=False, encoding=encoding,
                                                         consolidated=False)
        import zarr
        group = zarr.open_group(self._beside, mode="r+")
        for name, values in part.data_vars.items():
            found: Any = group[str(name)]
            found[self._stretch(values, place) or ...] = values.values

    def _parquet(self, part: xarray.Dataset, place: Place) -> None:
        import pyarrow.parquet
        for content in frames_of(part, {name: stretch.start for name, stretch in zip(self._sizes, place)}):
            if self._target is None:
                self._target = pyarrow.parquet.ParquetWriter(self._beside, content.schema)
            self._target.write_table(content)


def write_parts(files: list[str | os.PathLike[str]], store: Store, keys: Keys, chosen: NDArray[np.bool_], space: Space,
                columns: dict[str, Values], requested: Request, derived: Callable[[xarray.Dataset], xarray.Dataset],
                memory: int) -> Tally:
    """Write results to files, one part at a time.

    Parameters
    ----------
    files
        Paths of the files; if empty, cases are counted only.
    store, keys, chosen, space, columns, requested
        As for `assemble`.
    derived
        Adds the derived quantities to a part.
    memory
        Approximate memory of a part [bytes].
    """
    whole = survey(store, keys, requested)
    coordinates = coordinates_of(space, columns, requested.scene, whole.patches)
    values = sum(whole.patches if has_patches and not of_pair else 1 for _, of_pair, has_patches in whole.columns.values())
    values += len(requested.fields) * whole.patches * whole.elements[0] * whole.elements[1]
    most = max(1, memory // (8 * (values + 8) * requested.scene.steps))
    tally = Tally(space.shape + ((requested.scene.steps,) if requested.scene.steps > 1 else ()),
                  [axis.name for axis in space.axes] + (["step"] if requested.scene.steps > 1 else []))
    writers = [Writer(file, coordinates, {axis.name: len(axis) for axis in space.axes}) for file in files]
    reasons = xarray.DataArray()
    try:
        for place in places(space.shape, most):
            points = numbers_of(space.shape, place)
            one = replace(whole, batch=whole.batch[points])
            part = derived(assemble(store, keys[points], chosen[points], part_of(space, place),
                                    {path: all_values[points] for path, all_values in columns.items()}, requested, one))
            tally.add(part, points.start * requested.scene.steps)
            for writer in writers:
                writer.add(part, place)
            reasons = part["reasons"]
        for writer in writers:
            writer.close(reasons)
    except BaseException:
        for writer in writers:
            writer.abandon()
        raise
    return tally
