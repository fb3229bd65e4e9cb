"""The referee of the pump: its measurements, its limits and its findings."""
