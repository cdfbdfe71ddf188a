"""Results as an xarray dataset, and its files."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from .._signatures import VERSION
from ..errors import ContactError
from ._scene import Scene
from ._space import Space, Values
from ._store import Keys, Places, Store
from ._task import Done

#: Values of the variable status
STATUS = {-2: "not computed", -1: "left out", 0: "solved", 1: "not converged", 2: "refused"}
#: What is kept of each column beyond its values
_Table = dict[str, tuple[NDArray[Any], dict[str, str], bool]]
#: Elements of a chunk of a file, at most
_CHUNK = 1 << 18


def assemble(store: Store, keys: Keys, chosen: NDArray[np.bool_], space: Space, columns: dict[str, Values], scene: Scene,
             totals: list[str] | None, fields: tuple[str, ...]) -> xarray.Dataset:
    """The dataset of a study, from what is in its store."""
    steps = scene.steps
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.ravel()
    places = Places(keys[first])
    most = _most_patches(store, places) if scene.is_wheel_rail else 1
    status = np.full((len(first), steps), -2, dtype=np.int8)
    missed = np.zeros((len(first), steps), dtype=np.int8)
    reason = np.zeros((len(first), steps), dtype=np.int32)
    sentences: dict[str, int] = {"": 0}
    found: _Table = {}
    kept: dict[str, dict[tuple[int, int], Any]] = {name: {} for name in fields}
    units: dict[str, str] = {}
    for done in store.batches():
        at = places.of(done.keys)
        use = np.flatnonzero(at >= 0)
        status[at[use]], missed[at[use]] = done.states[use, :, 0], done.states[use, :, 1]
        for place, text in done.reasons.items():
            point, step = map(int, place.split(","))
            if at[point] >= 0:
                reason[at[point], step] = sentences.setdefault(text, len(sentences))
        _take_columns(done, at, found, totals, (len(first), steps, most))
        units.update(done.units)
        for name, values in done.arrays.items():
            word, point_text, _, patch = name.split(",")
            if word in kept and at[int(point_text)] >= 0:
                kept[word][int(at[int(point_text)]), int(patch) - 1] = (values, done.frames[name])
    if totals is not None:
        missing = [name for name in totals if name not in found]
        if missing and found:
            raise ContactError(f"there is no total {', '.join(missing)}")
    status[~_known(chosen, inverse, len(first))] = -1
    status_of, reason_of = status[inverse], reason[inverse]
    status_of[~chosen] = -1
    shape, dims = space.shape, tuple(axis.name for axis in space.axes)
    step_dims = ("step",) if steps > 1 else ()
    step_shape = (steps,) if steps > 1 else ()
    data: dict[str, Any] = {}
    taken = {*space.short.values(), *dims}
    for name, (values, attributes, of_pair) in found.items():
        if name in taken:
            # a total of the same name as an input: the creepage that was found, and the one that was given
            name += "_result"
        patch_dims = ("patch",) if scene.is_wheel_rail and not of_pair else ()
        values = values[inverse]
        values[~chosen] = np.nan
        data[name] = (dims + step_dims + patch_dims, values.reshape(shape + step_shape + values.shape[2:]), attributes)
    data["status"] = (dims + step_dims, status_of.reshape(shape + step_shape), {
        "long_name": "how the case ended", "flag_values": np.array(list(STATUS), dtype=np.int8),
        "flag_meanings": " ".join(word.replace(" ", "_") for word in STATUS.values())})
    data["missed"] = (dims + step_dims, missed[inverse].reshape(shape + step_shape), {
        "long_name": "what did not converge", "flag_values": np.arange(6, dtype=np.int8),
        "flag_meanings": "none normal tangential outer force time"})
    data["reason"] = (dims + step_dims, reason_of.reshape(shape + step_shape), {"long_name": "place in reasons"})
    data["reasons"] = (("sentence",), np.array(list(sentences), dtype=object), {"long_name": "why cases were not solved"})
    _add_fields(data, kept, units, inverse, dims, shape, most, scene.is_wheel_rail)
    coordinates = _coordinates(space, columns)
    if scene.is_wheel_rail:
        coordinates["patch"] = ("patch", np.arange(1, most + 1))
    if steps > 1:
        coordinates["step"] = ("step", np.arange(1, steps + 1))
    return xarray.Dataset(data, coordinates, {"title": "study of rolling contact", "source": f"CONTACT {VERSION}"})


def _known(chosen: NDArray[np.bool_], inverse: NDArray[np.intp], count: int) -> NDArray[np.bool_]:
    """Which different points count at all"""
    known = np.zeros(count, dtype=bool)
    known[inverse[chosen]] = True
    return known


def _most_patches(store: Store, places: Places) -> int:
    """Most patches of a case"""
    most = 1
    for done in store.batches():
        if len(done.places) and (places.of(done.keys) >= 0).any():
            most = max(most, int(done.places[:, 2].max()))
    return most


def _take_columns(done: Done, at: NDArray[np.int64], found: _Table, totals: list[str] | None, size: tuple[int, int, int]) -> None:
    """Totals of a batch into the arrays of the dataset"""
    point, step, patch = (done.places[:, k] for k in range(3))
    use = at[point] >= 0
    for rows, of_pair in ((np.flatnonzero(use & (patch == 0)), True), (np.flatnonzero(use & (patch > 0)), False)):
        if len(rows) == 0:
            continue
        target = (at[point[rows]], step[rows]) if of_pair else (at[point[rows]], step[rows], patch[rows] - 1)
        for place, column in enumerate(done.columns):
            if column.of_pair != of_pair or (totals is not None and column.name not in totals):
                continue
            if column.name not in found:
                wide = size[:2] if of_pair or not _has_patches(done) else size
                attributes = {"units": _units(column.unit), "long_name": column.meaning}
                found[column.name] = (np.full(wide, np.nan), attributes, of_pair)
            values = found[column.name][0]
            values[target[:values.ndim]] = done.values[rows, place]


def _has_patches(done: Done) -> bool:
    """Are these results of wheel and rail, with a dimension of patches?"""
    return any(column.of_pair for column in done.columns)


def _units(unit: str) -> str:
    """The unit as other programs read it"""
    return {"-": "1", "": "1"}.get(unit, unit)


def _coordinates(space: Space, columns: dict[str, Values]) -> dict[str, Any]:
    """Values of what varies, along its dimension"""
    found: dict[str, Any] = {}
    for axis in space.axes:
        for path, values in axis.columns.items():
            name = space.short[path]
            shown = values if values.dtype == np.float64 else np.array([str(value) for value in values], dtype=object)
            found[name] = (axis.name, shown, {"long_name": path})
    dims = tuple(axis.name for axis in space.axes)
    for path in space.rules:
        values = columns[path]
        shown = values if values.dtype == np.float64 else np.array([str(value) for value in values], dtype=object)
        found[space.short[path]] = (dims, shown.reshape(space.shape), {"long_name": path})
    return found


def _add_fields(data: dict[str, Any], kept: dict[str, dict[tuple[int, int], Any]], units: dict[str, str],
                inverse: NDArray[np.intp], dims: tuple[str, ...], shape: tuple[int, ...], most: int, has_patches: bool) -> None:
    """Element fields, smaller grids with NaN behind them, and the frames of their grids"""
    arrays = [values for name in kept for values, _ in kept[name].values()]
    if not arrays:
        return
    my, mx = (max(values.shape[k] for values in arrays) for k in (0, 1))
    count = int(inverse.max()) + 1
    frames = np.full((count, most, 4), np.nan)
    end = (most,) if has_patches else ()
    end_dims = ("patch",) if has_patches else ()
    for name, found in kept.items():
        whole = np.full((count, most, my, mx), np.nan)
        for (point, patch), (values, frame) in found.items():
            whole[point, patch, :values.shape[0], :values.shape[1]] = values
            frames[point, patch] = frame
        data[name] = (dims + end_dims + ("row_of_elements", "column_of_elements"), whole[inverse].reshape((*shape, *end, my, mx)),
                      {"units": _units(units.get(name, ""))})
    for k, (name, what) in enumerate((("x_first", "x of the centres of the first column of elements"),
                                      ("y_first", "y of the centres of the first row of elements"),
                                      ("dx", "side of an element along x"), ("dy", "side of an element along y"))):
        data[name] = (dims + end_dims, frames[..., k][inverse].reshape((*shape, *end)), {"units": "mm", "long_name": what})


def save(data: xarray.Dataset, file: str | os.PathLike[str]) -> None:
    """Write a dataset.

    Parameters
    ----------
    file
        ``.nc`` for netCDF, ``.zarr`` for Zarr, both in chunks, or ``.parquet`` for the totals as a table, one row for each case
        and patch.
    """
    path = Path(file)
    if path.suffix == ".parquet":
        _save_table(data, path)
        return
    if path.suffix not in (".nc", ".zarr"):
        raise ContactError(f"{path}: results are written as .nc, .zarr or .parquet")
    encoding: dict[str, Any] = {}
    for name, values in data.variables.items():
        if values.dtype == object or values.ndim == 0:
            continue
        chunks = _chunks(values.shape)
        if path.suffix == ".nc":
            encoding[str(name)] = {"chunksizes": chunks, "zlib": True, "complevel": 1}
        else:
            encoding[str(name)] = {"chunks": chunks}
    if path.suffix == ".zarr":
        data.to_zarr(path, mode="w", encoding=encoding, consolidated=False)
        return
    beside = path.with_name(path.name + ".new")
    data.to_netcdf(beside, engine="netcdf4", encoding=encoding)
    os.replace(beside, path)


def _chunks(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Sides of a chunk: whole in the last dimensions, as far as it goes"""
    sides, left = [], _CHUNK
    for length in reversed(shape):
        side = max(1, min(length, left))
        sides.append(side)
        left = max(1, left // side)
    return tuple(reversed(sides))


def _save_table(data: xarray.Dataset, path: Path) -> None:
    """Totals as a table, a portion of the first dimension at a time"""
    import pyarrow
    import pyarrow.parquet
    dims = data["status"].dims
    names = [str(name) for name, values in data.data_vars.items() if set(values.dims) <= {*dims, "patch"}
             and values.dtype != object]
    table = data[names]
    portions = [table]
    if dims:
        longest = table.sizes[dims[0]]
        rows = max(1, table["status"].size // longest) * table.sizes.get("patch", 1)
        step = max(1, _CHUNK // rows)
        portions = [table.isel({dims[0]: slice(first, first + step)}) for first in range(0, longest, step)]
    beside = path.with_name(path.name + ".new")
    writer = None
    for portion in portions:
        frame = portion.to_dataframe().reset_index() if dims else portion.expand_dims("case").to_dataframe().reset_index()
        content = pyarrow.Table.from_pandas(frame, preserve_index=False)
        if writer is None:
            writer = pyarrow.parquet.ParquetWriter(beside, content.schema)
        writer.write_table(content)
    if writer is not None:
        writer.close()
        os.replace(beside, path)
