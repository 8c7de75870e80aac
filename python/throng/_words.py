"""Words of messages."""

from __future__ import annotations

import difflib
from typing import Collection, Iterable


def counted(count: int, noun: str, plural: str | None = None) -> str:
    """1 frame, 2 frames; 1 person, 2 people with a plural of its own."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def known_names(what: str, names: str | Collection[str] | None, known: Iterable[str]) -> Collection[str] | None:
    """The names, of which one may be a text alone. Raises ValueError for one that is not known, with the nearest."""
    if names is None:
        return None
    chosen = [names] if isinstance(names, str) else names
    every = sorted(set(known))
    folded = {name.casefold(): name for name in every}
    for name in chosen:
        if name in every:
            continue
        near = difflib.get_close_matches(str(name).casefold(), folded, 1)
        hint = f" (did you mean {folded[near[0]]!r}?)" if near else ""
        raise ValueError(f"{what}: found {name!r}, expected one of {', '.join(every) or '(nothing)'}{hint}")
    return chosen
