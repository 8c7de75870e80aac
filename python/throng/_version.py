"""The version, which is that of the program that the package comes with."""

__version__ = "0.1.0"
