"""The assembly of an automobile water pump: its scene, worlds, faults and referee."""
