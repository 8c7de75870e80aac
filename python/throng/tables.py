"""Tables as columns of NumPy arrays, and the reader of throng's CSV files."""

from __future__ import annotations

import csv
import io
from typing import Any, Collection, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ._optional import require
from .errors import DatasetError


class Table(Mapping[str, NDArray[Any]]):
    """Columns of equal length by name: numbers as float64 or int64, words as text."""

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)
        self.rows = len(next(iter(self._columns.values()))) if self._columns else 0

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"Table({self.rows} rows: {', '.join(self._columns)})"

    def where(self, **equal: Any) -> Table:
        """The rows whose columns have these values, for example where(exit="north")."""
        keep = np.ones(self.rows, dtype=np.bool_)
        for name, value in equal.items():
            keep &= self._columns[name] == value
        return Table({name: column[keep] for name, column in self._columns.items()})

    def to_pandas(self) -> Any:
        """A pandas.DataFrame."""
        return require("pandas", "to_pandas()").DataFrame(self._columns)


def read_csv(data: bytes, where: str, texts: Collection[str] = ()) -> Table:
    """texts: columns that stay texts, whatever stands in them."""
    try:
        rows = list(csv.reader(io.StringIO(data.decode("utf-8"))))
    except (UnicodeDecodeError, csv.Error) as error:
        raise DatasetError(f"{where}: found no CSV in UTF-8 ({error})") from error
    if not rows:
        raise DatasetError(f"{where}: found an empty file, expected a line with names of columns")
    names = rows[0]
    for line, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            raise DatasetError(f"{where}: line {line}: found {len(row)} fields, expected {len(names)}")
    columns = list(zip(*rows[1:])) if len(rows) > 1 else [() for _ in names]
    return Table(
        {
            name: np.array(column, dtype=np.str_) if name in texts else _column(column)
            for name, column in zip(names, columns)
        }
    )


def _column(values: tuple[str, ...]) -> NDArray[Any]:
    for kind in (np.int64, np.float64):
        try:
            # An empty field is a value that is not there.
            filled = [value or "nan" for value in values] if kind is np.float64 else list(values)
            return np.array(filled, dtype=np.str_).astype(kind) if filled else np.array([], dtype=np.float64)
        except ValueError:
            continue
    return np.array(values, dtype=np.str_)
