"""The Stanford hand-eye pump assembly of 1973: a script becomes a plan, a plan and a work cell become a pump."""

__version__ = "0.1.0"
