"""The assembly of an automobile water pump: scene, worlds, faults, referee."""
