"""The assembly of an automobile water pump: its scene, its errors, its referee."""
