"""Stations of the pump's table: fixtures that parts and tools wait on, or are pushed against."""

from enum import StrEnum


class Station(StrEnum):
    """Names of the fixtures: of their bodies in the scene, and of the errors with which they stand."""

    BLOCKS = "blocks"
    PIN_HOLDER = "pin_holder"
    GASKET_STAND = "gasket_stand"
    TOP_STAND = "top_stand"
    RACK = "rack"
    DISPENSER = "dispenser"
