"""The simulated MICROBUS: wires, receivers with separate clocks, segments, faults, and timing diagrams."""
