"""A progress bar on a terminal, in a notebook, or as lines in a log."""

from __future__ import annotations

import html
import sys
from typing import Any, TextIO


class ProgressBar:
    """update() redraws; close() leaves the last state on the screen."""

    def __init__(self, title: str, stream: TextIO | None = None) -> None:
        self.title = title
        self._stream = sys.stderr if stream is None else stream
        self._handle: Any = None
        self._last = ""
        self._width = 0
        self._notebook = _notebook()

    def update(self, share: float, text: str, stage: str = "") -> None:
        share = min(1.0, max(0.0, share))
        if self._notebook is not None:
            markup = (
                f"<div>{html.escape(self.title)} <progress value='{share:.4f}' max='1' style='width:20em'></progress> "
                f"{100 * share:.0f} % {html.escape(text)}</div>"
            )
            if self._handle is None:
                self._handle = self._notebook.display(self._notebook.HTML(markup), display_id=True)
            else:
                self._handle.update(self._notebook.HTML(markup))
        elif self._stream.isatty():
            filled = round(24 * share)
            line = f"{self.title} [{'#' * filled}{'.' * (24 - filled)}] {100 * share:3.0f} % {text}"
            self._stream.write("\r" + line.ljust(self._width))
            self._stream.flush()
            self._width = len(line)
        elif stage != self._last:
            self._stream.write(f"{self.title}: {stage or text}\n")
            self._stream.flush()
        self._last = stage

    def close(self) -> None:
        if self._notebook is None and self._stream.isatty() and self._width:
            self._stream.write("\n")
            self._stream.flush()


def _notebook() -> Any:
    """IPython.display where this runs in a notebook's kernel."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    if shell is None or type(shell).__name__ != "ZMQInteractiveShell":
        return None
    import importlib

    return importlib.import_module("IPython.display")
