"""Base of the generated parts of a job, and distributions (docs/job_randomization.md)."""

from __future__ import annotations

import dataclasses
from typing import Any, Mapping, Sequence

Distribution = Mapping[str, Sequence[Any]]


def choice(*values: Any) -> Distribution:
    """Each value equally often; one that is named twice, twice as often."""
    return {"choice": list(values)}


def uniform(low: Any, high: Any) -> Distribution:
    """Every value between the two equally often; times of day are texts."""
    return {"uniform": [low, high]}


def log_uniform(low: float, high: float) -> Distribution:
    """As many in every octave; low above 0."""
    return {"log_uniform": [low, high]}


def normal(mean: Any, standard_deviation: float) -> Distribution:
    """A bell curve; what falls outside of the field's range is drawn again."""
    return {"normal": [mean, standard_deviation]}


class Part:
    """Base class of a job's parts."""

    def to_dict(self) -> dict[str, Any]:
        """The JSON object; without what is None."""
        assert dataclasses.is_dataclass(self)
        fields = ((field.name, getattr(self, field.name)) for field in dataclasses.fields(self))
        return {name: plain(value) for name, value in fields if value is not None}


def plain(value: Any) -> Any:
    """The value as what json.dumps takes: parts as objects, sequences and NumPy arrays as lists, NumPy's numbers as
    numbers."""
    if isinstance(value, Part):
        return value.to_dict()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value
