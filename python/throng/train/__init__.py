"""Trains detectors and counters of people and scores them: `python3 -m throng.train` (docs/training.md)."""
