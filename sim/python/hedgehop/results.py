"""Results of flights as numpy record arrays."""

import csv
import dataclasses
import io
import json
import pathlib

import numpy as np


TEXTS = ("trajectory_hash", "build", "point")  # hexadecimal digits, which could be parsed as a number


def _column(name, texts):
    """Returns 64-bit seeds; numbers if all fields are numbers or empty (NaN); else texts."""
    if name == "seed":
        return np.array([int(text) for text in texts], dtype=np.uint64)
    if name in TEXTS:
        return np.array(texts)
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


def _text(file):
    return file.read_text(encoding="utf-8")


def _read_json(file):
    """Returns the content of a JSON file. Raises ValueError with the place of a fault."""
    text = _text(file)
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        kind = "complete" if error.pos >= len(text.rstrip()) else "valid"
        raise ValueError(f"{file}:{error.lineno}:{error.colno}: is not {kind} JSON") from None


def read_table(text):
    """Returns the table of a CSV text as a record array with one field per column."""
    rows = list(csv.reader(io.StringIO(text)))
    names, rows = rows[0], rows[1:]
    columns = [_column(name, [row[i] for row in rows]) for i, name in enumerate(names)]
    if not rows:
        return np.recarray(0, dtype=[(name, float) for name in names])
    return np.rec.fromarrays(columns, names=names)


@dataclasses.dataclass
class Flight:
    """result: as in result.json. trajectory, decisions: record arrays with the columns of the CSV files."""

    result: dict
    trajectory: np.recarray
    decisions: np.recarray

    def __repr__(self):
        words = {key: self.result.get(key) for key in ("scenario", "seed", "outcome", "flight_time_s")}
        return f"Flight({', '.join(f'{key}={value!r}' for key, value in words.items())}, decisions={len(self.decisions)})"


def load(folder):
    """Returns the Flight of `hedgehop run`, or the record array of a batch or sweep with one record per flight."""
    folder = pathlib.Path(folder)
    for table in ("sweep.csv", "batch.csv"):
        if (folder / table).exists():
            return read_table(_text(folder / table))
    if not (folder / "result.json").exists():
        raise FileNotFoundError(f"{folder}: no result.json, batch.csv or sweep.csv")
    return Flight(_read_json(folder / "result.json"), read_table(_text(folder / "trajectory.csv")),
                  read_table(_text(folder / "decisions.csv")))


def to_frame(records):
    """Returns a record array as a pandas DataFrame."""
    import pandas

    return pandas.DataFrame.from_records(records)
