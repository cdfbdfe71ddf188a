"""Results as an xarray dataset, and its files."""
from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from .._signatures import VERSION
from ..errors import ContactError
from ._batch import Column
from ._scene import Scene
from ._space import Space, Values
from ._store import Keys, Places, Store, distinct
from ._task import Done

#: Values of the variable status
STATUS = {-2: "not computed", -1: "left out", 0: "solved", 1: "not converged", 2: "refused"}
#: Columns by name: values, attributes, and whether they have a dimension of patches
_Table = dict[str, tuple[NDArray[Any], dict[str, str], bool]]
#: Maximum number of elements of a chunk of a file
_CHUNK = 1 << 18


@dataclass(frozen=True)
class Request:
    """Requested contents of a dataset.

    Attributes
    ----------
    scene
        Base of the study.
    totals
        Names of totals; None: all.
    fields
        Names of element fields.
    """

    scene: Scene
    totals: list[str] | None
    fields: tuple[str, ...]


@dataclass
class Survey:
    """Contents and sizes of the results of a whole study, so that all its parts have the same variables and shapes.

    Attributes
    ----------
    patches
        Maximum number of patches of a case.
    columns
        Totals with their attributes, whether they belong to wheel and rail together, and whether they have a dimension of patches.
    elements
        Maximum number of rows and columns of the grids of fields.
    units
        Units of fields.
    batch
        Index of the batch of the store with each point, -1 for none.
    sentences
        Indices of the reasons why cases were not solved; extended part by part.
    """

    patches: int
    columns: dict[str, tuple[dict[str, str], bool, bool]]
    elements: tuple[int, int]
    units: dict[str, str]
    batch: NDArray[np.int64]
    sentences: dict[str, int]


def survey(store: Store, keys: Keys, requested: Request) -> Survey:
    """Scan a store, batch by batch."""
    first, inverse = distinct(keys)
    places = Places(keys[first])
    batch = np.full(len(first), -1, dtype=np.int64)
    found = Survey(1, {}, (0, 0), {}, batch, {"": 0})
    for number in store.numbers():
        done = store.batch(number)
        at = places.of(done.keys)
        batch[at[at >= 0]] = number
        if not (at >= 0).any():
            continue
        if requested.scene.is_wheel_rail and len(done.places):
            found.patches = max(found.patches, int(done.places[:, 2].max()))
        for column in done.columns:
            if requested.totals is None or column.name in requested.totals:
                found.columns.setdefault(column.name, (_attributes(column), column.of_pair, _has_patches(done)))
        for name, values in done.arrays.items():
            if name.partition(",")[0] in requested.fields:
                found.elements = (max(found.elements[0], values.shape[0]), max(found.elements[1], values.shape[1]))
        found.units.update(done.units)
    found.batch = batch[inverse]
    return found


def assemble(store: Store, keys: Keys, chosen: NDArray[np.bool_], space: Space, columns: dict[str, Values], requested: Request,
             whole: Survey | None = None) -> xarray.Dataset:
    """The dataset of a study from its store; for a part of a whole, with the variables and sizes of the whole."""
    scene, totals, fields = requested.scene, requested.totals, requested.fields
    steps = scene.steps
    first, inverse = distinct(keys)
    places = Places(keys[first])
    numbers = store.numbers() if whole is None else [int(number) for number in np.unique(whole.batch) if number >= 0]
    most = whole.patches if whole is not None else _max_patches(store, places) if scene.is_wheel_rail else 1
    status = np.full((len(first), steps), -2, dtype=np.int8)
    missed = np.zeros((len(first), steps), dtype=np.int8)
    reason = np.zeros((len(first), steps), dtype=np.int32)
    sentences: dict[str, int] = {"": 0} if whole is None else whole.sentences
    found: _Table = {}
    if whole is not None:
        for name, (attributes, of_pair, has_patches) in whole.columns.items():
            size = (len(first), steps, most) if has_patches and not of_pair else (len(first), steps)
            found[name] = (np.full(size, np.nan), attributes, of_pair)
    kept: dict[str, dict[tuple[int, int], Any]] = {name: {} for name in fields}
    units: dict[str, str] = {} if whole is None else dict(whole.units)
    for number in numbers:
        done = store.batch(number)
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
            # a total with the name of an input: the computed and the prescribed creepage
            name += "_result"
        patch_dims = ("patch",) if scene.is_wheel_rail and not of_pair else ()
        values = values[inverse]
        values[~chosen] = np.nan
        data[name] = (dims + step_dims + patch_dims, values.reshape(shape + step_shape + values.shape[2:]), attributes)
    data["status"] = (dims + step_dims, status_of.reshape(shape + step_shape), {
        "long_name": "status of the case", "flag_values": np.array(list(STATUS), dtype=np.int8),
        "flag_meanings": " ".join(word.replace(" ", "_") for word in STATUS.values())})
    data["missed"] = (dims + step_dims, missed[inverse].reshape(shape + step_shape), {
        "long_name": "missed condition", "flag_values": np.arange(6, dtype=np.int8),
        "flag_meanings": "none normal tangential outer force time"})
    data["reason"] = (dims + step_dims, reason_of.reshape(shape + step_shape), {"long_name": "index in reasons"})
    data["reasons"] = (("sentence",), np.array(list(sentences), dtype=object), {"long_name": "why cases were not solved"})
    of_fields: dict[str, Any] = {}
    _add_fields(of_fields, kept, units, inverse, dims, shape, most, scene.is_wheel_rail,
                whole.elements if whole is not None else None)
    data.update({f"{name}_result" if name in taken else name: values for name, values in of_fields.items()})
    return coordinates_of(space, columns, scene, most).assign(data)


def _known(chosen: NDArray[np.bool_], inverse: NDArray[np.intp], count: int) -> NDArray[np.bool_]:
    """Which distinct points are not excluded by constraints"""
    known = np.zeros(count, dtype=bool)
    known[inverse[chosen]] = True
    return known


def _max_patches(store: Store, places: Places) -> int:
    """Maximum number of patches of a case"""
    most = 1
    for number in store.numbers():
        done = store.batch(number)
        if len(done.places) and (places.of(done.keys) >= 0).any():
            most = max(most, int(done.places[:, 2].max()))
    return most


def _take_columns(done: Done, at: NDArray[np.int64], found: _Table, totals: list[str] | None, size: tuple[int, int, int]) -> None:
    """Copy the totals of a batch into the arrays of the dataset"""
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
                found[column.name] = (np.full(wide, np.nan), _attributes(column), of_pair)
            values = found[column.name][0]
            values[target[:values.ndim]] = done.values[rows, place]


def _attributes(column: Column) -> dict[str, str]:
    """Unit and meaning of a total"""
    return {"units": _units(column.unit), "long_name": column.meaning}


def _has_patches(done: Done) -> bool:
    """Do these results have a dimension of patches, as those of wheel and rail?"""
    return any(column.of_pair for column in done.columns)


def _units(unit: str) -> str:
    """The unit in the notation of other programs"""
    return {"-": "1", "": "1"}.get(unit, unit)


def coordinates_of(space: Space, columns: dict[str, Values], scene: Scene, most: int) -> xarray.Dataset:
    """A dataset of the varied inputs, patches and steps, without results."""
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
    if scene.is_wheel_rail:
        found["patch"] = ("patch", np.arange(1, most + 1))
    if scene.steps > 1:
        found["step"] = ("step", np.arange(1, scene.steps + 1))
    return xarray.Dataset({}, found, {"title": "study of rolling contact", "source": f"CONTACT {VERSION}"})


def _add_fields(data: dict[str, Any], kept: dict[str, dict[tuple[int, int], Any]], units: dict[str, str],
                inverse: NDArray[np.intp], dims: tuple[str, ...], shape: tuple[int, ...], most: int, has_patches: bool,
                elements: tuple[int, int] | None) -> None:
    """Element fields, smaller grids padded with NaN, and position and element size of their grids"""
    arrays = [values for name in kept for values, _ in kept[name].values()]
    if elements is None:
        elements = (max((values.shape[0] for values in arrays), default=0), max((values.shape[1] for values in arrays), default=0))
    my, mx = elements
    if mx == 0:
        return
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
        chunks = chunks_of(values.shape)
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


def chunks_of(shape: tuple[int, ...]) -> tuple[int, ...]:
    """Shape of a chunk: full length in the last dimensions, as far as its size permits"""
    sides, left = [], _CHUNK
    for length in reversed(shape):
        side = max(1, min(length, left))
        sides.append(side)
        left = max(1, left // side)
    return tuple(reversed(sides))


def frames_of(data: xarray.Dataset, starts: Mapping[str, int] | None = None) -> Iterator[Any]:
    """Totals as tables of pyarrow, in portions along the first dimension; a row for each case and patch.

    Dimensions without coordinates are numbered, from 0 or from the start of the part.
    """
    import pyarrow
    dims = data["status"].dims
    data = data.assign_coords({name: np.arange(data.sizes[name]) + (starts or {}).get(str(name), 0)
                               for name in dims if name not in data.coords})
    names = [str(name) for name, values in data.data_vars.items() if set(values.dims) <= {*dims, "patch"}
             and values.dtype != object]
    table = data[names]
    portions = [table]
    if dims:
        longest = table.sizes[dims[0]]
        rows = max(1, table["status"].size // longest) * table.sizes.get("patch", 1)
        step = max(1, _CHUNK // rows)
        portions = [table.isel({dims[0]: slice(first, first + step)}) for first in range(0, longest, step)]
    for portion in portions:
        frame = portion.to_dataframe().reset_index() if dims else portion.expand_dims("case").to_dataframe().reset_index()
        yield pyarrow.Table.from_pandas(frame, preserve_index=False)


def _save_table(data: xarray.Dataset, path: Path) -> None:
    """Totals as a table"""
    import pyarrow.parquet
    beside = path.with_name(path.name + ".new")
    writer = None
    for content in frames_of(data):
        if writer is None:
            writer = pyarrow.parquet.ParquetWriter(beside, content.schema)
        writer.write_table(content)
    if writer is not None:
        writer.close()
        os.replace(beside, path)
