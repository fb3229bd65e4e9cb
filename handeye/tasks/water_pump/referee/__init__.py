"""The referee of the pump, with its measurements, limits and findings."""
