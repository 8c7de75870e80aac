"""gymnasium's Env and spaces, or as much of their interface as Env needs where the package is absent."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np
from numpy.typing import DTypeLike, NDArray

try:
    import gymnasium  # type: ignore[import]
    from gymnasium.spaces import Box, Dict  # type: ignore[import]

    BaseEnv: Any = gymnasium.Env
except ImportError:

    class _Env:
        metadata: dict[str, Any] = {}
        render_mode: str | None = None
        spec: Any = None

        @property
        def unwrapped(self) -> "_Env":
            return self

        def __enter__(self) -> "_Env":
            return self

        def __exit__(self, *_: object) -> None:
            self.close()

        def close(self) -> None:
            """Nothing is open."""

    BaseEnv = _Env

    class Box:  # type: ignore[no-redef]
        """Arrays between two bounds."""

        def __init__(
            self, low: Any, high: Any, shape: Sequence[int] | None = None, dtype: DTypeLike = np.float32
        ) -> None:
            self.dtype = np.dtype(dtype)
            self.shape = tuple(np.shape(low) if shape is None else shape)
            self.low = np.broadcast_to(np.asarray(low, self.dtype), self.shape)
            self.high = np.broadcast_to(np.asarray(high, self.dtype), self.shape)
            self._random = np.random.default_rng()

        def seed(self, seed: int | None = None) -> None:
            self._random = np.random.default_rng(seed)

        def sample(self) -> NDArray[Any]:
            if self.dtype.kind in "ui":
                return self._random.integers(self.low, self.high, endpoint=True).astype(self.dtype)
            low = np.where(np.isfinite(self.low), self.low, -1)
            high = np.where(np.isfinite(self.high), self.high, 1)
            return self._random.uniform(low, high).astype(self.dtype)

        def contains(self, value: Any) -> bool:
            array = np.asarray(value)
            return bool(array.shape == self.shape and np.all(array >= self.low) and np.all(array <= self.high))

        def __repr__(self) -> str:
            return f"Box({self.shape}, {self.dtype})"

    class Dict:  # type: ignore[no-redef]
        """Spaces by name."""

        def __init__(self, spaces: Mapping[str, Any]) -> None:
            self.spaces = dict(spaces)

        def seed(self, seed: int | None = None) -> None:
            for number, space in enumerate(self.spaces.values()):
                space.seed(None if seed is None else seed + number)

        def sample(self) -> dict[str, Any]:
            return {name: space.sample() for name, space in self.spaces.items()}

        def contains(self, value: Any) -> bool:
            return set(value) == set(self.spaces) and all(
                space.contains(value[name]) for name, space in self.spaces.items()
            )

        def __getitem__(self, name: str) -> Any:
            return self.spaces[name]

        def __repr__(self) -> str:
            return f"Dict({self.spaces})"


__all__ = ["BaseEnv", "Box", "Dict"]
