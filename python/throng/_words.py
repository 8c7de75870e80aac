"""Counted nouns."""

from __future__ import annotations


def counted(count: int, noun: str, plural: str | None = None) -> str:
    """1 frame, 2 frames; 1 person, 2 people with a plural of its own."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"
